//! The plans of a figure's runs: without the beam, and repeated.

use crate::scenario::Place;
use crate::scenario::{Plan, Scenario, ScenarioError};
use crate::study::seed::repeat_seed;

/// Repeats of an experiment that a figure shows, as in the paper.
pub const REPEATS: usize = 5;

/// The same plan with no beam.
///
/// # Errors
/// None that the plan has not passed.
pub fn without_contact(plan: &Plan) -> Result<Plan, ScenarioError> {
    let mut scenario = plan.scenario().clone();
    scenario.contact.place = Place::Nowhere;
    Plan::new(&scenario)
}

/// The plans of all repeats.
///
/// # Errors
/// None that the plan has not passed.
pub fn repeats(plan: &Plan) -> Result<Vec<Plan>, ScenarioError> {
    let of = |k| Plan::new(&Scenario { seed: repeat_seed(plan.scenario().seed, k), ..plan.scenario().clone() });
    (0..REPEATS as u64).map(of).collect()
}
