//! Figure 7: Θ against θL without contact, beside the bounds from which the load cells' error is read.

use super::bound::{curve, moment};
use super::content::Content;
use super::plans::without_contact;
use super::thin::Thinner;
use super::words::{self, angle};
use crate::chart::{Axis, Chart, Panel, Role, Series, Style};
use crate::model::Segment;
use crate::model::configuration::bend_from_theta_l;
use crate::run::Simulation;
use crate::scenario::motion::command;
use crate::scenario::{Plan, ScenarioError};

/// Points of a bound.
const POINTS: usize = 121;
/// Bounds are drawn for these multiples of ε_τ: one too small, the right one, one too large.
const MULTIPLES: [f64; 3] = [0.5, 1.0, 1.5];

/// One piece for each bound and one for the run.
#[derive(Debug)]
pub struct OverBend {
    plan: Plan,
    series: Vec<Series>,
}

impl OverBend {
    /// Of a plan's motion, without its beam.
    pub fn new(plan: &Plan) -> Result<Self, ScenarioError> {
        Ok(Self { plan: without_contact(plan)?, series: Vec::new() })
    }

    /// θL at both ends of what is commanded, rad.
    fn ends(&self) -> [f64; 2] {
        let motion = &self.plan.scenario().motion;
        [motion.theta_start, command(motion, motion.end).0]
    }

    fn residual(&self) -> Series {
        let motion = &self.plan.scenario().motion;
        let mut points = Thinner::new(self.plan.samples());
        // At rest before and after, noise would only pile up at the ends.
        let moving = |time: f64| time >= motion.start && time <= motion.finish;
        for sample in Simulation::new(&self.plan).filter(|sample| moving(sample.time)) {
            points.push([sample.theta_l, sample.judgement.residual]);
        }
        Series::new("Θ", Role::Force, Style::Line, points.finish())
    }

    fn bound(&self, multiple: f64) -> Option<Series> {
        let epsilon = multiple * self.plan.scenario().load_cells.epsilon_tau;
        // An error of all that is read has no bound.
        if epsilon >= 1.0 {
            return None;
        }
        let [from, to] = self.ends().map(bend_from_theta_l);
        let bends: Vec<f64> = (0..POINTS).map(|k| from + (to - from) * (k as f64 / (POINTS - 1) as f64)).collect();
        let (role, style) = match multiple {
            1.0 => (Role::Bound, Style::Dashed),
            less if less < 1.0 => (Role::Member(0.15), Style::Dotted),
            _ => (Role::Member(0.75), Style::LongDashed),
        };
        Some(Series::new(
            format!("ε_c for ε_τ = {}", words::percent(epsilon)),
            role,
            style,
            curve(&self.plan, &bends, epsilon, Segment::common_error_bound),
        ))
    }
}

impl Content for OverBend {
    fn pieces(&self) -> usize {
        1 + MULTIPLES.len()
    }

    fn piece(&mut self, k: usize) {
        match k {
            0 => self.series.push(self.residual()),
            _ => self.series.extend(MULTIPLES.get(k - 1).and_then(|multiple| self.bound(*multiple))),
        }
    }

    fn chart(&self) -> Chart {
        let scenario = self.plan.scenario();
        let ends = self.ends();
        let panel = Panel {
            series: self.series.clone(),
            ..Panel::new(Axis { range: Some([ends[0].min(ends[1]), ends[0].max(ends[1])]), ..angle() }, moment("Θ"))
        };
        Chart {
            title: String::new(),
            panels: vec![panel],
            caption: words::caption(&[
                words::robot(scenario),
                words::motion(scenario),
                "no contact".into(),
                words::cells(scenario),
                words::seed(scenario, 1),
            ]),
        }
    }
}
