//! What the tracker would read if the robot stood as commanded: the readings that the real ones are compared with.

use super::calibration::Command;
use crate::model::orientation::to_euler;
use crate::model::{Configuration, Mat3, Pose, Segment, Vec3};
use crate::record::Entry;
use crate::scenario::Plan;
use crate::scenario::plan::MAX_FILTER;
use crate::sensors::tracker::{Reading, refresh, tip_from_marker, unwrapped};
use std::collections::VecDeque;

/// When the tracker reads, and how its marker is mounted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Readings per second, Hz.
    pub rate: f64,
    /// Age of a reading when it arrives, s.
    pub latency: f64,
    /// R̃_gᵀ: how the marker is mounted.
    pub tip_from_marker: Mat3,
}

impl Clock {
    /// That of a plan's tracker.
    #[must_use]
    pub fn of(plan: &Plan) -> Self {
        let scenario = plan.scenario();
        let tracker = &scenario.tracker;
        let tip_from_marker = tip_from_marker(tracker.mounting, scenario.motion.delta);
        Self { rate: tracker.rate, latency: tracker.latency, tip_from_marker }
    }
}

/// What was commanded when a reading was taken, and what the free model says of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// When the reading was taken, s.
    pub taken: f64,
    /// When the tracker delivered it, s.
    pub delivered: f64,
    /// The configuration commanded then; NaN where no command is known.
    pub configuration: Configuration,
    /// Commanded φ̇ then, rad/s.
    pub bend_rate: f64,
    /// The end disk of the free model in that configuration.
    pub tip: Pose,
    /// What the tracker would read of it without any error.
    pub reading: Reading,
}

impl Expected {
    /// The command behind the reading.
    #[must_use]
    pub fn command(&self) -> Command {
        let Self { taken, configuration, bend_rate, .. } = self;
        Command { time: *taken, bend: configuration.bend(), rate: *bend_rate, delta: configuration.delta() }
    }
}

/// The tracker's readings as the free model has them, one for each of the tracker's.
#[derive(Debug, Clone)]
pub struct Nominal {
    clock: Clock,
    segment: Segment,
    /// Times (s) and commands with φ̇ (rad/s), as far back as a reading may look.
    commands: VecDeque<(f64, Configuration, f64)>,
    /// Whether commands were given up because too many would have to be kept.
    given_up: bool,
    /// The refresh of the tracker at which the last reading came.
    refresh: Option<f64>,
    /// The angles of the last reading that had any, rad.
    angles: Option<[f64; 3]>,
}

impl Nominal {
    /// Before the first entry.
    #[must_use]
    pub fn new(segment: &Segment, clock: &Clock) -> Self {
        let commands = VecDeque::new();
        Self { clock: *clock, segment: *segment, commands, given_up: false, refresh: None, angles: None }
    }

    /// Takes the next entry; where the tracker has a new reading in it, what is expected of that.
    pub fn take(&mut self, entry: &Entry) -> Option<Expected> {
        self.commanded_at(entry.time, entry.configuration, entry.theta_l_rate)
    }

    /// The same of what is commanded at a time (s), with θ̇L (rad/s): nothing else of an entry matters.
    pub fn commanded_at(&mut self, time: f64, configuration: Configuration, theta_l_rate: f64) -> Option<Expected> {
        let Clock { rate, latency, .. } = self.clock;
        // θL falls as the bend grows; at rest φ̇ is 0, not −0.
        self.commands.push_back((time, configuration, 0.0 - theta_l_rate));
        if self.commands.len() as u64 > MAX_FILTER {
            self.commands.pop_front();
            self.given_up = true;
        }
        let refresh = refresh(rate, time);
        if self.refresh == Some(refresh) {
            return None;
        }
        self.refresh = Some(refresh);
        let taken = (refresh / rate).min(time) - latency;
        let (configuration, bend_rate) = self.commanded(taken);
        let tip = self.segment.arc(configuration).pose(self.segment.length);
        let reading = self.reading(&tip);
        let delivered = refresh / rate;
        Some(Expected { taken, delivered, configuration, bend_rate, tip, reading })
    }

    /// The configuration commanded at a time (s) that is not before that of the call before, and φ̇ (rad/s); the first one for times
    /// before it.
    fn commanded(&mut self, time: f64) -> (Configuration, f64) {
        while self.commands.get(1).is_some_and(|(next, ..)| *next <= time) {
            self.commands.pop_front();
            self.given_up = false;
        }
        let unknown = (Configuration::new(f64::NAN, f64::NAN), f64::NAN);
        match (self.commands.front(), self.commands.get(1)) {
            (Some((from, ..)), _) if *from > time && self.given_up => unknown,
            (Some(&(from, first, slow)), Some(&(to, next, fast))) if time > from => {
                let share = (time - from) / (to - from);
                (between(first, next, share), slow + share * (fast - slow))
            }
            (Some(&(_, first, rate)), _) => (first, rate),
            (None, _) => unknown,
        }
    }

    /// What the tracker reads of an end disk, whole turns kept from reading to reading.
    fn reading(&mut self, tip: &Pose) -> Reading {
        let mut angles = to_euler(&(tip.rotation * self.clock.tip_from_marker));
        if let Some(before) = self.angles {
            angles = [0, 1, 2].map(|k| unwrapped(angles[k], before[k]));
        }
        if angles.iter().all(|angle| angle.is_finite()) {
            self.angles = Some(angles);
            return Reading { position: tip.position, angles };
        }
        Reading { position: Vec3::repeat(f64::NAN), angles: [f64::NAN; 3] }
    }
}

/// A configuration between two, a share of the way from one to the other.
fn between(from: Configuration, to: Configuration, share: f64) -> Configuration {
    let mean = |a: f64, b: f64| a + share * (b - a);
    if from.delta() == to.delta() {
        return from.with_bend(mean(from.bend(), to.bend()));
    }
    // As vectors, which a turn of δ by half a turn with the sign of the bend leaves alone.
    let vector = |of: Configuration| {
        let (sin, cos) = of.sin_cos_delta();
        (of.bend() * sin, of.bend() * cos)
    };
    let ((sin, cos), (sin_to, cos_to)) = (vector(from), vector(to));
    let (sin, cos) = (mean(sin, sin_to), mean(cos, cos_to));
    Configuration::new(libm::hypot(sin, cos), libm::atan2(sin, cos))
}
