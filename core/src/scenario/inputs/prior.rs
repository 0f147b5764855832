//! What a calibration filter takes for granted before the first reading.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Standard deviations of the errors that a calibration filter reckons with, and of the noise. All illustrative.
///
/// One of 0 is believed exactly: the filter has no such error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Prior {
    /// Of the tracker frame's offset along each axis of {B}, m.
    pub translation: f64,
    /// Of the tracker frame's turn about each axis of {B}, rad.
    pub rotation: f64,
    /// Of the relative error of the length.
    pub length: f64,
    /// Of the relative error of the bend.
    pub bend_scale: f64,
    /// Of the offset of the bend, rad.
    pub bend_offset: f64,
    /// Of the offset of δ, rad.
    pub delta: f64,
    /// Of the latency, s.
    pub latency: f64,
    /// The standard deviation q with which the bend of every reading is free, rad.
    pub free_bend: f64,
    /// Of the tracker's drift on each axis, m; 0 reckons with none.
    pub drift: f64,
    /// Correlation time of the drift, s.
    pub drift_time: f64,
    /// Of the noise of each coordinate, m.
    pub position_noise: Estimated,
    /// Of the noise about each axis, rad.
    pub orientation_noise: Estimated,
    /// Correlation of the noise from reading to reading.
    pub colour: Estimated,
}

impl Default for Prior {
    fn default() -> Self {
        Self {
            translation: 1e-3,
            rotation: PI / 180.0,
            length: 0.02,
            bend_scale: 0.02,
            bend_offset: PI / 180.0,
            delta: PI / 90.0,
            latency: 0.010,
            free_bend: PI / 90.0,
            drift: 0.0,
            drift_time: 1.0,
            position_noise: Estimated::AUTO,
            orientation_noise: Estimated::AUTO,
            colour: Estimated::AUTO,
        }
    }
}

/// A number that is known, or that is estimated from the readings of the still stretch before the motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number or \"auto\"")]
pub enum Estimated {
    /// Known to be this.
    Known(f64),
    /// To be estimated.
    Auto(Auto),
}

/// The word `"auto"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Auto {
    /// Estimated.
    Auto,
}

impl Estimated {
    /// To be estimated.
    pub const AUTO: Self = Self::Auto(Auto::Auto);

    /// The value, when it is known.
    #[must_use]
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Known(value) => Some(value),
            Self::Auto(_) => None,
        }
    }
}
