//! The segment held at one point of its backbone (Eqs. 20–23).

use super::{Arc, Configuration, Jacobian, Pose, Rate, Twist, Vec3};

/// A segment held at arc length s_c: `[0, s_c]` keeps the shape it had at contact, the rest is a segment of
/// its own that starts at frame {S} of s_c and ends at the commanded tangent angle θL.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constrained {
    /// The part below the contact, frozen.
    pub lower: Arc,
    /// The part above it, in frame {S} of s_c; its δ is the segment's.
    pub upper: Arc,
    /// Pose of {S} at s_c, in {B}.
    pub base_from_contact: Pose,
}

impl Constrained {
    /// `length` L (m) held at `s_c` (m, in [0, L]) since the whole segment's bend was `bend_at_contact` (rad),
    /// now commanded to `configuration`.
    #[must_use]
    pub fn new(length: f64, s_c: f64, bend_at_contact: f64, configuration: Configuration) -> Self {
        let lower_bend = bend_at_contact * (s_c / length);
        let lower = Arc { length: s_c, configuration: configuration.with_bend(lower_bend) };
        let upper =
            Arc { length: length - s_c, configuration: configuration.with_bend(configuration.bend() - lower_bend) };
        Self { lower, upper, base_from_contact: lower.pose(s_c) }
    }

    /// Pose at arc length `s` (m) of the whole backbone, in {B}.
    #[must_use]
    pub fn pose(&self, s: f64) -> Pose {
        if s <= self.lower.length { self.lower.pose(s) } else { self.above(&self.upper.pose(s - self.lower.length)) }
    }

    /// Pose of the end disk, in {B}.
    #[must_use]
    pub fn tip_pose(&self) -> Pose {
        self.above(&self.upper.pose(self.upper.length))
    }

    /// Tip pose and the constrained Jacobian J̄_xψ (Eqs. 21, 22): ψ̃̇ = ψ̇.
    #[must_use]
    pub fn tip_pose_and_jacobian(&self) -> (Pose, Jacobian) {
        let (pose, local) = self.upper.pose_and_jacobian(self.upper.length);
        let rotation = &self.base_from_contact.rotation;
        let jacobian = Jacobian {
            theta_l: local.theta_l.rotated(rotation),
            delta_per_bend: local.delta_per_bend.rotated(rotation),
            bend: local.bend,
        };
        (self.above(&pose), jacobian)
    }

    /// Twist t_c of the end disk (Eq. 21): m/s and rad/s.
    #[must_use]
    pub fn tip_twist(&self, rate: Rate) -> Twist {
        self.tip_pose_and_jacobian().1.twist(rate)
    }

    /// The constrained centrode c_c (Eq. 23), m, in {B}. `None` when the rate is zero.
    #[must_use]
    pub fn centrode(&self, rate: Rate) -> Option<Vec3> {
        let (pose, jacobian) = self.tip_pose_and_jacobian();
        jacobian.centrode(&pose.position, rate)
    }

    fn above(&self, contact_from_frame: &Pose) -> Pose {
        let Pose { position, rotation } = &self.base_from_contact;
        Pose {
            position: position + rotation * contact_from_frame.position,
            rotation: rotation * contact_from_frame.rotation,
        }
    }
}
