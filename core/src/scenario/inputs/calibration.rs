//! How the true robot differs from its model.

use serde::{Deserialize, Serialize};

/// Errors of the true robot against the nominal one, and of the tracker. Default none: all illustrative.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Calibration {
    /// Whether the values down to `latency` are the errors, or standard deviations of errors drawn from the seed.
    pub draw: Draw,
    /// Offset of the tracker's frame, in {B}, m.
    pub frame: [f64; 3],
    /// Turn of the tracker's frame about the origin of {B}, a rotation vector in {B}, rad.
    pub frame_turn: [f64; 3],
    /// Relative error e of the length: the true one is L(1 + e).
    pub length: f64,
    /// Relative error of the bend.
    pub bend_scale: f64,
    /// Added to the bend, rad.
    pub bend_offset: f64,
    /// Added to δ, rad.
    pub delta: f64,
    /// How much older a reading is than `tracker.latency` says, s.
    pub latency: f64,
    /// Backlash of the bend, rad.
    pub play: f64,
    /// Standard deviation of the tracker's drift on each axis, m.
    pub drift: f64,
    /// Correlation time of the drift, s.
    pub drift_time: f64,
    /// Correlation of the tracker's noise from reading to reading.
    pub colour: f64,
}

impl Default for Calibration {
    fn default() -> Self {
        Self {
            draw: Draw::Fixed,
            frame: [0.0; 3],
            frame_turn: [0.0; 3],
            length: 0.0,
            bend_scale: 0.0,
            bend_offset: 0.0,
            delta: 0.0,
            latency: 0.0,
            play: 0.0,
            drift: 0.0,
            drift_time: 1.0,
            colour: 0.0,
        }
    }
}

impl Calibration {
    /// Whether the true robot depends on the seed.
    #[must_use]
    pub fn is_drawn(&self) -> bool {
        let Self { draw, frame, frame_turn, length, bend_scale, bend_offset, delta, latency, .. } = *self;
        let single = [length, bend_scale, bend_offset, delta, latency];
        draw == Draw::Drawn && frame.into_iter().chain(frame_turn).chain(single).any(|size| size != 0.0)
    }
}

/// What the values of [`Calibration`] are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Draw {
    /// The errors themselves.
    #[default]
    Fixed,
    /// Standard deviations of normal errors, drawn from the seed.
    Drawn,
}
