//! A linear axis: values to points, and ticks that are round numbers.

use crate::app::charts::notation::number;

/// Maps values to points of the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    low: f64,
    high: f64,
    from: f32,
    to: f32,
}

impl Axis {
    /// `low` lies at `from`, `high` at `to` (points). An empty range is widened, so that every value has a place.
    #[must_use]
    pub fn new([low, high]: [f64; 2], [from, to]: [f32; 2]) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Self { low, high, from, to }
    }

    /// Both ends of the range.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Value per point, positive.
    #[must_use]
    pub fn per_point(&self) -> f64 {
        (self.high - self.low) / f64::from((self.to - self.from).abs().max(1.0))
    }

    /// Where a value lies; values far outside stay within one span of the range, so that painting stays well-conditioned.
    #[must_use]
    pub fn at(&self, value: f64) -> f32 {
        let share = ((value - self.low) / (self.high - self.low)).clamp(-1.0, 2.0);
        self.from + (self.to - self.from) * share as f32
    }

    /// The value at a point, within the range.
    #[must_use]
    pub fn value(&self, point: f32) -> f64 {
        self.unbounded(point).clamp(self.low, self.high)
    }

    /// The value at a point, within the range or not.
    #[must_use]
    pub fn unbounded(&self, point: f32) -> f64 {
        let share = f64::from((point - self.from) / (self.to - self.from));
        self.low + (self.high - self.low) * share
    }

    /// Whether the range holds a value.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// Round values at least `spacing` points apart, and how to write them.
    #[must_use]
    pub fn ticks(&self, spacing: f32, steps: Steps) -> Vec<Tick> {
        let most = ((self.to - self.from).abs() / spacing).max(1.0);
        let step = steps.step((self.high - self.low) / f64::from(most));
        let decimals = decimals(step);
        let slack = 1e-9 * step;
        let first = ((self.low - slack) / step).ceil() as i64;
        let last = ((self.high + slack) / step).floor() as i64;
        (first..=last)
            .map(|k| {
                let value = k as f64 * step;
                Tick { value, text: number(value, decimals) }
            })
            .collect()
    }
}

/// One tick of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Its value.
    pub value: f64,
    /// The value as text.
    pub text: String,
}

/// Which steps count as round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Steps {
    /// 1, 2 and 5 times a power of ten.
    Decimal,
    /// Parts of a turn in degrees: 15, 30, 45, 90, 180; below them as [`Steps::Decimal`].
    Degrees,
}

impl Steps {
    /// The smallest round step not below `least`.
    #[must_use]
    pub fn step(self, least: f64) -> f64 {
        if self == Self::Degrees
            && least > 10.0
            && let Some(step) = [15.0, 30.0, 45.0, 90.0, 180.0, 360.0].into_iter().find(|&step| step >= least)
        {
            return step;
        }
        let power = 10f64.powf(least.log10().floor());
        [1.0, 2.0, 5.0, 10.0]
            .map(|m| m * power)
            .into_iter()
            .find(|&step| step >= least * (1.0 - 1e-9))
            .unwrap_or(10.0 * power)
    }
}

/// Decimals that show a step of this size.
#[must_use]
pub fn decimals(step: f64) -> usize {
    (-step.log10().floor() + if step >= 1.0 { -1.0 } else { 0.0 }).clamp(0.0, 9.0) as usize
}

/// `value` rounded to the power of ten that is nearest below what one point shows.
#[must_use]
pub fn rounded(value: f64, per_point: f64) -> f64 {
    let inverse = 10f64.powf(-per_point.log10().floor());
    (value * inverse).round() / inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(range: [f64; 2], points: f32, spacing: f32, steps: Steps) -> Vec<String> {
        Axis::new(range, [0.0, points]).ticks(spacing, steps).into_iter().map(|tick| tick.text).collect()
    }

    #[test]
    fn values_and_points_are_inverse() {
        let axis = Axis::new([-2.0, 12.0], [300.0, 20.0]);
        for value in [-2.0, 0.0, 3.3, 12.0] {
            assert!((axis.value(axis.at(value)) - value).abs() < 1e-5);
        }
        assert_eq!(axis.at(-2.0), 300.0);
        assert_eq!(axis.at(1e300), 20.0 - 280.0);
    }

    #[test]
    fn an_empty_range_still_maps() {
        let axis = Axis::new([5.0, 5.0], [0.0, 10.0]);
        assert!(axis.at(5.0).is_finite() && axis.value(3.0).is_finite());
    }

    #[test]
    fn ticks_are_round_and_keep_their_distance() {
        assert_eq!(texts([0.0, 10.0], 300.0, 50.0, Steps::Decimal), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(texts([0.0, 0.6], 100.0, 30.0, Steps::Decimal), ["0.0", "0.2", "0.4", "0.6"]);
        assert_eq!(texts([-5.0, 95.0], 100.0, 25.0, Steps::Degrees), ["0", "30", "60", "90"]);
        assert_eq!(texts([-15.0, 12.0], 100.0, 30.0, Steps::Decimal), ["−10", "0", "10"]);
        for span in [0.013, 0.7, 3.0, 49.0, 12_345.0] {
            let axis = Axis::new([0.0, span], [0.0, 400.0]);
            let ticks = axis.ticks(40.0, Steps::Decimal);
            assert!((2..=11).contains(&ticks.len()), "{span}: {ticks:?}");
            assert!(ticks.windows(2).all(|pair| axis.at(pair[1].value) - axis.at(pair[0].value) >= 39.9));
        }
    }

    #[test]
    fn steps_show_their_decimals() {
        assert_eq!([0.01, 0.2, 1.0, 5.0, 20.0].map(decimals), [2, 1, 0, 0, 0]);
    }

    #[test]
    fn dragging_gives_round_values() {
        assert_eq!(rounded(7.0384, 0.08), 7.04);
        assert_eq!(rounded(33.72, 1.2), 34.0);
    }
}
