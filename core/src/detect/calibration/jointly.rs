//! Where on a chain a contact is: what several trackers say of it together, each through its own calibration filter.

use super::STATES;
use super::filter::Signature;
use super::likelihood::{Base, Grid, Row};
use super::linear;
use super::marginal::{
    About, BELIEVED, CLEAR, Calibrated, Estimate, History, Tried, Weighed, about_errors, calibrate, likeliest, nominal,
    rows, weigh,
};
use super::signature::PLACES;
use crate::scenario::Kind;
use libm::fabs;

/// What planes on one segment change in the readings of every tracker.
pub trait Hypotheses: std::fmt::Debug {
    /// How many trackers, from the base, see anything of them.
    fn seen_by(&self) -> usize;
    /// What planes at the [`places`](super::signature::places) of the segment that were met at an instant (in readings) change in a reading of
    /// a tracker after it.
    fn signature(&self, tracker: usize, began: f64, reading: usize) -> Signature<PLACES>;
}

/// What is asked.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// The readings that are thought of as the beginning, rising.
    pub beginnings: &'a [usize],
    /// Beginnings that are tried between one of them and the next.
    pub parts: u32,
    /// The segment, from 0.
    pub segment: usize,
    /// Its length, m.
    pub length: f64,
}

/// Places a contact on one segment. `None` where nothing moved, or where a calibration is beyond what was thought possible.
#[must_use]
pub fn estimate(histories: &[History], hypotheses: &dyn Hypotheses, question: &Question) -> Option<Estimate> {
    let base = if question.segment == 0 { Base::Stays } else { Base::Moves };
    let grid = Grid::coarse(base);
    let seeing = &histories[..hypotheses.seen_by()];
    let share = 1.0 / together(seeing.len());
    let before: Vec<_> = seeing.iter().map(nominal).collect();
    let roughly = |began: usize| {
        let mut row = Row::silent((began, 0.0));
        for (tracker, (history, (innovations, _))) in seeing.iter().zip(&before).enumerate() {
            let signature = |k| hypotheses.signature(tracker, began as f64, k);
            row.hear(|k| &history.moments[k].stage, innovations, signature);
        }
        row.told(share).most(&grid)
    };
    let began = likeliest(question.beginnings, roughly)?;
    let calibrated: Vec<Calibrated> = seeing
        .iter()
        .zip(&before)
        .map(|(history, (_, states))| calibrate(history, began.saturating_sub(CLEAR), states))
        .collect::<Option<_>>()?;
    let beyond = |state: &f64| fabs(*state) > BELIEVED;
    if calibrated.iter().any(|of| of.states.iter().take(super::DRIFT).any(beyond)) {
        return None;
    }
    let errors = |of: &Calibrated, history: &History| linear::errors(&of.states, &history.model.belief.deviations);
    let about: Vec<About> = seeing
        .iter()
        .zip(&calibrated)
        .map(|(history, of)| about_errors(history, errors(of, history), history.readings.len()))
        .collect();
    let row = |began: (usize, f64)| {
        let mut row = Row::silent(began);
        for (tracker, about) in about.iter().enumerate() {
            let signature = |k| hypotheses.signature(tracker, began.0 as f64 + began.1, k);
            row.hear(|k| &about.stages[k], &about.innovations, signature);
        }
        row.told(share)
    };
    let (rows, parts) = rows(row, question.beginnings, began, question.parts, &grid);
    // One segment against another is weighed by all that was heard: what is left out for the place would be left out of one more than of the other.
    let whole: Vec<Row> = rows.iter().map(|row| row.clone().told(1.0 / share)).collect();
    let tried = |rows| [Tried { kind: Kind::Plane, rows, parts }];
    let own = question.segment.min(seeing.len() - 1);
    let commands: Vec<_> = seeing[own].moments.iter().map(|moment| moment.command).collect();
    let deviations = linear::errors(&calibrated[own].deviations, &seeing[own].model.belief.deviations);
    let calibration: [[f64; STATES]; 2] = [errors(&calibrated[own], &seeing[own]), deviations];
    let beginnings = question.beginnings.len();
    let weighed = Weighed { base, length: question.length, commands: &commands, beginnings, calibration };
    let ratio = weigh(&tried(whole), &weighed)?.ratio;
    Some(Estimate { ratio, ..weigh(&tried(rows), &weighed)? })
}

/// By how much the variance of what neighbouring trackers say together can exceed what it would be if their noise were independent.
///
/// A tracker's noise is in the readings of its own segment and, with the other sign, in those of the next, which have that of two trackers:
/// correlations of −√½ between the first two segments and −½ between others. This is the largest eigenvalue of their matrix.
fn together(trackers: usize) -> f64 {
    let correlation = |i: usize, j: usize| match (i.min(j), i.abs_diff(j)) {
        (_, 0) => 1.0,
        (0, 1) => -std::f64::consts::FRAC_1_SQRT_2,
        (_, 1) => -0.5,
        _ => 0.0,
    };
    nalgebra::DMatrix::from_fn(trackers, trackers, correlation).symmetric_eigenvalues().max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_that_share_noise_say_less_than_they_seem_to() {
        for (trackers, exact) in [(1, 1.0), (2, 1.0 + std::f64::consts::FRAC_1_SQRT_2), (3, 1.0 + libm::sqrt(0.75))] {
            assert!((together(trackers) - exact).abs() < 1e-12, "{trackers}: {}", together(trackers));
        }
        assert!(together(12) < 2.0);
    }
}
