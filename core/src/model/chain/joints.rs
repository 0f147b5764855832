//! Joint values of concentric backbones: those of a distal segment run through every segment below it.

use super::{Bends, bends, configuration};
use crate::model::joints as single;
use crate::model::{Configuration, Vec3};

/// Joint values q_{k,m} = −r Σ_{j ≤ k} φ_j cos(δ_j + γ_k + mβ) of each segment's backbones, m; m = 0, 1, 2.
///
/// Exact for any shape that does not twist. `offsets` are the angles γ_k (rad) by which the backbones of each segment stand
/// turned on the common pitch circle of radius r (`pitch_radius`, m).
#[must_use]
pub fn joints(pitch_radius: f64, offsets: &[f64], configurations: &[Configuration]) -> Vec<Vec3> {
    let mut below = Bends::zeros();
    let each = offsets.iter().zip(configurations);
    each.map(|(offset, at)| {
        below += bends(*at);
        single::joints(pitch_radius, &turned(&below, *offset))
    })
    .collect()
}

/// The configurations whose joint values are nearest to `joints` (m) in least squares, segment by segment from the base; bends
/// are never negative.
#[must_use]
pub fn configurations_from_joints(pitch_radius: f64, offsets: &[f64], joints: &[Vec3]) -> Vec<Configuration> {
    let mut below = Bends::zeros();
    let each = offsets.iter().zip(joints);
    each.map(|(offset, q)| {
        let whole = bends(turned(&bends(single::configuration_from_joints(pitch_radius, q)), -offset));
        let own = configuration(&(whole - below));
        below = whole;
        own
    })
    .collect()
}

/// These integrals of curvature as a segment sees them whose δ is counted from a frame turned by `offset` (rad).
fn turned(bends: &Bends, offset: f64) -> Configuration {
    let at = configuration(bends);
    Configuration::new(at.bend(), at.delta() + offset)
}
