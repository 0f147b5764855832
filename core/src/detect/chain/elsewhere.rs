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
        let mut changes = vec![[Signature::<LOOSE>::zeros(); TIMES]; here[0].len()];
        for (direction, prior) in PRIOR.into_iter().enumerate() {
            let mut other = known.to_vec();
            let moved = &mut other[place];
            let mut step = STEP;
            match direction {
                0 => {
                    // Toward the middle, where there is backbone.
                    step *= (0.5 * course.length(segment) - moved.at).signum();
                    moved.at += step * prior * course.length(segment);
                }
                1 => moved.began += step * prior,
                _ => moved.tilt += step * prior,
            }
            let there = course.held(&other, &instants)?;
            for (tracker, changes) in changes.iter_mut().enumerate() {
                for (time, change) in changes.iter_mut().enumerate() {
                    let off = Seen::Each.off(course, tracker, instants[time], [&here[time], &there[time]]);
                    change.set_column(direction, &(off / step));
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
