//! Every channel of a run as CSV, an instant to a row, units in the header: sample by sample, or of a whole run.

use crate::run::{CHANNELS, Channel, EXTRA, Run, Sample};
use crate::scenario::Detectors;
use std::fmt::Write;

/// The channels of a run with these detectors: those that are always there, then those of detectors that are not the paper's.
fn channels(detectors: Detectors) -> impl Iterator<Item = &'static Channel> {
    let extra = EXTRA.iter().filter(move |(method, _)| detectors.has(*method));
    CHANNELS.iter().chain(extra.map(|(_, channel)| channel))
}

/// The header.
#[must_use]
pub fn header(detectors: Detectors) -> String {
    let names: Vec<String> =
        channels(detectors).map(|channel| format!("{} [{}]", channel.name, channel.unit)).collect();
    names.join(",") + "\n"
}

/// Adds the row of a sample: what is not defined is empty, and so is the truth where it is not known, as in a log.
pub fn row(text: &mut String, sample: &Sample, truth: bool, detectors: Detectors) {
    for (k, channel) in channels(detectors).enumerate() {
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
    let detectors = run.judged.settings.thresholds.detectors;
    let mut text = header(detectors);
    let truth = !run.is_recorded();
    let within = run.samples().filter(|sample| (from..=to).contains(&sample.time));
    within.for_each(|sample| row(&mut text, &sample, truth, detectors));
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::csv::cell;
    use crate::run::simulate;
    use crate::scenario::{Method, Scenario};

    #[test]
    fn a_row_has_every_channel_and_no_truth_where_none_is_known() {
        let mut scenario = Scenario::default();
        scenario.detection.detectors = Detectors::of(&[Method::FcdVelocity, Method::Fcd, Method::FcdConsistent]);
        let run = simulate(&scenario).expect("possible");
        let whole = csv(&run, f64::NEG_INFINITY, f64::INFINITY);
        assert_eq!(whole.lines().count(), 1 + run.len());
        let head = whole.lines().next().expect("a header");
        assert!(head.ends_with(",bound_shape [N·m],consistent_deviation [m],velocity_deviation [m/s]"), "{head}");
        let sample = run.sample(7000);
        let mut cells: Vec<String> = CHANNELS.iter().map(|channel| cell((channel.value)(&sample))).collect();
        cells.extend([sample.judgement.consistent, sample.judgement.velocity].map(cell));
        assert_eq!(whole.lines().nth(7001), Some(&*cells.join(",")));
        let mut bare = String::new();
        row(&mut bare, &sample, false, Detectors::NONE);
        let place = CHANNELS.iter().position(|channel| channel.name == "in_contact").expect("the truth");
        let bare: Vec<&str> = bare.trim_end().split(',').collect();
        assert!(bare[place].is_empty() && cells[place] == "1" && bare.len() == CHANNELS.len());
        assert_eq!(csv(&run, 2.0, 1.0), format!("{head}\n"));
    }
}
