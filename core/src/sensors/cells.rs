//! The load cells: τ_lc,i = τ_i/(1 − ε_i), plus noise (Eqs. 13, 14).

use crate::model::Vec3;
use crate::noise::{Normal, Source};
use crate::scenario::CellErrors;
use crate::scenario::Plan;

/// The simulated load cells.
#[derive(Debug, Clone)]
pub struct SimulatedCells {
    errors: Vec3,
    deviation: f64,
    noise: Normal,
}

impl SimulatedCells {
    /// The load cells of a plan.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let scenario = plan.scenario();
        let cells = &scenario.load_cells;
        let errors = match cells.errors {
            CellErrors::Common => Vec3::repeat(cells.epsilon_tau),
            CellErrors::Independent => {
                let mut draws = Normal::new(scenario.seed, Source::CellErrors);
                Vec3::from_fn(|_, _| cells.epsilon_tau * draws.symmetric())
            }
        };
        Self { errors, deviation: cells.noise, noise: Normal::new(scenario.seed, Source::LoadCells) }
    }

    /// The relative errors ε_i of the three cells.
    #[must_use]
    pub fn errors(&self) -> &Vec3 {
        &self.errors
    }

    /// What the cells read (N) when the true joint forces are `tau` (N).
    pub fn read(&mut self, tau: &Vec3) -> Vec3 {
        let reading = tau.zip_map(&self.errors, |tau, error| tau / (1.0 - error));
        if self.deviation > 0.0 { reading.map(|x| x + self.deviation * self.noise.draw()) } else { reading }
    }
}
