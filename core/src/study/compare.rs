//! Detectors side by side: false alarms and delays at their own thresholds, at equal false alarms and over all thresholds, beside what no
//! test can beat; and places with their intervals, beside what no estimate can beat.
//!
//! Reading order: `outcome` (what one repeat comes to), `limits` (what cannot be beaten), `comparison` (what all repeats come to),
//! `advice` (which threshold to take), `chart` and `export`.

pub mod advice;
pub mod chart;
mod comparison;
pub mod export;
mod limits;
mod outcome;

pub use comparison::{At, Bound, Compared, Comparison, Place};
pub use limits::{Delay, PlaceBound};
pub use outcome::Outcome;

use super::{Job, Progress};
use crate::detect::Method;
use crate::run::at_most;
use crate::scenario::{Detectors, Estimator, Plan, Scenario, ScenarioError, Thresholds};
use limits::Limits;
use outcome::{Making, Task};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;
use thiserror::Error;

/// The longest run, in samples.
const LONGEST: usize = 200_000;

/// What to compare.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
#[non_exhaustive]
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

/// A piece of the work: a repeat, which is a run without contact and one with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Piece(pub u64);

/// What a repeat comes to, and which it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Made(pub u64, pub Outcome);

/// A comparison under way.
#[derive(Debug, Clone)]
pub struct Compare {
    spec: Spec,
    task: Task,
    limits: Limits,
    outcomes: BTreeMap<u64, Outcome>,
    begun: Option<Making>,
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
        let methods: Vec<Method> = spec.scenario.detection.detectors.iter().collect();
        if methods.is_empty() {
            return Err(CompareError::NoDetector);
        }
        Plan::new(&spec.scenario)?;
        let plan = at_most(Plan::new(&judged(&spec))?, LONGEST)?;
        if plan.contact().is_none() {
            return Err(CompareError::NoContact);
        }
        let limits = Limits::new(&plan, spec.rate);
        let places = spec.scenario.detection.of(spec.detector).value().is_some();
        let after = if places { spec.after.clone() } else { Vec::new() };
        let task = Task { free: plan.without_contact(), plan, methods, detector: spec.detector, after };
        Ok(Self { spec, task, limits, outcomes: BTreeMap::new(), begun: None })
    }

    /// What is compared.
    #[must_use]
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// Takes over what another comparison has made where both would make the same: all of it where they differ in nothing but
    /// repeats, rate and thresholds that matter to no run, else nothing.
    pub fn adopt(&mut self, other: &Self) {
        if self.task != other.task {
            return;
        }
        let repeats = self.spec.repeats as u64;
        let known = other.outcomes.range(..repeats).map(|(repeat, outcome)| (*repeat, outcome.clone()));
        self.outcomes.extend(known);
    }

    /// Makes a piece; changes nothing, so that many can be made at once.
    #[must_use]
    pub fn make(&self, piece: Piece) -> Made {
        let mut making = Making::new(piece.0);
        while !making.step(&self.task) {}
        Made(piece.0, making.outcome())
    }

    /// Counts a piece in. One that was not asked for, or that does not fit, is left; returns whether it fits.
    pub fn add(&mut self, made: Made) -> bool {
        let Made(repeat, outcome) = made;
        let fits = outcome.is_of(&self.task) && repeat < self.spec.repeats as u64;
        if fits {
            self.outcomes.insert(repeat, outcome);
        }
        fits
    }

    /// Repeats made.
    #[must_use]
    pub fn repeats(&self) -> u64 {
        self.outcomes.len() as u64
    }

    /// The repeats of a range that are made, each with what it came to.
    pub fn made(&self, repeats: Range<u64>) -> impl Iterator<Item = (u64, &Outcome)> {
        self.outcomes.range(repeats).map(|(repeat, outcome)| (*repeat, outcome))
    }

    /// The pieces that are not made.
    pub fn missing(&self) -> impl Iterator<Item = Piece> + '_ {
        (0..self.spec.repeats as u64).filter(|repeat| !self.outcomes.contains_key(repeat)).map(Piece)
    }

    /// A part of a piece, small enough for a frame; what it comes to once it is whole. A piece that is left for another begins anew.
    pub fn part(&mut self, piece: Piece) -> Option<Made> {
        let begun = self.begun.take().filter(|making| making.repeat() == piece.0);
        let mut making = begun.unwrap_or_else(|| Making::new(piece.0));
        if making.step(&self.task) {
            return Some(Made(piece.0, making.outcome()));
        }
        self.begun = Some(making);
        None
    }
}

impl Job for Compare {
    fn step(&mut self) {
        let next = self.missing().next();
        if let Some(made) = next.and_then(|piece| self.part(piece)) {
            self.add(made);
        }
    }

    fn progress(&self) -> Progress {
        Progress { done: self.repeats(), of: self.spec.repeats as u64 }
    }
}

/// The scenario that is run: thresholds that change nothing of what a repeat comes to have their defaults, so that moving one costs no
/// run. Detectors that are switched off still have values.
fn judged(spec: &Spec) -> Scenario {
    let mut scenario = spec.scenario.clone();
    let default = Thresholds::default();
    let detection = &mut scenario.detection;
    for &method in Method::ALL {
        // Places follow from the alarms of their detector; whiteness is tested up to the alarm of a likelihood ratio.
        let matters = method == spec.detector || matches!(method, Method::Cusum | Method::Glr);
        if !matters || detection.of(method).value().is_none() {
            *detection.of_mut(method) = default.of(method);
        }
    }
    (detection.release, detection.hold) = (default.release, default.hold);
    if spec.detector != Method::Jfd {
        detection.xi1_factor = default.xi1_factor;
    }
    // Places need the alarms of their detector.
    detection.detectors.set(spec.detector, true);
    // And the posterior needs the calibration filter.
    let watches = [Method::Cusum, Method::Glr].into_iter().any(|method| detection.detectors.has(method));
    if !watches && scenario.estimation.estimators.has(Estimator::Marginal) {
        detection.detectors.set(Method::Cusum, true);
    }
    scenario
}

/// A scenario with these detectors instead of its own.
#[must_use]
pub fn with(scenario: &Scenario, methods: &[Method]) -> Scenario {
    let mut scenario = scenario.clone();
    scenario.detection.detectors = Detectors::of(methods);
    scenario
}
