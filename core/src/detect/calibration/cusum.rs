//! Page's cumulative sum against one contact: in the middle of the backbone, a few readings old.

use super::course::{Model, Moment};
use super::linear::Linear;
use super::{Command, Six};
use crate::model::contact::{clamped_tip, free_tip};
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
}

impl Cusum {
    /// Takes the innovation of the next reading.
    #[inline]
    pub fn step(&mut self, moment: &Moment, innovation: &Six) -> f64 {
        self.value = (self.value + moment.design.dot(innovation) - moment.half).max(0.0);
        self.value
    }
}
