//! The study behind the tuning view: kept up with the scenario, made by a helper elsewhere or a few runs a frame.

use centrode_core::scenario::{Place, Scenario, ScenarioError, Threshold, Thresholds};
use centrode_core::study::tuning::remote::{Answer, Request};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Point, Spec, Study, xi1_setting};
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

/// Somebody who makes studies elsewhere, such as a worker of the page.
pub trait Helper: std::fmt::Debug {
    /// Makes this request (JSON of [`Request`]) from now on, and nothing asked before; `None` for nothing at all.
    fn ask(&mut self, request: Option<&str>);

    /// The answers (see [`Answer`]) that have come since this was last called.
    fn take(&mut self) -> Vec<Vec<u8>>;

    /// Why it can no longer be relied on, if so. The rest is made here then.
    fn failure(&self) -> Option<String>;
}

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
    helper: Option<Box<dyn Helper>>,
    /// What it was made for; none while nobody looks.
    inputs: Option<(Scenario, usize)>,
    study: Option<(Study, Cells)>,
    /// What is shown while the study has hardly begun.
    before: Option<(Study, Cells)>,
    request: u32,
    asked: bool,
    held: bool,
    version: u64,
    refused: Option<ScenarioError>,
    /// ξ2 that is set, m. No part of the study, which judges every run by a whole row of thresholds: moving it costs no run.
    xi2: Option<f64>,
    /// Why the helper was given up.
    trouble: Option<String>,
}

impl Tuner {
    /// A tuner with nothing to do.
    #[must_use]
    pub fn new(helper: Option<Box<dyn Helper>>) -> Self {
        Self {
            helper,
            inputs: None,
            study: None,
            before: None,
            request: 0,
            asked: false,
            held: false,
            version: 0,
            refused: None,
            xi2: None,
            trouble: None,
        }
    }

    /// Keeps the study up with what is set; with no scenario, nobody looks and nothing is made.
    pub fn update(&mut self, scenario: Option<&Scenario>, repeats: usize) {
        let Some(scenario) = scenario else {
            if self.inputs.take().is_some() {
                self.refused = None;
                self.rest();
            }
            return;
        };
        self.xi2 = scenario.detection.xi2.value();
        let mut scenario = scenario.clone();
        // A study counts first alarms: what ends an event does not matter to it.
        let Thresholds { release, hold, .. } = Thresholds::default();
        scenario.detection = Thresholds { xi2: Threshold::OFF, release, hold, ..scenario.detection };
        if self.inputs.as_ref().is_some_and(|(was, count)| *was == scenario && *count == repeats) {
            return;
        }
        // Whoever comes back finds a study held as it was left; a new one begins.
        let back = self.inputs.replace((scenario.clone(), repeats)).is_none();
        self.held &= back;
        let (spec, cells) = spec(&scenario, repeats);
        let old = self.study.take();
        match Study::new(spec) {
            Ok(mut study) => {
                if let Some((old, _)) = &old {
                    study.adopt(old);
                }
                if is_young(&study) {
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
        self.version += 1;
        self.rest();
    }

    /// Ends what the helper does. What it may still answer belongs to a request of the past.
    fn rest(&mut self) {
        self.request += 1;
        if std::mem::take(&mut self.asked)
            && let Some(helper) = &mut self.helper
        {
            helper.ask(None);
        }
    }

    /// Stops, or goes on.
    pub fn hold(&mut self, held: bool) {
        self.held = held;
        if held {
            self.rest();
        }
    }

    /// Takes what has come and asks for what is missing, or makes a few runs; `frame` is how long frames take, s.
    /// Returns whether the next one should come at once for it.
    pub fn work(&mut self, frame: f32) -> bool {
        let Some((study, _)) = self.study.as_mut().filter(|_| self.inputs.is_some()) else { return false };
        let before = study.progress();
        let mut failure = None;
        if let Some(helper) = &mut self.helper {
            for answer in helper.take() {
                match Answer::from_bytes(&answer) {
                    Ok(answer) if answer.id != self.request => {}
                    Ok(answer) => {
                        let mut tallies = answer.tallies.into_iter();
                        if !tallies.all(|(batch, tally)| study.set(batch as usize, tally)) {
                            failure = Some("its answer belongs to another study".into());
                        }
                    }
                    Err(error) => failure = Some(format!("its answer cannot be read: {error}")),
                }
            }
            failure = helper.failure().or(failure);
        }
        let mut busy = false;
        if !self.held && failure.is_none() && !study.progress().is_complete() {
            match &mut self.helper {
                Some(helper) if !self.asked => {
                    self.request += 1;
                    let request = Request { id: self.request, spec: study.spec().clone(), batches: study.missing() };
                    match serde_json::to_string(&request) {
                        Ok(request) => {
                            helper.ask(Some(&request));
                            self.asked = true;
                        }
                        Err(error) => failure = Some(format!("it cannot be asked: {error}")),
                    }
                }
                Some(_) => {}
                None => {
                    let pieces = ((frame * PIECES_PER_SECOND) as usize).clamp(PIECES[0], PIECES[1]);
                    (0..pieces).for_each(|_| study.step());
                    busy = true;
                }
            }
        }
        if study.progress() != before {
            self.version += 1;
            if !is_young(study) {
                self.before = None;
            }
        }
        let left = !study.progress().is_complete();
        if let Some(failure) = failure {
            self.give_up(failure);
            return left && !self.held;
        }
        busy && left
    }

    /// Does without the helper from now on.
    fn give_up(&mut self, why: String) {
        self.rest();
        self.helper = None;
        self.trouble = Some(why);
        self.version += 1;
    }

    /// What there is to see, what its cells are, and a number that changes with both.
    #[must_use]
    pub fn shown(&self) -> Option<(&Study, &Cells, u64)> {
        self.before.as_ref().or(self.study.as_ref()).map(|(study, cells)| (study, cells, self.version))
    }

    /// How far the study is; none when nothing is left, nobody looks or it is held.
    #[must_use]
    pub fn progress(&self) -> Option<Progress> {
        self.left().filter(|_| !self.held)
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
        self.held
    }

    /// Whether a helper makes it.
    #[must_use]
    pub fn has_helper(&self) -> bool {
        self.helper.is_some()
    }

    /// Why there is nothing to see.
    #[must_use]
    pub fn refused(&self) -> Option<&ScenarioError> {
        self.refused.as_ref()
    }

    /// Why the helper was given up, if it was.
    #[must_use]
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// The threshold of a method that is set, m, N·m, or k; none while it is switched off.
    #[must_use]
    pub fn setting(&self, method: Rule) -> Option<f64> {
        let (study, _, _) = self.shown()?;
        if method == Rule::Jfd { xi1_setting(&study.cells()[0].scenario) } else { self.xi2 }
    }

    /// The level whose counts stand for the threshold that is set: the nearest one.
    #[must_use]
    pub fn level(&self, method: Rule) -> Option<usize> {
        let (study, _, _) = self.shown()?;
        let (setting, levels) = (self.setting(method)?, study.levels(0, method));
        let away = |level: &usize| (levels[*level] - setting).abs();
        (0..levels.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// What the thresholds that are set come to; between two levels, what the nearest comes to.
    #[must_use]
    pub fn own(&self, method: Rule) -> Option<Point> {
        let (study, _, _) = self.shown()?;
        Some(study.point(0, method, self.level(method)?))
    }

    /// The same as JSON for whoever reads the page without eyes, with the progress in runs.
    #[must_use]
    pub fn report(&self, method: Rule) -> Option<Value> {
        let (study, _) = self.study.as_ref()?;
        let progress = study.progress();
        Some(json!({
            "done": progress.done,
            "of": progress.of,
            "method": method.name(),
            "helper": self.has_helper(),
            "held": self.held,
            "own": self.own(method),
        }))
    }
}

/// Whether too little is known yet of the cell that is set.
fn is_young(study: &Study) -> bool {
    let (free, held) = study.repeats(0);
    held.unwrap_or(free).min(free) < ENOUGH.min(study.spec().repeats as u64)
}

/// The study of a scenario: as it is set, with other filter lengths, and with contact at each disk.
fn spec(scenario: &Scenario, repeats: usize) -> (Spec, Cells) {
    let scenario = scenario.clone();
    let samples = scenario.motion.end * scenario.loop_rate;
    let own = scenario.filter.length;
    let mut lengths: Vec<u64> = LENGTHS.into_iter().filter(|&length| length as f64 <= samples).collect();
    if let Err(place) = lengths.binary_search(&own) {
        lengths.insert(place, own);
    }
    let mut set: Vec<Vec<String>> = vec![Vec::new()];
    let mut cells = Cells::default();
    let disks = scenario.robot.disks.len();
    match scenario.contact.place {
        Place::Nowhere => {}
        Place::Disk(_) if disks <= DISKS => {
            for disk in 1..=disks {
                cells.contacts.push((format!("Disk {disk}"), set.len()));
                set.push(vec![format!("contact.disk={disk}")]);
            }
        }
        Place::Disk(disk) => cells.contacts.push((format!("Disk {disk}"), 0)),
        Place::ArcLength(s) => cells.contacts.push((format!("{:.1} mm", s * 1e3), 0)),
    }
    for length in lengths {
        cells.lengths.push((length, set.len()));
        set.push(vec![format!("filter.length={length}")]);
    }
    (Spec { scenario, repeats, late: LATE, cells: set, xi2: None, xi1: None }, cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::scenario::preset::find;
    use centrode_core::study::tuning::remote::Remote;
    use std::cell::RefCell;
    use std::rc::Rc;

    /// A worker in the same memory, and a hand on it from outside.
    #[derive(Debug, Default)]
    struct Desk {
        remote: Option<Remote>,
        asked: usize,
        broken: bool,
        babbles: bool,
    }

    #[derive(Debug, Clone, Default)]
    struct Near(Rc<RefCell<Desk>>);

    impl Helper for Near {
        fn ask(&mut self, request: Option<&str>) {
            let mut desk = self.0.borrow_mut();
            desk.asked += usize::from(request.is_some());
            desk.remote = request.map(|request| Remote::new(request).expect("a request"));
        }

        fn take(&mut self) -> Vec<Vec<u8>> {
            let mut desk = self.0.borrow_mut();
            let babbles = desk.babbles;
            let remote = desk.remote.as_mut();
            remote.map_or_else(Vec::new, |remote| {
                let _ = (0..7).filter(|_| remote.step()).count();
                vec![if babbles { vec![0xff; 9] } else { remote.answer().expect("bytes") }]
            })
        }

        fn failure(&self) -> Option<String> {
            self.0.borrow().broken.then(|| "it is gone".into())
        }
    }

    fn bench() -> Scenario {
        find("bench").and_then(|preset| preset.scenario()).expect("bench")
    }

    fn finish(tuner: &mut Tuner) -> usize {
        (1..2000)
            .find(|_| {
                tuner.work(0.0);
                tuner.progress().is_none()
            })
            .expect("an end")
    }

    #[test]
    fn a_helper_gives_what_the_frames_give() {
        let (mut alone, mut helped) = (Tuner::new(None), Tuner::new(Some(Box::<Near>::default())));
        for tuner in [&mut alone, &mut helped] {
            tuner.update(Some(&bench()), 4);
            assert!(finish(tuner) > 3);
        }
        assert_eq!(alone.shown().map(|(study, ..)| study), helped.shown().map(|(study, ..)| study));
        assert_eq!(alone.own(Rule::Fcd), helped.own(Rule::Fcd));
    }

    #[test]
    fn a_helper_that_fails_is_replaced_by_the_frames() {
        let near = Near::default();
        let mut tuner = Tuner::new(Some(Box::new(near.clone())));
        tuner.update(Some(&bench()), 3);
        tuner.work(0.0);
        near.0.borrow_mut().broken = true;
        finish(&mut tuner);
        assert!(!tuner.has_helper());
        assert_eq!(tuner.trouble(), Some("it is gone"));
    }

    #[test]
    fn an_answer_that_cannot_be_read_ends_the_helper_and_not_the_study() {
        let near = Near::default();
        let mut tuner = Tuner::new(Some(Box::new(near.clone())));
        tuner.update(Some(&bench()), 3);
        tuner.work(0.0);
        near.0.borrow_mut().babbles = true;
        assert!(tuner.work(0.0), "the next frame goes on with it");
        assert!(tuner.trouble().is_some_and(|why| why.contains("cannot be read")), "{:?}", tuner.trouble());
        assert!(near.0.borrow().remote.is_none(), "the helper was told to stop");
        finish(&mut tuner);
        assert_eq!((tuner.has_helper(), tuner.left()), (false, None));
    }

    #[test]
    fn a_dragged_threshold_keeps_every_run() {
        let near = Near::default();
        let mut tuner = Tuner::new(Some(Box::new(near.clone())));
        let mut scenario = bench();
        tuner.update(Some(&scenario), 3);
        finish(&mut tuner);
        let asked = near.0.borrow().asked;
        for k in 0..50 {
            let xi2 = 0.004_03 + 0.000_113 * f64::from(k);
            scenario.detection.xi2 = Threshold::On(xi2);
            tuner.update(Some(&scenario), 3);
            assert_eq!((tuner.left(), near.0.borrow().asked), (None, asked), "{xi2} m");
            assert_eq!(tuner.setting(Rule::Fcd), Some(xi2));
            let counted = tuner.own(Rule::Fcd).expect("a point").threshold;
            assert!((counted - xi2).abs() <= 0.000_05 + 1e-9, "{counted} m for {xi2} m");
        }
    }

    #[test]
    fn a_threshold_costs_no_run_and_a_filter_length_few() {
        let near = Near::default();
        let mut tuner = Tuner::new(Some(Box::new(near.clone())));
        let mut scenario = bench();
        tuner.update(Some(&scenario), 3);
        finish(&mut tuner);
        let asked = near.0.borrow().asked;
        scenario.detection.xi2 = Threshold::On(0.0043);
        tuner.update(Some(&scenario), 3);
        assert_eq!((tuner.left(), near.0.borrow().asked), (None, asked));
        assert_eq!(tuner.own(Rule::Fcd).map(|point| point.threshold), Some(0.0043));
        scenario.filter.length = 300;
        tuner.update(Some(&scenario), 3);
        // The other disks at that length.
        assert_eq!(tuner.left().map(|left| left.of - left.done), Some(2 * 3));
        scenario.detection.xi2 = Threshold::On(0.0);
        tuner.update(Some(&scenario), 3);
        finish(&mut tuner);
        assert_eq!(tuner.own(Rule::Fcd).map(|point| point.false_alarms.rate.rate), Some(1.0));
        scenario.detection.xi2 = Threshold::OFF;
        tuner.update(Some(&scenario), 3);
        finish(&mut tuner);
        assert!(tuner.own(Rule::Fcd).is_none() && tuner.own(Rule::Jfd).is_some());
        // Nobody looks: nothing is made; and again it goes on.
        tuner.update(None, 3);
        assert_eq!((tuner.work(0.0), tuner.progress()), (false, None));
        tuner.update(Some(&scenario), 3);
        finish(&mut tuner);
        // More repeats go on from those there are.
        tuner.hold(true);
        scenario.tracker.position_noise *= 2.0;
        tuner.update(Some(&scenario), 3);
        assert!(!tuner.is_held(), "what is new is made");
        finish(&mut tuner);
    }

    #[test]
    fn what_is_shown_stays_until_the_next_can_be_shown() {
        let mut tuner = Tuner::new(None);
        let mut scenario = bench();
        scenario.motion.end = 8.0;
        tuner.update(Some(&scenario), 25);
        finish(&mut tuner);
        let point = tuner.own(Rule::Fcd);
        scenario.tracker.position_noise *= 3.0;
        tuner.update(Some(&scenario), 25);
        tuner.work(0.0);
        scenario.tracker.position_noise *= 1.5;
        tuner.update(Some(&scenario), 25);
        tuner.work(0.0);
        assert_eq!(tuner.own(Rule::Fcd), point);
        finish(&mut tuner);
        assert_ne!(tuner.own(Rule::Fcd), point);
    }
}
