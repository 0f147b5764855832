//! What a run of several segments comes to. Segments, disks and contacts count from 1, as in a file.

pub mod course;
pub mod figure;
pub mod placing;

use crate::detect::chain::{
    Along, ChainContactFound, ChainEvent, ChainJudged, ChainMethod, ChainSettings, judge_chain,
};
use crate::model::chain::Unsettled;
use crate::model::chain::path::What;
use crate::record::chain::ChainRecording;
use crate::record::log::chain::ChainAssembled;
use crate::scenario::chain::Stands;
use crate::scenario::{ChainPlan, Kind};
use crate::study::about::ChainAbout;
use serde::Serialize;
use std::collections::BTreeMap;

/// A run of several segments: its plan, what was recorded, and what is concluded from that.
#[derive(Debug, Clone)]
pub struct ChainRun {
    /// The plan.
    pub plan: ChainPlan,
    /// What was stored.
    pub recording: ChainRecording,
    /// What is concluded.
    pub judged: ChainJudged,
}

impl ChainRun {
    /// Simulates and judges.
    #[must_use]
    pub fn new(plan: ChainPlan) -> Self {
        let recording = ChainRecording::simulated(&plan);
        let judged = judge_chain(&recording, &ChainSettings::of(plan.scenario()));
        Self { plan, recording, judged }
    }

    /// What logs hold, judged. Its plan is the nominal experiment without contacts, which nobody knows.
    ///
    /// # Errors
    /// Never for an experiment without contacts whose segments are straight when it begins; else, where it has no stable shape then.
    pub fn recorded(assembled: &ChainAssembled) -> Result<Self, Unsettled> {
        let plan = ChainPlan::new(&assembled.scenario)?;
        let judged = judge_chain(&assembled.recording, &ChainSettings::of(plan.scenario()));
        Ok(Self { plan, recording: assembled.recording.clone(), judged })
    }

    /// What it comes to. Contacts are told by the alarms of a detector, and placed so long after them (s).
    #[must_use]
    pub fn report(&self, detector: Option<ChainMethod>, after: &[f64]) -> ChainReport {
        let detector = detector.or_else(|| self.judged.teller());
        let found = detector.map_or_else(Vec::new, |detector| self.judged.contacts(detector, after));
        self.report_of(detector, &found)
    }

    /// The same of contacts that a detector tells of.
    #[must_use]
    pub fn report_of(&self, detector: Option<ChainMethod>, found: &[ChainContactFound]) -> ChainReport {
        ChainReport {
            segments: self.recording.segments(),
            contacts: self.contacts(),
            plant_events: self.plan.path().happened().iter().map(|event| happened(event.time, event.what)).collect(),
            end: self.recording.times.last().copied().unwrap_or(0.0),
            detector: detector.map(ChainMethod::key),
            events: self.judged.events.iter().map(told).collect(),
            found: found.iter().map(found_told).collect(),
            log: None,
        }
    }

    fn contacts(&self) -> Vec<ContactTold> {
        let contacts = self.plan.scenario().contacts.iter().enumerate();
        let each = contacts.map(|(place, contact)| {
            let plane = self.plan.path().plane(place);
            let (kind, time) = match contact.stands {
                Stands::Always { .. } => ("plane", None),
                Stands::From { time, .. } => ("plane", Some(time)),
                Stands::Clamped { time } => ("clamp", Some(time)),
            };
            let largest = self.recording.truth.iter().flatten().map(|truth| truth.forces[place]).fold(0.0, f64::max);
            ContactTold {
                contact: place + 1,
                segment: contact.segment + 1,
                at: contact.at,
                kind,
                time,
                normal: plane.map(|(normal, _)| normal.into()),
                offset: plane.map(|(_, offset)| offset),
                largest_force: plane.map(|_| largest),
            }
        });
        each.collect()
    }
}

/// What a run comes to: m, rad, s, N.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChainReport {
    /// How many segments there are.
    pub segments: usize,
    /// What the backbone meets: truth.
    pub contacts: Vec<ContactTold>,
    /// What becomes of them: truth.
    pub plant_events: Vec<PlantTold>,
    /// The last instant of the run, s: before its end where the chain buckles.
    pub end: f64,
    /// The detector by which contacts are told; null where none can.
    pub detector: Option<&'static str>,
    /// Events of all detectors on all end disks.
    pub events: Vec<EventTold>,
    /// The contacts that are told.
    pub found: Vec<FoundTold>,
    /// How the log was read; of a simulated run there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log: Option<ChainAbout>,
}

/// Something that the backbone meets.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContactTold {
    /// Its number in the file.
    pub contact: usize,
    /// The segment.
    pub segment: usize,
    /// Arc length from that segment's base, m.
    pub at: f64,
    /// `plane` or `clamp`.
    pub kind: &'static str,
    /// Since when it stands, s; null for one that always does.
    pub time: Option<f64>,
    /// Normal in {B}; null of a clamp, and before it stands.
    pub normal: Option<[f64; 3]>,
    /// n·p, m.
    pub offset: Option<f64>,
    /// The largest force of the run, N.
    pub largest_force: Option<f64>,
}

/// An event of the plant.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlantTold {
    /// When, s.
    pub time: f64,
    /// `met`, `opened`, `buckled` or `lost`.
    pub what: &'static str,
    /// Which contact; null where the whole chain gives way.
    pub contact: Option<usize>,
}

/// An event of a detector.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EventTold {
    /// The segment whose end disk it is.
    pub segment: usize,
    /// The detector.
    pub detector: &'static str,
    /// When it was raised, s.
    pub raised: f64,
    /// When it was cleared, s; null while it stands at the end.
    pub cleared: Option<f64>,
    /// The value that raised it, SI.
    pub value: f64,
    /// The threshold, likewise.
    pub threshold: f64,
    /// Angle between the screw axes, rad; of `smd` alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

/// A contact that is told.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundTold {
    /// Its first alarm, s.
    pub alarm: f64,
    /// The segment whose end disk raised it.
    pub raised_by: usize,
    /// The segments whose end disks alarm of it.
    pub deviating: Vec<usize>,
    /// Where it is, as more is read.
    pub estimates: Vec<EstimateTold>,
}

/// Where a contact is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EstimateTold {
    /// Time since the alarm, s.
    pub after: f64,
    /// Time at which it was made, s.
    pub time: f64,
    /// The likeliest segment.
    pub segment: usize,
    /// Probability of each.
    pub probabilities: Vec<f64>,
    /// Probability that nothing touches.
    pub nothing: f64,
    /// Arc length from that segment's base, m: mean.
    pub at: f64,
    /// With a probability of 95 % it is above this …
    pub low: f64,
    /// … and below this, if it is on that segment.
    pub high: f64,
    /// Mean arc length from the base of the chain over all segments, m.
    pub along: f64,
    /// 95 % of all probability is above this …
    pub along_low: f64,
    /// … and below this.
    pub along_high: f64,
    /// When it began, s; null where the estimator does not say.
    pub began: Option<f64>,
    /// Probability of each kind of contact that was thought of there: `plane`, `clamp`; empty where the estimator does not say.
    pub kinds: BTreeMap<&'static str, f64>,
    /// By how much the normal of a plane there is turned about the backbone's tangent from the bending plane, rad: the likeliest; null where the
    /// estimator does not say.
    pub tilt: Option<f64>,
}

fn happened(time: f64, what: What) -> PlantTold {
    let (what, contact) = match what {
        What::Met(place) => ("met", Some(place + 1)),
        What::Opened(place) => ("opened", Some(place + 1)),
        What::Buckled => ("buckled", None),
        What::Lost => ("lost", None),
    };
    PlantTold { time, what, contact }
}

fn told(event: &ChainEvent) -> EventTold {
    let ChainEvent { segment, detector, raised, cleared, value, threshold, angle } = *event;
    EventTold { segment: segment + 1, detector: detector.key(), raised, cleared, value, threshold, angle }
}

fn found_told(found: &ChainContactFound) -> FoundTold {
    let estimates = found.estimates.iter().map(|estimate| {
        let Along { mean, low, high } = estimate.along;
        EstimateTold {
            after: estimate.after,
            time: estimate.time,
            segment: estimate.segment + 1,
            probabilities: estimate.probabilities.clone(),
            nothing: estimate.nothing,
            at: estimate.place.mean,
            low: estimate.place.low,
            high: estimate.place.high,
            along: mean,
            along_low: low,
            along_high: high,
            began: estimate.began,
            kinds: estimate.kinds.iter().map(|(kind, share)| (Kind::WORDS[*kind as usize], *share)).collect(),
            tilt: estimate.tilt,
        }
    });
    FoundTold {
        alarm: found.alarm,
        raised_by: found.raised_by + 1,
        deviating: found.deviating.iter().map(|segment| segment + 1).collect(),
        estimates: estimates.collect(),
    }
}
