//! What must hold for every configuration.

use crate::support::{about_z, arc, assert_near, position, rotation, segment};
use centrode_core::model::joints::{configuration_from_joints, joint_jacobian_per_bend, joints};
use centrode_core::model::{Assumption, Configuration, Constrained, Mat3, Rate, Vec3, Wrench, locate};
use num_dual::{Dual64, DualNum};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const LENGTH: f64 = 0.03;
const PITCH: f64 = 0.003;

/// Bends of every size and sign, straight included.
fn bend() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -3.0..3.0f64,
        2 => (-14.0..0.0f64, any::<bool>()).prop_map(|(e, sign)| 10f64.powf(e) * if sign { 1.0 } else { -1.0 }),
        1 => Just(0.0),
    ]
}

fn delta() -> impl Strategy<Value = f64> {
    -PI..PI
}

fn configuration() -> impl Strategy<Value = Configuration> {
    (bend(), delta()).prop_map(|(bend, delta)| Configuration::new(bend, delta))
}

fn rate() -> impl Strategy<Value = Rate> {
    let one = || prop_oneof![3 => -2.0..2.0f64, 1 => Just(0.0)];
    (one(), one()).prop_map(|(theta_l, delta)| Rate { theta_l, delta })
}

/// Numbers that are all finite.
fn finite(values: &[f64]) -> bool {
    values.iter().all(|x| x.is_finite())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn the_orientation_is_a_rotation(configuration in configuration(), share in 0.0..=1.0f64) {
        let r = segment(LENGTH, PITCH).arc(configuration).pose(share * LENGTH).rotation;
        prop_assert!((r * r.transpose() - Mat3::identity()).amax() < 4e-15);
        prop_assert!((r.determinant() - 1.0).abs() < 4e-15);
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_the_pose(theta_l in -1.4..3.0f64, delta in delta(), share in 0.05..=1.0f64) {
        // Dual numbers of the plain closed forms lose digits as they near straight: compare where they do not.
        prop_assume!((theta_l - std::f64::consts::FRAC_PI_2).abs() > 0.05);
        let s = share * LENGTH;
        let rows = arc(LENGTH, theta_l, delta).jacobian(s).to_rows();
        for (col, column) in [0, 1].map(|col| (col, rows.map(|row| row[col]))) {
            let seed = |i: usize, x: f64| if i == col { Dual64::from(x).derivative() } else { Dual64::from(x) };
            let (t, d) = (seed(0, theta_l), seed(1, delta));
            let (p, r) = (position(t, d, s, LENGTH), rotation(t, d, s, LENGTH));
            let value = Mat3::from_fn(|i, j| r[i][j].re);
            let slope = Mat3::from_fn(|i, j| r[i][j].eps);
            let omega = slope * value.transpose();
            let linear = Vec3::new(p[0].eps, p[1].eps, p[2].eps);
            let angular = Vec3::new(omega[(2, 1)], omega[(0, 2)], omega[(1, 0)]);
            assert_near(&Vec3::from_fn(|i, _| column[i]), &linear, 1e-12 * LENGTH, "linear");
            assert_near(&Vec3::from_fn(|i, _| column[i + 3]), &angular, 1e-13, "angular");
        }
    }

    #[test]
    fn the_energy_gradient_is_the_derivative_of_the_energy(configuration in configuration()) {
        // The plain sum of Eq. 10, term by term, in dual numbers.
        let s = segment(LENGTH, PITCH);
        let (bend, delta) = (configuration.bend(), configuration.delta());
        let gradient = s.energy_gradient(&configuration);
        for (col, ours) in [(0, -gradient.theta_l), (1, gradient.delta())] {
            let seed = |i: usize, x: f64| if i == col { Dual64::from(x).derivative() } else { Dual64::from(x) };
            let (b, d) = (seed(0, bend), seed(1, delta));
            let mut sum = Dual64::from(s.ep_ip / (2.0 * LENGTH));
            for i in 0..3 {
                let angle = d + f64::from(i) * TAU / 3.0;
                let length = -b * angle.cos() * PITCH + LENGTH;
                sum += length.recip() * (s.es_is / 2.0);
            }
            let energy = b * b * sum;
            let scale = bend.abs() * (s.ep_ip + 3.0 * s.es_is) / LENGTH;
            prop_assert!((energy.re - s.energy(&configuration)).abs() <= 1e-14 * scale * bend.abs());
            prop_assert!((energy.eps - ours).abs() <= 1e-13 * scale, "{} {}", energy.eps, ours);
        }
    }

    #[test]
    fn mirroring_delta_mirrors_y(configuration in configuration(), share in 0.0..=1.0f64) {
        let mirror = Mat3::from_diagonal(&Vec3::new(1.0, -1.0, 1.0));
        let mirrored = Configuration::new(configuration.bend(), -configuration.delta());
        let (a, b) = (segment(LENGTH, PITCH).arc(configuration), segment(LENGTH, PITCH).arc(mirrored));
        let s = share * LENGTH;
        assert_near(&(mirror * a.pose(s).position), &b.pose(s).position, 1e-16, "position");
        prop_assert!((mirror * a.pose(s).rotation * mirror - b.pose(s).rotation).amax() < 1e-15);
        // An angular velocity is a pseudovector: its mirror image changes sign.
        assert_near(&(-(mirror * a.jacobian(s).theta_l.angular)), &b.jacobian(s).theta_l.angular, 1e-15, "ω");
        let energy = |c: &Configuration| segment(LENGTH, PITCH).energy(c);
        prop_assert!((energy(&configuration) - energy(&mirrored)).abs() <= 1e-15 * energy(&configuration));
    }

    #[test]
    fn turning_the_base_turns_everything(configuration in configuration(), turn in delta(), rate in rate(), share in 0.1..0.9f64) {
        // {B} turned by −α about z: the same segment with δ + α and its frames turned along.
        let turned = Configuration::new(configuration.bend(), configuration.delta() + turn);
        let base = about_z(-turn);
        let (a, b) = (segment(LENGTH, PITCH).arc(configuration), segment(LENGTH, PITCH).arc(turned));
        let (pa, ja) = a.pose_and_jacobian(LENGTH);
        let (pb, jb) = b.pose_and_jacobian(LENGTH);
        assert_near(&(base * pa.position), &pb.position, 1e-15, "position");
        prop_assert!((base * pa.rotation * base.transpose() - pb.rotation).amax() < 2e-15);
        let (ca, cb) = (ja.centrode(&pa.position, rate), jb.centrode(&pb.position, rate));
        prop_assert_eq!(ca.is_some(), cb.is_some());
        if let (Some(ca), Some(cb)) = (ca, cb) {
            assert_near(&(base * ca), &cb, 1e-13 * LENGTH.max(ca.norm()), "centrode");
        }
        let held = |c: Configuration| Constrained::new(LENGTH, share * LENGTH, 0.7 * c.bend(), c);
        assert_near(&(base * held(configuration).tip_pose().position), &held(turned).tip_pose().position, 1e-15, "held");
        assert_near(&(base * held(configuration).tip_twist(rate).linear), &held(turned).tip_twist(rate).linear, 1e-15, "twist");
    }

    #[test]
    fn held_at_the_base_is_free(configuration in configuration(), rate in rate(), exponent in 6..300i32) {
        for s_c in [0.0, 10f64.powi(-exponent)] {
            let held = Constrained::new(LENGTH, s_c, configuration.bend(), configuration);
            let (pose, jacobian) = segment(LENGTH, PITCH).arc(configuration).pose_and_jacobian(LENGTH);
            let near = 2e-15 + 4.0 * s_c;
            assert_near(&held.tip_pose().position, &pose.position, near, "position");
            let twist = jacobian.twist(rate);
            // The part above s_c bends the rest at the same rate, so its shape differs in the first order of s_c.
            assert_near(&held.tip_twist(rate).linear, &twist.linear, near * 10.0, "linear");
            if let (Some(a), Some(b)) = (held.centrode(rate), jacobian.centrode(&pose.position, rate)) {
                assert_near(&a, &b, 100.0 * near * (1.0 + b.norm() / LENGTH), "centrode");
            }
        }
    }

    #[test]
    fn held_at_the_bend_of_contact_the_tip_is_where_the_free_tip_is(configuration in configuration(), share in 0.0..=1.0f64) {
        let held = Constrained::new(LENGTH, share * LENGTH, configuration.bend(), configuration);
        let free = segment(LENGTH, PITCH).arc(configuration).pose(LENGTH);
        assert_near(&held.tip_pose().position, &free.position, 1e-16 * 100.0, "tip");
    }

    #[test]
    fn nothing_is_ever_undefined(configuration in configuration(), rate in rate(), share in 0.0..=1.0f64, c in 0.0..=1.0f64) {
        let segment = segment(LENGTH, PITCH);
        let s = share * LENGTH;
        let (pose, jacobian) = segment.arc(configuration).pose_and_jacobian(s);
        prop_assert!(finite(pose.position.as_slice()) && finite(pose.rotation.as_slice()));
        prop_assert!(finite(jacobian.to_rows().as_flattened()));
        let (tip, tip_jacobian) = segment.arc(configuration).pose_and_jacobian(LENGTH);
        let moves = rate.theta_l != 0.0 || rate.delta != 0.0;
        let centrode = tip_jacobian.centrode(&tip.position, rate);
        prop_assert_eq!(centrode.is_some(), moves);
        prop_assert!(centrode.is_none_or(|c| finite(c.as_slice())));
        let held = Constrained::new(LENGTH, c * LENGTH, configuration.bend(), configuration);
        prop_assert!(finite(held.pose(s).position.as_slice()) && finite(&held.tip_twist(rate).to_array()));
        prop_assert!(held.centrode(rate).is_none_or(|c| finite(c.as_slice())));
        let wrench = Wrench { force: Vec3::new(0.1, -0.2, 0.3), moment: Vec3::new(1e-3, 2e-3, -3e-3) };
        let tau = segment.joint_forces(&configuration, &tip_jacobian, &wrench, 2.0);
        prop_assert!(finite(tau.as_slice()));
        prop_assert!(segment.residual(&configuration, &tau).is_finite());
    }

    #[test]
    fn joint_values_lead_back_to_the_configuration(bend in 1e-9..3.0f64, delta in delta()) {
        let q = joints(PITCH, &Configuration::new(bend, delta));
        let back = configuration_from_joints(PITCH, &q.add_scalar(0.001));
        prop_assert!((back.bend() - bend).abs() < 1e-13 + 1e-15 / PITCH);
        // A common push of a millimetre hides the direction of bends that are smaller than its rounding.
        let turn = (back.delta() - delta).rem_euclid(TAU);
        prop_assert!(turn.min(TAU - turn) < 1e-14 / PITCH / bend.min(1.0) + 1e-14);
    }

    #[test]
    fn joint_forces_balance_energy_and_wrench(configuration in configuration(), f in prop::array::uniform6(-1.0..1.0f64), preload in -9.0..9.0f64) {
        let segment = segment(LENGTH, PITCH);
        let jacobian = segment.arc(configuration).jacobian(LENGTH);
        let wrench = Wrench { force: Vec3::new(f[0], f[1], f[2]), moment: Vec3::new(f[3], f[4], f[5]) * LENGTH };
        let tau = segment.joint_forces(&configuration, &jacobian, &wrench, preload);
        let left = segment.generalised_force(&configuration, &tau);
        let gradient = segment.energy_gradient(&configuration);
        prop_assert!((left.theta_l - (gradient.theta_l - jacobian.theta_l.power(&wrench))).abs() < 1e-14);
        prop_assert!((left.delta() - (gradient.delta() - jacobian.delta().power(&wrench))).abs() < 1e-14);
        // Least norm: nothing along (1, 1, 1) but the preload.
        prop_assert!((tau.sum() - 3.0 * preload).abs() < 1e-11);
    }

    #[test]
    fn the_independent_bound_is_never_below_the_common_one(configuration in configuration(), tau in prop::array::uniform3(-50.0..50.0f64)) {
        let segment = segment(LENGTH, PITCH);
        let tau = Vec3::from(tau);
        let (common, independent) = (segment.common_error_bound(&configuration, &tau, 0.1), segment.independent_error_bound(&configuration, &tau, 0.1));
        prop_assert!(independent >= common);
        // All eight sign choices, the slow way.
        let (a, b) = joint_jacobian_per_bend(PITCH, &configuration);
        let mut largest = 0.0f64;
        for signs in 0..8 {
            let t = Vec3::from_fn(|i, _| if signs >> i & 1 == 0 { tau[i] } else { -tau[i] });
            largest = largest.max(a.dot(&t).hypot(b.dot(&t) * configuration.bend()));
        }
        prop_assert!((independent - 0.1 * largest).abs() <= 1e-14 * largest);
    }

    #[test]
    fn the_location_search_finds_the_place_that_made_the_centrode(bend in 0.2..2.5f64, delta in delta(), share in 0.02..0.98f64) {
        let configuration = Configuration::new(bend, delta);
        let rate = Rate { theta_l: -1.0, delta: 0.0 };
        let truth = share * LENGTH;
        let c = Constrained::new(LENGTH, truth, bend, configuration).centrode(rate).expect("it moves");
        let found = locate(Assumption::default(), LENGTH, configuration, rate, &c).expect("it moves");
        prop_assert!((found.arc_length - truth).abs() < 1e-9 * LENGTH, "{} {truth}", found.arc_length);
        prop_assert!(found.distance < 1e-9 * LENGTH);
    }
}

/// Neighbouring doubles on both sides of every switch in the code give neighbouring values.
#[test]
fn nothing_jumps_where_a_formula_switches() {
    // Switches: zero bend; |φ_s| = 1, the end of the series; s = s_c between the two parts of a held segment.
    for at in [0.0, 1.0, -1.0, 1.0 / 0.7] {
        let quantities = |bend: f64| {
            let arc = segment(LENGTH, PITCH).arc(Configuration::new(bend, 0.4));
            let (pose, jacobian) = arc.pose_and_jacobian(0.7 * LENGTH);
            let (tip, tip_jacobian) = arc.pose_and_jacobian(LENGTH);
            let mut all = pose.position.as_slice().to_vec();
            all.extend_from_slice(pose.rotation.as_slice());
            all.extend_from_slice(jacobian.to_rows().as_flattened());
            for rate in [Rate { theta_l: -1.0, delta: 0.0 }, Rate { theta_l: 0.0, delta: 1.0 }] {
                let centrode = tip_jacobian.centrode(&tip.position, rate).expect("it moves");
                all.extend_from_slice(centrode.as_slice());
            }
            all
        };
        for (a, b) in quantities(at - 1e-15).iter().zip(quantities(at + 1e-15)) {
            assert!((a - b).abs() < 1e-14, "at bend {at}: {a} {b}");
        }
    }
    let held = Constrained::new(LENGTH, 0.012, 0.6, Configuration::new(1.1, 0.4));
    let (below, above) = (held.pose(0.012), held.pose(0.012 + 1e-17));
    assert_near(&below.position, &above.position, 1e-16, "across the contact");
}

/// At the straight segment the centrode of a motion in δ alone is a limit; it must be the one of small bends.
#[test]
fn a_turn_of_the_bending_plane_has_its_limit_when_straight() {
    let rate = Rate { theta_l: 0.0, delta: 1.0 };
    let at = |bend: f64| {
        let (tip, jacobian) = segment(LENGTH, PITCH).arc(Configuration::new(bend, 0.4)).pose_and_jacobian(LENGTH);
        jacobian.centrode(&tip.position, rate).expect("it moves")
    };
    assert_near(&at(0.0), &at(1e-9), 1e-9 * LENGTH, "limit");
}
