//! Shares of a count, with the interval that belongs to them.

use libm::sqrt;
use serde::Serialize;

/// Two-sided 95 % of a normal law.
pub const Z: f64 = 1.959_963_984_540_054;

/// How often something happened, with its 95 % interval (Wilson's score interval).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Share {
    /// Times it happened.
    pub count: u64,
    /// Times it could have.
    pub of: u64,
    /// The share; NaN of none.
    pub rate: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl Share {
    /// `count` of `of`. Of none, the share is not defined and may be anything from 0 to 1.
    #[must_use]
    pub fn new(count: u64, of: u64) -> Self {
        if of == 0 {
            return Self { count, of, rate: f64::NAN, low: 0.0, high: 1.0 };
        }
        let rate = count as f64 / of as f64;
        let [low, high] = wilson(rate, of as f64);
        // The ends are known exactly where nothing or everything happened; roundings must not blur them.
        Self { count, of, rate, low: if count == 0 { 0.0 } else { low }, high: if count == of { 1.0 } else { high } }
    }
}

/// Wilson's interval about a share of `of`.
#[must_use]
pub fn wilson(share: f64, of: f64) -> [f64; 2] {
    let square = Z * Z / of;
    let middle = share + 0.5 * square;
    let half = Z * sqrt(share * (1.0 - share) / of + 0.25 * square / of);
    [(middle - half) / (1.0 + square), (middle + half) / (1.0 + square)]
}

/// The fewest runs that can show, by having no alarm in any, that a rate is at most `rate` (above 0).
#[must_use]
pub fn runs_to_show(rate: f64) -> u64 {
    libm::ceil(Z * Z * (1.0 - rate) / rate) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_those_of_the_tables() {
        // Wilson's intervals for 0 of 10, 5 of 10 and 81 of 263, as statistics packages print them.
        for (count, of, low, high) in [(0, 10, 0.0, 0.2775), (5, 10, 0.2366, 0.7634), (81, 263, 0.2553, 0.3662)] {
            let rate = Share::new(count, of);
            assert!((rate.low - low).abs() < 5e-5 && (rate.high - high).abs() < 5e-5, "{rate:?}");
        }
        assert_eq!((Share::new(10, 10).high, Share::new(0, 10).low), (1.0, 0.0));
        assert!(Share::new(0, 0).rate.is_nan());
    }

    #[test]
    fn an_interval_covers_the_truth_as_often_as_it_says() {
        // Every outcome of 50 draws with its binomial probability.
        for truth in [0.03, 0.2, 0.5, 0.9] {
            let of = 50u64;
            let mut probability = libm::pow(1.0 - truth, of as f64);
            let mut covered = 0.0;
            for count in 0..=of {
                let rate = Share::new(count, of);
                if (rate.low..=rate.high).contains(&truth) {
                    covered += probability;
                }
                probability *= truth / (1.0 - truth) * (of - count) as f64 / (count + 1) as f64;
            }
            assert!((0.91..=0.99).contains(&covered), "{truth}: {covered}");
        }
    }

    #[test]
    fn so_many_silent_runs_show_a_rate_and_one_less_does_not() {
        for rate in [0.5, 0.05, 0.01, 0.001] {
            let runs = runs_to_show(rate);
            assert!(Share::new(0, runs).high <= rate && Share::new(0, runs - 1).high > rate, "{rate}: {runs}");
        }
    }
}
