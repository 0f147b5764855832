//! When contact is found at each place: a histogram of the delays in a lane of its own, with those that alarm before and those
//! missed.

use super::look;
use crate::chart::notation::number;
use crate::chart::{Aside, Axis, Bars, Intervals, Panel, Role, Vertical};
use crate::study::tuning::Study;
use crate::study::tuning::tally::{Count, Found};
use crate::study::tuning::watch::Rule;

/// Bars over the delays that are in time.
const BARS: usize = 50;
/// The foot of a lane's bars below its middle, the highest bar above its foot, and the median's interval, in heights of a lane.
const FOOT: f64 = 0.46;
const HIGH: f64 = 0.72;
const MEDIAN: f64 = -0.38;

/// A lane for each of the `places`, which are names of contacts with their cells: how many of them a rule finds when, with a
/// threshold (SI); none while it is switched off. Delays reach to `late`, s. A line marks the `median` delay (s) of the contact that is
/// set, where there is one.
///
/// # Panics
/// When there is no such cell.
#[must_use]
pub fn places(
    study: &Study,
    places: &[(String, usize)],
    (rule, threshold): (Rule, Option<f64>),
    median: Option<f64>,
    late: f64,
) -> Panel {
    let x = Axis { range: Some([0.0, late]), ..Axis::new("Delay after contact", "s", "s", 1.0) };
    let y = Axis::categories("", places.iter().map(|(name, _)| name.clone()), true);
    let mut panel = Panel { title: "Delay by place of contact".into(), ..Panel::new(x, y) };
    let (mut corners, mut medians) = (Vec::new(), Vec::new());
    for (k, (_, cell)) in places.iter().enumerate() {
        let (Some(held), Some(threshold)) = (study.cells()[*cell].held, threshold) else { continue };
        // Cells share their thresholds, but for an own one that only some have.
        let Some(level) = study.levels(*cell, rule).iter().position(|&other| other == threshold) else { continue };
        let batch = &study.batches()[held];
        let lane = k as f64;
        corners.extend(bars(batch.counted(rule, level).count, batch.clock.rate, late, lane + FOOT));
        let Some(seen) = study.point(*cell, rule, level).detection.filter(|seen| seen.early.of > 0) else { continue };
        let at = |delay: f64| [delay, lane + MEDIAN];
        if !seen.median.is_nan() {
            // An interval that is open at its upper end reaches to the end of the axis.
            let high = if seen.median_high.is_nan() { late } else { seen.median_high };
            medians.push([at(seen.median_low), at(seen.median), at(high)]);
        }
        panel.asides.push(Aside { y: lane, lines: words(&seen) });
    }
    let role = look(rule).0;
    panel.bars.push(Bars { name: String::new(), role, corners });
    if !medians.is_empty() {
        panel.intervals.push(Intervals { name: String::new(), role: Role::Bound, ends: medians });
    }
    panel.verticals.extend(median.map(|x| Vertical { name: "", x, role: Role::Detection }));
    panel
}

/// How many contacts are found within each bar, as corners above a foot; the most frequent delay is the highest.
fn bars(count: &Count, rate: f64, late: f64, foot: f64) -> Vec<[[f64; 2]; 2]> {
    let mut bars = [0u32; BARS];
    for &(delay, runs) in &count.found {
        let bar = f64::from(delay) / rate / late * BARS as f64;
        bars[(bar as usize).min(BARS - 1)] += runs;
    }
    let most = f64::from(bars.iter().copied().max().unwrap_or(0).max(1));
    let wide = late / BARS as f64;
    let bar = |(k, runs): (usize, u32)| {
        let left = wide * k as f64;
        [[left, foot], [left + wide, foot - HIGH * f64::from(runs) / most]]
    };
    bars.into_iter().enumerate().filter(|(_, runs)| *runs > 0).map(bar).collect()
}

fn words(seen: &Found) -> Vec<String> {
    let mut lines = vec![format!("found {} of {}", seen.detected.count, seen.detected.of)];
    if seen.early.count > 0 {
        lines.push(format!("{} before contact", seen.early.count));
    }
    if !seen.median.is_nan() {
        lines.push(format!("median {} s", number(seen.median, 2)));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_hold_every_contact_found_and_the_most_frequent_delay_is_the_highest() {
        let count = Count { found: vec![(0, 1), (100, 2), (119, 4), (1000, 3)], ..Count::default() };
        let bars = bars(&count, 1000.0, 1.0, 0.46);
        let tall = |bar: &[[f64; 2]; 2]| ((bar[0][1] - bar[1][1]) / HIGH * 6.0).round();
        assert_eq!(bars.iter().map(tall).collect::<Vec<_>>(), [1.0, 6.0, 3.0]);
        assert_eq!(bars[1].map(|corner| (corner[0] * 1e3).round()), [100.0, 120.0]);
        assert!((bars[2][1][0] - 1.0).abs() < 1e-12, "the last bar ends where delays do");
    }
}
