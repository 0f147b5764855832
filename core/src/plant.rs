//! What the robot truly does: free, or held by the beam.

pub mod event;

pub use event::{Happening, PlantEvent};

use crate::model::configuration::bend_from_theta_l;
use crate::model::{Arc, Configuration, Constrained, Jacobian, Pose, Segment, Touched, Vec3, Wrench};
use crate::scenario::Plan;
use crate::scenario::motion::command;
use crate::scenario::plan::PlannedContact;

/// The true shape of the backbone.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// One circular arc.
    Free(Arc),
    /// Clamped by the beam: two arcs.
    Held(Constrained),
    /// Touched by the beam: an elastic curve below, an arc above.
    Touched(Touched),
}

impl Shape {
    /// Pose at arc length `s` (m, in [0, L]), in {B}.
    #[must_use]
    pub fn pose(&self, s: f64) -> Pose {
        match self {
            Self::Free(arc) => arc.pose(s),
            Self::Held(held) => held.pose(s),
            Self::Touched(touched) => touched.pose(s),
        }
    }

    /// The same with everything at hand that several poses need.
    #[must_use]
    pub fn detailed(self) -> Self {
        match self {
            Self::Touched(touched) => Self::Touched(touched.detailed()),
            plain => plain,
        }
    }

    /// Pose of the end disk, in {B}.
    #[must_use]
    pub fn tip_pose(&self) -> Pose {
        match self {
            Self::Touched(touched) => touched.tip_pose(),
            plain => plain.tip_pose_and_jacobian().0,
        }
    }

    /// Pose and Jacobian of the end disk, in {B}.
    #[must_use]
    pub fn tip_pose_and_jacobian(&self) -> (Pose, Jacobian) {
        match self {
            Self::Free(arc) => arc.pose_and_jacobian(arc.length),
            Self::Held(held) => held.tip_pose_and_jacobian(),
            Self::Touched(touched) => touched.tip_pose_and_jacobian(),
        }
    }
}

/// The robot and its beam. Configurations that it is asked about are commanded ones; what it answers is true of the true robot.
#[derive(Debug, Clone)]
pub struct Plant<'a> {
    plan: &'a Plan,
    plane: Configuration,
}

impl<'a> Plant<'a> {
    /// The plant of a plan.
    #[must_use]
    pub fn new(plan: &'a Plan) -> Self {
        Self { plan, plane: Configuration::new(0.0, plan.scenario().motion.delta) }
    }

    /// Commanded configuration and θ̇L (rad/s) at `time` (s).
    #[must_use]
    pub fn command(&self, time: f64) -> (Configuration, f64) {
        let (theta_l, rate) = command(&self.plan.scenario().motion, time);
        (self.plane.with_bend(bend_from_theta_l(theta_l)), rate)
    }

    /// Which of the plan's contacts holds the backbone in a commanded configuration.
    #[must_use]
    pub fn held(&self, configuration: &Configuration) -> Option<usize> {
        self.holding(&self.plan.true_robot().configuration(*configuration)).map(|(place, _)| place)
    }

    /// Which contact holds in a true configuration.
    fn holding(&self, truly: &Configuration) -> Option<(usize, &PlannedContact)> {
        self.plan.contacts().iter().enumerate().find(|(_, contact)| contact.holds_at(truly.bend()))
    }

    /// The true shape in a commanded configuration.
    #[must_use]
    pub fn shape(&self, configuration: Configuration) -> Shape {
        let robot = self.plan.true_robot();
        let (length, configuration) = (robot.segment().length, robot.configuration(configuration));
        let Some((_, contact)) = self.holding(&configuration) else {
            return Shape::Free(Arc { length, configuration });
        };
        match contact.branch() {
            Some(branch) => Shape::Touched(Touched::new(length, std::sync::Arc::clone(branch), configuration)),
            None => Shape::Held(Constrained::new(length, contact.arc_length, contact.bend, configuration)),
        }
    }

    /// The wrench on the end disk at `time` (s), in {B}.
    #[must_use]
    pub fn wrench(&self, time: f64) -> Wrench {
        let load = &self.plan.scenario().load;
        let (since, rise) = (time - load.start, load.finish - load.start);
        let share = match since {
            before if before < 0.0 => 0.0,
            after if after >= rise => 1.0,
            within => within / rise,
        };
        Wrench { force: Vec3::from(load.force) * share, moment: Vec3::from(load.moment) * share }
    }

    /// True joint forces τ (N): by virtual work on the true shape they balance the gradient of its energy less the
    /// work of `wrench` on the end disk (Eq. 11), plus the preload.
    ///
    /// NaN where the part above the beam bends so sharply that a secondary backbone would have no length left:
    /// constant curvature says nothing there.
    #[must_use]
    pub fn joint_forces(&self, configuration: Configuration, wrench: &Wrench) -> Vec3 {
        let robot = self.plan.true_robot();
        let preload = self.plan.scenario().load_cells.preload;
        let truly = robot.configuration(configuration);
        let contact = self.holding(&truly).map(|(_, contact)| contact);
        let (part, shape) = moved_part(robot.segment(), contact, truly);
        if part.shortest_backbone(shape.bend()) <= 0.0 {
            return Vec3::repeat(f64::NAN);
        }
        let mut load = part.energy_gradient(&shape);
        if *wrench != Wrench::ZERO {
            // Above a beam the Jacobian's bend is that part's own, as is the gradient's.
            let jacobian = self.shape(configuration).tip_pose_and_jacobian().1;
            load = load.minus(&jacobian.transposed_times(wrench));
        }
        part.forces_from_load(&shape, &load).add_scalar(preload)
    }
}

/// The part of a segment that moves in a true configuration, and that part's own shape: all of it, or what is
/// above the beam.
#[must_use]
pub fn moved_part(
    segment: &Segment,
    contact: Option<&PlannedContact>,
    configuration: Configuration,
) -> (Segment, Configuration) {
    let Some(contact) = contact.filter(|contact| contact.holds_at(configuration.bend())) else {
        return (*segment, configuration);
    };
    let length = segment.length;
    match contact.branch() {
        Some(branch) => {
            let (bend, place) = branch.above(configuration.bend());
            (segment.shortened(length * (1.0 - place)), configuration.with_bend(bend))
        }
        None => {
            let share = contact.arc_length / length;
            let upper = segment.shortened(length - contact.arc_length);
            (upper, configuration.with_bend(configuration.bend() - contact.bend * share))
        }
    }
}
