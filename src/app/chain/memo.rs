//! What is set of several segments → their run → the contacts that are told, each made anew when what it depends on changes.

use std::rc::Rc;

use crate::app::chain::log::Opened;
use crate::app::charts::notation::number;
use crate::app::helper::{Asking, Helper, Turn};
use crate::app::memo::MAX_SAMPLES;
use crate::app::stages::viewport::subject::Subject;
use centrode_core::detect::chain::{ChainContactFound, ChainEstimate, ChainMethod};
use centrode_core::model::chain::Unsettled;
use centrode_core::model::chain::path::What;
use centrode_core::scenario::chain::ChainDraft;
use centrode_core::scenario::preset::CHAINS;
use centrode_core::scenario::{ChainPlan, ChainScenario};
use centrode_core::study::about::ChainAbout;
use centrode_core::study::chain::ChainRun;
use centrode_core::study::chain::course;
use centrode_core::study::chain::placing::{Placing, Spec, Told};
use centrode_core::study::remote::{Found, Work};

/// The last run that was possible, and why the wanted one is not.
pub struct Memo {
    wanted: ChainDraft,
    log: Option<Rc<Opened>>,
    ran: Ran,
    placing: Placing,
    asking: Asking,
    version: u64,
    refusal: Option<String>,
}

/// What came of a text, or of a log that is judged by it.
struct Ran {
    /// What was run.
    draft: ChainDraft,
    scenario: ChainScenario,
    run: ChainRun,
    /// How the log was read; none of a simulation.
    about: Option<ChainAbout>,
}

fn run(draft: &ChainDraft, log: Option<&Rc<Opened>>) -> Result<Ran, String> {
    let scenario = draft.scenario().map_err(|refused| refused.to_string())?;
    if let Some(log) = log {
        let assembled = log.assembled(&scenario);
        let assembled =
            assembled.map_err(|error| format!("The log does not fit what is set: {}", error.without_flags()))?;
        let run = ChainRun::recorded(&assembled).map_err(|unsettled| begins(&unsettled))?;
        let about = Some(ChainAbout::new(&assembled));
        return Ok(Ran { draft: draft.clone(), scenario: assembled.scenario, run, about });
    }
    let (end, rate) = (scenario.common().motion.end, scenario.common().loop_rate);
    if end * rate > MAX_SAMPLES as f64 {
        return Err(format!(
            "A run of {} s at {} Hz is too long for the page, which keeps {MAX_SAMPLES} samples",
            number(end, 1),
            number(rate, 0)
        ));
    }
    let plan = ChainPlan::new(&scenario).map_err(|unsettled| begins(&unsettled))?;
    Ok(Ran { draft: draft.clone(), scenario, run: ChainRun::new(plan), about: None })
}

fn begins(unsettled: &Unsettled) -> String {
    format!("As the experiment begins, there is {unsettled}")
}

impl Memo {
    /// Runs what is set, or judges a log by it; the first preset in place of what is refused. `helper` places contacts, if there is one.
    ///
    /// # Panics
    /// When the first preset is impossible, which a test excludes.
    #[must_use]
    pub fn new(draft: &ChainDraft, log: Option<&Rc<Opened>>, helper: Option<Box<dyn Helper>>) -> Self {
        let (ran, refusal) = match run(draft, log) {
            Ok(made) => (made, None),
            Err(why) => (run(&ChainDraft::of(&CHAINS[0]), None).expect("the first preset is possible"), Some(why)),
        };
        let (placing, asking) = (Placing::new(&ran.run), Asking::new(helper));
        Self { wanted: draft.clone(), log: log.cloned(), ran, placing, asking, version: 0, refusal }
    }

    /// Brings the run up to date. Returns whether what is set had changed.
    pub fn update(&mut self, draft: &ChainDraft, log: Option<&Rc<Opened>>) -> bool {
        let same_log = self.log.as_ref().map(Rc::as_ptr) == log.map(Rc::as_ptr);
        if *draft == self.wanted && same_log {
            return false;
        }
        (self.wanted, self.log) = (draft.clone(), log.cloned());
        match run(draft, log) {
            Ok(ran) => {
                self.placing = Placing::new(&ran.run);
                (self.ran, self.refusal) = (ran, None);
                self.version += 1;
                self.asking.rest();
            }
            Err(why) => self.refusal = Some(why),
        }
        true
    }

    /// Nobody looks: what a helper does for it ends.
    pub fn rest(&mut self) {
        self.asking.rest();
    }

    /// Takes what has come and asks for what is missing, or finds the contacts and places one of them, first what is known at a time (s). Returns
    /// whether the next frame should come at once for it.
    pub fn work(&mut self, time: f64) -> bool {
        let placing = &mut self.placing;
        if placing.progress().is_complete() {
            return false;
        }
        let taken = self.asking.take(|found| match found {
            Found::Contacts(parts) => parts.into_iter().all(|part| placing.add(part)),
            _ => true,
        });
        // Nobody else has the log.
        let turn = match taken {
            Ok(()) if self.ran.about.is_some() => Ok(Turn::Make),
            taken => taken.and_then(|()| {
                let scenario = || self.ran.draft.to_toml();
                self.asking.ask(placing.progress(), || Work::Contacts(Spec { scenario: scenario(), time }))
            }),
        };
        match turn {
            Ok(Turn::Make) => {
                if let Some(part) = placing.make(&self.ran.run, time) {
                    placing.add(part);
                }
                self.is_working()
            }
            Ok(Turn::Wait) => false,
            Err(why) => {
                self.asking.give_up(why);
                // Whoever makes it now begins with it anew.
                self.placing = Placing::new(&self.ran.run);
                true
            }
        }
    }

    /// Whether contacts are still to be found or placed.
    #[must_use]
    pub fn is_working(&self) -> bool {
        !self.placing.progress().is_complete()
    }

    /// What is set: the last that was possible.
    #[must_use]
    pub fn scenario(&self) -> &ChainScenario {
        &self.ran.scenario
    }

    /// Its run.
    #[must_use]
    pub fn run(&self) -> &ChainRun {
        &self.ran.run
    }

    /// How the log that is shown was read; none while a simulation is.
    #[must_use]
    pub fn about(&self) -> Option<&ChainAbout> {
        self.ran.about.as_ref()
    }

    /// The contacts that are told, as far as they have been found.
    #[must_use]
    pub fn told(&self) -> &[Told] {
        self.placing.told()
    }

    /// The same with what is known of each.
    #[must_use]
    pub fn found(&self) -> Vec<ChainContactFound> {
        self.placing.found()
    }

    /// The detector that tells of contacts.
    #[must_use]
    pub fn teller(&self) -> Option<ChainMethod> {
        self.placing.teller()
    }

    /// What is known at a time (s), with the number of each contact from 0.
    #[must_use]
    pub fn placed(&self, time: f64) -> Vec<(usize, &ChainEstimate)> {
        let each = self.told().iter().enumerate();
        each.filter_map(|(number, told)| Some((number, told.at(time)?))).collect()
    }

    /// What the 3D view shows at a time (s), with the chosen segment.
    #[must_use]
    pub fn subject(&self, chosen: usize, time: f64) -> Subject<'_> {
        let placed = self.placed(time).into_iter().map(|(_, estimate)| estimate).collect();
        let chosen = chosen.min(self.ran.run.recording.segments() - 1);
        Subject::Chain { run: &self.ran.run, chosen, placed, alarm: self.alarm(time) }
    }

    /// When the last alarm was raised before a time (s).
    #[must_use]
    pub fn alarm(&self, time: f64) -> Option<f64> {
        self.told().iter().map(|told| told.found.alarm).rfind(|alarm| *alarm <= time)
    }

    /// A number that is another for every other run.
    #[must_use]
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Why what is wanted is not what was run.
    #[must_use]
    pub fn refusal(&self) -> Option<&str> {
        self.refusal.as_deref()
    }

    /// How far the last end disk is out of the bending plane of the first segment at a time (s), m.
    #[must_use]
    pub fn aside(&self, time: f64) -> f64 {
        let time = time.min(self.end());
        let plan = &self.ran.run.plan;
        let truth = plan.path().at(time, &plan.bends(time));
        let (sin, cos) = plan.command(0, time).0.sin_cos_delta();
        truth.disks.last().map_or(0.0, |disk| (sin * disk.position.x + cos * disk.position.y).abs())
    }

    /// Whether the robot gives way before the run would end.
    #[must_use]
    pub fn gives_way(&self) -> bool {
        self.ran.run.plan.path().happened().iter().any(|event| matches!(event.what, What::Buckled | What::Lost))
    }

    /// When the run ends, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        course::end(&self.ran.run)
    }

    /// Where playback opens and loops to, s: shortly before the first motion.
    #[must_use]
    pub fn lead_in(&self) -> f64 {
        if self.ran.about.is_some() {
            return 0.0;
        }
        lead_in(&self.ran.scenario).min(self.end())
    }
}

/// Where playback of an experiment opens, s.
#[must_use]
pub fn lead_in(scenario: &ChainScenario) -> f64 {
    let starts = scenario.segments.iter().flat_map(|segment| [segment.motion().start, segment.delta_start]);
    (starts.fold(f64::INFINITY, f64::min) - crate::app::state::LEAD_IN)
        .clamp(0.0, scenario.common().motion.end.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::helper::near::Near;
    use centrode_core::scenario::preset;
    use centrode_core::study::remote::{Remote, Request};

    fn helped(near: &Near) -> Memo {
        Memo::new(&ChainDraft::of(&CHAINS[0]), None, Some(Box::new(near.clone())))
    }

    fn here() -> Memo {
        let mut here = Memo::new(&ChainDraft::of(&CHAINS[0]), None, None);
        while here.work(0.0) {}
        here
    }

    #[test]
    fn a_helper_places_what_is_placed_here() {
        let near = Near::default();
        let mut there = helped(&near);
        while there.is_working() {
            assert!(!there.work(0.0), "the page has nothing to do");
        }
        assert_eq!(near.0.borrow().asked, 1);
        assert_eq!(there.told(), here().told());
        assert!(!there.told().is_empty());
        // Another experiment is asked for anew, and nothing is while nobody looks.
        let other = ChainDraft::of(&CHAINS[0]).overridden(["seed=2"]).expect("possible");
        assert!(there.update(&other, None) && there.is_working());
        there.work(0.0);
        assert_eq!(near.0.borrow().asked, 2);
        there.rest();
        assert!(near.0.borrow().remote.is_none());
    }

    #[test]
    fn placing_goes_on_where_somebody_looks_again_or_another_helper_begins_anew() {
        let near = Near::default();
        let draft = ChainDraft::of(preset::find_chain("two-contacts").expect("shipped"));
        let mut there = Memo::new(&draft, None, Some(Box::new(near.clone())));
        // Looked at until something has come, then not for a while.
        while there.told().is_empty() {
            there.work(0.0);
        }
        assert!(there.is_working());
        there.rest();
        there.work(0.0);
        near.0.borrow_mut().remote = None;
        // As the page does it: another is asked the same.
        let scenario = draft.to_toml();
        let request = Request { id: 3, work: Work::Contacts(Spec { scenario, time: 0.0 }) };
        near.0.borrow_mut().remote = Some(Remote::new(&serde_json::to_string(&request).expect("JSON")).expect("one"));
        while there.is_working() {
            there.work(0.0);
        }
        let mut here = Memo::new(&draft, None, None);
        while here.work(0.0) {}
        assert_eq!(there.told(), here.told());
        assert!(there.asking.has_helper(), "it is relied on still");
    }

    #[test]
    fn without_a_helper_that_can_be_relied_on_the_page_places() {
        let told = here().told().to_vec();
        for nonsense in [false, true] {
            let near = Near::default();
            let mut there = helped(&near);
            there.work(0.0);
            let mut desk = near.0.borrow_mut();
            (desk.broken, desk.babbles) = (!nonsense, nonsense);
            drop(desk);
            while there.is_working() {
                there.work(0.0);
            }
            assert_eq!(there.told(), told);
        }
    }
}
