//! A log in the place of the plant.

use std::rc::Rc;

use crate::app::words::refusal;
use centrode_core::record::log::assemble::rated;
use centrode_core::record::log::frame::Setting;
use centrode_core::record::log::{Commands, Log, LogError, Setup, assemble};
use centrode_core::run::Run;
use centrode_core::scenario::{Contact, Place, Plan, Scenario, ScenarioError};
use centrode_core::study::about::About;

/// The longest log the page shows, in instants of the loop: with its plots it takes less than 1 GB. It may be longer than a
/// simulation, which is computed anew at each touch of a slider.
pub const MAX_SAMPLES: usize = 1_200_000;

/// A log that is shown, and how it was made a recording.
#[derive(Debug)]
pub struct Recorded {
    /// What the file holds.
    pub log: Rc<Log>,
    setup: Setup,
    /// The scenario with which it was made a recording.
    scenario: Scenario,
    /// How it was read.
    pub about: About,
}

impl Recorded {
    /// Makes a recording of a log and judges it by a scenario.
    ///
    /// # Errors
    /// When the two do not fit, or the log is longer than [`MAX_SAMPLES`].
    pub fn new(log: Rc<Log>, setup: Setup, scenario: &Scenario) -> Result<(Self, Run), LogError> {
        let setup = Setup { most: Some(MAX_SAMPLES), ..setup };
        let loop_rate = rated(&log, scenario, setup.rate)?.loop_rate;
        // Before it is assembled, which would refuse in SI.
        let plan = plan(scenario, loop_rate)
            .map_err(|refused| LogError::file(format!("with this log, {}", refusal::told(&refused))))?;
        let made = assemble(&log, scenario, &setup)?;
        let about = About::new(&log, &made);
        let run = Run::recorded(plan, made.recording);
        let run = run.ok_or_else(|| LogError::file("holds no row that can be used"))?;
        let recorded = Self { log, setup, scenario: scenario.clone(), about };
        Ok((recorded, run))
    }

    /// The same log by another scenario.
    ///
    /// # Errors
    /// As [`Recorded::new`].
    pub fn again(&self, scenario: &Scenario) -> Result<(Self, Run), LogError> {
        Self::new(Rc::clone(&self.log), self.setup.clone(), scenario)
    }

    /// The same log by the scenario with which it was made a recording.
    ///
    /// # Errors
    /// As [`Recorded::new`].
    pub fn as_it_was(&self) -> Result<(Self, Run), LogError> {
        self.again(&self.scenario)
    }

    /// Whether another scenario makes another recording of the log, or only judges the same one.
    #[must_use]
    pub fn depends(&self, scenario: &Scenario) -> bool {
        let made = &self.scenario;
        let armed = |scenario: &Scenario| scenario.detection.armed_from.to_bits();
        let mut same = Scenario {
            contact: made.contact,
            load: made.load.clone(),
            load_cells: made.load_cells.clone(),
            filter: made.filter.clone(),
            detection: made.detection.clone(),
            seed: made.seed,
            ..scenario.clone()
        };
        if self.about.commands != Commands::Motion {
            // Its end says which clock is the scenario's, its direction what δ is where the log has none.
            let theirs = &scenario.motion;
            same.motion = made.motion.clone();
            (same.motion.end, same.motion.delta) = (theirs.end, theirs.delta);
        }
        same != *made || self.setup.frame == Setting::Fitted && armed(scenario) != armed(made)
    }

    /// By what the recording is judged in a scenario.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn plan(&self, scenario: &Scenario) -> Result<Plan, ScenarioError> {
        plan(scenario, self.about.loop_rate)
    }
}

/// A scenario at the rate of a log's loop, without the contact: where that was, no log says.
fn plan(scenario: &Scenario, loop_rate: f64) -> Result<Plan, ScenarioError> {
    let contact = Contact { place: Place::Nowhere, ..Contact::default() };
    Plan::new(&Scenario { loop_rate, contact, ..scenario.clone() })
}
