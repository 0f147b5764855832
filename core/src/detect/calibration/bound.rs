//! What no detector and no estimator can do better with the same readings.

use super::Command;
use super::course::Moment;
use super::filter::Responses;
use crate::model::contact::{clamped_tip, free_tip};
use libm::{erfc, sqrt};
use nalgebra::Matrix2;
use std::f64::consts::FRAC_1_SQRT_2;

/// When a contact begins: the last reading before it, and how much of the way to the next the bend has gone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beginning {
    /// The reading.
    pub reading: usize,
    /// From 0 to 1.
    pub share: f64,
}

impl Beginning {
    /// Of a contact that holds beyond a bend (rad): beyond is a larger one where `side` is positive. None where no reading was taken before
    /// it, or after.
    #[must_use]
    pub fn of(commands: &[Command], bend: f64, side: f64) -> Option<Self> {
        let after = commands.iter().position(|command| side * (command.bend - bend) > 0.0)?;
        let reading = after.checked_sub(1)?;
        let [from, to] = [reading, after].map(|k| commands[k].bend);
        Some(Self { reading, share: ((bend - from) / (to - from)).clamp(0.0, 1.0) })
    }
}

/// What a clamp at an arc length (in units of L) adds to the innovations of the readings after it began.
fn added(moments: &[Moment], length: f64, place: f64, began: Beginning) -> Vec<[f64; 3]> {
    let Beginning { reading, share } = began;
    let [from, to] = [reading, reading + 1].map(|k| moments.get(k).map_or(0.0, |moment| moment.command.bend));
    let met = from + share * (to - from);
    let side = (to - from).signum();
    let mut response = Responses::<1>::default();
    let step = |moment: &Moment| {
        let bend = moment.command.bend;
        let off = if side * (bend - met) > 0.0 {
            (clamped_tip(place, met, bend) - free_tip(bend)) * length
        } else {
            crate::model::contact::Planar::zeros()
        };
        response.step(&moment.stage, &[[off.x], [off.y]]).map(|[axis]| axis)
    };
    moments.iter().skip(reading + 1).map(step).collect()
}

/// The least standard deviation (m) that an unbiased estimate of the place can have, at each reading after the contact
/// began: Cramér and Rao's bound, of place and beginning together, with the errors of the calibration unknown but for their
/// prior. Infinite while the readings cannot tell the two apart. For a clamp at `place` (m) on a segment `length` m long.
#[must_use]
pub fn place(moments: &[Moment], length: f64, place: f64, began: Beginning) -> Vec<f64> {
    let (h, dt) = (1e-5, 1e-3);
    let share = place / length;
    let by = |a: Vec<[f64; 3]>, b: Vec<[f64; 3]>, step: f64| -> Vec<[f64; 3]> {
        a.iter().zip(&b).map(|(a, b)| [0, 1, 2].map(|i| (b[i] - a[i]) / step)).collect()
    };
    let added = |place: f64, when: f64| added(moments, length, place, Beginning { share: began.share + when, ..began });
    let by_place = by(added(share - h, 0.0), added(share + h, 0.0), 2.0 * h * length);
    let by_time = by(added(share, 0.0), added(share, dt), dt);
    let mut information = Matrix2::<f64>::zeros();
    let bound = |(a, b): (&[f64; 3], &[f64; 3])| {
        let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        information += Matrix2::new(dot(a, a), dot(a, b), dot(a, b), dot(b, b));
        let left = information[(0, 0)] - information[(0, 1)] * information[(0, 1)] / information[(1, 1)];
        if left > 0.0 { 1.0 / sqrt(left) } else { f64::INFINITY }
    };
    by_place.iter().zip(&by_time).map(bound).collect()
}

/// How late the best of all tests is, which knows where and when the contact begins, and all errors of the calibration but those that
/// the filter takes out.
///
/// Of a test that alarms in a share α of all runs without contact, the alarms up to any reading are a test of that level. Neyman and
/// Pearson's is the most powerful one, and detects by then in a share Φ(D − z) of all runs with contact: D² is what the readings add
/// up to, z the deviation that a share α exceeds.
///
/// Gives the first reading after the contact by which `share` of the contacts can be detected: 1 for the first after `began`, 0 where no
/// reading is needed, none where all of them say too little.
#[must_use]
pub fn delay(
    moments: &[Moment],
    length: f64,
    (place, began): (f64, Beginning),
    rate: f64,
    share: f64,
) -> Option<usize> {
    let needed = exceeded(rate) + exceeded(1.0 - share);
    if needed <= 0.0 {
        return Some(0);
    }
    let mut square = 0.0;
    added(moments, length, place / length, began)
        .iter()
        .position(|w| {
            square += w.iter().map(|w| w * w).sum::<f64>();
            sqrt(square) >= needed
        })
        .map(|before| before + 1)
}

/// The standard normal deviation that a share exceeds.
fn exceeded(share: f64) -> f64 {
    let (mut low, mut high) = (-40.0, 40.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if 0.5 * erfc(middle * FRAC_1_SQRT_2) > share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::exceeded;

    #[test]
    fn deviations_are_those_of_tables() {
        for (share, z) in [(0.5, 0.0), (0.01, 2.326_348), (0.9, -1.281_552), (0.0025, 2.807_034)] {
            assert!((exceeded(share) - z).abs() < 1e-6, "{share}: {}", exceeded(share));
        }
    }
}
