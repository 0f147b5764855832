//! A chain that moves against planes: what touches when, and every shape in between.
//!
//! Between events (a plane is met, comes to stand, or is left; the chain buckles) shapes are smooth functions of time. They are solved
//! at Chebyshev points of stretches of time and interpolated in between: the tip to 1e-10 of the length, forces to 1e-7 EI/L².

mod clamp;
mod fit;
mod follow;
mod plane;

use super::profile::Profile;
use super::{Bends, Rod, free};
use crate::model::{Pose, Twist, Vec3};
use clamp::Clamp;
use fit::Fit;

pub use plane::{Plane, Stands};

/// What the joints of a chain are told, as a function of time (s).
pub trait Course {
    /// Integrals of curvature of every segment, rad, from the base.
    fn bends(&self, time: f64) -> Vec<Bends>;
}

impl<F: Fn(f64) -> Vec<Bends>> Course for F {
    fn bends(&self, time: f64) -> Vec<Bends> {
        self(time)
    }
}

/// What happens to a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// A contact, by its place in the list, begins to press.
    Met(usize),
    /// It is left.
    Opened(usize),
    /// The shape is stable no more. The path ends there: whether the chain snaps, and to where, is not followed.
    Buckled,
    /// No equilibrium near the shape of before was found. The path ends there.
    Lost,
}

/// Something that happens, and when (s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Happened {
    /// When, s.
    pub time: f64,
    /// What.
    pub what: What,
}

/// A chain at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    /// The end disk of every segment, from the base, in {B}.
    pub disks: Vec<Pose>,
    /// The contacts that press, by their places in the list, rising.
    pub active: Vec<usize>,
    /// Force F of every contact, N: 0 where it does not press; that on the robot is −F n. NaN of a clamp that holds, whose force
    /// and couple are not computed.
    pub forces: Vec<f64>,
    /// Stability margin, as of [`Settled`](super::Settled); 1 without a force.
    pub margin: f64,
}

/// A stretch of time in which the same contacts press.
#[derive(Debug, Clone)]
struct Stretch {
    from: f64,
    to: f64,
    active: Vec<usize>,
    fit: Fit,
}

/// A chain from the first to the last instant, or to where it buckles.
#[derive(Debug, Clone)]
pub struct Path {
    rods: Vec<Rod>,
    /// The chain above a clamp, from when it holds.
    clamp: Option<Box<Clamp>>,
    stretches: Vec<Stretch>,
    happened: Vec<Happened>,
    /// Normal and offset (m) of every plane that came to stand.
    planes: Vec<Option<(Vec3, f64)>>,
    end: f64,
}

impl Path {
    /// Follows a chain through its course. `knots` (s, rising) are the instants between which the course is smooth, the first and the last
    /// of all among them.
    ///
    /// # Errors
    /// When the chain has no stable shape as it begins.
    pub fn new(rods: &[Rod], course: &dyn Course, knots: &[f64], planes: &[Plane]) -> Result<Self, super::Unsettled> {
        follow::follow(rods, course, knots, planes)
    }

    /// Events in order of time.
    #[must_use]
    pub fn happened(&self) -> &[Happened] {
        &self.happened
    }

    /// How far it was followed, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Normal, in {B}, and offset (m) of a plane by its place in the list; none that has not come to stand.
    #[must_use]
    pub fn plane(&self, place: usize) -> Option<(Vec3, f64)> {
        self.planes.get(place).copied().flatten()
    }

    fn stretch(&self, time: f64) -> Option<&Stretch> {
        let place = self.stretches.partition_point(|stretch| stretch.to < time);
        self.stretches.get(place).or(self.stretches.last())
    }

    /// The chain at a time (s) for the bends of the course then. After the end it stands as at the end.
    #[must_use]
    pub fn at(&self, time: f64, bends: &[Bends]) -> Instant {
        match &self.clamp {
            Some(clamp) if time > clamp.time => clamp.at(time, bends),
            _ => self.unclamped(time, bends),
        }
    }

    fn unclamped(&self, time: f64, bends: &[Bends]) -> Instant {
        let free = free::poses(&self.rods, bends);
        let mut instant =
            Instant { disks: free, active: Vec::new(), forces: vec![0.0; self.planes.len()], margin: 1.0 };
        if let Some(stretch) = self.stretch(time) {
            instant.active.clone_from(&stretch.active);
            stretch.fit.bend(time.clamp(stretch.from, stretch.to), &stretch.active, &mut instant);
        }
        instant
    }

    /// Poses along the backbone at a time (s), in {B}: `parts` steps in each segment, from its base on.
    #[must_use]
    pub fn backbone(&self, time: f64, bends: &[Bends], parts: usize) -> Vec<Vec<Pose>> {
        match &self.clamp {
            Some(clamp) if time > clamp.time => clamp.backbone(time, bends, parts),
            _ => self.profile(time, bends).backbone(&self.rods, parts),
        }
    }

    /// The pose of a point of the backbone at a time (s), in {B}: on a segment (from 0), at an arc length (m) from its base.
    #[must_use]
    pub fn pose(&self, time: f64, bends: &[Bends], segment: usize, at: f64) -> Pose {
        match &self.clamp {
            Some(clamp) if time > clamp.time => clamp.pose(time, bends, segment, at),
            _ => self.profile(time, bends).pose(&self.rods, segment, at),
        }
    }

    fn profile(&self, time: f64, bends: &[Bends]) -> Profile {
        let bent = self.stretch(time).and_then(|stretch| stretch.fit.profile(&self.rods, time, bends));
        bent.unwrap_or_else(|| Profile::free(&self.rods, bends))
    }
}

/// The motion of a frame in another that moves, both in {B} and per second: velocity of its own centre and ω, in the other's axes.
#[must_use]
pub fn relative_twist(base: &Pose, base_twist: &Twist, tip: &Pose, tip_twist: &Twist) -> Twist {
    let arm = tip.position - base.position;
    let linear = tip_twist.linear - base_twist.linear - base_twist.angular.cross(&arm);
    let into = base.rotation.transpose();
    Twist { linear: into * linear, angular: into * (tip_twist.angular - base_twist.angular) }
}

#[cfg(test)]
mod tests;
