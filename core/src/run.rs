//! A simulated experiment and what is concluded from it: at once, or sample by sample.

mod replay;
mod simulation;
mod unfinished;

pub use replay::Replay;
pub use simulation::Simulation;
pub use unfinished::Unfinished;

use crate::detect::filter::FilteredMotion;
use crate::detect::{Crossing, Detection, Event, Evidence, Judged, Judgement, Method, Settings, judge};
use crate::model::{Segment, Vec3};
use crate::plant::{Happening, PlantEvent, Shape};
use crate::record::{Entry, Recording, Truth};
use crate::scenario::keys::{Allowed, Quantity, Value};
use crate::scenario::{Plan, Refused, Scenario, ScenarioError};
use crate::sensors::tracker::Reading;

/// The longest run that [`simulate`] keeps in memory, in samples: below 1 GB. A [`Simulation`] may go on for longer.
pub const MAX_KEPT: usize = 1_000_000;

/// Everything at one instant of the loop.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
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
    pub motion: FilteredMotion,
    /// Load cell readings τ_lc, N. NaN where the statics are not defined.
    pub tau_lc: Vec3,
    /// What the methods make of it.
    pub judgement: Judgement,
}

impl Sample {
    /// What was stored, what was true, and what is known of it.
    #[must_use]
    #[inline]
    fn new(entry: &Entry, truth: Option<&Truth>, evidence: &Evidence) -> Self {
        Self {
            time: entry.time,
            theta_l: entry.configuration.theta_l(),
            theta_l_rate: entry.theta_l_rate,
            in_contact: truth.is_some_and(|truth| truth.held.is_some()),
            reading: entry.reading,
            motion: evidence.motion,
            tau_lc: entry.tau_lc,
            judgement: evidence.judgement,
        }
    }
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

/// Every channel of a run that is there whichever detectors judge, in the order of the CSV columns.
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

/// Channels of the detectors that are not the paper's, each with its detector: a CSV file has those of the detectors that judge, behind
/// the others. No fingerprint covers them.
pub const EXTRA: &[(Method, Channel)] = &[
    extra(Method::FcdConsistent, "consistent_deviation", "m", |x| x.judgement.consistent),
    extra(Method::FcdVelocity, "velocity_deviation", "m/s", |x| x.judgement.velocity),
    extra(Method::Cusum, "cusum", "1", |x| x.judgement.cusum),
    extra(Method::Glr, "glr", "1", |x| x.judgement.glr),
];

const fn extra(method: Method, name: &'static str, unit: &'static str, value: fn(&Sample) -> f64) -> (Method, Channel) {
    (method, Channel { name, unit, value })
}

/// What changed when a run was brought up to date, the first of the stages that were made anew.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Anew {
    /// Nothing.
    Nothing,
    /// Crossings and events: a threshold has moved.
    Events,
    /// What the detectors compute, too: the filter has changed, or a detector that costs something has been switched on.
    Evidence,
    /// Everything.
    Recording,
}

/// A finished experiment: what was recorded, and what is concluded.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// What was run.
    pub plan: Plan,
    /// What was stored, and what was true.
    pub recording: Recording,
    /// What is concluded.
    pub judged: Judged,
    plant_events: Vec<PlantEvent>,
}

impl Run {
    /// Runs a plan.
    #[must_use]
    pub fn new(plan: Plan) -> Self {
        Unfinished::new(plan).finish()
    }

    /// Brings the run up to date with a plan, and makes anew no more than that asks for: a threshold neither filters nor records
    /// again, a filter does not record again.
    ///
    /// ```
    /// use centrode_core::run::{Anew, simulate};
    /// use centrode_core::scenario::{Plan, Scenario, Threshold};
    ///
    /// let mut scenario = Scenario::default();
    /// let mut run = simulate(&scenario)?;
    /// scenario.detection.xi2 = Threshold::On(0.004);
    /// assert_eq!(run.update(Plan::new(&scenario)?), Anew::Events);
    /// scenario.filter.length = 200;
    /// assert_eq!(run.update(Plan::new(&scenario)?), Anew::Evidence);
    /// # Ok::<(), centrode_core::scenario::ScenarioError>(())
    /// ```
    pub fn update(&mut self, mut plan: Plan) -> Anew {
        plan.share_contacts(&self.plan);
        let (settings, before) = (Settings::of(&plan), &self.judged.settings);
        if plan == self.plan {
            return Anew::Nothing;
        }
        if self.is_recorded() {
            return self.judge_again(plan);
        }
        if !same_recording(plan.scenario(), self.plan.scenario()) {
            *self = Self::new(plan);
            return Anew::Recording;
        }
        let anew = if settings.see_as(before) { Anew::Events } else { Anew::Evidence };
        if anew == Anew::Evidence {
            self.judged = judge(&self.recording, &settings);
        } else {
            self.alarm_again(settings);
        }
        self.plan = plan;
        anew
    }

    /// Holds the evidence against other thresholds.
    fn alarm_again(&mut self, settings: Settings) {
        let empty = Judged {
            settings: settings.clone(),
            evidence: Vec::new(),
            watched: None,
            crossings: Vec::new(),
            events: Vec::new(),
        };
        self.judged = std::mem::replace(&mut self.judged, empty).again(&self.recording, settings);
    }

    /// Samples of the run, at least 1.
    #[must_use]
    pub fn len(&self) -> usize {
        self.recording.entries.len()
    }

    /// Never: a run has at least one sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.recording.entries.is_empty()
    }

    /// The sample at a place in the run.
    ///
    /// # Panics
    /// When `k` is not below [`Run::len`].
    #[must_use]
    #[inline]
    pub fn sample(&self, k: usize) -> Sample {
        Sample::new(&self.recording.entries[k], self.truth(k), &self.judged.evidence[k])
    }

    /// All samples, in order.
    pub fn samples(&self) -> impl DoubleEndedIterator<Item = Sample> + ExactSizeIterator + Clone {
        (0..self.len()).map(|k| self.sample(k))
    }

    /// Place of the last sample not after `time` (s); the first for times before the run.
    #[must_use]
    pub fn place(&self, time: f64) -> usize {
        if self.is_recorded() {
            // The entries of a log need not begin at 0, nor be evenly spaced to the last bit.
            let after = self.recording.entries.partition_point(|entry| entry.time <= time);
            return after.saturating_sub(1);
        }
        let k = (time * self.judged.settings.loop_rate * (1.0 + 4.0 * f64::EPSILON)) as usize;
        k.min(self.len() - 1)
    }

    /// The last sample not after `time` (s); the first for times before the run.
    #[must_use]
    pub fn sample_at(&self, time: f64) -> Sample {
        self.sample(self.place(time))
    }

    /// The truth at a place in the run; none when it is not known.
    #[must_use]
    #[inline]
    pub fn truth(&self, k: usize) -> Option<&Truth> {
        self.recording.truth.as_ref().and_then(|truth| truth.get(k))
    }

    /// The shape of the backbone at a place in the run; where the truth is not known, the free shape last commanded.
    ///
    /// # Panics
    /// When `k` is not below [`Run::len`].
    #[must_use]
    pub fn shape(&self, k: usize) -> Shape {
        let free = || Shape::Free(self.plan.segment().arc(self.commanded(k)));
        self.truth(k).map_or_else(free, |truth| truth.shape.clone().detailed())
    }

    /// The segment as it is: the true one of a simulation, the model's for a log.
    #[must_use]
    pub fn segment(&self) -> &Segment {
        if self.is_recorded() { self.plan.segment() } else { self.plan.true_robot().segment() }
    }

    /// Threshold crossings, in order.
    #[must_use]
    pub fn crossings(&self) -> &[Crossing] {
        &self.judged.crossings
    }

    /// Events of the detectors that judge, in the order in which they were raised.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.judged.events
    }

    /// The first event of the centrode, with the place that Eq. 24 gives it.
    #[must_use]
    pub fn detection(&self) -> Option<Detection> {
        self.judged.detection()
    }

    /// Truth: time of the first sample in contact, s.
    #[must_use]
    pub fn contact_time(&self) -> Option<f64> {
        self.plant_events.iter().find(|event| event.what == Happening::Met).map(|event| event.time)
    }

    /// Truth: what becomes of contacts, in order; empty where it is not known.
    #[must_use]
    pub fn plant_events(&self) -> &[PlantEvent] {
        &self.plant_events
    }

    /// A hash of every channel of every sample: equal bits give equal fingerprints, on every machine.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let mut hash = Fingerprint::new();
        self.samples().for_each(|sample| hash.add(&sample));
        hash.value()
    }
}

/// Whether two scenarios differ at most in how a recording of them is judged.
fn same_recording(one: &Scenario, other: &Scenario) -> bool {
    // Every field by name, so that one to come is thought of.
    let Scenario {
        loop_rate,
        seed,
        robot,
        motion,
        contact,
        tracker,
        load_cells,
        load,
        calibration,
        filter: _,
        detection: _,
        estimation: _,
        prior: _,
    } = one;
    (*loop_rate, *seed, *contact) == (other.loop_rate, other.seed, other.contact)
        && (robot, motion, tracker) == (&other.robot, &other.motion, &other.tracker)
        && (load_cells, load, calibration) == (&other.load_cells, &other.load, &other.calibration)
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

/// Runs a scenario and keeps every sample.
///
/// ```
/// let run = centrode_core::run::simulate(&centrode_core::scenario::Scenario::default())?;
/// let (contact, detection) = (run.contact_time().expect("met"), run.detection().expect("detected"));
/// assert!(contact < detection.time);
/// assert!((detection.location - 0.015).abs() < 0.002, "disk 2 is at 15 mm");
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
///
/// # Errors
/// [`ScenarioError::Value`] when the scenario is impossible, or its run is longer than [`MAX_KEPT`]: which key, which value,
/// what is allowed.
pub fn simulate(scenario: &Scenario) -> Result<Run, ScenarioError> {
    Ok(Run::new(kept(Plan::new(scenario)?)?))
}

/// A plan whose run can be kept in memory.
///
/// # Errors
/// [`ScenarioError::Value`] names `motion.end` when it is longer than [`MAX_KEPT`].
pub fn kept(plan: Plan) -> Result<Plan, ScenarioError> {
    at_most(plan, MAX_KEPT)
}

/// A plan whose run has at most so many samples.
///
/// # Errors
/// [`ScenarioError::Value`] names `motion.end` when it has more.
pub fn at_most(plan: Plan, samples: usize) -> Result<Plan, ScenarioError> {
    if plan.samples() <= samples {
        return Ok(plan);
    }
    let allowed = Allowed::Kept(samples, plan.samples());
    Err(Refused::error("motion.end", Quantity::Time, Value::Number(plan.scenario().motion.end), allowed))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::preset::find;

    #[test]
    fn an_update_makes_anew_what_it_must_and_gives_what_a_new_run_gives() {
        let bench = find("bench").and_then(|preset| preset.scenario()).expect("bench");
        let mut run = simulate(&bench).expect("valid");
        let mut scenario = bench.clone();
        type Change = fn(&mut Scenario);
        let changes: [(Anew, Change); 11] = [
            (Anew::Nothing, |_| ()),
            (Anew::Events, |s| s.detection.xi2 = crate::scenario::Threshold::On(0.005)),
            (Anew::Events, |s| s.detection.min_speed = 0.3),
            (Anew::Evidence, |s| s.filter.length = 123),
            (Anew::Events, |s| s.detection.detectors.set(Method::FcdVelocity, true)),
            (Anew::Evidence, |s| s.detection.detectors.set(Method::FcdConsistent, true)),
            (Anew::Events, |s| s.detection.detectors.set(Method::Fcd, false)),
            (Anew::Recording, |s| s.load_cells.epsilon_tau = 0.05),
            (Anew::Recording, |s| s.seed = 5),
            (Anew::Recording, |s| s.calibration.bend_offset = 0.02),
            (Anew::Events, |s| s.detection.hold = 0.0),
        ];
        for (anew, change) in changes {
            change(&mut scenario);
            assert_eq!(run.update(Plan::new(&scenario).expect("valid")), anew);
            let fresh = simulate(&scenario).expect("valid");
            assert_eq!(run.fingerprint(), fresh.fingerprint(), "{anew:?}");
            assert_eq!((run.crossings(), run.events()), (fresh.crossings(), fresh.events()), "{anew:?}");
            assert_eq!((&run.plan, run.contact_time()), (&fresh.plan, fresh.contact_time()));
        }
    }

    #[test]
    fn a_stream_gives_what_a_run_keeps() {
        let scenario = find("bench").and_then(|preset| preset.scenario()).expect("bench");
        let run = simulate(&scenario).expect("valid");
        let mut stream = Simulation::new(&run.plan);
        let mut hash = Fingerprint::new();
        stream.by_ref().for_each(|sample| hash.add(&sample));
        assert_eq!(hash.value(), run.fingerprint());
        assert_eq!((stream.events(), stream.crossings()), (run.events(), run.crossings()));
    }

    #[test]
    fn noise_around_a_threshold_is_one_event() {
        let run = find("bench").and_then(|preset| preset.scenario()).and_then(|s| simulate(&s)).expect("bench");
        let of = |detector| run.events().iter().filter(move |event| event.detector == detector);
        for &detector in Method::PAPER {
            assert_eq!(of(detector).count(), 1, "{:?}", run.events());
        }
        let centrode = of(Method::Fcd).next().expect("one");
        assert!((centrode.raised - 6.26).abs() < 0.01, "{centrode:?}");
        assert!(run.crossings().len() > 10);
        assert_eq!(run.detection().map(|detection| detection.time), Some(centrode.raised));
    }

    #[test]
    fn a_run_too_long_to_keep_is_refused_and_can_be_streamed() {
        let mut scenario = Scenario::default();
        scenario.motion.end = 90_000.0;
        let refusal = simulate(&scenario).expect_err("too long").to_string();
        assert!(refusal.contains("motion.end = 90000") && refusal.contains("90000001"), "{refusal}");
        let plan = Plan::new(&scenario).expect("possible");
        assert_eq!(Simulation::new(&plan).take(3).count(), 3);
    }

    #[test]
    fn crossings_that_are_taken_are_kept_no_longer() {
        let plan = Plan::new(&Scenario::default()).expect("possible");
        let (mut whole, mut drained) = (Simulation::new(&plan), Simulation::new(&plan));
        whole.by_ref().for_each(drop);
        let mut taken = Vec::new();
        while drained.next().is_some() {
            taken.extend(drained.take_crossings());
        }
        assert!(!taken.is_empty() && drained.crossings().is_empty());
        assert_eq!(taken, whole.crossings());
    }
}
