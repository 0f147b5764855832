//! What is not known of contacts that hold already: a little elsewhere, earlier or more askew, they change what later ones are heard by.

use super::course::{Course, KnownContact};
use super::hypotheses::{Seen, TIMES, interpolated, times};
use crate::detect::calibration::ensemble::LOOSE;
use crate::detect::calibration::filter::Signature;

/// Standard deviations of what is not known of a contact before it is heard: of its place (a share of its segment's length), of its beginning
/// (readings), and of its tilt (rad). What is read from then on says far more.
const PRIOR: [f64; LOOSE] = [0.1, 5.0, 0.3];
/// Over such shares of them changes are taken for linear.
const STEP: f64 = 0.02;

/// What one contact changes in the readings of every end disk as it is a standard deviation elsewhere.
#[derive(Debug)]
pub(super) struct Elsewhere {
    pub began: f64,
    last: f64,
    /// By tracker, then by time.
    changes: Vec<[Signature<LOOSE>; TIMES]>,
}

impl Elsewhere {
    /// Of each of the contacts that are known. `None` where one of them cannot be.
    pub fn all(course: &Course, known: &[KnownContact]) -> Option<Vec<Self>> {
        (0..known.len()).map(|place| Self::of(course, known, place)).collect()
    }

    fn of(course: &Course, known: &[KnownContact], place: usize) -> Option<Self> {
        let KnownContact { segment, began, .. } = known[place];
        let last = course.last as f64;
        let instants = times().map(|share| began + share * (last - began));
        let here = course.held(known, &instants)?;
        let trackers = here[0].len();
        let mut changes = vec![[Signature::<LOOSE>::zeros(); TIMES]; trackers];
        for (direction, prior) in PRIOR.into_iter().enumerate() {
            let mut other = known.to_vec();
            let moved = &mut other[place];
            // Toward the middle, where there is backbone, and later, where there are readings.
            match direction {
                0 => {
                    moved.at -=
                        STEP * prior * course.length(segment) * (moved.at - 0.5 * course.length(segment)).signum()
                }
                1 => moved.began += STEP * prior,
                _ => moved.tilt += STEP * prior,
            }
            let sign = if direction == 0 { (other[place].at - known[place].at).signum() } else { 1.0 };
            let there = course.held(&other, &instants)?;
            for time in 0..TIMES {
                for tracker in 0..trackers {
                    let off = Seen::Each.off(course, tracker, instants[time], [&here[time], &there[time]]);
                    changes[tracker][time].set_column(direction, &(off * (sign / STEP)));
                }
            }
        }
        Some(Self { began, last, changes })
    }

    /// What each direction changes in a reading of a tracker.
    pub fn at(&self, tracker: usize, reading: usize) -> Signature<LOOSE> {
        interpolated(&self.changes[tracker], [self.began, self.last], reading)
    }
}
