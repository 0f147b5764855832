//! The fixed centrode: where the instantaneous screw axis passes nearest the origin.

use super::{Twist, Vec3};

/// The point of the instantaneous screw axis nearest the origin of {B} (Eqs. 17, 18), in m.
///
/// `position` and `twist` are those of one frame, in {B}. `None` when the frame does not turn: a pure
/// translation has no axis.
#[must_use]
pub fn centrode(position: &Vec3, twist: &Twist) -> Option<Vec3> {
    let w = &twist.angular;
    let square = w.norm_squared();
    let axis_point = w.cross(&(twist.linear - w.cross(position))) / square;
    (square > 0.0 && axis_point.iter().all(|x| x.is_finite())).then_some(axis_point)
}
