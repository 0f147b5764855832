//! Readings as the calibration filter has heard them: what estimates and pictures are made from.

use super::course::{Heard, Model, Planner};
use super::marginal::{Estimate, History, Question, estimate, innovations};
use super::monitor::Readings;
use super::noise::Whiteness;
use crate::scenario::Kind;

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

    /// Places the contact that an alarm told of, from readings up to `until` without those of contacts that had been left before the
    /// alarm. `None` where nothing moved.
    #[must_use]
    pub fn estimate(&self, until: usize, alarm: usize, kinds: &[Kind], parts: u32) -> Option<Estimate> {
        let left = self.heard.get(..=alarm)?.iter().filter_map(|heard| heard.left);
        let (mut free, mut from) = (Vec::new(), 0);
        let mut next = 0;
        for [first, last] in left {
            free.extend(next..first);
            (next, from) = (last + 1, free.len());
        }
        let alarm = free.len() + alarm.checked_sub(next)?;
        free.extend(next..=until);
        let pick = |k: &usize| Some((*self.readings.commands.get(*k)?, *self.readings.poses.get(*k)?));
        let (commands, readings): (Vec<_>, Vec<_>) =
            free.iter().map(pick).collect::<Option<Vec<_>>>()?.into_iter().unzip();
        let moments = Planner::all(&self.model, &commands, false);
        let history = History { model: &self.model, moments: &moments, readings: &readings };
        estimate(&history, &Question { from, alarm, kinds, parts })
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
