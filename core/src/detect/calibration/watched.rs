//! Readings as the calibration filter has heard them: what estimates and pictures are made from.

use super::course::{Heard, Model, Planner};
use super::marginal::{BEFORE, Estimate, History, Question, estimate, innovations};
use super::monitor::{KEPT, Readings};
use super::noise::Whiteness;
use crate::scenario::Kind;

/// A cumulative sum above this tells of a contact, or of innovations that are not white.
const CONTACT: f64 = 8.0;
/// Readings before the last at which the sum was zero, at which a contact may have begun nevertheless.
pub const EARLIER: usize = 25;

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
    /// The last reading that had arrived at `time` (s); none before the first, and after the last that was kept.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<usize> {
        // What came after the last that was kept is not known.
        if self.heard.len() == KEPT && self.readings.arrived.last().is_some_and(|last| *last < time) {
            return None;
        }
        // Times are added up of decimals: one that falls on a reading's is meant to.
        self.readings.arrived.partition_point(|arrived| *arrived <= time + 1e-9).checked_sub(1)
    }

    /// The readings that had arrived at some times (s, rising), without the others.
    #[must_use]
    pub fn of(&self, times: &[f64]) -> Self {
        let among = |k: &usize| times.binary_search_by(|time| time.total_cmp(&self.readings.arrived[*k])).is_ok();
        let kept: Vec<usize> = (0..self.heard.len().min(self.readings.arrived.len())).filter(among).collect();
        let readings = Readings {
            arrived: kept.iter().map(|&k| self.readings.arrived[k]).collect(),
            commands: kept.iter().map(|&k| self.readings.commands[k]).collect(),
            poses: kept.iter().map(|&k| self.readings.poses[k]).collect(),
        };
        Self { readings, model: self.model, heard: kept.iter().map(|&k| self.heard[k]).collect() }
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
        // Long before the alarm of a slow detector, the sum knows.
        let clear = self.clear_by(alarm)?.max(next);
        let begin = free.len() + (clear - next);
        let alarm = free.len() + alarm.checked_sub(next)?;
        let margin = EARLIER + (alarm - begin) / 4;
        let first = alarm.saturating_sub(BEFORE).min(begin.saturating_sub(margin)).max(from);
        free.extend(next..=until);
        let pick = |k: &usize| Some((*self.readings.commands.get(*k)?, *self.readings.poses.get(*k)?));
        let (commands, readings): (Vec<_>, Vec<_>) =
            free.iter().map(pick).collect::<Option<Vec<_>>>()?.into_iter().unzip();
        let moments = Planner::all(&self.model, &commands, false);
        let history = History { model: &self.model, moments: &moments, readings: &readings };
        estimate(&history, &Question { first, kinds, parts })
    }

    /// The first reading at which a contact can have begun of which an alarm at a reading tells.
    #[must_use]
    pub fn earliest(&self, alarm: usize) -> Option<usize> {
        let begin = self.clear_by(alarm)?;
        Some(begin.saturating_sub(EARLIER + (alarm - begin) / 4))
    }

    /// The last reading at or before one at which the cumulative sum was zero: as it has it, no contact that holds there had begun by then.
    #[must_use]
    pub fn clear_by(&self, reading: usize) -> Option<usize> {
        self.heard.get(..=reading)?.iter().rposition(|heard| heard.cusum == 0.0)
    }

    /// Whether innovations are white, up to where a contact can have begun, whatever the thresholds. `None` of too few.
    #[must_use]
    pub fn whiteness(&self) -> Option<Whiteness> {
        let told = self.heard.iter().position(|heard| heard.cusum > CONTACT);
        let until = told.map_or(self.heard.len(), |told| self.clear_by(told).map_or(0, |clear| clear + 1));
        let (commands, readings) = (self.readings.commands.get(..until)?, self.readings.poses.get(..until)?);
        let moments = Planner::all(&self.model, commands, false);
        Whiteness::of(&innovations(&History { model: &self.model, moments: &moments, readings }))
    }
}
