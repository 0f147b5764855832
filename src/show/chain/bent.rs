//! A backbone in space, from its poses at equal steps: what stands on it is looked up at any arc length.

use crate::scene::{Pose, arc};
use crate::show::scene_pose;
use centrode_core::model::{self, Arc, Configuration};
use glam::Vec3;

/// Steps of a segment: enough that no corner shows.
pub const PARTS: usize = 24;

/// Poses along each segment, from its base to its end disk.
pub struct Bent {
    segments: Vec<Vec<Pose>>,
}

impl Bent {
    /// From poses in {B}.
    pub fn new(segments: &[Vec<model::Pose>]) -> Self {
        Self { segments: segments.iter().map(|poses| poses.iter().map(scene_pose).collect()).collect() }
    }

    /// Of a chain that nothing touches.
    pub fn free(lengths: &[f64], told: &[Configuration]) -> Self {
        let mut base = Pose::IDENTITY;
        let segments = lengths.iter().zip(told).map(|(&length, &configuration)| {
            let bent = Arc { length, configuration };
            let frames = arc::frames(base, length as f32, PARTS, |s| scene_pose(&bent.pose(f64::from(s))));
            base = frames[PARTS];
            frames
        });
        Self { segments: segments.collect() }
    }

    /// Poses along a segment.
    pub fn frames(&self, segment: usize) -> &[Pose] {
        &self.segments[segment]
    }

    /// The pose at a share of a segment's length, 0 at its base.
    pub fn pose(&self, segment: usize, share: f32) -> Pose {
        let frames = &self.segments[segment];
        let steps = frames.len() - 1;
        let at = (share * steps as f32).clamp(0.0, steps as f32);
        let step = (at as usize).min(steps - 1);
        between(&frames[step], &frames[step + 1], at - step as f32)
    }
}

/// Between two frames of a curve whose tangent is z: the cubic through both, and the turn in proportion.
fn between(from: &Pose, to: &Pose, share: f32) -> Pose {
    let chord = from.position.distance(to.position);
    let [start, end] = [from, to].map(|pose| pose.rotation * Vec3::Z * chord);
    let (t, rest) = (share, 1.0 - share);
    let position = from.position * (rest * rest * (1.0 + 2.0 * t))
        + to.position * (t * t * (1.0 + 2.0 * rest))
        + start * (t * rest * rest)
        - end * (t * t * rest);
    Pose::new(position, from.rotation.slerp(to.rotation, share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_between_steps_are_those_of_the_arc() {
        let arc = Arc { length: 0.03, configuration: Configuration::new(1.4, 0.6) };
        let bent = Bent::free(&[0.03, 0.02], &[arc.configuration, Configuration::new(0.3, 0.0)]);
        for k in 0..=100 {
            let share = k as f32 / 100.0;
            let (pose, exact) = (bent.pose(0, share), scene_pose(&arc.pose(0.03 * f64::from(share))));
            assert!(pose.position.distance(exact.position) < 1e-7, "{share}: {pose:?} {exact:?}");
            // Half the angle between both, as a sine: its cosine would be lost in rounding.
            assert!((pose.rotation.inverse() * exact.rotation).xyz().length() < 1e-4);
        }
        assert!(bent.pose(1, 0.0).position.distance(bent.pose(0, 1.0).position) < 1e-9);
    }
}
