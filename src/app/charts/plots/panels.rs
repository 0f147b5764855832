//! The plots: one for each detector, and the tangent angle.

use crate::app::charts::notation::{job, number};
use crate::app::charts::paint;
use crate::app::charts::plots::View;
use crate::app::charts::plots::frame::{ReadOut, SMALL};
use crate::app::charts::plots::marks::empty;
use crate::app::charts::plots::threshold::Line;
use crate::app::command::Command;
use crate::app::theme::Theme;
use centrode_core::chart::layout::Ink;
use centrode_core::chart::{Role, Style};
use centrode_core::detect::Method;
use centrode_core::run::Sample;
use centrode_core::scenario::{Scenario, Threshold, Xi1Rule};
use centrode_core::study::course::{Curve, Measure, curves, events, measure};
use egui::{Color32, Ui};

/// The threshold of a detector as a plot's line sets it: what it is, and whether it judges or something else in its place.
fn set(method: Method, scenario: &Scenario) -> (Threshold, bool) {
    let detection = &scenario.detection;
    (detection.of(method), method != Method::Jfd || detection.xi1_rule == Xi1Rule::Constant)
}

/// The threshold of a detector (SI) that its plot should show: the one that is set, else `otherwise`.
pub fn threshold(method: Method, scenario: &Scenario, otherwise: f64) -> f64 {
    set(method, scenario).0.value().unwrap_or(otherwise)
}

/// The colour of a curve.
fn color(role: Role, theme: &Theme) -> Color32 {
    paint::color(Ink::Role(role), theme)
}

/// A value with its unit, where it has one.
fn with_unit(value: &str, unit: &str) -> String {
    format!("{value} {unit}").trim_end().into()
}

/// What the detectors of a plot judge, with their thresholds and events. All of them are shown in the unit of the first.
pub fn judging(ui: &mut Ui, view: &mut View<'_>, methods: &[Method]) {
    let Some(&first) = methods.first() else { return };
    let run = view.run;
    let scenario = run.plan.scenario();
    let theme = view.frame.theme;
    let Measure { name, symbol, scale, unit, decimals, .. } = measure(first);
    let curves: Vec<Curve> = methods.iter().flat_map(|&method| curves(method, &scenario.detection)).collect();
    let value = |curve: &Curve, sample: &Sample| (curve.value)(sample, &scenario.detection) * scale;
    let ink = |curve: &Curve| color(curve.role, &theme);
    let now = run.sample_at(view.cursor);
    let readout = |curve: &Curve| ReadOut {
        name: if curves.len() > 1 { curve.name } else { "" },
        value: number(value(curve, &now), decimals),
        color: ink(curve),
        style: curve.style,
    };
    let readouts: Vec<ReadOut> = curves.iter().map(readout).collect();
    let painter = ui.painter().clone();

    view.scrub(ui, &format!("Plot of the {} over time", name.to_lowercase()));
    let unit_behind = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
    let (long, short) = (format!("{name} {symbol}{unit_behind}"), format!("{symbol}{unit_behind}"));
    view.frame.title(&painter, &long, &short, &readouts);
    if !view.has_values() {
        empty(&painter, &view.frame, "no values in this run");
    }
    let dots: Vec<_> = curves.iter().rev().map(|curve| (value(curve, &now), ink(curve))).collect();
    view.between(&painter);
    view.cursor(&painter, &dots);

    let wait = methods.iter().all(|&method| scenario.detection.waits(method));
    if wait {
        view.arming(ui, &painter);
    }
    if view.which == 0 {
        view.detection_label(&painter, wait);
    }
    for (place, &method) in methods.iter().enumerate() {
        let (threshold, judges) = set(method, scenario);
        let measure = measure(method);
        let color = color(measure.role, &theme);
        let line = Line { measure, threshold, otherwise: view.otherwise(method), color, judges, place };
        let outcome = view.threshold(ui, &line);
        view.hold(method, outcome.moving);
        view.out.extend(outcome.changed.map(|to| Command::SetThreshold(method, to)));
        view.over(&painter, &events(run, method));
    }
    view.change(&painter, symbol);
    if !methods.iter().any(|&method| view.event(ui, &painter, method)) {
        view.hover(&painter, |sample| {
            let line = |curve: &Curve| {
                let text = with_unit(&format!("{} {}", curve.name, number(value(curve, sample), decimals)), unit);
                job(&text, SMALL + 1.0, ink(curve))
            };
            curves.iter().map(line).collect()
        });
    }
}

/// θL, with the contact shaded.
pub fn angle(ui: &mut Ui, view: &mut View<'_>) {
    let theme = view.frame.theme;
    let painter = ui.painter().clone();
    let value = |sample: &Sample| sample.theta_l.to_degrees();
    let now = view.run.sample_at(view.cursor);
    let readout = ReadOut { name: "", value: number(value(&now), 1), color: theme.robot, style: Style::Line };
    view.scrub(ui, "Plot of the tangent angle over time");
    view.frame.title(&painter, "Tangent angle θ_L (°)", "θ_L (°)", &[readout]);
    view.between(&painter);
    view.cursor(&painter, &[(value(&now), theme.robot)]);
    view.change(&painter, "θ_L");
    view.hover(&painter, |sample| vec![job(&format!("θ_L {}°", number(value(sample), 2)), SMALL + 1.0, theme.ink)]);
}
