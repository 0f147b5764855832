//! Which numbers of an axis are marked, and how they are written.

use super::notation::number;
use super::scale::Scale;
use libm::{asin, ceil, floor, log10, pow, round, sqrt};
use std::f64::consts::FRAC_PI_2;

/// One mark of an axis.
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
    /// Shares, on a [`Scale::shares`], written in percent.
    Shares,
    /// 1, 2 and 5 times powers of ten, on a [`Scale::log`].
    Log,
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
        let power = pow(10.0, floor(log10(least)));
        [1.0, 2.0, 5.0, 10.0]
            .map(|m| m * power)
            .into_iter()
            .find(|&step| step >= least * (1.0 - 1e-9))
            .unwrap_or(10.0 * power)
    }
}

/// Most marks of an axis, whatever its range.
const MOST: i64 = 200;

/// Round values of a scale at least `spacing` points apart, and how to write them.
#[must_use]
pub fn ticks(scale: &Scale, spacing: f64, steps: Steps) -> Vec<Tick> {
    if steps == Steps::Shares {
        let tick = |percent: u8| Tick { value: f64::from(percent) / 100.0, text: percent.to_string() };
        return percents(spacing / scale.length().max(1.0)).into_iter().map(tick).collect();
    }
    if steps == Steps::Log {
        return powers(scale, spacing);
    }
    let [low, high] = scale.range();
    let most = (scale.length() / spacing).max(1.0);
    let step = steps.step((high - low) / most);
    let decimals = decimals(step);
    let slack = 1e-9 * step;
    let first = ceil((low - slack) / step) as i64;
    let last = floor((high + slack) / step) as i64;
    let tick = |k: i64| Tick { value: k as f64 * step, text: number(k as f64 * step, decimals) };
    (first..=last.min(first.saturating_add(MOST))).map(tick).collect()
}

/// Powers of ten with as many of 2 and 5 times them as keep their distance.
fn powers(scale: &Scale, spacing: f64) -> Vec<Tick> {
    let [low, high] = scale.range();
    let (first, last) = (floor(log10(low)) as i32, ceil(log10(high)) as i32);
    let mut marks: Vec<Tick> = Vec::new();
    for factor in [1.0, 2.0, 5.0] {
        for power in first..=last {
            let value = factor * pow(10.0, f64::from(power));
            let inside = (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(&value);
            let apart = |mark: &Tick| (scale.at(mark.value) - scale.at(value)).abs() >= spacing;
            if inside && marks.iter().all(apart) {
                marks.push(Tick { value, text: number(value, (-power).clamp(0, 9) as usize) });
            }
        }
    }
    marks.sort_by(|a, b| a.value.total_cmp(&b.value));
    marks
}

/// Decimals that show a step of this size.
#[must_use]
pub fn decimals(step: f64) -> usize {
    (-floor(log10(step)) + if step >= 1.0 { -1.0 } else { 0.0 }).clamp(0.0, 9.0) as usize
}

/// `value` rounded to the power of ten that is nearest below what one point shows.
#[must_use]
pub fn rounded(value: f64, per_point: f64) -> f64 {
    let inverse = pow(10.0, -floor(log10(per_point)));
    round(value * inverse) / inverse
}

/// Where a share lies on an arcsine scale, from 0 to 1: intervals from equally many runs are about equally wide there,
/// and both ends are spread.
#[must_use]
pub fn spread(share: f64) -> f64 {
    asin(sqrt(share.clamp(0.0, 1.0))) / FRAC_PI_2
}

/// Percentages worth marking on such a scale, those that matter most first.
const PERCENTS: [u8; 13] = [0, 100, 50, 5, 95, 20, 80, 1, 99, 10, 90, 35, 65];

/// Percentages for a scale on which marks are to be at least `apart` from each other, as a share of its length.
#[must_use]
pub fn percents(apart: f64) -> Vec<u8> {
    let mut marks: Vec<u8> = Vec::new();
    for percent in PERCENTS {
        let at = |percent: u8| spread(f64::from(percent) / 100.0);
        if marks.iter().all(|&mark| (at(mark) - at(percent)).abs() >= apart) {
            marks.push(percent);
        }
    }
    marks.sort_unstable();
    marks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(range: [f64; 2], points: f64, spacing: f64, steps: Steps) -> Vec<String> {
        ticks(&Scale::new(range, [0.0, points]), spacing, steps).into_iter().map(|tick| tick.text).collect()
    }

    #[test]
    fn ticks_are_round_and_keep_their_distance() {
        assert_eq!(texts([0.0, 10.0], 300.0, 50.0, Steps::Decimal), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(texts([0.0, 0.6], 100.0, 30.0, Steps::Decimal), ["0.0", "0.2", "0.4", "0.6"]);
        assert_eq!(texts([-5.0, 95.0], 100.0, 25.0, Steps::Degrees), ["0", "30", "60", "90"]);
        assert_eq!(texts([-15.0, 12.0], 100.0, 30.0, Steps::Decimal), ["−10", "0", "10"]);
        for span in [0.013, 0.7, 3.0, 49.0, 12_345.0] {
            let scale = Scale::new([0.0, span], [0.0, 400.0]);
            let ticks = ticks(&scale, 40.0, Steps::Decimal);
            assert!((2..=11).contains(&ticks.len()), "{span}: {ticks:?}");
            assert!(ticks.windows(2).all(|pair| scale.at(pair[1].value) - scale.at(pair[0].value) >= 39.9));
        }
    }

    #[test]
    fn an_axis_of_powers_marks_ones_twos_and_fives_as_far_as_they_keep_their_distance() {
        let texts = |points: f64| -> Vec<String> {
            let scale = Scale::log([0.01, 3.0], [0.0, points]);
            ticks(&scale, 20.0, Steps::Log).into_iter().map(|tick| tick.text).collect()
        };
        assert_eq!(texts(300.0), ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1", "2"]);
        assert_eq!(texts(80.0), ["0.01", "0.1", "1"]);
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

    #[test]
    fn an_axis_of_shares_marks_both_ends_and_crowds_none() {
        assert_eq!(percents(0.2), [0, 20, 50, 80, 100]);
        assert_eq!(percents(0.0).len(), PERCENTS.len());
        assert_eq!([0.0, 0.5, 1.0].map(spread).map(|x| (x * 1e12).round() / 1e12), [0.0, 0.5, 1.0]);
        assert!(percents(0.05).windows(2).all(|pair| pair[0] < pair[1]));
        let scale = Scale::shares(0.04, [0.0, 300.0]);
        let ticks = ticks(&scale, 26.0, Steps::Shares);
        assert!(
            ticks.len() > 5 && ticks.windows(2).all(|pair| scale.at(pair[1].value) - scale.at(pair[0].value) > 22.0)
        );
    }
}
