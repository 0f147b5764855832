//! A touching shape in space, as the plant has it.

use super::branch::{Branch, Tip};
use super::ritz::Basis;
use super::{Meeting, Planar, Touching, Unknowns, plane};
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

    /// Size of the contact force (N) of a segment with a bending stiffness (N·m²); none where the contact does not hold.
    #[must_use]
    pub fn force(&self, stiffness: f64) -> Option<f64> {
        let touching = self.touching()?;
        Some(self.branch.meeting().side * touching.force() * stiffness / (self.length * self.length))
    }

    /// Pose at arc length `s` (m) of the backbone, in {B}.
    #[must_use]
    pub fn pose(&self, s: f64) -> Pose {
        let Some(touching) = self.touching() else {
            return Arc { length: self.length, configuration: self.configuration }.pose(s);
        };
        let (at, slope) = touching.point(self.branch.basis(), s / self.length);
        Pose { position: point(self.length, self.configuration, at), rotation: rotation(self.configuration, slope) }
    }

    /// Pose of the end disk, in {B}.
    #[must_use]
    pub fn tip_pose(&self) -> Pose {
        let bend = self.configuration.bend();
        let position = point(self.length, self.configuration, self.branch.tip(bend).position);
        Pose { position, rotation: rotation(self.configuration, bend) }
    }

    /// Pose and Jacobian of the end disk, in {B}. A change of δ turns the part above the contact alone, as in Eq. 22.
    #[must_use]
    pub fn tip_pose_and_jacobian(&self) -> (Pose, Jacobian) {
        let bend = self.configuration.bend();
        in_space(self.length, self.configuration, self.branch.tip(bend), self.branch.above(bend))
    }

    /// The constrained centrode c_c (Eq. 23 with this shape), m, in {B}. `None` when the rate is zero.
    #[must_use]
    pub fn centrode(&self, rate: Rate) -> Option<Vec3> {
        let (pose, jacobian) = self.tip_pose_and_jacobian();
        jacobian.centrode(&pose.position, rate)
    }
}

/// A plane against a segment, as Eq. 24 tries one place after the other.
#[derive(Debug, Clone)]
pub struct Trial {
    basis: Basis,
    /// Length of the segment, m.
    length: f64,
    configuration: Configuration,
    /// Bend φ_c at first contact, rad.
    met: f64,
    /// The last shape found: the next is near.
    last: Option<Unknowns>,
}

impl Trial {
    /// A segment `length` m long in a configuration, with a contact that began at the bend `met` (rad).
    #[must_use]
    pub fn new(length: f64, configuration: Configuration, met: f64) -> Self {
        Self { basis: Basis::new(), length, configuration, met, last: None }
    }

    /// The constrained centrode c_c (m, in {B}) with the plane at arc length `s` (m, in (0, L)): Eq. 23 with the shape of a
    /// beam that only touches. `None` when the rate is zero, or where there is no such shape.
    #[must_use]
    pub fn centrode(&mut self, s: f64, rate: Rate) -> Option<Vec3> {
        let Self { basis, length, configuration, met, last } = self;
        let (bend, place) = (configuration.bend(), s / *length);
        let meeting = Meeting { place, bend: *met, side: if bend < *met { -1.0 } else { 1.0 } };
        let touching = if bend == *met {
            plane::at_first_contact(basis, &meeting)
        } else {
            let near = last.and_then(|near| plane::solve(basis, &meeting, bend, Some(&Unknowns { place, ..near })));
            near.or_else(|| plane::solve(basis, &meeting, bend, None)).filter(|found| found.stable)?.touching
        };
        *last = Some(touching.at);
        let (position, by_bend) = touching.tip(basis);
        let above = (touching.upper_bend(), place);
        let (pose, jacobian) = in_space(*length, *configuration, Tip { position, by_bend }, above);
        jacobian.centrode(&pose.position, rate)
    }
}

/// Pose and Jacobian of the end disk from what they are in the bending plane, and from bend (rad) and beginning (in units of L) of
/// the part above the contact.
fn in_space(
    length: f64,
    configuration: Configuration,
    Tip { position, by_bend }: Tip,
    (upper_bend, place): (f64, f64),
) -> (Pose, Jacobian) {
    let bend = configuration.bend();
    let upper = Arc { length: length * (1.0 - place), configuration: configuration.with_bend(upper_bend) };
    let (sd, cd) = configuration.sin_cos_delta();
    let local = upper.jacobian(upper.length);
    let jacobian = Jacobian {
        theta_l: Twist { linear: -point(length, configuration, by_bend), angular: Vec3::new(-sd, -cd, 0.0) },
        delta_per_bend: local.delta_per_bend.rotated(&rotation(configuration, bend - upper_bend)),
        bend: local.bend,
    };
    (Pose { position: point(length, configuration, position), rotation: rotation(configuration, bend) }, jacobian)
}

/// A point of the bending plane (in units of L) in {B}, m.
fn point(length: f64, configuration: Configuration, at: Planar) -> Vec3 {
    let (sd, cd) = configuration.sin_cos_delta();
    Vec3::new(cd * at.x, -sd * at.x, at.y) * length
}

/// The frame of a slope (rad): that at the end of an arc of this bend.
fn rotation(configuration: Configuration, slope: f64) -> Mat3 {
    Arc { length: 1.0, configuration: configuration.with_bend(slope) }.pose(1.0).rotation
}
