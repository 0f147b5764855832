//! Scenario → recording → conclusions → loci, each made anew when what it depends on changes.

use crate::show::track::Trace;
use centrode_core::run::{Anew, Run, at_most, simulate};
use centrode_core::scenario::{Plan, Scenario, ScenarioError};

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

/// The last run that was possible, and why the wanted one is not.
#[derive(Debug)]
pub struct Memo {
    wanted: Scenario,
    run: Run,
    trace: Trace,
    version: u64,
    refusal: Option<ScenarioError>,
}

impl Memo {
    /// Runs a scenario; the default one in place of one that is refused.
    ///
    /// # Panics
    /// When the default scenario is impossible, which a test excludes.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        let run = simulate(&Scenario::default()).expect("the default scenario is possible");
        let mut memo = Self { wanted: Scenario::default(), trace: Trace::new(&run), run, version: 0, refusal: None };
        memo.update(scenario);
        memo
    }

    /// Brings everything up to date. Returns whether the scenario had changed.
    pub fn update(&mut self, scenario: &Scenario) -> bool {
        if *scenario == self.wanted {
            return false;
        }
        self.wanted = scenario.clone();
        match plan(scenario) {
            Ok(plan) => {
                self.refusal = None;
                let looks = |run: &Run| {
                    let detection = &run.plan.scenario().detection;
                    (detection.armed_from, detection.min_speed)
                };
                let before = looks(&self.run);
                let anew = self.run.update(plan);
                self.version += 1;
                if anew > Anew::Events || looks(&self.run) != before {
                    self.trace = Trace::new(&self.run);
                }
            }
            Err(refusal) => self.refusal = Some(refusal),
        }
        true
    }

    /// The last run that was possible.
    #[must_use]
    pub fn run(&self) -> &Run {
        &self.run
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
    pub fn refusal(&self) -> Option<&ScenarioError> {
        self.refusal.as_ref()
    }
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
        let message = memo.refusal().expect("refused").to_string();
        assert!(message.contains("robot.length") && message.contains("-1"), "{message}");
        assert!(memo.update(&Scenario::default()));
        assert_eq!(memo.refusal(), None);
    }

    #[test]
    fn a_run_too_long_for_a_page_is_refused() {
        let mut scenario = Scenario::default();
        scenario.motion.end = 99_999.0;
        let message = check(&scenario).expect_err("too long").to_string();
        assert!(message.contains("motion.end") && message.contains("99999"), "{message}");
    }
}
