//! Readings as the calibration filter has heard them: what estimates and pictures are made from.

use super::course::{Heard, Model, Planner};
use super::marginal::{Estimate, History, Question, estimate, innovations};
use super::monitor::Readings;
use super::noise::Whiteness;

/// A contact may have begun so long before its alarm, s.
const BEFORE_ALARM: f64 = 0.5;

/// Readings, and what came of each.
#[derive(Debug, Clone, PartialEq)]
pub struct Watched {
    /// The readings.
    pub readings: Readings,
    /// The model of the robot and its tracker.
    pub model: Model,
    /// What each reading came to.
    pub heard: Vec<Heard>,
}

impl Watched {
    /// The last reading that had arrived at `time` (s); none before the first.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<usize> {
        self.readings.arrived.partition_point(|arrived| *arrived <= time).checked_sub(1)
    }

    /// Places the contact that an alarm told of, from readings up to `until`. `None` where nothing moved.
    #[must_use]
    pub fn estimate(&self, until: usize, question: &Question) -> Option<Estimate> {
        let (commands, readings) = (self.readings.commands.get(..=until)?, self.readings.poses.get(..=until)?);
        let moments = Planner::all(&self.model, commands, false);
        estimate(&History { model: &self.model, moments: &moments, readings }, question)
    }

    /// Whether innovations are white, up to half a second before an alarm at a time (s), or all of them. `None` of too few.
    #[must_use]
    pub fn whiteness_before(&self, alarm: Option<f64>) -> Option<Whiteness> {
        let until = match alarm {
            Some(alarm) => self.at(alarm - BEFORE_ALARM).map_or(0, |last| last + 1),
            None => self.heard.len(),
        };
        let (commands, readings) = (self.readings.commands.get(..until)?, self.readings.poses.get(..until)?);
        let moments = Planner::all(&self.model, commands, false);
        Whiteness::of(&innovations(&History { model: &self.model, moments: &moments, readings }))
    }
}
