//! What the large part of the page shows: the robot, something of the paper, the map or the tuning.

use centrode_core::scenario::link::page;
use centrode_core::study::figure::Number;
use serde::{Deserialize, Serialize};

/// What stands on the stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// The robot in 3D and in its bending plane.
    #[default]
    Robot,
    /// Segments in series.
    Chain,
    /// The bound of the joint forces over the bend.
    Figure3,
    /// Centrode loci with and without constraint.
    Figure4,
    /// Joint forces with and without contact.
    Figure6,
    /// Joint forces over the bend.
    Figure7,
    /// Centrode deviation and detections.
    Figure8,
    /// Table II.
    Table2,
    /// Which contacts are detectable.
    Map,
    /// How soon and how reliably each threshold and filter detects.
    Tuning,
    /// The detectors held against each other, and against what cannot be beaten.
    Detectors,
}

/// The views of the bar; each has one stage or, the paper, several.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// The robot.
    Robot,
    /// Segments in series.
    Chain,
    /// Figures and Table II.
    Paper,
    /// The map.
    Map,
    /// The tuning.
    Tuning,
}

impl Section {
    /// All of them, in the order offered.
    pub const ALL: [Self; 5] = [Self::Robot, Self::Chain, Self::Paper, Self::Map, Self::Tuning];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Robot => "Robot",
            Self::Chain => "Segments",
            Self::Paper => "Paper",
            Self::Map => "Map",
            Self::Tuning => "Tuning",
        }
    }

    /// What it shows, in a line.
    #[must_use]
    pub fn summary(self) -> &'static str {
        match self {
            Self::Robot => Stage::Robot.summary(),
            Self::Chain => Stage::Chain.summary(),
            Self::Paper => "Five figures of the paper and its Table II, simulated here",
            Self::Map => Stage::Map.summary(),
            Self::Tuning => Stage::Tuning.summary(),
        }
    }
}

impl Stage {
    /// All of them, in the order offered.
    pub const ALL: [Self; 11] = [
        Self::Robot,
        Self::Chain,
        Self::Figure3,
        Self::Figure4,
        Self::Figure6,
        Self::Figure7,
        Self::Figure8,
        Self::Table2,
        Self::Map,
        Self::Tuning,
        Self::Detectors,
    ];

    /// Those of the paper.
    pub const PAPER: [Self; 6] =
        [Self::Figure3, Self::Figure4, Self::Figure6, Self::Figure7, Self::Figure8, Self::Table2];

    /// Those of the tuning.
    pub const TUNING: [Self; 2] = [Self::Tuning, Self::Detectors];

    /// Whether it is a robot as it moves, with views around it, rather than a study in their place.
    #[must_use]
    pub fn is_run(self) -> bool {
        matches!(self, Self::Robot | Self::Chain)
    }

    /// The view that it belongs to.
    #[must_use]
    pub fn section(self) -> Section {
        match self {
            Self::Robot => Section::Robot,
            Self::Chain => Section::Chain,
            Self::Map => Section::Map,
            Self::Tuning | Self::Detectors => Section::Tuning,
            _ => Section::Paper,
        }
    }

    /// Name of the preset that it is made with, whatever the page is set to; none for what shows the page's scenario.
    #[must_use]
    pub fn own_preset(self) -> Option<&'static str> {
        match self {
            Self::Table2 => Some("bench"),
            _ => self.figure().map(Number::preset),
        }
    }

    /// The figure it is, if it is one.
    #[must_use]
    pub fn figure(self) -> Option<Number> {
        match self {
            Self::Figure3 => Some(Number::Three),
            Self::Figure4 => Some(Number::Four),
            Self::Figure6 => Some(Number::Six),
            Self::Figure7 => Some(Number::Seven),
            Self::Figure8 => Some(Number::Eight),
            Self::Robot | Self::Chain | Self::Table2 | Self::Map | Self::Tuning | Self::Detectors => None,
        }
    }

    /// Its name in a link.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Robot => "robot",
            Self::Chain => page::CHAIN,
            Self::Figure3 => "figure-3",
            Self::Figure4 => "figure-4",
            Self::Figure6 => "figure-6",
            Self::Figure7 => "figure-7",
            Self::Figure8 => "figure-8",
            Self::Table2 => "table2",
            Self::Map => "map",
            Self::Tuning => "tuning",
            Self::Detectors => "detectors",
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Robot => "Robot",
            Self::Chain => "Segments",
            Self::Figure3 => "Figure 3",
            Self::Figure4 => "Figure 4",
            Self::Figure6 => "Figure 6",
            Self::Figure7 => "Figure 7",
            Self::Figure8 => "Figure 8",
            Self::Table2 => "Table II",
            Self::Map => "Map",
            Self::Tuning => "Tuning",
            Self::Detectors => "Detectors",
        }
    }

    /// What it shows, in a line.
    #[must_use]
    pub fn summary(self) -> &'static str {
        match (self, self.figure()) {
            (_, Some(number)) => number.title(),
            (Self::Table2, _) => "Contact on three disks: the paper's experiment and the simulated one",
            (Self::Chain, _) => "Several segments in series, several contacts: which segment is touched, and where",
            (Self::Map, _) => "Which contacts are detectable: the largest thresholds that find them, by place and bend",
            (Self::Tuning, _) => "Choose thresholds and filter: false alarms against delay, from repeated runs",
            (Self::Detectors, _) => "Which detector is soonest at equal false alarms, and how true its places are",
            _ => "The robot as it bends, and its centrodes in the bending plane",
        }
    }
}
