//! The comparison behind the view of detectors: kept up with the scenario, made by a helper elsewhere or a part a frame.

use crate::app::helper::{Asking, Helper, Turn};
use crate::app::state::Tuning;
use centrode_core::detect::Method;
use centrode_core::scenario::Scenario;
use centrode_core::study::compare::{Compare, CompareError, Comparison, Spec, with};
use centrode_core::study::remote::{Found, Work};
use centrode_core::study::report::AFTER;
use centrode_core::study::{Job, Progress};
use serde_json::{Value, json};

/// The detector whose alarms are placed.
pub const PLACED: Method = Method::Cusum;
/// A comparison stays on view until the next one has so many repeats.
const ENOUGH: u64 = 20;

/// The comparison and who makes it.
#[derive(Debug)]
pub struct Comparer {
    asking: Asking,
    /// What it was made for; none while nobody looks.
    inputs: Option<Spec>,
    compare: Option<Compare>,
    /// What is shown while hardly anything is known of the next.
    before: Option<Compare>,
    /// What there is to see comes to this, of which version.
    comparison: Option<(u64, Comparison)>,
    version: u64,
    refused: Option<CompareError>,
}

impl Comparer {
    /// A comparer with nothing to do.
    #[must_use]
    pub fn new(helper: Option<Box<dyn Helper>>) -> Self {
        Self {
            asking: Asking::new(helper),
            inputs: None,
            compare: None,
            before: None,
            comparison: None,
            version: 0,
            refused: None,
        }
    }

    /// Keeps the comparison up with what is set; with no scenario, nobody looks and nothing is made. While something is on its way
    /// (`moving`) it stays as it is: a run takes longer than a frame.
    pub fn update(&mut self, scenario: Option<&Scenario>, tuning: &Tuning, moving: bool) {
        let Some(scenario) = scenario else {
            if self.inputs.take().is_some() {
                self.refused = None;
                self.asking.rest();
            }
            return;
        };
        if moving && self.inputs.is_some() {
            return;
        }
        let methods: Vec<Method> = tuning.compare.iter().collect();
        let spec = Spec {
            scenario: with(scenario, &methods),
            repeats: tuning.repeats,
            rate: tuning.wish,
            detector: PLACED,
            after: AFTER.to_vec(),
        };
        if self.inputs.as_ref() == Some(&spec) {
            return;
        }
        let back = self.inputs.replace(spec.clone()).is_none();
        self.asking.hold(self.asking.is_held() && back);
        let old = self.compare.take();
        match Compare::new(spec) {
            Ok(mut compare) => {
                old.iter().chain(&self.before).for_each(|known| compare.adopt(known));
                self.before = if is_young(&compare) { self.before.take().or(old) } else { None };
                self.compare = Some(compare);
                self.refused = None;
            }
            Err(refused) => {
                self.before = None;
                self.refused = Some(refused);
            }
        }
        self.version += 1;
        self.asking.rest();
        self.reckon();
    }

    /// Stops, or goes on.
    pub fn hold(&mut self, held: bool) {
        self.asking.hold(held);
    }

    /// Takes what has come and asks for what is missing, or makes a part; returns whether the next frame should come at once for it.
    pub fn work(&mut self) -> bool {
        let Some(compare) = self.compare.as_mut().filter(|_| self.inputs.is_some()) else { return false };
        let before = compare.progress();
        let taken = self.asking.take(|found| match found {
            Found::Detectors(pieces) => pieces.into_iter().all(|made| compare.add(made)),
            _ => true,
        });
        let turn = taken.and_then(|()| {
            let work = || Work::Detectors { spec: compare.spec().clone(), pieces: compare.missing().collect() };
            self.asking.ask(compare.progress(), work)
        });
        if turn == Ok(Turn::Make) {
            compare.step();
        }
        let (progress, young) = (compare.progress(), is_young(compare));
        if progress != before {
            self.version += 1;
            self.before = self.before.take().filter(|_| young);
            self.reckon();
        }
        match turn {
            Ok(turn) => turn == Turn::Make && !progress.is_complete(),
            Err(why) => {
                self.asking.give_up(why);
                self.version += 1;
                self.reckon();
                !self.asking.is_held() && !progress.is_complete()
            }
        }
    }

    /// What is on view comes to this.
    fn reckon(&mut self) {
        let seen = self.before.as_ref().or(self.compare.as_ref());
        let comparison = seen.map(|compare| (self.version, compare.comparison()));
        self.comparison = comparison;
    }

    /// What there is to see, what it comes to, and a number that changes with both.
    #[must_use]
    pub fn shown(&self) -> Option<(&Compare, &Comparison, u64)> {
        let seen = self.before.as_ref().or(self.compare.as_ref())?;
        self.comparison.as_ref().map(|(version, comparison)| (seen, comparison, *version))
    }

    /// Whether what there is to see is of the settings before.
    #[must_use]
    pub fn is_former(&self) -> bool {
        self.before.is_some()
    }

    /// How far it is; none when nothing is left, nobody looks or it is held.
    #[must_use]
    pub fn progress(&self) -> Option<Progress> {
        self.left().filter(|_| !self.asking.is_held())
    }

    /// How far it is; none when nothing is left or nobody looks.
    #[must_use]
    pub fn left(&self) -> Option<Progress> {
        let compare = self.compare.as_ref().filter(|_| self.inputs.is_some())?;
        Some(compare.progress()).filter(|progress| !progress.is_complete())
    }

    /// Repeats made, and of how many; none when nothing is left or nobody looks.
    #[must_use]
    pub fn left_repeats(&self) -> Option<[u64; 2]> {
        let compare = self.compare.as_ref().filter(|_| self.left().is_some())?;
        Some([compare.repeats(), compare.spec().repeats as u64])
    }

    /// Whether it was stopped.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.asking.is_held()
    }

    /// Why there is nothing to see.
    #[must_use]
    pub fn refused(&self) -> Option<&CompareError> {
        self.refused.as_ref()
    }

    /// Why the helper was given up, if it was.
    #[must_use]
    pub fn trouble(&self) -> Option<&str> {
        self.asking.trouble()
    }

    /// The same as JSON for whoever reads the page without eyes, with the progress in pieces of work.
    #[must_use]
    pub fn report(&self) -> Option<Value> {
        let (compare, comparison, _) = self.shown()?;
        let progress = compare.progress();
        Some(json!({
            "done": progress.done,
            "of": progress.of,
            "helper": self.asking.has_helper(),
            "held": self.asking.is_held(),
            "repeats": comparison.repeats,
            "soonest": comparison.soonest,
            "bound": comparison.bound,
        }))
    }
}

/// Whether too little is known yet.
fn is_young(compare: &Compare) -> bool {
    compare.repeats() < ENOUGH.min(compare.spec().repeats as u64)
}

#[cfg(test)]
mod tests;
