//! Where the contact is that an alarm told of, at the alarm and as more is read.

use super::alarm::Event;
use super::calibration::STATES;
use super::calibration::marginal::{Estimate, Place};
use super::calibration::watched::Watched;
use super::evidence::Evidence;
use super::judge::Settings;
use crate::model::{Location, Rate, locate};
use crate::record::Entry;
use crate::scenario::{Estimator, Kind};
use serde::Serialize;
use std::collections::BTreeMap;

/// One estimate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Estimated {
    /// Time since the alarm, s.
    pub after: f64,
    /// Time at which it was made, s.
    pub time: f64,
    /// What made it.
    pub estimator: Estimator,
    /// Arc lengths, m. An estimator that gives no interval gives one of no width.
    pub location: Place,
    /// When the contact began, s; null where the estimator does not say.
    pub contact_time: Option<f64>,
    /// Probability of each kind of contact; empty where the estimator does not say.
    pub kinds: BTreeMap<&'static str, f64>,
    /// What the readings before the contact say of the robot's calibration; null where the estimator does not say.
    pub calibration: Option<Calibrated>,
}

/// An error of the calibration, as it was estimated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Error {
    /// The estimate.
    pub mean: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

/// Errors of the calibration, as they were estimated. SI units; with the meaning and sign of the keys of `calibration`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Calibrated {
    /// Offset of the tracker's frame along x, y and z of {B}, m.
    pub frame: [Error; 3],
    /// Its turn about them, rad.
    pub frame_turn: [Error; 3],
    /// Relative error of L.
    pub length: Error,
    /// Relative error of the bend.
    pub bend_scale: Error,
    /// Offset of the bend, rad.
    pub bend_offset: Error,
    /// Offset of δ, rad.
    pub delta: Error,
    /// Latency beyond the nominal one, s.
    pub latency: Error,
}

impl Calibrated {
    fn of([means, deviations]: &[[f64; STATES]; 2]) -> Self {
        let at = |i: usize| Error { mean: means[i], deviation: deviations[i] };
        Self {
            frame: [at(0), at(1), at(2)],
            frame_turn: [at(3), at(4), at(5)],
            length: at(6),
            bend_scale: at(7),
            bend_offset: at(8),
            delta: at(9),
            latency: at(10),
        }
    }
}

/// With what contacts are placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placing {
    /// The estimators.
    pub estimators: crate::scenario::Choice<Estimator>,
    /// The kinds of contact that are thought possible.
    pub plants: crate::scenario::Choice<Kind>,
    /// Beginnings that are tried from one reading to the next, at most.
    pub beginnings: u32,
}

/// The posterior of an alarm's contact, from what had been read at `time` (s). `None` without the readings, or where nothing moved.
#[must_use]
pub fn marginal(watched: &Watched, placing: &Placing, alarm: f64, time: f64) -> Option<Estimate> {
    let kinds: Vec<Kind> = placing.plants.iter().collect();
    watched.estimate(watched.at(time)?, watched.at(alarm)?, &kinds, placing.beginnings)
}

/// What is known of a run where contacts are placed.
#[derive(Debug, Clone, Copy)]
pub struct Known<'a> {
    /// What was judged.
    pub entries: &'a [Entry],
    /// What is known of each entry.
    pub evidence: &'a [Evidence],
    /// What the calibration filter has heard; none where no detector rests on it.
    pub watched: Option<&'a Watched>,
    /// With what it was judged.
    pub settings: &'a Settings,
}

/// The estimates of an event at these times since its alarm (s), as far as there are entries so late.
#[must_use]
pub fn estimates(known: &Known, event: &Event, after: &[f64]) -> Vec<Estimated> {
    let estimators: Vec<Estimator> = known.settings.placing.estimators.iter().collect();
    let all = after.iter().flat_map(|&after| estimators.iter().map(move |&estimator| (after, estimator)));
    all.filter_map(|(after, estimator)| estimate(known, event.raised, after, estimator)).collect()
}

/// What one estimator says so long after an alarm (s). `None` where there are no entries so late, or it cannot tell.
#[must_use]
pub fn estimate(known: &Known, alarm: f64, after: f64, estimator: Estimator) -> Option<Estimated> {
    let time = alarm + after;
    if known.entries.last().is_none_or(|last| last.time < time) {
        return None;
    }
    let plain = |location| {
        let (contact_time, kinds, calibration) = (None, BTreeMap::new(), None);
        Estimated { after, time, estimator, location, contact_time, kinds, calibration }
    };
    Some(match estimator {
        Estimator::Eq24 => plain(eq24(known, time)?),
        Estimator::Settled => {
            let time = time + known.settings.filter_span();
            Estimated { time, ..plain(eq24(known, time)?) }
        }
        Estimator::Marginal => {
            let estimate = marginal(known.watched?, &known.settings.placing, alarm, time)?;
            let kinds = estimate.kinds.iter().map(|(kind, share)| (Kind::WORDS[*kind as usize], *share)).collect();
            let calibration = Some(Calibrated::of(&estimate.calibration));
            Estimated { contact_time: Some(estimate.began), kinds, calibration, ..plain(estimate.place) }
        }
    })
}

/// The place that Eq. 24 gives at a time (s). `None` where the sensor has no centrode then, or there is no such entry.
fn eq24(known: &Known, time: f64) -> Option<Place> {
    let Known { entries, evidence, settings, .. } = known;
    let at = entries.partition_point(|entry| entry.time < time - 1e-9);
    let (entry, evidence) = (entries.get(at)?, evidence.get(at)?);
    let sensor = &evidence.judgement.sensor_centrode;
    let Location { arc_length, .. } =
        locate(settings.assumption, settings.segment.length, entry.configuration, Rate::BENDING, sensor)?;
    Some(Place { mean: arc_length, mode: arc_length, low: arc_length, high: arc_length })
}
