//! What the detectors hold against their thresholds over time, as a chart: of a log, or of any run.

use super::course::{Measure, measure};
use super::figure::thin::Thinner;
use super::figure::words::{MILLI, millimetres, plain, robot, time};
use crate::chart::{Axis, Chart, Panel, Role, Series, Span, Style, Vertical};
use crate::detect::{Event, Method, Standing};
use crate::run::Sample;
use crate::scenario::Scenario;

/// An axis reaches at least this many times the threshold, and this many times what is judged.
const HEADROOM: [f64; 2] = [1.6, 1.1];
/// It never reaches more than this many times the threshold.
const MOST: f64 = 4.0;

/// Takes samples one by one.
#[derive(Debug)]
pub struct Timeline {
    scenario: Scenario,
    panels: Vec<(Method, Thinner, Thinner)>,
    /// Largest value judged and largest threshold, by detector.
    highest: Vec<[f64; 2]>,
    ends: Option<[f64; 2]>,
}

impl Timeline {
    /// For at most `samples` of the given detectors.
    #[must_use]
    pub fn new(scenario: &Scenario, detectors: &[Method], samples: usize) -> Self {
        let panel = |detector: &Method| (*detector, Thinner::new(samples), Thinner::new(samples));
        Self {
            scenario: scenario.clone(),
            panels: detectors.iter().map(panel).collect(),
            highest: vec![[0.0; 2]; detectors.len()],
            ends: None,
        }
    }

    /// The next sample.
    pub fn push(&mut self, sample: &Sample) {
        let thresholds = &self.scenario.detection;
        self.ends = Some([self.ends.map_or(sample.time, |[first, _]| first), sample.time]);
        for ((method, values, limits), [highest, most]) in self.panels.iter_mut().zip(&mut self.highest) {
            let statistic = method.statistic(&sample.judgement, sample.time, thresholds);
            let shown = if statistic.standing == Standing::Silent { f64::NAN } else { statistic.value };
            *highest = highest.max(statistic.counted().unwrap_or(0.0));
            values.push([sample.time, shown]);
            let limit = method.threshold(&sample.judgement, thresholds).unwrap_or(f64::NAN);
            *most = most.max(limit);
            limits.push([sample.time, limit]);
        }
    }

    /// The chart, with the events of its detectors.
    #[must_use]
    pub fn finish(self, title: String, events: &[Event]) -> Chart {
        let Self { scenario, panels, highest, ends } = self;
        let ends = ends.unwrap_or([0.0, 1.0]);
        let armed = scenario.detection.armed_from.min(ends[1]);
        let unarmed = (armed > ends[0]).then_some(Span {
            name: "not armed",
            role: Role::Aside,
            low: false,
            ends: [ends[0], armed],
        });
        let panel = |((method, values, limits), [highest, most]): ((Method, Thinner, Thinner), [f64; 2])| {
            let Measure { symbol, threshold, scale, si_unit, unit, role, .. } = measure(method);
            let reach = HEADROOM[1] * highest;
            let top = if most > 0.0 { reach.clamp(HEADROOM[0] * most, MOST * most) } else { reach };
            let top = if top > 0.0 { top } else { 1e-3 };
            let series = vec![
                Series::new(symbol, role, Style::Line, values.finish()),
                Series::new(threshold, Role::Bound, Style::Dashed, limits.finish()),
            ];
            let own = events.iter().filter(|event| event.detector == method);
            let raised = own.map(|event| Vertical { name: "event raised", x: event.raised, role: Role::Detection });
            Panel {
                spans: unarmed.clone().into_iter().collect(),
                series: series.into_iter().filter(|series| !series.points.is_empty()).collect(),
                verticals: raised.take(MOST_EVENTS).collect(),
                ..Panel::new(
                    Axis { range: Some(ends).filter(|[from, to]| to > from), ..time() },
                    Axis { range: Some([0.0, top]), ..Axis::new(symbol, si_unit, unit, scale) },
                )
            }
        };
        let detection = &scenario.detection;
        let xi2 = detection.xi2.value().map_or_else(|| "off".into(), millimetres);
        let xi1 = detection.xi1.value().map_or_else(|| "off".into(), |xi1| format!("{} mN·m", plain(xi1 * MILLI)));
        let (length, from) = (scenario.filter.length, plain(detection.armed_from));
        let caption = format!("{}; N = {length}; ξ1 = {xi1}, ξ2 = {xi2}, armed from {from} s.", robot(&scenario));
        Chart { title, panels: panels.into_iter().zip(highest).map(panel).collect(), caption }
    }
}

/// More events than this are no longer told apart.
const MOST_EVENTS: usize = 200;
