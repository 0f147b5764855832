//! Where along the backbone the contact is (Eq. 24).

use super::contact::touched::Trial;
use super::{Configuration, Constrained, Rate, Vec3};

/// The paper tests a discrete set of points; this many bracket the minimum before it is refined. Against a plane each costs a
/// solution, and the distance is as smooth.
const GRID: [usize; 2] = [128, 32];
/// Golden-section steps: each keeps 0.618 of the bracket, so 60 reach rounding; 40 a nanometre.
const STEPS: [usize; 2] = [60, 40];
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// An estimate of the contact's place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Location {
    /// Estimated arc length s_c of the contact, m.
    pub arc_length: f64,
    /// What remains of ‖c_c(s) − c_s‖ there, m.
    pub distance: f64,
}

/// What a contact is taken to do to the part below it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Assumed {
    /// It holds position and slope: that part is frozen, as in the paper.
    #[default]
    Clamp,
    /// It holds the position along its normal: that part goes on changing shape. A round beam does nearly the same.
    Plane,
}

/// What Eq. 24 takes a contact to be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Assumption {
    /// What it does to the part below it.
    pub kind: Assumed,
    /// Bend φ_c at which it is known to have begun, rad; none takes the bend at the instant of detection for it, as the paper does.
    pub met: Option<f64>,
}

/// The s in (0, L) whose constrained centrode c_c(s) is nearest the sensor's c_s (Eq. 24).
///
/// `configuration` is the one commanded at the instant of detection, `rate` the commanded ψ̇ then. `None` when the rate is zero.
#[must_use]
pub fn locate(
    assumption: Assumption,
    length: f64,
    configuration: Configuration,
    rate: Rate,
    sensor_centrode: &Vec3,
) -> Option<Location> {
    let met = assumption.met.unwrap_or_else(|| configuration.bend());
    let to_sensor = |centrode: Option<Vec3>| centrode.map_or(f64::INFINITY, |c| (c - sensor_centrode).norm());
    match assumption.kind {
        Assumed::Clamp => nearest::<{ GRID[0] }>(length, STEPS[0], |s| {
            to_sensor(Constrained::new(length, s, met, configuration).centrode(rate))
        }),
        Assumed::Plane => {
            let mut trial = Trial::new(length, configuration, met);
            nearest::<{ GRID[1] }>(length, STEPS[1], |s| to_sensor(trial.centrode(s, rate)))
        }
    }
}

/// The place in (0, L) with the least distance.
fn nearest<const GRID: usize>(length: f64, steps: usize, mut distance: impl FnMut(f64) -> f64) -> Option<Location> {
    let place = |k: usize| length * k as f64 / GRID as f64;
    let distances: [f64; GRID] = std::array::from_fn(|k| if k == 0 { f64::INFINITY } else { distance(place(k)) });
    let nearest = (1..GRID).min_by(|&a, &b| distances[a].total_cmp(&distances[b]))?;
    if !distances[nearest].is_finite() {
        return None;
    }
    let (mut low, mut high) = (place(nearest - 1), place(nearest + 1));
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (distance(a), distance(b));
    for _ in 0..steps {
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
