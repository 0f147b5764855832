//! The contacts of a run, told and placed in parts: one estimate after the other, here or elsewhere.

use super::ChainRun;
use crate::detect::chain::{ChainContactFound, ChainEstimate, ChainMethod};
use crate::scenario::ChainPlan;
use crate::scenario::chain::{ChainDraft, ChainScenario, Tracked};
use crate::study::Progress;
use serde::{Deserialize, Serialize};

/// Times after an alarm at which a contact is placed, s.
const AFTER: [f64; 3] = [0.1, 0.5, 1.0];

/// Those at which one of an experiment is placed: once where only the last disk carries a tracker, for that takes long.
#[must_use]
pub fn after(scenario: &ChainScenario) -> &'static [f64] {
    match scenario.tracked {
        Tracked::All => &AFTER,
        Tracked::Tip => &AFTER[1..2],
    }
}

/// A contact that is told, with what is known of it so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// Its alarm, and which disks deviate.
    pub found: ChainContactFound,
    /// What is known at each of [`after`]; none where the run or the contact ends before, or it cannot be placed.
    pub estimates: Vec<Option<ChainEstimate>>,
}

impl Told {
    /// What is known of it at a time (s).
    #[must_use]
    pub fn at(&self, time: f64) -> Option<&ChainEstimate> {
        self.estimates.iter().flatten().rfind(|estimate| estimate.time <= time)
    }
}

/// A part of the work.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Part {
    /// The contacts that are told.
    Contacts(Vec<ChainContactFound>),
    /// What is known of one of them at the next of the times; none where it ends before, or cannot be placed.
    Estimate {
        /// Its number, from 0.
        contact: u32,
        /// Which of the times at which it is placed, from 0.
        number: u32,
        /// What is known.
        estimate: Option<ChainEstimate>,
    },
}

/// What is known of the contacts of one run.
#[derive(Debug, Clone)]
pub struct Placing {
    teller: Option<ChainMethod>,
    after: &'static [f64],
    segments: usize,
    /// None while contacts are still to be found.
    told: Option<Vec<Told>>,
}

impl Placing {
    /// Of a run, of which nothing is known.
    #[must_use]
    pub fn new(run: &ChainRun) -> Self {
        let scenario = run.plan.scenario();
        Self { teller: run.judged.teller(), after: after(scenario), segments: scenario.segments.len(), told: None }
    }

    /// The detector that tells of contacts.
    #[must_use]
    pub fn teller(&self) -> Option<ChainMethod> {
        self.teller
    }

    /// The contacts that are told, as far as they have been found.
    #[must_use]
    pub fn told(&self) -> &[Told] {
        self.told.as_deref().unwrap_or_default()
    }

    /// The same with what is known of each.
    #[must_use]
    pub fn found(&self) -> Vec<ChainContactFound> {
        let known = |told: &Told| {
            let mut found = told.found.clone();
            found.estimates = told.estimates.iter().flatten().cloned().collect();
            found
        };
        self.told().iter().map(known).collect()
    }

    /// Finds the contacts, then places one of them, first what is known at a time (s). `None` where nothing is left to do.
    #[must_use]
    pub fn make(&self, run: &ChainRun, time: f64) -> Option<Part> {
        let Some(told) = &self.told else {
            let found = self.teller.map_or_else(Vec::new, |teller| run.judged.contacts(teller, &[]));
            return Some(Part::Contacts(found));
        };
        let teller = self.teller?;
        let due = |told: &Told| told.estimates.len() < self.after.len();
        let seen = told.iter().rposition(|told| due(told) && told.found.alarm <= time);
        let place = seen.or_else(|| told.iter().position(due))?;
        // What is read once the next contact has begun says nothing of this one alone.
        let next = told.get(place + 1).map_or(f64::INFINITY, |next| next.found.alarm);
        let one = &told[place];
        let number = one.estimates.len();
        let after = self.after[number];
        let made = (one.found.alarm + after < next).then(|| run.judged.estimate(teller, &one.found, after));
        Some(Part::Estimate { contact: place as u32, number: number as u32, estimate: made.flatten() })
    }

    /// Takes over a part. Returns whether it fits: one that is known already changes nothing, as whoever begins anew makes it again; one of a
    /// contact that is not told, or of another robot, is left.
    pub fn add(&mut self, part: Part) -> bool {
        if !self.fits(&part) {
            return false;
        }
        match (part, &mut self.told) {
            (Part::Contacts(found), told @ None) => {
                *told = Some(found.into_iter().map(|found| Told { found, estimates: Vec::new() }).collect());
                true
            }
            (Part::Contacts(found), Some(told)) => told.iter().map(|told| &told.found).eq(&found),
            (Part::Estimate { contact, number, estimate }, Some(told)) => {
                let (count, number) = (self.after.len(), number as usize);
                let Some(one) = told.get_mut(contact as usize).filter(|_| number < count) else { return false };
                if number == one.estimates.len() {
                    one.estimates.push(estimate);
                }
                number < one.estimates.len()
            }
            (Part::Estimate { .. }, None) => false,
        }
    }

    /// Whether a part can be of this robot.
    fn fits(&self, part: &Part) -> bool {
        let of = |segment: usize| segment < self.segments;
        match part {
            Part::Contacts(found) => found.iter().all(|found| {
                let deviate = !found.deviating.is_empty() && found.deviating.iter().all(|&segment| of(segment));
                of(found.raised_by) && deviate && found.estimates.is_empty()
            }),
            Part::Estimate { estimate, .. } => estimate.iter().all(|estimate| {
                let shared = estimate.probabilities.len() == self.segments;
                of(estimate.segment) && shared && estimate.posterior.len() <= self.segments
            }),
        }
    }

    /// Parts done, of all that are known of.
    #[must_use]
    pub fn progress(&self) -> Progress {
        let done: usize = self.told().iter().map(|told| told.estimates.len()).sum();
        let of = self.told().len() * self.after.len();
        let found = u64::from(self.told.is_some());
        Progress { done: found + done as u64, of: 1 + of as u64 }
    }
}

/// What is asked of somebody elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spec {
    /// The experiment, as a file has it.
    pub scenario: String,
    /// What is known at this time (s) is made first.
    pub time: f64,
}

impl Spec {
    /// Simulates the experiment.
    ///
    /// # Errors
    /// Why that is impossible.
    pub fn run(&self) -> Result<ChainRun, String> {
        let draft = ChainDraft::from_bytes(self.scenario.as_bytes()).map_err(|error| error.to_string())?;
        let scenario = draft.scenario().map_err(|error| error.to_string())?;
        let plan = ChainPlan::new(&scenario).map_err(|unsettled| unsettled.to_string())?;
        Ok(ChainRun::new(plan))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::preset::find_chain;

    #[test]
    fn parts_come_to_what_is_told_at_once_and_others_are_left() {
        let spec = Spec { scenario: find_chain("two-contacts").expect("shipped").toml.into(), time: 0.0 };
        let run = spec.run().expect("possible");
        let mut placing = Placing::new(&run);
        assert!(!placing.add(Part::Estimate { contact: 0, number: 0, estimate: None }), "nothing is told yet");
        let mut all = Vec::new();
        while let Some(part) = placing.make(&run, 0.0) {
            assert!(!placing.progress().is_complete());
            // As it comes from elsewhere.
            let bytes = postcard::to_allocvec(&part).expect("bytes");
            assert_eq!(postcard::from_bytes::<Part>(&bytes).expect("a part"), part);
            all.push(part.clone());
            assert!(placing.add(part));
        }
        assert!(placing.progress().is_complete());
        let told = placing.told().to_vec();
        assert!(all.into_iter().all(|part| placing.add(part)) && placing.told() == told, "once more says nothing new");
        let whole = run.judged.contacts(placing.teller().expect("one judges"), after(run.plan.scenario()));
        assert_eq!(whole.len(), placing.told().len());
        assert_eq!(placing.found(), whole);
        assert!(!placing.add(Part::Estimate { contact: 9, number: 0, estimate: None }));
        assert!(!placing.add(Part::Estimate { contact: 0, number: 9, estimate: None }));
        assert!(!placing.add(Part::Contacts(Vec::new())));
    }
}
