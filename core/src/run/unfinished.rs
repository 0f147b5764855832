//! A run that is judged a part at a time, for who must not be long away.

use super::Run;
use crate::detect::Settings;
use crate::detect::judge::Judging;
use crate::record::Recording;
use crate::scenario::Plan;

/// A run that is recorded and not judged to its end.
#[derive(Debug, Clone)]
pub struct Unfinished {
    plan: Plan,
    recording: Recording,
    judging: Judging,
}

impl Unfinished {
    /// Records the run of a plan.
    #[must_use]
    pub fn new(plan: Plan) -> Self {
        let recording = Recording::simulated(&plan);
        let judging = Judging::new(&recording, &Settings::of(&plan));
        Self { plan, recording, judging }
    }

    /// Judges so many entries more, or all that are left; returns whether none are.
    pub fn judge(&mut self, entries: usize) -> bool {
        self.judging.look(&self.recording, entries)
    }

    /// The run, once the rest is judged.
    #[must_use]
    pub fn finish(self) -> Run {
        let Self { plan, recording, judging } = self;
        let judged = judging.finish(&recording);
        Run { plant_events: recording.plant_events(&plan), recording, judged, plan }
    }
}
