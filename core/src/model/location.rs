//! Where along the backbone the contact is (Eq. 24).

use super::{Configuration, Constrained, Rate, Vec3};

/// The paper tests a discrete set of points; this many bracket the minimum before it is refined.
const GRID: usize = 128;
/// Golden-section steps: each keeps 0.618 of the bracket, so 60 reach rounding.
const STEPS: usize = 60;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// An estimate of the contact's place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Location {
    /// Estimated arc length s_c of the contact, m.
    pub arc_length: f64,
    /// What remains of ‖c_c(s) − c_s‖ there, m.
    pub distance: f64,
}

/// The s in (0, L) whose constrained centrode c_c(s) is nearest the sensor's c_s (Eq. 24).
///
/// As in the paper, the part below s is taken to have frozen in the shape of `configuration`, the one
/// commanded at the instant of detection; `rate` is the commanded ψ̇ then. `None` when the rate is zero.
#[must_use]
pub fn locate(length: f64, configuration: Configuration, rate: Rate, sensor_centrode: &Vec3) -> Option<Location> {
    let distance = |s: f64| {
        Constrained::new(length, s, configuration.bend(), configuration)
            .centrode(rate)
            .map_or(f64::INFINITY, |c| (c - sensor_centrode).norm())
    };
    let place = |k: usize| length * k as f64 / GRID as f64;
    let nearest = (1..GRID).min_by(|&a, &b| distance(place(a)).total_cmp(&distance(place(b))))?;
    if !distance(place(nearest)).is_finite() {
        return None;
    }
    let (mut low, mut high) = (place(nearest - 1), place(nearest + 1));
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (distance(a), distance(b));
    for _ in 0..STEPS {
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = distance(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = distance(b);
        }
    }
    let arc_length = 0.5 * (low + high);
    Some(Location { arc_length, distance: distance(arc_length) })
}
