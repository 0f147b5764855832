//! The load cells: τ_lc,i = τ_i/(1 − ε_i), plus noise (Eq. 13).

use super::Plan;
use super::noise::{Normal, Source};
use super::scenario::LoadCells;
use crate::model::Vec3;

/// The simulated load cells.
#[derive(Debug, Clone)]
pub struct SimulatedCells {
    settings: LoadCells,
    noise: Normal,
}

impl SimulatedCells {
    /// The load cells of a plan.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let scenario = plan.scenario();
        Self { settings: scenario.load_cells.clone(), noise: Normal::new(scenario.seed, Source::LoadCells) }
    }

    /// What the cells read (N) when the true joint forces are `tau` (N).
    pub fn read(&mut self, tau: &Vec3) -> Vec3 {
        let reading = tau / (1.0 - self.settings.epsilon_tau);
        if self.settings.noise > 0.0 { reading.map(|x| x + self.settings.noise * self.noise.draw()) } else { reading }
    }
}
