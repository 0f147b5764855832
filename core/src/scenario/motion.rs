//! The commanded motion: a fifth-order rest-to-rest polynomial of θL.

use crate::scenario::Motion;

/// θL (rad) and θ̇L (rad/s) commanded at `time` (s).
#[must_use]
pub fn command(motion: &Motion, time: f64) -> (f64, f64) {
    from_rest_to_rest(motion.theta_start, motion.theta_end, motion.start, motion.finish, time)
}

/// The value at `time` (s), and its rate, of what goes from one value to another from `start` to `finish` (s).
#[must_use]
pub fn from_rest_to_rest(from: f64, to: f64, start: f64, finish: f64, time: f64) -> (f64, f64) {
    let duration = finish - start;
    let u = ((time - start) / duration).clamp(0.0, 1.0);
    let v = 1.0 - u;
    let travel = to - from;
    let progress = u * u * u * (10.0 + u * (6.0 * u - 15.0));
    let speed = 30.0 * (u * v) * (u * v) / duration;
    let value = if u == 1.0 { to } else { from + travel * progress };
    // At rest the rate is 0, not the −0 of a motion downward.
    (value, travel * speed + 0.0)
}
