//! The three plots.

use crate::app::charts::notation::{job, number};
use crate::app::charts::plots::View;
use crate::app::charts::plots::axis::Steps;
use crate::app::charts::plots::frame::{ReadOut, SMALL, Style};
use crate::app::charts::plots::marks::{Judged, empty};
use crate::app::charts::plots::range::top;
use crate::app::charts::plots::threshold::Line;
use crate::app::command::Command;
use centrode_core::detect::{Method, Standing};
use centrode_core::run::Sample;
use centrode_core::scenario::{Threshold, Xi1Rule};
use egui::{Color32, Ui};

/// Deviations are shown in mm.
const FCD: Judged = Judged { method: Method::Fcd, name: "‖c_m − c_s‖", scale: 1e3, unit: "mm", decimals: 2 };
/// Joint force deviations are shown in mN·m.
const JFD: Judged = Judged { method: Method::Jfd, name: "Θ", scale: 1e3, unit: "mN·m", decimals: 1 };

/// ‖c_m − c_s‖ with ξ2.
pub fn deviation(ui: &mut Ui, view: &mut View<'_>) {
    let settings = view.run.plan.scenario().detection.clone();
    let color = view.frame.theme.sensor;
    let value = |sample: &Sample| sample.judgement.deviation * FCD.scale;
    judging(
        ui,
        view,
        settings.xi2,
        |sample| Method::Fcd.statistic(&sample.judgement, sample.time, &settings).standing != Standing::Silent,
        value,
        Shown {
            judged: FCD,
            symbol: "ξ2",
            color,
            long: "Centrode deviation ‖c_m − c_s‖ (mm)",
            short: "‖c_m − c_s‖ (mm)",
            label: "Plot of the centrode deviation over time",
            judges: true,
            others: &[],
        },
    );
}

/// Θ with both rules of ξ1, and both bounds ε_c.
pub fn force(ui: &mut Ui, view: &mut View<'_>) {
    let settings = view.run.plan.scenario().detection.clone();
    let color = view.frame.theme.force;
    let value = |sample: &Sample| sample.judgement.residual * JFD.scale;
    let dim = view.frame.theme.dim;
    let follows = settings.xi1_rule == Xi1Rule::Bound;
    let on = follows && settings.xi1.value().is_some();
    let factor = settings.xi1_factor;
    judging(
        ui,
        view,
        settings.xi1,
        |_| true,
        value,
        Shown {
            judged: JFD,
            symbol: "ξ1",
            color,
            long: "Joint force deviation Θ (mN·m)",
            short: "Θ (mN·m)",
            label: "Plot of the joint force deviation over time",
            judges: !follows,
            others: &[
                Other {
                    name: "k·ε_c",
                    value: &|sample| factor * sample.judgement.shape_bound * JFD.scale,
                    color: if on { color } else { color.gamma_multiply(0.6) },
                    style: if on { Style::Thin } else { Style::Dashed },
                },
                Other {
                    name: "ε_c",
                    value: &|sample| sample.judgement.common_bound * JFD.scale,
                    color: dim,
                    style: Style::Thin,
                },
                Other {
                    name: "ε_c indep.",
                    value: &|sample| sample.judgement.independent_bound * JFD.scale,
                    color: dim,
                    style: Style::Dashed,
                },
            ],
        },
    );
}

/// What a plot with a threshold shows.
struct Shown<'a> {
    judged: Judged,
    symbol: &'static str,
    color: Color32,
    long: &'a str,
    short: &'a str,
    label: &'a str,
    /// Whether the constant judges, or one of the others in its place.
    judges: bool,
    others: &'a [Other<'a>],
}

/// A line beside the one that is judged.
struct Other<'a> {
    name: &'static str,
    value: &'a dyn Fn(&Sample) -> f64,
    color: Color32,
    style: Style,
}

fn judging(
    ui: &mut Ui,
    view: &mut View<'_>,
    threshold: Threshold,
    is_judged: impl Fn(&Sample) -> bool + Copy,
    value: impl Fn(&Sample) -> f64,
    shown: Shown<'_>,
) {
    let which = view.which;
    let otherwise = view.state.otherwise[which];
    let high = view.state.held[which].unwrap_or_else(|| {
        let (method, thresholds) = (shown.judged.method, &view.run.plan.scenario().detection);
        let counts = |sample: &Sample| method.statistic(&sample.judgement, sample.time, thresholds).counted().is_some();
        let mut values: Vec<f64> = view.run.samples().filter(counts).map(|sample| value(&sample)).collect();
        top(threshold.value().unwrap_or(otherwise) * shown.judged.scale, &mut values)
    });
    let values = view.frame.values([0.0, high]);
    let frame = view.frame;
    let painter = ui.painter().clone();
    let now = view.run.sample_at(view.cursor);
    let decimals = shown.judged.decimals;
    let mut readouts = vec![ReadOut {
        name: if shown.others.is_empty() { "" } else { shown.judged.name },
        value: number(value(&now), decimals),
        color: shown.color,
        style: Style::Strong,
    }];
    readouts.extend(shown.others.iter().map(|other| ReadOut {
        name: other.name,
        value: number((other.value)(&now), decimals),
        color: other.color,
        style: other.style,
    }));

    view.scrub(ui, shown.label);
    frame.title(&painter, shown.long, shown.short, &readouts);
    frame.grid(&painter, &values, Steps::Decimal);
    view.unarmed(&painter);
    view.contact(&painter, 4.0);
    for other in shown.others {
        frame.curve(&painter, view.run, &values, |sample| (other.value)(sample), other.color, other.style);
    }
    // What is not judged, for the robot hardly turns, stands back.
    let part = |moving: bool| {
        let value = &value;
        move |sample: &Sample| if is_judged(sample) == moving { value(sample) } else { f64::NAN }
    };
    let back = shown.color.gamma_multiply(0.35);
    let still = frame.curve(&painter, view.run, &values, part(false), back, Style::Thin);
    let moving = frame.curve(&painter, view.run, &values, part(true), shown.color, Style::Strong);
    if still.is_empty() && moving.is_empty() {
        empty(&painter, &frame, "not defined anywhere in this run");
    }
    frame.off_scale(&painter, &values, &moving, shown.color);
    view.detection(&painter);
    let mut dots: Vec<_> = shown.others.iter().map(|other| ((other.value)(&now), other.color)).collect();
    dots.push((value(&now), shown.color));
    view.cursor(&painter, &values, &dots);

    view.arming(ui, &painter);
    if which == 0 {
        view.detection_label(&painter);
    }
    let line = Line {
        name: shown.symbol,
        threshold,
        otherwise,
        judged: shown.judged,
        color: shown.color,
        judges: shown.judges,
    };
    let outcome = view.threshold(ui, &values, &line);
    view.state.held[which] = outcome.moving.then_some(high);
    if let Some(changed) = outcome.changed {
        view.out.push(match shown.judged.method {
            Method::Fcd => Command::SetXi2(changed),
            Method::Jfd => Command::SetXi1(changed),
        });
    }
    if !view.crossings(ui, &painter, &values, shown.judged, shown.color) {
        view.hover(&painter, |sample| {
            let line = |name: &str, value: f64, color| {
                job(&format!("{name} {} {}", number(value, decimals), shown.judged.unit), SMALL + 1.0, color)
            };
            let mut lines = vec![line(shown.judged.name, value(sample), shown.color)];
            lines.extend(shown.others.iter().map(|other| line(other.name, (other.value)(sample), other.color)));
            lines
        });
    }
}

/// θL, with the contact shaded.
pub fn angle(ui: &mut Ui, view: &mut View<'_>) {
    let frame = view.frame;
    let theme = frame.theme;
    let painter = ui.painter().clone();
    let value = |sample: &Sample| sample.theta_l.to_degrees();
    let motion = &view.run.plan.scenario().motion;
    let (a, b) = (motion.theta_start.to_degrees(), motion.theta_end.to_degrees());
    let margin = 0.08 * (a - b).abs().max(10.0);
    let values = frame.values([a.min(b) - margin, a.max(b) + margin]);
    let now = view.run.sample_at(view.cursor);
    let readout = ReadOut { name: "", value: number(value(&now), 1), color: theme.robot, style: Style::Strong };
    view.scrub(ui, "Plot of the tangent angle over time");
    frame.title(&painter, "Tangent angle θ_L (°)", "θ_L (°)", &[readout]);
    frame.grid(&painter, &values, Steps::Degrees);
    view.contact(&painter, frame.data.height());
    frame.curve(&painter, view.run, &values, value, theme.robot, Style::Strong);
    view.detection(&painter);
    view.cursor(&painter, &values, &[(value(&now), theme.robot)]);
    view.hover(&painter, |sample| vec![job(&format!("θ_L {}°", number(value(sample), 2)), SMALL + 1.0, theme.ink)]);
}
