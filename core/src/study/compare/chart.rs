//! A comparison as charts: delay against false alarms for each detector, and how true places are against the time since contact, each with
//! what cannot be beaten as a line of its own.

use super::{Compare, Compared, Comparison, Place};
use crate::chart::ticks::Steps;
use crate::chart::{Axis, Band, Chart, Intervals, Panel, Role, Series, Style, Vertical};
use crate::detect::Method;
use crate::scenario::{Estimator, Listed};
use crate::study::Job;
use crate::study::course::measure;
use crate::study::figure::words::{self, MILLI};
use crate::study::tuning::Point;
use crate::study::tuning::chart::{delay, delay_band, mark, shares};

/// Title of the picture of delays, and what its bound is called.
pub const DELAYS: &str = "Delay against false alarms, by detector";
/// Title of the picture of places.
pub const ERRORS: &str = "Error of the place since contact";
/// Title of the picture of their intervals.
pub const COVERAGE: &str = "How often the interval holds the place";
/// What no test can beat, in the legend.
pub const NO_TEST: &str = "No test can beat";
/// What no estimate can beat, in the legend.
pub const NO_ESTIMATE: &str = "No unbiased estimate can beat";

/// Room at both ends of a logarithmic axis, as a ratio.
const ROOM: f64 = 1.25;
const GAP: [f64; 2] = [f64::NAN; 2];
/// The share of intervals that should hold the truth.
const NOMINAL: f64 = 0.95;

/// How a detector's curve looks: no two are drawn alike.
#[must_use]
pub fn look(method: Method) -> (Role, Style) {
    let style = match method {
        Method::Fcd => Style::Line,
        Method::FcdConsistent => Style::Dashed,
        Method::FcdVelocity => Style::Thin,
        Method::Jfd => Style::LongDashed,
        Method::Cusum => Style::DashDotted,
        Method::Glr => Style::Dotted,
    };
    (measure(method).role, style)
}

fn estimator_look(word: &str) -> (Role, Style, &'static str) {
    match Estimator::ALL.iter().find(|estimator| estimator.word() == word) {
        Some(Estimator::Eq24) => (Role::Sensor, Style::Line, "Eq. 24"),
        Some(Estimator::Settled) => (Role::Sensor, Style::Dashed, "Eq. 24, settled"),
        _ => (Role::Likelihood, Style::DashDotted, "Posterior mean"),
    }
}

/// A logarithmic range around positive values.
fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let positive = values.filter(|value| value.is_finite() && *value > 0.0);
    let (low, high) = positive.fold((f64::MAX, 0.0f64), |(low, high), value| (low.min(value), high.max(value)));
    (low <= high).then_some([low / ROOM, high * ROOM])
}

/// Where a threshold lies; none also where more than half of the contacts are not met without an alarm before.
#[must_use]
pub fn at(point: &Point) -> Option<[f64; 2]> {
    let seen = point.detection?;
    delay(point).filter(|_| 2 * seen.detected.of >= seen.early.of)
}

/// Median delay against false alarms, a curve for each detector and one for what no test can beat. Dots are the thresholds that are set,
/// rings the advised ones; the dashed line is the rate.
#[must_use]
pub fn delays(comparison: &Comparison) -> Panel {
    let points = || comparison.detectors.iter().flat_map(|compared| &compared.curve);
    let medians = points().filter_map(at).map(|[_, median]| median);
    let all = medians.chain(comparison.bounds.iter().map(|bound| bound.delay.median));
    let range = range(all);
    let top = range.map_or(1.0, |[_, top]| top);
    let y = Axis { steps: Steps::Log, range: range.or(Some([0.01, 1.0])), ..Axis::new("Median delay", "s", "s", 1.0) };
    let mut panel = Panel { title: DELAYS.into(), ..Panel::new(shares("Runs without contact that alarm"), y) };
    for compared in &comparison.detectors {
        let (role, style) = look(compared.method());
        let edges =
            compared.curve.iter().map(|point| at(point).and(delay_band(point, top)).unwrap_or([GAP; 2])).collect();
        panel.bands.push(Band { role, faint: true, edges });
        let points = compared.curve.iter().map(|point| at(point).unwrap_or(GAP)).collect();
        panel.series.push(Series::new(name(compared), role, style, points));
    }
    let bound = comparison.bounds.iter().map(|bound| [bound.rate, bound.delay.median]).collect();
    panel.series.push(Series::new(NO_TEST, Role::Bound, Style::Heavy, bound));
    for compared in &comparison.detectors {
        let role = look(compared.method()).0;
        let own = compared.own.as_ref().filter(|own| own.false_alarms.of > 0 && own.median.is_finite());
        mark(&mut panel, role, Style::Dots, own.map(|own| [own.false_alarms.rate, own.median]));
        mark(&mut panel, Role::Choice, Style::Rings, compared.taken().and_then(at));
    }
    panel.verticals.push(Vertical { name: "", x: comparison.rate, role: Role::Choice });
    panel
}

/// What a detector is called in a legend.
#[must_use]
pub fn name(compared: &Compared) -> &'static str {
    measure(compared.method()).detector
}

fn since(comparison: &Comparison) -> Axis {
    let last = comparison.place_bounds.last().map(|limit| limit.since);
    let axis = Axis::new("Time since contact", "s", "s", 1.0);
    Axis { range: last.map(|last| [0.0, last]), ..axis }
}

/// The estimators in the order of their places, each with its own.
fn estimators(comparison: &Comparison) -> Vec<(&'static str, Vec<&Place>)> {
    let of = |estimator: &Estimator| {
        let word = estimator.word();
        (word, comparison.places.iter().filter(|place| place.estimator == word).collect::<Vec<_>>())
    };
    Estimator::ALL.iter().map(of).filter(|(_, places)| !places.is_empty()).collect()
}

/// Root mean square error of the place against the time since contact, with Cramér and Rao's bound.
#[must_use]
pub fn errors(comparison: &Comparison) -> Panel {
    let all = comparison.places.iter().flat_map(|place| [place.rms_low, place.rms, place.rms_high]);
    // Right after the contact the bound is beyond all measure: the axis is that of what was estimated.
    let bounds = comparison.places.iter().filter_map(|place| place.bound);
    let y = Axis { steps: Steps::Log, range: range(all.chain(bounds)), ..Axis::new("RMS error", "m", "mm", MILLI) };
    let y = Axis { range: y.range.or(Some([1e-4, 1e-2])), ..y };
    let mut panel = Panel { title: ERRORS.into(), ..Panel::new(since(comparison), y) };
    for (word, places) in estimators(comparison) {
        let (role, style, name) = estimator_look(word);
        panel.series.push(Series::new(
            name,
            role,
            style,
            places.iter().map(|place| [place.since, place.rms]).collect(),
        ));
        let at = |place: &&Place| [place.rms_low, place.rms, place.rms_high].map(|rms| [place.since, rms]);
        panel.intervals.push(Intervals { name: String::new(), role, ends: places.iter().map(at).collect() });
    }
    let bound = comparison.place_bounds.iter().map(|limit| [limit.since, limit.bound]).collect();
    panel.series.push(Series::new(NO_ESTIMATE, Role::Bound, Style::Heavy, bound));
    panel
}

/// How many of the 95 % intervals hold the true place against the time since contact.
#[must_use]
pub fn coverage(comparison: &Comparison) -> Panel {
    let x = since(comparison);
    let ends = x.range.unwrap_or([0.0, 1.0]);
    let mut panel = Panel { title: COVERAGE.into(), ..Panel::new(x, shares("95 % intervals that hold it")) };
    for (word, places) in estimators(comparison) {
        let (role, style, name) = estimator_look(word);
        let covered = |place: &&Place| place.coverage.map(|share| (place.since, share));
        let covered: Vec<_> = places.iter().filter_map(covered).collect();
        if covered.is_empty() {
            continue;
        }
        panel.series.push(Series::new(
            name,
            role,
            style,
            covered.iter().map(|(at, share)| [*at, share.rate]).collect(),
        ));
        let ends = covered.iter().map(|(at, share)| [share.low, share.rate, share.high].map(|share| [*at, share]));
        panel.intervals.push(Intervals { name: String::new(), role, ends: ends.collect() });
    }
    let nominal = ends.map(|end| [end, NOMINAL]).to_vec();
    panel.series.push(Series::new("95 %", Role::Choice, Style::Dashed, nominal));
    panel
}

/// All pictures of a comparison; those of places where there are any.
#[must_use]
pub fn chart(compare: &Compare, comparison: &Comparison) -> Chart {
    let mut panels = vec![delays(comparison)];
    if !comparison.places.is_empty() {
        panels.extend([errors(comparison), coverage(comparison)]);
    }
    Chart { title: "Detectors side by side".into(), panels, caption: caption(compare, comparison) }
}

fn caption(compare: &Compare, comparison: &Comparison) -> String {
    let spec = compare.spec();
    let progress = compare.progress();
    let made = match progress.is_complete() {
        true => format!("{} repeats with contact and without", spec.repeats),
        false => format!("PARTIAL: {} of {} repeats with contact and without", comparison.repeats, spec.repeats),
    };
    let ring = match comparison.detectors.iter().any(|compared| compared.taken().is_some()) {
        true => "Rings: soonest of each with at most that many",
        false => "Rings, of which there are none: soonest with at most that many",
    };
    let set = &spec.scenario.calibration;
    let drawn = if *set == Default::default() { "a calibrated robot" } else { "calibration errors as set" };
    format!(
        "Simulated by Centrode, {made}: {}; {}; {drawn}; seed {}.\n\
         Bands: corners of the 95 % intervals of both axes. Shares lie on an arcsine scale, delays and errors on logarithmic ones. \
         No alarm is too late to count.\n\
         Dots: thresholds as set. Dashed line: {} false alarms. {ring}. Places are those of the first alarm of {}.",
        words::tracker(&spec.scenario),
        words::motion(&spec.scenario),
        spec.scenario.seed,
        words::percent(comparison.rate),
        spec.detector.key(),
    )
}
