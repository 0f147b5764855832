//! A touching shape in space, as the plant has it.

use super::branch::{Branch, Tip};
use super::{Planar, Touching};
use crate::model::{Arc, Configuration, Jacobian, Mat3, Pose, Rate, Twist, Vec3};
use std::sync::Arc as Shared;

/// A segment that something touches, in a commanded configuration at which the contact holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Touched {
    /// Length L, m.
    length: f64,
    branch: Shared<Branch>,
    configuration: Configuration,
    detail: Option<Box<Touching>>,
}

impl Touched {
    /// The shape on a branch, of a segment `length` m long.
    #[must_use]
    pub fn new(length: f64, branch: Shared<Branch>, configuration: Configuration) -> Self {
        Self { length, branch, configuration, detail: None }
    }

    /// The same with its shape at hand, for whoever asks for several poses.
    #[must_use]
    pub fn detailed(self) -> Self {
        let detail = self.touching().map(Box::new);
        Self { detail, ..self }
    }

    /// The branch that the shape lies on.
    #[must_use]
    pub fn branch(&self) -> &Branch {
        &self.branch
    }

    /// The shape in the bending plane, in units of L; none where the contact does not hold.
    #[must_use]
    pub fn touching(&self) -> Option<Touching> {
        self.detail.as_deref().copied().or_else(|| self.branch.shape(self.configuration.bend()))
    }

    /// Pose at arc length `s` (m) of the backbone, in {B}.
    #[must_use]
    pub fn pose(&self, s: f64) -> Pose {
        let Some(touching) = self.touching() else {
            return Arc { length: self.length, configuration: self.configuration }.pose(s);
        };
        let (point, slope) = touching.point(self.branch.basis(), s / self.length);
        Pose { position: self.in_space(point), rotation: self.rotation(slope) }
    }

    /// Pose of the end disk, in {B}.
    #[must_use]
    pub fn tip_pose(&self) -> Pose {
        let bend = self.configuration.bend();
        Pose { position: self.in_space(self.branch.tip(bend).position), rotation: self.rotation(bend) }
    }

    /// Pose and Jacobian of the end disk, in {B}. A change of δ turns the part above the contact alone, as in Eq. 22.
    #[must_use]
    pub fn tip_pose_and_jacobian(&self) -> (Pose, Jacobian) {
        let bend = self.configuration.bend();
        let Tip { position, by_bend } = self.branch.tip(bend);
        let (upper_bend, place) = self.branch.above(bend);
        let upper =
            Arc { length: self.length * (1.0 - place), configuration: self.configuration.with_bend(upper_bend) };
        let (sd, cd) = self.configuration.sin_cos_delta();
        let local = upper.jacobian(upper.length);
        let jacobian = Jacobian {
            theta_l: Twist { linear: -self.in_space(by_bend), angular: Vec3::new(-sd, -cd, 0.0) },
            delta_per_bend: local.delta_per_bend.rotated(&self.rotation(bend - upper_bend)),
            bend: local.bend,
        };
        (Pose { position: self.in_space(position), rotation: self.rotation(bend) }, jacobian)
    }

    /// The constrained centrode c_c (Eq. 23 with this shape), m, in {B}. `None` when the rate is zero.
    #[must_use]
    pub fn centrode(&self, rate: Rate) -> Option<Vec3> {
        let (pose, jacobian) = self.tip_pose_and_jacobian();
        jacobian.centrode(&pose.position, rate)
    }

    /// A point of the bending plane (in units of L) in {B}, m.
    fn in_space(&self, point: Planar) -> Vec3 {
        let (sd, cd) = self.configuration.sin_cos_delta();
        Vec3::new(cd * point.x, -sd * point.x, point.y) * self.length
    }

    /// The frame of a slope (rad): that at the end of an arc of this bend.
    fn rotation(&self, slope: f64) -> Mat3 {
        Arc { length: 1.0, configuration: self.configuration.with_bend(slope) }.pose(1.0).rotation
    }
}
