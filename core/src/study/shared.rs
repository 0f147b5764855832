//! What the repeats of a plan have in common, made once for all of them, and a few of the latest kept.

use crate::detect::evidence::Expectation;
use crate::record::Script;
use crate::scenario::{CellErrors, Filter, Plan, Prior, Scenario, Thresholds};
use crate::sensors::cells::SimulatedCells;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock};

/// Commands, truth, the tracker's views of it, and what the model expects.
#[derive(Debug, Clone, PartialEq)]
pub struct Shared {
    script: Script,
    expectations: Vec<Expectation>,
    /// Θ (N·m) at each sample, where no load cell draws a random number.
    residuals: Option<Vec<f64>>,
}

impl Shared {
    /// Of a plan; its filter and thresholds do not matter, nor its seed unless the true robot is drawn from it.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let script = Script::new(plan);
        let (segment, load_cells) = (plan.segment(), &plan.scenario().load_cells);
        let expect = |configuration| Expectation::new(segment, configuration, load_cells.epsilon_tau);
        let expectations: Vec<_> = script.steps().iter().map(|step| expect(step.configuration)).collect();
        let alike = load_cells.noise == 0.0 && load_cells.errors == CellErrors::Common;
        let residuals = alike.then(|| {
            let mut cells = SimulatedCells::new(plan);
            let both = script.steps().iter().zip(&expectations);
            both.map(|(step, expected)| expected.residual(segment, &step.configuration, &cells.read(&step.tau)))
                .collect()
        });
        Self { script, expectations, residuals }
    }

    /// Commands, truth and the tracker's views.
    #[must_use]
    pub fn script(&self) -> &Script {
        &self.script
    }

    /// What the model expects at sample `k`.
    ///
    /// # Panics
    /// When there is no such sample.
    #[must_use]
    pub fn expectation(&self, k: usize) -> &Expectation {
        &self.expectations[k]
    }

    /// Θ (N·m) at sample `k`, where it is the same in all repeats.
    #[must_use]
    pub fn residual(&self, k: usize) -> Option<f64> {
        self.residuals.as_ref().map(|residuals| residuals[k])
    }
}

/// The latest of what was shared: plans that differ in seed, filter, thresholds or the tracker's noise share one, but for the seed
/// that draws a true robot.
///
/// It keeps few, for each holds a whole run: memory does not grow with the number of plans. Two of these are always equal, since
/// what they keep follows from the plans.
#[derive(Debug, Default)]
pub struct Kept {
    latest: Mutex<VecDeque<Slot>>,
}

/// A plan's own, its samples, and what is shared, being made or made.
type Slot = (Scenario, usize, Arc<OnceLock<Shared>>);

/// How many are kept.
pub const KEPT: usize = 16;
/// How many samples they may have together, where there is more than one: some 400 bytes each.
const MOST: usize = 1_000_000;

impl Kept {
    /// What the repeats of a plan share, made now unless it is there. Whoever asks for it meanwhile waits for it.
    #[must_use]
    pub fn of(&self, plan: &Plan) -> impl std::ops::Deref<Target = Shared> + use<> {
        let key = key(plan);
        let slot = {
            // A thread that panicked has left the list as it was, or one longer.
            let mut latest = self.latest.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            match latest.iter().position(|(known, ..)| *known == key) {
                Some(place) => {
                    // The one asked for longest ago goes first.
                    let known = latest.remove(place);
                    latest.extend(known);
                }
                None => {
                    latest.push_back((key, plan.samples(), Arc::default()));
                    let samples = |slots: &VecDeque<Slot>| slots.iter().map(|(_, samples, _)| samples).sum::<usize>();
                    while latest.len() > 1 && (latest.len() > KEPT || samples(&latest) > MOST) {
                        latest.pop_front();
                    }
                }
            }
            latest.back().map(|(.., slot)| Arc::clone(slot)).unwrap_or_default()
        };
        slot.get_or_init(|| Shared::new(plan));
        Held(slot)
    }
}

/// A slot that is filled.
struct Held(Arc<OnceLock<Shared>>);

impl std::ops::Deref for Held {
    type Target = Shared;

    fn deref(&self) -> &Shared {
        self.0.get().expect("filled before it was handed out")
    }
}

impl Clone for Kept {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Kept {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// What a plan shares with others, as a scenario in which nothing else differs.
fn key(plan: &Plan) -> Scenario {
    let mut key = plan.scenario().clone();
    if !plan.is_drawn() {
        key.seed = 0;
    }
    key.filter = Filter::default();
    key.detection = Thresholds::default();
    key.prior = Prior::default();
    key.tracker.position_noise = 0.0;
    key.tracker.orientation_noise = 0.0;
    key.calibration.drift = 0.0;
    key.calibration.colour = 0.0;
    key
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::preset::find;

    fn plan(sets: &[&str]) -> Plan {
        let mut draft = find("bench").and_then(|preset| preset.draft()).expect("bench");
        sets.iter().for_each(|set| draft.set(set).expect(set));
        Plan::new(&draft.finish().expect("valid")).expect("valid")
    }

    #[test]
    fn plans_that_differ_in_noise_or_judging_share_and_others_do_not() {
        let kept = Kept::default();
        let count = || kept.latest.lock().expect("no panic").len();
        for sets in [&["seed=7"][..], &["filter.length=100"], &["detection.xi2=0.001"], &["tracker.position_noise=0"]] {
            assert_eq!(*kept.of(&plan(sets)), Shared::new(&plan(sets)), "{sets:?}");
            assert_eq!(count(), 1);
        }
        for (k, set) in ["contact.disk=1", "tracker.latency=0.01", "load_cells.noise=0.3"].into_iter().enumerate() {
            assert_eq!(*kept.of(&plan(&[set])), Shared::new(&plan(&[set])), "{set}");
            assert_eq!(count(), k + 2);
        }
    }

    #[test]
    fn repeats_with_a_drawn_robot_do_not_share() {
        let kept = Kept::default();
        let drawn = plan(&["calibration.draw=drawn", "calibration.bend_offset=0.01"]);
        let scripts = [3, 4].map(|seed| {
            let plan = drawn.with_seed(seed);
            let shared = kept.of(&plan);
            assert_eq!(*shared, Shared::new(&plan));
            shared.script().clone()
        });
        assert_ne!(scripts[0], scripts[1]);
        assert_eq!(*kept.of(&drawn.with_seed(3)), Shared::new(&drawn.with_seed(3)));
        // What is not drawn, and what only the tracker sees, is shared.
        let fixed = plan(&["calibration.bend_offset=0.01", "calibration.drift=0.001", "calibration.colour=0.5"]);
        let count = || kept.latest.lock().expect("no panic").len();
        for seed in [3, 4] {
            assert_eq!(*kept.of(&fixed.with_seed(seed)), Shared::new(&fixed));
            assert_eq!(count(), 3);
        }
    }

    #[test]
    fn no_more_than_a_few_are_kept() {
        let kept = Kept::default();
        for k in 0..2 * KEPT {
            let held = kept.of(&plan(&[&format!("motion.end={}", 8.5 + 0.01 * k as f64)]));
            assert!(held.script().contact_time().is_some());
        }
        assert_eq!(kept.latest.lock().expect("no panic").len(), KEPT);
    }
}
