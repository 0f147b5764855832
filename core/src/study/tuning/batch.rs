//! Runs of one scenario, and what is known of them: counted here, or before by another study.

use super::levels::Levels;
use super::tally::{Clock, Count, Counted, Tally};
use super::watch::{Firsts, Rule};
use crate::scenario::Plan;

/// One scenario to repeat.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// The scenario, planned, with nothing left in its thresholds that no rule looks at.
    pub plan: Plan,
    /// The thresholds.
    pub levels: Levels,
    /// Its times.
    pub clock: Clock,
    /// What its runs came to.
    pub tally: Tally,
    /// What another study had counted of some rules, until there are as many runs.
    known: Vec<Known>,
}

/// What another study had counted of a rule.
#[derive(Debug, Clone, PartialEq)]
struct Known {
    rule: Rule,
    runs: u64,
    counts: Vec<Count>,
}

impl Batch {
    /// Of which nothing is done.
    #[must_use]
    pub fn new(plan: Plan, levels: Levels, clock: Clock) -> Self {
        Self { plan, levels, clock, tally: Tally::default(), known: Vec::new() }
    }

    /// Counts one run in.
    pub fn add(&mut self, firsts: &Firsts) {
        self.tally.add(firsts, &self.clock);
        self.tidy();
    }

    /// Takes over a tally that was counted elsewhere, unless it says less. Returns whether it fits: one of other thresholds, or
    /// that no runs can have come to, is left.
    pub fn set(&mut self, tally: Tally) -> bool {
        let fits = self.fits(&tally) && tally.is_of(tally.runs, &self.clock);
        if fits && tally.runs > self.tally.runs {
            self.tally = tally;
            self.tidy();
        }
        fits
    }

    /// Counts in a tally of so many other runs. Returns whether it can be one of them: another is left.
    pub fn join(&mut self, tally: &Tally, runs: u64) -> bool {
        let fits = self.fits(tally) && tally.is_of(runs, &self.clock);
        if fits {
            self.tally.join(tally);
            self.tidy();
        }
        fits
    }

    fn fits(&self, tally: &Tally) -> bool {
        let counted = tally.counts.iter().map(Vec::len);
        Rule::ALL.iter().map(|rule| rule.levels(&self.levels).len()).eq(counted)
    }

    /// What the runs say about one threshold of a rule; while there are fewer of them, what another study had counted.
    ///
    /// # Panics
    /// When there is no such level.
    #[must_use]
    pub fn counted(&self, rule: Rule, level: usize) -> Counted<'_> {
        match self.known(rule) {
            Some(known) => Counted { runs: known.runs, count: &known.counts[level] },
            None => self.tally.counted(rule, level),
        }
    }

    /// Runs that are counted of a rule.
    #[must_use]
    pub fn runs(&self, rule: Rule) -> u64 {
        self.known(rule).map_or(self.tally.runs, |known| known.runs)
    }

    fn known(&self, rule: Rule) -> Option<&Known> {
        self.known.iter().find(|known| known.rule == rule && known.runs > self.tally.runs)
    }

    /// Whether a rule counts the same in both.
    fn agrees(&self, other: &Self, rule: Rule) -> bool {
        let matters = |plan: &Plan| plan.with_thresholds(rule.matters(&plan.scenario().detection));
        self.clock == other.clock
            && rule.levels(&self.levels) == rule.levels(&other.levels)
            && matters(&self.plan) == matters(&other.plan)
    }

    /// Takes over what another batch has counted of the rules that count the same.
    pub fn adopt(&mut self, other: &Self) {
        for &rule in Rule::ALL {
            let runs = other.runs(rule);
            if runs <= self.runs(rule) || !self.agrees(other, rule) {
                continue;
            }
            let counts = match other.known(rule) {
                Some(known) => known.counts.clone(),
                None => other.tally.counts.get(rule as usize).cloned().unwrap_or_default(),
            };
            self.known.retain(|known| known.rule != rule);
            self.known.push(Known { rule, runs, counts });
            self.tally.contact = self.tally.contact.or(other.tally.contact);
        }
        // Where every rule is known alike nothing is to be counted again.
        let runs = self.known.first().map_or(0, |known| known.runs);
        if self.known.len() == Rule::ALL.len() && self.known.iter().all(|known| known.runs == runs) {
            let mut known = std::mem::take(&mut self.known);
            known.sort_by_key(|known| known.rule as usize);
            let counts = known.into_iter().map(|known| known.counts).collect();
            self.tally = Tally { runs, contact: self.tally.contact, counts };
        }
    }

    /// Forgets what its own runs have overtaken.
    fn tidy(&mut self) {
        self.known.retain(|known| known.runs > self.tally.runs);
    }
}
