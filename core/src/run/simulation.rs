//! A simulated experiment sample by sample.

use super::Sample;
use crate::detect::alarm::Alarms;
use crate::detect::calibration::watched::Watched;
use crate::detect::evidence::Observer;
use crate::detect::{Crossing, Detection, Event, Settings};
use crate::plant::PlantEvent;
use crate::plant::event::Watch;
use crate::record::{Entry, Recorder};
use crate::scenario::Plan;

/// The experiment as a stream: what it keeps is one filter length of readings, the events, and the crossings unless they are taken.
#[derive(Debug, Clone)]
pub struct Simulation<'a> {
    recorder: Recorder<'a>,
    observer: Observer,
    alarms: Alarms,
    watch: Watch,
    /// What was stored last.
    entry: Option<Entry>,
}

impl<'a> Simulation<'a> {
    /// At rest before the first sample.
    #[must_use]
    pub fn new(plan: &'a Plan) -> Self {
        let settings = Settings::of(plan);
        Self {
            recorder: Recorder::new(plan),
            observer: Observer::new(&settings, settings.monitor_of(plan)),
            alarms: Alarms::new(&settings),
            watch: Watch::default(),
            entry: None,
        }
    }

    /// What the loop stored at the last sample; none before the first.
    #[must_use]
    pub fn entry(&self) -> Option<&Entry> {
        self.entry.as_ref()
    }

    /// Threshold crossings so far, in order.
    #[must_use]
    pub fn crossings(&self) -> &[Crossing] {
        self.alarms.crossings()
    }

    /// Takes the crossings so far out, so that a long run does not gather them.
    pub fn take_crossings(&mut self) -> Vec<Crossing> {
        self.alarms.take_crossings()
    }

    /// Events so far, in the order in which they were raised.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        self.alarms.events()
    }

    /// What the calibration filter has heard so far, as far as it is kept; none where no detector that judges rests on it.
    #[must_use]
    pub fn watched(&self) -> Option<Watched> {
        self.observer.watched()
    }

    /// The first detection so far.
    #[must_use]
    pub fn detection(&self) -> Option<Detection> {
        Detection::first(self.events())
    }

    /// Truth: time of the first sample in contact so far, s.
    #[must_use]
    pub fn contact_time(&self) -> Option<f64> {
        self.watch.contact_time()
    }

    /// Truth: what has become of contacts so far, in order.
    #[must_use]
    pub fn plant_events(&self) -> &[PlantEvent] {
        self.watch.events()
    }
}

impl Iterator for Simulation<'_> {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        let (entry, truth) = self.recorder.next()?;
        let evidence = self.observer.observe(&entry);
        self.alarms.look(entry.time, &entry.configuration, &evidence.judgement);
        self.watch.look(self.recorder.plan(), entry.time, &entry.configuration, truth.held);
        self.entry = Some(entry);
        Some(Sample::new(&entry, Some(&truth), &evidence))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.recorder.size_hint()
    }
}
