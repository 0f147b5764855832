//! A study in words and a table.

use centrode_core::scenario::{Override, Xi1Rule};
use centrode_core::study::Job;
use centrode_core::study::tuning::rate::Share;
use centrode_core::study::tuning::recommend::{Verdict, Wish, recommend_among};
use centrode_core::study::tuning::tally::Found;
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Point, Study};
use std::io::{self, Write};

/// Width of rule and threshold.
const NARROW: usize = 23;

/// Writes them.
pub fn text(out: &mut impl Write, study: &Study, wish: &Wish, verdict: &Verdict, partial: bool) -> io::Result<()> {
    let spec = study.spec();
    let progress = study.progress();
    let made = if partial { format!(", PARTIAL: {} of {} runs", progress.done, progress.of) } else { String::new() };
    writeln!(out, "study       {} repeats with contact and without{made}", spec.repeats)?;
    writeln!(out, "late        alarms more than {} s after contact count as missed", spec.late)?;
    writeln!(out, "intervals   95 % (Wilson; of the median, from its ranks)\n")?;
    if let [_] = study.cells() {
        writeln!(out, "{}", head("method      threshold", NARROW))?;
        for &rule in Rule::ALL {
            let lead = match study.own(0, rule) {
                Some(level) => format!("{:<11} {}", name(rule), threshold(study, 0, rule, level)),
                None => format!("{:<11} off", name(rule)),
            };
            let point = study.own(0, rule).map(|level| study.point(0, rule, level));
            writeln!(out, "{}", row(&lead, NARROW, point.as_ref()))?;
        }
        match study.contact_time(0) {
            Some(time) => writeln!(out, "\ncontact     at {time:.3} s")?,
            None => writeln!(out, "\ncontact     none")?,
        }
    } else {
        let wide = study.cells().iter().map(|cell| joined(&cell.set).chars().count()).max().unwrap_or(0);
        writeln!(out, "{}, at the threshold that is set, and at the one advised in each cell", name(wish.rule))?;
        writeln!(out, "{}", head(&format!("{:<wide$}  threshold", ""), wide + 13))?;
        for (k, cell) in study.cells().iter().enumerate() {
            let lead = |level: usize, sets: &str| format!("{sets:<wide$}  {}", threshold(study, k, wish.rule, level));
            let sets = joined(&cell.set);
            match study.own(k, wish.rule) {
                Some(level) => {
                    let point = study.point(k, wish.rule, level);
                    writeln!(out, "{}", row(&lead(level, &sets), wide + 13, Some(&point)))?;
                }
                None => writeln!(out, "{sets:<wide$}  off")?,
            }
            if let Verdict::Take { level, point, .. } = recommend_among(study, [k], wish) {
                writeln!(out, "{}", row(&lead(level, "  advised"), wide + 13, Some(&point)))?;
            }
        }
    }
    match super::is_tuned(study) {
        true => writeln!(out, "\nadvice      {}", advice(study, wish, verdict)),
        false => writeln!(
            out,
            "\nadvice      one for each cell: the sweeps change more than filter and detection, so cells cannot be compared"
        ),
    }
}

fn name(rule: Rule) -> &'static str {
    match rule {
        Rule::Fcd => "centrode",
        Rule::Jfd => "forces",
        Rule::Or => "either",
        Rule::And => "both",
    }
}

fn threshold(study: &Study, cell: usize, rule: Rule, level: usize) -> String {
    let value = study.levels(cell, rule)[level];
    match (rule, study.cells()[cell].scenario.detection.xi1_rule) {
        (Rule::Jfd, Xi1Rule::Constant) => format!("{:.1} mN·m", value * 1e3),
        (Rule::Jfd, Xi1Rule::Bound) => format!("{value:.2} ε_c"),
        _ => format!("{:.2} mm", value * 1e3),
    }
}

/// What a cell changes, as it is written.
fn joined(set: &[Override]) -> String {
    set.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

fn head(lead: &str, wide: usize) -> String {
    format!(
        "{lead:<wide$}  {:<30}  {:<30}  {:>10}  {:>6}  {:>14}  time to false alarm [s]",
        "false alarms", "found in time", "median [s]", "90 %", "mean [s]"
    )
}

fn row(lead: &str, wide: usize, point: Option<&Point>) -> String {
    let Some(point) = point else { return lead.to_owned() };
    let Found { detected, mean, mean_error, median, ninety, .. } = match point.detection {
        Some(seen) => seen,
        None => {
            let alarms = share(&point.false_alarms.rate);
            return format!("{lead:<wide$}  {alarms:<30}  {:<30}{}", "no contact", watched(point));
        }
    };
    format!(
        "{lead:<wide$}  {:<30}  {:<30}  {:>10}  {:>6}  {:>14}{}",
        share(&point.false_alarms.rate),
        share(&detected),
        seconds(median),
        seconds(ninety),
        with_error(mean, mean_error, 3),
        watched(point),
    )
}

fn watched(point: &Point) -> String {
    let alarms = &point.false_alarms;
    match alarms.rate.count {
        0 => format!("  none in {:.0}", alarms.watched),
        _ => format!("  {}", with_error(alarms.mean_time, alarms.mean_time_error, 1)),
    }
}

fn with_error(mean: f64, error: f64, digits: usize) -> String {
    match (mean.is_nan(), error.is_nan()) {
        (true, _) => "–".into(),
        (false, true) => format!("{mean:.digits$}"),
        _ => format!("{mean:.digits$} ± {error:.digits$}"),
    }
}

fn seconds(value: f64) -> String {
    if value.is_nan() { "–".into() } else { format!("{value:.3}") }
}

/// `3 of 100 (1.0 to 8.5 %)`.
fn share(rate: &Share) -> String {
    format!("{} of {} ({:.1} to {:.1} %)", rate.count, rate.of, rate.low * 100.0, rate.high * 100.0)
}

fn advice(study: &Study, wish: &Wish, verdict: &Verdict) -> String {
    let wished = wish.false_alarm_rate * 100.0;
    let most = format!("at most {wished} % false alarms");
    match verdict {
        Verdict::Take { cell, level, point } => {
            let delay = point.detection.map_or(f64::NAN, |seen| seen.median);
            let others = study.cells()[*cell].set.iter().filter(|set| set.path() != "filter.length");
            let others: String = others.map(|set| format!(", {set}")).collect();
            format!(
                "{} with N = {}{}: soonest with {most}, {} s after contact (median); {} runs without contact give a false alarm",
                threshold(study, *cell, wish.rule, *level),
                study.cells()[*cell].scenario.filter.length,
                others,
                seconds(delay),
                share(&point.false_alarms.rate),
            )
        }
        Verdict::TooFewRuns { needed } => {
            format!(
                "no threshold can be shown to give {most}: that takes at least --repeats {needed}, even when no run gives one"
            )
        }
        Verdict::NoneQuiet { lowest } => {
            format!("no threshold gives {most}: the best may give up to {:.1} %", lowest * 100.0)
        }
        Verdict::NoneFinds { best } => format!(
            "no threshold with {most} detects half of the contacts in time; the best detects {:.1} %",
            best * 100.0
        ),
        Verdict::NoContact => "none: there is no contact to detect".into(),
    }
}
