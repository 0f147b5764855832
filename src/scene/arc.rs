//! Sampling a bent backbone into frames and polylines.

use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3};

use super::Pose;

/// The frame at arc length `s` of a circular arc that starts along z.
///
/// `length` in m is where the bend reaches `bend` rad; `delta` in rad turns the bending plane as in the paper's Eq. 3
/// and Eq. 4: a positive bend goes toward (cos δ, −sin δ, 0), and R = Rz(−δ) Ry(φ_s) Rz(δ).
pub fn circular(length: f32, bend: f32, delta: f32, s: f32) -> Pose {
    let phi = if length > 0.0 { bend * s / length } else { 0.0 };
    // (1 − cos φ)/φ and sin φ/φ by the half angle, so that straight is no special case.
    let half = 0.5 * phi;
    let chord = s * sinc(half);
    let (sin_delta, cos_delta) = delta.sin_cos();
    let aside = chord * half.sin();
    let turn = Quat::from_rotation_z(-delta);
    Pose::new(
        Vec3::new(aside * cos_delta, -aside * sin_delta, chord * half.cos()),
        turn * Quat::from_rotation_y(phi) * turn.conjugate(),
    )
}

fn sinc(x: f32) -> f32 {
    if x.abs() < 1e-3 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}

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
    use std::f32::consts::{FRAC_PI_2, PI};

    const L: f32 = 0.03;

    #[test]
    fn straight_goes_up() {
        let tip = circular(L, 0.0, 0.7, L);
        assert!((tip.position - Vec3::new(0.0, 0.0, L)).length() < 1e-9);
        assert!(tip.rotation.angle_between(Quat::IDENTITY) < 1e-3);
    }

    #[test]
    fn quarter_circle_ends_where_it_should() {
        let radius = L / FRAC_PI_2;
        let tip = circular(L, FRAC_PI_2, 0.0, L);
        assert!((tip.position - Vec3::new(radius, 0.0, radius)).length() < 1e-7);
        assert!((tip.rotation * Vec3::Z - Vec3::X).length() < 1e-6);
        // δ turns it toward (cos δ, −sin δ).
        let tip = circular(L, FRAC_PI_2, FRAC_PI_2, L);
        assert!((tip.position - Vec3::new(0.0, -radius, radius)).length() < 1e-7);
    }

    #[test]
    fn no_jump_at_straight_and_unit_speed() {
        for bend in [0.0, 1e-6, 1.9e-3, 2.1e-3, 0.5, -1.3, PI] {
            let path: Vec<_> = frames(Pose::IDENTITY, L, 400, |s| circular(L, bend, 0.4, s));
            let length: f32 = path.windows(2).map(|w| (w[1].position - w[0].position).length()).sum();
            assert!((length - L).abs() < 1e-6, "{bend}: {length}");
        }
    }

    #[test]
    fn offset_backbones_change_length_by_the_joint() {
        // q = r cos(δ + iβ)(θL − θ0) = −r cos(δ + iβ) φ (Eq. 2).
        let (r, delta, bend) = (0.003, 0.3_f32, 1.2);
        let path = frames(Pose::IDENTITY, L, 2000, |s| circular(L, bend, delta, s));
        for i in 0..3 {
            let line = offset(&path, pitch_point(r, i, 3));
            let length: f32 = line.windows(2).map(|w| (w[1] - w[0]).length()).sum();
            let q = -r * (delta + TAU * i as f32 / 3.0).cos() * bend;
            assert!((length - (L + q)).abs() < 2e-5, "{i}: {length} {q}");
        }
    }

    #[test]
    fn extending_goes_straight_on() {
        let path = frames(Pose::IDENTITY, L, 4, |s| circular(L, FRAC_PI_2, 0.0, s));
        let longer = extended(&path, 0.001, 0.002);
        assert_eq!(longer.len(), path.len() + 2);
        assert!((longer[0].position - Vec3::Z * -0.001).length() < 1e-9);
        let on = longer[6].position - longer[5].position;
        assert!((on - Vec3::X * 0.002).length() < 1e-8);
        assert!(extended(&[], 1.0, 1.0).is_empty());
    }

    #[test]
    fn a_second_arc_goes_on_from_the_first() {
        let first = frames(Pose::IDENTITY, 0.5 * L, 8, |s| circular(L, 1.0, 0.2, s));
        let start = *first.last().unwrap();
        let second = frames(start, 0.5 * L, 8, |s| circular(L, 1.0, 0.2, s));
        let whole = circular(L, 1.0, 0.2, L);
        assert!((second.last().unwrap().position - whole.position).length() < 1e-7);
    }
}
