//! A recording as the calibration filter has seen it: what estimates and pictures are made from.

use super::course::{Heard, Listener, Model, Moment, Planner};
use super::marginal::{Estimate, History, Question, estimate};
use super::monitor::{Readings, Watching};
use super::noise::Whiteness;
use crate::record::Entry;
use std::sync::Arc;

/// All readings of a recording, and what came of each.
#[derive(Debug, Clone, PartialEq)]
pub struct Watched {
    /// The readings.
    pub readings: Readings,
    /// The model of the robot and its tracker.
    pub model: Model,
    /// What does not depend on the readings.
    pub moments: Arc<[Moment]>,
    /// What each reading came to.
    pub heard: Vec<Heard>,
}

impl Watched {
    /// Of a recording.
    #[must_use]
    pub fn of(watching: &Watching, entries: &[Entry]) -> Self {
        let readings = Readings::of(watching, entries);
        let model = readings.model(watching);
        let moments = Planner::all(&model, &readings.commands, watching.with_bank);
        Self::with(readings, model, moments.into())
    }

    /// The same with moments that were made before, of the same commands and model.
    #[must_use]
    pub fn with(readings: Readings, model: Model, moments: Arc<[Moment]>) -> Self {
        let mut listener = Listener::default();
        let heard = moments.iter().zip(&readings.poses).map(|(moment, pose)| listener.hear(moment, pose)).collect();
        Self { readings, model, moments, heard }
    }

    /// The last reading that had arrived at `time` (s), as the loop stored it; none before the first.
    #[must_use]
    pub fn at(&self, entries: &[Entry], time: f64) -> Option<usize> {
        let arrived = |&k: &usize| entries.get(k).is_some_and(|entry| entry.time <= time);
        self.readings.entries.partition_point(arrived).checked_sub(1)
    }

    /// Places the contact that an alarm at the reading `alarm` told of, from readings up to `until`.
    #[must_use]
    pub fn estimate(&self, until: usize, question: &Question) -> Option<Estimate> {
        let readings = self.readings.poses.get(..=until)?;
        estimate(&History { model: &self.model, moments: &self.moments, readings }, question)
    }

    /// Whether innovations before the reading `until` are white.
    #[must_use]
    pub fn whiteness(&self, until: usize) -> Option<Whiteness> {
        let innovations: Vec<_> = self.heard.iter().take(until).map(|heard| heard.innovation).collect();
        Whiteness::of(&innovations)
    }
}
