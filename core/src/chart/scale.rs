//! Values to places along an axis, and back.

use super::ticks::spread;
use libm::{exp, log, sin};
use std::f64::consts::FRAC_PI_2;

/// How values lie along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spacing {
    /// Evenly.
    #[default]
    Even,
    /// Shares from 0 to 1 on an arcsine scale: both ends are spread, and intervals from equally many runs are about equally
    /// wide everywhere.
    Arcsine,
    /// By their logarithms: equal ratios are equally far apart.
    Log,
}

/// Maps the values of an axis to places, in points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    spacing: Spacing,
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// An even scale: `low` lies at `from`, `high` at `to`. An empty range is widened, so that every value has a place.
    #[must_use]
    pub fn new([low, high]: [f64; 2], [from, to]: [f64; 2]) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Self { spacing: Spacing::Even, low, high, from, to }
    }

    /// An arcsine scale of the shares from 0 to 1, with a margin at both ends as a share of its length.
    #[must_use]
    pub fn shares(margin: f64, [from, to]: [f64; 2]) -> Self {
        Self { spacing: Spacing::Arcsine, low: -margin, high: 1.0 + margin, from, to }
    }

    /// A logarithmic scale: `low` lies at `from`, `high` at `to`, both above 0. An empty range, or one that reaches to 0, is widened
    /// or cut to three powers of ten.
    #[must_use]
    pub fn log([low, high]: [f64; 2], ends: [f64; 2]) -> Self {
        let high = if high > 0.0 { high } else { 1.0 };
        let low = if low > 0.0 && low < high { low } else { 1e-3 * high };
        Self { spacing: Spacing::Log, ..Self::new([log(low), log(high)], ends) }
    }

    /// Both ends of the range; those of an arcsine scale are 0 and 1.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        match self.spacing {
            Spacing::Even => [self.low, self.high],
            Spacing::Arcsine => [0.0, 1.0],
            Spacing::Log => [exp(self.low), exp(self.high)],
        }
    }

    /// Length of the scale, points.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }

    /// Value per point of an even scale, positive.
    #[must_use]
    pub fn per_point(&self) -> f64 {
        (self.high - self.low) / self.length().max(1.0)
    }

    /// Where a value lies; values far outside stay within one span of the range, so that painting stays well-conditioned.
    #[must_use]
    pub fn at(&self, value: f64) -> f64 {
        let value = match self.spacing {
            Spacing::Even => value,
            Spacing::Arcsine => spread(value),
            Spacing::Log => log(value.max(f64::MIN_POSITIVE)),
        };
        let share = ((value - self.low) / (self.high - self.low)).clamp(-1.0, 2.0);
        self.from + (self.to - self.from) * share
    }

    /// The value at a place, within the range.
    #[must_use]
    pub fn value(&self, place: f64) -> f64 {
        let [low, high] = self.range();
        self.unbounded(place).clamp(low, high)
    }

    /// The value at a place, within the range or not.
    #[must_use]
    pub fn unbounded(&self, place: f64) -> f64 {
        let share = (place - self.from) / (self.to - self.from);
        let value = self.low + (self.high - self.low) * share;
        match self.spacing {
            Spacing::Even => value,
            Spacing::Arcsine => {
                let root = sin(FRAC_PI_2 * value.clamp(0.0, 1.0));
                root * root
            }
            Spacing::Log => exp(value),
        }
    }

    /// Whether the range holds a value.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        let [low, high] = self.range();
        (low..=high).contains(&value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_places_are_inverse() {
        let even = Scale::new([-2.0, 12.0], [300.0, 20.0]);
        let shares = Scale::shares(0.04, [10.0, 210.0]);
        let log = Scale::log([0.01, 2.0], [100.0, 0.0]);
        for (scale, values) in
            [(even, [-2.0, 0.0, 3.3, 12.0]), (shares, [0.0, 0.05, 0.5, 1.0]), (log, [0.01, 0.03, 1.0, 2.0])]
        {
            assert!(values.into_iter().all(|value| (scale.value(scale.at(value)) - value).abs() < 1e-12), "{scale:?}");
        }
        assert_eq!(even.at(-2.0), 300.0);
        assert_eq!(even.at(1e300), 20.0 - 280.0);
        assert_eq!(shares.value(1e9), 1.0);
        let decades = [0.01, 0.1, 1.0].map(|value| log.at(value));
        assert!((decades[0] - 2.0 * decades[1] + decades[2]).abs() < 1e-9, "equal ratios are equally far apart");
        assert!(Scale::log([0.0, 0.0], [0.0, 1.0]).range()[0] > 0.0);
    }

    #[test]
    fn an_empty_range_still_maps() {
        let scale = Scale::new([5.0, 5.0], [0.0, 10.0]);
        assert!(scale.at(5.0).is_finite() && scale.value(3.0).is_finite());
    }
}
