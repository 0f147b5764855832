//! What depends on commands alone, reading by reading: shared by all repeats of a plan, or made as a stream goes on.

use super::filter::{Designer, Filter, Responses, Square, Stage};
use super::glr::{Bank, Glr};
use super::linear::Linear;
use super::release::Vigil;
use super::{Belief, Command, Noise, Six, cusum};
use crate::model::contact::{Planar, clamped_tip, free_tip};
use crate::model::{Mat3, Pose, Vec3};
use std::collections::VecDeque;

/// What a calibration filter is made with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model {
    /// Nominal length of the segment, m.
    pub length: f64,
    /// What is believed of its calibration.
    pub belief: Belief,
    /// Noise of the tracker.
    pub noise: Noise,
}

/// One reading's worth of all that does not depend on the reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// The command.
    pub command: Command,
    /// The pose that the nominal model expects, in {B}.
    pub pose: Pose,
    /// Axes of the bending plane in {B}.
    pub axes: Mat3,
    /// The filter.
    pub stage: Stage,
    /// Covariance of the errors after the reading.
    pub covariance: Square,
    /// What [`cusum`] looks for in the innovation, W_k; zero while the robot rests.
    pub design: Six,
    /// ½ W·W.
    pub half: f64,
    /// What [`glr`](super::glr) looks for, where it does.
    pub bank: Option<Bank>,
}

impl Moment {
    /// How a reading differs from what the nominal model expects.
    #[must_use]
    #[inline]
    pub fn residual(&self, reading: &Pose) -> Six {
        residual(&self.pose, &self.axes, reading)
    }
}

/// How a reading differs from an expected pose, along the axes of a bending plane.
#[must_use]
pub fn residual(expected: &Pose, axes: &Mat3, reading: &Pose) -> Six {
    let shift = axes.tr_mul(&(reading.position - expected.position));
    let turn =
        axes.tr_mul(&crate::model::orientation::rotation_vector(&(reading.rotation * expected.rotation.transpose())));
    Six::new(turn.y, shift.x, shift.z, shift.y, turn.x, turn.z)
}

/// A contact that may have begun at an earlier reading, on its way through the filter.
#[derive(Debug, Clone)]
pub(super) struct Flight<const N: usize> {
    /// The bend at which it began, rad.
    met: f64,
    /// +1 while the bend grows.
    side: f64,
    /// What the filter makes of it at each place.
    responses: Responses<N>,
}

impl<const N: usize> Flight<N> {
    /// One that begins at a command; none where the robot rests.
    pub(super) fn begin(command: &Command) -> Option<Self> {
        let side = if command.rate == 0.0 { 0.0 } else { command.rate.signum() };
        (side != 0.0).then(|| Self { met: command.bend, side, responses: Responses::default() })
    }

    /// What it adds to the innovation of a reading in the bending plane, at each place (in units of L).
    pub(super) fn step(&mut self, stage: &Stage, length: f64, bend: f64, places: &[f64; N]) -> [[f64; N]; 3] {
        let holds = self.side * (bend - self.met) > 0.0;
        let free = free_tip(bend);
        let off = |place: f64| if holds { clamped_tip(place, self.met, bend) - free } else { Planar::zeros() };
        let off = places.map(off);
        self.responses.step(stage, &[off.map(|off| off.x * length), off.map(|off| off.y * length)])
    }
}

/// Makes the moments of a stream of commands.
#[derive(Debug, Clone)]
pub struct Planner {
    model: Model,
    designer: Designer,
    age: usize,
    /// Contacts of the last few readings, the oldest first.
    young: VecDeque<Option<Flight<1>>>,
    bank: Option<super::glr::Flights>,
}

impl Planner {
    /// Before the first command. `age` (readings) is that of the contact that [`cusum`] looks for; `with_bank` where
    /// [`glr`](super::glr) is to work.
    #[must_use]
    pub fn new(model: &Model, age: usize, with_bank: bool) -> Self {
        Self {
            model: *model,
            designer: Designer::new(&model.belief, model.noise),
            age: age.clamp(1, cusum::LONGEST),
            young: VecDeque::new(),
            bank: with_bank.then(super::glr::Flights::default),
        }
    }

    /// The moment of the next reading.
    pub fn next(&mut self, command: &Command) -> Moment {
        let Self { model, designer, age, young, bank } = self;
        let linear = Linear::nominal(model.length, command);
        let stage = designer.next(command.time, &linear);
        let mut design = Six::zeros();
        let full = young.len() == *age;
        for (place, flight) in young.iter_mut().enumerate() {
            let Some(flight) = flight else { continue };
            let [[turn], [toward], [along]] = flight.step(&stage, model.length, command.bend, &[cusum::PLACE]);
            if place == 0 && full && command.rate != 0.0 {
                design = Six::new(turn, toward, along, 0.0, 0.0, 0.0);
            }
        }
        if full {
            young.pop_front();
        }
        young.push_back(Flight::begin(command));
        let bank = bank.as_mut().map(|flights| flights.next(&stage, model.length, command));
        let (pose, axes, covariance) = (linear.pose, linear.axes, *designer.covariance());
        Moment { command: *command, pose, axes, stage, covariance, design, half: 0.5 * design.norm_squared(), bank }
    }

    /// The moments of a whole list of commands.
    #[must_use]
    pub fn all(model: &Model, commands: &[Command], with_bank: bool) -> Vec<Moment> {
        let age = cusum::age(model, commands.iter().copied());
        let mut planner = Self::new(model, age, with_bank);
        commands.iter().map(|command| planner.next(command)).collect()
    }
}

/// What one reading comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heard {
    /// The innovation ν_k.
    pub innovation: Six,
    /// The cumulative sum.
    pub cusum: f64,
    /// Probability that a contact has begun by now.
    pub contact: f64,
    /// The generalised likelihood ratio; NaN where the moments have no bank.
    pub glr: f64,
    /// Where this reading tells that a contact has been left: the first and the last reading that were in it, counted from 0.
    pub left: Option<[usize; 2]>,
}

/// The few numbers of one run.
#[derive(Debug, Clone)]
pub struct Listener {
    model: Model,
    age: usize,
    statistics: Statistics,
    vigil: Vigil,
    /// Gains of its own, once a contact has been left: what it knows is no longer what the commands alone say.
    own: Option<Box<Planner>>,
}

#[derive(Debug, Clone, Default)]
struct Statistics {
    filter: Filter,
    cusum: cusum::Cusum,
    glr: Glr,
}

impl Statistics {
    fn hear(&mut self, moment: &Moment, residual: &Six) -> Heard {
        let innovation = self.filter.step(&moment.stage, residual);
        let cusum = self.cusum.step(moment, &innovation);
        let glr = moment.bank.as_ref().map_or(f64::NAN, |bank| self.glr.step(bank, &innovation));
        Heard { innovation, cusum, contact: self.cusum.probability(), glr, left: None }
    }
}

impl Listener {
    /// Before the first reading. `age` is that of the [planner](Planner::new).
    #[must_use]
    pub fn new(model: &Model, age: usize) -> Self {
        Self { model: *model, age, statistics: Statistics::default(), vigil: Vigil::default(), own: None }
    }

    /// Takes the reading of a moment: the pose of the end disk as the tracker has it, in {B}.
    pub fn hear(&mut self, moment: &Moment, reading: &Pose) -> Heard {
        let Self { model, age, statistics, vigil, own } = self;
        let residual = moment.residual(reading);
        let planned = own.as_mut().map(|planner| planner.next(&moment.command));
        let mine = planned.as_ref().unwrap_or(moment);
        let heard = statistics.hear(mine, &residual);
        let seen = (&heard.innovation, &residual, heard.cusum);
        let Some(release) = vigil.look(model, mine, &statistics.filter, seen) else { return heard };
        let planner = Planner { designer: release.designer, ..Planner::new(model, *age, mine.bank.is_some()) };
        *own = Some(Box::new(planner));
        *statistics = Statistics { filter: release.filter, ..Statistics::default() };
        let (cusum, contact) = (statistics.cusum.value, statistics.cusum.probability());
        Heard { cusum, contact, left: Some(release.forgotten), ..heard }
    }
}

/// The pose of the end disk in a planar experiment: position toward the bend and along the backbone (m), and angle (rad).
#[must_use]
pub fn planar(x: f64, z: f64, angle: f64) -> Pose {
    let (sin, cos) = libm::sincos(angle);
    Pose { position: Vec3::new(x, 0.0, z), rotation: Mat3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos) }
}
