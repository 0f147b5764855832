//! Ranges of axes, and round numbers on them.

use centrode_core::study::figure::{Axis, Figure};

/// Room beyond what is drawn, where no range is given, in shares of the range.
const MARGIN: f64 = 0.05;
/// About so many ticks.
const WANTED: f64 = 7.0;

/// Ends of both axes, as shown (scaled).
pub fn ranges(figure: &Figure) -> [[f64; 2]; 2] {
    let of = |which: usize, axis: &Axis| {
        if let Some([a, b]) = axis.range
            && a != b
        {
            return [a * axis.scale, b * axis.scale];
        }
        let values = figure.series.iter().flat_map(|series| &series.points).map(|point| point[which] * axis.scale);
        let (low, high) =
            values.filter(|x| x.is_finite()).fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            return [0.0, 1.0];
        }
        let margin = if high > low { MARGIN * (high - low) } else { 1.0_f64.max(0.1 * high.abs()) };
        // What is never negative starts at 0.
        let floor = if low >= 0.0 && low < 0.4 * high && !figure.equal_scales { 0.0 } else { low - margin };
        [floor, high + margin]
    };
    [of(0, &figure.x), of(1, &figure.y)]
}

/// Round numbers within a range, with their labels.
pub fn ticks([low, high]: [f64; 2], unit: &str) -> Vec<(f64, String)> {
    let least = (high - low).abs() / WANTED;
    let power = 10f64.powf(least.log10().floor());
    let decimal = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|step| *step >= 0.999 * least);
    let round = [5.0, 10.0, 15.0, 30.0, 45.0, 90.0].into_iter().find(|step| *step >= 0.8 * least);
    let step = match round {
        Some(step) if unit == "°" && least > 3.0 => step,
        _ => decimal.unwrap_or(10.0 * power),
    };
    let decimals = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
    let slack = 1e-6 * step;
    let first = ((low.min(high) - slack) / step).ceil() as i64;
    let last = ((low.max(high) + slack) / step).floor() as i64;
    let tick = |k: i64| (k as f64 * step, format!("{:.decimals$}", k as f64 * step).replace('-', "−"));
    (first..=last.min(first.saturating_add(50))).map(tick).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let labels = |range, unit| ticks(range, unit).into_iter().map(|(_, label)| label).collect::<Vec<_>>();
        assert_eq!(labels([30.0, 90.0], "°"), ["30", "40", "50", "60", "70", "80", "90"]);
        assert_eq!(labels([-1.0, 1.0], "mm"), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels([0.0, 11.2], "mm"), ["0", "2", "4", "6", "8", "10"]);
    }
}
