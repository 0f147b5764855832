//! Figure 3: the bound ε_c (Eq. 16) against θL, for several relative errors of the load cells.

use super::content::Content;
use super::words::{self, MILLI, angle};
use crate::chart::{Axis, Chart, Panel, Role, Series, Style};
use crate::model::configuration::{bend_from_theta_l, theta_l_from_bend};
use crate::model::{Configuration, Segment, Vec3};
use crate::scenario::{Plan, Scenario};
use std::f64::consts::FRAC_PI_2;

/// Relative errors of the family.
const FAMILY: [f64; 5] = [0.02, 0.05, 0.10, 0.15, 0.20];
/// Relative errors nearer than this are one.
const SAME: f64 = 1e-9;
/// Points of a curve.
const POINTS: usize = 181;

/// The bound's curves, one piece each.
#[derive(Debug)]
pub struct Bounds {
    plan: Plan,
    family: Vec<f64>,
    bends: Vec<f64>,
    series: Vec<Series>,
}

impl Bounds {
    /// Of a plan's robot.
    pub fn new(plan: Plan) -> Self {
        let own = plan.scenario().load_cells.epsilon_tau;
        let mut family: Vec<f64> = FAMILY.into_iter().filter(|member| (member - own).abs() > SAME).collect();
        family.push(own);
        family.sort_by(f64::total_cmp);
        let last = last_bend(&plan);
        let bends = (0..POINTS).map(|k| last * (k as f64 / (POINTS - 1) as f64)).collect();
        Self { plan, family, bends, series: Vec::new() }
    }

    fn own(&self) -> f64 {
        self.plan.scenario().load_cells.epsilon_tau
    }
}

/// From straight to the motion's sharpest bend, and to a right angle at least where the robot can: the last bend, rad.
fn last_bend(plan: &Plan) -> f64 {
    let motion = &plan.scenario().motion;
    let ends = [motion.theta_start, motion.theta_end].map(bend_from_theta_l);
    let sharpest = if ends[0].abs() > ends[1].abs() { ends[0] } else { ends[1] };
    let right_angle = if sharpest < 0.0 { -FRAC_PI_2 } else { FRAC_PI_2 };
    if sharpest.abs() < FRAC_PI_2 && plan.segment().shortest_backbone(right_angle) > 0.0 {
        right_angle
    } else {
        sharpest
    }
}

/// A bound (N·m) from a segment, its configuration, the load cells' readings (N) and their relative error.
type Bound = fn(&Segment, &Configuration, &Vec3, f64) -> f64;

/// A bound against θL at some bends (rad), for cells that all read τ/(1 − `epsilon`).
pub fn curve(plan: &Plan, bends: &[f64], epsilon: f64, rule: Bound) -> Vec<[f64; 2]> {
    let (segment, Scenario { motion, load_cells, .. }) = (plan.segment(), plan.scenario());
    let plane = Configuration::new(0.0, motion.delta);
    let at = |bend: &f64| {
        let configuration = plane.with_bend(*bend);
        let tau = segment.forces_from_load(&configuration, &segment.energy_gradient(&configuration));
        let tau_lc = tau.add_scalar(load_cells.preload) / (1.0 - epsilon);
        [theta_l_from_bend(*bend), rule(segment, &configuration, &tau_lc, epsilon)]
    };
    bends.iter().map(at).collect()
}

/// The axis of Θ and of its bounds.
pub fn moment(name: &'static str) -> Axis {
    Axis::new(name, "N·m", "mN·m", MILLI)
}

impl Content for Bounds {
    fn pieces(&self) -> usize {
        self.family.len() + 1
    }

    fn piece(&mut self, k: usize) {
        let own = self.own();
        let last = (self.family.len() - 1).max(1) as f64;
        let (name, role, style, points) = match self.family.get(k) {
            Some(&epsilon) => (
                format!("ε_τ = {}", words::percent(epsilon)),
                Role::Member(k as f64 / last),
                Style::Line,
                curve(&self.plan, &self.bends, epsilon, Segment::common_error_bound),
            ),
            None => (
                format!("ε_τ = {}, independent cells", words::percent(own)),
                Role::Bound,
                Style::Dashed,
                curve(&self.plan, &self.bends, own, Segment::independent_error_bound),
            ),
        };
        self.series.push(Series::new(name, role, style, points));
    }

    fn chart(&self) -> Chart {
        let scenario = self.plan.scenario();
        let ends = [self.bends.first(), self.bends.last()].map(|bend| theta_l_from_bend(bend.copied().unwrap_or(0.0)));
        let tubes = words::stiffness(self.plan.segment());
        let panel = Panel {
            series: self.series.clone(),
            ..Panel::new(Axis { range: Some([ends[0].min(ends[1]), ends[0].max(ends[1])]), ..angle() }, moment("ε_c"))
        };
        Chart {
            title: String::new(),
            panels: vec![panel],
            caption: words::caption(&[
                "ε_c of Eq. 16 of the free segment, whose load cells read τ/(1 − ε_τ)".into(),
                words::robot(scenario),
                tubes,
                format!("preload {} N, which only the bound of independent cells knows", {
                    words::plain(scenario.load_cells.preload)
                }),
            ]),
        }
    }
}
