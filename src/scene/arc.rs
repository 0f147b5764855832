//! Sampling a bent backbone into frames and polylines.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::Pose;

/// Frames at `count + 1` equally spaced arc lengths from 0 to `length`, each put behind `start`.
///
/// `shape` gives the frame at an arc length, as seen from `start`. At least one step is taken.
pub fn frames(start: Pose, length: f32, count: usize, shape: impl Fn(f32) -> Pose) -> Vec<Pose> {
    let count = count.max(1);
    (0..=count).map(|i| start.then(&shape(length * i as f32 / count as f32))).collect()
}

/// The frames with one more at each end, `before` and `after` m straight on along z: so that a backbone shows on the
/// far side of its end disks.
pub fn extended(frames: &[Pose], before: f32, after: f32) -> Vec<Pose> {
    let on = |f: &Pose, by: f32| Pose::new(f.point(Vec3::Z * by), f.rotation);
    let first = frames.first().map(|f| on(f, -before));
    let last = frames.last().map(|f| on(f, after));
    first.into_iter().chain(frames.iter().copied()).chain(last).collect()
}

/// The line that a fixed point of the moving frame's x–y plane draws.
pub fn offset(frames: &[Pose], at: Vec2) -> Vec<Vec3> {
    frames.iter().map(|f| f.point(at.extend(0.0))).collect()
}

/// Where backbone `index` of `count` meets a disk: on the pitch circle, the first on the x axis.
pub fn pitch_point(pitch_radius: f32, index: usize, count: usize) -> Vec2 {
    Vec2::from_angle(TAU * index as f32 / count.max(1) as f32) * pitch_radius
}

/// A closed circle of `count` chords in the x–y plane of a frame.
pub fn circle(pose: Pose, radius: f32, count: usize) -> Vec<Vec3> {
    let count = count.max(3);
    (0..=count)
        .map(|i| {
            let at = Vec2::from_angle(TAU * (i % count) as f32 / count as f32) * radius;
            pose.point(at.extend(0.0))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;
    use std::f32::consts::FRAC_PI_2;

    const L: f32 = 0.03;

    /// A circle's arc in the x–z plane that has turned by `bend` where it is `L` long. Not for a bend of 0.
    fn bent(bend: f32, s: f32) -> Pose {
        let (turned, radius) = (bend * s / L, L / bend);
        let position = radius * Vec3::new(1.0 - turned.cos(), 0.0, turned.sin());
        Pose::new(position, Quat::from_rotation_y(turned))
    }

    fn length(line: &[Vec3]) -> f32 {
        line.windows(2).map(|w| w[0].distance(w[1])).sum()
    }

    #[test]
    fn frames_lie_behind_their_start() {
        let whole = frames(Pose::IDENTITY, L, 16, |s| bent(1.0, s));
        let second = frames(whole[8], 0.5 * L, 8, |s| bent(1.0, s));
        assert_eq!((whole.len(), second.len()), (17, 9));
        assert!((second[8].position - whole[16].position).length() < 1e-7);
        assert!(second[8].rotation.angle_between(whole[16].rotation) < 1e-3);
        assert_eq!(frames(Pose::IDENTITY, L, 0, |s| bent(1.0, s)).len(), 2);
    }

    #[test]
    fn offset_backbones_change_length_by_the_joint() {
        // q = r cos(iβ)(θL − θ0) = −r cos(iβ) φ (Eq. 2).
        let (r, bend) = (0.003, 1.2);
        let path = frames(Pose::IDENTITY, L, 2000, |s| bent(bend, s));
        for i in 0..3 {
            let line = offset(&path, pitch_point(r, i, 3));
            let q = -r * (TAU * i as f32 / 3.0).cos() * bend;
            assert!((length(&line) - (L + q)).abs() < 2e-5, "{i}: {q}");
        }
    }

    #[test]
    fn extending_goes_straight_on() {
        let path = frames(Pose::IDENTITY, L, 4, |s| bent(FRAC_PI_2, s));
        let longer = extended(&path, 0.001, 0.002);
        assert_eq!(longer.len(), path.len() + 2);
        assert!((longer[0].position - Vec3::Z * -0.001).length() < 1e-9);
        let on = longer[6].position - longer[5].position;
        assert!((on - Vec3::X * 0.002).length() < 1e-8);
        assert!(extended(&[], 1.0, 1.0).is_empty());
    }

    #[test]
    fn a_circle_is_closed_and_round() {
        let pose = bent(1.0, L);
        let circle = circle(pose, 0.004, 64);
        assert_eq!(circle.first(), circle.last());
        assert!(circle.iter().all(|p| (p.distance(pose.position) - 0.004).abs() < 1e-8));
        assert!((length(&circle) - TAU * 0.004).abs() < 2e-5);
    }
}
