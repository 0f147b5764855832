//! A scenario, validated once: what follows cannot fail.

use crate::model::Segment;
use crate::model::configuration::bend_from_theta_l;
use crate::model::contact::Meeting;
use crate::model::contact::branch::{Branch, Surface, Touch};
use crate::scenario::keys::Allowed;
use crate::scenario::keys::allowed::{Limit, bend_refused};
use crate::scenario::keys::{self, KEYS, Quantity, Value};
use crate::scenario::motion;
use crate::scenario::refusal::{Refused, ScenarioError};
use crate::scenario::{Contact, ContactKind, Draw, Motion, Place, Scenario, Start, Thresholds, TrueRobot};
use std::sync::Arc;

/// The longest run, in samples.
pub const MAX_SAMPLES: f64 = 1e8;
/// The longest filter, in samples: it holds as many readings.
pub const MAX_FILTER: u64 = 10_000_000;
/// Lengths that a segment may have, m. Beyond these bounds nothing is wrong with the mathematics, but squares of
/// the numbers leave the range of a double, and answers would be silently lost.
pub const LENGTHS: (f64, f64) = (1e-4, 100.0);
/// Radii that a pitch circle may have, m.
pub const RADII: (f64, f64) = (1e-6, 100.0);
/// Bending-plane angles go this far either way, rad: sines of larger ones mean nothing.
pub const MAX_TURN: f64 = 1e6;
/// Forces of load cells go this far, N.
pub const MAX_FORCE: f64 = 1e6;
/// Moments on the end disk go this far, N·m.
pub const MAX_MOMENT: f64 = 1e6;
/// Times go this far, s.
pub const MAX_TIME: f64 = 1e9;
/// The largest seed that TOML can hold.
pub const MAX_SEED: u64 = i64::MAX as u64;

/// A contact, resolved to numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedContact {
    /// Where the beam meets the backbone, arc length in m.
    pub arc_length: f64,
    /// True bend φ of the whole segment at contact, rad; the beam holds while the true bend is beyond it.
    pub bend: f64,
    /// +1 when "beyond" means a larger bend, −1 when it means a smaller one.
    pub side: f64,
    /// The shapes against a beam that only touches, for all copies of the plan; none for a clamp.
    pub touch: Option<Arc<Touch>>,
}

impl PlannedContact {
    /// A beam at `arc_length` (m) that holds beyond `bend` (rad), whichever way the motion goes through it; of the scenario's
    /// kind, against the robot as calibrated. Its shapes are sketched ([`Branch::sketched`]): one of many on a map.
    #[must_use]
    pub fn beyond(arc_length: f64, bend: f64, scenario: &Scenario) -> Self {
        Self::new(
            (arc_length, bend),
            side_beyond(bend, &scenario.motion),
            scenario,
            &TrueRobot::nominal(scenario),
            true,
        )
    }

    fn new((arc_length, bend): (f64, f64), side: f64, scenario: &Scenario, robot: &TrueRobot, sketched: bool) -> Self {
        let length = robot.segment().length;
        let surface = match scenario.contact.kind {
            ContactKind::Clamp => None,
            ContactKind::Plane => Some(Surface::Plane),
            ContactKind::Cylinder => Some(Surface::Cylinder { rounding: scenario.contact.rounding / length }),
        };
        let touch = surface.map(|surface| {
            let motion = &scenario.motion;
            let ends = ends(motion).map(|bend| side * robot.bend(bend));
            let last = side * ends[0].max(ends[1]).max(side * bend);
            Arc::new(Touch::new(Meeting { place: arc_length / length, bend, side }, surface, last, sketched))
        });
        Self { arc_length, bend, side, touch }
    }

    /// The shapes against a beam that only touches; none for a clamp.
    #[must_use]
    pub fn branch(&self) -> Option<&Arc<Branch>> {
        self.touch.as_deref().map(Touch::branch)
    }

    /// Whether the beam holds the backbone at this true bend (rad).
    #[must_use]
    pub fn holds_at(&self, bend: f64) -> bool {
        match self.branch() {
            None => self.side * (bend - self.bend) > 0.0,
            Some(branch) => branch.holds_at(bend),
        }
    }
}

/// A scenario that can be run.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    scenario: Scenario,
    /// From the base up; one, for now.
    segments: Vec<Segment>,
    truth: TrueRobot,
    /// In the order of the scenario; at most one, for now.
    contacts: Vec<PlannedContact>,
    samples: usize,
}

impl Plan {
    /// Validates a scenario.
    ///
    /// ```
    /// use centrode_core::scenario::{Plan, Scenario};
    ///
    /// let mut scenario = Scenario::default();
    /// assert_eq!(Plan::new(&scenario)?.samples(), 10_001);
    /// scenario.filter.length = 20_000;
    /// let refused = Plan::new(&scenario).expect_err("longer than the run").to_string();
    /// assert!(refused.starts_with("filter.length = 20000 is not allowed: a whole number from 1 to 10001"));
    /// # Ok::<(), centrode_core::scenario::ScenarioError>(())
    /// ```
    ///
    /// # Errors
    /// [`ScenarioError::Value`]: the first impossible value in the order of the table of keys, with its key and what is allowed.
    pub fn new(scenario: &Scenario) -> Result<Self, ScenarioError> {
        #[cfg(test)]
        tests::VALIDATED.set(tests::VALIDATED.get() + 1);
        KEYS.iter().try_for_each(|key| key.check(scenario))?;
        check_contact(scenario)?;
        check_truth(scenario)?;
        Ok(Self {
            segments: vec![scenario.robot.segment()],
            truth: TrueRobot::of(scenario),
            contacts: Vec::new(),
            samples: steps(scenario) as usize + 1,
            scenario: scenario.clone(),
        }
        .with_contacts())
    }

    fn with_contacts(self) -> Self {
        let contact = at(&self.scenario).map(|(_, _, arc_length)| {
            let (bend, side) = meets(&self.scenario, &self.truth);
            PlannedContact::new((arc_length, bend), side, &self.scenario, &self.truth, false)
        });
        Self { contacts: contact.into_iter().collect(), ..self }
    }

    /// The same with another seed, of which the bits above [`MAX_SEED`] do not count; with another true robot, where that is drawn.
    #[must_use]
    pub fn with_seed(&self, seed: u64) -> Self {
        let seeded = Self { scenario: Scenario { seed: seed & MAX_SEED, ..self.scenario.clone() }, ..self.clone() };
        if !seeded.is_drawn() {
            return seeded;
        }
        // Whatever may be drawn was checked with the plan.
        Self { truth: TrueRobot::of(&seeded.scenario), ..seeded }.with_contacts()
    }

    /// Whether the true robot, and with it everything but the commands, depends on the seed.
    #[must_use]
    pub fn is_drawn(&self) -> bool {
        self.scenario.calibration.is_drawn()
    }

    /// Takes the shapes that another plan has found already, where its contacts are the same.
    pub fn share_contacts(&mut self, other: &Self) {
        if self.contacts == other.contacts {
            self.contacts.clone_from(&other.contacts);
        }
    }

    /// The same without a contact, which is always possible.
    #[must_use]
    pub fn without_contact(&self) -> Self {
        let contact = Contact { place: Place::Nowhere, ..self.scenario.contact };
        Self { scenario: Scenario { contact, ..self.scenario.clone() }, contacts: Vec::new(), ..self.clone() }
    }

    /// The same with thresholds that whoever calls knows to be possible: those of a plan, switched off, or the default.
    pub(crate) fn with_thresholds(&self, detection: Thresholds) -> Self {
        Self { scenario: Scenario { detection, ..self.scenario.clone() }, ..self.clone() }
    }

    /// What was asked for.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The segments, from the base up, as the model has them: at least one.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// What the backbone may meet.
    #[must_use]
    pub fn contacts(&self) -> &[PlannedContact] {
        &self.contacts
    }

    /// The robot as it truly is.
    #[must_use]
    pub fn true_robot(&self) -> &TrueRobot {
        &self.truth
    }

    /// The segment at the base, as the model has it.
    #[must_use]
    pub fn segment(&self) -> &Segment {
        &self.segments[0]
    }

    /// The beam, when there is one.
    #[must_use]
    pub fn contact(&self) -> Option<&PlannedContact> {
        self.contacts.first()
    }

    /// Number of loop samples, from t = 0 to the end, both included.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Time of sample `k`, s.
    #[must_use]
    pub fn time(&self, k: usize) -> f64 {
        k as f64 / self.scenario.loop_rate
    }
}

/// Checks that the model holds at a bend (rad): no full turn, and no backbone of negative length.
///
/// # Errors
/// Names `key` and its `value` (rad).
pub fn check_bend(segment: &Segment, key: &str, value: f64, bend: f64) -> Result<(), ScenarioError> {
    match bend_refused(segment, bend) {
        Some(allowed) => Err(Refused::error(key, Quantity::Angle, Value::Number(value), allowed)),
        None => Ok(()),
    }
}

/// Steps of the control loop in a run, as far as they go into a number.
pub(super) fn steps(scenario: &Scenario) -> f64 {
    libm::floor(scenario.motion.end * scenario.loop_rate + 1e-6)
}

/// Bends nearer to straight than this are straight when the beam's side is chosen.
const STRAIGHT: f64 = 1e-12;

/// Where the beam meets the backbone: the key that says so, its value, and the arc length (m); none without a beam.
fn at(scenario: &Scenario) -> Option<(&'static str, Value, f64)> {
    match scenario.contact.place {
        Place::Nowhere => None,
        Place::Disk(number) => {
            let disk = scenario.robot.disks.get(number.get() as usize - 1).copied();
            disk.map(|at| ("contact.disk", Value::Whole(number.get()), at))
        }
        Place::ArcLength(at) => Some(("contact.arc_length", Value::Number(at), at)),
    }
}

/// The true bend (rad) at which a robot meets the beam, and on which side of it the beam holds.
fn meets(scenario: &Scenario, robot: &TrueRobot) -> (f64, f64) {
    let motion = &scenario.motion;
    match scenario.contact.start {
        // From a time on, the beam stands where the motion goes, be it toward straight.
        Start::Time(time) => {
            let commanded = bend_from_theta_l(motion::command(motion, time).0);
            (robot.bend(commanded), side(motion.theta_start - motion.theta_end))
        }
        Start::Bend(bend) => (bend, side_beyond(bend, motion)),
    }
}

/// Checks the contact against the robot as calibrated.
fn check_contact(scenario: &Scenario) -> Result<(), ScenarioError> {
    let Some((key, value, arc_length)) = at(scenario) else { return Ok(()) };
    let robot = TrueRobot::nominal(scenario);
    if !meets_between(scenario, &robot, arc_length) {
        let quantity = if key == "contact.disk" { Quantity::Count } else { Quantity::Length };
        let allowed =
            Allowed::Need("a place between the base and the end disk, for a beam that only touches (contact.kind)");
        return Err(Refused::error(key, quantity, value, allowed));
    }
    if let Some(most) = room(scenario, &robot) {
        let allowed = Allowed::Range(Limit::At(0.0), Limit::Beyond(most));
        let rounding = Value::Number(scenario.contact.rounding);
        return Err(Refused::error("contact.rounding", Quantity::Length, rounding, allowed));
    }
    Ok(())
}

/// Whether a robot's backbone can meet the beam at an arc length (m): a clamp takes its ends as well.
fn meets_between(scenario: &Scenario, robot: &TrueRobot, arc_length: f64) -> bool {
    let length = robot.segment().length;
    match scenario.contact.kind {
        ContactKind::Clamp => arc_length <= length,
        ContactKind::Plane | ContactKind::Cylinder => is_between(arc_length, length),
    }
}

/// The rounding (m) below which a round beam on the inside of the bend fits into the arc; none where it fits.
fn room(scenario: &Scenario, robot: &TrueRobot) -> Option<f64> {
    let Contact { kind, rounding, .. } = scenario.contact;
    let (bend, side) = meets(scenario, robot);
    let (inside, length) = (side * bend, robot.segment().length);
    (kind == ContactKind::Cylinder && inside * rounding >= length).then_some(length / inside)
}

/// Checks every true robot that a scenario may have.
fn check_truth(scenario: &Scenario) -> Result<(), ScenarioError> {
    let fault = |robot: &TrueRobot| {
        let reached = ends(&scenario.motion).map(|bend| robot.bend(bend));
        let met = at(scenario).is_none_or(|(_, _, arc_length)| {
            meets_between(scenario, robot, arc_length) && room(scenario, robot).is_none()
        });
        !met || reached.into_iter().any(|bend| bend_refused(robot.segment(), bend).is_some())
    };
    let Some(key) = TrueRobot::refused(scenario, fault).and_then(keys::find) else { return Ok(()) };
    let allowed = match scenario.calibration.draw {
        Draw::Fixed => Allowed::Need(
            "an error with which the true robot bends by less than one turn, each secondary backbone has some length left, and \
             contact.disk or contact.arc_length is on the true backbone",
        ),
        Draw::Drawn => Allowed::Need(
            "a standard deviation such that errors four times as large are at most 50 % of length and bend, leave less than one turn of bend \
             and some length of each secondary backbone, and leave contact.disk or contact.arc_length on the true backbone",
        ),
    };
    Err(key.refuse(key.get(scenario).unwrap_or(Value::Number(f64::NAN)), allowed))
}

/// Commanded bends before and after the motion, rad.
fn ends(motion: &Motion) -> [f64; 2] {
    [motion.theta_start, motion.theta_end].map(bend_from_theta_l)
}

/// Whether a place (m) lies between the ends of a segment, so that a beam can touch it there without clamping it.
#[must_use]
pub fn is_between(arc_length: f64, length: f64) -> bool {
    let margin = 1e-5 * length;
    arc_length > margin && arc_length < length - margin
}

/// The side on which a bend (rad) lies: away from straight, or where the motion goes.
fn side_beyond(bend: f64, motion: &Motion) -> f64 {
    side(if bend.abs() > STRAIGHT { bend } else { motion.theta_start - motion.theta_end })
}

fn side(toward: f64) -> f64 {
    if toward < 0.0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::cell::Cell;

    thread_local! {
        /// How often this thread has validated a scenario.
        pub(crate) static VALIDATED: Cell<usize> = const { Cell::new(0) };
    }

    #[test]
    fn without_contact_a_plan_is_that_of_the_scenario_without_one() {
        let mut scenario = Scenario::default();
        let plan = Plan::new(&scenario).expect("possible");
        scenario.contact.place = Place::Nowhere;
        assert_eq!(Plan::new(&scenario), Ok(plan.without_contact()));
    }
}
