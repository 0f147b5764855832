//! Every threshold of every cell as CSV.

use crate::cli::output::{Failure, NewFile, finish_csv, write_record};
use centrode_core::chart::csv::cell;
use centrode_core::scenario::Override;
use centrode_core::study::tuning::Study;
use centrode_core::study::tuning::rate::Share;
use centrode_core::study::tuning::watch::Rule;

/// Columns after those of the swept keys. Thresholds are ξ2 in m, or ξ1 in N·m, or k where ξ1 follows the shape.
const COLUMNS: [&str; 27] = [
    "method",
    "threshold [SI]",
    "free_runs",
    "false_alarms",
    "false_alarm_rate [1]",
    "false_alarm_low [1]",
    "false_alarm_high [1]",
    "time_to_false_alarm [s]",
    "time_to_false_alarm_error [s]",
    "contact_runs",
    "early",
    "met",
    "found",
    "found_rate [1]",
    "found_low [1]",
    "found_high [1]",
    "missed",
    "missed_rate [1]",
    "late",
    "delay_mean [s]",
    "delay_mean_error [s]",
    "delay_median [s]",
    "delay_median_low [s]",
    "delay_median_high [s]",
    "delay_90 [s]",
    "contact_time [s]",
    "partial",
];

/// Writes them.
pub fn csv(file: NewFile, study: &Study, partial: bool) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(file);
    let keys = study.cells().first().map_or(&[][..], |cell| &cell.set[..]);
    let keys = keys.iter().map(Override::path);
    write_record(&mut csv, keys.chain(COLUMNS))?;
    for (k, settings) in study.cells().iter().enumerate() {
        let values: Vec<String> = settings.set.iter().map(|set| set.written().to_owned()).collect();
        let contact = study.contact_time(k).map_or_else(String::new, cell);
        for &rule in Rule::ALL {
            for point in study.curve(k, rule) {
                let mut row = values.clone();
                row.extend([rule.name().to_owned(), cell(point.threshold)]);
                let alarms = point.false_alarms;
                row.push(alarms.rate.of.to_string());
                row.extend(rate(&alarms.rate));
                row.extend([alarms.mean_time, alarms.mean_time_error].map(cell));
                if let Some(seen) = point.detection {
                    row.extend([seen.early.of, seen.early.count, seen.detected.of].map(|count| count.to_string()));
                    row.extend(rate(&seen.detected));
                    row.extend([seen.missed.count.to_string(), cell(seen.missed.rate), seen.late.to_string()]);
                    let delays =
                        [seen.mean, seen.mean_error, seen.median, seen.median_low, seen.median_high, seen.ninety];
                    row.extend(delays.map(cell));
                }
                row.resize(values.len() + COLUMNS.len() - 2, String::new());
                row.extend([contact.clone(), partial.to_string()]);
                write_record(&mut csv, row)?;
            }
        }
    }
    finish_csv(csv)
}

fn rate(rate: &Share) -> [String; 4] {
    [rate.count.to_string(), cell(rate.rate), cell(rate.low), cell(rate.high)]
}
