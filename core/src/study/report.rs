//! What a run or a log comes to: crossings, events, the detection, and the largest values judged.

use crate::detect::calibration::Noise;
use crate::detect::calibration::noise::Whiteness;
use crate::detect::estimates::Estimated;
use crate::detect::force::Force;
use crate::detect::{Crossing, Detection, Event, Judged, Method, judge};
use crate::plant::{Happening, PlantEvent};
use crate::record::Recording;
use crate::run::{Run, Sample};
use crate::scenario::{Estimator, Plan, Scenario, Thresholds};
use serde::Serialize;
use thiserror::Error;

/// A run with more crossings than this has no list of them: 40 MB as JSON.
pub const MAX_CROSSINGS: usize = 1_000_000;

/// Estimates are made at the alarm and so long after it, s, unless somebody asks otherwise.
pub const AFTER: &[f64] = &[0.0, 0.1, 0.25, 0.5];

/// A run crosses thresholds too often for a list.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("at most {MAX_CROSSINGS} threshold crossings are listed, and at {time} s there are more: raise the thresholds")]
pub struct TooMany {
    /// When the first one too many happens, s.
    pub time: f64,
}

/// What a run or a log comes to. SI units; `L` is how a log was read.
#[derive(Debug, Serialize)]
#[non_exhaustive]
pub struct Report<L = ()> {
    /// What was run.
    pub scenario: Scenario,
    /// Instants judged.
    pub samples: usize,
    /// Truth; null when the beam never holds, and for a log, which does not know it.
    pub contact: Option<Contact>,
    /// Truth: what becomes of the contact, in order; left out where nothing touches or, for a log, nothing is known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub plant: Vec<PlantEvent>,
    /// Every time a threshold was passed upward, as far as they are listed.
    pub crossings: Vec<Crossing>,
    /// What each detector makes of its crossings.
    pub events: Vec<Event>,
    /// Crossings that are not listed.
    #[serde(skip)]
    pub more: u64,
    /// The first alarm of fcd; null when there is none.
    pub detection: Option<Found>,
    /// The first alarm of the detector whose contact is placed, where it has one.
    #[serde(skip)]
    pub placed: Option<Event>,
    /// Where the contact is that it told of, at several times after it.
    pub estimates: Vec<Estimated>,
    /// The same of the detector's later alarms that tell of another contact; left out without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub next_estimates: Vec<Next>,
    /// How hard it presses there, at the last of these times, if it only touches; null where that is not likely, or there are no load
    /// cells.
    pub force: Option<Pressed>,
    /// The tracker's noise as the calibration filter takes it, known or measured at rest; null where it did not watch.
    pub noise: Option<Noise>,
    /// Whether that is what the scenario says of the tracker, for it was neither known nor could be measured; left out where not.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub noise_unmeasured: bool,
    /// Whether the calibration filter's innovations are white before a contact can have begun; null where it did not watch, or too briefly.
    pub whiteness: Option<Whiteness>,
    /// Largest values judged: after arming, and for the centrode while the end disk turns.
    pub peak: Peaks,
    /// How the log was read; left out for a simulation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log: Option<L>,
}

impl<L> Report<L> {
    /// Of what was simulated, with its plan and what became of the contacts, or of a log.
    #[must_use]
    pub fn new(
        scenario: Scenario,
        tally: Tally,
        events: &[Event],
        truth: Option<(&Plan, &[PlantEvent])>,
        conclusions: Conclusions,
        log: Option<L>,
    ) -> Self {
        let Conclusions { placed, estimates, next_estimates, force, noise, noise_unmeasured, whiteness } = conclusions;
        let contact = truth.and_then(|(plan, plant)| Contact::of(plan, plant));
        let plant = truth.map_or_else(Vec::new, |(_, plant)| plant.to_vec());
        let detection = Detection::first(events);
        let delay = |detection: &Detection| contact.as_ref().map(|contact| detection.time - contact.time);
        let detection = detection.map(|detection| Found { delay: delay(&detection), detection });
        let Tally { samples, crossings: Crossings { listed, more, .. }, peak, .. } = tally;
        let events = events.to_vec();
        Self {
            scenario,
            samples,
            contact,
            plant,
            crossings: listed,
            events,
            more,
            detection,
            placed,
            estimates,
            next_estimates,
            force,
            noise,
            noise_unmeasured,
            whiteness,
            peak,
            log,
        }
    }

    /// Of a run with every crossing: what was simulated, or a log with how it was read. `scenario` is what is set, of which a log is
    /// judged without the contact.
    ///
    /// # Errors
    /// When there are too many.
    pub fn of(run: &Run, scenario: Scenario, log: Option<L>) -> Result<Self, TooMany> {
        let mut tally = Tally::new(true);
        let mut crossings = run.crossings();
        for sample in run.samples() {
            let (now, later) = crossings.split_at(crossings.partition_point(|crossing| crossing.time <= sample.time));
            tally.add(&sample, now, &scenario.detection)?;
            crossings = later;
        }
        let truth = (!run.is_recorded()).then(|| (&run.plan, run.plant_events()));
        let conclusions = Conclusions::of(&run.judged, &run.recording, Method::Cusum, AFTER);
        Ok(Self::new(scenario, tally, run.events(), truth, conclusions, log))
    }
}

/// How hard a beam presses, and in truth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pressed {
    /// By the load cells.
    #[serde(flatten)]
    pub force: Force,
    /// Truth, N; null where it is not known, or nothing flat touches.
    pub truth: Option<f64>,
}

/// Contacts are placed for so many alarms after the first.
pub const PLACED: usize = 15;

/// The contact of a later alarm.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Next {
    /// When the alarm was raised, s.
    pub raised: f64,
    /// Where the contact is.
    pub estimates: Vec<Estimated>,
}

/// What is concluded from a run as a whole.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Conclusions {
    /// [`Report::placed`].
    pub placed: Option<Event>,
    /// [`Report::estimates`].
    pub estimates: Vec<Estimated>,
    /// [`Report::next_estimates`].
    pub next_estimates: Vec<Next>,
    /// [`Report::force`].
    pub force: Option<Pressed>,
    /// [`Report::noise`].
    pub noise: Option<Noise>,
    /// [`Report::noise_unmeasured`].
    pub noise_unmeasured: bool,
    /// [`Report::whiteness`].
    pub whiteness: Option<Whiteness>,
}

impl Conclusions {
    /// Of a recording as it was judged: the contact that the first alarm of `detector` told of, at these times after it (s). Where that
    /// detector is switched off, it judges here alone.
    #[must_use]
    pub fn of(judged: &Judged, recording: &Recording, detector: Method, after: &[f64]) -> Self {
        let places = judged.settings.placing.estimators.has(Estimator::Marginal) && recording.commanded;
        let detectors = judged.settings.thresholds.detectors;
        if !detectors.has(detector) || places && !judged.settings.watches() {
            let mut settings = judged.settings.clone();
            settings.thresholds.detectors.set(detector, true);
            if places && !settings.watches() {
                // Places are the calibration filter's.
                settings.thresholds.detectors.set(Method::Cusum, true);
            }
            return Self::of(&judge(recording, &settings), recording, detector, after);
        }
        let estimates = judged.estimates(recording, detector, after);
        let marginal = estimates.iter().filter(|estimate| estimate.estimator == Estimator::Marginal);
        let last = marginal.max_by(|a, b| a.time.total_cmp(&b.time));
        let pressed = |force: Force| {
            let truth = recording.contact_force(force.time, judged.settings.segment.bending_stiffness());
            Pressed { force, truth }
        };
        let force = last.and_then(|last| Force::of(judged, recording, last)).map(pressed);
        let noise = judged.watched.as_ref().map(|watched| watched.model.noise);
        let noise_unmeasured = judged.noise_unmeasured();
        let later = judged.contacts(detector).into_iter().skip(1).take(PLACED);
        let next =
            |event: &Event| Next { raised: event.raised, estimates: judged.estimates_of(recording, event, after) };
        Self {
            placed: judged.first(detector).copied(),
            estimates,
            next_estimates: later.map(next).collect(),
            force,
            noise,
            noise_unmeasured,
            whiteness: judged.whiteness(),
        }
    }
}

/// What is gathered sample by sample.
#[derive(Debug)]
pub struct Tally {
    samples: usize,
    /// Whether every crossing is listed.
    lists: bool,
    crossings: Crossings,
    peak: Peaks,
}

impl Tally {
    /// Before the first sample; `lists` where every crossing is to be listed, else they are counted.
    #[must_use]
    pub fn new(lists: bool) -> Self {
        let crossings = Crossings::new(if lists { MAX_CROSSINGS } else { 0 });
        Self { samples: 0, lists, crossings, peak: Peaks::default() }
    }

    /// Takes a sample, and the crossings at it.
    ///
    /// # Errors
    /// When there are too many to list.
    pub fn add(&mut self, sample: &Sample, crossings: &[Crossing], thresholds: &Thresholds) -> Result<(), TooMany> {
        let Self { samples, lists, crossings: listed, peak } = self;
        *samples += 1;
        listed.add(crossings);
        if *lists && listed.more > 0 {
            return Err(TooMany { time: sample.time });
        }
        let Sample { time, judgement, .. } = sample;
        for (method, peak) in [(Method::Fcd, &mut peak.deviation), (Method::Jfd, &mut peak.residual)] {
            if let Some(value) = method.statistic(judgement, *time, thresholds).counted() {
                raise(peak, *time, value);
            }
        }
        Ok(())
    }
}

/// A contact as the simulation knows it.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Contact {
    /// When it began, s.
    pub time: f64,
    /// Where, m.
    pub arc_length: f64,
    /// Bend of the segment then, rad.
    pub bend: f64,
}

impl Contact {
    /// The first contact of a plan that was met.
    #[must_use]
    pub fn of(plan: &Plan, plant: &[PlantEvent]) -> Option<Self> {
        let met = plant.iter().find(|event| event.what == Happening::Met)?;
        let contact = plan.contacts().get(met.contact)?;
        Some(Self { time: met.time, arc_length: contact.arc_length, bend: contact.bend })
    }
}

/// A detection, and how late it is.
#[derive(Debug, Serialize)]
pub struct Found {
    /// The detection.
    #[serde(flatten)]
    pub detection: Detection,
    /// Time since the contact began, s; null without contact.
    pub delay: Option<f64>,
}

/// Largest values judged; null where nothing was.
#[derive(Debug, Default, Serialize)]
#[non_exhaustive]
pub struct Peaks {
    /// Of the centrode, m.
    pub deviation: Option<Peak>,
    /// Of joint forces, N·m.
    pub residual: Option<Peak>,
}

/// A largest value.
#[derive(Debug, Clone, Copy, Serialize)]
#[non_exhaustive]
pub struct Peak {
    /// When, s.
    pub time: f64,
    /// The value, SI.
    pub value: f64,
}

fn raise(peak: &mut Option<Peak>, time: f64, value: f64) {
    if !value.is_nan() && peak.is_none_or(|peak| value > peak.value) {
        *peak = Some(Peak { time, value });
    }
}

/// The first crossings, and how many more there are.
#[derive(Debug)]
struct Crossings {
    most: usize,
    listed: Vec<Crossing>,
    more: u64,
}

impl Crossings {
    fn new(most: usize) -> Self {
        Self { most, listed: Vec::new(), more: 0 }
    }

    fn add(&mut self, crossings: &[Crossing]) {
        let (listed, more) = crossings.split_at(crossings.len().min(self.most - self.listed.len()));
        self.listed.extend_from_slice(listed);
        self.more += more.len() as u64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::simulate;
    use crate::scenario::preset::find;

    #[test]
    fn the_first_crossings_are_listed_and_the_others_counted() {
        let at = |time| Crossing { method: Method::Fcd, time, theta_l: 0.0, value: 2.0, threshold: 1.0 };
        let mut crossings = Crossings::new(3);
        for some in [&[][..], &[at(1.0), at(2.0)], &[at(3.0), at(4.0)], &[at(5.0)]] {
            crossings.add(some);
        }
        assert_eq!((crossings.listed, crossings.more), (vec![at(1.0), at(2.0), at(3.0)], 2));
    }

    #[test]
    fn a_report_of_a_run_holds_what_the_run_found() {
        let run = simulate(&find("bench").and_then(|preset| preset.scenario()).expect("a preset")).expect("a run");
        let report = Report::<()>::of(&run, run.plan.scenario().clone(), None).expect("few crossings");
        assert_eq!((report.samples, &*report.crossings, &*report.events), (run.len(), run.crossings(), run.events()));
        assert_eq!(report.detection.map(|found| found.detection), run.detection());
        assert_eq!(report.contact.map(|contact| contact.time), run.contact_time());
        let peak = report.peak.deviation.expect("a peak");
        let alarms = run.events().iter().filter(|event| event.detector == Method::Fcd);
        assert!(alarms.map(|event| event.value).fold(0.0, f64::max) <= peak.value);
    }
}
