//! What a comparison says, in sentences and notes.

use crate::app::charts::notation::{self, job, number};
use crate::app::charts::paint::Place;
use crate::app::stages::Inputs;
pub use crate::app::stages::tuning::wished;
use crate::app::stages::tuning::{interval, percent};
use crate::app::theme::Theme;
use centrode_core::chart::notation::printed;
use centrode_core::chart::{Axis, Panel};
use centrode_core::detect::Method;
use centrode_core::scenario::{Scenario, Xi1Rule};
use centrode_core::study::compare::{Compared, Comparison, chart};
use centrode_core::study::course::measure;
use centrode_core::study::tuning::Point;
use centrode_core::study::tuning::recommend::Verdict;
use egui::text::LayoutJob;
use egui::{Painter, Pos2, Stroke};

/// The pointer reads a point this near, points.
const REACH: f32 = 24.0;

/// What a detector is called where there is little room.
pub fn short(method: Method) -> &'static str {
    match method {
        Method::Fcd => "FCD",
        Method::Jfd => "JFD",
        Method::FcdConsistent => "Consistent",
        Method::FcdVelocity => "Velocity",
        Method::Cusum => "CUSUM",
        Method::Glr => "GLR",
    }
}

/// A threshold with its symbol and unit.
pub fn threshold(method: Method, value: f64, rule: Xi1Rule) -> String {
    let measure = measure(method);
    let (symbol, scale, unit) = match (method, rule) {
        (Method::Jfd, Xi1Rule::Bound) => ("k", 1.0, ""),
        _ => (measure.threshold, measure.scale, measure.unit),
    };
    let shown = value * scale;
    // Three digits of it.
    let decimals = (2 - shown.abs().max(1e-9).log10().floor() as i32).clamp(0, 6) as usize;
    let digits = number(shown, decimals);
    let digits = if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { &digits };
    format!("{symbol} = {digits} {unit}").trim_end().to_owned()
}

pub fn rule(inputs: &Inputs<'_>) -> Xi1Rule {
    inputs.comparer.shown().map_or(Xi1Rule::Constant, |(compare, ..)| compare.spec().scenario.detection.xi1_rule)
}

fn runs(comparison: &Comparison) -> String {
    let repeats = comparison.repeats;
    format!("{repeats} {} without and as many with contact", if repeats == 1 { "run" } else { "runs" })
}

/// Which detector is soonest, and what no test can beat.
pub fn summary(comparison: &Comparison, inputs: &Inputs<'_>) -> String {
    if comparison.repeats == 0 {
        return "Making the first runs …".into();
    }
    let wish = wished(comparison.rate);
    let left = inputs.comparer.left().is_some();
    let so_far = match left {
        _ if inputs.comparer.is_former() => "With the settings before: ",
        true => "So far: ",
        false => "",
    };
    let told = match comparison.advice() {
        Some((method, point)) => format!(
            "Soonest with at most {wish} % false alarms: {}, {}, {} s after contact (median).",
            short(method),
            threshold(method, point.threshold, rule(inputs)),
            number(point.detection.map_or(f64::NAN, |seen| seen.median), 3),
        ),
        None => format!(
            "No threshold of these detectors is shown to give at most {wish} % false alarms and detects half of the contacts."
        ),
    };
    let bound = comparison
        .bound
        .filter(|bound| bound.median.is_finite())
        .map_or_else(String::new, |bound| format!(" No test at that rate can beat {} s.", number(bound.median, 3)));
    format!("{so_far}{told}{bound} From {}.", runs(comparison))
}

/// What is advised for one detector.
pub fn line(compared: &Compared, soonest: bool, inputs: &Inputs<'_>) -> String {
    let name = short(compared.method());
    match &compared.advised {
        Verdict::Take { point, .. } => {
            let seen = point.detection;
            let (median, ninety) = seen.map_or((f64::NAN, f64::NAN), |seen| (seen.median, seen.ninety));
            let within =
                if ninety.is_nan() { String::new() } else { format!(" (90 % within {} s)", number(ninety, 2)) };
            let best = if soonest { ", the soonest" } else { "" };
            format!(
                "{name}{best}: {} after {} s{within}, {} of {} false alarms ({})",
                threshold(compared.method(), point.threshold, rule(inputs)),
                number(median, 3),
                point.false_alarms.rate.count,
                point.false_alarms.rate.of,
                interval(&point.false_alarms.rate),
            )
        }
        Verdict::TooFewRuns { needed } => {
            format!("{name}: nothing can be shown with fewer than {needed} runs, even when none gives a false alarm")
        }
        Verdict::NoneQuiet { lowest } => {
            format!("{name}: no threshold; the best may give up to {} %", percent(*lowest))
        }
        Verdict::NoneFinds { best } => {
            format!("{name}: no threshold that detects half of the contacts; the best detects {} %", percent(*best))
        }
        Verdict::NoContact => format!("{name}: the robot never reaches the contact"),
    }
}

/// A threshold under the pointer.
pub fn note(compared: &Compared, point: &Point, rule: Xi1Rule, theme: &Theme) -> Vec<LayoutJob> {
    let method = compared.method();
    let alarms = point.false_alarms.rate;
    let mut lines = vec![
        job(&format!("{}, {}", short(method), threshold(method, point.threshold, rule)), 11.5, theme.ink),
        job(&format!("alarms {} of {}", alarms.count, alarms.of), 11.5, theme.dim),
    ];
    if let Some(seen) = point.detection {
        lines.push(job(&format!("found {} of {}", seen.detected.count, seen.detected.of), 11.5, theme.dim));
        lines.push(job(&format!("after {} s", number(seen.median, 3)), 11.5, theme.dim));
    }
    lines
}

/// A picture in words.
pub fn described(panel: &Panel, comparison: &Comparison) -> String {
    let mut text = panel.title.clone();
    let add = |text: &mut String, part: String| text.push_str(&part);
    if panel.title == chart::DELAYS {
        let at = |compared: &Compared| {
            let equal = compared.equal.as_ref().filter(|equal| equal.median.is_finite())?;
            Some(format!("{} {} s", short(compared.method()), number(equal.median, 3)))
        };
        let known: Vec<_> = comparison.detectors.iter().filter_map(at).collect();
        let rate = wished(comparison.rate);
        add(&mut text, format!(". Median at {rate} % false alarms: {}", known.join(", ")));
        if let Some(bound) = comparison.bound {
            add(&mut text, format!("; no test can beat {} s", number(bound.median, 3)));
        }
        return text;
    }
    for place in &comparison.places {
        add(&mut text, format!(". {} after {} s: ", place.estimator, number(place.since, 2)));
        match (&place.coverage, panel.title == chart::COVERAGE) {
            (Some(share), true) => add(&mut text, format!("{} of {}", share.count, share.of)),
            (None, true) => add(&mut text, "no interval".into()),
            _ => {
                let bound = place.bound.map_or_else(|| "–".into(), |bound| number(bound * 1e3, 2));
                add(&mut text, format!("RMS {} mm, bound {bound} mm", number(place.rms * 1e3, 2)));
            }
        }
    }
    text
}

/// Reads the nearest point of a picture that is under the pointer.
pub fn read(painter: &Painter, place: &Place, (panel, pointer): (&Panel, Pos2), theme: &Theme) {
    if panel.title == chart::DELAYS {
        return;
    }
    let points = panel.series.iter().flat_map(|series| series.points.iter().map(move |point| (series, *point)));
    let near = points
        .filter(|(_, point)| point.iter().all(|value| value.is_finite()))
        .map(|(series, point)| (place.at(point), series, point))
        .filter(|(at, ..)| at.distance(pointer) < REACH)
        .min_by(|a, b| a.0.distance(pointer).total_cmp(&b.0.distance(pointer)));
    let Some((at, series, point)) = near else { return };
    painter.circle_stroke(at, 4.5, Stroke::new(1.5, theme.ink));
    let line = |axis: &Axis, value: f64| {
        job(&format!("{} {} {}", printed(axis.name), number(value * axis.scale, 2), axis.unit), 11.5, theme.ink)
    };
    let lines = vec![job(&series.name, 11.5, theme.dim), line(&panel.x, point[0]), line(&panel.y, point[1])];
    notation::note(painter, theme, at, place.data(), lines);
}

/// The command that makes this comparison.
pub fn command(inputs: &Inputs<'_>) -> String {
    let (name, base): (&str, &Scenario) = inputs.base;
    let (scenario, hint) = match base == inputs.plan.scenario() {
        true => (format!("--preset {name}"), ""),
        false => ("my.toml".into(), "   (my.toml: this scenario)"),
    };
    let tuning = inputs.tuning;
    let detectors: Vec<&str> = tuning.compare.iter().map(Method::key).collect();
    format!(
        "centrode study {scenario} --repeats {} --detectors {} --rate {} --svg detectors.svg{hint}",
        tuning.repeats,
        detectors.join(","),
        tuning.wish
    )
}
