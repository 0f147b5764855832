//! Scenario, or a log → recording → conclusions → loci, each made anew when what it depends on changes.

pub mod placed;
pub mod recorded;

use std::rc::Rc;

use crate::app::state;
use crate::show::track::Trace;
use centrode_core::record::log::{Log, LogError, Setup};
use centrode_core::run::{Anew, Run, at_most, simulate};
use centrode_core::scenario::{Plan, Scenario, ScenarioError};
use centrode_core::study::course;
use placed::Placed;
use recorded::Recorded;

/// The longest run the page takes, in samples: it keeps every sample, and runs anew at each touch of a slider.
pub const MAX_SAMPLES: usize = 200_000;

/// Whether the page can run a scenario.
///
/// # Errors
/// Why not: an impossible value, or a run that is too long for a page.
pub fn check(scenario: &Scenario) -> Result<(), ScenarioError> {
    plan(scenario).map(drop)
}

fn plan(scenario: &Scenario) -> Result<Plan, ScenarioError> {
    at_most(Plan::new(scenario)?, MAX_SAMPLES)
}

/// Why the wanted scenario is not the one that is shown.
#[derive(Debug, Clone, PartialEq)]
pub enum Refusal {
    /// It cannot be.
    Scenario(ScenarioError),
    /// The log that is shown does not fit it.
    Log(LogError),
}

/// The last run that was possible, simulated or of a log, and why the wanted one is not.
#[derive(Debug)]
pub struct Memo {
    wanted: Scenario,
    /// The last scenario that was possible.
    plan: Plan,
    run: Run,
    /// The log in place of a simulation.
    recorded: Option<Recorded>,
    trace: Trace,
    version: u64,
    /// A number that is another for other readings, or readings that were heard otherwise.
    heard: u64,
    placed: Placed,
    refusal: Option<Refusal>,
}

impl Memo {
    /// Runs a scenario; the default one in place of one that is refused.
    ///
    /// # Panics
    /// When the default scenario is impossible, which a test excludes.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        let run = simulate(&Scenario::default()).expect("the default scenario is possible");
        let mut memo = Self {
            wanted: Scenario::default(),
            plan: run.plan.clone(),
            trace: Trace::new(&run),
            run,
            recorded: None,
            version: 0,
            heard: 0,
            placed: Placed::default(),
            refusal: None,
        };
        memo.placed.renew(&memo.run, memo.heard);
        memo.update(scenario);
        memo
    }

    /// Brings everything up to date. Returns whether the scenario had changed.
    pub fn update(&mut self, scenario: &Scenario) -> bool {
        if *scenario == self.wanted {
            return false;
        }
        self.wanted = scenario.clone();
        self.refusal = self.follow().err();
        true
    }

    /// Runs or judges what is wanted.
    fn follow(&mut self) -> Result<(), Refusal> {
        let plan = plan(&self.wanted).map_err(Refusal::Scenario)?;
        // Also when the log does not fit it: without the log it is what is shown.
        self.plan = plan.clone();
        let looks = |run: &Run| {
            let detection = &run.plan.scenario().detection;
            (detection.armed_from, detection.min_speed)
        };
        let before = looks(&self.run);
        let anew = match &self.recorded {
            None => self.run.update(plan),
            Some(recorded) if recorded.depends(&self.wanted) => {
                let (recorded, run) = recorded.again(&self.wanted).map_err(Refusal::Log)?;
                (self.recorded, self.run) = (Some(recorded), run);
                Anew::Recording
            }
            Some(recorded) => self.run.update(recorded.plan(&self.wanted).map_err(Refusal::Scenario)?),
        };
        self.version += 1;
        if anew > Anew::Events || looks(&self.run) != before {
            self.trace = Trace::new(&self.run);
        }
        self.heard += u64::from(anew > Anew::Events);
        self.placed.renew(&self.run, self.heard);
        Ok(())
    }

    /// Shows a log in place of the simulation.
    ///
    /// # Errors
    /// When it does not fit the scenario; what is shown then stays.
    pub fn open(&mut self, log: Rc<Log>, setup: Setup) -> Result<(), LogError> {
        let (recorded, run) = Recorded::new(log, setup, self.plan.scenario())?;
        self.recorded = Some(recorded);
        self.show(run);
        Ok(())
    }

    /// Goes back to the simulation.
    pub fn close(&mut self) {
        if self.recorded.take().is_some() {
            self.show(Run::new(self.plan.clone()));
        }
    }

    /// Takes the log off the page, and goes back to the simulation.
    pub fn set_aside(&mut self) -> Option<Recorded> {
        let log = self.recorded.take()?;
        self.show(Run::new(self.plan.clone()));
        Some(log)
    }

    /// Shows a log again that was set aside, as the scenario now asks, or as it was if the scenario no longer fits.
    pub fn put_back(&mut self, log: Recorded) {
        let (made, refused) = match log.again(&self.wanted) {
            Ok(made) => (Some(made), None),
            Err(refused) => (log.as_it_was().ok(), Some(refused)),
        };
        if let Some((log, run)) = made {
            self.recorded = Some(log);
            self.show(run);
            self.refusal = self.refusal.take().or(refused.map(Refusal::Log));
        }
    }

    fn show(&mut self, run: Run) {
        self.run = run;
        self.trace = Trace::new(&self.run);
        (self.version, self.heard) = (self.version + 1, self.heard + 1);
        self.placed.renew(&self.run, self.heard);
        self.refusal = self.refusal.take().filter(|refusal| matches!(refusal, Refusal::Scenario(_)));
    }

    /// Makes one of the estimates that are missing, first the one that is shown at a time (s). Returns whether more are missing.
    pub fn place(&mut self, time: f64) -> bool {
        self.placed.work(&self.run, time)
    }

    /// Where the contact is that its alarm tells of.
    #[must_use]
    pub fn placed(&self) -> &Placed {
        &self.placed
    }

    /// Probability that a contact has begun by a time (s), by the calibration filter; none where it does not watch.
    #[must_use]
    pub fn contact(&self, time: f64) -> Option<f64> {
        let watched = self.run.judged.watched.as_ref()?;
        watched.at(time).and_then(|at| watched.heard.get(at)).map(|heard| heard.contact)
    }

    /// The last run that was possible.
    #[must_use]
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The log that it is of; none for a simulation.
    #[must_use]
    pub fn recorded(&self) -> Option<&Recorded> {
        self.recorded.as_ref()
    }

    /// What is set, whether or not a log is shown: the last scenario that was possible.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Where playback opens and loops to, s.
    #[must_use]
    pub fn lead_in(&self) -> f64 {
        if self.run.is_recorded() { self.run.sample(0).time } else { state::lead_in(self.plan.scenario()) }
    }

    /// A number that is another for every other run.
    #[must_use]
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Its loci.
    #[must_use]
    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    /// Why the wanted scenario is not the one that was run.
    #[must_use]
    pub fn refusal(&self) -> Option<&Refusal> {
        self.refusal.as_ref()
    }
}

/// When a run ends, s.
#[must_use]
pub fn end(run: &Run) -> f64 {
    if run.is_recorded() { course::end(run) } else { run.plan.scenario().motion.end }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refused_scenario_keeps_the_last_good_run() {
        let mut memo = Memo::new(&Scenario::default());
        let before = memo.run().fingerprint();
        let mut scenario = Scenario::default();
        scenario.robot.length = -1.0;
        assert!(memo.update(&scenario));
        assert_eq!(memo.run().fingerprint(), before);
        let Some(Refusal::Scenario(refused)) = memo.refusal() else { panic!("{:?}", memo.refusal()) };
        let message = refused.to_string();
        assert!(message.contains("robot.length") && message.contains("-1"), "{message}");
        assert!(memo.update(&Scenario::default()));
        assert_eq!(memo.refusal(), None);
    }

    #[test]
    fn a_log_that_is_put_back_where_it_does_not_fit_is_shown_as_it_was() {
        let bytes = include_bytes!("../../assets/logs/clean.csv").to_vec();
        let log = Log::read("clean.csv", bytes, &Default::default()).expect("an example");
        let mut memo = Memo::new(&Scenario::default());
        memo.open(Rc::new(log), Setup::default()).expect("it fits");
        let before = memo.run().fingerprint();
        let log = memo.set_aside().expect("a log");
        assert!(!memo.run().is_recorded());
        let mut scenario = Scenario::default();
        scenario.robot.length = -1.0;
        memo.update(&scenario);
        memo.put_back(log);
        assert_eq!((memo.run().is_recorded(), memo.run().fingerprint()), (true, before));
        assert!(memo.refusal().is_some());
        memo.update(&Scenario::default());
        assert!(memo.run().is_recorded() && memo.refusal().is_none());
    }

    #[test]
    fn a_run_too_long_for_a_page_is_refused() {
        let mut scenario = Scenario::default();
        scenario.motion.end = 99_999.0;
        let message = check(&scenario).expect_err("too long").to_string();
        assert!(message.contains("motion.end") && message.contains("99999"), "{message}");
    }
}
