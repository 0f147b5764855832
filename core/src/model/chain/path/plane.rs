//! Planes that stand from the start, or come to stand where the backbone is.

use crate::model::{Pose, Vec3};
use libm::sincos;

/// A frictionless plane against a point of the backbone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// The segment, from 0.
    pub segment: usize,
    /// Arc length of the point from that segment's base, m.
    pub at: f64,
    /// Bending-plane angle δ of the segment when the plane comes to stand, rad: where its tilt is counted from.
    pub delta: f64,
    /// Where it stands.
    pub stands: Stands,
}

/// Where a plane stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stands {
    /// With this unit normal n in {B}, away from the robot's side, and offset n·p (m), from the first instant on.
    Always {
        /// n in {B}.
        normal: Vec3,
        /// n·p, m.
        offset: f64,
    },
    /// From a time on, where the point is then. The tangent there lies in the plane, and n points to where the point moves.
    From {
        /// s.
        time: f64,
        /// Angle (rad) by which n is turned about the tangent from the bending plane.
        tilt: f64,
    },
    /// From a time (s) on, the backbone is clamped there: position and slope stay, and so does all below, while what is told to the
    /// segments below stands still. What is told them after that is not looked at.
    Clamped {
        /// s.
        time: f64,
    },
}

impl Plane {
    /// The time from which it stands, s; none for one that always does.
    pub(super) fn time(&self) -> Option<f64> {
        match self.stands {
            Stands::Always { .. } => None,
            Stands::From { time, .. } | Stands::Clamped { time } => Some(time),
        }
    }

    pub(super) fn is_clamp(&self) -> bool {
        matches!(self.stands, Stands::Clamped { .. })
    }

    /// As it stands in a frame that rests on its segment at an arc length (m), `below` segments up; none where it holds what is below.
    pub(super) fn above(&self, frame: &Pose, below: usize, at: f64) -> Option<Self> {
        let segment = self.segment.checked_sub(below)?;
        let place = if segment == 0 { self.at - at } else { self.at };
        let stands = match self.stands {
            Stands::Always { normal, offset } => {
                let offset = offset - normal.dot(&frame.position);
                Stands::Always { normal: frame.rotation.transpose() * normal, offset }
            }
            moving => moving,
        };
        (place > 0.0).then_some(Self { segment, at: place, stands, ..*self })
    }

    /// Normal and offset of a plane that comes to stand where its point is, which moves with a velocity: none for another.
    pub(super) fn placed(&self, point: &Pose, velocity: &Vec3) -> Option<(Vec3, f64)> {
        let Stands::From { tilt, .. } = self.stands else { return None };
        // The bend is toward (cos δ, −sin δ, 0) of the cross section.
        let (sin, cos) = sincos(tilt - self.delta);
        let normal = point.rotation * Vec3::new(cos, sin, 0.0);
        let normal = if normal.dot(velocity) < 0.0 { -normal } else { normal };
        Some((normal, normal.dot(&point.position)))
    }
}
