//! The calibration filter on a stream of entries.

use super::course::{Heard, Listener, Model, Planner};
use super::watched::Watched;
use super::{Belief, Command, Noise, cusum, noise};
use crate::detect::nominal::{Clock, Expected, Nominal};
use crate::model::orientation::from_euler;
use crate::model::{Mat3, Pose, Segment};
use crate::record::Entry;

/// With what a stretch of entries is watched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watching {
    /// What is believed of the robot's calibration.
    pub belief: Belief,
    /// Noise of the tracker, where it is known: the position's (m), the orientation's (rad), its correlation. What is not is measured
    /// while the robot stands still.
    pub noise: [Option<f64>; 3],
    /// What the tracker's noise is taken for where it can be neither known nor measured.
    pub declared: Noise,
    /// What it is never taken for less than, unless it is known.
    pub least: Noise,
}

impl Watching {
    /// Noise, from what is known and from readings that were taken while the robot stood still.
    #[must_use]
    pub fn noise(&self, length: f64, readings: &Readings) -> Noise {
        let measured = if self.noise.iter().all(Option::is_some) {
            None
        } else {
            let still = noise::still(&readings.commands);
            noise::measured(length, &self.belief, &self.least, &readings.commands[..still], &readings.poses[..still])
        };
        let (other, least) = (measured.unwrap_or(self.declared), &self.least);
        let [position, orientation, colour] = self.noise;
        Noise {
            position: position.unwrap_or(other.position.max(least.position)).max(noise::FLOOR.position),
            orientation: orientation.unwrap_or(other.orientation.max(least.orientation)).max(noise::FLOOR.orientation),
            colour: colour.unwrap_or(other.colour),
        }
    }

    /// The model of a segment `length` m long, from readings that begin while the robot stands still.
    #[must_use]
    pub fn model(&self, length: f64, readings: &Readings) -> Model {
        Model { length, belief: self.belief, noise: self.noise(length, readings) }
    }
}

/// The tracker's readings, each once.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Readings {
    /// When each had arrived, s: the time of the first entry that holds it.
    pub arrived: Vec<f64>,
    /// What the robot was told when it was taken.
    pub commands: Vec<Command>,
    /// The pose of the end disk that it tells of, in {B}.
    pub poses: Vec<Pose>,
}

impl Readings {
    /// Of entries; what is no reading is left out.
    #[must_use]
    pub fn of<'a>(segment: &Segment, clock: &Clock, entries: impl IntoIterator<Item = &'a Entry>) -> Self {
        let mut nominal = Nominal::new(segment, clock);
        let mut readings = Self::default();
        for entry in entries {
            if let Some(expected) = nominal.take(entry) {
                readings.take(&expected, entry, &clock.tip_from_marker);
            }
        }
        readings
    }

    /// Takes the reading that is new in an entry; returns whether it is one.
    pub fn take(&mut self, expected: &Expected, entry: &Entry, tip_from_marker: &Mat3) -> bool {
        let Some((command, pose)) = heard(expected, entry, tip_from_marker) else { return false };
        self.arrived.push(entry.time);
        self.commands.push(command);
        self.poses.push(pose);
        true
    }
}

/// A new reading and its command; `None` where either is not known.
fn heard(expected: &Expected, entry: &Entry, tip_from_marker: &Mat3) -> Option<(Command, Pose)> {
    let command = expected.command();
    let rotation = from_euler(&entry.reading.angles) * tip_from_marker.transpose();
    let pose = Pose { position: entry.reading.position, rotation };
    let known = pose.position.sum() + pose.rotation.sum() + command.bend + command.delta + command.rate;
    known.is_finite().then_some((command, pose))
}

/// Readings that are kept of a stream: 1000 s at 100 Hz. Of what comes later there are no estimates.
pub const KEPT: usize = 100_000;

/// The calibration filter on a stream of entries.
#[derive(Debug, Clone)]
pub struct Monitor {
    tip_from_marker: Mat3,
    model: Model,
    planner: Planner,
    listener: Listener,
    readings: Readings,
    heard: Vec<Heard>,
}

impl Monitor {
    /// Before the first entry. `commands` are those of the readings to come, of which the fastest says how old a contact [`cusum`]
    /// looks for; `with_bank` where [`glr`](super::glr) is to work.
    #[must_use]
    pub fn new(clock: &Clock, model: &Model, with_bank: bool, commands: impl Iterator<Item = Command>) -> Self {
        let age = cusum::age(model, commands);
        Self {
            tip_from_marker: clock.tip_from_marker,
            model: *model,
            planner: Planner::new(model, age, with_bank),
            listener: Listener::new(model, age),
            readings: Readings::default(),
            heard: Vec::new(),
        }
    }

    /// What an entry with a new reading brings, of which this is expected; `None` where the reading is none.
    pub fn take(&mut self, expected: &Expected, entry: &Entry) -> Option<Heard> {
        let (command, pose) = heard(expected, entry, &self.tip_from_marker)?;
        let heard = self.listener.hear(&self.planner.next(&command), &pose);
        if self.heard.len() < KEPT {
            self.readings.take(expected, entry, &self.tip_from_marker);
            self.heard.push(heard);
        }
        Some(heard)
    }

    /// What has been read and heard so far, as far as it was kept.
    #[must_use]
    pub fn watched(&self) -> Watched {
        Watched { readings: self.readings.clone(), model: self.model, heard: self.heard.clone() }
    }
}
