//! Page's cumulative sum against one contact: in the middle of the backbone, a few readings old.

use super::course::{Model, Moment};
use super::linear::Linear;
use super::{Command, Six};
use crate::model::contact::{clamped_tip, free_tip};
use libm::{exp, log};
use nalgebra::SMatrix;

/// The contact that it looks for, as a share of the backbone.
pub const PLACE: f64 = 0.5;
/// The contact that it looks for is old enough to stand out by this many standard deviations, squared.
const VISIBLE: f64 = 4.0;
/// Its age, in readings, at most.
pub const LONGEST: usize = 100;

/// How many readings ago the contact began: the fewest after which one in the middle of the backbone, met at the fastest, stands out of
/// the noise by two standard deviations. 3 at 0.05 mm and 0.01°, 12 at 0.5 mm and 0.1°, with the paper's motion at 100 Hz.
#[must_use]
pub fn age(model: &Model, commands: impl Iterator<Item = Command>) -> usize {
    let Model { length, belief, noise } = model;
    let (mut last, mut fastest): (Option<f64>, Option<(Command, f64)>) = (None, None);
    for command in commands {
        let step = last.map_or(0.0, |time| command.rate * (command.time - time));
        if step != 0.0 && fastest.is_none_or(|(_, most)| step.abs() > most.abs()) {
            fastest = Some((command, step));
        }
        last = Some(command.time);
    }
    let Some((command, step)) = fastest else { return 1 };
    let linear = Linear::nominal(*length, &command);
    let free = belief.free_bend * belief.free_bend;
    let mut spread: SMatrix<f64, 6, 6> = linear.by_bend * linear.by_bend.transpose() * free;
    let (place, turn) = (noise.position * noise.position, noise.orientation * noise.orientation);
    for (i, variance) in [turn, place, place, place, turn, turn].into_iter().enumerate() {
        spread[(i, i)] += variance;
    }
    let Some(cholesky) = spread.cholesky() else { return 1 };
    let mut sum = 0.0;
    for age in 1..LONGEST {
        let bend = command.bend + step * age as f64;
        let off = (clamped_tip(PLACE, command.bend, bend) - free_tip(bend)) * *length;
        let off = Six::new(0.0, off.x, off.y, 0.0, 0.0, 0.0);
        sum += off.dot(&cholesky.solve(&off));
        if sum >= VISIBLE {
            return age;
        }
    }
    LONGEST
}

/// The sum of one run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cusum {
    /// The statistic, a log likelihood ratio (natural), not negative.
    pub value: f64,
    /// Log odds of a contact by now; −∞ before one can have begun.
    odds: Odds,
    /// Time of the reading before, s.
    last: Option<f64>,
}

/// Odds of a contact, as a natural logarithm.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Odds(f64);

impl Default for Odds {
    fn default() -> Self {
        Self(f64::NEG_INFINITY)
    }
}

/// Contacts that begin in a second while the robot moves, beforehand: one in ten seconds.
pub const HAZARD: f64 = 0.1;
/// No step is so long that one is more likely than not.
const MOST: f64 = 0.5;

impl Cusum {
    /// Takes the innovation of the next reading.
    #[inline]
    pub fn step(&mut self, moment: &Moment, innovation: &Six) -> f64 {
        let added = moment.design.dot(innovation) - moment.half;
        self.value = (self.value + added).max(0.0);
        let time = moment.command.time;
        let elapsed = self.last.replace(time).map_or(0.0, |last| time - last);
        if moment.command.rate != 0.0 {
            // Shiryaev's recursion: what was, and what begins now.
            let begins = (HAZARD * elapsed).min(MOST);
            self.odds.0 = log((exp(self.odds.0) + begins) / (1.0 - begins)) + added;
            // Beyond this the logarithm of the exponential would not be a number.
            self.odds.0 = self.odds.0.min(600.0);
        }
        self.value
    }

    /// The probability that a contact has begun by now, with [`HAZARD`] beforehand and the contact that the sum looks for.
    #[must_use]
    pub fn probability(&self) -> f64 {
        1.0 / (1.0 + exp(-self.odds.0))
    }
}
