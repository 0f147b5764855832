//! Where the segment is in its configuration space ψ = (θL, δ), and how fast it moves there.
//!
//! θ0 is the double nearest to π/2: θL = [`FRAC_PI_2`] is straight exactly, and small bends keep their digits.

use libm::sincos;
use std::f64::consts::FRAC_PI_2;

/// A configuration ψ = (θL, δ), held as the bend φ = π/2 − θL so that small bends keep their digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Configuration {
    bend: f64,
    delta: f64,
    sin_delta: f64,
    cos_delta: f64,
}

impl Configuration {
    /// From the bend φ and the bending-plane angle δ, both in rad and finite.
    #[must_use]
    pub fn new(bend: f64, delta: f64) -> Self {
        let (sin_delta, cos_delta) = sincos(delta);
        Self { bend, delta, sin_delta, cos_delta }
    }

    /// From the paper's θL (rad; π/2 is straight) and δ (rad). θL is taken as the exact double it is.
    #[must_use]
    pub fn from_theta_l(theta_l: f64, delta: f64) -> Self {
        Self::new(bend_from_theta_l(theta_l), delta)
    }

    /// The same bending plane with another bend φ (rad).
    #[must_use]
    pub fn with_bend(self, bend: f64) -> Self {
        Self { bend, ..self }
    }

    /// The bend φ = π/2 − θL in rad: 0 is straight, positive bends toward `(cos δ, −sin δ, 0)`.
    #[must_use]
    pub fn bend(self) -> f64 {
        self.bend
    }

    /// The tangent angle θL at the end disk in rad.
    #[must_use]
    pub fn theta_l(self) -> f64 {
        theta_l_from_bend(self.bend)
    }

    /// The bending-plane angle δ in rad.
    #[must_use]
    pub fn delta(self) -> f64 {
        self.delta
    }

    /// `(sin δ, cos δ)`.
    #[must_use]
    pub fn sin_cos_delta(self) -> (f64, f64) {
        (self.sin_delta, self.cos_delta)
    }
}

/// φ = θ0 − θL (rad).
#[must_use]
pub fn bend_from_theta_l(theta_l: f64) -> f64 {
    FRAC_PI_2 - theta_l
}

/// θL = θ0 − φ (rad).
#[must_use]
pub fn theta_l_from_bend(bend: f64) -> f64 {
    FRAC_PI_2 - bend
}

/// The configuration's velocity ψ̇ = (θ̇L, δ̇), rad/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rate {
    /// θ̇L in rad/s; negative while the segment bends further.
    pub theta_l: f64,
    /// δ̇ in rad/s.
    pub delta: f64,
}

impl Rate {
    /// θL falls at 1 rad/s, δ rests: the direction of bending. A centrode depends on direction only, so this gives it
    /// at rest, too.
    pub const BENDING: Self = Self { theta_l: -1.0, delta: 0.0 };
}
