//! A comparison as CSV: one table, with a kind for each row.

use super::{At, Comparison, Place};
use crate::chart::csv::{cell, line};
use crate::study::tuning::Point;
use crate::study::tuning::rate::Share;

/// Columns, with SI units. What a kind of row does not say stays empty.
const COLUMNS: [&str; 36] = [
    "kind",
    "name",
    "threshold [SI]",
    "free_runs",
    "false_alarms",
    "false_alarm_rate [1]",
    "false_alarm_low [1]",
    "false_alarm_high [1]",
    "time_to_false_alarm [s]",
    "contact_runs",
    "early",
    "met",
    "found",
    "found_rate [1]",
    "found_low [1]",
    "found_high [1]",
    "delay_mean [s]",
    "delay_mean_error [s]",
    "delay_median [s]",
    "delay_median_low [s]",
    "delay_median_high [s]",
    "delay_90 [s]",
    "after [s]",
    "since_contact [s]",
    "placed",
    "bias [m]",
    "rms [m]",
    "rms_low [m]",
    "rms_high [m]",
    "interval_width [m]",
    "covered",
    "covered_rate [1]",
    "covered_low [1]",
    "covered_high [1]",
    "bound [m]",
    "partial",
];

/// Fields of a row by the names of their columns.
struct Row<'a>(Vec<(&'a str, String)>);

impl<'a> Row<'a> {
    fn new(kind: &str, name: &str) -> Self {
        Self(vec![("kind", kind.into()), ("name", name.into())])
    }

    fn with(mut self, column: &'a str, value: impl ToString) -> Self {
        self.0.push((column, value.to_string()));
        self
    }

    fn number(self, column: &'a str, value: f64) -> Self {
        self.with(column, cell(value))
    }

    fn share(self, [count, rate, low, high]: [&'a str; 4], share: &Share) -> Self {
        let row = self.with(count, share.count);
        row.number(rate, share.rate).number(low, share.low).number(high, share.high)
    }

    fn line(self, partial: bool) -> String {
        let row = self.with("partial", partial);
        let field = |column: &&str| row.0.iter().find(|(name, _)| name == column).map_or("", |(_, text)| text.as_str());
        line(COLUMNS.iter().map(field))
    }
}

const FALSE_ALARMS: [&str; 4] = ["false_alarms", "false_alarm_rate [1]", "false_alarm_low [1]", "false_alarm_high [1]"];
const FOUND: [&str; 4] = ["found", "found_rate [1]", "found_low [1]", "found_high [1]"];
const COVERED: [&str; 4] = ["covered", "covered_rate [1]", "covered_low [1]", "covered_high [1]"];

/// The table: `own` and `equal` are a detector at the threshold that is set and at equal false alarms (shares found are of all contacts
/// met), `threshold` is each threshold of its curve (of contacts met without an alarm before), `advised` the one to take; `bound` is what
/// no test can beat; `place` is what an estimator reached, `place-bound` what no unbiased estimate can beat.
#[must_use]
pub fn csv(comparison: &Comparison, partial: bool) -> String {
    let mut text = line(COLUMNS);
    let mut push = |row: Row<'_>| text.push_str(&row.line(partial));
    for compared in &comparison.detectors {
        for (kind, at) in [("own", &compared.own), ("equal", &compared.equal)] {
            at.iter().for_each(|at| push(counted(kind, compared.detector, at)));
        }
        compared.curve.iter().for_each(|point| push(level("threshold", compared.detector, point)));
        compared.taken().into_iter().for_each(|point| push(level("advised", compared.detector, point)));
    }
    for bound in &comparison.bounds {
        let row = Row::new("bound", "").number("false_alarm_rate [1]", bound.rate);
        push(row.number("delay_median [s]", bound.delay.median).number("delay_90 [s]", bound.delay.ninety));
    }
    comparison.places.iter().for_each(|placed| push(place(placed)));
    for limit in &comparison.place_bounds {
        push(Row::new("place-bound", "").number("since_contact [s]", limit.since).number("bound [m]", limit.bound));
    }
    text
}

fn counted<'a>(kind: &str, name: &str, at: &At) -> Row<'a> {
    Row::new(kind, name)
        .number("threshold [SI]", at.threshold)
        .with("free_runs", at.false_alarms.of)
        .share(FALSE_ALARMS, &at.false_alarms)
        .with("contact_runs", at.early.of)
        .with("early", at.early.count)
        .share(FOUND, &at.found)
        .number("delay_median [s]", at.median)
        .number("delay_90 [s]", at.ninety)
}

fn level<'a>(kind: &str, name: &str, point: &Point) -> Row<'a> {
    let alarms = &point.false_alarms;
    let row = Row::new(kind, name)
        .number("threshold [SI]", point.threshold)
        .with("free_runs", alarms.rate.of)
        .share(FALSE_ALARMS, &alarms.rate)
        .number("time_to_false_alarm [s]", alarms.mean_time);
    let Some(seen) = &point.detection else { return row };
    row.with("contact_runs", seen.early.of)
        .with("early", seen.early.count)
        .with("met", seen.detected.of)
        .share(FOUND, &seen.detected)
        .number("delay_mean [s]", seen.mean)
        .number("delay_mean_error [s]", seen.mean_error)
        .number("delay_median [s]", seen.median)
        .number("delay_median_low [s]", seen.median_low)
        .number("delay_median_high [s]", seen.median_high)
        .number("delay_90 [s]", seen.ninety)
}

fn place<'a>(place: &Place) -> Row<'a> {
    let row = Row::new("place", place.estimator)
        .number("after [s]", place.after)
        .number("since_contact [s]", place.since)
        .with("placed", place.count)
        .number("bias [m]", place.bias)
        .number("rms [m]", place.rms)
        .number("rms_low [m]", place.rms_low)
        .number("rms_high [m]", place.rms_high)
        .number("interval_width [m]", place.width)
        .number("bound [m]", place.bound.unwrap_or(f64::NAN));
    match &place.coverage {
        Some(share) => row.share(COVERED, share),
        None => row,
    }
}
