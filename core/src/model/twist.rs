//! Twists and wrenches, both in {B}.

use super::{Mat3, Vec3};
use std::ops::{Add, Mul};

/// The velocity of a frame, in {B}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Velocity of the frame's origin (m/s, or m/rad as a Jacobian column).
    pub linear: Vec3,
    /// Angular velocity ω (rad/s, or 1 as a Jacobian column).
    pub angular: Vec3,
}

impl Twist {
    /// The same motion seen from a frame in which this one is turned by `rotation` (the 6×6 block-diagonal of Eq. 22).
    #[must_use]
    pub fn rotated(self, rotation: &Mat3) -> Self {
        Self { linear: rotation * self.linear, angular: rotation * self.angular }
    }

    /// Power of a wrench acting at the frame's origin (W, or N·m as a Jacobian column).
    #[must_use]
    pub fn power(self, wrench: &Wrench) -> f64 {
        self.linear.dot(&wrench.force) + self.angular.dot(&wrench.moment)
    }

    /// Linear part first, as in the paper's six-vectors.
    #[must_use]
    pub fn to_array(self) -> [f64; 6] {
        let (v, w) = (self.linear, self.angular);
        [v.x, v.y, v.z, w.x, w.y, w.z]
    }
}

impl Add for Twist {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { linear: self.linear + other.linear, angular: self.angular + other.angular }
    }
}

impl Mul<f64> for Twist {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { linear: self.linear * factor, angular: self.angular * factor }
    }
}

/// An external wrench W_e acting at the origin of the tip frame, in {B} (Eq. 11).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force in N.
    pub force: Vec3,
    /// Moment in N·m.
    pub moment: Vec3,
}

impl Wrench {
    /// None.
    pub const ZERO: Self = Self { force: Vec3::new(0.0, 0.0, 0.0), moment: Vec3::new(0.0, 0.0, 0.0) };
}
