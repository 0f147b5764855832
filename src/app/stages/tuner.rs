//! The study behind the tuning view: kept up with the scenario, made by a helper elsewhere or a few runs a frame.

use crate::app::helper::{Asking, Helper, Turn};
use centrode_core::detect::Method;
use centrode_core::scenario::overrides::whole;
use centrode_core::scenario::{Override, Place, Scenario, ScenarioError, Threshold, Thresholds};
use centrode_core::study::remote::{Found, Work};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Point, Spec, Study};
use centrode_core::study::{Job, Progress};
use serde_json::{Value, json};

/// An alarm later than this after contact counts as missed, s.
pub const LATE: f64 = 1.0;
/// Filter lengths that are compared, besides the one that is set.
const LENGTHS: [u64; 10] = [50, 100, 150, 200, 300, 400, 500, 600, 800, 1000];
/// The most disks whose detection times are compared.
const DISKS: usize = 6;
/// Runs, each about three milliseconds on the page, that are made in a frame when there is no helper: so many at
/// least and at most, and between them a seventh of the time that a frame takes anyway.
const PIECES: [usize; 2] = [2, 16];
const PIECES_PER_SECOND: f32 = 50.0;
/// A study stays on view until the next one has repeated its own cell so often.
const ENOUGH: u64 = 20;

/// What the study compares, by cell.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cells {
    /// Filter lengths, rising.
    pub lengths: Vec<(u64, usize)>,
    /// Contacts by name: the one that is set, or each disk.
    pub contacts: Vec<(String, usize)>,
}

/// The study and who makes it.
#[derive(Debug)]
pub struct Tuner {
    asking: Asking,
    /// What it was made for; none while nobody looks.
    inputs: Option<(Scenario, usize)>,
    study: Option<(Study, Cells)>,
    /// What is shown of a rule of which the study has hardly begun.
    before: Option<(Study, Cells)>,
    version: u64,
    refused: Option<ScenarioError>,
    /// The thresholds that are set, which may be on their way while the study is one of those before.
    thresholds: Thresholds,
    /// Studies begun.
    begun: u64,
}

impl Tuner {
    /// A tuner with nothing to do.
    #[must_use]
    pub fn new(helper: Option<Box<dyn Helper>>) -> Self {
        Self {
            asking: Asking::new(helper),
            inputs: None,
            study: None,
            before: None,
            version: 0,
            refused: None,
            thresholds: Thresholds::default(),
            begun: 0,
        }
    }

    /// Keeps the study up with what is set; with no scenario, nobody looks and nothing is made.
    ///
    /// The study judges every run by a whole row of thresholds: moving one costs no run of the rules whose own it is. Those that
    /// hold it beside another, either and both, are counted anew once it is no longer on its way (`moving`).
    pub fn update(&mut self, scenario: Option<&Scenario>, repeats: usize, moving: bool) {
        let Some(scenario) = scenario else {
            if self.inputs.take().is_some() {
                self.refused = None;
                self.asking.rest();
            }
            return;
        };
        if self.thresholds != scenario.detection {
            self.thresholds = scenario.detection.clone();
            self.version += 1;
        }
        let mut scenario = scenario.clone();
        // A study counts first alarms: what ends an event does not matter to it.
        let Thresholds { release, hold, .. } = Thresholds::default();
        scenario.detection = Thresholds { xi2: Threshold::OFF, release, hold, ..scenario.detection };
        if let Some((was, count)) = &self.inputs
            && *count == repeats
            && (*was == scenario || moving && differ_in_thresholds(was, &scenario))
        {
            return;
        }
        // Whoever comes back finds a study held as it was left; a new one begins.
        let back = self.inputs.replace((scenario.clone(), repeats)).is_none();
        self.asking.hold(self.asking.is_held() && back);
        let old = self.study.take();
        let made = spec(&scenario, repeats).and_then(|(spec, cells)| Ok((Study::new(spec)?, cells)));
        match made {
            Ok((mut study, cells)) => {
                for (known, _) in old.iter().chain(&self.before) {
                    study.adopt(known);
                }
                if Rule::ALL.iter().any(|&rule| is_young(&study, rule)) {
                    self.before = self.before.take().or(old);
                } else {
                    self.before = None;
                }
                self.study = Some((study, cells));
                self.refused = None;
            }
            Err(refused) => {
                self.before = None;
                self.refused = Some(refused);
            }
        }
        self.begun += 1;
        self.version += 1;
        self.asking.rest();
    }

    /// Stops, or goes on.
    pub fn hold(&mut self, held: bool) {
        self.asking.hold(held);
    }

    /// Takes what has come and asks for what is missing, or makes a few runs; `frame` is how long frames take, s.
    /// Returns whether the next one should come at once for it.
    pub fn work(&mut self, frame: f32) -> bool {
        let Some((study, _)) = self.study.as_mut().filter(|_| self.inputs.is_some()) else { return false };
        let before = study.progress();
        let taken = self.asking.take(|found| match found {
            Found::Thresholds(tallies) => tallies.into_iter().all(|(batch, tally)| study.set(batch as usize, tally)),
            _ => true,
        });
        let turn = taken.and_then(|()| {
            let work = || Work::Thresholds { spec: study.spec().clone(), batches: study.missing() };
            self.asking.ask(study.progress(), work)
        });
        if turn == Ok(Turn::Make) {
            let pieces = ((frame * PIECES_PER_SECOND) as usize).clamp(PIECES[0], PIECES[1]);
            (0..pieces).for_each(|_| study.step());
        }
        let progress = study.progress();
        if progress != before {
            self.version += 1;
            if !Rule::ALL.iter().any(|&rule| is_young(study, rule)) {
                self.before = None;
            }
        }
        match turn {
            Ok(turn) => turn == Turn::Make && !progress.is_complete(),
            Err(why) => {
                self.asking.give_up(why);
                self.version += 1;
                !self.asking.is_held() && !progress.is_complete()
            }
        }
    }

    /// What there is to see of a rule, what its cells are, and a number that changes with both.
    #[must_use]
    pub fn shown(&self, rule: Rule) -> Option<(&Study, &Cells, u64)> {
        let young = self.study.as_ref().is_none_or(|(study, _)| is_young(study, rule));
        let before = self.before.as_ref().filter(|_| young);
        before.or(self.study.as_ref()).map(|(study, cells)| (study, cells, self.version))
    }

    /// What all thresholds of a rule come to; empty where there is nothing to see.
    #[must_use]
    pub fn curve(&self, rule: Rule) -> Vec<Point> {
        self.shown(rule).map_or_else(Vec::new, |(study, ..)| study.curve(0, rule))
    }

    /// Studies begun so far.
    #[must_use]
    pub fn begun(&self) -> u64 {
        self.begun
    }

    /// How far the study is; none when nothing is left, nobody looks or it is held.
    #[must_use]
    pub fn progress(&self) -> Option<Progress> {
        self.left().filter(|_| !self.asking.is_held())
    }

    /// How far the study is; none when nothing is left or nobody looks.
    #[must_use]
    pub fn left(&self) -> Option<Progress> {
        let (study, _) = self.study.as_ref().filter(|_| self.inputs.is_some())?;
        Some(study.progress()).filter(|progress| !progress.is_complete())
    }

    /// Whether it was stopped.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.asking.is_held()
    }

    /// Whether a helper makes it.
    #[must_use]
    pub fn has_helper(&self) -> bool {
        self.asking.has_helper()
    }

    /// Why there is nothing to see.
    #[must_use]
    pub fn refused(&self) -> Option<&ScenarioError> {
        self.refused.as_ref()
    }

    /// Why the helper was given up, if it was.
    #[must_use]
    pub fn trouble(&self) -> Option<&str> {
        self.asking.trouble()
    }

    /// The threshold of a rule that is set, m, N·m, or k; none while it is switched off.
    #[must_use]
    pub fn setting(&self, rule: Rule) -> Option<f64> {
        let (study, ..) = self.shown(rule)?;
        let counted = &study.spec().scenario.detection;
        // A study of before ξ1 changed its kind has levels of the other kind.
        let alike = self.thresholds.xi1_rule == counted.xi1_rule || rule.swept() != Method::Jfd;
        rule.swept().setting(if alike { &self.thresholds } else { counted })
    }

    /// The level whose counts stand for the threshold that is set: the nearest one.
    #[must_use]
    pub fn level(&self, rule: Rule) -> Option<usize> {
        let (study, ..) = self.shown(rule)?;
        let (setting, levels) = (self.setting(rule)?, study.levels(0, rule));
        let away = |level: &usize| (levels[*level] - setting).abs();
        (0..levels.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// What the thresholds that are set come to; between two levels, what the nearest comes to.
    #[must_use]
    pub fn own(&self, rule: Rule) -> Option<Point> {
        let (study, ..) = self.shown(rule)?;
        Some(study.point(0, rule, self.level(rule)?))
    }

    /// The thresholds with which what is shown of a rule was counted, where it looks at others beside its own: those of the
    /// scenario then.
    #[must_use]
    pub fn counted_with(&self, rule: Rule) -> Option<&Thresholds> {
        let (study, ..) = self.shown(rule).filter(|_| !rule.fixed().is_empty())?;
        Some(&study.spec().scenario.detection)
    }

    /// The thresholds that are set.
    #[must_use]
    pub fn thresholds(&self) -> &Thresholds {
        &self.thresholds
    }

    /// The same as JSON for whoever reads the page without eyes, with the progress in runs.
    #[must_use]
    pub fn report(&self, rule: Rule) -> Option<Value> {
        let (study, _) = self.study.as_ref()?;
        let progress = study.progress();
        Some(json!({
            "done": progress.done,
            "of": progress.of,
            "method": rule.name(),
            "helper": self.has_helper(),
            "held": self.asking.is_held(),
            "begun": self.begun,
            "own": self.own(rule),
        }))
    }
}

/// Whether too little is known yet of a rule in the cell that is set.
fn is_young(study: &Study, rule: Rule) -> bool {
    let (free, held) = study.runs(0, rule);
    held.unwrap_or(free).min(free) < ENOUGH.min(study.spec().repeats as u64)
}

/// Whether two scenarios differ in the values of thresholds alone.
fn differ_in_thresholds(one: &Scenario, other: &Scenario) -> bool {
    let mut moved = one.clone();
    (moved.detection.xi1, moved.detection.xi1_factor) = (other.detection.xi1, other.detection.xi1_factor);
    moved == *other
}

/// The study of a scenario: as it is set, with other filter lengths, and with contact at each disk.
fn spec(scenario: &Scenario, repeats: usize) -> Result<(Spec, Cells), ScenarioError> {
    let samples = scenario.motion.end * scenario.loop_rate;
    let own = scenario.filter.length;
    let mut lengths: Vec<u64> = LENGTHS.into_iter().filter(|&length| length as f64 <= samples).collect();
    if let Err(place) = lengths.binary_search(&own) {
        lengths.insert(place, own);
    }
    let mut set: Vec<Vec<Override>> = vec![Vec::new()];
    let mut cells = Cells::default();
    let disks = scenario.robot.disks.len();
    match scenario.contact.place {
        Place::Nowhere => {}
        Place::Disk(_) if disks <= DISKS => {
            for disk in 1..=disks {
                cells.contacts.push((format!("Disk {disk}"), set.len()));
                set.push(vec![whole("contact.disk", disk as u64)?]);
            }
        }
        Place::Disk(disk) => cells.contacts.push((format!("Disk {disk}"), 0)),
        Place::ArcLength(s) => cells.contacts.push((format!("{:.1} mm", s * 1e3), 0)),
    }
    for length in lengths {
        cells.lengths.push((length, set.len()));
        set.push(vec![whole("filter.length", length)?]);
    }
    Ok((Spec { late: LATE, cells: set, own: false, ..Spec::of(scenario.clone(), repeats) }, cells))
}

#[cfg(test)]
mod tests;
