//! Threshold tuning: repeats of a scenario with and without contact, and what every threshold of every rule would
//! have made of them.
//!
//! A run is made once and judged by all thresholds in that one pass. Repeat `k` has the seed of
//! [`repeat_seed`]; what repeats come to is counted in whole numbers. So a study is the same to the bit whoever runs
//! its pieces, in whichever order. Reading order: `sweep` (what is compared), `levels` (which thresholds), `sight` and `watch`
//! (first alarms of one run), `batch`, `tally` and `rate` (what they come to), `recommend` (which threshold to take).

pub mod batch;
pub mod chart;
pub mod levels;
mod pieces;
pub mod rate;
pub mod recommend;
mod sight;
pub mod sweep;
pub mod tally;
pub mod watch;

use super::seed::repeat_seed;
use super::shared::Kept;
use super::{Job, Progress};
use crate::run::kept;
use crate::scenario::keys::allowed::NOT_NEGATIVE;
use crate::scenario::keys::{Allowed, Quantity, Value};
use crate::scenario::{Override, Place, Plan, Refused, Scenario, ScenarioError};
use batch::Batch;
use levels::Levels;
use serde::{Deserialize, Serialize};
use tally::{Clock, FalseAlarms, Found, Tally, detection, false_alarms};
use watch::{Firsts, Rule, first_alarms, of_any_rule};

/// The most repeats of one scenario.
pub const MAX_REPEATS: usize = 10_000_000;

/// The most thresholds that one study counts, over all its scenarios and rules: up to 1 GB of counts.
pub const MAX_COUNTS: usize = 20_000_000;

/// What is to be studied.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spec {
    /// The scenario on which every cell builds.
    pub scenario: Scenario,
    /// Repeats of each cell, with contact and without.
    pub repeats: usize,
    /// An alarm later than this after contact counts as missed, s.
    pub late: f64,
    /// The cells, each a list of what it changes.
    pub cells: Vec<Vec<Override>>,
    /// Thresholds in place of the usual ones.
    pub levels: Levels,
    /// Whether each cell's own thresholds are counted beside them. Without, moving one changes no level.
    pub own: bool,
}

impl Spec {
    /// A scenario as it is, with the usual thresholds and its own; an alarm is late after 1 s.
    #[must_use]
    pub fn of(scenario: Scenario, repeats: usize) -> Self {
        Self { scenario, repeats, late: 1.0, cells: vec![Vec::new()], levels: Levels::default(), own: true }
    }
}

/// One combination of settings.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Cell {
    /// What it changes.
    pub set: Vec<Override>,
    /// The scenario that they make.
    pub scenario: Scenario,
    /// Place of its runs without contact among the batches.
    pub free: usize,
    /// Place of its runs with contact; none when the scenario has no contact.
    pub held: Option<usize>,
}

/// What one threshold comes to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Point {
    /// ξ2 (m) or ξ1 (N·m, or k).
    pub threshold: f64,
    /// In runs without contact.
    pub false_alarms: FalseAlarms,
    /// In runs with contact; none when the scenario has no contact.
    pub detection: Option<Found>,
}

/// A study, as far as it has come.
///
/// ```
/// use centrode_core::scenario::preset::find;
/// use centrode_core::study::Job;
/// use centrode_core::study::tuning::watch::Rule;
/// use centrode_core::study::tuning::{Spec, Study};
///
/// let spec = Spec { cells: vec![vec!["filter.length=300".parse()?]], ..Spec::of(find("bench")?.scenario()?, 4) };
/// let mut study = Study::new(spec)?;
/// study.step();
/// assert_eq!((study.progress().done, study.progress().of), (1, 8));
/// study.finish();
/// let own = study.own(0, Rule::Fcd).expect("ξ2 is on");
/// let point = study.point(0, Rule::Fcd, own);
/// assert_eq!((point.threshold, point.false_alarms.rate.of), (0.007, 4));
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    spec: Spec,
    batches: Vec<Batch>,
    cells: Vec<Cell>,
    shared: Kept,
    /// Thresholds to count, over all batches and rules.
    counts: usize,
}

impl Study {
    /// A study of which nothing is done.
    ///
    /// # Errors
    /// [`ScenarioError::Value`] when a cell's scenario is impossible or its run too long to keep, `repeats` or `late` is, or
    /// `cells` have more thresholds together than [`MAX_COUNTS`].
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
            let mut scenario = study.spec.scenario.clone();
            set.iter().for_each(|set| set.apply(&mut scenario));
            let plan = kept(Plan::new(&scenario)?)?;
            let mut levels = Levels::usual(&scenario).replaced(&study.spec.levels);
            if study.spec.own {
                levels = levels.with_own(&scenario.detection);
            }
            let free = study.batch(plan.without_contact(), &levels)?;
            let held = match scenario.contact.place {
                Place::Nowhere => None,
                _ => Some(study.batch(plan, &levels)?),
            };
            study.cells.push(Cell { set, scenario, free, held });
        }
        Ok(study)
    }

    /// The place of a batch, which cells share where they differ in nothing that matters to it.
    fn batch(&mut self, plan: Plan, levels: &Levels) -> Result<usize, ScenarioError> {
        let plan = plan.with_thresholds(of_any_rule(&plan.scenario().detection));
        let same = |batch: &Batch| batch.plan == plan && batch.levels == *levels;
        if let Some(place) = self.batches.iter().position(same) {
            return Ok(place);
        }
        self.counts += Rule::ALL.iter().map(|rule| rule.levels(levels).len()).sum::<usize>();
        if self.counts > MAX_COUNTS {
            let cells = Value::Whole(self.spec.cells.len() as u64);
            return Err(Refused::error("cells", Quantity::Count, cells, Allowed::Thresholds(MAX_COUNTS)));
        }
        let scenario = plan.scenario();
        let late = libm::floor(self.spec.late * scenario.loop_rate * (1.0 + 4.0 * f64::EPSILON));
        let clock = Clock {
            rate: scenario.loop_rate,
            armed: first_sample(&plan, scenario.detection.armed_from) as u32,
            samples: plan.samples() as u32,
            late: late as u32,
        };
        self.batches.push(Batch::new(plan, levels.clone(), clock));
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
        batch.add(firsts);
    }

    /// Takes over what another study has counted where both would count the same: rule by rule, for a threshold that has moved
    /// matters to some rules and not to others.
    pub fn adopt(&mut self, other: &Self) {
        let most = self.spec.repeats as u64;
        for batch in &mut self.batches {
            for known in other.batches.iter().filter(|known| known.tally.runs <= most) {
                batch.adopt(known);
            }
        }
    }

    /// Takes over the tally of one batch that was counted elsewhere, unless it says less. Returns whether it fits: one of
    /// another batch or of other thresholds, or that no runs can have come to, is left.
    pub fn set(&mut self, batch: usize, tally: Tally) -> bool {
        let Some(batch) = self.batches.get_mut(batch) else { return false };
        tally.runs <= self.spec.repeats as u64 && batch.set(tally)
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

    /// The thresholds of a rule in a cell.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn levels(&self, cell: usize, rule: Rule) -> &[f64] {
        rule.levels(&self.batches[self.cells[cell].free].levels)
    }

    /// What a threshold comes to in a cell.
    ///
    /// # Panics
    /// When there is no such cell or level.
    #[must_use]
    pub fn point(&self, cell: usize, rule: Rule, level: usize) -> Point {
        let Cell { free, held, .. } = self.cells[cell];
        let free = &self.batches[free];
        Point {
            threshold: rule.levels(&free.levels)[level],
            false_alarms: false_alarms(free.counted(rule, level), &free.clock),
            detection: held.map(|held| {
                let held = &self.batches[held];
                detection(held.counted(rule, level), &held.clock)
            }),
        }
    }

    /// What all thresholds of a rule come to in a cell, rising.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn curve(&self, cell: usize, rule: Rule) -> Vec<Point> {
        (0..self.levels(cell, rule).len()).map(|level| self.point(cell, rule, level)).collect()
    }

    /// The level of the cell's own setting; none while it is switched off.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn own(&self, cell: usize, rule: Rule) -> Option<usize> {
        let setting = rule.swept().setting(&self.cells[cell].scenario.detection);
        self.levels(cell, rule).iter().position(|&level| Some(level) == setting)
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

    /// Runs that are counted of a rule in a cell: without contact, and with.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn runs(&self, cell: usize, rule: Rule) -> (u64, Option<u64>) {
        let Cell { free, held, .. } = self.cells[cell];
        (self.batches[free].runs(rule), held.map(|held| self.batches[held].runs(rule)))
    }

    /// Truth: when contact begins in a cell, s; none without. Its first run says so; asked before, it is found out.
    ///
    /// # Panics
    /// When there is no such cell.
    #[must_use]
    pub fn contact_time(&self, cell: usize) -> Option<f64> {
        let Batch { plan, tally, .. } = &self.batches[self.cells[cell].held?];
        match (tally.contact, tally.runs) {
            (None, 0) => self.shared.of(plan).script().contact_time(),
            (sample, _) => sample.map(|sample| plan.time(sample as usize)),
        }
    }
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
    use crate::scenario::overrides::whole;
    use crate::scenario::plan::tests::VALIDATED;
    use crate::scenario::{Threshold, preset};

    #[test]
    fn each_cell_is_validated_once() {
        let before = VALIDATED.get();
        let study = Study::new(spec(30)).expect("possible");
        assert_eq!((VALIDATED.get() - before, study.batches().len()), (30, 60));
    }

    #[test]
    fn a_threshold_that_moves_leaves_what_does_not_look_at_it() {
        let bench = preset::find("bench").and_then(|preset| preset.scenario()).expect("bench");
        let spec = |xi1: f64| {
            let mut scenario = bench.clone();
            scenario.detection.xi1 = Threshold::On(xi1);
            Spec { own: false, ..Spec::of(scenario, 6) }
        };
        let mut before = Study::new(spec(0.03)).expect("possible");
        before.finish();
        let mut after = Study::new(spec(0.0123)).expect("possible");
        after.adopt(&before);
        let runs = |study: &Study| Rule::ALL.iter().map(|&rule| study.runs(0, rule)).collect::<Vec<_>>();
        assert_eq!(runs(&after), [(6, Some(6)), (6, Some(6)), (0, Some(0)), (0, Some(0))]);
        for rule in [Rule::Fcd, Rule::Jfd] {
            let told = |study: &Study| format!("{:?}", study.point(0, rule, 40));
            assert_eq!(told(&after), told(&before));
        }
        // What is kept survives another move, and the way back finds everything again.
        let mut third = Study::new(spec(0.02)).expect("possible");
        third.adopt(&after);
        assert_eq!(runs(&third), runs(&after));
        let mut back = Study::new(spec(0.03)).expect("possible");
        back.adopt(&after);
        back.adopt(&before);
        assert_eq!(back, before);
        // Counted anew, it is the study that nothing was kept for.
        let mut fresh = Study::new(spec(0.0123)).expect("possible");
        fresh.finish();
        after.finish();
        assert_eq!(after, fresh);
        // What changes the runs leaves nothing.
        let mut noisier = spec(0.03);
        noisier.scenario.tracker.position_noise *= 2.0;
        let mut other = Study::new(noisier).expect("possible");
        other.adopt(&before);
        assert!(runs(&other).iter().all(|runs| *runs == (0, Some(0))));
    }

    #[test]
    fn contact_begins_when_the_run_says() {
        for (name, sets) in [
            ("bench", &[][..]),
            ("disk-1", &[]),
            ("letting-go", &[]),
            ("free", &[]),
            ("bench", &["motion.theta_start=0", "motion.theta_end=1.5"]),
            ("bench", &["contact.bend=1.57079632679489"]),
            ("bench", &["contact.bend=1.7"]),
            ("bench", &["contact.bend=-0.1", "motion.theta_end=2.5"]),
        ] {
            let mut draft = preset::find(name).and_then(|preset| preset.draft()).expect(name);
            sets.iter().for_each(|set| draft.set(set).expect(set));
            let scenario = draft.finish().expect(name);
            let plan = Plan::new(&scenario).expect(name);
            let mut simulation = crate::run::Simulation::new(&plan);
            simulation.by_ref().for_each(drop);
            let mut study = Study::new(Spec::of(scenario, 1)).expect(name);
            // Before the first run, and after it.
            for _ in 0..2 {
                assert_eq!(study.contact_time(0), simulation.contact_time(), "{name} {sets:?}");
                study.finish();
            }
        }
    }

    pub(super) fn spec(cells: u32) -> Spec {
        let cells = (1..=cells).map(|seed| vec![whole("seed", u64::from(seed)).expect("a key")]).collect();
        Spec { cells, ..Spec::of(Scenario::default(), MAX_REPEATS) }
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
        let mut levels = Levels::default();
        levels.put(crate::detect::Method::Fcd, (0..10_000).map(|k| f64::from(k) * 1e-6).collect());
        let refusal = Study::new(Spec { levels, ..spec(400) }).expect_err("too many").to_string();
        assert!(refusal.contains("cells = 400") && refusal.contains("20000000 thresholds"), "{refusal}");
    }
}
