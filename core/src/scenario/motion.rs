//! The commanded motion: a fifth-order rest-to-rest polynomial of θL.

use crate::scenario::Motion;

/// θL (rad) and θ̇L (rad/s) commanded at `time` (s).
#[must_use]
pub fn command(motion: &Motion, time: f64) -> (f64, f64) {
    let duration = motion.finish - motion.start;
    let u = ((time - motion.start) / duration).clamp(0.0, 1.0);
    let v = 1.0 - u;
    let travel = motion.theta_end - motion.theta_start;
    let progress = u * u * u * (10.0 + u * (6.0 * u - 15.0));
    let speed = 30.0 * (u * v) * (u * v) / duration;
    let theta_l = if u == 1.0 { motion.theta_end } else { motion.theta_start + travel * progress };
    // At rest the rate is 0, not the −0 of a motion downward.
    (theta_l, travel * speed + 0.0)
}
