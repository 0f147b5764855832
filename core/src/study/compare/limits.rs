//! What no test and no estimate can beat, from the nominal course of a plan.

use crate::detect::Settings;
use crate::detect::calibration::bound::{self, Beginning};
use crate::detect::calibration::course::{Model, Moment, Planner};
use crate::detect::calibration::{Noise, noise};
use crate::record::{Entry, Recorder, Truth};
use crate::scenario::Plan;
use serde::{Deserialize, Serialize};

/// Shares of false alarms at which the least delay is told.
const RATES: [f64; 12] = [0.0025, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9];

/// Delays, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Delay {
    /// The median.
    pub median: f64,
    /// Nine in ten.
    pub ninety: f64,
}

/// The least standard deviation that an unbiased estimate of the place can have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PlaceBound {
    /// Time since the contact, s.
    pub since: f64,
    /// Cramér and Rao's bound, m.
    pub bound: f64,
}

/// All of them.
#[derive(Debug, Clone)]
pub(super) struct Limits {
    delays: Vec<(f64, Delay)>,
    places: Vec<PlaceBound>,
}

/// The nominal course with the tracker's own noise.
struct Course {
    moments: Vec<Moment>,
    /// When each reading arrives, s.
    arrived: Vec<f64>,
    /// L, and the arc length of the contact, m.
    length: f64,
    place: f64,
    began: Beginning,
    /// The first instant of the loop in contact, s, from which delays count.
    contact: f64,
}

impl Course {
    /// None where there is no reading before the contact.
    fn new(plan: &Plan) -> Option<Self> {
        let contact = plan.contact()?;
        let settings = Settings::of(plan);
        let (arrived, commands): (Vec<_>, Vec<_>) = settings.readings(plan).unzip();
        let floor = noise::FLOOR;
        let Noise { position, orientation, colour } = settings.watching.declared;
        let colour = colour.max(plan.scenario().calibration.colour);
        let noise =
            Noise { position: position.max(floor.position), orientation: orientation.max(floor.orientation), colour };
        let length = settings.segment.length;
        let model = Model { length, belief: settings.watching.belief, noise };
        let moments = Planner::all(&model, &commands, false);
        let began = Beginning::of(&commands, contact.bend, contact.side)?;
        let held = |(_, truth): &(Entry, Truth)| truth.held.is_some();
        let first = Recorder::new(plan).find(held)?.0.time;
        Some(Self { moments, arrived, length, place: contact.arc_length, began, contact: first })
    }

    /// Time from the contact to the arrival of a reading after it, s.
    fn since(&self, readings: usize) -> Option<f64> {
        Some(self.arrived.get(self.began.reading.checked_add(readings)?)? - self.contact)
    }

    /// The least delay of any test with such a share of false alarms.
    fn delay(&self, rate: f64) -> Delay {
        let at = |share: f64| {
            let readings = bound::delay(&self.moments, self.length, (self.place, self.began), rate, share);
            match readings {
                Some(0) => 0.0,
                Some(readings) => self.since(readings).unwrap_or(f64::NAN),
                None => f64::NAN,
            }
        };
        Delay { median: at(0.5), ninety: at(0.9) }
    }
}

impl Limits {
    /// None of them where there is no reading before the contact. `rate` is told besides the usual ones.
    pub(super) fn new(plan: &Plan, rate: f64) -> Self {
        let Some(course) = Course::new(plan) else { return Self { delays: Vec::new(), places: Vec::new() } };
        let bounds = bound::place(&course.moments, course.length, course.place, course.began);
        let known = bounds.into_iter().enumerate();
        let places = known.filter_map(|(k, bound)| Some(PlaceBound { since: course.since(k + 1)?, bound })).collect();
        let mut rates = RATES.to_vec();
        if !rates.contains(&rate) {
            rates.push(rate);
            rates.sort_by(f64::total_cmp);
        }
        Self { delays: rates.into_iter().map(|rate| (rate, course.delay(rate))).collect(), places }
    }

    /// Delays by rising rate.
    pub(super) fn delays(&self) -> &[(f64, Delay)] {
        &self.delays
    }

    /// Cramér and Rao's bound at each reading after the contact began.
    pub(super) fn places(&self) -> &[PlaceBound] {
        &self.places
    }
}
