//! The calibration filter on a stream of entries: which of them bring a new reading, and what the robot was told when it was taken.

use super::course::{Heard, Listener, Model, Moment, Planner};
use super::{Belief, Command, Noise, cusum, noise};
use crate::model::orientation::from_euler;
use crate::model::{Mat3, Pose};
use crate::record::Entry;
use crate::sensors::tracker::refresh;
use std::collections::VecDeque;
use std::sync::Arc;

/// What a stretch of entries is watched with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watching {
    /// Nominal length of the segment, m.
    pub length: f64,
    /// What is believed of its calibration.
    pub belief: Belief,
    /// Noise of the tracker, where it is known: the position's (m), the orientation's (rad), its correlation. What is not is measured
    /// while the robot stands still.
    pub noise: [Option<f64>; 3],
    /// What the tracker's noise is taken for where it can be neither known nor measured.
    pub declared: Noise,
    /// How often the tracker delivers, Hz.
    pub rate: f64,
    /// Age of a reading when it arrives, s.
    pub latency: f64,
    /// R̃_gᵀ: `tip_from_marker`.
    pub tip_from_marker: Mat3,
    /// Whether the [`glr`](super::glr) is computed.
    pub with_bank: bool,
}

impl Watching {
    /// Noise, from what is known and from readings that were taken while the robot stood still.
    #[must_use]
    pub fn noise(&self, command: Option<&Command>, still: &[Pose]) -> Noise {
        let measured = if self.noise.iter().all(Option::is_some) {
            None
        } else {
            command.and_then(|command| noise::measured(self.length, command, still))
        };
        let other = measured.unwrap_or(self.declared);
        let [position, orientation, colour] = self.noise;
        Noise {
            position: position.unwrap_or(other.position).max(noise::FLOOR.position),
            orientation: orientation.unwrap_or(other.orientation).max(noise::FLOOR.orientation),
            colour: colour.unwrap_or(other.colour),
        }
    }

    /// The pose of the end disk that a reading of the marker tells of.
    fn pose(&self, entry: &Entry) -> Pose {
        let rotation = from_euler(&entry.reading.angles) * self.tip_from_marker.transpose();
        Pose { position: entry.reading.position, rotation }
    }
}

/// Which entries bring a new reading, and the command at the instant at which it was taken.
#[derive(Debug, Clone)]
pub struct Clock {
    rate: f64,
    latency: f64,
    last: Option<f64>,
    /// Commands as far back as a reading may have been taken.
    commands: VecDeque<Command>,
}

impl Clock {
    /// Of a tracker that delivers `rate` times a second (Hz) what was true `latency` (s) ago.
    #[must_use]
    pub fn new(rate: f64, latency: f64) -> Self {
        Self { rate, latency, last: None, commands: VecDeque::new() }
    }

    /// The command that belongs to a new reading; `None` where the entry holds the last one.
    pub fn look(&mut self, entry: &Entry) -> Option<Command> {
        let configuration = &entry.configuration;
        let now = Command {
            time: entry.time,
            bend: configuration.bend(),
            // θL falls as the bend grows; at rest 0, not −0.
            rate: 0.0 - entry.theta_l_rate,
            delta: configuration.delta(),
        };
        if self.latency == 0.0 {
            self.commands.clear();
        }
        self.commands.push_back(now);
        let refresh = refresh(self.rate, entry.time);
        let taken = (refresh / self.rate).min(entry.time) - self.latency;
        while self.commands.get(1).is_some_and(|next| next.time <= taken) {
            self.commands.pop_front();
        }
        if self.last == Some(refresh) {
            return None;
        }
        self.last = Some(refresh);
        let before = *self.commands.front()?;
        let share = self.commands.get(1).map_or(0.0, |after| (taken - before.time) / (after.time - before.time));
        let share = if share > 0.0 { share } else { 0.0 };
        let after = self.commands.get(1).unwrap_or(&before);
        let between = |of: fn(&Command) -> f64| of(&before) + share * (of(after) - of(&before));
        Some(Command {
            time: refresh / self.rate,
            bend: between(|command| command.bend),
            rate: between(|command| command.rate),
            delta: between(|command| command.delta),
        })
    }
}

/// The readings of a stretch of entries.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Readings {
    /// At which entry each arrived.
    pub entries: Vec<usize>,
    /// What the robot was told when it was taken.
    pub commands: Vec<Command>,
    /// The pose of the end disk that it tells of, in {B}.
    pub poses: Vec<Pose>,
}

impl Readings {
    /// Of entries; what is no reading is left out.
    #[must_use]
    pub fn of(watching: &Watching, entries: &[Entry]) -> Self {
        let mut clock = Clock::new(watching.rate, watching.latency);
        let mut readings = Self::default();
        for (k, entry) in entries.iter().enumerate() {
            if let Some(command) = clock.look(entry)
                && is_reading(entry)
            {
                readings.entries.push(k);
                readings.commands.push(command);
                readings.poses.push(watching.pose(entry));
            }
        }
        readings
    }

    /// The model that a watch takes: with noise as known, or as measured here.
    #[must_use]
    pub fn model(&self, watching: &Watching) -> Model {
        let still = noise::still(&self.commands);
        let noise = watching.noise(self.commands.first(), &self.poses[..still]);
        Model { length: watching.length, belief: watching.belief, noise }
    }
}

fn is_reading(entry: &Entry) -> bool {
    !entry.reading.position.x.is_nan() && !entry.reading.angles[0].is_nan()
}

/// The moments of a stream: made as it goes on, or before for all repeats of a plan.
#[derive(Debug, Clone)]
enum Moments {
    Made(Box<Planner>),
    Shared(Arc<[Moment]>, usize),
}

/// The calibration filter on a stream of entries.
#[derive(Debug, Clone)]
pub struct Monitor {
    watching: Watching,
    clock: Clock,
    moments: Moments,
    listener: Listener,
}

impl Monitor {
    /// Makes its moments as it goes. `commands` are those of the readings to come, of which the fastest says how old a contact
    /// [`cusum`] looks for.
    #[must_use]
    pub fn new(watching: &Watching, model: &Model, commands: impl Iterator<Item = Command>) -> Self {
        let planner = Planner::new(model, cusum::age(model, commands), watching.with_bank);
        Self::with(watching, Moments::Made(Box::new(planner)))
    }

    /// With moments that were made before, of the same commands.
    #[must_use]
    pub fn shared(watching: &Watching, moments: Arc<[Moment]>) -> Self {
        Self::with(watching, Moments::Shared(moments, 0))
    }

    fn with(watching: &Watching, moments: Moments) -> Self {
        let clock = Clock::new(watching.rate, watching.latency);
        Self { watching: *watching, clock, moments, listener: Listener::default() }
    }

    /// What an entry brings; `None` where it holds the last reading, or none.
    pub fn look(&mut self, entry: &Entry) -> Option<Heard> {
        let command = self.clock.look(entry)?;
        if !is_reading(entry) {
            return None;
        }
        let pose = self.watching.pose(entry);
        match &mut self.moments {
            Moments::Made(planner) => Some(self.listener.hear(&planner.next(&command), &pose)),
            Moments::Shared(moments, next) => {
                let moment = moments.get(*next)?;
                *next += 1;
                Some(self.listener.hear(moment, &pose))
            }
        }
    }
}
