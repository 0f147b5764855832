//! The page in the frame of another page: what of it is shown, and the way out to a page of its own.

use egui::{Rect, Ui, vec2};

use crate::app::command::{Command, Share};
use crate::app::stages::stage::Stage;
use crate::app::widgets::icon::{self, Icon, Look};
use centrode_core::scenario::link::page::VIEWS;

/// What is shown in a frame; what is not part of it is hidden.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Embed {
    /// The 3D view and playback.
    Robot,
    /// The plots and playback.
    Plots,
    /// The tuning view.
    Tuning,
    /// Everything but title, presets, sharing, theme and help.
    All,
}

impl Embed {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Robot, Self::Plots, Self::Tuning, Self::All];

    /// Its name in an address.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Robot => "robot",
            Self::Plots => "plots",
            Self::Tuning => "tuning",
            Self::All => "all",
        }
    }

    /// The one of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|embed| embed.name() == name)
    }

    /// The stage that it shows where a link names one.
    #[must_use]
    pub fn stage(self, named: Stage) -> Stage {
        match self {
            Self::Robot | Self::Plots if named.is_run() => named,
            Self::Robot | Self::Plots => Stage::Robot,
            Self::Tuning => Stage::Tuning,
            Self::All => named,
        }
    }

    /// The views that it can show, as a link names them.
    #[must_use]
    pub fn views(self) -> &'static [&'static str] {
        match self {
            Self::Robot | Self::Plots => &["robot", "chain"],
            Self::Tuning => &["tuning"],
            Self::All => VIEWS,
        }
    }
}

/// Width of one tool, points.
pub const TOOL: f32 = 40.0;

/// Shows the tools that stay in a frame: the way to a page of its own and, where they are in a sheet, the controls. Beside each other,
/// or above each other where it is narrow.
pub fn tools(ui: &mut Ui, rect: Rect, sheet: Option<bool>, out: &mut Vec<Command>) {
    let beside = rect.width() >= 2.0 * TOOL;
    let center = if sheet.is_none() {
        rect.center()
    } else if beside {
        rect.right_center() - vec2(TOOL / 2.0, 0.0)
    } else {
        rect.center_bottom() - vec2(0.0, TOOL / 2.0)
    };
    let place = Rect::from_center_size(center, vec2(34.0, 34.0));
    if icon::button(ui, place, Icon::Open, "Open in a page of its own", Look::Plain).clicked() {
        out.push(Command::Share(Share::OwnPage));
    }
    let Some(open) = sheet else { return };
    let place = place.translate(if beside { vec2(-TOOL, 0.0) } else { vec2(0.0, -TOOL) });
    if icon::button(ui, place, Icon::Controls, "Controls", if open { Look::Lit } else { Look::Plain }).clicked() {
        out.push(Command::ToggleSheet);
    }
}
