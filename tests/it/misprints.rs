//! Each misprint of the paper (the table in `docs/MODEL.md`): the printed form is wrong, ours is right.
//!
//! "Right" is the derivative of Eqs. 3 and 4 in dual numbers, and Eqs. 11 and 14 where statics are concerned.

use crate::support::{arc, position, rotation, segment};
use centrode_core::model::joints::joint_jacobian;
use centrode_core::model::{Configuration, Mat3, Vec3};
use num_dual::Dual64;
use std::f64::consts::FRAC_PI_2;

const LENGTH: f64 = 0.03;
const THETA_L: f64 = 0.6;
const DELTA: f64 = 0.8;
const S: f64 = 0.018;

/// One column of the Jacobian by dual numbers: linear, then angular.
fn column(which: usize) -> [f64; 6] {
    let seed = |i: usize, x: f64| {
        if i == which { Dual64::from(x).derivative() } else { Dual64::from(x) }
    };
    let (theta_l, delta) = (seed(0, THETA_L), seed(1, DELTA));
    let p = position(theta_l, delta, S, LENGTH);
    let r = rotation(theta_l, delta, S, LENGTH);
    let matrix = |part: fn(&Dual64) -> f64| Mat3::from_fn(|i, j| part(&r[i][j]));
    let omega = matrix(|x| x.eps) * matrix(|x| x.re).transpose();
    [p[0].eps, p[1].eps, p[2].eps, omega[(2, 1)], omega[(0, 2)], omega[(1, 0)]]
}

fn ours() -> [[f64; 2]; 6] {
    arc(LENGTH, THETA_L, DELTA).jacobian(S).to_rows()
}

fn theta_s() -> f64 {
    FRAC_PI_2 - S * (FRAC_PI_2 - THETA_L) / LENGTH
}

/// Ours equals the truth and the printed entry is far from it.
fn shows(row: usize, col: usize, printed: f64) {
    let truth = column(col)[row];
    let ours = ours()[row][col];
    assert!((ours - truth).abs() < 1e-14, "ours: {ours} against {truth}");
    assert!((printed - truth).abs() > 1e-3, "the printed {printed} is not wrong: {truth}");
}

#[test]
fn equation_9_v1_has_s_where_sin_is_printed() {
    let bend = THETA_L - FRAC_PI_2;
    let v1 = |first: f64| first * theta_s().cos() - LENGTH * (theta_s().sin() - 1.0);
    shows(0, 0, DELTA.cos() * v1(bend.sin()) / (bend * bend));
    let right = DELTA.cos() * v1(S * bend) / (bend * bend);
    assert!((ours()[0][0] - right).abs() < 1e-15);
}

#[test]
fn equation_8_row_2_column_1_has_the_other_sign() {
    let bend = THETA_L - FRAC_PI_2;
    let v1 = S * bend * theta_s().cos() - LENGTH * (theta_s().sin() - 1.0);
    shows(1, 0, DELTA.sin() * v1 / (bend * bend));
    assert!((ours()[1][0] + DELTA.sin() * v1 / (bend * bend)).abs() < 1e-15);
}

#[test]
fn equation_8_rows_4_and_5_column_1_are_scaled_by_s_over_l() {
    shows(3, 0, -DELTA.sin());
    shows(4, 0, -DELTA.cos());
    let tip = arc(LENGTH, THETA_L, DELTA).jacobian(LENGTH).to_rows();
    assert!((tip[3][0] + DELTA.sin()).abs() < 1e-15, "equal at s = L only");
    assert!((tip[4][0] + DELTA.cos()).abs() < 1e-15, "equal at s = L only");
}

#[test]
fn equation_8_rows_4_to_6_column_2_have_sine_and_cosine_swapped() {
    let (sin, cos) = theta_s().sin_cos();
    shows(3, 1, DELTA.cos() * sin);
    shows(4, 1, -DELTA.sin() * sin);
    shows(5, 1, cos - 1.0);
    // A straight segment does not turn when δ changes; the printed column says it does.
    let straight = arc(LENGTH, FRAC_PI_2, DELTA).jacobian(LENGTH).delta().angular;
    assert!(straight.norm() < 1e-15);
    assert!((DELTA.cos() * FRAC_PI_2.sin()).abs() > 0.5);
}

#[test]
fn equation_12_takes_j_q_psi_transposed() {
    // J_qψᵀ is 2×3 and takes three forces to two generalised forces, as Eqs. 11 and 14 need. J_ψq is 2×3 itself, so
    // its transpose is 3×2 and cannot take three forces; untransposed it has units of rad/m, not m/rad.
    let segment = segment(LENGTH, 0.003);
    let configuration = Configuration::from_theta_l(THETA_L, DELTA);
    let gradient = segment.energy_gradient(&configuration);
    let tau = segment.forces_from_load(&configuration, &gradient);
    assert!(segment.residual(&configuration, &tau) < 1e-15 * 1e3, "ours vanishes in balance");
    let j = nalgebra::Matrix3x2::from_fn(|i, k| joint_jacobian(0.003, &configuration)[i][k]);
    let j_psi_q = (j.transpose() * j).try_inverse().expect("bent") * j.transpose();
    let printed = j_psi_q * tau - nalgebra::Vector2::new(gradient.theta_l, gradient.delta());
    assert!(printed.norm() > 1.0, "the printed residual does not vanish in balance: {}", printed.norm());
}

#[test]
fn equation_16_is_no_bound_for_independent_errors() {
    let segment = segment(LENGTH, 0.003);
    let configuration = Configuration::from_theta_l(THETA_L, DELTA);
    let epsilon = 0.1;
    let tau = segment.forces_from_load(&configuration, &segment.energy_gradient(&configuration)).add_scalar(60.0);

    // One error common to the cells: Θ equals Eq. 16.
    let tau_lc = tau / (1.0 - epsilon);
    let theta = segment.residual(&configuration, &tau_lc);
    let printed = segment.common_error_bound(&configuration, &tau_lc, epsilon);
    assert!((theta - printed).abs() < 1e-12, "{theta} {printed}");

    // Errors of opposite sign, each within ±ε: Θ exceeds Eq. 16 and stays within ours.
    let tau_lc = Vec3::from_fn(|i, _| tau[i] / (1.0 - [epsilon, -epsilon, epsilon][i]));
    let theta = segment.residual(&configuration, &tau_lc);
    assert!(theta > 1.5 * segment.common_error_bound(&configuration, &tau_lc, epsilon));
    assert!(theta <= segment.independent_error_bound(&configuration, &tau_lc, epsilon) * (1.0 + 1e-12));
}
