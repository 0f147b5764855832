//! Threshold tuning: repeats of a scenario with and without contact, and what every threshold of every method would
//! have made of them.
//!
//! A run is made once and judged by all thresholds in that one pass. Repeat `k` has the seed of
//! [`repeat_seed`]; what repeats come to is counted in whole numbers. So a study is the same to the bit whoever runs
//! its pieces, in whichever order. Reading order: `sweep` (what is compared), `levels` (which thresholds), `watch`
//! (first alarms of one run), `tally` and `rate` (what they come to), `recommend` (which threshold to take), `remote` (a study that a worker makes).

pub mod chart;
pub mod levels;
pub mod rate;
pub mod recommend;
pub mod remote;
pub mod sweep;
pub mod tally;
pub mod watch;

use super::seed::repeat_seed;
use super::shared::{KEPT, Kept};
use super::truth::contact_sample;
use super::{Job, Progress};
use crate::run::kept;
use crate::scenario::keys::allowed::NOT_NEGATIVE;
use crate::scenario::keys::{Allowed, Quantity, Value};
use crate::scenario::text::Draft;
use crate::scenario::{Place, Threshold, Thresholds};
use crate::scenario::{Plan, Refused, Scenario, ScenarioError};
use levels::Levels;
use serde::{Deserialize, Serialize};
use tally::{Clock, FalseAlarms, Found, Tally, detection, false_alarms};
use watch::{Firsts, Rule, first_alarms};

/// The most repeats of one scenario.
pub const MAX_REPEATS: usize = 10_000_000;

/// The most thresholds that one study counts, over all its scenarios and methods: up to 1 GB of counts.
pub const MAX_COUNTS: usize = 20_000_000;

/// Repeats that a batch makes in its turn where there are many batches.
const TURN: u64 = 64;

/// What is to be studied.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spec {
    /// The scenario on which every cell builds.
    pub scenario: Scenario,
    /// Repeats of each cell, with contact and without.
    pub repeats: usize,
    /// An alarm later than this after contact counts as missed, s.
    pub late: f64,
    /// The cells, each a list of overrides `key=value`.
    pub cells: Vec<Vec<String>>,
    /// Thresholds ξ2 (m) in place of the usual ones.
    pub xi2: Option<Vec<f64>>,
    /// Thresholds ξ1 (N·m, or k where it follows the shape) in place of the usual ones.
    pub xi1: Option<Vec<f64>>,
}

/// One scenario to repeat.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// The scenario, planned; ξ2 does not matter to it.
    pub plan: Plan,
    /// The thresholds.
    pub levels: Levels,
    /// Its times.
    pub clock: Clock,
    /// What its runs came to.
    pub tally: Tally,
}

/// One combination of settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Its overrides.
    pub set: Vec<String>,
    /// The scenario that they make.
    pub scenario: Scenario,
    /// Place of its runs without contact among the batches.
    pub free: usize,
    /// Place of its runs with contact; none when the scenario has no contact.
    pub held: Option<usize>,
}

/// What one threshold comes to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Point {
    /// ξ2 (m) or ξ1 (N·m, or k).
    pub threshold: f64,
    /// In runs without contact.
    pub false_alarms: FalseAlarms,
    /// In runs with contact; none when the scenario has no contact.
    pub detection: Option<Found>,
}

/// A study, as far as it has come.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    spec: Spec,
    batches: Vec<Batch>,
    cells: Vec<Cell>,
    shared: Kept,
    /// Thresholds to count, over all batches and methods.
    counts: usize,
}

impl Study {
    /// A study of which nothing is done.
    ///
    /// # Errors
    /// When a cell's scenario is impossible, a number of the spec is, or there is more to count than [`MAX_COUNTS`].
    pub fn new(spec: Spec) -> Result<Self, ScenarioError> {
        if !(1..=MAX_REPEATS).contains(&spec.repeats) {
            let allowed = Allowed::Whole(1, MAX_REPEATS as u64);
            return Err(Refused::error("repeats", Quantity::Count, Value::Whole(spec.repeats as u64), allowed));
        }
        if !NOT_NEGATIVE.has(spec.late) {
            return Err(Refused::error("late", Quantity::Time, Value::Other(spec.late.to_string()), NOT_NEGATIVE));
        }
        let mut study = Self { batches: Vec::new(), cells: Vec::new(), counts: 0, shared: Kept::default(), spec };
        for set in study.spec.cells.clone() {
            let mut draft = Draft::from_scenario(&study.spec.scenario);
            set.iter().try_for_each(|text| draft.set(text))?;
            let scenario = draft.finish()?;
            let mut alone = scenario.clone();
            alone.contact.place = Place::Nowhere;
            let free = study.batch(&scenario, alone)?;
            let held = match scenario.contact.place {
                Place::Nowhere => None,
                _ => Some(study.batch(&scenario, scenario.clone())?),
            };
            study.cells.push(Cell { set, scenario, free, held });
        }
        Ok(study)
    }

    /// The place of a batch, which cells share where they differ in nothing that matters to it.
    fn batch(&mut self, cell: &Scenario, mut scenario: Scenario) -> Result<usize, ScenarioError> {
        let mut levels = Levels::of(cell);
        if let Some(xi2) = &self.spec.xi2 {
            levels.xi2.clone_from(xi2);
            levels::with(&mut levels.xi2, cell.detection.xi2.value());
        }
        if let Some(xi1) = &self.spec.xi1 {
            levels.xi1.clone_from(xi1);
            levels::with(&mut levels.xi1, xi1_setting(cell));
        }
        scenario.detection.xi2 = Threshold::OFF;
        // First alarms are counted: what ends an event does not matter.
        let Thresholds { release, hold, .. } = Thresholds::default();
        (scenario.detection.release, scenario.detection.hold) = (release, hold);
        if scenario.contact.place == Place::Nowhere {
            scenario.contact = crate::scenario::Contact { place: Place::Nowhere, ..Default::default() };
        }
        let place = self.batches.iter().position(|batch| *batch.plan.scenario() == scenario && batch.levels == levels);
        if let Some(place) = place {
            return Ok(place);
        }
        let count = |levels: &Levels| Rule::ALL.iter().map(|method| method.levels(levels).len()).sum::<usize>();
        self.counts += count(&levels);
        if self.counts > MAX_COUNTS {
            let allowed = Allowed::Need("at most 20000000 thresholds in all cells; compare fewer values or thresholds");
            let cells = Value::Whole(self.spec.cells.len() as u64);
            return Err(Refused::error("cells", Quantity::Count, cells, allowed));
        }
        let plan = kept(Plan::new(&scenario)?)?;
        let armed = first_sample(&plan, scenario.detection.armed_from);
        let late = libm::floor(self.spec.late * scenario.loop_rate * (1.0 + 4.0 * f64::EPSILON));
        let clock = Clock {
            rate: scenario.loop_rate,
            armed: armed as u32,
            samples: plan.samples() as u32,
            contact: contact_sample(&plan).map(|k| k as u32),
            late: late as u32,
        };
        self.batches.push(Batch { tally: Tally::default(), plan, levels, clock });
        Ok(self.batches.len() - 1)
    }

    /// What is studied.
    #[must_use]
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// The scenarios to repeat, each once.
    #[must_use]
    pub fn batches(&self) -> &[Batch] {
        &self.batches
    }

    /// The combinations compared, in the order asked for.
    #[must_use]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Which batch and which repeat the `piece`-th piece of work is, of [`Progress::of`]: the batches take turns, so that
    /// whoever stops early has equally many repeats of each.
    #[must_use]
    pub fn piece(&self, piece: u64) -> (usize, u64) {
        let (batches, repeats) = (self.batches.len() as u64, self.spec.repeats as u64);
        // Where not all keep what their repeats share, each takes several in its turn.
        let turn = if self.batches.len() > KEPT { TURN } else { 1 };
        let round = piece / (turn * batches);
        let size = turn.min(repeats.saturating_sub(round * turn)).max(1);
        let within = piece - round * turn * batches;
        ((within / size % batches) as usize, round * turn + within % size)
    }

    /// Makes one repeat of one batch; changes nothing, so that many can be made at once.
    ///
    /// # Panics
    /// When there is no such batch.
    #[must_use]
    pub fn run(&self, (batch, repeat): (usize, u64)) -> Firsts {
        let Batch { plan, levels, .. } = &self.batches[batch];
        let plan = plan.with_seed(repeat_seed(plan.scenario().seed, repeat));
        first_alarms(&plan, levels, &self.shared.of(&plan))
    }

    /// Counts one repeat in.
    ///
    /// # Panics
    /// When there is no such batch.
    pub fn add(&mut self, batch: usize, firsts: &Firsts) {
        let batch = &mut self.batches[batch];
        batch.tally.add(firsts, &batch.clock);
    }

    /// Takes over what another study has counted where both would count the same.
    pub fn adopt(&mut self, other: &Self) {
        for batch in &mut self.batches {
            let same =
                |known: &&Batch| known.levels == batch.levels && known.clock == batch.clock && known.plan == batch.plan;
            let known = other.batches.iter().find(same);
            if let Some(known) = known.filter(|known| known.tally.runs <= self.spec.repeats as u64) {
                batch.tally = known.tally.clone();
            }
        }
    }

    /// Takes over the tally of one batch that was counted elsewhere, unless it says less. Returns whether it fits: one of
    /// another batch or of other thresholds is left.
    pub fn set(&mut self, batch: usize, tally: Tally) -> bool {
        let Some(batch) = self.batches.get_mut(batch) else { return false };
        let counted = tally.counts.iter().map(Vec::len);
        let fits = Rule::ALL.iter().map(|rule| rule.levels(&batch.levels).len()).eq(counted);
        if fits && tally.runs > batch.tally.runs {
            batch.tally = tally;
        }
        fits
    }

    /// The batch to go on with among those wanted, so that cells are known one after the other, each with and without
    /// contact alike.
    #[must_use]
    pub fn next(&self, wanted: impl Fn(usize) -> bool) -> Option<usize> {
        let repeats = self.spec.repeats as u64;
        let runs = |batch: &usize| self.batches[*batch].tally.runs;
        let left = |cell: &Cell| {
            let both = [Some(cell.free), cell.held].into_iter().flatten();
            both.filter(|batch| wanted(*batch) && runs(batch) < repeats).min_by_key(runs)
        };
        self.cells.iter().find_map(left)
    }

    /// The batches that are not complete.
    #[must_use]
    pub fn missing(&self) -> Vec<usize> {
        let wanted = self.spec.repeats as u64;
        (0..self.batches.len()).filter(|&batch| self.batches[batch].tally.runs < wanted).collect()
    }

    /// The thresholds of a method in a cell.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn levels(&self, cell: usize, method: Rule) -> &[f64] {
        method.levels(&self.batches[self.cells[cell].free].levels)
    }

    /// What a threshold comes to in a cell.
    ///
    /// # Panics
    /// When there is no such cell or level.
    #[must_use]
    pub fn point(&self, cell: usize, method: Rule, level: usize) -> Point {
        let Cell { free, held, .. } = self.cells[cell];
        let free = &self.batches[free];
        Point {
            threshold: method.levels(&free.levels)[level],
            false_alarms: false_alarms(&free.tally, &free.clock, method, level),
            detection: held.map(|held| {
                let held = &self.batches[held];
                detection(&held.tally, &held.clock, method, level)
            }),
        }
    }

    /// What all thresholds of a method come to in a cell, rising.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn curve(&self, cell: usize, method: Rule) -> Vec<Point> {
        (0..self.levels(cell, method).len()).map(|level| self.point(cell, method, level)).collect()
    }

    /// The level of the cell's own setting; none while it is switched off.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn own(&self, cell: usize, method: Rule) -> Option<usize> {
        let scenario = &self.cells[cell].scenario;
        let setting = if method == Rule::Jfd { xi1_setting(scenario) } else { scenario.detection.xi2.value() };
        self.levels(cell, method).iter().position(|&level| Some(level) == setting)
    }

    /// Repeats made of a cell: without contact, and with.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn repeats(&self, cell: usize) -> (u64, Option<u64>) {
        let Cell { free, held, .. } = self.cells[cell];
        (self.batches[free].tally.runs, held.map(|held| self.batches[held].tally.runs))
    }

    /// Truth: when contact begins in a cell, s; none without.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn contact_time(&self, cell: usize) -> Option<f64> {
        let held = &self.batches[self.cells[cell].held?];
        held.clock.contact.map(|sample| held.plan.time(sample as usize))
    }
}

/// ξ1 as levels count it: N·m, or k where it follows the shape; none while switched off.
#[must_use]
pub fn xi1_setting(scenario: &Scenario) -> Option<f64> {
    use crate::scenario::Xi1Rule;
    let detection = &scenario.detection;
    detection.xi1.value().map(|constant| match detection.xi1_rule {
        Xi1Rule::Constant => constant,
        Xi1Rule::Bound => detection.xi1_factor,
    })
}

/// The first sample not before `time` (s); the run's length when there is none.
fn first_sample(plan: &Plan, time: f64) -> usize {
    let (mut before, mut after) = (0, plan.samples());
    while before < after {
        let middle = before + (after - before) / 2;
        if plan.time(middle) < time { before = middle + 1 } else { after = middle }
    }
    after
}

/// A piece is one run.
impl Job for Study {
    fn step(&mut self) {
        if let Some(batch) = self.next(|_| true) {
            let firsts = self.run((batch, self.batches[batch].tally.runs));
            self.add(batch, &firsts);
        }
    }

    fn progress(&self) -> Progress {
        let done = self.batches.iter().map(|batch| batch.tally.runs).sum();
        Progress { done, of: self.batches.len() as u64 * self.spec.repeats as u64 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_every_repeat_of_every_batch_once_and_many_batches_take_long_turns() {
        for (cells, repeats) in [(2, 3), (20, 150), (20, 64), (20, 1)] {
            let study = Study::new(Spec { repeats, ..spec(cells) }).expect("possible");
            let of = study.progress().of;
            let pieces: Vec<(usize, u64)> = (0..of).map(|piece| study.piece(piece)).collect();
            let turns = 1 + pieces.windows(2).filter(|pair| pair[0].0 != pair[1].0).count();
            assert!(
                study.batches().len() <= KEPT || turns <= of as usize / repeats.min(22),
                "{cells} {repeats}: {turns}"
            );
            let mut all = pieces;
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len() as u64, of);
            assert!(all.iter().all(|&(batch, repeat)| batch < study.batches().len() && repeat < repeats as u64));
        }
    }

    fn spec(cells: u32) -> Spec {
        let cells = (1..=cells).map(|seed| vec![format!("seed={seed}")]).collect();
        Spec { scenario: Scenario::default(), repeats: MAX_REPEATS, late: 1.0, cells, xi2: None, xi1: None }
    }

    #[test]
    fn what_is_not_begun_has_no_counts() {
        let mut study = Study::new(spec(50)).expect("possible");
        assert!(study.batches().iter().all(|batch| batch.tally.counts.is_empty()));
        assert_eq!(study.point(0, Rule::Fcd, 3).false_alarms.rate.of, 0);
        study.step();
        let begun = study.batches().iter().filter(|batch| !batch.tally.counts.is_empty());
        assert_eq!(begun.count(), 1);
        // More pieces than 32 bits count.
        let of = 2 * 500 * MAX_REPEATS as u64;
        let many = Study::new(spec(500)).expect("possible");
        assert_eq!((many.progress().of, many.piece(of - 1)), (of, (999, MAX_REPEATS as u64 - 1)));
    }

    #[test]
    fn more_thresholds_than_can_be_counted_are_refused() {
        let xi2 = Some((0..10_000).map(|k| f64::from(k) * 1e-6).collect());
        let refusal = Study::new(Spec { xi2, ..spec(400) }).expect_err("too many").to_string();
        assert!(refusal.contains("cells = 400") && refusal.contains("20000000 thresholds"), "{refusal}");
    }
}
