//! What each detector sees of a repeat, sample by sample: no more is computed than is held against thresholds.

use crate::detect::evidence::deviation;
use crate::detect::filter::PoseFilter;
use crate::detect::{Method, Standing, Statistic};
use crate::model::Vec3;
use crate::record::script::Step;
use crate::scenario::Plan;
use crate::sensors::cells::SimulatedCells;
use crate::sensors::tracker::Reading;
use crate::study::shared::Shared;

/// A repeat of a plan, looked at one sample after the other.
#[derive(Debug)]
pub struct Sight<'a> {
    plan: &'a Plan,
    shared: &'a Shared,
    filter: PoseFilter,
    cells: SimulatedCells,
    /// Load cells now, where Θ is not known beforehand.
    tau_lc: Option<Vec3>,
}

impl<'a> Sight<'a> {
    /// Before the first sample. `shared` is what the plan's repeats have in common.
    #[must_use]
    pub fn new(plan: &'a Plan, shared: &'a Shared) -> Self {
        let scenario = plan.scenario();
        Self {
            plan,
            shared,
            filter: PoseFilter::new(&scenario.filter, scenario.loop_rate),
            cells: SimulatedCells::new(plan),
            tau_lc: None,
        }
    }

    /// Takes sample `k`: what the sensors read then.
    #[inline]
    pub fn take(&mut self, k: usize, step: &Step, reading: &Reading) {
        self.filter.take(reading);
        self.tau_lc = self.shared.residual(k).is_none().then(|| self.cells.read(&step.tau));
    }

    /// What a detector holds against its threshold at sample `k`, the one taken last.
    #[inline]
    pub fn sees(&mut self, detector: Method, k: usize, step: &Step) -> Statistic {
        let (thresholds, expected) = (&self.plan.scenario().detection, self.shared.expectation(k));
        let (value, speed) = match detector {
            // What turns too slowly needs no centrode.
            Method::Fcd if self.filter.turns_at_most(thresholds.min_speed) => {
                return Statistic { value: f64::NAN, standing: Standing::Silent };
            }
            Method::Fcd => {
                let motion = self.filter.motion();
                (deviation(&expected.centrode, &motion).1, motion.twist.angular.norm())
            }
            Method::Jfd => {
                let residual = |tau_lc| expected.residual(self.plan.segment(), &step.configuration, tau_lc);
                (self.tau_lc.as_ref().map(residual).or(self.shared.residual(k)).unwrap_or(f64::NAN), 0.0)
            }
            // No rule looks at them.
            Method::FcdConsistent | Method::FcdVelocity | Method::Cusum | Method::Glr => (f64::NAN, 0.0),
        };
        Statistic { value, standing: detector.standing(value, speed, step.time, thresholds) }
    }
}
