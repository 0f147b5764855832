//! What the repeats of a comparison come to.

use super::advice::{levels, soonest};
use super::limits::{Delay, PlaceBound};
use super::outcome::Placed;
use super::{Compare, Outcome};
use crate::detect::Method;
use crate::scenario::{Estimator, Listed};
use crate::study::course::range::quantile;
use crate::study::tuning::Point;
use crate::study::tuning::rate::{Share, Z};
use crate::study::tuning::recommend::{Search, Verdict};
use crate::study::tuning::tally::{Clock, Count, Counted, detection, false_alarms};
use libm::sqrt;
use serde::Serialize;

/// The bound of the place is told up to this many times the latest estimate, counted from the contact.
const BEYOND: f64 = 1.25;

/// What a comparison comes to. SI units; NaN where a value is not defined.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Comparison {
    /// Runs without, and as many with contact.
    pub repeats: u64,
    /// The share of runs without contact that may alarm, where false alarms are equal and for the advice.
    pub rate: f64,
    /// Each detector.
    pub detectors: Vec<Compared>,
    /// The detector whose advised threshold detects soonest; none where no detector has one.
    pub soonest: Option<&'static str>,
    /// The delay that no test can beat at that rate, which knows where and when a clamp begins to hold, and of the calibration what is known beforehand.
    pub bound: Option<Delay>,
    /// The same at other rates, rising.
    pub bounds: Vec<Bound>,
    /// Runs without contact whose innovations are white.
    pub white: Share,
    /// Places.
    pub places: Vec<Place>,
    /// What no unbiased estimate of the place can beat, for a clamp, reading by reading; nothing where nothing is placed.
    pub place_bounds: Vec<PlaceBound>,
}

/// The delay that no test can beat at a rate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Bound {
    /// The share of runs without contact that alarm.
    pub rate: f64,
    /// Its delays.
    #[serde(flatten)]
    pub delay: Delay,
}

/// One detector.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Compared {
    /// Its key.
    pub detector: &'static str,
    /// At the scenario's threshold; none while it is off.
    pub own: Option<At>,
    /// At the threshold at which so many runs alarm as may; none where no value counts.
    pub equal: Option<At>,
    /// Which threshold to take: `cell` is the detector's place, `level` that of the threshold in the curve.
    pub advised: Verdict,
    /// At rising thresholds of three digits, from one that nearly all runs without contact exceed to one that none does.
    pub curve: Vec<Point>,
}

/// One detector at one threshold.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct At {
    /// In the unit of its setting.
    pub threshold: f64,
    /// Runs without contact that alarm.
    pub false_alarms: Share,
    /// Runs with contact that alarm after it began, and not before.
    pub found: Share,
    /// Runs with contact that alarm before it began.
    pub early: Share,
    /// Median delay of the contacts met without an alarm before, s; one that is not found is later than any other.
    pub median: f64,
    /// Nine in ten of them are found within this, s.
    pub ninety: f64,
}

impl At {
    fn new(point: &Point) -> Option<Self> {
        let seen = point.detection?;
        Some(Self {
            threshold: point.threshold,
            false_alarms: point.false_alarms.rate,
            found: Share::new(seen.detected.count, seen.early.of),
            early: seen.early,
            median: seen.median,
            ninety: seen.ninety,
        })
    }
}

/// Places by one estimator, so long after the alarm.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Place {
    /// Its key.
    pub estimator: &'static str,
    /// Time since the alarm, s.
    pub after: f64,
    /// Median of the time since the contact began, s.
    pub since: f64,
    /// Contacts that were placed.
    pub count: u64,
    /// Mean error, m.
    pub bias: f64,
    /// Root of the mean square error, m.
    pub rms: f64,
    /// Ends of its 95 % interval, from the scatter of the squares, m.
    pub rms_low: f64,
    /// The upper one.
    pub rms_high: f64,
    /// 95 % intervals that hold the truth; none for an estimator without.
    pub coverage: Option<Share>,
    /// Mean width of the interval, m.
    pub width: f64,
    /// Cramér and Rao's bound at that time since the contact, m, for a clamp; none before any reading.
    pub bound: Option<f64>,
}

impl Compare {
    /// What the repeats so far come to.
    #[must_use]
    pub fn comparison(&self) -> Comparison {
        let thresholds = &self.spec.scenario.detection;
        let compared = |(place, &method): (usize, &Method)| {
            let mut peaks: Vec<f64> = self.outcomes.values().filter_map(|outcome| outcome.peak(place)).collect();
            peaks.sort_by(|a, b| b.total_cmp(a));
            let allowed = (self.spec.rate * self.outcomes.len() as f64) as usize;
            let at = |threshold: f64| At::new(&self.point(place, method, threshold));
            let curve: Vec<Point> = levels(&peaks).into_iter().map(|level| self.point(place, method, level)).collect();
            Compared {
                detector: method.key(),
                own: method.setting(thresholds).and_then(at),
                equal: peaks.get(allowed).copied().and_then(at),
                advised: self.advised(place, &curve),
                curve,
            }
        };
        let detectors: Vec<Compared> = self.task.methods.iter().enumerate().map(compared).collect();
        let white = self.outcomes.values().filter_map(|outcome| outcome.white);
        let (tested, passed) = white.fold((0, 0), |(of, count), white| (of + 1, count + u64::from(white)));
        let bounds: Vec<Bound> = self.limits.delays().iter().map(|&(rate, delay)| Bound { rate, delay }).collect();
        let places = self.places();
        let last = BEYOND * places.iter().map(|place| place.since).fold(0.0, f64::max);
        let known = self.limits.places().iter().filter(|limit| limit.since <= last && limit.bound.is_finite());
        Comparison {
            repeats: self.repeats(),
            rate: self.spec.rate,
            soonest: soonest(&detectors),
            detectors,
            bound: bounds.iter().find(|bound| bound.rate == self.spec.rate).map(|bound| bound.delay),
            bounds,
            white: Share::new(passed, tested),
            place_bounds: known.copied().collect(),
            places,
        }
    }

    fn advised(&self, place: usize, curve: &[Point]) -> Verdict {
        let mut search = Search::new(self.spec.rate);
        let met = self.outcomes.is_empty() || self.outcomes.values().any(|outcome| outcome.contact().is_some());
        search.enter(self.repeats(), met);
        curve.iter().enumerate().for_each(|(level, point)| search.look(place, level, *point));
        search.verdict()
    }

    /// One detector at one threshold. Contacts count wherever they are found: none is too late.
    fn point(&self, place: usize, method: Method, threshold: f64) -> Point {
        let scenario = self.task.plan.scenario();
        let armed =
            if scenario.detection.waits(method) { scenario.detection.armed_from } else { scenario.motion.start };
        let samples = self.task.plan.samples() as u32;
        let armed = ((armed * scenario.loop_rate) as u32).min(samples);
        let clock = Clock { rate: scenario.loop_rate, armed, samples, late: samples };
        let (mut free, mut held, mut met) = (Count::default(), Count::default(), 0);
        for outcome in self.outcomes.values() {
            let [without, with] = outcome.firsts(place, threshold);
            free.add(without, None, &clock);
            if outcome.contact().is_some() {
                met += 1;
                held.add(with, outcome.contact(), &clock);
            }
        }
        Point {
            threshold,
            false_alarms: false_alarms(Counted { runs: self.repeats(), count: &free }, &clock),
            detection: Some(detection(Counted { runs: met, count: &held }, &clock)),
        }
    }

    fn places(&self) -> Vec<Place> {
        let after = 0..self.task.after.len();
        let all = Estimator::ALL.iter().flat_map(|&estimator| after.clone().map(move |after| (estimator, after)));
        all.filter_map(|(estimator, after)| {
            let own = |placed: &&Placed| placed.estimator == estimator && placed.after == after;
            let of = |outcome: &'_ Outcome| -> Vec<Placed> { outcome.placed.iter().filter(own).cloned().collect() };
            self.place(estimator, self.task.after[after], &self.outcomes.values().flat_map(of).collect::<Vec<_>>())
        })
        .collect()
    }

    fn place(&self, estimator: Estimator, after: f64, placed: &[Placed]) -> Option<Place> {
        let since = quantile(&mut placed.iter().map(|placed| placed.since).collect::<Vec<_>>(), 0.5)?;
        let count = placed.len() as f64;
        let mean = |of: &dyn Fn(&Placed) -> f64| placed.iter().map(of).sum::<f64>() / count;
        let square = mean(&|placed| placed.error * placed.error);
        let scatter = mean(&|placed| (placed.error * placed.error - square) * (placed.error * placed.error - square));
        let away = Z * sqrt(scatter / count);
        let covered = placed.iter().filter(|placed| placed.covers).count() as u64;
        let reading = self.limits.places().iter().rfind(|limit| limit.since <= since + 1e-9);
        Some(Place {
            estimator: estimator.word(),
            after,
            since,
            count: placed.len() as u64,
            bias: mean(&|placed| placed.error),
            rms: sqrt(square),
            rms_low: sqrt((square - away).max(0.0)),
            rms_high: sqrt(square + away),
            coverage: (estimator == Estimator::Marginal).then(|| Share::new(covered, placed.len() as u64)),
            width: mean(&|placed| placed.width),
            bound: reading.map(|limit| limit.bound),
        })
    }
}
