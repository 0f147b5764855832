//! From a log to a recording: everything on the loop's clock.

pub(super) mod clock;
mod hold;

use super::error::LogError;
use super::gather::Track;
use super::report::{Happening, Place, Report};
use super::{Log, frame};
use crate::model::configuration::bend_from_theta_l;
use crate::model::joints::configuration_from_joints;
use crate::model::orientation::from_euler;
use crate::model::{Configuration, Vec3};
use crate::record::{Entry, Recording};
use crate::scenario::keys::allowed::bend_refused;
use crate::scenario::keys::{Quantity, Units};
use crate::scenario::motion::command;
use crate::scenario::{Plan, Scenario};
use crate::sensors::tracker::Reading;
use clock::Ticks;
use hold::Held;
use serde::Serialize;

/// A recording of a log has at most this many entries: below 1 GB.
pub const MAX_ENTRIES: usize = 4_000_000;

/// Who says how fast the loop ran.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rate {
    /// `loop_rate` of the scenario.
    #[default]
    Scenario,
    /// The spacing of the log's commands, or of its readings where it has none.
    Log,
}

impl Rate {
    /// In a few words.
    #[must_use]
    pub const fn told(self) -> &'static str {
        match self {
            Self::Scenario => "the scenario says so",
            Self::Log => "from the spacing of the rows",
        }
    }
}

impl Commands {
    /// In a few words.
    #[must_use]
    pub const fn told(self) -> &'static str {
        match self {
            Self::Log => "as recorded",
            Self::Motion => "from the scenario's motion",
            Self::Estimated => "none: the bend is estimated from the measured angle, as if the robot bent freely",
        }
    }
}

/// Where the commands come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Commands {
    /// The log, or a second file.
    Log,
    /// The scenario's motion, on the log's clock.
    Motion,
    /// Estimated from the measured angle, as if the robot bent freely in the plane `motion.delta`.
    Estimated,
}

/// How a log becomes a recording.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setup {
    /// Who says how fast the loop ran.
    pub rate: Rate,
    /// Where the commands come from; none takes the log's, and estimates them where it has none.
    pub commands: Option<Commands>,
    /// The longest that a value is held, s; none for five times the usual spacing of its rows, and at least [`LEAST_HOLD`].
    pub hold: Option<f64>,
    /// Where the log's frame is.
    pub frame: frame::Setting,
    /// The most entries that are wanted; none for [`MAX_ENTRIES`], which is never exceeded.
    pub most: Option<usize>,
}

/// A value is held for at least this long, s.
pub const LEAST_HOLD: f64 = 0.05;
/// And at least for this many times the usual spacing of its rows.
const SPACINGS: f64 = 5.0;

/// A log as a recording, with the scenario that it is judged by.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Assembled {
    /// The nominal scenario at the loop's rate: model, filter and thresholds.
    pub plan: Plan,
    /// The recording, without truth.
    pub recording: Recording,
    /// What was done on the way, with what the reader had to report.
    pub report: Report,
    /// Who said how fast the loop ran.
    pub rate: Rate,
    /// Where the commands came from.
    pub commands: Commands,
    /// What was subtracted from the log's times, s.
    pub start: f64,
    /// Where the log's frame is, when it was fitted.
    pub fit: Option<frame::Fit>,
}

/// Puts a log on the loop's clock.
///
/// Rows that lie within a quarter of a step of their place on that clock become entries with their own times, bit for bit; at
/// instants without a row, and in a log on another clock, the last value is held, as a loop holds its tracker's reading. A
/// value that is too old is undefined.
///
/// # Errors
/// When the log does not say enough, holds a command that the model cannot follow, or the recording would be too long.
pub fn assemble(log: &Log, scenario: &Scenario, setup: &Setup) -> Result<Assembled, LogError> {
    let mut report = log.report.clone();
    let times = clock::times(log)?;
    let scenario = rated(log, scenario, setup.rate)?;
    let plan = Plan::new(&scenario).map_err(|error| LogError::file(format!("with this log, {error}")))?;
    let source = source(log, setup.commands)?;
    let start = clock::start(times[0], log.origin, &scenario, &mut report);
    let most = setup.most.map_or(MAX_ENTRIES, |most| most.min(MAX_ENTRIES));
    let rows = log.readings.len() + log.commands.len() + log.joints.len() + log.forces.len();
    let ticks = Ticks::new((times, rows), scenario.loop_rate, most, &mut report)?;
    let ordered = ordered(log, &plan, &mut report)?;
    let commanded = |at: f64| commanded(source, &plan, &ordered, at, start);
    let known = (source != Commands::Estimated).then_some(&commanded as &dyn Fn(f64) -> Option<Configuration>);
    let (readings, fit) = frame::placed(log, &plan, &setup.frame, known, start)?;
    report.notes.extend(fit.map(|fit| format!("the log's frame is {}", fit.told())));
    let motion = |time: f64| {
        let (theta_l, rate) = command(&scenario.motion, time);
        ([bend_from_theta_l(theta_l), scenario.motion.delta], [rate, 0.0])
    };
    let orders = match source {
        Commands::Log => Orders::Log(&ordered, scenario.motion.delta),
        Commands::Motion => Orders::Motion(&motion),
        Commands::Estimated => Orders::Measured(scenario.motion.delta),
    };
    let clock = OnClock { ticks: &ticks, start, loop_rate: scenario.loop_rate, hold: setup.hold };
    let entries = clock.entries((&readings, &log.forces), &orders, &mut report);
    let recording = Recording { entries, truth: None, commanded: source != Commands::Estimated };
    Ok(Assembled { plan, recording, report, rate: setup.rate, commands: source, start: log.origin + start, fit })
}

/// What the robot is told at each instant.
pub(super) enum Orders<'a> {
    /// The log's commands: bend and δ, rad. Before the first one, δ (rad) is as given.
    Log(&'a Track<2>, f64),
    /// Bend and δ (rad), θ̇L and δ̇ (rad/s) at a time (s) on the scenario's clock.
    Motion(&'a dyn Fn(f64) -> ([f64; 2], [f64; 2])),
    /// The bend that the tracker measures in the plane δ (rad).
    Measured(f64),
}

/// The clock of the loop, under what a log holds.
pub(super) struct OnClock<'a> {
    pub ticks: &'a Ticks<'a>,
    /// Where the scenario's clock begins on the log's, s.
    pub start: f64,
    /// Hz.
    pub loop_rate: f64,
    /// The longest that a value is held, s, where that is said.
    pub hold: Option<f64>,
}

impl OnClock<'_> {
    fn held<'t, const D: usize>(&self, track: &'t Track<D>) -> Held<'t, D> {
        let usual = || LEAST_HOLD.max(SPACINGS * clock::median(&track.times).unwrap_or(0.0));
        Held::new(track, self.hold.unwrap_or_else(usual), self.loop_rate)
    }

    /// What the loop saw at each of its instants: readings in {B} and load cells as held, commands as ordered.
    pub fn entries(
        &self,
        (readings, forces): (&Track<6>, &Track<3>),
        orders: &Orders,
        report: &mut Report,
    ) -> Vec<Entry> {
        let none = Track::default();
        let (ordered, delta) = match orders {
            Orders::Log(ordered, delta) => (*ordered, *delta),
            Orders::Motion(motion) => (&none, motion(0.0).0[1]),
            Orders::Measured(delta) => (&none, *delta),
        };
        let (mut reading, mut order, mut force) = (self.held(readings), self.held(ordered), self.held(forces));
        let mut entries: Vec<Entry> = Vec::with_capacity(self.ticks.len());
        let mut plane = Configuration::new(0.0, delta);
        for at in self.ticks.instants() {
            let time = if self.start == 0.0 { at } else { at - self.start };
            let [x, y, z, azimuth, elevation, roll] = reading.at(at);
            let reading = Reading { position: Vec3::new(x, y, z), angles: [azimuth, elevation, roll] };
            let ([bend, delta], [theta_l_rate, delta_rate]) = match orders {
                Orders::Log(..) => (order.at(at), [f64::NAN, 0.0]),
                Orders::Motion(motion) => motion(time),
                Orders::Measured(delta) => ([measured_bend(&reading.angles, &plane), *delta], [f64::NAN, 0.0]),
            };
            if delta.to_bits() != plane.delta().to_bits() {
                plane = Configuration::new(0.0, delta);
            }
            let (configuration, tau_lc) = (plane.with_bend(bend), Vec3::from(force.at(at)));
            entries.push(Entry { time, configuration, theta_l_rate, delta_rate, reading, tau_lc });
        }
        if !matches!(orders, Orders::Motion(_)) {
            difference(&mut entries);
        }
        reading.tell([Happening::HeldReading, Happening::GapInReadings], self.start, report);
        force.tell([Happening::HeldForce, Happening::GapInForces], self.start, report);
        order.tell([Happening::HeldCommand, Happening::GapInCommands], self.start, report);
        entries
    }
}

/// A scenario at the rate of a log's loop.
///
/// # Errors
/// When the log is to say how fast it was, and does not.
pub fn rated(log: &Log, scenario: &Scenario, rate: Rate) -> Result<Scenario, LogError> {
    let loop_rate = match rate {
        Rate::Scenario => scenario.loop_rate,
        Rate::Log => clock::rate(clock::times(log)?)?,
    };
    Ok(Scenario { loop_rate, ..scenario.clone() })
}

/// Where the commands come from.
fn source(log: &Log, asked: Option<Commands>) -> Result<Commands, LogError> {
    let otherwise = if log.has_commands() { Commands::Log } else { Commands::Estimated };
    match asked.unwrap_or(otherwise) {
        Commands::Log if !log.has_commands() => Err(LogError::file("holds no command")),
        Commands::Estimated if !log.has_orientation() => {
            let what = "holds no command, and no orientation to estimate the bend from: give a second file with commands, or take \
                        the scenario's motion";
            Err(LogError::file(what).or(", with --commands"))
        }
        source => Ok(source),
    }
}

/// The log's commands as bend and δ (rad), each checked against the model.
pub(super) fn ordered(log: &Log, plan: &Plan, report: &mut Report) -> Result<Track<2>, LogError> {
    let segment = plan.segment();
    let delta = plan.scenario().motion.delta;
    let radius = segment.pitch_radius;
    let values: Vec<[f64; 2]> = if log.commands.is_empty() {
        let of = |joints: &[f64; 3]| {
            let configuration = configuration_from_joints(radius, &Vec3::from(*joints));
            [configuration.bend(), configuration.delta()]
        };
        log.joints.values.iter().map(of).collect()
    } else {
        log.commands.values.iter().map(|[bend, own]| [*bend, if own.is_nan() { delta } else { *own }]).collect()
    };
    if log.commands.values.first().is_some_and(|[_, own]| own.is_nan()) {
        let told = Quantity::Angle.amount(delta, Units::Si);
        report.notes.push(format!("the log has no δ: motion.delta = {told} is taken"));
    }
    let track = if log.commands.is_empty() {
        (&log.joints.times, &log.joints.lines, &log.joints.file)
    } else {
        (&log.commands.times, &log.commands.lines, &log.commands.file)
    };
    for ([bend, _], line) in values.iter().zip(track.1) {
        if let Some(allowed) = bend_refused(segment, *bend) {
            let what = format!("a commanded bend of {bend} rad: the model does not reach so far; is the unit right?");
            let allowed = allowed.words(Quantity::Angle, Units::Si);
            return Err(LogError {
                place: Place { name: track.2.clone(), ..Place::line(u64::from(*line)) },
                what,
                allowed,
                way: "".into(),
            });
        }
    }
    Ok(Track { times: track.0.clone(), lines: track.1.clone(), values, file: track.2.clone() })
}

/// The configuration commanded at a time (s) on the log's clock, when that is known.
fn commanded(source: Commands, plan: &Plan, ordered: &Track<2>, at: f64, start: f64) -> Option<Configuration> {
    let motion = &plan.scenario().motion;
    if source == Commands::Motion {
        let (theta_l, _) = command(motion, at - start);
        return Some(Configuration::from_theta_l(theta_l, motion.delta));
    }
    let last = ordered.times.partition_point(|time| *time <= at).checked_sub(1)?;
    let [bend, delta] = ordered.values.get(last)?;
    Some(Configuration::new(*bend, *delta))
}

/// The bend (rad) in the plane of a configuration at which {G}'s tangent points as the marker's z does, both of which the
/// mounting leaves parallel.
fn measured_bend(angles: &[f64; 3], plane: &Configuration) -> f64 {
    let tangent = from_euler(angles).column(2).into_owned();
    let (sin, cos) = plane.sin_cos_delta();
    libm::atan2(tangent.x * cos - tangent.y * sin, tangent.z)
}

/// θ̇L as the backward difference of the commands; that of the second entry at the first.
fn difference(entries: &mut [Entry]) {
    for k in 1..entries.len() {
        let (before, now) = (entries[k - 1], entries[k]);
        entries[k].theta_l_rate = (before.configuration.bend() - now.configuration.bend()) / (now.time - before.time);
    }
    if let [first, second, ..] = entries {
        first.theta_l_rate = second.theta_l_rate;
    }
}
