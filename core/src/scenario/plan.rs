//! A scenario, validated once: what follows cannot fail.

use crate::model::Segment;
use crate::model::configuration::bend_from_theta_l;
use crate::scenario::{Load, Motion, Place, Scenario, Start, Threshold};
use crate::scenario::{motion, text};
use std::f64::consts::PI;
use thiserror::Error;

/// The longest run, in samples.
pub const MAX_SAMPLES: f64 = 1e8;
/// The longest filter, in samples: it holds as many readings.
pub const MAX_FILTER: u64 = 10_000_000;
/// Lengths that a segment may have, m. Beyond these bounds nothing is wrong with the mathematics, but squares of
/// the numbers leave the range of a double, and answers would be silently lost.
pub const LENGTHS: (f64, f64) = (1e-4, 100.0);
/// Radii that a pitch circle may have, m.
pub const RADII: (f64, f64) = (1e-6, 100.0);
/// Bending-plane angles go this far either way, rad: sines of larger ones mean nothing.
pub const MAX_TURN: f64 = 1e6;
/// Forces of load cells go this far, N.
const MAX_FORCE: f64 = 1e6;
/// Moments on the end disk go this far, N·m.
const MAX_MOMENT: f64 = 1e6;
/// Times go this far, s.
const MAX_TIME: f64 = 1e9;
/// The largest seed that TOML can hold.
pub const MAX_SEED: u64 = i64::MAX as u64;

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
    /// A beam at `arc_length` (m) that holds beyond `bend` (rad), whichever way the motion goes through it.
    #[must_use]
    pub fn beyond(arc_length: f64, bend: f64, motion: &Motion) -> Self {
        let toward = if bend.abs() > STRAIGHT { bend } else { motion.theta_start - motion.theta_end };
        Self { arc_length, bend, side: side(toward) }
    }

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

    /// The same with another seed, of which the bits above [`MAX_SEED`] do not count.
    #[must_use]
    pub fn with_seed(&self, seed: u64) -> Self {
        Self { scenario: Scenario { seed: seed & MAX_SEED, ..self.scenario.clone() }, ..self.clone() }
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

fn between(key: &str, value: f64, least: f64, most: f64, unit: &str) -> Result<(), ScenarioError> {
    let allowed = format!("a number from {} {unit} to {} {unit}", text::number(least), text::number(most));
    demand(value >= least && value <= most, key, value, &allowed)
}

fn not_negative(key: &str, value: f64, unit: &str) -> Result<(), ScenarioError> {
    demand(value >= 0.0 && value.is_finite(), key, value, &format!("a finite number, 0 {unit} or more"))
}

fn check_robot(scenario: &Scenario) -> Result<(), ScenarioError> {
    let robot = &scenario.robot;
    between("robot.length", robot.length, LENGTHS.0, LENGTHS.1, "m")?;
    between("robot.pitch_radius", robot.pitch_radius, RADII.0, RADII.1, "m")?;
    let mut below = 0.0;
    for (i, &disk) in robot.disks.iter().enumerate() {
        let allowed =
            format!("an arc length above the disk before it ({below} m) and at most robot.length = {} m", robot.length);
        demand(disk > below && disk <= robot.length, &format!("robot.disks[{i}]"), disk, &allowed)?;
        below = disk;
    }
    for (name, tube) in [("primary", &robot.primary), ("secondary", &robot.secondary)] {
        let key = |field: &str| format!("robot.{name}.{field}");
        between(&key("outer_diameter"), tube.outer_diameter, 1e-6, 1.0, "m")?;
        let inside = tube.inner_diameter >= 0.0 && tube.inner_diameter < tube.outer_diameter;
        let allowed = format!("from 0 to below the outer diameter, {} m", tube.outer_diameter);
        demand(inside, &key("inner_diameter"), tube.inner_diameter, &allowed)?;
        between(&key("youngs_modulus"), tube.youngs_modulus, 1e6, 1e13, "Pa")?;
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
    between("motion.delta", motion.delta, -MAX_TURN, MAX_TURN, "rad")?;
    not_negative("motion.start", motion.start, "s")?;
    let later = motion.finish > motion.start && motion.finish.is_finite();
    demand(later, "motion.finish", motion.finish, &format!("a time after motion.start = {} s", motion.start))?;
    demand(motion.end > 0.0 && motion.end.is_finite(), "motion.end", motion.end, "a finite time above 0 s")
}

fn check_sensors(scenario: &Scenario) -> Result<(), ScenarioError> {
    let tracker = &scenario.tracker;
    between("tracker.rate", tracker.rate, 1e-3, 1e6, "Hz")?;
    between("tracker.position_noise", tracker.position_noise, 0.0, 1.0, "m")?;
    between("tracker.orientation_noise", tracker.orientation_noise, 0.0, PI, "rad")?;
    between("tracker.position_resolution", tracker.position_resolution, 0.0, 1.0, "m")?;
    between("tracker.orientation_resolution", tracker.orientation_resolution, 0.0, PI, "rad")?;
    between("tracker.latency", tracker.latency, 0.0, MAX_TIME, "s")?;
    let cells = &scenario.load_cells;
    let epsilon = cells.epsilon_tau;
    demand((0.0..1.0).contains(&epsilon), "load_cells.epsilon_tau", epsilon, "from 0 to below 1")?;
    between("load_cells.noise", cells.noise, 0.0, MAX_FORCE, "N")?;
    between("load_cells.preload", cells.preload, -MAX_FORCE, MAX_FORCE, "N")?;
    check_load(&scenario.load)?;
    let detection = &scenario.detection;
    for (key, threshold, unit) in [("detection.xi1", detection.xi1, "N·m"), ("detection.xi2", detection.xi2, "m")] {
        if let Threshold::On(value) = threshold {
            let allowed = format!("a finite number, 0 {unit} or more, or \"off\"");
            demand(value >= 0.0 && value.is_finite(), key, value, &allowed)?;
        }
    }
    let factor = detection.xi1_factor;
    demand(factor >= 0.0 && factor.is_finite(), "detection.xi1_factor", factor, "a finite number, 0 or more")?;
    not_negative("detection.armed_from", detection.armed_from, "s")?;
    not_negative("detection.min_speed", detection.min_speed, "rad/s")?;
    between("detection.release", detection.release, 0.0, 1.0, "of the threshold")?;
    not_negative("detection.hold", detection.hold, "s")
}

fn check_load(load: &Load) -> Result<(), ScenarioError> {
    for (key, values, most, unit) in
        [("load.force", load.force, MAX_FORCE, "N"), ("load.moment", load.moment, MAX_MOMENT, "N·m")]
    {
        for (i, value) in values.into_iter().enumerate() {
            between(&format!("{key}[{i}]"), value, -most, most, unit)?;
        }
    }
    not_negative("load.start", load.start, "s")?;
    let later = load.finish >= load.start && load.finish.is_finite();
    demand(later, "load.finish", load.finish, &format!("a time at or after load.start = {} s", load.start))
}

fn check_contact(scenario: &Scenario) -> Result<(), ScenarioError> {
    let (contact, robot) = (&scenario.contact, &scenario.robot);
    match contact.place {
        Place::Nowhere => {}
        Place::Disk(disk) => {
            let count = robot.disks.len();
            if disk > count as u64 {
                let allowed = match count {
                    0 => "0, no contact: the robot has no spacer disks (contact.arc_length needs none)".into(),
                    _ => format!("a disk from 1 to {count}, the robot's spacer disks, or 0 for no contact"),
                };
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
    let (rate, end) = (scenario.loop_rate, scenario.motion.end);
    between("loop_rate", rate, 0.1, 1e6, "Hz")?;
    let steps = libm::floor(end * rate + 1e-6);
    if steps + 1.0 > MAX_SAMPLES {
        let allowed = format!(
            "a run of at most {MAX_SAMPLES:e} samples, at loop_rate = {} Hz so at most {} s",
            text::number(rate),
            text::number(MAX_SAMPLES / rate)
        );
        return Err(refusal("motion.end", text::number(end), allowed));
    }
    let samples = steps as usize + 1;
    let (length, most) = (scenario.filter.length, MAX_FILTER.min(samples as u64));
    if length < 1 || length > most {
        let allowed =
            format!("a whole number from 1 to {most}; the run has {samples} samples (motion.end · loop_rate)");
        return Err(refusal("filter.length", length.to_string(), allowed));
    }
    if scenario.seed > MAX_SEED {
        let allowed = format!("a whole number from 0 to {MAX_SEED}");
        return Err(refusal("seed", scenario.seed.to_string(), allowed));
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
    let motion = &scenario.motion;
    Some(match scenario.contact.start {
        // At that time the contact starts: the beam stands where the motion goes, be it toward straight.
        Start::Time(time) => PlannedContact {
            arc_length,
            bend: bend_from_theta_l(motion::command(motion, time).0),
            side: side(motion.theta_start - motion.theta_end),
        },
        Start::Bend(bend) => PlannedContact::beyond(arc_length, bend, motion),
    })
}

fn side(toward: f64) -> f64 {
    if toward < 0.0 { -1.0 } else { 1.0 }
}
