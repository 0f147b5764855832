//! Two instants of a run held against each other: what was judged then, and the tangent angle.

use super::{Measure, curves, has_plot, measure};
use crate::chart::notation::{number, runs};
use crate::detect::Method;
use crate::run::Run;
use std::fmt::Write;

/// What one quantity was at both instants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Its symbol, in which `_x` is a subscript.
    pub symbol: &'static str,
    /// Unit shown.
    pub unit: &'static str,
    /// Decimals shown.
    pub decimals: usize,
    /// Its values in that unit; NaN where it was not defined.
    pub values: [f64; 2],
}

impl Reading {
    /// By how much it is more at the second instant.
    #[must_use]
    pub fn change(&self) -> f64 {
        self.values[1] - self.values[0]
    }

    /// The change as it is read, with its sign and unit.
    #[must_use]
    pub fn told(&self) -> String {
        let (change, unit) = (self.change(), self.unit);
        let sign = if change > 0.0 { "+" } else { "" };
        match change.is_finite() {
            true => format!("{sign}{} {unit}", number(change, self.decimals)),
            false => "not defined".into(),
        }
    }
}

/// What the detectors that judge said at two times (s), and at last the tangent angle. Those that are not the paper's are left out
/// where they have no value in the whole run.
///
/// ```
/// use centrode_core::run::simulate;
/// use centrode_core::scenario::Scenario;
/// use centrode_core::study::course::between::between;
///
/// let run = simulate(&Scenario::default())?;
/// let angle = between(&run, [0.0, 10.0]).pop().expect("an angle");
/// assert_eq!((angle.symbol, angle.unit), ("θ_L", "°"));
/// assert!((angle.change() + 90.0).abs() < 1e-9);
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[must_use]
pub fn between(run: &Run, times: [f64; 2]) -> Vec<Reading> {
    let samples = times.map(|time| run.sample_at(time));
    let thresholds = &run.judged.settings.thresholds;
    let judged = |method: Method| {
        let Measure { symbol, unit, scale, decimals, .. } = measure(method);
        let curve = curves(method, thresholds).into_iter().next()?;
        let values = [0, 1].map(|k| (curve.value)(&samples[k], thresholds) * scale);
        Some(Reading { symbol, unit, decimals, values })
    };
    let bend = samples.map(|sample| sample.theta_l.to_degrees());
    let angle = Reading { symbol: "θ_L", unit: "°", decimals: 2, values: bend };
    let shown = thresholds.detectors.iter().filter(|&method| has_plot(run, method));
    shown.filter_map(judged).chain([angle]).collect()
}

/// The same as a table whose cells are parted by tabs, with the times first.
#[must_use]
pub fn table(run: &Run, times: [f64; 2]) -> String {
    let instants = times.map(|time| run.sample_at(time).time);
    let time = Reading { symbol: "t", unit: "s", decimals: 3, values: instants };
    let mut text = String::from("\tA\tB\tB − A\n");
    for reading in [time].into_iter().chain(between(run, times)) {
        let symbol: String = runs(reading.symbol).into_iter().map(|run| run.text).collect();
        let [a, b] = reading.values.map(|value| number(value, reading.decimals));
        let change = number(reading.change(), reading.decimals);
        // Writing to a string does not fail.
        let _ = writeln!(text, "{symbol} ({})\t{a}\t{b}\t{change}", reading.unit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::simulate;
    use crate::scenario::preset::find;

    #[test]
    fn both_values_and_their_difference_are_told() {
        let run = simulate(&find("bench").and_then(|preset| preset.scenario()).expect("a preset")).expect("a run");
        let found = run.detection().expect("detected").time;
        let readings = between(&run, [5.5, found]);
        let shown = run.judged.settings.thresholds.detectors.iter().filter(|&method| has_plot(&run, method));
        assert_eq!(readings.len(), shown.count() + 1);
        let centrode = readings[0];
        assert_eq!(centrode.values[1], run.sample_at(found).judgement.deviation * 1e3);
        assert!(centrode.change() > 3.0 && centrode.told().starts_with('+') && centrode.told().ends_with(" mm"));
        let text = table(&run, [5.5, found]);
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split('\t').collect()).collect();
        assert!(rows.len() == readings.len() + 2 && rows.iter().all(|row| row.len() == 4), "{text}");
        assert_eq!(rows[1], ["t (s)", "5.500", &number(found, 3), &number(found - 5.5, 3)]);
        assert_eq!(rows[2][0], "‖cm − cs‖ (mm)");
    }

    #[test]
    fn what_is_not_defined_has_no_difference() {
        let run = simulate(&find("bench").and_then(|preset| preset.scenario()).expect("a preset")).expect("a run");
        // The filter is not filled yet.
        let first = between(&run, [0.0, 7.0])[0];
        assert!(first.values[0].is_nan() && first.told() == "not defined", "{first:?}");
        assert!(table(&run, [0.0, 7.0]).contains("\t–\t"));
    }
}
