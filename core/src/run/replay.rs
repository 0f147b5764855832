//! A recording that a rig made, judged: kept as a run, or sample by sample.

use super::{Anew, Run, Sample};
use crate::detect::alarm::Alarms;
use crate::detect::evidence::Observer;
use crate::detect::{Crossing, Detection, Event, Settings, judge};
use crate::model::Configuration;
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
    pub fn new(recording: &'a Recording, settings: &Settings) -> Self {
        let (entries, settings) = (&recording.entries, settings.on(recording));
        let observer = Observer::new(&settings, settings.monitor(entries));
        Self { entries: entries.iter(), observer, alarms: Alarms::new(&settings) }
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
        Some(Self { plant_events: recording.plant_events(&plan), recording, judged, plan })
    }

    /// Whether a rig made the recording.
    #[must_use]
    pub fn is_recorded(&self) -> bool {
        self.recording.truth.is_none()
    }

    /// The configuration last commanded at a place in the run: a log may have gaps. Straight in a run without any command.
    ///
    /// # Panics
    /// When `k` is not below [`Run::len`].
    #[must_use]
    pub fn commanded(&self, k: usize) -> Configuration {
        let (before, after) = self.recording.entries.split_at(k + 1);
        let known = |entry: &&Entry| entry.configuration.bend().is_finite();
        let found = before.iter().rev().find(known).or_else(|| after.iter().find(known));
        let straight = || Configuration::new(0.0, self.plan.scenario().motion.delta);
        found.map_or_else(straight, |entry| entry.configuration)
    }

    /// Judges a recording that cannot be made again.
    pub(super) fn judge_again(&mut self, plan: Plan) -> Anew {
        let settings = Settings::of(&plan).on(&self.recording);
        let before = &self.judged.settings;
        let same = settings.see_as(before);
        if same {
            self.alarm_again(settings);
        } else {
            self.judged = judge(&self.recording, &settings);
        }
        self.plan = plan;
        if same { Anew::Events } else { Anew::Evidence }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Vec3;
    use crate::run::simulate;
    use crate::scenario::preset::find;
    use crate::scenario::{Plan, Scenario, Threshold};

    fn bench() -> Scenario {
        find("bench").and_then(|preset| preset.scenario()).expect("bench")
    }

    fn without_truth(run: &Run) -> Recording {
        Recording { truth: None, ..run.recording.clone() }
    }

    #[test]
    fn a_recorded_run_is_judged_anew_and_never_simulated() {
        let simulated = simulate(&bench()).expect("valid");
        let mut run = Run::recorded(simulated.plan.clone(), without_truth(&simulated)).expect("entries");
        assert_eq!((run.events(), run.contact_time(), run.is_recorded()), (simulated.events(), None, true));
        let replayed = Replay::new(&run.recording, &run.judged.settings);
        assert!(
            replayed.zip(run.samples()).all(|(a, b)| a.judgement.residual.to_bits() == b.judgement.residual.to_bits())
        );
        type Change = fn(&mut Scenario);
        let changes: [(Anew, Change); 4] = [
            (Anew::Nothing, |_| ()),
            (Anew::Events, |s| s.detection.xi2 = Threshold::On(0.005)),
            (Anew::Evidence, |s| s.filter.length = 123),
            // Another seed makes no other log.
            (Anew::Events, |s| s.seed = 5),
        ];
        let mut scenario = bench();
        for (anew, change) in changes {
            change(&mut scenario);
            let plan = Plan::new(&scenario).expect("valid");
            assert_eq!(run.update(plan.clone()), anew);
            let fresh = Run::recorded(plan, without_truth(&simulated)).expect("entries");
            assert_eq!((run.events(), run.crossings()), (fresh.events(), fresh.crossings()), "{anew:?}");
        }
        assert_eq!(run.place(6.2605), 6260);
        assert_eq!((run.place(-1.0), run.place(1e9)), (0, 10_000));
    }

    #[test]
    fn nothing_is_known_in_a_gap_and_until_the_average_is_whole_again() {
        let simulated = simulate(&bench()).expect("valid");
        let mut recording = without_truth(&simulated);
        for entry in &mut recording.entries[6000..6100] {
            entry.reading.position = Vec3::repeat(f64::NAN);
        }
        let run = Run::recorded(simulated.plan.clone(), recording).expect("entries");
        let known: Vec<usize> = (5990..6700).filter(|k| !run.sample(*k).motion.position.x.is_nan()).collect();
        assert_eq!((known[9], known[10]), (5999, 6600));
        assert_eq!(run.sample(6700).judgement.deviation, simulated.sample(6700).judgement.deviation);
        assert!(run.sample(6050).judgement.residual.is_finite(), "the load cells are there");
        let mut recording = run.recording.clone();
        for entry in &mut recording.entries[6000..6100] {
            entry.configuration = Configuration::new(f64::NAN, f64::NAN);
        }
        let run = Run::recorded(simulated.plan.clone(), recording).expect("entries");
        assert_eq!(run.commanded(6050), simulated.recording.entries[5999].configuration);
        assert_eq!(run.commanded(6100), simulated.recording.entries[6100].configuration);
    }
}
