//! Orientations of logs as azimuth, elevation and roll.

use crate::model::Mat3;
use crate::model::orientation::{Quaternion, from_vector, to_euler};
use libm::sqrt;

/// An orientation of the marker as a log holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Orientation {
    /// The log has none.
    None,
    /// Azimuth, elevation, roll, rad.
    Euler([f64; 3]),
    /// A quaternion, scalar first; of unit length or nearly so.
    Quaternion(Quaternion),
    /// Axis times angle, rad.
    Vector([f64; 3]),
}

/// A quaternion this far from unit length is no rounding.
const SLACK: f64 = 1e-3;
/// One shorter or longer than this by as many times is no rotation: trackers write zeros where they see nothing.
const FAR: f64 = 2.0;

impl Orientation {
    /// Azimuth, elevation and roll (rad), and whether a quaternion had to be brought to unit length; none where a part is not
    /// defined, NaN for a log without orientation.
    #[must_use]
    pub fn angles(self) -> Option<([f64; 3], bool)> {
        match self {
            Self::None => Some(([f64::NAN; 3], false)),
            Self::Euler(angles) => angles.iter().all(|angle| angle.is_finite()).then_some((angles, false)),
            Self::Quaternion(quaternion) => {
                let length = sqrt(quaternion.iter().map(|part| part * part).sum());
                let near = (1.0 / FAR..=FAR).contains(&length);
                near.then(|| (to_euler(&from_quaternion(&quaternion)), (length - 1.0).abs() > SLACK))
            }
            Self::Vector(vector) => {
                vector.iter().all(|part| part.is_finite()).then(|| (to_euler(&from_vector(&vector.into())), false))
            }
        }
    }
}

/// The rotation of a quaternion, scalar first, of any length but 0.
#[must_use]
pub fn from_quaternion(&[w, x, y, z]: &Quaternion) -> Mat3 {
    let scale = 2.0 / (w * w + x * x + y * y + z * z);
    Mat3::new(
        1.0 - scale * (y * y + z * z),
        scale * (x * y - w * z),
        scale * (x * z + w * y),
        scale * (x * y + w * z),
        1.0 - scale * (x * x + z * z),
        scale * (y * z - w * x),
        scale * (x * z - w * y),
        scale * (y * z + w * x),
        1.0 - scale * (x * x + y * y),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Vec3;
    use crate::model::orientation::{from_euler, quaternion_from_euler};

    #[test]
    fn every_way_to_write_a_rotation_gives_the_same_angles() {
        for angles in [[0.0; 3], [0.3, -0.7, 2.0], [-3.0, 1.5, -2.9]] {
            let quaternion = quaternion_from_euler(&angles);
            let (from, normalised) = Orientation::Quaternion(quaternion.map(|part| 1.5 * part)).angles().expect("one");
            assert!(normalised && from.iter().zip(angles).all(|(a, b)| (a - b).abs() < 1e-9), "{from:?}");
            let [w, x, y, z] = quaternion;
            let sine = sqrt(x * x + y * y + z * z);
            let scale = if sine > 0.0 { 2.0 * libm::atan2(sine, w) / sine } else { 2.0 };
            let rotation = from_vector(&Vec3::new(x * scale, y * scale, z * scale));
            assert!((rotation - from_euler(&angles)).norm() < 1e-12, "{angles:?}");
        }
    }

    #[test]
    fn what_is_no_rotation_has_no_angles() {
        assert_eq!(Orientation::Quaternion([0.0; 4]).angles(), None);
        assert_eq!(Orientation::Quaternion([f64::NAN, 0.0, 0.0, 1.0]).angles(), None);
        assert_eq!(Orientation::Quaternion([1e200, 0.0, 0.0, 1.0]).angles(), None);
        assert_eq!(Orientation::Vector([0.0, f64::INFINITY, 0.0]).angles(), None);
    }
}
