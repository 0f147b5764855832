//! What all repeats of a plan have in common: commands, truth, and where the tip is whenever the tracker looks.

use super::{Entry, Truth};
use crate::model::{Configuration, Pose, Vec3};
use crate::plant::Plant;
use crate::scenario::Plan;
use crate::sensors::cells::SimulatedCells;
use crate::sensors::tracker::{Reading, SimulatedTracker};

/// One instant of the loop, before any noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Time, s.
    pub time: f64,
    /// The commanded configuration.
    pub configuration: Configuration,
    /// Commanded θ̇L, rad/s.
    pub theta_l_rate: f64,
    /// Joint forces τ, N.
    pub tau: Vec3,
    /// Whether the beam holds the backbone.
    pub held: bool,
}

/// The experiment of a plan without its noise, made once for all repeats.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    steps: Vec<Step>,
    /// Pose of the end disk at each of the tracker's readings, in order.
    tips: Vec<Pose>,
    /// The first instant in contact.
    contact: Option<usize>,
}

impl Script {
    /// Of a plan; its seed matters only where the true robot is drawn from it.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let plant = Plant::new(plan);
        let mut tracker = SimulatedTracker::new(plan);
        let mut tips = Vec::new();
        let step = |k| {
            let time = plan.time(k);
            let (configuration, theta_l_rate) = plant.command(time);
            tracker.read(time, |taken| {
                let tip = plant.shape(plant.command(taken).0).tip_pose();
                tips.push(tip);
                tip
            });
            let Truth { held, tau, .. } = Truth::of(&plant, configuration, time);
            Step { time, configuration, theta_l_rate, tau, held: held.is_some() }
        };
        let steps: Vec<_> = (0..plan.samples()).map(step).collect();
        Self { contact: steps.iter().position(|step| step.held), steps, tips }
    }

    /// The instants of the loop.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Truth: the first instant in contact, as its place among the instants.
    #[must_use]
    pub fn contact_sample(&self) -> Option<usize> {
        self.contact
    }

    /// Truth: time of the first instant in contact, s.
    #[must_use]
    pub fn contact_time(&self) -> Option<f64> {
        self.contact.map(|sample| self.steps[sample].time)
    }

    /// The tracker's readings in one repeat. `plan` is the script's own but for its seed, or as it is where that
    /// draws the true robot.
    pub fn readings(&self, plan: &Plan) -> impl Iterator<Item = Reading> {
        let mut tracker = SimulatedTracker::new(plan);
        let mut tips = self.tips.iter();
        // There are as many tips as the tracker takes readings, for it looks at the clock alone.
        self.steps.iter().map(move |step| tracker.read(step.time, |_| *tips.next().expect("a tip for each reading")))
    }

    /// What is stored of one repeat: the same as [`super::Recorder`] gives. `plan` is the script's own but for its seed, or as it is where that
    /// draws the true robot.
    pub fn entries(&self, plan: &Plan) -> impl Iterator<Item = Entry> {
        let mut cells = SimulatedCells::new(plan);
        self.steps.iter().zip(self.readings(plan)).map(move |(step, reading)| {
            let Step { time, configuration, theta_l_rate, tau, .. } = *step;
            Entry { time, configuration, theta_l_rate, delta_rate: 0.0, reading, tau_lc: cells.read(&tau) }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Recorder;
    use crate::scenario::preset::PRESETS;

    #[test]
    fn a_script_gives_what_each_repeat_would_have_stored() {
        for preset in PRESETS {
            let plan = Plan::new(&preset.scenario().expect(preset.name)).expect(preset.name);
            let whole = Script::new(&plan);
            for seed in [plan.scenario().seed, 77] {
                let plan = plan.with_seed(seed);
                // A robot that is drawn is another one in each repeat.
                let script = if plan.is_drawn() { Script::new(&plan) } else { whole.clone() };
                let same = |a: &Vec3, b: &Vec3| a.iter().zip(b.iter()).all(|(a, b)| a.to_bits() == b.to_bits());
                for (ours, (entry, truth)) in script.entries(&plan).zip(Recorder::new(&plan)) {
                    let readings = (ours.reading, ours.time, ours.configuration);
                    assert_eq!(readings, (entry.reading, entry.time, entry.configuration), "{}", preset.name);
                    assert!(same(&ours.tau_lc, &entry.tau_lc), "{} at {}", preset.name, truth.tau);
                }
                assert_eq!(script.entries(&plan).count(), plan.samples());
            }
        }
    }

    #[test]
    fn repeats_of_one_script_differ_in_drift_and_noise_as_they_would_alone() {
        let mut scenario = PRESETS[0].scenario().expect("a preset");
        scenario.tracker.position_noise = 1e-4;
        (scenario.calibration.drift, scenario.calibration.colour) = (1e-4, 0.5);
        scenario.calibration.frame = [1e-3, 0.0, 0.0];
        let plan = Plan::new(&scenario).expect("possible");
        let script = Script::new(&plan);
        for seed in [3, 77] {
            let plan = plan.with_seed(seed);
            let alone = Recorder::new(&plan).map(|(entry, _)| entry.reading);
            assert!(script.readings(&plan).eq(alone));
        }
        assert!(script.readings(&plan.with_seed(3)).ne(script.readings(&plan.with_seed(77))));
    }
}
