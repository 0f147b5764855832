//! A study as charts: contacts found, and delay, against false alarms, each with its band.
//!
//! Shares lie on an arcsine scale: both ends, where thresholds are chosen, are spread, and intervals from equally many runs are
//! about equally wide everywhere.

mod places;

pub use places::places;

use super::recommend::{Verdict, Wish};
use super::watch::Rule;
use super::{Point, Study};
use crate::chart::notation::plain;
use crate::chart::ticks::Steps;
use crate::chart::{Axis, Band, Chart, Panel, Role, Series, Style, Vertical};
use crate::scenario::Override;
use crate::study::Job;
use crate::study::figure::words;

/// The most cells whose delays are drawn.
const CELLS: usize = 12;
/// A delay's axis reaches beyond the longest by this share of it.
const MARGIN: f64 = 0.04;

/// What all thresholds of one rule come to, and how that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve<'a> {
    /// Name in the legend.
    pub name: String,
    /// What it means.
    pub role: Role,
    /// How its line is drawn.
    pub style: Style,
    /// Whether it stands back behind the others.
    pub faint: bool,
    /// One point for each threshold, rising.
    pub points: &'a [Point],
}

/// What a rule means in a chart, and how its line is drawn.
#[must_use]
pub fn look(rule: Rule) -> (Role, Style) {
    match rule {
        Rule::Fcd => (Role::Sensor, Style::Line),
        Rule::Jfd => (Role::Force, Style::LongDashed),
        Rule::Or => (Role::Bound, Style::Dotted),
        Rule::And => (Role::Aside, Style::Dashed),
    }
}

/// How a rule is called.
#[must_use]
pub fn name(rule: Rule) -> &'static str {
    match rule {
        Rule::Fcd => "Centrode",
        Rule::Jfd => "Forces",
        Rule::Or => "Either",
        Rule::And => "Both",
    }
}

/// Where a threshold lies among those found against false alarms: the share of runs without contact that alarm, and the share
/// of contacts found in time; none without such runs.
#[must_use]
pub fn found(point: &Point) -> Option<[f64; 2]> {
    let rate = point.detection?.detected;
    let alarms = point.false_alarms.rate;
    (rate.of > 0 && alarms.of > 0).then_some([alarms.rate, rate.rate])
}

/// Where a threshold lies among delays against false alarms: the share of runs without contact that alarm, and the median
/// delay, s; none where fewer than half are found in time.
#[must_use]
pub fn delay(point: &Point) -> Option<[f64; 2]> {
    let median = point.detection?.median;
    let alarms = point.false_alarms.rate;
    (!median.is_nan() && alarms.of > 0).then_some([alarms.rate, median])
}

/// The corners of both intervals that lie farthest from the curve: more alarms go with more found.
fn found_band(point: &Point) -> Option<[[f64; 2]; 2]> {
    let (rate, alarms) = (point.detection?.detected, point.false_alarms.rate);
    found(point).map(|_| [[alarms.high, rate.low], [alarms.low, rate.high]])
}

/// The same for delays, with more alarms for less delay; an open end reaches to the top of the axis.
pub(crate) fn delay_band(point: &Point, top: f64) -> Option<[[f64; 2]; 2]> {
    let (seen, alarms) = (point.detection?, point.false_alarms.rate);
    let open = |value: f64| if value.is_nan() { top } else { value };
    delay(point).map(|_| [[alarms.low, open(seen.median_low)], [alarms.high, open(seen.median_high)]])
}

pub(crate) fn shares(name: &'static str) -> Axis {
    Axis { steps: Steps::Shares, range: Some([0.0, 1.0]), ..Axis::new(name, "1", "%", 100.0) }
}

fn panel(
    y: Axis,
    curves: &[Curve<'_>],
    wish: f64,
    at: impl Fn(&Point) -> Option<[f64; 2]>,
    band: impl Fn(&Point) -> Option<[[f64; 2]; 2]>,
) -> Panel {
    const GAP: [f64; 2] = [f64::NAN; 2];
    let mut panel = Panel::new(shares("Runs without contact that alarm"), y);
    for curve in curves {
        let edges = curve.points.iter().map(|point| band(point).unwrap_or([GAP; 2])).collect();
        panel.bands.push(Band { role: curve.role, faint: curve.faint, edges });
        let points = curve.points.iter().map(|point| at(point).unwrap_or(GAP)).collect();
        panel
            .series
            .push(Series { faint: curve.faint, ..Series::new(curve.name.clone(), curve.role, curve.style, points) });
    }
    panel.verticals.push(Vertical { name: "", x: wish, role: Role::Choice });
    panel
}

/// Contacts found against false alarms, with a line at the share of false alarms that is wished for.
#[must_use]
pub fn operating(curves: &[Curve<'_>], wish: f64) -> Panel {
    let panel = panel(shares("Found in time"), curves, wish, found, found_band);
    Panel { title: "Contacts found against false alarms".into(), ..panel }
}

/// Median delay against false alarms; delays reach to `late`, s.
#[must_use]
pub fn delays(curves: &[Curve<'_>], wish: f64, late: f64) -> Panel {
    let top = late * (1.0 + MARGIN);
    let y = Axis { range: Some([0.0, top]), ..Axis::new("Median delay", "s", "s", 1.0) };
    let panel = panel(y, curves, wish, delay, |point| delay_band(point, top));
    Panel { title: "Delay against false alarms".into(), ..panel }
}

/// Adds a mark at a place that may not be defined.
pub fn mark(panel: &mut Panel, role: Role, style: Style, at: Option<[f64; 2]>) {
    panel.series.extend(at.map(|at| Series::new("", role, style, vec![at])));
}

/// A study as the command draws it: all rules in the advised cell, or the first; the wished-for rule's delays in each cell.
#[must_use]
pub fn chart(study: &Study, wish: &Wish, verdict: &Verdict, partial: bool) -> Chart {
    let cell = if let Verdict::Take { cell, .. } = verdict { *cell } else { 0 };
    let set = study.cells().get(cell).map_or_else(String::new, |cell| plain(&joined(&cell.set)));
    let rate = wish.false_alarm_rate;
    let own = |rule| study.own(cell, rule).map(|level| study.point(cell, rule, level));
    let advised = if let Verdict::Take { point, .. } = verdict { Some(&**point) } else { None };

    let points: Vec<_> = Rule::ALL.iter().map(|&rule| study.curve(cell, rule)).collect();
    let curves = Rule::ALL.iter().zip(&points).map(|(&rule, points)| {
        let (role, style) = look(rule);
        Curve { name: name(rule).into(), role, style, faint: false, points }
    });
    let mut first = operating(&curves.collect::<Vec<_>>(), rate);
    if !set.is_empty() {
        first.title = format!("{}, {set}", first.title);
    }
    for &rule in Rule::ALL {
        mark(&mut first, look(rule).0, Style::Dots, own(rule).as_ref().and_then(found));
    }
    mark(&mut first, Role::Choice, Style::Rings, advised.and_then(found));

    let count = study.cells().len().min(CELLS);
    let points: Vec<_> = (0..count).map(|cell| study.curve(cell, wish.rule)).collect();
    let curves = study.cells().iter().zip(&points).enumerate().map(|(k, (cell, points))| {
        let member = Role::Member(k as f64 / (count.max(2) - 1) as f64);
        let (name, role, style) = match cell.set.is_empty() {
            true => ("As set".into(), look(wish.rule).0, Style::Heavy),
            false => (plain(&joined(&cell.set)), member, Style::Line),
        };
        Curve { name, role, style, faint: false, points }
    });
    let mut second = delays(&curves.collect::<Vec<_>>(), rate, late(study));
    mark(&mut second, Role::Bound, Style::Dots, own(wish.rule).as_ref().and_then(delay));
    mark(&mut second, Role::Choice, Style::Rings, advised.and_then(delay));

    Chart {
        title: "What each threshold costs".into(),
        panels: vec![first, second],
        caption: caption(study, wish, advised.is_some(), partial),
    }
}

/// What a cell changes, as it is written.
fn joined(set: &[Override]) -> String {
    set.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Top of the delays, s: no run is longer.
fn late(study: &Study) -> f64 {
    let ends = study.cells().iter().map(|cell| cell.scenario.motion.end);
    study.spec().late.min(ends.fold(0.0, f64::max)).max(1e-9)
}

/// What a study was made with and what its charts show, in words; `advised` says whether there is a threshold to take.
#[must_use]
pub fn caption(study: &Study, wish: &Wish, advised: bool, partial: bool) -> String {
    let spec = study.spec();
    let (tracker, cells) = (&spec.scenario.tracker, &spec.scenario.load_cells);
    let progress = study.progress();
    let made = match partial {
        true => format!("PARTIAL: {} of {} runs", progress.done, progress.of),
        false => format!("{} repeats with contact and without", spec.repeats),
    };
    let swept = study.cells().iter().flat_map(|cell| &cell.set).any(|set| set.path() == "filter.length");
    let filter = if swept { String::new() } else { format!(", N = {}", spec.scenario.filter.length) };
    let left_out = study.cells().len().saturating_sub(CELLS);
    let more = if left_out > 0 { format!(" {left_out} more cells are not drawn.") } else { String::new() };
    let none = if advised { "" } else { " (none reaches this)" };
    format!(
        "Simulated by Centrode, {made}: tracker noise {} and {}, load cell noise {} N, ε_τ = {}{filter}; alarms more than {} s \
         after contact are missed.\n\
         Bands: corners of the 95 % intervals of both axes. Shares lie on an arcsine scale. Delays are those of rule {}.{more}\n\
         Dots: thresholds as set. Dashed line: {} false alarms. Ring: soonest with at most that many{none}.",
        words::millimetres(tracker.position_noise),
        words::degrees(tracker.orientation_noise),
        words::plain(cells.noise),
        words::percent(cells.epsilon_tau),
        spec.late,
        wish.rule.name(),
        words::percent(wish.false_alarm_rate),
    )
}
