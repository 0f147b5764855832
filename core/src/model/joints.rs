//! Joint space: how far each secondary backbone is pushed or pulled (Eq. 2), and back again.

use super::{Configuration, Rate, Vec3};
use libm::{atan2, hypot};

/// Cosine of β = 2π/3, the division angle of the secondary backbones.
const COS_BETA: f64 = -0.5;
/// Sine of β = 2π/3.
const SIN_BETA: f64 = 0.866_025_403_784_438_6;

/// `(cos δᵢ, sin δᵢ)` as two vectors over the three backbones, δᵢ = δ + iβ.
#[must_use]
pub fn backbone_directions(configuration: &Configuration) -> (Vec3, Vec3) {
    let (s, c) = configuration.sin_cos_delta();
    let cos = Vec3::new(c, c * COS_BETA - s * SIN_BETA, c * COS_BETA + s * SIN_BETA);
    let sin = Vec3::new(s, s * COS_BETA + c * SIN_BETA, s * COS_BETA - c * SIN_BETA);
    (cos, sin)
}

/// Joint values qᵢ = Lᵢ − L = r cos(δᵢ)(θL − θ0), in m.
#[must_use]
pub fn joints(pitch_radius: f64, configuration: &Configuration) -> Vec3 {
    backbone_directions(configuration).0 * (-pitch_radius * configuration.bend())
}

/// J_qψ (Eq. 2) by columns: ∂q/∂θL and (∂q/∂δ)/φ, in m/rad and m/rad².
#[must_use]
pub fn joint_jacobian_per_bend(pitch_radius: f64, configuration: &Configuration) -> (Vec3, Vec3) {
    let (cos, sin) = backbone_directions(configuration);
    (cos * pitch_radius, sin * pitch_radius)
}

/// J_qψ (Eq. 2): one row per backbone, columns θL and δ, in m/rad.
#[must_use]
pub fn joint_jacobian(pitch_radius: f64, configuration: &Configuration) -> [[f64; 2]; 3] {
    let (theta, delta_per_bend) = joint_jacobian_per_bend(pitch_radius, configuration);
    std::array::from_fn(|i| [theta[i], delta_per_bend[i] * configuration.bend()])
}

/// Joint speeds q̇ = J_qψ ψ̇ (Eq. 2), in m/s.
#[must_use]
pub fn joint_speeds(pitch_radius: f64, configuration: &Configuration, rate: Rate) -> Vec3 {
    let (theta, delta_per_bend) = joint_jacobian_per_bend(pitch_radius, configuration);
    theta * rate.theta_l + delta_per_bend * (configuration.bend() * rate.delta)
}

/// The configuration whose joint values are nearest to `q` (m) in least squares; the bend is never negative.
///
/// What three backbones share (their mean) bends nothing and is left out. δ is 0 for the straight segment.
#[must_use]
pub fn configuration_from_joints(pitch_radius: f64, q: &Vec3) -> Configuration {
    let scale = 2.0 / (3.0 * pitch_radius);
    let x = -scale * (q.x + COS_BETA * (q.y + q.z));
    let y = scale * SIN_BETA * (q.y - q.z);
    Configuration::new(hypot(x, y), if x == 0.0 && y == 0.0 { 0.0 } else { atan2(y, x) })
}
