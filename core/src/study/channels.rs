//! Every channel of a run as CSV, an instant to a row, units in the header: sample by sample, or of a whole run.

use crate::run::{CHANNELS, Run, Sample};
use std::fmt::Write;

/// The header.
#[must_use]
pub fn header() -> String {
    let names: Vec<String> = CHANNELS.iter().map(|channel| format!("{} [{}]", channel.name, channel.unit)).collect();
    names.join(",") + "\n"
}

/// Adds the row of a sample: what is not defined is empty, and so is the truth where it is not known, as in a log.
pub fn row(text: &mut String, sample: &Sample, truth: bool) {
    for (k, channel) in CHANNELS.iter().enumerate() {
        if k > 0 {
            text.push(',');
        }
        let value = (channel.value)(sample);
        if !value.is_nan() && (truth || channel.name != "in_contact") {
            // Writing to a string does not fail.
            let _ = write!(text, "{value}");
        }
    }
    text.push('\n');
}

/// A run from one time to another, s, both included where there is a sample.
///
/// ```
/// use centrode_core::run::simulate;
/// use centrode_core::scenario::Scenario;
/// use centrode_core::study::channels::csv;
///
/// let run = simulate(&Scenario::default())?;
/// let text = csv(&run, 1.0, 1.0);
/// assert!(text.starts_with("time [s],theta_l [rad],"));
/// assert!(text.lines().nth(1).is_some_and(|row| row.starts_with("1,")) && text.lines().count() == 2);
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[must_use]
pub fn csv(run: &Run, from: f64, to: f64) -> String {
    let mut text = header();
    let truth = !run.is_recorded();
    let within = run.samples().filter(|sample| (from..=to).contains(&sample.time));
    within.for_each(|sample| row(&mut text, &sample, truth));
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::csv::cell;
    use crate::run::simulate;
    use crate::scenario::Scenario;

    #[test]
    fn a_row_has_every_channel_and_no_truth_where_none_is_known() {
        let run = simulate(&Scenario::default()).expect("possible");
        let whole = csv(&run, f64::NEG_INFINITY, f64::INFINITY);
        assert_eq!(whole.lines().count(), 1 + run.len());
        let sample = run.sample(7000);
        let cells: Vec<String> = CHANNELS.iter().map(|channel| cell((channel.value)(&sample))).collect();
        assert_eq!(whole.lines().nth(7001), Some(&*cells.join(",")));
        let mut bare = String::new();
        row(&mut bare, &sample, false);
        let place = CHANNELS.iter().position(|channel| channel.name == "in_contact").expect("the truth");
        let bare: Vec<&str> = bare.trim_end().split(',').collect();
        assert!(bare[place].is_empty() && cells[place] == "1" && bare.len() == CHANNELS.len());
        assert_eq!(csv(&run, 2.0, 1.0), header());
    }
}
