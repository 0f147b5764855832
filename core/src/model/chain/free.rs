//! A chain that nothing touches: arcs in series.

use super::{Bends, bends};
use crate::model::{Arc, Configuration, Mat3, Pose, Twist, Vec3};

/// The end disk of a segment: where it is, and how it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Disk {
    /// Pose in {B}.
    pub pose: Pose,
    /// Twist in {B} by the integrals of curvature U of every segment, from the base: m/rad and 1. Linear is the velocity of the
    /// disk's own centre. Zero for what lies above, unless a contact hands the motion down.
    pub by_bends: Vec<[Twist; 2]>,
}

impl Disk {
    /// Twist by θL and δ of every segment, from the base: m/rad and 1.
    #[must_use]
    pub fn by_configuration(&self, configurations: &[Configuration]) -> Vec<[Twist; 2]> {
        self.by_bends.iter().zip(configurations).map(|(by, at)| by_theta_l_and_delta(*at, *by)).collect()
    }
}

/// From derivatives by U = φ (sin δ, cos δ) to those by θL and δ.
#[must_use]
pub fn by_theta_l_and_delta<T>(at: Configuration, by: [T; 2]) -> [T; 2]
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let ((sin, cos), bend) = (at.sin_cos_delta(), at.bend());
    [by[0] * -sin + by[1] * -cos, by[0] * (bend * cos) + by[1] * (-bend * sin)]
}

/// The end disk of an arc in the frame of its base, with its twist by U.
pub(super) fn end(length: f64, configuration: Configuration) -> (Pose, [Twist; 2]) {
    let (pose, jacobian) = Arc { length, configuration }.pose_and_jacobian(length);
    let ((sin, cos), along, across) = (configuration.sin_cos_delta(), jacobian.theta_l, jacobian.delta_per_bend);
    (pose, [along * -sin + across * cos, along * -cos + across * -sin])
}

/// The end disk of an arc in the frame of its base.
#[must_use]
pub fn pose(length: f64, configuration: Configuration) -> Pose {
    Arc { length, configuration }.pose(length)
}

/// Where a frame is, and how it moves by the U of every segment.
#[derive(Debug, Clone)]
pub(super) struct Moving {
    pub pose: Pose,
    pub by_bends: Vec<[Twist; 2]>,
}

impl Moving {
    /// The base.
    pub fn base(segments: usize) -> Self {
        let pose = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
        Self { pose, by_bends: vec![[NONE; 2]; segments] }
    }

    /// The end of an arc that starts here. `moved` is the derivative of the arc's own U by that of every segment.
    pub fn then(&self, length: f64, bends: &Bends, moved: impl Fn(usize, usize) -> Bends) -> Self {
        let (pose, own) = end(length, super::configuration(bends));
        self.carry(&pose, own, moved)
    }

    fn carry(&self, end: &Pose, own: [Twist; 2], moved: impl Fn(usize, usize) -> Bends) -> Self {
        let Pose { position, rotation } = self.pose;
        let arm = rotation * end.position;
        let own = own.map(|twist| twist.rotated(&rotation));
        let by = |segment: usize, axis: usize, base: Twist| {
            let carried = Twist { linear: base.linear + base.angular.cross(&arm), angular: base.angular };
            let moved = moved(segment, axis);
            carried + own[0] * moved.x + own[1] * moved.y
        };
        let by_bends = self.by_bends.iter().enumerate().map(|(j, [x, y])| [by(j, 0, *x), by(j, 1, *y)]).collect();
        Self { pose: Pose { position: position + arm, rotation: rotation * end.rotation }, by_bends }
    }

    /// The end of a whole free segment that starts here.
    pub fn then_segment(&self, segment: usize, length: f64, configuration: Configuration) -> Self {
        let (pose, own) = end(length, configuration);
        self.carry(&pose, own, |by, axis| if by == segment { unit(axis) } else { Bends::zeros() })
    }
}

impl From<Moving> for Disk {
    fn from(moving: Moving) -> Self {
        Self { pose: moving.pose, by_bends: moving.by_bends }
    }
}

pub(super) const NONE: Twist = Twist { linear: Vec3::new(0.0, 0.0, 0.0), angular: Vec3::new(0.0, 0.0, 0.0) };

pub(super) fn unit(axis: usize) -> Bends {
    Bends::new(1.0 - axis as f64, axis as f64)
}

/// Every end disk of a chain that nothing touches, from the base: one length (m) and one configuration for each segment.
#[must_use]
pub fn free(lengths: &[f64], configurations: &[Configuration]) -> Vec<Disk> {
    let mut at = Moving::base(lengths.len().min(configurations.len()));
    let segments = lengths.iter().zip(configurations).enumerate();
    segments
        .map(|(segment, (length, configuration))| {
            at = at.then_segment(segment, *length, *configuration);
            at.clone().into()
        })
        .collect()
}

/// The end disk of every segment of a chain that nothing touches, in {B}; one U for each rod.
#[must_use]
pub fn poses(rods: &[super::Rod], bends: &[Bends]) -> Vec<Pose> {
    let mut at = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
    let segments = rods.iter().zip(bends);
    segments
        .map(|(rod, bends)| {
            let end = pose(rod.length, super::configuration(bends));
            at = Pose { position: at.position + at.rotation * end.position, rotation: at.rotation * end.rotation };
            at
        })
        .collect()
}

/// Where a point of a free chain is, in {B}: on a segment (from 0) at an arc length from that segment's base (m).
#[must_use]
pub fn point(lengths: &[f64], configurations: &[Configuration], segment: usize, at: f64) -> Pose {
    let mut base = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
    for (place, (&length, &configuration)) in lengths.iter().zip(configurations).enumerate().take(segment + 1) {
        let arc = Arc { length, configuration };
        let end = arc.pose(if place == segment { at } else { length });
        base = Pose { position: base.position + base.rotation * end.position, rotation: base.rotation * end.rotation };
    }
    base
}

/// Moments that hold a free chain, N·m: ∂E/∂U = EI U/L of each segment.
#[must_use]
pub fn moments(rods: &[super::Rod], configurations: &[Configuration]) -> Vec<Bends> {
    rods.iter().zip(configurations).map(|(rod, at)| bends(*at) * (rod.bending_stiffness / rod.length)).collect()
}
