//! The paper's Table II, as printed and as the simulated experiment gives it with two kinds of contact.
//!
//! Three disks are met one after the other and each experiment is repeated. The table says when the contact was
//! detected, at which θL, and where along the backbone it was placed.

pub mod chart;
pub mod export;
pub mod ours;

use super::seed::repeat_seed;
use super::{Job, Progress};
use crate::detect::alarm::Alarms;
use crate::detect::evidence::Observer;
use crate::detect::{Detection, Method, Settings};
use crate::record::Script;
use crate::run::kept;
use crate::scenario::keys::{Allowed, Quantity, Value};
use crate::scenario::preset::find;
use crate::scenario::{Contact, ContactKind, Detectors, Plan, Refused, Scenario, ScenarioError};
use libm::sqrt;
use ours::{OurRow, Ours};
use serde::Serialize;

/// The presets whose contact stands for disk 1, 2 and 3.
pub const PRESETS: [&str; 3] = ["disk-1", "bench", "disk-3"];
/// Repeats of the paper's experiment on each disk.
pub const PAPER_REPEATS: usize = 5;
/// The most repeats of one experiment.
pub const MAX_REPEATS: usize = 100_000;

/// How one experiment ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Detected at or after contact.
    Found,
    /// Detected before contact, or without one.
    FalseAlarm,
    /// Not detected.
    Missed,
}

/// One experiment: a row of the paper's table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Row {
    /// The disk in contact, counted from 1 at the base.
    pub disk: u64,
    /// How it ended.
    pub outcome: Outcome,
    /// Time of the first crossing of ξ2, s; NaN without one.
    pub detection_time: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// Estimated arc length of the contact, m.
    pub location: f64,
}

/// Mean and scatter of a quantity over the experiments in which contact was found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The mean; NaN over none.
    pub mean: f64,
    /// The sample standard deviation (n − 1); NaN below two.
    pub deviation: f64,
}

impl Spread {
    /// Of values, which may be looked at twice.
    #[must_use]
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let (count, sum) = values.clone().fold((0.0, 0.0), |(count, sum), x| (count + 1.0, sum + x));
        let mean = if count > 0.0 { sum / count } else { f64::NAN };
        let squares = values.fold(0.0, |sum, x| sum + (x - mean) * (x - mean));
        Self { mean, deviation: if count > 1.0 { sqrt(squares / (count - 1.0)) } else { f64::NAN } }
    }
}

/// What the experiments on one disk come to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Disk {
    /// The disk in contact, counted from 1 at the base.
    pub disk: u64,
    /// Met: arc length s_c of the disk, m.
    pub arc_length: f64,
    /// Met: when contact began, s. NaN when it never did, and for the paper, which does not say.
    pub contact_time: f64,
    /// Experiments made.
    pub repeats: usize,
    /// In how many contact was found.
    pub found: usize,
    /// In how many the alarm came before contact; `None` for the paper, which does not say.
    pub false_alarms: Option<usize>,
    /// Time of detection, s.
    pub detection_time: Spread,
    /// Time from contact to detection, s.
    pub delay: Spread,
    /// θL at detection, rad.
    pub theta_l: Spread,
    /// Estimated location of the contact, m.
    pub location: Spread,
    /// Mean estimate less the truth, m.
    pub bias: f64,
}

impl Disk {
    fn new(truth: Met, rows: &[Row], false_alarms: Option<usize>) -> Self {
        let rows = rows.iter().filter(move |row| row.disk == truth.disk);
        let found = rows.clone().filter(|row| row.outcome == Outcome::Found);
        let location = Spread::of(found.clone().map(|row| row.location));
        Self {
            disk: truth.disk,
            arc_length: truth.arc_length,
            contact_time: truth.contact_time,
            repeats: rows.count(),
            found: found.clone().count(),
            false_alarms,
            detection_time: Spread::of(found.clone().map(|row| row.detection_time)),
            delay: Spread::of(found.clone().map(|row| row.detection_time - truth.contact_time)),
            theta_l: Spread::of(found.map(|row| row.theta_l)),
            bias: location.mean - truth.arc_length,
            location,
        }
    }
}

/// Table II three times, disk by disk.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Table2 {
    /// From the rows that the paper prints.
    pub paper: [Disk; 3],
    /// From the experiments made so far with the scenario's kind of contact.
    pub simulated: [Disk; 3],
    /// What that kind is.
    pub kind: ContactKind,
    /// From the same experiments with the other kind.
    pub other: [Disk; 3],
    /// What the other kind is: a flat beam that only touches, or a clamp where the scenario's own is flat.
    pub other_kind: ContactKind,
    /// From the experiments with the scenario's kind of contact, with `cusum` and the posterior of the place in place of the
    /// paper's method; none where the threshold of `cusum` is off.
    pub ours: Option<[Ours; 3]>,
}

#[derive(Debug, Clone, Copy)]
struct Met {
    disk: u64,
    arc_length: f64,
    contact_time: f64,
}

/// The fifteen rows that the paper prints.
///
/// It does not say when contact began: every row counts as found.
#[must_use]
pub fn paper_rows() -> Vec<Row> {
    numbers(include_str!("../../assets/table2.csv"))
        .map(|[disk, detection_time, theta_l, location]| Row {
            disk: disk as u64,
            outcome: Outcome::Found,
            detection_time,
            theta_l,
            location,
        })
        .collect()
}

/// Per disk, from 1: arc length (m) and the standard deviation of the location (m) as the paper prints them.
#[must_use]
pub fn paper_disks() -> [[f64; 2]; 3] {
    let mut disks = [[f64::NAN; 2]; 3];
    for (disk, [_, arc_length, deviation]) in
        disks.iter_mut().zip(numbers(include_str!("../../assets/table2-disks.csv")))
    {
        *disk = [arc_length, deviation];
    }
    disks
}

/// What the paper's rows come to.
#[must_use]
pub fn paper() -> [Disk; 3] {
    let (rows, disks) = (paper_rows(), paper_disks());
    std::array::from_fn(|k| {
        let truth = Met { disk: k as u64 + 1, arc_length: disks[k][0], contact_time: f64::NAN };
        Disk::new(truth, &rows, None)
    })
}

/// The lines of a shipped file below its header, as numbers; a test reads them all.
fn numbers<const N: usize>(text: &str) -> impl Iterator<Item = [f64; N]> {
    text.lines().skip(1).map(|line| {
        let mut values = [f64::NAN; N];
        for (value, field) in values.iter_mut().zip(line.split(',')) {
            *value = field.trim().parse().unwrap_or(f64::NAN);
        }
        values
    })
}

/// The simulated Table II; a step is one experiment with either kind of contact, and the disks take turns.
#[derive(Debug, Clone)]
pub struct Table2Job {
    own: Experiments,
    other: Option<Experiments>,
    repeats: usize,
}

/// The experiments with one kind of contact.
#[derive(Debug, Clone)]
struct Experiments {
    kind: ContactKind,
    plans: [(Met, Plan, Script); 3],
    rows: Vec<Row>,
    /// The same by the calibration filter; none where it does not watch.
    ours: Option<Vec<OurRow>>,
}

impl Experiments {
    fn new(base: &Scenario, kind: ContactKind, watch: bool) -> Result<Self, ScenarioError> {
        let mut plans = Vec::with_capacity(PRESETS.len());
        for (k, name) in PRESETS.into_iter().enumerate() {
            let Contact { place, start, .. } = find(name)?.scenario()?.contact;
            let contact = Contact { place, start, kind, ..base.contact };
            let plan = kept(Plan::new(&Scenario { contact, ..base.clone() })?)?;
            let script = Script::new(&plan);
            let truth = Met {
                disk: k as u64 + 1,
                arc_length: base.robot.disks[k],
                contact_time: script.contact_time().unwrap_or(f64::NAN),
            };
            plans.push((truth, plan, script));
        }
        let plans = plans.try_into().expect("one for each preset");
        Ok(Self { kind, plans, rows: Vec::new(), ours: watch.then(Vec::new) })
    }

    fn step(&mut self) {
        let (truth, plan, script) = &self.plans[self.rows.len() % PRESETS.len()];
        let seed = repeat_seed(plan.scenario().seed, (self.rows.len() / PRESETS.len()) as u64);
        let plan = plan.with_seed(seed);
        let watch = self.ours.is_some();
        let (row, ours) = if plan.is_drawn() {
            // Each repeat is of another robot.
            let script = Script::new(&plan);
            let contact_time = script.contact_time().unwrap_or(f64::NAN);
            experiment(&plan, &script, &Met { contact_time, ..*truth }, watch)
        } else {
            experiment(&plan, script, truth, watch)
        };
        self.rows.push(row);
        if let (Some(all), Some(ours)) = (&mut self.ours, ours) {
            all.push(ours);
        }
    }

    /// The same disks without an experiment.
    fn none(&self) -> [Disk; 3] {
        self.plans.each_ref().map(|(truth, ..)| Disk::new(Met { contact_time: f64::NAN, ..*truth }, &[], Some(0)))
    }

    fn disks(&self) -> [Disk; 3] {
        self.plans.each_ref().map(|(truth, ..)| {
            let alarms = self.rows.iter().filter(|row| row.disk == truth.disk && row.outcome == Outcome::FalseAlarm);
            Disk::new(*truth, &self.rows, Some(alarms.count()))
        })
    }
}

impl Table2Job {
    /// The experiment of `base` on disks 1, 2 and 3, each `repeats` times, with its own kind of contact and with another.
    ///
    /// Everything is as in `base` but for the contact: its place and time are those of the presets `disk-1`, `bench`
    /// and `disk-3`. With `bench` as base, the first experiments are these presets themselves. Later ones have the
    /// seeds of [`repeat_seed`].
    ///
    /// # Errors
    /// When the scenario is impossible, has fewer than three disks, or the repeats are not from 1 to [`MAX_REPEATS`].
    pub fn new(base: &Scenario, repeats: usize) -> Result<Self, ScenarioError> {
        if !(1..=MAX_REPEATS).contains(&repeats) {
            let allowed = Allowed::Whole(1, MAX_REPEATS as u64);
            return Err(Refused::error("repeats", Quantity::Count, Value::Whole(repeats as u64), allowed));
        }
        Plan::new(base)?;
        let count = base.robot.disks.len();
        if count < PRESETS.len() {
            let allowed = Allowed::Need("at least three disks are needed, because Table II compares disks 1, 2 and 3");
            let disks = Value::List(base.robot.disks.clone());
            return Err(Refused::error("robot.disks", Quantity::Length, disks, allowed));
        }
        let kind = base.contact.kind;
        let own = Experiments::new(base, kind, base.detection.cusum.value().is_some())?;
        // What a clamp holds a flat beam cannot always touch: then nothing is simulated with the other kind.
        let other = Experiments::new(base, kind.other(), false).ok();
        Ok(Self { own, other, repeats })
    }

    /// The experiments made so far with the scenario's kind of contact: disks 1, 2, 3 of the first repeat, then of the second,
    /// and so on.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.own.rows
    }

    /// The same by the calibration filter; none where the threshold of `cusum` is off.
    #[must_use]
    pub fn our_rows(&self) -> Option<&[OurRow]> {
        self.own.ours.as_deref()
    }

    /// The same with the other kind.
    #[must_use]
    pub fn other_rows(&self) -> &[Row] {
        self.other.as_ref().map_or(&[], |other| &other.rows)
    }

    /// All tables, from the experiments made so far.
    #[must_use]
    pub fn table(&self) -> Table2 {
        Table2 {
            paper: paper(),
            simulated: self.own.disks(),
            kind: self.own.kind,
            other: self.other.as_ref().map_or_else(|| self.own.none(), Experiments::disks),
            other_kind: self.own.kind.other(),
            ours: self
                .own
                .ours
                .as_ref()
                .map(|rows| self.own.plans.each_ref().map(|(truth, ..)| Ours::new(*truth, rows))),
        }
    }
}

impl Job for Table2Job {
    fn step(&mut self) {
        if self.progress().is_complete() {
            return;
        }
        self.own.step();
        if let Some(other) = &mut self.other {
            other.step();
        }
    }

    fn progress(&self) -> Progress {
        Progress { done: self.own.rows.len() as u64, of: self.repeats as u64 * PRESETS.len() as u64 }
    }
}

/// One run, up to its detection; `watch` where the calibration filter looks at it too, until that has placed the contact.
fn experiment(plan: &Plan, script: &Script, truth: &Met, watch: bool) -> (Row, Option<OurRow>) {
    let mut settings = Settings::of(plan);
    let detectors = &mut settings.thresholds.detectors;
    let paper = detectors.has(Method::Fcd);
    *detectors = Detectors::NONE;
    detectors.set(Method::Fcd, paper);
    detectors.set(Method::Cusum, watch);
    let monitor = settings.monitor_before(plan, script.entries(plan));
    let (mut observer, mut alarms) = (Observer::new(&settings, monitor), Alarms::new(&settings));
    let (mut detection, mut end) = (None, f64::NAN);
    for entry in script.entries(plan) {
        let evidence = observer.observe(&entry);
        alarms.look(entry.time, &entry.configuration, &evidence.judgement);
        detection = detection.or_else(|| Detection::first(alarms.events()));
        end = entry.time;
        if detection.is_some() && (!watch || ours::is_over(&alarms, end)) {
            break;
        }
    }
    let ours = watch.then(|| ours::row(&settings, &observer, &alarms, end, truth));
    let outcome = ours::outcome(detection.map(|detection| detection.time), truth.contact_time);
    let found = |of: fn(&Detection) -> f64| detection.as_ref().map_or(f64::NAN, of);
    let row = Row {
        disk: truth.disk,
        outcome,
        detection_time: found(|detection| detection.time),
        theta_l: found(|detection| detection.theta_l),
        location: found(|detection| detection.location),
    };
    (row, ours)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_deviations_follow_from_the_printed_rows() {
        let disks = paper_disks();
        // As many digits as the paper prints.
        for ((disk, printed), digits) in
            paper().iter().zip(disks.map(|[_, deviation]| deviation)).zip([1e-4, 1e-8, 1e-4])
        {
            let error = (disk.location.deviation - printed).abs();
            assert!(error <= 0.5 * digits, "disk {}: {} for {printed}", disk.disk, disk.location.deviation);
        }
    }

    #[test]
    fn every_field_of_the_shipped_files_is_a_number() {
        let rows = paper_rows();
        assert_eq!(rows.len(), 3 * PAPER_REPEATS);
        for (k, row) in rows.iter().enumerate() {
            assert_eq!(row.disk as usize, k / PAPER_REPEATS + 1);
            assert!((5.0..8.0).contains(&row.detection_time) && (0.0..1.6).contains(&row.theta_l), "{row:?}");
            assert!((0.0..0.03).contains(&row.location), "{row:?}");
        }
        assert_eq!(paper_disks().map(|[s, _]| s), [0.0075, 0.015, 0.0225]);
    }

    #[test]
    fn a_statistic_over_few_is_not_defined() {
        let none = Spread::of(std::iter::empty());
        let one = Spread::of([3.0].into_iter());
        assert!(none.mean.is_nan() && none.deviation.is_nan() && one.deviation.is_nan());
        let two = Spread::of([1.0, 3.0].into_iter());
        assert_eq!((one.mean, two.mean, two.deviation), (3.0, 2.0, sqrt(2.0)));
    }
}
