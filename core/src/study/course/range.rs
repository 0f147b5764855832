//! How high a plot reaches: the interesting part fills it, and the rest is said to be off the scale.

use libm::{floor, log10, pow, round};

/// The plot reaches at least this many times its threshold, so that the line can be dragged upward.
const HEADROOM: f64 = 1.6;
/// Share of the values that should lie inside.
const INSIDE: f64 = 0.98;
/// Never more than this many thresholds or medians, whichever is more: noise may not flatten the plot.
const MOST: f64 = 4.0;
/// More values than this are thinned before they are sorted.
const ENOUGH: usize = 4096;

/// Top of a plot from 0 that judges `values` by `threshold`, a round number.
///
/// Robust: a value far above the others does not change it.
#[must_use]
pub fn top(threshold: f64, values: &mut Vec<f64>) -> f64 {
    values.retain(|value| value.is_finite());
    if values.len() > ENOUGH {
        let stride = values.len().div_ceil(ENOUGH);
        let mut k = 0;
        values.retain(|_| {
            k += 1;
            k % stride == 0
        });
    }
    let most = MOST * threshold.max(quantile(values, 0.5).unwrap_or(0.0));
    let inside = 1.1 * quantile(values, INSIDE).unwrap_or(0.0);
    let top = (HEADROOM * threshold).max(if most > 0.0 { inside.min(most) } else { inside });
    if top > 0.0 { round_up(top) } else { 1.0 }
}

/// The value below which this share of the values lies.
#[must_use]
pub fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let k = round(last as f64 * share) as usize;
    Some(*values.select_nth_unstable_by(k.min(last), f64::total_cmp).1)
}

/// The next round number: coarse enough that a small change of a setting seldom changes it.
#[must_use]
pub fn round_up(value: f64) -> f64 {
    let power = pow(10.0, floor(log10(value)));
    let round = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    round.map(|m| m * power).into_iter().find(|&r| r >= value * (1.0 - 1e-9)).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_wild_values_do_not_flatten_the_plot() {
        let mut values: Vec<f64> = (0..3000).map(|k| 4.0 + f64::from(k % 7) * 0.5).collect();
        let calm = top(7.0, &mut values.clone());
        values.extend([1e6, 1e9, f64::INFINITY, f64::NAN]);
        assert_eq!(top(7.0, &mut values), calm);
        assert_eq!(calm, 12.0);
    }

    #[test]
    fn a_threshold_far_above_the_values_is_inside() {
        assert_eq!(top(50.0, &mut vec![1.0, 2.0]), 80.0);
    }

    #[test]
    fn values_above_the_threshold_are_shown() {
        assert_eq!(top(1.0, &mut vec![3.0; 100]), 4.0);
    }

    #[test]
    fn noise_everywhere_is_cut() {
        let mut values: Vec<f64> = (1..=1000).map(|k| 7000.0 / f64::from(k)).collect();
        assert!(top(7.0, &mut values) <= 80.0);
    }

    #[test]
    fn nothing_to_show_still_has_a_range() {
        assert_eq!(top(0.0, &mut Vec::new()), 1.0);
        assert_eq!(top(0.0, &mut vec![f64::NAN]), 1.0);
        assert_eq!(top(7.0, &mut Vec::new()), 12.0);
    }

    #[test]
    fn rounding_up_is_round() {
        for (value, round) in [(11.2, 12.0), (0.048, 0.05), (1.0, 1.0), (8.1, 10.0), (95.0, 100.0)] {
            assert!((round_up(value) - round).abs() < 1e-12, "{value}");
        }
    }
}
