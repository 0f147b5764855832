//! A scenario, validated once: what follows cannot fail.

use super::scenario::{Place, Scenario, Start, Threshold};
use super::{motion, text};
use crate::model::Segment;
use crate::model::configuration::bend_from_theta_l;
use std::f64::consts::PI;
use thiserror::Error;

/// The longest run, in samples.
pub const MAX_SAMPLES: f64 = 1e8;

/// Why a scenario is refused.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScenarioError {
    /// A value that cannot be.
    #[error("{key} = {value} is not allowed: {allowed}")]
    Value {
        /// Dotted key.
        key: String,
        /// The value as written.
        value: String,
        /// What would be allowed.
        allowed: String,
    },
    /// A key that does not exist.
    #[error("unknown key {key}; known are: {known}")]
    UnknownKey {
        /// Dotted key.
        key: String,
        /// The keys that exist at this place.
        known: String,
    },
    /// Text that is not TOML.
    #[error("line {line}: {message}")]
    Syntax {
        /// Line in the text, from 1.
        line: usize,
        /// What is wrong there.
        message: String,
    },
    /// Bytes that are not text.
    #[error("not text: byte {offset} is not UTF-8; a scenario is a TOML file in UTF-8")]
    NotText {
        /// Offset of the first bad byte.
        offset: usize,
    },
    /// An override that is not `key=value`.
    #[error("{text:?} is not an override: write key=value, as in contact.disk=3")]
    Override {
        /// The text given.
        text: String,
    },
    /// A preset that does not exist.
    #[error("unknown preset {name:?}; known are: {known}")]
    UnknownPreset {
        /// The name given.
        name: String,
        /// The names that exist.
        known: String,
    },
}

/// A contact, resolved to numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedContact {
    /// Where the beam meets the backbone, arc length in m.
    pub arc_length: f64,
    /// Bend φ of the whole segment at contact, rad; the beam holds while the bend is beyond it.
    pub bend: f64,
    /// +1 when "beyond" means a larger bend, −1 when it means a smaller one.
    pub side: f64,
}

impl PlannedContact {
    /// Whether the beam holds the backbone at this commanded bend (rad).
    #[must_use]
    pub fn holds_at(&self, bend: f64) -> bool {
        self.side * (bend - self.bend) > 0.0
    }
}

/// A scenario that can be run.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    scenario: Scenario,
    segment: Segment,
    contact: Option<PlannedContact>,
    samples: usize,
}

impl Plan {
    /// Validates a scenario.
    ///
    /// # Errors
    /// The first impossible value, with its key and what is allowed.
    pub fn new(scenario: &Scenario) -> Result<Self, ScenarioError> {
        check_robot(scenario)?;
        check_motion(scenario)?;
        check_sensors(scenario)?;
        check_contact(scenario)?;
        let samples = check_length(scenario)?;
        Ok(Self {
            segment: scenario.robot.segment(),
            contact: resolve_contact(scenario),
            samples,
            scenario: scenario.clone(),
        })
    }

    /// What was asked for.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The segment.
    #[must_use]
    pub fn segment(&self) -> &Segment {
        &self.segment
    }

    /// The beam, when there is one.
    #[must_use]
    pub fn contact(&self) -> Option<&PlannedContact> {
        self.contact.as_ref()
    }

    /// Number of loop samples, from t = 0 to the end, both included.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Time of sample `k`, s.
    #[must_use]
    pub fn time(&self, k: usize) -> f64 {
        k as f64 / self.scenario.loop_rate
    }
}

/// Refuses `key = value` unless it is one of `allowed`.
fn demand(ok: bool, key: &str, value: f64, allowed: &str) -> Result<(), ScenarioError> {
    if ok { Ok(()) } else { Err(refusal(key, text::number(value), allowed)) }
}

fn refusal(key: &str, value: String, allowed: impl Into<String>) -> ScenarioError {
    ScenarioError::Value { key: key.into(), value, allowed: allowed.into() }
}

fn positive(key: &str, value: f64, most: f64, unit: &str) -> Result<(), ScenarioError> {
    demand(value > 0.0 && value <= most, key, value, &format!("a number above 0 and at most {most} {unit}"))
}

fn not_negative(key: &str, value: f64, unit: &str) -> Result<(), ScenarioError> {
    demand(value >= 0.0 && value.is_finite(), key, value, &format!("a finite number, 0 {unit} or more"))
}

fn check_robot(scenario: &Scenario) -> Result<(), ScenarioError> {
    let robot = &scenario.robot;
    positive("robot.length", robot.length, 100.0, "m")?;
    positive("robot.pitch_radius", robot.pitch_radius, 100.0, "m")?;
    let mut below = 0.0;
    for (i, &disk) in robot.disks.iter().enumerate() {
        let allowed =
            format!("an arc length above the disk before it ({below} m) and at most robot.length = {} m", robot.length);
        demand(disk > below && disk <= robot.length, &format!("robot.disks[{i}]"), disk, &allowed)?;
        below = disk;
    }
    for (name, tube) in [("primary", &robot.primary), ("secondary", &robot.secondary)] {
        let key = |field: &str| format!("robot.{name}.{field}");
        positive(&key("outer_diameter"), tube.outer_diameter, 1.0, "m")?;
        let inside = tube.inner_diameter >= 0.0 && tube.inner_diameter < tube.outer_diameter;
        let allowed = format!("from 0 to below the outer diameter, {} m", tube.outer_diameter);
        demand(inside, &key("inner_diameter"), tube.inner_diameter, &allowed)?;
        positive(&key("youngs_modulus"), tube.youngs_modulus, 1e13, "Pa")?;
    }
    Ok(())
}

/// Checks that the model holds at a bend: no full turn, and no backbone of negative length.
///
/// # Errors
/// Names `key` and its `value`.
pub fn check_bend(segment: &Segment, key: &str, value: f64, bend: f64) -> Result<(), ScenarioError> {
    demand(bend.abs() < 2.0 * PI, key, value, "a finite angle, less than one turn (2π rad) from straight")?;
    let allowed = format!(
        "a bend below length/pitch_radius = {} rad, or a secondary backbone would have no length left",
        text::number(segment.length / segment.pitch_radius)
    );
    demand(segment.shortest_backbone(bend) > 0.0, key, value, &allowed)
}

fn check_motion(scenario: &Scenario) -> Result<(), ScenarioError> {
    let motion = &scenario.motion;
    let segment = scenario.robot.segment();
    check_bend(&segment, "motion.theta_start", motion.theta_start, bend_from_theta_l(motion.theta_start))?;
    check_bend(&segment, "motion.theta_end", motion.theta_end, bend_from_theta_l(motion.theta_end))?;
    demand(motion.delta.is_finite(), "motion.delta", motion.delta, "a finite angle in rad")?;
    not_negative("motion.start", motion.start, "s")?;
    let later = motion.finish > motion.start && motion.finish.is_finite();
    demand(later, "motion.finish", motion.finish, &format!("a time after motion.start = {} s", motion.start))?;
    demand(motion.end > 0.0 && motion.end.is_finite(), "motion.end", motion.end, "a finite time above 0 s")
}

fn check_sensors(scenario: &Scenario) -> Result<(), ScenarioError> {
    let tracker = &scenario.tracker;
    positive("tracker.rate", tracker.rate, 1e9, "Hz")?;
    not_negative("tracker.position_noise", tracker.position_noise, "m")?;
    not_negative("tracker.orientation_noise", tracker.orientation_noise, "rad")?;
    not_negative("tracker.position_resolution", tracker.position_resolution, "m")?;
    not_negative("tracker.orientation_resolution", tracker.orientation_resolution, "rad")?;
    not_negative("tracker.latency", tracker.latency, "s")?;
    let cells = &scenario.load_cells;
    let epsilon = cells.epsilon_tau;
    demand((0.0..1.0).contains(&epsilon), "load_cells.epsilon_tau", epsilon, "from 0 to below 1")?;
    not_negative("load_cells.noise", cells.noise, "N")?;
    demand(cells.preload.is_finite(), "load_cells.preload", cells.preload, "a finite force in N")?;
    let detection = &scenario.detection;
    for (key, threshold, unit) in [("detection.xi1", detection.xi1, "N·m"), ("detection.xi2", detection.xi2, "m")] {
        if let Threshold::On(value) = threshold {
            let allowed = format!("a finite number, 0 {unit} or more, or \"off\"");
            demand(value >= 0.0 && value.is_finite(), key, value, &allowed)?;
        }
    }
    not_negative("detection.armed_from", detection.armed_from, "s")?;
    not_negative("detection.min_speed", detection.min_speed, "rad/s")
}

fn check_contact(scenario: &Scenario) -> Result<(), ScenarioError> {
    let (contact, robot) = (&scenario.contact, &scenario.robot);
    match contact.place {
        Place::Nowhere => {}
        Place::Disk(disk) => {
            let count = robot.disks.len();
            if disk > count as u64 {
                let allowed = format!("a disk from 1 to {count}, the robot's spacer disks, or 0 for no contact");
                return Err(refusal("contact.disk", disk.to_string(), allowed));
            }
        }
        Place::ArcLength(s) => {
            let allowed = format!("an arc length from 0 to robot.length = {} m", robot.length);
            demand((0.0..=robot.length).contains(&s), "contact.arc_length", s, &allowed)?;
        }
    }
    match contact.start {
        Start::Time(time) => not_negative("contact.time", time, "s"),
        Start::Bend(bend) => check_bend(&robot.segment(), "contact.bend", bend, bend),
    }
}

fn check_length(scenario: &Scenario) -> Result<usize, ScenarioError> {
    let rate = scenario.loop_rate;
    demand(rate > 0.0 && rate.is_finite(), "loop_rate", rate, "a finite rate above 0 Hz")?;
    let steps = libm::floor(scenario.motion.end * rate + 1e-6);
    if steps + 1.0 > MAX_SAMPLES {
        let value = format!("{} with loop_rate = {}", text::number(scenario.motion.end), text::number(rate));
        let allowed = format!("a run of at most {MAX_SAMPLES:e} samples, motion.end · loop_rate");
        return Err(refusal("motion.end", value, allowed));
    }
    let samples = steps as usize + 1;
    let length = scenario.filter.length;
    if length < 1 || length > samples as u64 {
        let allowed = format!("a whole number from 1 to the run's {samples} samples");
        return Err(refusal("filter.length", length.to_string(), allowed));
    }
    Ok(samples)
}

/// Bends nearer to straight than this are straight when the beam's side is chosen.
const STRAIGHT: f64 = 1e-12;

fn resolve_contact(scenario: &Scenario) -> Option<PlannedContact> {
    let arc_length = match scenario.contact.place {
        Place::Nowhere => return None,
        Place::Disk(disk) => *scenario.robot.disks.get(disk as usize - 1)?,
        Place::ArcLength(s) => s,
    };
    let bend = match scenario.contact.start {
        Start::Time(time) => bend_from_theta_l(motion::command(&scenario.motion, time).0),
        Start::Bend(bend) => bend,
    };
    // A beam that meets the straight segment stands on the side it is about to bend to.
    let toward = if bend.abs() > STRAIGHT { bend } else { scenario.motion.theta_start - scenario.motion.theta_end };
    let side = if toward < 0.0 { -1.0 } else { 1.0 };
    Some(PlannedContact { arc_length, bend, side })
}
