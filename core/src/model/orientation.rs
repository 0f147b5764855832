//! Azimuth, elevation and roll, and unit quaternions: how orientations are reported and averaged.

use crate::model::special::Angle;
use crate::model::{Mat3, Vec3};
use libm::{asin, atan2, sincos};

/// `Rz(azimuth) Ry(elevation) Rx(roll)`, all in rad.
#[must_use]
pub fn from_euler(angles: &[f64; 3]) -> Mat3 {
    from_euler_sin_cos(&angles.map(sincos))
}

/// [`from_euler`] from the sine and cosine of each angle.
#[must_use]
pub fn from_euler_sin_cos(angles: &[(f64, f64); 3]) -> Mat3 {
    let [(sa, ca), (se, ce), (sr, cr)] = *angles;
    Mat3::new(
        ca * ce,
        ca * se * sr - sa * cr,
        ca * se * cr + sa * sr,
        sa * ce,
        sa * se * sr + ca * cr,
        sa * se * cr - ca * sr,
        -se,
        ce * sr,
        ce * cr,
    )
}

/// The rotation about `vector` by its length in rad (Rodrigues).
#[must_use]
pub fn from_vector(vector: &Vec3) -> Mat3 {
    let angle = Angle::new(vector.norm());
    let hat = vector.cross_matrix();
    Mat3::identity() + hat * angle.sinc() + hat * hat * angle.versinc()
}

/// Azimuth, elevation, roll of a rotation, rad; elevation in [−π/2, π/2].
///
/// At ±90° of elevation only a sum of the others is defined: roll is then 0.
#[must_use]
pub fn to_euler(rotation: &Mat3) -> [f64; 3] {
    let sine = (-rotation[(2, 0)]).clamp(-1.0, 1.0);
    if sine.abs() == 1.0 {
        return [atan2(-rotation[(0, 1)], rotation[(1, 1)]), asin(sine), 0.0];
    }
    [atan2(rotation[(1, 0)], rotation[(0, 0)]), asin(sine), atan2(rotation[(2, 1)], rotation[(2, 2)])]
}

/// A quaternion, scalar first; of unit length when it stands for one rotation.
pub type Quaternion = [f64; 4];

/// The unit quaternion of `Rz(azimuth) Ry(elevation) Rx(roll)`.
#[must_use]
pub fn quaternion_from_euler(angles: &[f64; 3]) -> Quaternion {
    let [(sa, ca), (se, ce), (sr, cr)] = angles.map(|angle| sincos(0.5 * angle));
    [ca * ce * cr + sa * se * sr, ca * ce * sr - sa * se * cr, ca * se * cr + sa * ce * sr, sa * ce * cr - ca * se * sr]
}

/// The vector part of `a · conj(b)`.
#[must_use]
pub fn vector_of_ratio(a: &Quaternion, b: &Quaternion) -> Vec3 {
    let (av, bv) = (Vec3::new(a[1], a[2], a[3]), Vec3::new(b[1], b[2], b[3]));
    av * b[0] - bv * a[0] - av.cross(&bv)
}

/// The rotation vector of a rotation (rad): its logarithm, of an angle in [0, π].
#[must_use]
pub fn rotation_vector(rotation: &Mat3) -> Vec3 {
    let sine = vee(rotation);
    let (size, cosine) = (sine.norm(), 0.5 * (rotation.trace() - 1.0));
    if size > 1e-7 || cosine > 0.0 {
        // A small angle is its own sine, to rounding.
        return if size < 1e-7 { sine } else { sine * (atan2(size, cosine) / size) };
    }
    // A half turn has no sine: its axis is the largest column of (R + 1)/2.
    let square = (rotation + Mat3::identity()) * 0.5;
    let axis = square.column(square.diagonal().imax()).into_owned();
    axis.normalize() * std::f64::consts::PI
}

/// The vector of the skew part of a matrix: the inverse of the hat, [·]^∨.
#[must_use]
pub fn vee(matrix: &Mat3) -> Vec3 {
    0.5 * Vec3::new(matrix[(2, 1)] - matrix[(1, 2)], matrix[(0, 2)] - matrix[(2, 0)], matrix[(1, 0)] - matrix[(0, 1)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn euler_angles_and_back() {
        for angles in [[0.0, 0.0, 0.0], [0.3, -0.7, 2.0], [-3.0, 1.5, -2.9], [1.0, -FRAC_PI_2 + 1e-6, 0.2]] {
            let back = to_euler(&from_euler(&angles));
            for (a, b) in angles.iter().zip(back) {
                assert!((a - b).abs() < 1e-9, "{angles:?} {back:?}");
            }
        }
    }

    #[test]
    fn the_singular_orientation_is_still_that_orientation() {
        let rotation = from_euler(&[0.4, FRAC_PI_2, 0.9]);
        assert!((from_euler(&to_euler(&rotation)) - rotation).norm() < 1e-9);
    }

    #[test]
    fn quaternions_agree_with_matrices() {
        let (a, b) = ([0.3, -0.7, 2.0], [0.31, -0.72, 2.01]);
        let ratio = vector_of_ratio(&quaternion_from_euler(&b), &quaternion_from_euler(&a));
        let matrix = from_euler(&b) * from_euler(&a).transpose();
        // Half-angle against whole angle of a small rotation.
        assert!((2.0 * ratio - vee(&matrix)).norm() < 1e-5);
    }
}
