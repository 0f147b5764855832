//! A recording that a rig made, judged: kept as a run, or sample by sample.

use super::{Anew, Run, Sample};
use crate::detect::alarm::Alarms;
use crate::detect::evidence::Observer;
use crate::detect::{Crossing, Detection, Event, Settings, judge};
use crate::record::{Entry, Recording};
use crate::scenario::Plan;

/// Entries judged as a stream, as [`Simulation`](super::Simulation) judges what it simulates.
#[derive(Debug, Clone)]
pub struct Replay<'a> {
    entries: std::slice::Iter<'a, Entry>,
    observer: Observer,
    alarms: Alarms,
}

impl<'a> Replay<'a> {
    /// Before the first entry.
    #[must_use]
    pub fn new(entries: &'a [Entry], settings: &Settings) -> Self {
        Self { entries: entries.iter(), observer: Observer::new(settings), alarms: Alarms::new(settings) }
    }

    /// Takes the crossings so far out, so that a long log does not gather them.
    pub fn take_crossings(&mut self) -> Vec<Crossing> {
        self.alarms.take_crossings()
    }

    /// Events so far, in the order in which they were raised.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        self.alarms.events()
    }

    /// The first detection so far.
    #[must_use]
    pub fn detection(&self) -> Option<Detection> {
        Detection::first(self.events())
    }
}

impl Iterator for Replay<'_> {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        let entry = self.entries.next()?;
        let evidence = self.observer.observe(entry);
        self.alarms.look(entry.time, &entry.configuration, &evidence.judgement);
        Some(Sample::new(entry, None, &evidence))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.entries.size_hint()
    }
}

impl Run {
    /// A recording that a rig made, judged by a plan; none for a recording without entries. [`Run::update`] judges it anew and
    /// never simulates.
    #[must_use]
    pub fn recorded(plan: Plan, recording: Recording) -> Option<Self> {
        if recording.entries.is_empty() {
            return None;
        }
        let judged = judge(&recording, &Settings::of(&plan));
        Some(Self { contact_time: recording.contact_time(), recording, judged, plan })
    }

    /// Whether a rig made the recording.
    #[must_use]
    pub fn is_recorded(&self) -> bool {
        self.recording.truth.is_none()
    }

    /// Judges a recording that cannot be made again.
    pub(super) fn judge_again(&mut self, plan: Plan) -> Anew {
        let settings = Settings::of(&plan);
        let before = &self.judged.settings;
        let same = Settings { thresholds: before.thresholds.clone(), ..settings.clone() } == *before;
        if same {
            self.alarm_again(settings);
        } else {
            self.judged = judge(&self.recording, &settings);
        }
        self.plan = plan;
        if same { Anew::Events } else { Anew::Evidence }
    }
}
