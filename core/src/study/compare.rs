//! Detectors side by side: false alarms and delays at their own thresholds and at equal false alarms, beside what no test can beat; and
//! places with their intervals, beside what no estimate can beat.

use super::seed::repeat_seed;
use super::tuning::rate::Share;
use super::{Job, Progress};
use crate::detect::calibration::course::{Model, Moment, Planner};
use crate::detect::calibration::{Command, Noise, bound, noise};
use crate::detect::estimates::Estimated;
use crate::detect::{Method, Settings};
use crate::run::{Run, at_most};
use crate::scenario::{Detectors, Estimator, Listed, Plan, Scenario, ScenarioError};
use crate::study::course::range::quantile;
use libm::sqrt;
use serde::Serialize;
use std::collections::BTreeMap;
use thiserror::Error;

/// Runs that the lower bound of the delay is drawn from.
const DRAWN: usize = 4000;
/// The longest run, in samples.
const LONGEST: usize = 200_000;

/// What to compare.
#[derive(Debug, Clone, PartialEq)]
pub struct Spec {
    /// The scenario; its detectors are those that are compared.
    pub scenario: Scenario,
    /// Runs without, and as many with contact.
    pub repeats: usize,
    /// The share of runs without contact that may alarm.
    pub rate: f64,
    /// Whose alarms are placed.
    pub detector: Method,
    /// So long after the alarm, s.
    pub after: Vec<f64>,
}

/// Why nothing can be compared.
#[derive(Debug, Error)]
pub enum CompareError {
    /// The scenario is impossible.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// It has no contact.
    #[error("there is nothing to find: the scenario has no contact, or the motion does not reach it")]
    NoContact,
    /// No detector is switched on.
    #[error("no detector is given")]
    NoDetector,
    /// The number of repeats.
    #[error("repeats = {0} is not allowed; allowed: a whole number from 1 to 100000")]
    Repeats(usize),
    /// The rate.
    #[error("rate = {0} is not allowed; allowed: a share above 0 and below 1")]
    Rate(f64),
}

/// Where the largest value so far of a detector rose, in one run: when (s), and to what.
type Climb = Vec<[f64; 2]>;

/// One place, and the truth.
#[derive(Debug, Clone, PartialEq)]
struct Placed {
    estimator: Estimator,
    after: usize,
    /// Estimate less truth, m.
    error: f64,
    covers: bool,
    width: f64,
}

/// What one repeat came to: a run without contact and one with.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    free: Vec<Climb>,
    held: Vec<Climb>,
    /// Truth: when the contact began, s.
    contact: Option<f64>,
    placed: Vec<Placed>,
    /// Whether innovations of the run without contact are white.
    white: Option<bool>,
}

/// A comparison under way.
#[derive(Debug, Clone)]
pub struct Compare {
    spec: Spec,
    plan: Plan,
    free: Plan,
    methods: Vec<Method>,
    outcomes: BTreeMap<u64, Outcome>,
}

impl Compare {
    /// Checks what is to be compared.
    ///
    /// # Errors
    /// When it cannot be.
    pub fn new(spec: Spec) -> Result<Self, CompareError> {
        if !(1..=100_000).contains(&spec.repeats) {
            return Err(CompareError::Repeats(spec.repeats));
        }
        if !(spec.rate > 0.0 && spec.rate < 1.0) {
            return Err(CompareError::Rate(spec.rate));
        }
        let mut scenario = spec.scenario.clone();
        let methods: Vec<Method> = scenario.detection.detectors.iter().collect();
        if methods.is_empty() {
            return Err(CompareError::NoDetector);
        }
        // Places need the alarms of their detector.
        scenario.detection.detectors.set(spec.detector, true);
        let plan = at_most(Plan::new(&scenario)?, LONGEST)?;
        if plan.contact().is_none() {
            return Err(CompareError::NoContact);
        }
        Ok(Self { free: plan.without_contact(), plan, methods, spec, outcomes: BTreeMap::new() })
    }

    /// What is compared.
    #[must_use]
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// Makes one repeat.
    #[must_use]
    pub fn run(&self, repeat: u64) -> Outcome {
        let seed = |which: u64| repeat_seed(self.spec.scenario.seed, 2 * repeat + which);
        let free = Run::new(self.free.with_seed(seed(0)));
        let white = free.judged.whiteness().map(|test| !test.fails());
        let held = Run::new(self.plan.with_seed(seed(1)));
        let contact = held.contact_time();
        Outcome {
            free: self.climbs(&free),
            placed: self.placed(&held, contact),
            held: self.climbs(&held),
            contact,
            white,
        }
    }

    fn climbs(&self, run: &Run) -> Vec<Climb> {
        let thresholds = &self.plan.scenario().detection;
        let climb = |method: &Method| {
            let mut climb: Climb = Vec::new();
            let mut most = f64::NEG_INFINITY;
            for (entry, evidence) in run.recording.entries.iter().zip(&run.judged.evidence) {
                let unit = method.unit(thresholds, evidence.judgement.shape_bound);
                let value = method.statistic(&evidence.judgement, entry.time, thresholds).counted();
                if let Some(value) = value.map(|value| value / unit)
                    && value > most
                {
                    most = value;
                    climb.push([entry.time, value]);
                }
            }
            climb
        };
        self.methods.iter().map(climb).collect()
    }

    fn placed(&self, run: &Run, contact: Option<f64>) -> Vec<Placed> {
        let (Some(event), Some(contact)) = (run.judged.first(self.spec.detector), contact) else { return Vec::new() };
        let Some(truth) = run.plan.contact().map(|contact| contact.arc_length) else { return Vec::new() };
        if event.raised < contact {
            return Vec::new();
        }
        let estimates = run.judged.estimates(&run.recording, self.spec.detector, &self.spec.after);
        let placed = |estimate: &Estimated| {
            let location = &estimate.location;
            Some(Placed {
                estimator: estimate.estimator,
                after: self.spec.after.iter().position(|after| *after == estimate.after)?,
                error: location.mean - truth,
                covers: (location.low..=location.high).contains(&truth),
                width: location.high - location.low,
            })
        };
        estimates.iter().filter_map(placed).collect()
    }

    /// Counts a repeat in.
    pub fn add(&mut self, repeat: u64, outcome: Outcome) {
        self.outcomes.insert(repeat, outcome);
    }

    /// What the repeats so far come to.
    #[must_use]
    pub fn comparison(&self) -> Comparison {
        let thresholds = &self.plan.scenario().detection;
        let detectors = self.methods.iter().enumerate().map(|(place, &method)| {
            let most = |outcome: &Outcome| outcome.free[place].last().map_or(f64::NEG_INFINITY, |last| last[1]);
            let mut highs: Vec<f64> = self.outcomes.values().map(most).collect();
            highs.sort_by(|a, b| b.total_cmp(a));
            let allowed = (self.spec.rate * highs.len() as f64) as usize;
            let equal = highs.get(allowed).copied().filter(|high| high.is_finite());
            let own = method.setting(thresholds);
            let at = |threshold: f64| self.at(place, threshold);
            Compared { detector: method.key(), own: own.map(at), equal: equal.map(at) }
        });
        let white = self.outcomes.values().filter_map(|outcome| outcome.white);
        let (mut tested, mut passed) = (0, 0);
        white.for_each(|white| {
            tested += 1;
            passed += u64::from(white);
        });
        let delays = self.bound();
        Comparison {
            repeats: self.outcomes.len() as u64,
            rate: self.spec.rate,
            detectors: detectors.collect(),
            bound: delays,
            white: Share::new(passed, tested),
            places: self.places(),
        }
    }

    /// One detector at one threshold.
    fn at(&self, place: usize, threshold: f64) -> At {
        let first = |climb: &Climb| climb.iter().find(|[_, value]| *value > threshold).map(|[time, _]| *time);
        let outcomes = || self.outcomes.values();
        let alarms = outcomes().filter(|outcome| first(&outcome.free[place]).is_some()).count() as u64;
        let (mut met, mut early, mut delays) = (0, 0, Vec::new());
        for outcome in outcomes() {
            let Some(contact) = outcome.contact else { continue };
            met += 1;
            match first(&outcome.held[place]) {
                Some(time) if time < contact => early += 1,
                Some(time) => delays.push(time - contact),
                None => {}
            }
        }
        At {
            threshold,
            false_alarms: Share::new(alarms, self.outcomes.len() as u64),
            found: Share::new(delays.len() as u64, met),
            early: Share::new(early, met),
            median: quantile(&mut delays.clone(), 0.5).unwrap_or(f64::NAN),
            ninety: quantile(&mut delays, 0.9).unwrap_or(f64::NAN),
        }
    }

    /// What no test can beat that knows where and when the contact begins, and no errors of calibration.
    fn bound(&self) -> Option<Delay> {
        let (moments, length, place, began) = self.exact()?;
        let delays =
            bound::Delays::drawn(&moments, length, (place, began), self.spec.rate, DRAWN, self.spec.scenario.seed);
        let since = |readings: usize| {
            let moment = moments.get(began.checked_add(readings)?)?;
            Some(moment.command.time - moments[began].command.time)
        };
        let at = |share: f64| {
            let place = ((share * DRAWN as f64) as usize).min(DRAWN - 1);
            delays.readings.get(place).and_then(|readings| since(*readings)).unwrap_or(f64::NAN)
        };
        Some(Delay { median: at(0.5), ninety: at(0.9) })
    }

    /// The nominal course of the plan with the tracker's own noise: moments, length, place and first reading of the contact.
    fn exact(&self) -> Option<(Vec<Moment>, f64, f64, usize)> {
        let contact = self.plan.contact()?;
        let settings = Settings::of(&self.plan);
        let commands: Vec<_> = settings.commands(&self.plan).collect();
        let floor = noise::FLOOR;
        let Noise { position, orientation, colour } = settings.watching.declared;
        let colour = colour.max(self.spec.scenario.calibration.colour);
        let noise =
            Noise { position: position.max(floor.position), orientation: orientation.max(floor.orientation), colour };
        let length = settings.segment.length;
        let model = Model { length, belief: settings.watching.belief, noise };
        let moments = Planner::all(&model, &commands, false);
        let beyond = |command: &Command| contact.side * (command.bend - contact.bend) > 0.0;
        let began = commands.iter().position(beyond)?.checked_sub(1)?;
        Some((moments, length, contact.arc_length, began))
    }

    fn places(&self) -> Vec<Place> {
        let bounds = self.exact().map(|(moments, length, place, began)| {
            let times: Vec<f64> =
                moments[began..].iter().map(|moment| moment.command.time - moments[began].command.time).collect();
            (bound::place(&moments, length, place, began), times)
        });
        let median = self.methods.iter().position(|method| *method == self.spec.detector).and_then(|place| {
            Some(self.at(place, self.spec.detector.setting(&self.plan.scenario().detection)?).median)
        });
        let all =
            Estimator::ALL.iter().flat_map(|estimator| (0..self.spec.after.len()).map(move |after| (estimator, after)));
        let place = |(estimator, after): (&Estimator, usize)| {
            let own = |placed: &&Placed| placed.estimator == *estimator && placed.after == after;
            let placed: Vec<&Placed> = self.outcomes.values().flat_map(|outcome| &outcome.placed).filter(own).collect();
            if placed.is_empty() {
                return None;
            }
            let count = placed.len() as f64;
            let mean = |of: &dyn Fn(&Placed) -> f64| placed.iter().map(|placed| of(placed)).sum::<f64>() / count;
            let covered = placed.iter().filter(|placed| placed.covers).count() as u64;
            let late = self.spec.after[after];
            let bound = bounds.as_ref().zip(median).and_then(|((bounds, times), median)| {
                let reading = times.iter().position(|time| *time >= median + late - 1e-9)?;
                bounds.get(reading.checked_sub(1)?).copied()
            });
            Some(Place {
                estimator: estimator.word(),
                after: late,
                count: placed.len() as u64,
                bias: mean(&|placed| placed.error),
                rms: sqrt(mean(&|placed| placed.error * placed.error)),
                coverage: (*estimator == Estimator::Marginal).then(|| Share::new(covered, placed.len() as u64)),
                width: mean(&|placed| placed.width),
                bound,
            })
        };
        all.filter_map(place).collect()
    }
}

impl Job for Compare {
    fn step(&mut self) {
        let next = (0..self.spec.repeats as u64).find(|repeat| !self.outcomes.contains_key(repeat));
        if let Some(repeat) = next {
            let outcome = self.run(repeat);
            self.add(repeat, outcome);
        }
    }

    fn progress(&self) -> Progress {
        Progress { done: self.outcomes.len() as u64, of: self.spec.repeats as u64 }
    }
}

/// What a comparison comes to. SI units; NaN where a value is not defined.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Runs without, and as many with contact.
    pub repeats: u64,
    /// The share of runs without contact that may alarm, where false alarms are equal.
    pub rate: f64,
    /// Each detector.
    pub detectors: Vec<Compared>,
    /// The delay that no test can beat at that rate, which knows where and when a clamp begins to hold and how the robot is calibrated.
    pub bound: Option<Delay>,
    /// Runs without contact whose innovations are white.
    pub white: Share,
    /// Places.
    pub places: Vec<Place>,
}

/// One detector.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// Its key.
    pub detector: &'static str,
    /// At the scenario's threshold; none while it is off.
    pub own: Option<At>,
    /// At the threshold at which so many runs alarm as may; none where no value counts.
    pub equal: Option<At>,
}

/// One detector at one threshold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct At {
    /// In the unit of its setting.
    pub threshold: f64,
    /// Runs without contact that alarm.
    pub false_alarms: Share,
    /// Runs with contact that alarm after it began, and not before.
    pub found: Share,
    /// Runs with contact that alarm before it began.
    pub early: Share,
    /// Median delay of the contacts found, s.
    pub median: f64,
    /// Nine in ten of them are found within this, s.
    pub ninety: f64,
}

/// Delays, s.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Delay {
    /// The median.
    pub median: f64,
    /// Nine in ten.
    pub ninety: f64,
}

/// Places by one estimator, so long after the alarm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// Its key.
    pub estimator: &'static str,
    /// Time since the alarm, s.
    pub after: f64,
    /// Contacts that were placed.
    pub count: u64,
    /// Mean error, m.
    pub bias: f64,
    /// Root of the mean square error, m.
    pub rms: f64,
    /// 95 % intervals that hold the truth; none for an estimator without.
    pub coverage: Option<Share>,
    /// Mean width of the interval, m.
    pub width: f64,
    /// Cramér and Rao's bound at the median alarm and so long after it, m, for a clamp; none before any reading.
    pub bound: Option<f64>,
}

/// A scenario with these detectors instead of its own.
#[must_use]
pub fn with(scenario: &Scenario, methods: &[Method]) -> Scenario {
    let mut scenario = scenario.clone();
    scenario.detection.detectors = Detectors::of(methods);
    scenario
}
