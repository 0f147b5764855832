//! Figure 8: ‖c_m − c_s‖ over time, repeated, with ξ2 and the detections.

use super::content::Content;
use super::plans::{REPEATS, repeats};
use super::thin::Thinner;
use super::words::{self, MILLI, time};
use crate::chart::{Axis, Chart, Panel, Role, Series, Span, Style, Vertical};
use crate::detect::Method;
use crate::run::Simulation;
use crate::scenario::{Plan, ScenarioError};

/// The axis reaches at least this many times ξ2.
const HEADROOM: f64 = 1.6;
/// It reaches this many times what is judged.
const MARGIN: f64 = 1.1;
/// It never reaches more than this many times ξ2: as the motion ends, the sensor's centrode scatters without bound.
const MOST: f64 = 2.5;

/// One run for each repeat.
#[derive(Debug)]
pub struct Deviations {
    plan: Plan,
    runs: Vec<Plan>,
    series: Vec<Series>,
    verticals: Vec<Vertical>,
    contact: Option<f64>,
    /// Largest value judged, m.
    highest: f64,
}

impl Deviations {
    /// Of a plan.
    pub fn new(plan: Plan) -> Result<Self, ScenarioError> {
        let runs = repeats(&plan)?;
        Ok(Self { plan, runs, series: Vec::new(), verticals: Vec::new(), contact: None, highest: 0.0 })
    }

    /// Top of the axis, m: from what is judged and ξ2, not from the transient before.
    fn top(&self) -> f64 {
        let reach = MARGIN * self.highest;
        let top = match self.plan.scenario().detection.xi2.value() {
            Some(xi2) if xi2 > 0.0 => reach.clamp(HEADROOM * xi2, MOST * xi2),
            _ => reach,
        };
        if top > 0.0 { top } else { self.plan.segment().length }
    }

    /// When something moves, s.
    fn ends(&self) -> [f64; 2] {
        let motion = &self.plan.scenario().motion;
        let end = motion.finish.min(motion.end);
        [if motion.start < end { motion.start } else { 0.0 }, end]
    }
}

impl Content for Deviations {
    fn pieces(&self) -> usize {
        self.runs.len()
    }

    fn piece(&mut self, k: usize) {
        let plan = &self.runs[k];
        let [from, to] = self.ends();
        let detection = &plan.scenario().detection;
        let mut simulation = Simulation::new(plan);
        let mut curve = Thinner::new(plan.samples());
        for sample in simulation.by_ref().filter(|sample| sample.time >= from && sample.time <= to) {
            let judgement = &sample.judgement;
            let statistic = Method::Fcd.statistic(judgement, sample.time, detection);
            if let Some(counted) = statistic.counted() {
                self.highest = self.highest.max(counted);
            }
            // Before arming the transient is shown whole; after it, only what counts.
            let hidden = sample.time >= detection.armed_from && statistic.counted().is_none();
            curve.push([sample.time, if hidden { f64::NAN } else { judgement.deviation }]);
        }
        self.contact = self.contact.or(simulation.contact_time());
        if let Some(found) = simulation.detection() {
            self.verticals.push(Vertical { name: "detection", x: found.time, role: Role::Detection });
        }
        self.series.push(Series::new("||c_m − c_s||", Role::Sensor, Style::Line, curve.finish()));
    }

    fn chart(&self) -> Chart {
        let scenario = self.plan.scenario();
        let detection = &scenario.detection;
        let ends = self.ends();
        let mut series = self.series.clone();
        series.extend(
            detection
                .xi2
                .value()
                .map(|xi2| Series::new("ξ2", Role::Bound, Style::Dashed, ends.map(|time| [time, xi2]).into())),
        );
        let mut verticals = self.verticals.clone();
        verticals.extend(self.contact.map(|x| Vertical { name: "contact begins", x, role: Role::Contact }));
        let unarmed = [ends[0], detection.armed_from.min(ends[1])];
        let panel = Panel {
            spans: (unarmed[1] > unarmed[0])
                .then_some(Span { name: "not armed", role: Role::Aside, low: false, ends: unarmed })
                .into_iter()
                .collect(),
            series,
            verticals,
            ..Panel::new(
                Axis { range: Some(ends), ..time() },
                Axis { range: Some([0.0, self.top()]), ..Axis::new("||c_m − c_s||", "m", "mm", MILLI) },
            )
        };
        Chart {
            title: String::new(),
            panels: vec![panel],
            caption: words::caption(&[
                words::robot(scenario),
                words::motion(scenario),
                words::contact(&self.plan),
                words::tracker(scenario),
                words::detection(scenario),
                words::seed(scenario, REPEATS),
            ]),
        }
    }
}
