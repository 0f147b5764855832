//! A run over time as panels: what each detector judges, with what it is compared with, and the tangent angle.

pub mod between;
pub mod range;

use crate::chart::ticks::Steps;
use crate::chart::{Axis, Panel, Role, Series, Span, Style, Vertical};
use crate::detect::{Detection, Event, Method, Standing};
use crate::plant::{Happening, PlantEvent};
use crate::run::{Run, Sample};
use crate::scenario::{Detectors, Thresholds, Xi1Rule};

/// Room beyond the angles of the motion, as a share of their difference, and the least difference that counts, rad.
const MARGIN: f64 = 0.08;
const LEAST: f64 = 0.174_532_925_199_432_95;

/// How the values of a detector are called and shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// The detector.
    pub detector: &'static str,
    /// The symbol of its value.
    pub symbol: &'static str,
    /// Its value in words.
    pub name: &'static str,
    /// The symbol of its threshold.
    pub threshold: &'static str,
    /// Values are multiplied by this to be shown.
    pub scale: f64,
    /// Unit of the numbers.
    pub si_unit: &'static str,
    /// Unit shown.
    pub unit: &'static str,
    /// Decimals shown.
    pub decimals: usize,
    /// What its value means.
    pub role: Role,
}

/// How the values of a detector are called and shown; the units are those of its threshold's key.
#[must_use]
pub fn measure(method: Method) -> Measure {
    let (detector, symbol, name, threshold, role, decimals) = match method {
        Method::Fcd => ("Centrode", "‖c_m − c_s‖", "Centrode deviation", "ξ_2", Role::Sensor, 2),
        Method::Jfd => ("Joint forces", "Θ", "Joint force deviation", "ξ_1", Role::Force, 1),
        Method::FcdConsistent => {
            ("Consistent centrode", "‖c_f − c_s‖", "Consistent centrode deviation", "ξ_f", Role::Sensor, 2)
        }
        Method::FcdVelocity => ("Velocity", "ω_s‖c_m − c_s‖", "Velocity deviation", "ξ_v", Role::Sensor, 2),
        Method::Cusum => ("CUSUM", "g", "Log likelihood ratio", "h", Role::Likelihood, 2),
        Method::Glr => ("GLR", "Λ", "Log likelihood ratio", "h_Λ", Role::Likelihood, 2),
    };
    let quantity = method.quantity();
    let si_unit = match quantity.si_unit() {
        "" => "1",
        unit => unit,
    };
    let (scale, unit) = (quantity.shown(1.0), quantity.unit());
    Measure { detector, symbol, name, threshold, scale, si_unit, unit, decimals, role }
}

/// The detectors that judge, as they share plots: [`Method::Cusum`] and [`Method::Glr`] have one.
#[must_use]
pub fn plots(detectors: Detectors) -> Vec<Vec<Method>> {
    const SHARED: [&[Method]; 5] = [
        &[Method::Fcd],
        &[Method::FcdConsistent],
        &[Method::FcdVelocity],
        &[Method::Jfd],
        &[Method::Cusum, Method::Glr],
    ];
    let judge = |methods: &&[Method]| methods.iter().copied().filter(|&method| detectors.has(method)).collect();
    SHARED.iter().map(judge).filter(|methods: &Vec<Method>| !methods.is_empty()).collect()
}

/// Whether a plot of a detector says something: those of the paper always do, the others where they have a value.
#[must_use]
pub fn has_plot(run: &Run, method: Method) -> bool {
    method.is_of_paper() || run.judged.evidence.iter().any(|evidence| method.value(&evidence.judgement).is_finite())
}

/// A curve over time.
#[derive(Debug, Clone, Copy)]
pub struct Curve {
    /// Its name.
    pub name: &'static str,
    /// What it means.
    pub role: Role,
    /// How it is drawn.
    pub style: Style,
    /// Its value, SI; NaN where it is not defined.
    pub value: fn(&Sample, &Thresholds) -> f64,
}

/// What a detector judges, and behind it what that is compared with.
#[must_use]
pub fn curves(method: Method, thresholds: &Thresholds) -> Vec<Curve> {
    let Measure { symbol, role, .. } = measure(method);
    let judged = |value| Curve { name: symbol, role, style: Style::Line, value };
    match method {
        Method::Fcd => vec![judged(|sample, _| sample.judgement.deviation)],
        Method::Jfd => {
            let follows = thresholds.xi1_rule == Xi1Rule::Bound && thresholds.xi1.value().is_some();
            let style = if follows { Style::LongDashed } else { Style::Dotted };
            vec![
                judged(|sample, _| sample.judgement.residual),
                Curve {
                    name: "k·ε_c",
                    role,
                    style,
                    value: |sample, thresholds| thresholds.xi1_factor * sample.judgement.shape_bound,
                },
                Curve {
                    name: "ε_c",
                    role: Role::Aside,
                    style: Style::Thin,
                    value: |sample, _| sample.judgement.common_bound,
                },
                Curve {
                    name: "ε_c indep.",
                    role: Role::Aside,
                    style: Style::Dashed,
                    value: |sample, _| sample.judgement.independent_bound,
                },
            ]
        }
        Method::FcdConsistent => vec![judged(|sample, _| sample.judgement.consistent)],
        Method::FcdVelocity => vec![judged(|sample, _| sample.judgement.velocity)],
        Method::Cusum => vec![judged(|sample, _| sample.judgement.cusum)],
        // Beside the line of CUSUM, with which it shares a plot.
        Method::Glr => vec![Curve { style: Style::Dashed, ..judged(|sample, _| sample.judgement.glr) }],
    }
}

/// How high the plot of a detector reaches, SI, where its line is to be seen at a `threshold` (SI): see [`range::top`].
#[must_use]
pub fn top(run: &Run, method: Method, threshold: f64) -> f64 {
    let (thresholds, scale) = (&run.judged.settings.thresholds, measure(method).scale);
    let counted = |sample: Sample| method.statistic(&sample.judgement, sample.time, thresholds).counted();
    let mut values: Vec<f64> = run.samples().filter_map(counted).map(|value| value * scale).collect();
    range::top(threshold * scale, &mut values) / scale
}

/// What the detectors of a plot judge over time, up to `top` (SI): behind it what that is compared with; where it is not judged it
/// stands back. Thresholds and the [`events`] are not drawn. Without detectors it is empty.
#[must_use]
pub fn statistic(run: &Run, methods: &[Method], top: f64) -> Panel {
    let thresholds = &run.judged.settings.thresholds;
    let Some(&first) = methods.first() else { return over_time(run, Axis::new("", "1", "", 1.0)) };
    let Measure { symbol, name, scale, si_unit, unit, .. } = measure(first);
    let y = Axis { range: Some([0.0, top]), ..Axis::new(symbol, si_unit, unit, scale) };
    let mut panel = Panel { title: name.into(), off_scale: true, ..over_time(run, y) };
    if methods.iter().all(|&method| thresholds.waits(method)) {
        panel.spans.push(unarmed([0.0, end(run)], thresholds.armed_from));
    }
    panel.spans.extend(held(&contacts(run), true));
    for &method in methods {
        let mut all = curves(method, thresholds).into_iter();
        let judged = all.next();
        for Curve { name, role, style, value } in all {
            let points = run.samples().map(|sample| [sample.time, value(&sample, thresholds)]).collect();
            panel.series.push(Series::new(name, role, style, points));
        }
        for (faint, counts) in [(true, false), (false, true)] {
            let Some(Curve { name, role, style, value }) = judged else { continue };
            let point = |sample: Sample| {
                let value = value(&sample, thresholds);
                let standing = method.standing(value, sample.judgement.speed, sample.time, thresholds);
                [sample.time, if (standing != Standing::Silent) == counts { value } else { f64::NAN }]
            };
            let name = if faint { "" } else { name };
            let points = run.samples().map(point).collect();
            panel.series.push(Series { faint, ..Series::new(name, role, style, points) });
        }
    }
    panel
}

/// θL over time, with the contact shaded.
#[must_use]
pub fn angle(run: &Run) -> Panel {
    let points: Vec<[f64; 2]> = run.samples().map(|sample| [sample.time, sample.theta_l]).collect();
    let motion = &run.plan.scenario().motion;
    let mut ends = [motion.theta_start, motion.theta_end];
    if run.is_recorded() {
        // A log moves as it did, whatever the scenario says.
        let finite = || points.iter().map(|point| point[1]).filter(|angle| angle.is_finite());
        let own = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
        ends = if own[0].is_finite() { own } else { ends };
    }
    bent(over_time(run, angles(ends)), &contacts(run), points)
}

/// The axis of θL between two angles.
pub(super) fn angles([a, b]: [f64; 2]) -> Axis {
    let margin = MARGIN * (a - b).abs().max(LEAST);
    let range = Some([a.min(b) - margin, a.max(b) + margin]);
    Axis { range, steps: Steps::Degrees, ..Axis::new("θ_L", "rad", "°", 180.0 / std::f64::consts::PI) }
}

/// A panel with θL and the times during which a contact holds.
pub(super) fn bent(mut panel: Panel, contacts: &[[f64; 2]], points: Vec<[f64; 2]>) -> Panel {
    panel.title = "Tangent angle".into();
    panel.spans.extend(held(contacts, false));
    panel.spans.extend(held(contacts, true).map(|span| Span { name: "", ..span }));
    panel.series.push(Series::new("θ_L", Role::Robot, Style::Line, points));
    panel
}

/// The events of a detector at its threshold: a diamond where one is raised, a circle where it is cleared. The one that the
/// detection is made of has its colour.
#[must_use]
pub fn events(run: &Run, method: Method) -> Vec<Series> {
    marks(&run.judged.events, run.detection(), method)
}

/// The same of events in their order, with the detection that is made of one of them.
pub(super) fn marks(events: &[Event], detection: Option<Detection>, method: Method) -> Vec<Series> {
    let own = || events.iter().filter(|event| event.detector == method);
    let found = |event: &Event| is_made_of(detection, event);
    let role = |event: &Event| if found(event) { Role::Detection } else { measure(method).role };
    let cleared = own().filter_map(|event| Some([event.cleared?, event.threshold])).collect();
    let mut all = vec![Series::new("cleared", measure(method).role, Style::Circles, cleared)];
    let raised = own().map(|event| (role(event), [event.raised, event.threshold]));
    all.extend(raised.map(|(role, at)| Series::new("raised", role, Style::Diamonds, vec![at])));
    all
}

/// Whether an event is the one that the detection of a run is made of.
#[must_use]
pub fn is_detection(run: &Run, event: &Event) -> bool {
    is_made_of(run.detection(), event)
}

fn is_made_of(detection: Option<Detection>, event: &Event) -> bool {
    event.detector == Method::Fcd && event.detection.is_some() && event.detection == detection
}

/// A panel over the time of a run, with its detection.
fn over_time(run: &Run, y: Axis) -> Panel {
    let mut panel = timed([0.0, end(run)], y, run.detection());
    panel.verticals.extend(let_go(run.plant_events()));
    panel
}

/// Where a segment loses its beam without the motion taking it off.
pub(super) fn let_go(plant: &[PlantEvent]) -> impl Iterator<Item = Vertical> {
    plant.iter().filter_map(|event| {
        let name = match event.what {
            Happening::Snapped => "snaps off",
            Happening::SlidOff => "slides off",
            Happening::Wrapped => "would wrap",
            Happening::Met | Happening::Opened => return None,
        };
        Some(Vertical { name, x: event.time, role: Role::Contact })
    })
}

/// A panel over times (s), with a detection.
pub(super) fn timed(ends: [f64; 2], y: Axis, detection: Option<Detection>) -> Panel {
    let x = Axis { range: Some(ends), ..Axis::new("Time", "s", "s", 1.0) };
    let detection = detection.map(|found| Vertical { name: "detection", x: found.time, role: Role::Detection });
    Panel { verticals: detection.into_iter().collect(), ..Panel::new(x, y) }
}

/// Time of the last sample, s.
#[must_use]
pub fn end(run: &Run) -> f64 {
    run.sample(run.len() - 1).time
}

/// Times during which a contact holds, as spans.
pub(super) fn held(contacts: &[[f64; 2]], low: bool) -> impl Iterator<Item = Span> {
    contacts.iter().map(move |&ends| Span { name: "contact", role: Role::Contact, low, ends })
}

/// Times before alarms are armed, as a span.
pub(super) fn unarmed([from, to]: [f64; 2], armed_from: f64) -> Span {
    Span { name: "not armed", role: Role::Aside, low: false, ends: [from, armed_from.clamp(from, to.max(from))] }
}

/// Truth: times during which a contact holds the backbone, s.
#[must_use]
pub fn contacts(run: &Run) -> Vec<[f64; 2]> {
    let mut spans: Vec<[f64; 2]> = Vec::new();
    let mut held = false;
    for sample in run.samples() {
        match spans.last_mut() {
            Some(span) if sample.in_contact && held => span[1] = sample.time,
            _ if sample.in_contact => spans.push([sample.time; 2]),
            _ => {}
        }
        held = sample.in_contact;
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::simulate;
    use crate::scenario::preset::find;

    fn run(name: &str) -> Run {
        simulate(&find(name).and_then(|preset| preset.scenario()).expect("preset")).expect("run")
    }

    #[test]
    fn contact_is_one_span_that_starts_at_the_truth() {
        let run = run("paper");
        let spans = contacts(&run);
        assert_eq!(spans, [[run.contact_time().expect("contact"), 10.0]]);
    }

    #[test]
    fn the_angle_of_a_log_has_a_range_of_its_own() {
        let log = run("bench");
        let mut scenario = log.plan.scenario().clone();
        (scenario.motion.theta_start, scenario.motion.theta_end) = (1.5, 1.4);
        let recording = crate::record::Recording { truth: None, ..log.recording.clone() };
        let plan = crate::scenario::Plan::new(&scenario).expect("possible");
        let panel = angle(&Run::recorded(plan, recording).expect("entries"));
        assert_eq!(panel.y.range, angle(&log).y.range);
    }

    #[test]
    fn contact_that_opens_again_ends() {
        let spans = contacts(&run("letting-go"));
        assert_eq!(spans.len(), 1);
        assert!(spans[0][0] == 0.0 && spans[0][1] < 8.0);
        assert!(contacts(&run("free")).is_empty());
    }

    #[test]
    fn every_value_is_drawn_once_and_what_is_not_judged_stands_back() {
        let run = run("bench");
        for &method in Method::PAPER {
            let panel = statistic(&run, &[method], 0.1);
            let [.., still, judged] = &panel.series[..] else { panic!("{method:?}") };
            assert!(still.faint && !judged.faint);
            let value = curves(method, &run.judged.settings.thresholds)[0].value;
            for (k, sample) in run.samples().enumerate() {
                let (value, a, b) = (value(&sample, &Thresholds::default()), still.points[k][1], judged.points[k][1]);
                assert!(value.is_nan() || (a == value) != (b == value), "{method:?} at {} s", sample.time);
            }
        }
    }

    #[test]
    fn likelihood_ratios_share_a_plot_and_what_has_no_value_has_none() {
        let all = plots(Detectors::of(Method::ALL));
        assert_eq!(all.last().map(Vec::as_slice), Some(&[Method::Cusum, Method::Glr][..]));
        assert_eq!((all.len(), all.concat().len()), (5, Method::ALL.len()));
        assert_eq!(plots(Detectors::of(&[Method::Glr])), [[Method::Glr]]);
        let mut run = run("bench");
        assert!(has_plot(&run, Method::Jfd) && !has_plot(&run, Method::FcdConsistent) && !has_plot(&run, Method::Glr));
        let mut scenario = run.plan.scenario().clone();
        scenario.detection.detectors = Detectors::of(&[Method::FcdConsistent]);
        run.update(crate::scenario::Plan::new(&scenario).expect("possible"));
        assert!(has_plot(&run, Method::FcdConsistent));
        let panel = statistic(&run, &[Method::FcdConsistent], 0.1);
        assert!(panel.spans.iter().all(|span| span.name != "not armed"), "it does not wait");
    }

    #[test]
    fn marks_are_events_and_not_crossings() {
        let run = run("bench");
        let (events, crossings) = (&run.judged.events, run.crossings());
        assert!(crossings.len() > events.len(), "noise crosses a threshold more often than it raises an alarm");
        for &method in Method::ALL {
            let marks = super::events(&run, method);
            let own = events.iter().filter(|event| event.detector == method);
            assert_eq!(marks.len() - 1, own.clone().count());
            assert_eq!(marks[0].points.len(), own.clone().filter(|event| event.cleared.is_some()).count());
            let colours = marks[1..].iter().filter(|series| series.role == Role::Detection).count();
            assert_eq!(colours, usize::from(method == Method::Fcd), "{method:?}");
        }
    }
}
