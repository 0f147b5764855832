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
    pub fn drawn(moments: &[Moment], length: f64, contact: (f64, usize), rate: f64, runs: usize, seed: u64) -> Self {
        let mut drawing = Drawing::new(moments, length, contact, (rate, runs), seed);
        drawing.draw(usize::MAX);
        drawing.delays()
    }
}

/// Delays being drawn, some runs at a time.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// What each reading adds to the log likelihood ratio: its deviation, and half its square.
    steps: Vec<[f64; 2]>,
    normal: Normal,
    rate: f64,
    runs: usize,
    /// The largest ratio of each run without contact so far; falling once all are drawn.
    most: Vec<f64>,
    readings: Vec<usize>,
}

impl Drawing {
    /// As [`Delays::drawn`] has it, before the first of so many runs.
    #[must_use]
    pub fn new(
        moments: &[Moment],
        length: f64,
        (place, began): (f64, usize),
        (rate, runs): (f64, usize),
        seed: u64,
    ) -> Self {
        let step = |w: &[f64; 3]| {
            let square: f64 = w.iter().map(|w| w * w).sum();
            [sqrt(square), 0.5 * square]
        };
        let steps = added(moments, length, place / length, began, 0.0).iter().map(step).collect();
        Self { steps, normal: Normal::new(seed, Source::Bound), rate, runs, most: Vec::new(), readings: Vec::new() }
    }

    /// Draws so many runs more, or all that are left; returns whether none are.
    pub fn draw(&mut self, runs: usize) -> bool {
        for _ in 0..runs {
            if self.most.len() < self.runs {
                self.free();
            } else if self.readings.len() < self.runs {
                self.held();
            } else {
                break;
            }
        }
        self.readings.len() >= self.runs
    }

    fn free(&mut self) {
        let (mut sum, mut most) = (0.0, f64::NEG_INFINITY);
        for [deviation, half] in &self.steps {
            sum += deviation * self.normal.draw() - half;
            most = f64::max(most, sum);
        }
        self.most.push(most);
        if self.most.len() == self.runs {
            self.most.sort_by(|a, b| b.total_cmp(a));
        }
    }

    fn held(&mut self) {
        let threshold = self.threshold();
        let (mut sum, mut first) = (0.0, usize::MAX);
        for (k, [deviation, half]) in self.steps.iter().enumerate() {
            sum += deviation * self.normal.draw() + half;
            if first == usize::MAX && sum > threshold {
                first = k + 1;
            }
        }
        self.readings.push(first);
    }

    fn threshold(&self) -> f64 {
        self.most.get((self.rate * self.runs as f64) as usize).copied().unwrap_or(0.0)
    }

    /// What was drawn comes to.
    #[must_use]
    pub fn delays(mut self) -> Delays {
        self.readings.sort_unstable();
        Delays { threshold: self.threshold(), readings: self.readings }
    }
}
