//! The whole experiment, sample by sample or at once.

use crate::detect::detector::{Crossing, Detection, Detector, Judgement, Measurement};
use crate::detect::filter::{Motion, PoseFilter};
use crate::model::Vec3;
use crate::plant::Plant;
use crate::scenario::Scenario;
use crate::scenario::{Plan, ScenarioError};
use crate::sensors::cells::SimulatedCells;
use crate::sensors::tracker::{Reading, SimulatedTracker};

/// Everything at one instant of the loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time, s.
    pub time: f64,
    /// Commanded θL, rad.
    pub theta_l: f64,
    /// Commanded θ̇L, rad/s.
    pub theta_l_rate: f64,
    /// Truth: whether the beam holds the backbone.
    pub in_contact: bool,
    /// The tracker's reading, as held.
    pub reading: Reading,
    /// Position and motion of the end disk as the filtered tracker shows them.
    pub motion: Motion,
    /// Load cell readings τ_lc, N. NaN where the statics are not defined.
    pub tau_lc: Vec3,
    /// What the two methods make of it.
    pub judgement: Judgement,
}

/// One column of a run: what a CSV file holds, and what a fingerprint covers.
#[derive(Debug, Clone, Copy)]
pub struct Channel {
    /// Name, as in the CSV header.
    pub name: &'static str,
    /// SI unit; 1 for none.
    pub unit: &'static str,
    /// The value; NaN where it is not defined.
    pub value: fn(&Sample) -> f64,
}

macro_rules! channels {
    ($($name:literal, $unit:literal, $sample:ident => $value:expr;)*) => {
        &[$(Channel { name: $name, unit: $unit, value: |$sample| $value }),*]
    };
}

/// Every channel of a run, in the order of the CSV columns.
pub const CHANNELS: &[Channel] = channels! {
    "time", "s", x => x.time;
    "theta_l", "rad", x => x.theta_l;
    "theta_l_rate", "rad/s", x => x.theta_l_rate;
    "in_contact", "1", x => f64::from(u8::from(x.in_contact));
    "tracker_x", "m", x => x.reading.position.x;
    "tracker_y", "m", x => x.reading.position.y;
    "tracker_z", "m", x => x.reading.position.z;
    "tracker_azimuth", "rad", x => x.reading.angles[0];
    "tracker_elevation", "rad", x => x.reading.angles[1];
    "tracker_roll", "rad", x => x.reading.angles[2];
    "filtered_x", "m", x => x.motion.position.x;
    "filtered_y", "m", x => x.motion.position.y;
    "filtered_z", "m", x => x.motion.position.z;
    "filtered_vx", "m/s", x => x.motion.twist.linear.x;
    "filtered_vy", "m/s", x => x.motion.twist.linear.y;
    "filtered_vz", "m/s", x => x.motion.twist.linear.z;
    "sensor_omega_x", "rad/s", x => x.motion.twist.angular.x;
    "sensor_omega_y", "rad/s", x => x.motion.twist.angular.y;
    "sensor_omega_z", "rad/s", x => x.motion.twist.angular.z;
    "model_centrode_x", "m", x => x.judgement.model_centrode.x;
    "model_centrode_y", "m", x => x.judgement.model_centrode.y;
    "model_centrode_z", "m", x => x.judgement.model_centrode.z;
    "sensor_centrode_x", "m", x => x.judgement.sensor_centrode.x;
    "sensor_centrode_y", "m", x => x.judgement.sensor_centrode.y;
    "sensor_centrode_z", "m", x => x.judgement.sensor_centrode.z;
    "deviation", "m", x => x.judgement.deviation;
    "sensor_speed", "rad/s", x => x.judgement.speed;
    "tau_lc_1", "N", x => x.tau_lc.x;
    "tau_lc_2", "N", x => x.tau_lc.y;
    "tau_lc_3", "N", x => x.tau_lc.z;
    "residual", "N·m", x => x.judgement.residual;
    "bound_common", "N·m", x => x.judgement.common_bound;
    "bound_independent", "N·m", x => x.judgement.independent_bound;
    "bound_shape", "N·m", x => x.judgement.shape_bound;
};

/// The experiment as a stream: what it keeps is one filter length of readings, and the crossings.
#[derive(Debug, Clone)]
pub struct Simulation<'a> {
    plan: &'a Plan,
    plant: Plant<'a>,
    tracker: SimulatedTracker,
    cells: SimulatedCells,
    filter: PoseFilter,
    detector: Detector,
    crossings: Vec<Crossing>,
    contact_time: Option<f64>,
    next: usize,
}

impl<'a> Simulation<'a> {
    /// At rest before the first sample.
    #[must_use]
    pub fn new(plan: &'a Plan) -> Self {
        let scenario = plan.scenario();
        Self {
            plan,
            plant: Plant::new(plan),
            tracker: SimulatedTracker::new(plan),
            cells: SimulatedCells::new(plan),
            filter: PoseFilter::new(&scenario.filter, scenario.loop_rate),
            detector: Detector::new(*plan.segment(), scenario.detection.clone(), scenario.load_cells.epsilon_tau),
            crossings: Vec::new(),
            contact_time: None,
            next: 0,
        }
    }

    /// Threshold crossings so far, in order.
    #[must_use]
    pub fn crossings(&self) -> &[Crossing] {
        &self.crossings
    }

    /// The first detection so far.
    #[must_use]
    pub fn detection(&self) -> Option<Detection> {
        self.detector.detection()
    }

    /// Truth: time of the first sample in contact so far, s.
    #[must_use]
    pub fn contact_time(&self) -> Option<f64> {
        self.contact_time
    }
}

impl Iterator for Simulation<'_> {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        if self.next >= self.plan.samples() {
            return None;
        }
        let time = self.plan.time(self.next);
        self.next += 1;
        let (configuration, theta_l_rate) = self.plant.command(time);
        let in_contact = self.plant.in_contact(&configuration);
        if in_contact && self.contact_time.is_none() {
            self.contact_time = Some(time);
        }
        let reading = self.tracker.read(&self.plant, time);
        let motion = self.filter.push(&reading);
        let tau_lc = self.cells.read(&self.plant.joint_forces(configuration, &self.plant.wrench(time)));
        let measurement = Measurement { time, configuration, motion, tau_lc };
        let crossings = &mut self.crossings;
        let judgement = self.detector.judge(&measurement, |crossing| crossings.push(crossing));
        Some(Sample {
            time,
            theta_l: configuration.theta_l(),
            theta_l_rate,
            in_contact,
            reading,
            motion,
            tau_lc,
            judgement,
        })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.plan.samples() - self.next;
        (left, Some(left))
    }
}

/// A finished experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// What was run.
    pub plan: Plan,
    /// Every sample, at loop rate.
    pub samples: Vec<Sample>,
    /// Threshold crossings, in order.
    pub crossings: Vec<Crossing>,
    /// The first crossing of ξ2 and the place estimated from it.
    pub detection: Option<Detection>,
    /// Truth: time of the first sample in contact, s.
    pub contact_time: Option<f64>,
}

impl Run {
    /// The last sample not after `time` (s); the first for times before the run.
    #[must_use]
    pub fn sample_at(&self, time: f64) -> &Sample {
        let k = (time * self.plan.scenario().loop_rate * (1.0 + 4.0 * f64::EPSILON)) as usize;
        &self.samples[k.min(self.samples.len() - 1)]
    }

    /// A hash of every channel of every sample: equal bits give equal fingerprints, on every machine.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let mut hash = Fingerprint::new();
        self.samples.iter().for_each(|sample| hash.add(sample));
        hash.value()
    }
}

/// A running hash over the channels' bits, a word at a time (FNV's multiplier with a rotation, so that high bits
/// reach low ones). Every NaN counts as the same one, for its bits mean nothing.
#[derive(Debug, Clone)]
struct Fingerprint(u64);

impl Fingerprint {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, sample: &Sample) {
        for channel in CHANNELS {
            let value = (channel.value)(sample);
            let bits = if value.is_nan() { u64::MAX } else { value.to_bits() };
            self.0 = (self.0.rotate_left(23) ^ bits).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn value(&self) -> u64 {
        self.0
    }
}

/// Runs a scenario.
///
/// # Errors
/// When the scenario is impossible: which key, which value, what is allowed.
pub fn simulate(scenario: &Scenario) -> Result<Run, ScenarioError> {
    let plan = Plan::new(scenario)?;
    let mut simulation = Simulation::new(&plan);
    let mut samples = Vec::with_capacity(plan.samples());
    samples.extend(simulation.by_ref());
    let (detection, contact_time) = (simulation.detection(), simulation.contact_time());
    let crossings = std::mem::take(&mut simulation.crossings);
    Ok(Run { samples, crossings, detection, contact_time, plan })
}
