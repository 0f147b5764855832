//! What the detectors hold against their thresholds over time, and the tangent angle, as a chart: of a run or of a log.
//!
//! It looks as the live plots do, but takes samples one by one and keeps few points of each curve, so that a long run needs no more
//! memory than a short one.

use super::course::{Curve, Measure, angles, bent, curves, held, let_go, marks, measure, timed, unarmed};
use super::figure::thin::Thinner;
use super::figure::words;
use crate::chart::notation::plain;
use crate::chart::{Axis, Chart, Panel, Role, Series, Style};
use crate::detect::{Detection, Event, Method, Standing};
use crate::plant::PlantEvent;
use crate::run::{Run, Sample};
use crate::scenario::{Plan, Scenario};

/// An axis reaches at least this many times the threshold, and this many times what is judged.
const HEADROOM: [f64; 2] = [1.6, 1.1];
/// It never reaches more than this many times the threshold.
const MOST: f64 = 4.0;
/// More events than this are no longer told apart.
const MOST_EVENTS: usize = 200;
/// What a simulated run's chart is called.
const TITLE: &str = "Contact detection over time";

/// Takes samples one by one.
#[derive(Debug)]
pub struct Timeline {
    scenario: Scenario,
    detectors: Vec<Detector>,
    bend: Thinner,
    /// Smallest and largest θL, rad.
    bends: Option<[f64; 2]>,
    /// Times during which a contact holds, s, and whether one does.
    contacts: Vec<[f64; 2]>,
    touches: bool,
    ends: Option<[f64; 2]>,
}

/// What is kept of one detector.
#[derive(Debug)]
struct Detector {
    method: Method,
    /// Behind what is judged, what that is compared with.
    beside: Vec<(Curve, Thinner)>,
    /// Where nothing is judged, and where something is.
    silent: Thinner,
    judged: Thinner,
    threshold: Thinner,
    /// Largest value judged, and largest threshold.
    highest: f64,
    most: f64,
    /// Whether it has had a value.
    defined: bool,
}

impl Timeline {
    /// For at most `samples` of the detectors of a scenario.
    #[must_use]
    pub fn new(scenario: &Scenario, samples: usize) -> Self {
        let thin = || Thinner::new(samples);
        let detector = |method: Method| Detector {
            method,
            beside: curves(method, &scenario.detection).into_iter().skip(1).map(|curve| (curve, thin())).collect(),
            silent: thin(),
            judged: thin(),
            threshold: thin(),
            highest: 0.0,
            most: 0.0,
            defined: false,
        };
        Self {
            scenario: scenario.clone(),
            detectors: scenario.detection.detectors.iter().map(detector).collect(),
            bend: thin(),
            bends: None,
            contacts: Vec::new(),
            touches: false,
            ends: None,
        }
    }

    /// The next sample.
    pub fn push(&mut self, sample: &Sample) {
        let (thresholds, time) = (&self.scenario.detection, sample.time);
        self.ends = Some([self.ends.map_or(time, |[first, _]| first), time]);
        self.bend.push([time, sample.theta_l]);
        let [low, high] = self.bends.unwrap_or([sample.theta_l; 2]);
        self.bends = Some([low.min(sample.theta_l), high.max(sample.theta_l)]);
        match self.contacts.last_mut() {
            Some(contact) if sample.in_contact && self.touches => contact[1] = time,
            _ if sample.in_contact => self.contacts.push([time; 2]),
            _ => {}
        }
        self.touches = sample.in_contact;
        for detector in &mut self.detectors {
            let Detector { method, beside, silent, judged, threshold, highest, most, defined } = detector;
            let statistic = method.statistic(&sample.judgement, time, thresholds);
            let (shown, hidden) = match statistic.standing {
                Standing::Silent => (f64::NAN, statistic.value),
                _ => (statistic.value, f64::NAN),
            };
            *highest = highest.max(statistic.counted().unwrap_or(0.0));
            *defined |= statistic.value.is_finite();
            judged.push([time, shown]);
            silent.push([time, hidden]);
            let limit = method.threshold(&sample.judgement, thresholds).unwrap_or(f64::NAN);
            *most = most.max(limit);
            threshold.push([time, limit]);
            for (curve, points) in beside {
                points.push([time, (curve.value)(sample, thresholds)]);
            }
        }
    }

    /// The chart of a log called `name`, with the events of its detectors.
    #[must_use]
    pub fn of_log(self, name: &str, events: &[Event]) -> Chart {
        let caption = judged(&self.scenario);
        self.finish(plain(name), caption, events)
    }

    /// The chart, with the events of its detectors.
    fn finish(self, title: String, caption: String, events: &[Event]) -> Chart {
        let ends = self.ends.filter(|[from, to]| to > from).unwrap_or([0.0, 1.0]);
        let detection = Detection::first(events);
        let thresholds = &self.scenario.detection;
        let mut panels = Vec::new();
        let shown = |detector: &Detector| detector.defined || detector.method.is_of_paper();
        for detector in self.detectors.into_iter().filter(shown) {
            let method = detector.method;
            let mut panel = detector.panel(ends, detection);
            let waits = thresholds.waits(method).then(|| unarmed(ends, thresholds.armed_from));
            panel.spans.extend(waits.filter(|span| span.ends[1] > span.ends[0]));
            panel.spans.extend(held(&self.contacts, true));
            let few = &events[..events.len().min(MOST_EVENTS)];
            panel.series.extend(marks(few, detection, method));
            panel.series.retain(|series| !series.points.is_empty());
            panels.push(panel);
        }
        let axis = angles(self.bends.unwrap_or([0.0; 2]));
        panels.push(bent(timed(ends, axis, detection), &self.contacts, self.bend.finish()));
        Chart { title, panels, caption }
    }
}

impl Detector {
    /// What was judged with its threshold, without the events.
    fn panel(self, ends: [f64; 2], detection: Option<Detection>) -> Panel {
        let Self { method, beside, silent, judged, threshold: limits, highest, most, .. } = self;
        let Measure { symbol, name, threshold, scale, si_unit, unit, role, .. } = measure(method);
        let reach = HEADROOM[1] * highest;
        let top = if most > 0.0 { reach.clamp(HEADROOM[0] * most, MOST * most) } else { reach };
        let top = if top > 0.0 { top } else { 1e-3 };
        let y = Axis { range: Some([0.0, top]), ..Axis::new(symbol, si_unit, unit, scale) };
        let mut panel = Panel { title: name.into(), off_scale: true, ..timed(ends, y, detection) };
        let beside = beside.into_iter();
        panel.series = beside.map(|(of, kept)| Series::new(of.name, of.role, of.style, kept.finish())).collect();
        let line = |name: &str, points| Series::new(name, role, Style::Line, points);
        panel.series.push(Series { faint: true, ..line("", silent.finish()) });
        panel.series.push(line(symbol, judged.finish()));
        panel.series.push(Series::new(threshold, Role::Bound, Style::Dashed, limits.finish()));
        panel
    }
}

/// A finished run as a chart.
#[must_use]
pub fn chart(run: &Run) -> Chart {
    simulated(whole(run), &run.plan, run.events(), run.plant_events())
}

/// A log called `name` as a chart.
#[must_use]
pub fn recorded(run: &Run, name: &str) -> Chart {
    whole(run).of_log(name, run.events())
}

fn whole(run: &Run) -> Timeline {
    let mut timeline = Timeline::new(run.plan.scenario(), run.len());
    run.samples().for_each(|sample| timeline.push(&sample));
    timeline
}

/// The chart of a run that has been simulated sample by sample.
#[must_use]
pub fn simulated(timeline: Timeline, plan: &Plan, events: &[Event], plant: &[PlantEvent]) -> Chart {
    let scenario = plan.scenario();
    let made = [
        words::robot(scenario),
        words::motion(scenario),
        words::contact(plan),
        words::cells(scenario),
        words::tracker(scenario),
        words::thresholds(scenario),
        words::seed(scenario, 1),
    ];
    let mut chart = timeline.finish(TITLE.into(), words::caption(&made), events);
    chart.panels.iter_mut().for_each(|panel| panel.verticals.extend(let_go(plant)));
    chart
}

/// What a log was judged by, in words.
fn judged(scenario: &Scenario) -> String {
    let length = scenario.filter.length;
    format!("{}; N = {length}; {}.", words::robot(scenario), words::thresholds(scenario))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Simulation, simulate};
    use crate::scenario::preset::{PRESETS, find};

    #[test]
    fn a_run_kept_and_one_that_streams_give_the_same_chart() {
        for preset in PRESETS {
            let scenario = preset.scenario().expect("valid");
            let plan = Plan::new(&scenario).expect("possible");
            let mut simulation = Simulation::new(&plan);
            let mut timeline = Timeline::new(&scenario, plan.samples());
            for sample in simulation.by_ref() {
                timeline.push(&sample);
            }
            let streamed = simulated(timeline, &plan, simulation.events(), simulation.plant_events());
            let kept = chart(&simulate(&scenario).expect("possible"));
            // Gaps are NaN, which equals nothing.
            assert_eq!(format!("{streamed:?}"), format!("{kept:?}"), "{}", preset.name);
        }
    }

    #[test]
    fn thresholds_events_and_the_truth_are_drawn() {
        let run = simulate(&find("bench").and_then(|preset| preset.scenario()).expect("a preset")).expect("a run");
        let chart = chart(&run);
        let [centrode, forces, angle] = &chart.panels[..] else { panic!("{} panels", chart.panels.len()) };
        for (panel, method) in [(centrode, Method::Fcd), (forces, Method::Jfd)] {
            let name = measure(method).threshold;
            let line = panel.series.iter().find(|series| series.name == name).expect("a threshold");
            let set = method.threshold(&run.sample(0).judgement, &run.judged.settings.thresholds);
            assert!(line.points.iter().all(|point| Some(point[1]) == set), "{method:?}");
            let raised = panel.series.iter().filter(|series| series.name == "raised").count();
            assert_eq!(raised, run.events().iter().filter(|event| event.detector == method).count());
            assert!(panel.series.iter().all(|series| series.points.len() <= 1000));
        }
        let truth = run.contact_time().expect("contact");
        assert!(angle.spans.iter().any(|span| span.ends[0] == truth));
        assert!(chart.caption.contains("ξ1 = 30 mN·m, ξ2 = 7 mm"), "{}", chart.caption);
    }

    #[test]
    fn without_samples_or_thresholds_there_are_still_axes() {
        let scenario = Scenario::default();
        let empty = Timeline::new(&scenario, 0).finish(String::new(), String::new(), &[]);
        assert_eq!(empty.panels.len(), 3);
        assert!(empty.panels.iter().all(|panel| panel.x.range == Some([0.0, 1.0])));
    }
}
