//! What disturbs the tracker's readings: noise, white or coloured, and a slow drift.

use crate::model::Vec3;
use crate::noise::{Normal, Source};
use crate::scenario::Calibration;
use libm::{exp, expm1, sqrt};

/// Noise of a stationary autoregressive process of the first order, reading by reading; white for a correlation of 0.
#[derive(Debug, Clone)]
pub struct Coloured {
    draws: Normal,
    correlation: f64,
    /// The last of position and of orientation, in standard deviations.
    last: [Option<Vec3>; 2],
}

impl Coloured {
    /// The tracker's noise under a seed, with this correlation from reading to reading, in [0, 1).
    #[must_use]
    pub fn new(seed: u64, correlation: f64) -> Self {
        Self { draws: Normal::new(seed, Source::Tracker), correlation, last: [None; 2] }
    }

    /// The next of the position, of this standard deviation (m). Without noise nothing is drawn.
    pub fn position(&mut self, deviation: f64) -> Vec3 {
        self.next(0, deviation)
    }

    /// The next of the orientation, of this standard deviation (rad) about each axis.
    pub fn orientation(&mut self, deviation: f64) -> Vec3 {
        self.next(1, deviation)
    }

    fn next(&mut self, kind: usize, deviation: f64) -> Vec3 {
        if deviation <= 0.0 {
            return Vec3::zeros();
        }
        let fresh = Vec3::from_fn(|_, _| self.draws.draw());
        if self.correlation == 0.0 {
            return deviation * fresh;
        }
        let now = stationary(self.last[kind], self.correlation, 1.0 - self.correlation * self.correlation, fresh);
        self.last[kind] = Some(now);
        deviation * now
    }
}

/// A Gauss–Markov (Ornstein–Uhlenbeck) offset of the position.
#[derive(Debug, Clone)]
pub struct Drift {
    draws: Normal,
    /// Standard deviation, m.
    size: f64,
    /// Correlation time, s.
    time: f64,
    /// When it was asked for last (s), and what it was then, in standard deviations.
    last: Option<(f64, Vec3)>,
}

impl Drift {
    /// The drift of a scenario's tracker under a seed.
    #[must_use]
    pub fn new(seed: u64, calibration: &Calibration) -> Self {
        let Calibration { drift, drift_time, .. } = *calibration;
        Self { draws: Normal::new(seed, Source::Drift), size: drift, time: drift_time, last: None }
    }

    /// The offset at `time` (s), which is not before the last one asked for, m; none where nothing drifts.
    pub fn at(&mut self, time: f64) -> Option<Vec3> {
        if self.size <= 0.0 {
            return None;
        }
        let fresh = Vec3::from_fn(|_, _| self.draws.draw());
        let since = self.last.map_or(f64::INFINITY, |(last, _)| time - last) / self.time;
        let now = stationary(self.last.map(|(_, before)| before), exp(-since), -expm1(-2.0 * since), fresh);
        self.last = Some((time, now));
        Some(self.size * now)
    }
}

/// One step of a stationary process of variance 1: what is left of the value before, and `renewed`, the variance of what is new.
fn stationary(before: Option<Vec3>, correlation: f64, renewed: f64, fresh: Vec3) -> Vec3 {
    before.map_or(fresh, |before| before * correlation + fresh * sqrt(renewed))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean square and mean product with the value `lag` later, per axis, over all of a sequence.
    fn moments(values: &[Vec3], lag: usize) -> (Vec3, Vec3) {
        let mean = |pairs: Vec<Vec3>| pairs.iter().sum::<Vec3>() / pairs.len() as f64;
        let squares = mean(values.iter().map(|x| x.component_mul(x)).collect());
        (squares, mean(values.iter().zip(&values[lag..]).map(|(x, y)| x.component_mul(y)).collect()))
    }

    #[test]
    fn coloured_noise_has_its_standard_deviation_and_correlation() {
        for correlation in [0.0, 0.5, 0.9] {
            let mut noise = Coloured::new(3, correlation);
            let mut both = [const { Vec::new() }; 2];
            for _ in 0..100_000 {
                both[0].push(noise.position(2.0));
                both[1].push(noise.orientation(0.5));
            }
            for (values, size) in both.iter().zip([2.0_f64, 0.5]) {
                let (squares, products) = moments(values, 1);
                // Four standard errors of the variance: √(2(1 + ρ²)/(1 − ρ²)/n).
                let error =
                    4.0 * sqrt(2.0 * (1.0 + correlation * correlation) / (1.0 - correlation * correlation) / 1e5);
                for axis in 0..3 {
                    let (variance, product) = (squares[axis] / (size * size), products[axis] / (size * size));
                    assert!((variance - 1.0).abs() < error, "ρ = {correlation}: variance {variance}");
                    assert!((product - correlation).abs() < error, "ρ = {correlation}: {product}");
                }
            }
            // The two are independent of each other.
            let cross = both[0].iter().zip(&both[1]).map(|(x, y)| x.dot(y)).sum::<f64>() / 3e5;
            assert!(cross.abs() < 4.0 / sqrt(3e5 * (1.0 - correlation * correlation) / 2.0), "{cross}");
        }
    }

    #[test]
    fn drift_has_its_standard_deviation_and_its_time() {
        let calibration = Calibration { drift: 0.002, drift_time: 0.5, ..Calibration::default() };
        let mut drift = Drift::new(9, &calibration);
        let values: Vec<Vec3> = (0..200_000).map(|k| drift.at(f64::from(k) * 0.01).expect("drifts") / 0.002).collect();
        for lag in [0, 10, 50, 100] {
            let (_, products) = moments(&values, lag);
            let expected = exp(-0.01 * lag as f64 / 0.5);
            // 200 000 readings hold some 4000 independent ones: 2·0.5 s / 0.01 s readings make one.
            for axis in 0..3 {
                assert!(
                    (products[axis] - expected).abs() < 4.0 * sqrt(2.0 / 4000.0),
                    "{lag}: {} {expected}",
                    products[axis]
                );
            }
        }
        assert_eq!(Drift::new(9, &Calibration::default()).at(0.0), None);
    }
}
