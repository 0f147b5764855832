//! What several subjects need.

use centrode_core::model::{Arc, Configuration, Mat3, Segment, Vec3};
use num_dual::{Dual64, DualNum};
use std::f64::consts::FRAC_PI_2;

/// A segment with the reference's names.
pub fn segment(length: f64, pitch_radius: f64) -> Segment {
    Segment { length, pitch_radius, ep_ip: 0.0013, es_is: 0.00087 }
}

pub fn arc(length: f64, theta_l: f64, delta: f64) -> Arc {
    Arc { length, configuration: Configuration::from_theta_l(theta_l, delta) }
}

/// Eq. 3 as printed (it is right), in dual numbers: the pose from which derivatives are taken.
pub fn position(theta_l: Dual64, delta: Dual64, s: f64, length: f64) -> [Dual64; 3] {
    let bend = theta_l - FRAC_PI_2;
    let theta_s = bend * (s / length) + FRAC_PI_2;
    let scale = bend.recip() * length;
    let across = scale * (theta_s.sin() - 1.0);
    [delta.cos() * across, -delta.sin() * across, -scale * theta_s.cos()]
}

/// Eq. 4, row by row.
pub fn rotation(theta_l: Dual64, delta: Dual64, s: f64, length: f64) -> [[Dual64; 3]; 3] {
    let angle = (theta_l - FRAC_PI_2) * (-s / length);
    let (sin, cos) = angle.sin_cos();
    let (sd, cd) = delta.sin_cos();
    let (one, zero) = (Dual64::from(1.0), Dual64::from(0.0));
    let turn = |s: Dual64, c: Dual64| [[c, -s, zero], [s, c, zero], [zero, zero, one]];
    let bend = [[cos, zero, sin], [zero, one, zero], [-sin, zero, cos]];
    multiply(&multiply(&turn(-sd, cd), &bend), &turn(sd, cd))
}

fn multiply(a: &[[Dual64; 3]; 3], b: &[[Dual64; 3]; 3]) -> [[Dual64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

/// Rotation about z.
pub fn about_z(angle: f64) -> Mat3 {
    let (s, c) = angle.sin_cos();
    Mat3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

pub fn assert_near(ours: &Vec3, reference: &Vec3, tolerance: f64, what: &str) {
    let error = (ours - reference).amax();
    assert!(error <= tolerance, "{what}: off by {error:e} of {tolerance:e}\n{ours}{reference}");
}
