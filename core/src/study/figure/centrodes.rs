//! Figure 4: loci of the end disk's fixed centrode with and without constraint, and both backbones.

use super::content::Content;
use super::plans::without_contact;
use super::words::{self, MILLI};
use crate::chart::{Axis, Chart, Panel, Role, Series, Style};
use crate::model::configuration::bend_from_theta_l;
use crate::model::{Configuration, Rate, Vec3};
use crate::plant::Shape;
use crate::record::held_still;
use crate::scenario::{Contact, ContactKind, Plan, Scenario, ScenarioError, motion::command};

/// Marks of a locus over the whole motion.
const MARKS: usize = 31;
/// Backbones drawn over the whole motion.
const BACKBONES: usize = 5;
/// Points of a backbone.
const POINTS: usize = 61;

/// Loci and backbones in the bending plane, for the plan's kind of contact and beside it for another.
#[derive(Debug)]
pub struct Centrodes {
    sides: Vec<Side>,
}

impl Centrodes {
    /// Of a plan's motion and beam.
    pub fn new(plan: Plan) -> Result<Self, ScenarioError> {
        let mut sides = vec![Side::new(plan.clone())?];
        if plan.contact().is_some() {
            let contact = Contact { kind: plan.scenario().contact.kind.other(), ..plan.scenario().contact };
            // A beam that only touches needs a place between the ends, which a clamp does not.
            if let Ok(other) = Plan::new(&Scenario { contact, ..plan.scenario().clone() }) {
                sides.push(Side::new(other)?);
            }
        }
        Ok(Self { sides })
    }
}

/// One kind of contact: the backbones, then the marks of one locus, then those of the other.
#[derive(Debug)]
struct Side {
    plan: Plan,
    free: Plan,
    series: Vec<Series>,
}

/// Pieces of work in a side.
const PIECES: usize = 3;

impl Side {
    fn new(plan: Plan) -> Result<Self, ScenarioError> {
        Ok(Self { free: without_contact(&plan)?, plan, series: Vec::new() })
    }

    /// Configurations between which θL takes equal steps over the motion.
    fn even(&self, count: usize) -> impl Iterator<Item = Configuration> + '_ {
        let motion = &self.plan.scenario().motion;
        let plane = Configuration::new(0.0, motion.delta);
        // Nothing is commanded past the end of the run.
        let last = command(motion, motion.end).0;
        (0..count).map(move |k| {
            let share = k as f64 / (count - 1) as f64;
            plane.with_bend(bend_from_theta_l(motion.theta_start + share * (last - motion.theta_start)))
        })
    }

    fn locus(&self, plan: &Plan) -> Vec<[f64; 2]> {
        let held = plan.contact().is_some();
        let truths = self.even(MARKS).zip(held_still(plan, self.even(MARKS)));
        let chosen = truths.filter(|(_, truth)| !held || truth.held.is_some());
        chosen
            .filter_map(|(configuration, truth)| {
                let (pose, jacobian) = truth.shape.tip_pose_and_jacobian();
                Some(in_plane(&configuration, &jacobian.centrode(&pose.position, Rate::BENDING)?))
            })
            .collect()
    }

    fn backbones(&self) -> Vec<Series> {
        let [free, held] = [&self.free, &self.plan].map(|plan| held_still(plan, self.even(BACKBONES)));
        let mut series = Vec::new();
        for ((configuration, free), held) in self.even(BACKBONES).zip(free).zip(held) {
            series.push(Series::new(
                "backbone without constraint",
                Role::Robot,
                Style::Line,
                self.backbone(&configuration, free.shape),
            ));
            if held.held.is_some() {
                series.push(Series::new(
                    "backbone with constraint",
                    Role::Constrained,
                    Style::Dashed,
                    self.backbone(&configuration, held.shape),
                ));
            }
        }
        series
    }

    fn backbone(&self, configuration: &Configuration, shape: Shape) -> Vec<[f64; 2]> {
        let shape = shape.detailed();
        let length = self.plan.true_robot().segment().length;
        let at = |k| in_plane(configuration, &shape.pose(length * (k as f64 / (POINTS - 1) as f64)).position);
        (0..POINTS).map(at).collect()
    }
}

/// Across the base toward the bend, and along the straight backbone, m.
fn in_plane(configuration: &Configuration, point: &Vec3) -> [f64; 2] {
    let (s, c) = configuration.sin_cos_delta();
    [c * point.x - s * point.y, point.z]
}

impl Side {
    fn piece(&mut self, k: usize) {
        match k {
            0 => self.series.extend(self.backbones()),
            1 => self.series.push(Series::new(
                "centrode without constraint, c_m",
                Role::Model,
                Style::Triangles,
                self.locus(&self.free),
            )),
            _ if self.plan.contact().is_some() => self.series.push(Series::new(
                "centrode with constraint, c_c",
                Role::Constrained,
                Style::Circles,
                self.locus(&self.plan),
            )),
            _ => {}
        }
    }

    fn panel(&self) -> Panel {
        let axis = |name| Axis::new(name, "m", "mm", MILLI);
        let title = match (self.plan.contact(), self.plan.scenario().contact.kind) {
            (None, _) => "",
            (_, ContactKind::Clamp) => "A beam that clamps",
            (_, ContactKind::Plane) => "A flat beam that touches",
            (_, ContactKind::Cylinder) => "A round beam that touches",
        };
        Panel {
            title: title.into(),
            equal_scales: true,
            series: self.series.clone(),
            ..Panel::new(axis("across the base"), axis("along the straight backbone"))
        }
    }
}

impl Content for Centrodes {
    fn pieces(&self) -> usize {
        PIECES * self.sides.len()
    }

    fn piece(&mut self, k: usize) {
        if let Some(side) = self.sides.get_mut(k / PIECES) {
            side.piece(k % PIECES);
        }
    }

    fn chart(&self) -> Chart {
        let plan = &self.sides[0].plan;
        let scenario = plan.scenario();
        Chart {
            title: String::new(),
            panels: self.sides.iter().map(Side::panel).collect(),
            caption: words::caption(&[
                "in the bending plane, marks at equal steps of θ_L".into(),
                words::robot(scenario),
                words::motion(scenario),
                if self.sides.len() > 1 { words::place(plan) } else { words::contact(plan) },
            ]),
        }
    }
}
