//! What an experiment stores: commands, tracker readings and load cells at loop rate; and, when it was simulated, the truth.
//!
//! A recording does not know whether a simulation or a rig made it, and what judges it never looks at the truth. What shows it
//! reads the truth here and builds no plant of its own.

pub mod chain;
pub mod log;
pub mod script;

use crate::model::contact::branch::Surface;
use crate::model::{Configuration, Vec3, Wrench};
use crate::plant::event::Watch;
use crate::plant::{Plant, PlantEvent, Shape};
use crate::scenario::Plan;
use crate::sensors::cells::SimulatedCells;
use crate::sensors::tracker::{Reading, SimulatedTracker};

pub use script::Script;

/// What the loop stores at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Time, s.
    pub time: f64,
    /// The commanded configuration.
    pub configuration: Configuration,
    /// Commanded θ̇L, rad/s.
    pub theta_l_rate: f64,
    /// Commanded δ̇, rad/s; 0 in a bending plane that stays.
    pub delta_rate: f64,
    /// The tracker's reading, as held.
    pub reading: Reading,
    /// Load cell readings τ_lc, N. NaN where the statics are not defined.
    pub tau_lc: Vec3,
}

/// What was true of the robot at one instant.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Truth {
    /// Which of the plan's contacts holds the backbone, counted from 0; none while the robot is free.
    pub held: Option<usize>,
    /// The shape of the backbone.
    pub shape: Shape,
    /// The wrench on the end disk, in {B}.
    pub wrench: Wrench,
    /// Joint forces τ, N. NaN where the statics are not defined.
    pub tau: Vec3,
}

impl Truth {
    /// What a plant does in a commanded configuration at `time` (s).
    #[must_use]
    pub fn of(plant: &Plant, configuration: Configuration, time: f64) -> Self {
        let wrench = plant.wrench(time);
        Self {
            held: plant.held(&configuration),
            shape: plant.shape(configuration),
            tau: plant.joint_forces(configuration, &wrench),
            wrench,
        }
    }
}

/// The truth in configurations that are commanded one after the other and held still, before any load.
#[must_use]
pub fn held_still(plan: &Plan, configurations: impl IntoIterator<Item = Configuration>) -> Vec<Truth> {
    let plant = Plant::new(plan);
    configurations.into_iter().map(|configuration| Truth::of(&plant, configuration, 0.0)).collect()
}

/// An experiment as it was stored.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The entries, in order of time.
    pub entries: Vec<Entry>,
    /// The truth at each entry; none when a rig made the recording.
    pub truth: Option<Vec<Truth>>,
    /// Whether commands are what the robot was told; false where they were estimated from the tracker's own readings.
    pub commanded: bool,
}

impl Recording {
    /// What was stored with commands that the robot was told, and nothing beside it.
    #[must_use]
    pub fn stored(entries: Vec<Entry>) -> Self {
        Self { entries, truth: None, commanded: true }
    }

    /// The experiment of a plan, simulated.
    ///
    /// ```
    /// use centrode_core::record::Recording;
    /// use centrode_core::scenario::{Plan, Scenario};
    ///
    /// let recording = Recording::simulated(&Plan::new(&Scenario::default())?);
    /// assert_eq!(recording.entries.len(), 10_001);
    /// let truth = recording.truth.as_ref().expect("a simulation knows it");
    /// assert!(truth[0].held.is_none() && truth[9_000].held.is_some());
    /// # Ok::<(), centrode_core::scenario::ScenarioError>(())
    /// ```
    #[must_use]
    pub fn simulated(plan: &Plan) -> Self {
        let mut entries = Vec::with_capacity(plan.samples());
        let mut truth = Vec::with_capacity(plan.samples());
        for (entry, true_now) in Recorder::new(plan) {
            entries.push(entry);
            truth.push(true_now);
        }
        Self { entries, truth: Some(truth), commanded: true }
    }

    /// Truth: time of the first entry in contact, s; none when nothing touches or the truth is not known.
    #[must_use]
    pub fn contact_time(&self) -> Option<f64> {
        let truth = self.truth.as_ref()?;
        let first = truth.iter().position(|truth| truth.held.is_some())?;
        Some(self.entries[first].time)
    }

    /// Truth: size (N) of the force of a plane on the backbone at a time (s), for a segment of this bending stiffness (N·m²); none where
    /// it is not known, or nothing flat touches.
    #[must_use]
    pub fn contact_force(&self, time: f64, stiffness: f64) -> Option<f64> {
        let at = self.entries.partition_point(|entry| entry.time < time - 1e-9);
        match &self.truth.as_ref()?.get(at)?.shape {
            Shape::Touched(touched) if touched.branch().surface() == Surface::Plane => touched.force(stiffness),
            _ => None,
        }
    }

    /// Truth: what becomes of the contacts of the recording's plan, in order; nothing where the truth is not known.
    #[must_use]
    pub fn plant_events(&self, plan: &Plan) -> Vec<PlantEvent> {
        let mut watch = Watch::default();
        for (entry, truth) in self.entries.iter().zip(self.truth.iter().flatten()) {
            watch.look(plan, entry.time, &entry.configuration, truth.held);
        }
        watch.events().to_vec()
    }
}

/// A simulated experiment as a stream of what is stored, beside the truth: it keeps nothing.
#[derive(Debug, Clone)]
pub struct Recorder<'a> {
    plan: &'a Plan,
    plant: Plant<'a>,
    tracker: SimulatedTracker,
    cells: SimulatedCells,
    next: usize,
}

impl<'a> Recorder<'a> {
    /// At rest before the first entry.
    #[must_use]
    pub fn new(plan: &'a Plan) -> Self {
        Self {
            plan,
            plant: Plant::new(plan),
            tracker: SimulatedTracker::new(plan),
            cells: SimulatedCells::new(plan),
            next: 0,
        }
    }

    /// The plan that is simulated.
    #[must_use]
    pub fn plan(&self) -> &'a Plan {
        self.plan
    }
}

impl Iterator for Recorder<'_> {
    type Item = (Entry, Truth);

    fn next(&mut self) -> Option<Self::Item> {
        if self.next >= self.plan.samples() {
            return None;
        }
        let time = self.plan.time(self.next);
        self.next += 1;
        let (configuration, theta_l_rate) = self.plant.command(time);
        let truth = Truth::of(&self.plant, configuration, time);
        let plant = &self.plant;
        let reading = self.tracker.read(time, |taken| plant.shape(plant.command(taken).0).tip_pose());
        let tau_lc = self.cells.read(&truth.tau);
        let entry = Entry { time, configuration, theta_l_rate, delta_rate: 0.0, reading, tau_lc };
        Some((entry, truth))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.plan.samples() - self.next;
        (left, Some(left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::preset::find;

    #[test]
    fn the_truth_says_when_contact_begins_and_ends() {
        let plan = |name| Plan::new(&find(name).and_then(|preset| preset.scenario()).expect(name)).expect(name);
        assert_eq!(Recording::simulated(&plan("free")).contact_time(), None);
        let held = Recording::simulated(&plan("bench"));
        assert_eq!(held.contact_time(), Some(5.801));
        let truth = held.truth.as_ref().expect("simulated");
        assert!(truth.iter().all(|truth| truth.held.is_some() == matches!(truth.shape, Shape::Held(_))));
        assert_eq!(Recording { truth: None, ..held }.contact_time(), None);
    }
}
