//! Figure 6: Θ over time with and without contact, repeated.

use super::bound::moment;
use super::content::Content;
use super::plans::{REPEATS, repeats, without_contact};
use super::thin::Thinner;
use super::words::{self, time};
use crate::chart::{Axis, Chart, Panel, Role, Series, Style, Vertical};
use crate::run::Simulation;
use crate::scenario::{Plan, ScenarioError};

/// One run for each repeat and case: all without contact, then all with it.
#[derive(Debug)]
pub struct Residuals {
    plan: Plan,
    runs: Vec<Plan>,
    series: Vec<Series>,
    contact: Option<f64>,
}

impl Residuals {
    /// Of a plan, with and without its beam.
    pub fn new(plan: Plan) -> Result<Self, ScenarioError> {
        let mut runs = repeats(&without_contact(&plan)?)?;
        if plan.contact().is_some() {
            runs.extend(repeats(&plan)?);
        }
        Ok(Self { plan, runs, series: Vec::new(), contact: None })
    }
}

impl Content for Residuals {
    fn pieces(&self) -> usize {
        self.runs.len()
    }

    fn piece(&mut self, k: usize) {
        let plan = &self.runs[k];
        let mut simulation = Simulation::new(plan);
        let mut curve = Thinner::new(plan.samples());
        simulation.by_ref().for_each(|sample| curve.push([sample.time, sample.judgement.residual]));
        self.contact = self.contact.or(simulation.contact_time());
        let (name, role, style) = match plan.contact() {
            Some(_) => ("with contact", Role::Force, Style::Line),
            None => ("without contact", Role::Robot, Style::LongDashed),
        };
        self.series.push(Series::new(name, role, style, curve.finish()));
    }

    fn chart(&self) -> Chart {
        let scenario = self.plan.scenario();
        let mark = |x| Vertical { name: "contact begins", x, role: Role::Contact };
        let panel = Panel {
            series: self.series.clone(),
            verticals: self.contact.map(mark).into_iter().collect(),
            ..Panel::new(Axis { range: Some([0.0, scenario.motion.end]), ..time() }, moment("Θ"))
        };
        Chart {
            title: String::new(),
            panels: vec![panel],
            caption: words::caption(&[
                words::robot(scenario),
                words::motion(scenario),
                words::contact(&self.plan),
                words::cells(scenario),
                words::seed(scenario, REPEATS),
            ]),
        }
    }
}
