//! What a study of thresholds comes to: in words or as JSON, as a table and drawn.

use super::is_tuned;
use super::outputs::Files;
use super::{table, text};
use crate::cli::draw;
use crate::cli::output::{Failure, json};
use centrode_core::scenario::link::Page;
use centrode_core::scenario::{Override, Scenario};
use centrode_core::study::Job;
use centrode_core::study::export::signed;
use centrode_core::study::tuning::chart::chart;
use centrode_core::study::tuning::recommend::{Verdict, Wish, recommend_among};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Point, Study};
use serde::Serialize;
use std::io::Write;

/// Reports what was asked for.
pub fn write(study: &Study, wish: Wish, partial: bool, files: Files, out: &mut impl Write) -> Result<(), Failure> {
    // Cells that differ in what is to be found are no alternatives: each has its own advice.
    let cells = if is_tuned(study) { 0..study.cells().len() } else { 0..1 };
    let verdict = recommend_among(study, cells, &wish);
    if let Some(file) = files.table {
        table::csv(file, study, partial)?;
    }
    if let Some((mut file, format)) = files.drawing {
        let page = Page {
            rule: wish.rule.name(),
            false_alarms: wish.false_alarm_rate,
            repeats: study.spec().repeats as u64,
            ..Page::of("tuning")
        };
        let chart = signed(chart(study, &wish, &verdict, partial), &study.spec().scenario, page);
        draw::write(&mut file, &chart, format)?;
        file.finish()?;
    }
    if files.json {
        json(out, &report(study, wish, &verdict, partial))?;
    } else {
        text::text(out, study, &wish, &verdict, partial)?;
    }
    out.flush()?;
    if partial {
        let progress = study.progress();
        let line =
            format!("interrupted after {} of {} runs; the results written are partial", progress.done, progress.of);
        return Err(Failure::Interrupted(line));
    }
    Ok(())
}

/// What a study comes to. SI units; null where a value is not defined.
#[derive(Debug, Serialize)]
struct Report<'a> {
    scenario: &'a Scenario,
    repeats: usize,
    /// s
    late: f64,
    /// Whether it was interrupted: cells say how many runs they hold.
    partial: bool,
    wish: Wish,
    cells: Vec<CellReport<'a>>,
    /// Among all cells; null where they differ in more than can be tuned.
    recommendation: Option<Recommendation<'a>>,
}

#[derive(Debug, Serialize)]
struct CellReport<'a> {
    /// What it changes in the scenario.
    set: &'a [Override],
    runs_free: u64,
    /// Null without a contact.
    runs_contact: Option<u64>,
    /// Truth, s; null when contact never begins.
    contact_time: Option<f64>,
    /// At the scenario's own thresholds; null where one is off.
    own: ByRule<Option<Point>>,
    /// At all thresholds, without the inner points of stretches in which nothing else changes.
    curves: ByRule<Vec<Point>>,
    /// Which threshold to take in this cell.
    advised: Verdict,
}

#[derive(Debug, Serialize)]
struct ByRule<T> {
    fcd: T,
    jfd: T,
    or: T,
    and: T,
}

impl<T> ByRule<T> {
    fn of(of: impl Fn(Rule) -> T) -> Self {
        Self { fcd: of(Rule::Fcd), jfd: of(Rule::Jfd), or: of(Rule::Or), and: of(Rule::And) }
    }
}

#[derive(Debug, Serialize)]
struct Recommendation<'a> {
    #[serde(flatten)]
    verdict: &'a Verdict,
    /// What the cell to take changes in the scenario, and its filter length.
    set: Option<&'a [Override]>,
    filter_length: Option<u64>,
}

fn report<'a>(study: &'a Study, wish: Wish, verdict: &'a Verdict, partial: bool) -> Report<'a> {
    let cells = study.cells().iter().enumerate().map(|(k, cell)| {
        let (runs_free, runs_contact) = study.repeats(k);
        let own = |rule| study.own(k, rule).map(|level| study.point(k, rule, level));
        CellReport {
            set: &cell.set,
            runs_free,
            runs_contact,
            contact_time: study.contact_time(k),
            own: ByRule::of(own),
            curves: ByRule::of(|rule| thinned(study.curve(k, rule))),
            advised: recommend_among(study, [k], &wish),
        }
    });
    let taken = match verdict {
        Verdict::Take { cell, .. } => Some(&study.cells()[*cell]),
        _ => None,
    };
    Report {
        scenario: &study.spec().scenario,
        repeats: study.spec().repeats,
        late: study.spec().late,
        partial,
        wish,
        cells: cells.collect(),
        recommendation: is_tuned(study).then(|| Recommendation {
            verdict,
            set: taken.map(|cell| &cell.set[..]),
            filter_length: taken.map(|cell| cell.scenario.filter.length),
        }),
    }
}

/// Without the points between two that say the same.
fn thinned(points: Vec<Point>) -> Vec<Point> {
    let says = |k: usize| {
        let Point { false_alarms, detection, .. } = &points[k];
        let counts = detection.map(|seen| (seen.early.count, seen.detected.count, seen.late));
        let delays = detection.map(|seen| [seen.mean, seen.mean_error, seen.median, seen.ninety].map(f64::to_bits));
        (false_alarms.rate.count, false_alarms.watched.to_bits(), counts, delays)
    };
    let last = points.len().saturating_sub(1);
    let kept = (0..points.len()).filter(|&k| k == 0 || k == last || says(k) != says(k - 1) || says(k) != says(k + 1));
    kept.map(|k| points[k]).collect()
}
