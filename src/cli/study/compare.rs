//! Detectors side by side.

use super::StudyArgs;
use super::outputs::Files;
use super::{share as made, work};
use crate::cli::draw;
use crate::cli::estimating::method;
use crate::cli::output::{Failure, json};
use centrode_core::detect::Method;
use centrode_core::scenario::keys::Quantity;
use centrode_core::scenario::link::Page;
use centrode_core::scenario::text::number;
use centrode_core::scenario::{Detectors, Scenario, Xi1Rule};
use centrode_core::study::Job;
use centrode_core::study::compare::chart::chart;
use centrode_core::study::compare::export::csv;
use centrode_core::study::compare::{At, Compare, Comparison, Place, Spec, with};
use centrode_core::study::export::signed;
use centrode_core::study::tuning::Point;
use centrode_core::study::tuning::rate::Share;
use centrode_core::study::tuning::recommend::Verdict;
use serde::Serialize;
use std::io::Write;

/// The share of runs without contact that may alarm, where none is given.
const RATE: f64 = 0.01;

/// What is printed as JSON. SI units; null where a value is not defined.
#[derive(Serialize)]
struct Report<'a> {
    scenario: &'a Scenario,
    /// Whether it was interrupted.
    partial: bool,
    #[serde(flatten)]
    comparison: &'a Comparison,
}

/// Compares the detectors that were given.
pub fn execute(args: &StudyArgs, scenario: &Scenario, repeats: usize, out: &mut impl Write) -> Result<(), Failure> {
    if !args.sweeps.is_empty() || args.rule.is_some() {
        let line = "--detectors compares detectors; --sweep and --method belong to a study of thresholds";
        return Err(Failure::Input(line.into()));
    }
    if args.false_alarms.is_some() || args.late.is_some() {
        let line = "--detectors compares at equal false alarms, --rate; --false-alarms and --late belong to a study of thresholds";
        return Err(Failure::Input(line.into()));
    }
    let methods: Vec<Method> =
        args.detectors.iter().map(|name| method("--detectors", name)).collect::<Result<_, _>>()?;
    let spec = Spec {
        scenario: with(scenario, &methods),
        repeats,
        rate: args.rate.unwrap_or(RATE),
        detector: args.estimating.detector()?,
        after: args.estimating.after()?,
    };
    let compare = Compare::new(spec).map_err(|error| Failure::Input(error.to_string()))?;
    if let Some((share, file)) = args.share.open(&args.outputs)? {
        return made::detectors(share, file, compare, scenario.detection.detectors);
    }
    let files = args.outputs.open()?;
    let compare = work::compare(compare);
    write(&compare, scenario.detection.detectors, files, out)
}

/// Reports what was asked for; a drawing links to the scenario with those that judge in it.
pub fn write(compare: &Compare, judging: Detectors, files: Files, out: &mut impl Write) -> Result<(), Failure> {
    let (comparison, spec) = (compare.comparison(), compare.spec());
    let partial = !compare.progress().is_complete();
    if let Some(mut file) = files.table {
        file.write_all(csv(&comparison, partial).as_bytes()).map_err(|error| file.blame(&error))?;
        file.finish()?;
    }
    if let Some((mut file, format)) = files.drawing {
        let compared = spec.scenario.detection.detectors;
        let page =
            Page { false_alarms: spec.rate, repeats: spec.repeats as u64, compare: compared, ..Page::of("detectors") };
        let mut scenario = spec.scenario.clone();
        scenario.detection.detectors = judging;
        draw::write(&mut file, &signed(chart(compare, &comparison), &scenario, page), format)?;
        file.finish()?;
    }
    if files.json {
        json(out, &Report { scenario: &spec.scenario, partial, comparison: &comparison })?;
    } else {
        text(out, &comparison, spec.scenario.detection.xi1_rule)?;
    }
    out.flush()?;
    if partial {
        let (done, of) = (comparison.repeats, spec.repeats);
        let line = format!("interrupted after {done} of {of} repeats; the results written are partial");
        return Err(Failure::Interrupted(line));
    }
    Ok(())
}

/// A number, or a dash where there is none.
fn shown(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("{value:.digits$}") } else { "–".into() }
}

fn text(out: &mut impl Write, comparison: &Comparison, rule: Xi1Rule) -> std::io::Result<()> {
    let Comparison { repeats, rate, detectors, bound, white, places, .. } = comparison;
    let runs = if *repeats == 1 { "run" } else { "runs" };
    writeln!(
        out,
        "{repeats} {runs} without and as many with contact; {} of {} without have white innovations",
        white.count, white.of
    )?;
    let own: Vec<_> = detectors.iter().map(|compared| (compared, &compared.own)).collect();
    let equal: Vec<_> = detectors.iter().map(|compared| (compared, &compared.equal)).collect();
    let percent = format!("at the threshold that at most {} of these runs without contact exceed", share(*rate));
    for (title, rows, with_bound) in [("at the scenario's thresholds", own, false), (&percent, equal, true)] {
        writeln!(out, "\n{title}")?;
        let head = ["detector", "threshold", "", "false", "found", "early", "median", "90 %"];
        let [detector, threshold, none, false_alarms, found, early, median, ninety] = head;
        writeln!(
            out,
            "{detector:<16}{threshold:>10} {none:<5}{false_alarms:>9}{found:>9}{early:>9}{median:>9} s{ninety:>9} s"
        )?;
        for (compared, at) in rows {
            detected(out, (compared.detector, compared.method().setting_quantity(rule)), at.as_ref())?;
        }
        if let Some(bound) = bound.as_ref().filter(|_| with_bound) {
            let (median, ninety) = (shown(bound.median, 3), shown(bound.ninety, 3));
            let name = "no test can beat";
            writeln!(
                out,
                "{name:<16}{:>10} {:<5}{:>9}{:>9}{:>9}{median:>9} s{ninety:>9} s",
                "",
                "",
                share(*rate),
                "",
                ""
            )?;
        }
    }
    if !places.is_empty() {
        let head = ["placed by", "after", "contacts", "bias", "RMS", "bound", "95 % hold", "width"];
        let [by, after, contacts, bias, rms, bound, hold, width] = head;
        writeln!(
            out,
            "\n{by:<12}{after:>7} s{contacts:>9}{bias:>9} mm{rms:>8} mm{bound:>8} mm{hold:>11}{width:>9} mm"
        )?;
        places.iter().try_for_each(|of| place(out, of))?;
    }
    advice(out, comparison, rule)
}

/// Which threshold of each detector to take, and of which detector.
fn advice(out: &mut impl Write, comparison: &Comparison, rule: Xi1Rule) -> std::io::Result<()> {
    let most = format!("at most {} false alarms", share(comparison.rate));
    writeln!(out, "\nadvice: the soonest threshold shown to give {most}, by the upper end of its 95 % interval")?;
    for compared in &comparison.detectors {
        let told = match &compared.advised {
            Verdict::Take { point, .. } => taken(compared.method().setting_quantity(rule), point),
            Verdict::TooFewRuns { needed } => {
                format!("none can be shown to: that takes at least --repeats {needed}, even when no run gives one")
            }
            Verdict::NoneQuiet { lowest } => format!("none: the best may give up to {:.1} %", lowest * 100.0),
            Verdict::NoneFinds { best } => {
                format!("none that detects half of the contacts; the best detects {:.1} %", best * 100.0)
            }
            Verdict::NoContact => "none: the robot never reaches the contact".into(),
        };
        writeln!(out, "{:<16}{told}", compared.detector)?;
    }
    match comparison.advice() {
        Some((method, point)) => {
            let at = threshold(method.setting_quantity(rule), point);
            writeln!(out, "{:<16}{} at {at}", "soonest", method.key())
        }
        None => Ok(()),
    }
}

fn threshold(quantity: Quantity, point: &Point) -> String {
    // Three digits in SI are three in the unit shown, but for roundings.
    let shown = (quantity.shown(point.threshold) * 1e6).round() / 1e6;
    format!("{} {}", number(shown), quantity.unit()).trim_end().to_owned()
}

fn taken(quantity: Quantity, point: &Point) -> String {
    let seen = point.detection.map_or([f64::NAN; 2], |seen| [seen.median, seen.ninety]);
    let Share { count, of, low, high, .. } = point.false_alarms.rate;
    format!(
        "{}: {} s after contact (median; 90 % within {} s); {count} of {of} ({:.1} to {:.1} %) runs without contact give a false alarm",
        threshold(quantity, point),
        shown(seen[0], 3),
        shown(seen[1], 3),
        low * 100.0,
        high * 100.0
    )
}

fn share(share: f64) -> String {
    if share.is_finite() { format!("{:.1} %", share * 100.0) } else { "–".into() }
}

/// One detector at one threshold.
fn detected(out: &mut impl Write, (name, quantity): (&str, Quantity), at: Option<&At>) -> std::io::Result<()> {
    let Some(at) = at else { return writeln!(out, "{name:<16}{:>10}", "off") };
    writeln!(
        out,
        "{name:<16}{:>10} {:<5}{:>9}{:>9}{:>9}{:>9} s{:>9} s",
        shown(quantity.shown(at.threshold), 3),
        quantity.unit(),
        share(at.false_alarms.rate),
        share(at.found.rate),
        share(at.early.rate),
        shown(at.median, 3),
        shown(at.ninety, 3)
    )
}

/// Where a contact is.
fn place(out: &mut impl Write, place: &Place) -> std::io::Result<()> {
    let mm = |x: f64| shown(x * 1e3, 3);
    let coverage = place.coverage.as_ref().map_or_else(|| "–".into(), |share| format!("{:.1} %", share.rate * 100.0));
    writeln!(
        out,
        "{:<12}{:>7.2} s{:>9}{:>9} mm{:>8} mm{:>8} mm{:>11}{:>9} mm",
        place.estimator,
        place.after,
        place.count,
        mm(place.bias),
        mm(place.rms),
        place.bound.map_or_else(|| "–".into(), mm),
        coverage,
        mm(place.width)
    )
}
