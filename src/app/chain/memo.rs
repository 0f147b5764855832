//! What is set of several segments → their run → the contacts that are told, each made anew when what it depends on changes.

use std::rc::Rc;

use crate::app::chain::log::Opened;
use crate::app::charts::notation::number;
use crate::app::memo::MAX_SAMPLES;
use crate::app::stages::viewport::subject::Subject;
use centrode_core::detect::chain::{ChainContactFound, ChainEstimate, ChainMethod};
use centrode_core::model::chain::Unsettled;
use centrode_core::model::chain::path::What;
use centrode_core::scenario::chain::{ChainDraft, Tracked};
use centrode_core::scenario::preset::CHAINS;
use centrode_core::scenario::{ChainPlan, ChainScenario};
use centrode_core::study::about::ChainAbout;
use centrode_core::study::chain::ChainRun;
use centrode_core::study::chain::course;

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
#[derive(Debug, Clone)]
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

/// The last run that was possible, and why the wanted one is not.
pub struct Memo {
    wanted: ChainDraft,
    log: Option<Rc<Opened>>,
    ran: Ran,
    teller: Option<ChainMethod>,
    /// The contacts that are told; none while they are still to be found.
    told: Option<Vec<Told>>,
    version: u64,
    refusal: Option<String>,
}

/// What came of a text, or of a log that is judged by it.
struct Ran {
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
        return Ok(Ran { scenario: assembled.scenario, run, about });
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
    Ok(Ran { scenario, run: ChainRun::new(plan), about: None })
}

fn begins(unsettled: &Unsettled) -> String {
    format!("As the experiment begins, there is {unsettled}")
}

impl Memo {
    /// Runs what is set, or judges a log by it; the first preset in place of what is refused.
    ///
    /// # Panics
    /// When the first preset is impossible, which a test excludes.
    #[must_use]
    pub fn new(draft: &ChainDraft, log: Option<&Rc<Opened>>) -> Self {
        let (ran, refusal) = match run(draft, log) {
            Ok(made) => (made, None),
            Err(why) => (run(&ChainDraft::of(&CHAINS[0]), None).expect("the first preset is possible"), Some(why)),
        };
        let teller = ran.run.judged.teller();
        Self { wanted: draft.clone(), log: log.cloned(), ran, teller, told: None, version: 0, refusal }
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
                (self.ran, self.refusal) = (ran, None);
                (self.teller, self.told) = (self.ran.run.judged.teller(), None);
                self.version += 1;
            }
            Err(why) => self.refusal = Some(why),
        }
        true
    }

    /// Finds the contacts, then places one of them, first what is known at a time (s). Returns whether more is to be done.
    pub fn work(&mut self, time: f64) -> bool {
        let Some(told) = &mut self.told else {
            let found = self.teller.map_or_else(Vec::new, |teller| self.ran.run.judged.contacts(teller, &[]));
            self.told = Some(found.into_iter().map(|found| Told { found, estimates: Vec::new() }).collect());
            return self.is_working();
        };
        let Some(teller) = self.teller else { return false };
        let times = after(&self.ran.scenario);
        let due = |told: &Told| told.estimates.len() < times.len();
        let seen = told.iter().rposition(|told| due(told) && told.found.alarm <= time);
        let Some(place) = seen.or_else(|| told.iter().position(due)) else { return false };
        // What is read once the next contact has begun says nothing of this one alone.
        let next = told.get(place + 1).map_or(f64::INFINITY, |next| next.found.alarm);
        let one = &mut told[place];
        let after = times[one.estimates.len()];
        let made = (one.found.alarm + after < next).then(|| self.ran.run.judged.estimate(teller, &one.found, after));
        one.estimates.push(made.flatten());
        self.is_working()
    }

    /// Whether contacts are still to be found or placed.
    #[must_use]
    pub fn is_working(&self) -> bool {
        let due = |told: &Told| told.estimates.len() < after(&self.ran.scenario).len();
        self.told.as_ref().is_none_or(|told| told.iter().any(due))
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
        self.told.as_deref().unwrap_or_default()
    }

    /// The detector that tells of contacts.
    #[must_use]
    pub fn teller(&self) -> Option<ChainMethod> {
        self.teller
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
