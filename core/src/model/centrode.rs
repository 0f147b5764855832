//! The fixed centrode: where the instantaneous screw axis passes nearest the origin.

use super::{Twist, Vec3};

/// The point of the instantaneous screw axis nearest the origin of {B} (Eqs. 17, 18), in m.
///
/// `position` and `twist` are those of one frame, in {B}. `None` when the frame does not turn, as a pure
/// translation has no axis, or so little that the axis lies further away than numbers tell.
#[must_use]
pub fn centrode(position: &Vec3, twist: &Twist) -> Option<Vec3> {
    let w = &twist.angular;
    let square = w.norm_squared();
    let axis_point = w.cross(&(twist.linear - w.cross(position))) / square;
    (square > 0.0 && axis_point.norm_squared().is_finite()).then_some(axis_point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_turns_too_little_for_the_distance_of_its_axis_has_none() {
        let axis = |rate: f64| {
            let twist = Twist { linear: Vec3::new(0.0, 0.0, 1e-3), angular: Vec3::new(0.0, rate, 0.0) };
            centrode(&Vec3::zeros(), &twist)
        };
        let found = axis(1e-100).expect("far away");
        assert!((found.norm() * 1e-97 - 1.0).abs() < 1e-12, "{found:?}");
        // The square of its distance is no number, though each of its coordinates is one.
        assert_eq!([axis(1e-158), axis(0.0)], [None, None]);
    }
}
