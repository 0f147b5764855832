//! Which detectors there are, which of them judge, and their thresholds.

use super::choice::{Choice, Listed};
use serde::{Deserialize, Serialize};

/// How a contact is noticed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Fixed centrode deviation ‖c_m − c_s‖ above ξ2 (Eq. 19).
    Fcd,
    /// Joint force deviation Θ above ξ1 (Eqs. 12, 16).
    Jfd,
    /// The same as [`Method::Fcd`] with a model's centrode that is sampled, delayed and averaged as the sensor's is.
    FcdConsistent,
    /// ‖ω_s‖·‖c_m − c_s‖: by how much the velocities of the end disk differ, which needs no least speed.
    FcdVelocity,
    /// Page's CUSUM of the log likelihood ratio of a contact, on readings whose calibration errors have been estimated.
    Cusum,
    /// The largest such log likelihood ratio over places and times of a contact.
    Glr,
}

impl Method {
    /// All of them, in the order in which they judge an instant.
    pub const ALL: &'static [Self] =
        &[Self::Fcd, Self::Jfd, Self::FcdConsistent, Self::FcdVelocity, Self::Cusum, Self::Glr];
    /// Those of the paper.
    pub const PAPER: &'static [Self] = &[Self::Fcd, Self::Jfd];
    /// The keys of all of them, in their order.
    pub const KEYS: &'static [&'static str] = &[
        Self::Fcd.key(),
        Self::Jfd.key(),
        Self::FcdConsistent.key(),
        Self::FcdVelocity.key(),
        Self::Cusum.key(),
        Self::Glr.key(),
    ];

    /// Its key in files and on the command line.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Fcd => "fcd",
            Self::Jfd => "jfd",
            Self::FcdConsistent => "fcd-consistent",
            Self::FcdVelocity => "fcd-velocity",
            Self::Cusum => "cusum",
            Self::Glr => "glr",
        }
    }

    /// Whether it is one of the paper's.
    #[must_use]
    pub fn is_of_paper(self) -> bool {
        Self::PAPER.contains(&self)
    }
}

impl Listed for Method {
    const ALL: &'static [Self] = Method::ALL;

    fn word(self) -> &'static str {
        self.key()
    }
}

/// Some of the detectors.
pub type Detectors = Choice<Method>;

/// Which detectors raise no alarm before `detection.armed_from`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arming {
    /// The paper's.
    #[default]
    Paper,
    /// All.
    All,
}

/// Which detectors judge, their thresholds, and when they are looked at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Thresholds {
    /// The detectors that judge (default: the paper's two).
    pub detectors: Detectors,
    /// ξ1 of the joint force deviation Θ, N·m, or `"off"` (illustrative: above ε_c of the default robot).
    pub xi1: Threshold,
    /// Whether ξ1 is that constant, or follows the shape as k·ε_c(θL) (illustrative). `xi1 = "off"` silences both.
    pub xi1_rule: Xi1Rule,
    /// k in k·ε_c(θL) (illustrative: half again what friction alone can do).
    pub xi1_factor: f64,
    /// ξ2 of the fixed centrode deviation ‖c_m − c_s‖, m, or `"off"`.
    pub xi2: Threshold,
    /// Of the distance from the model's centrode that is sampled and averaged like the tracker's, m, or `"off"` (illustrative).
    pub consistent: Threshold,
    /// Of ‖ω_s‖·‖c_m − c_s‖, m/s, or `"off"` (illustrative).
    pub velocity: Threshold,
    /// Of Page's CUSUM of the log likelihood ratio, natural logarithm, or `"off"` (illustrative).
    pub cusum: Threshold,
    /// Of the generalised log likelihood ratio, natural logarithm, or `"off"` (illustrative).
    pub glr: Threshold,
    /// Detectors that wait, by `arming`, raise no alarm before this time, s.
    pub armed_from: f64,
    /// Which detectors wait for `armed_from` (illustrative).
    pub arming: Arming,
    /// The centrode deviations are judged only while ‖ω_s‖ exceeds this, rad/s (illustrative).
    pub min_speed: f64,
    /// An event is cleared once its value has fallen below this share of the threshold (illustrative).
    pub release: f64,
    /// An event lasts at least this long, s (illustrative).
    pub hold: f64,
}

impl Default for Thresholds {
    fn default() -> Self {
        Self {
            detectors: Detectors::of(Method::PAPER),
            xi1: Threshold::On(0.03),
            xi1_rule: Xi1Rule::Constant,
            xi1_factor: 1.5,
            xi2: Threshold::On(0.007),
            consistent: Threshold::On(0.002_45),
            velocity: Threshold::On(0.001),
            cusum: Threshold::On(9.3),
            glr: Threshold::On(9.2),
            armed_from: 5.0,
            arming: Arming::Paper,
            min_speed: 0.05,
            release: 0.8,
            hold: 0.1,
        }
    }
}

impl Thresholds {
    /// The threshold of a detector as it is set; where ξ1 follows the shape, this is whether it is switched on.
    #[must_use]
    pub fn of(&self, method: Method) -> Threshold {
        match method {
            Method::Fcd => self.xi2,
            Method::Jfd => self.xi1,
            Method::FcdConsistent => self.consistent,
            Method::FcdVelocity => self.velocity,
            Method::Cusum => self.cusum,
            Method::Glr => self.glr,
        }
    }

    /// The same, to be set.
    pub fn of_mut(&mut self, method: Method) -> &mut Threshold {
        match method {
            Method::Fcd => &mut self.xi2,
            Method::Jfd => &mut self.xi1,
            Method::FcdConsistent => &mut self.consistent,
            Method::FcdVelocity => &mut self.velocity,
            Method::Cusum => &mut self.cusum,
            Method::Glr => &mut self.glr,
        }
    }

    /// Whether a detector can raise an alarm: it is one of those that judge, and its threshold is switched on.
    #[must_use]
    pub fn judges(&self, method: Method) -> bool {
        self.detectors.has(method) && self.of(method).value().is_some()
    }

    /// Whether a detector waits for `armed_from`.
    #[must_use]
    pub fn waits(&self, method: Method) -> bool {
        self.arming == Arming::All || method.is_of_paper()
    }

    /// ξ1 where the free model's bound ε_c(θL) is `shape_bound` (N·m): a constant, or k times that; none while switched off.
    #[must_use]
    pub fn xi1_at(&self, shape_bound: f64) -> Option<f64> {
        let constant = self.xi1.value()?;
        Some(match self.xi1_rule {
            Xi1Rule::Constant => constant,
            Xi1Rule::Bound => self.xi1_factor * shape_bound,
        })
    }
}

/// What ξ1 is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Xi1Rule {
    /// `detection.xi1`, everywhere.
    Constant,
    /// `detection.xi1_factor` times the bound ε_c (Eq. 16) of the free model at the commanded shape.
    Bound,
}

/// A threshold that can be switched off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number or \"off\"")]
pub enum Threshold {
    /// Alarm above this value.
    On(f64),
    /// Never alarm.
    Off(Off),
}

/// The word `"off"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Off {
    /// Switched off.
    Off,
}

impl Threshold {
    /// A threshold that never alarms.
    pub const OFF: Self = Self::Off(Off::Off);

    /// The value, when switched on.
    #[must_use]
    pub fn value(self) -> Option<f64> {
        match self {
            Self::On(value) => Some(value),
            Self::Off(_) => None,
        }
    }
}
