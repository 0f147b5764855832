//! What no detector and no estimator can do better with the same readings.

use super::course::Moment;
use super::filter::Responses;
use crate::model::contact::{clamped_tip, free_tip};
use crate::noise::{Normal, Source};
use libm::sqrt;
use nalgebra::Matrix2;

/// What a clamp at an arc length (in units of L), begun at the bend of the reading `began` and some of the way to the next, adds to the
/// innovations of the readings after it.
fn added(moments: &[Moment], length: f64, place: f64, began: usize, share: f64) -> Vec<[f64; 3]> {
    let [from, to] = [began, began + 1].map(|k| moments.get(k).map_or(0.0, |moment| moment.command.bend));
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
    moments.iter().skip(began + 1).map(step).collect()
}

/// The least standard deviation (m) that an unbiased estimate of the place can have, at each reading after the contact began at the
/// reading `began`: Cramér and Rao's bound, of place and beginning together, with the errors of the calibration unknown but for their
/// prior. Infinite while the readings cannot tell the two apart. For a clamp at `place` (m) on a segment `length` m long.
#[must_use]
pub fn place(moments: &[Moment], length: f64, place: f64, began: usize) -> Vec<f64> {
    let (h, dt) = (1e-5, 1e-3);
    let share = place / length;
    let by = |a: Vec<[f64; 3]>, b: Vec<[f64; 3]>, step: f64| -> Vec<[f64; 3]> {
        a.iter().zip(&b).map(|(a, b)| [0, 1, 2].map(|i| (b[i] - a[i]) / step)).collect()
    };
    let added = |place: f64, when: f64| added(moments, length, place, began, when);
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

/// How late the best of all tests is, which knows where and when the contact begins: Neyman and Pearson's, at a false-alarm rate.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Delays {
    /// Threshold of its log likelihood ratio.
    pub threshold: f64,
    /// Readings from the contact to the alarm, in rising order; `usize::MAX` where there is none.
    pub readings: Vec<usize>,
}

impl Delays {
    /// By drawing `runs` runs without and as many with a contact at `place` (m), from a seed. `rate` is the share of runs without
    /// contact in which it may alarm.
    #[must_use]
    pub fn drawn(
        moments: &[Moment],
        length: f64,
        (place, began): (f64, usize),
        rate: f64,
        runs: usize,
        seed: u64,
    ) -> Self {
        let added = added(moments, length, place / length, began, 0.0);
        let mut normal = Normal::new(seed, Source::Bound);
        let mut steps = |sign: f64| -> Vec<f64> {
            let mut sum = 0.0;
            added
                .iter()
                .map(|w| {
                    let square: f64 = w.iter().map(|w| w * w).sum();
                    sum += sqrt(square) * normal.draw() + sign * 0.5 * square;
                    sum
                })
                .collect()
        };
        let mut most: Vec<f64> = (0..runs).map(|_| steps(-1.0).into_iter().fold(f64::NEG_INFINITY, f64::max)).collect();
        most.sort_by(|a, b| b.total_cmp(a));
        let threshold = most.get((rate * runs as f64) as usize).copied().unwrap_or(0.0);
        let mut readings: Vec<usize> = (0..runs)
            .map(|_| steps(1.0).iter().position(|sum| *sum > threshold).map_or(usize::MAX, |k| k + 1))
            .collect();
        readings.sort_unstable();
        Self { threshold, readings }
    }
}
