//! What no test and no estimate can beat, from the nominal course of a plan.

use crate::detect::Settings;
use crate::detect::calibration::bound::{self, Drawing};
use crate::detect::calibration::course::{Model, Moment, Planner};
use crate::detect::calibration::{Command, Noise, noise};
use crate::scenario::Plan;
use serde::{Deserialize, Serialize};

/// Runs that the lower bound of the delay is drawn from.
const DRAWN: usize = 4000;
/// Shares of false alarms at which it is drawn.
const RATES: [f64; 12] = [0.0025, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9];

/// Delays, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Delay {
    /// The median.
    pub median: f64,
    /// Nine in ten.
    pub ninety: f64,
}

/// The least standard deviation that an unbiased estimate of the place can have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PlaceBound {
    /// Time since the last reading before the contact, s.
    pub since: f64,
    /// Cramér and Rao's bound, m.
    pub bound: f64,
}

/// What is known of them so far.
#[derive(Debug, Clone)]
pub(super) struct Limits {
    course: Option<Course>,
    rates: Vec<f64>,
    delays: Vec<Option<Delay>>,
    places: Vec<PlaceBound>,
}

/// The nominal course with the tracker's own noise.
#[derive(Debug, Clone)]
struct Course {
    moments: Vec<Moment>,
    /// L, and the arc length of the contact, m.
    length: f64,
    place: f64,
    /// The last reading before the contact.
    began: usize,
}

impl Course {
    /// None where there is no reading before the contact.
    fn new(plan: &Plan) -> Option<Self> {
        let contact = plan.contact()?;
        let settings = Settings::of(plan);
        let commands: Vec<_> = settings.commands(plan).collect();
        let floor = noise::FLOOR;
        let Noise { position, orientation, colour } = settings.watching.declared;
        let colour = colour.max(plan.scenario().calibration.colour);
        let noise =
            Noise { position: position.max(floor.position), orientation: orientation.max(floor.orientation), colour };
        let length = settings.segment.length;
        let model = Model { length, belief: settings.watching.belief, noise };
        let moments = Planner::all(&model, &commands, false);
        let beyond = |command: &Command| contact.side * (command.bend - contact.bend) > 0.0;
        let began = commands.iter().position(beyond)?.checked_sub(1)?;
        Some(Self { moments, length, place: contact.arc_length, began })
    }

    /// Time from the last reading before the contact to one after it, s.
    fn since(&self, readings: usize) -> Option<f64> {
        let moment = self.moments.get(self.began.checked_add(readings)?)?;
        Some(moment.command.time - self.moments[self.began].command.time)
    }
}

impl Limits {
    pub(super) fn new(plan: &Plan, rate: f64) -> Self {
        let course = Course::new(plan);
        let places = course.as_ref().map_or_else(Vec::new, |course| {
            let bounds = bound::place(&course.moments, course.length, course.place, course.began);
            let known = bounds.into_iter().enumerate();
            known.filter_map(|(k, bound)| Some(PlaceBound { since: course.since(k + 1)?, bound })).collect()
        });
        let rates = if course.is_some() { RATES.to_vec() } else { Vec::new() };
        let mut limits = Self { delays: vec![None; rates.len()], course, rates, places };
        limits.want(rate);
        limits
    }

    /// Wants the delay at a rate, too.
    pub(super) fn want(&mut self, rate: f64) {
        if self.course.is_some() && !self.rates.contains(&rate) {
            self.rates.push(rate);
            self.delays.push(None);
        }
    }

    pub(super) fn rates(&self) -> &[f64] {
        &self.rates
    }

    pub(super) fn has(&self, place: usize) -> bool {
        self.delays.get(place).is_some_and(Option::is_some)
    }

    pub(super) fn made(&self) -> usize {
        self.delays.iter().flatten().count()
    }

    /// Whether the delay at that rate was wanted.
    pub(super) fn set(&mut self, rate: f64, delay: Delay) -> bool {
        let place = self.rates.iter().position(|known| *known == rate);
        place.map(|place| self.delays[place] = Some(delay)).is_some()
    }

    /// Takes over what another of the same plan knows.
    pub(super) fn adopt(&mut self, other: &Self) {
        for (rate, delay) in other.rates.iter().zip(&other.delays) {
            if let Some(delay) = delay {
                self.set(*rate, *delay);
            }
        }
    }

    /// Delays known so far, by rising rate.
    pub(super) fn delays(&self) -> Vec<(f64, Delay)> {
        let known = self.rates.iter().zip(&self.delays);
        let mut known: Vec<_> = known.filter_map(|(rate, delay)| Some((*rate, (*delay)?))).collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        known
    }

    /// Cramér and Rao's bound at each reading after the contact began.
    pub(super) fn places(&self) -> &[PlaceBound] {
        &self.places
    }

    /// The delay of the test that knows where and when the contact begins, and no errors of calibration, before the first run is drawn.
    pub(super) fn drawing(&self, place: usize, seed: u64) -> Option<Drawing> {
        let (course, rate) = (self.course.as_ref()?, *self.rates.get(place)?);
        Some(Drawing::new(&course.moments, course.length, (course.place, course.began), (rate, DRAWN), seed))
    }

    /// The delay that was drawn for a rate.
    pub(super) fn delay(&self, drawing: Drawing) -> Option<Delay> {
        let course = self.course.as_ref()?;
        let delays = drawing.delays();
        let at = |share: f64| {
            let place = ((share * DRAWN as f64) as usize).min(DRAWN - 1);
            delays.readings.get(place).and_then(|readings| course.since(*readings)).unwrap_or(f64::NAN)
        };
        Some(Delay { median: at(0.5), ninety: at(0.9) })
    }
}
