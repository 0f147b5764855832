//! How a contact is placed.

use super::choice::{Choice, Listed};
use serde::{Deserialize, Serialize};

/// How a contact is placed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Estimation {
    /// The model of the contact in Eq. 24 (default: the paper's).
    pub kind: EstimationKind,
    /// Which estimators place a contact (default: the one that gives an interval).
    pub estimators: Choice<Estimator>,
    /// Kinds of contact that [`Estimator::Marginal`] thinks possible (default: all).
    pub plants: Choice<Kind>,
    /// Beginnings that it tries from one reading to the next, at most.
    pub beginnings: u64,
}

impl Default for Estimation {
    fn default() -> Self {
        Self {
            kind: EstimationKind::default(),
            estimators: Choice::of(&[Estimator::Marginal]),
            plants: Choice::of(Kind::ALL),
            beginnings: 16,
        }
    }
}

/// The model of the contact in Eq. 24.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EstimationKind {
    /// A beam that clamps the backbone, as in the paper.
    #[default]
    Clamp,
    /// A beam that only touches it.
    Plane,
    /// What the simulated beam does, from the bend on at which it does it: a rig knows neither.
    AsSimulated,
}

impl EstimationKind {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Clamp, Self::Plane, Self::AsSimulated];
}

/// What places a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Estimator {
    /// Eq. 24 at the instant: the place whose constrained centrode is nearest to the sensor's.
    Eq24,
    /// Eq. 24 one filter length later, when the average holds nothing from before.
    Settled,
    /// The posterior of the place, with the errors of the calibration integrated out.
    Marginal,
}

impl Estimator {
    /// All of them.
    pub const ALL: &'static [Self] = &[Self::Eq24, Self::Settled, Self::Marginal];
    /// Their words.
    pub const WORDS: &'static [&'static str] = &["eq24", "settled", "marginal"];
}

impl Listed for Estimator {
    const ALL: &'static [Self] = Estimator::ALL;

    fn word(self) -> &'static str {
        Self::WORDS[self as usize]
    }
}

/// How a contact holds the backbone, as a hypothesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A beam that clamps it: the part below keeps its shape.
    Clamp,
    /// A plane that touches it: the part below goes on changing shape.
    Plane,
}

impl Kind {
    /// All of them.
    pub const ALL: &'static [Self] = &[Self::Clamp, Self::Plane];
    /// Their words.
    pub const WORDS: &'static [&'static str] = &["clamp", "plane"];
}

impl Listed for Kind {
    const ALL: &'static [Self] = Kind::ALL;

    fn word(self) -> &'static str {
        Self::WORDS[self as usize]
    }
}
