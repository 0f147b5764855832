//! Table II with the calibration filter's detector and estimator in place of the paper's, from the same readings.

use super::{Disk, Met, Outcome, Row, Spread};
use crate::detect::alarm::Alarms;
use crate::detect::calibration::marginal::Place;
use crate::detect::estimates::marginal;
use crate::detect::evidence::Observer;
use crate::detect::{Method, Settings};
use serde::Serialize;

/// The contact is placed so long after the alarm of `cusum`, s.
pub const AFTER: f64 = 0.5;

/// What the experiments on one disk come to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ours {
    /// As for the paper's method: detected by `cusum`, and placed half a second later.
    #[serde(flatten)]
    pub disk: Disk,
    /// In how many experiments in which contact was found it could be placed.
    pub placed: usize,
    /// In what share of those the 95 % interval of the place holds the true one; NaN over none.
    pub covered: f64,
}

impl Ours {
    pub(super) fn new(truth: Met, rows: &[OurRow]) -> Self {
        let rows = || rows.iter().filter(|row| row.disk == truth.disk);
        let counted = |outcome| rows().filter(|row| row.row.outcome == outcome).count();
        let plain: Vec<Row> = rows().map(|row| row.row).collect();
        let found = rows().filter(|row| row.row.outcome == Outcome::Found);
        let delay = Spread::of(found.clone().map(|row| row.row.detection_time - row.contact_time));
        let places = found.filter_map(|row| row.place);
        let location = Spread::of(places.clone().map(|place| place.mean));
        let holding = places.clone().filter(|place| (place.low..=place.high).contains(&truth.arc_length)).count();
        let placed = places.count();
        let disk = Disk::new(truth, &plain, Some(counted(Outcome::FalseAlarm)));
        let disk = Disk { delay, location, bias: location.mean - truth.arc_length, ..disk };
        Self { disk, placed, covered: if placed > 0 { holding as f64 / placed as f64 } else { f64::NAN } }
    }
}

/// One experiment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OurRow {
    /// The disk in contact, counted from 1 at the base.
    pub disk: u64,
    /// With the mean of the posterior as its location.
    pub row: Row,
    /// Met: when contact began, s.
    pub contact_time: f64,
    /// The place half a second after the alarm; none where contact was not found, or the run ends before.
    pub place: Option<Place>,
}

/// Whether a detection at a time (s), if there is one, is of the contact.
pub(super) fn outcome(detection: Option<f64>, contact_time: f64) -> Outcome {
    match detection {
        Some(time) if time >= contact_time => Outcome::Found,
        Some(_) => Outcome::FalseAlarm,
        None => Outcome::Missed,
    }
}

/// Whether an experiment has gone on long enough at a time (s) for its contact to be placed.
pub(super) fn is_over(alarms: &Alarms, time: f64) -> bool {
    alarm(alarms).is_some_and(|(raised, _)| time >= raised + AFTER)
}

fn alarm(alarms: &Alarms) -> Option<(f64, f64)> {
    let own = alarms.events().iter().find(|event| event.detector == Method::Cusum);
    own.map(|event| (event.raised, event.theta_l))
}

/// What an experiment comes to, of which the last instant was at `end` (s).
pub(super) fn row(settings: &Settings, observer: &Observer, alarms: &Alarms, end: f64, truth: &Met) -> OurRow {
    let alarm = alarm(alarms);
    let outcome = outcome(alarm.map(|(raised, _)| raised), truth.contact_time);
    let (detection_time, theta_l) = alarm.unwrap_or((f64::NAN, f64::NAN));
    let time = detection_time + AFTER;
    let placed = outcome == Outcome::Found && time <= end;
    let watched = if placed { observer.watched() } else { None };
    let estimate = watched.and_then(|watched| marginal(&watched, &settings.placing, detection_time, time));
    let place = estimate.map(|estimate| estimate.place);
    let location = place.map_or(f64::NAN, |place| place.mean);
    let (disk, contact_time) = (truth.disk, truth.contact_time);
    OurRow { disk, row: Row { disk, outcome, detection_time, theta_l, location }, contact_time, place }
}
