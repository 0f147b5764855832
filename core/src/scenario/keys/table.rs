//! The table itself, in the order of the file.

use crate::scenario::keys::allowed::{Limit, NOT_NEGATIVE};
use crate::scenario::keys::entry::{at_most_key, below_key, between, either, key, number, one_of, vector, whole};
use crate::scenario::keys::quantity::Quantity::{
    Angle, Count, Force, Frequency, Length, Modulus, Moment, Ratio, Time, Word,
};
use crate::scenario::keys::{Access, Allowed, Key};
use crate::scenario::plan::{LENGTHS, MAX_FORCE, MAX_MOMENT, MAX_SEED, MAX_TIME, MAX_TURN, RADII};
use crate::scenario::{Averaging, CellErrors, ContactKind, EstimationKind, Mounting, Place, Scenario, Start};
use std::f64::consts::{FRAC_PI_2, PI};

mod detection;

/// Keys that belong together.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// Dotted path.
    pub path: &'static str,
    /// What it is.
    pub sentence: &'static str,
}

/// All groups, each before the keys in it.
pub const GROUPS: &[Group] = &[
    Group { path: "robot", sentence: "The segment." },
    Group { path: "robot.primary", sentence: "The tube of the central (primary) backbone." },
    Group { path: "robot.secondary", sentence: "The tube of each of the three other backbones." },
    Group { path: "motion", sentence: "The commanded motion: a fifth-order polynomial from rest to rest." },
    Group { path: "contact", sentence: "A fixed beam that the backbone meets." },
    Group { path: "tracker", sentence: "The tracker on the end disk." },
    Group { path: "load_cells", sentence: "The load cells on the secondary backbones." },
    Group { path: "load", sentence: "A wrench on the end disk, which ramps up and then stays constant." },
    Group { path: "filter", sentence: "The moving average over the tracker's readings." },
    Group { path: "detection", sentence: "The detectors, their thresholds, and when they apply." },
    Group { path: "estimation", sentence: "How a contact is placed." },
];

const DIAMETERS: Allowed = between(1e-6, 1.0);
const MODULI: Allowed = between(1e6, 1e13);
/// From 0 to the end of the run.
const RUN: fn(&Scenario) -> (f64, f64) = |s| (0.0, s.motion.end);

/// Everything that can be set; the keys of a group stand together.
pub const KEYS: &[Key] = &[
    key(
        "loop_rate",
        Frequency,
        between(0.1, 1e6),
        number!(loop_rate),
        "Rate of the control loop: readings are taken, filtered and judged this often.",
    ),
    key(
        "seed",
        Count,
        Allowed::Whole(0, MAX_SEED),
        whole!(seed),
        "Seed of all noise: the same number gives the same run again, another number gives different noise.",
    )
    .usual_range(0.0, 99.0)
    .illustrative(),
    key(
        "robot.length",
        Length,
        between(LENGTHS.0, LENGTHS.1),
        number!(robot.length),
        "Length of the primary backbone, from base disk to end disk.",
    )
    .usual_of(|s| {
        let low = s.robot.disks.last().copied().unwrap_or(0.010);
        (low, (2.0 * low).max(0.100))
    }),
    key(
        "robot.pitch_radius",
        Length,
        between(RADII.0, RADII.1),
        number!(robot.pitch_radius),
        "Radius of the pitch circle, on which the three secondary backbones lie.",
    )
    .usual_range(0.0005, 0.008)
    .illustrative(),
    key(
        "robot.disks",
        Length,
        Allowed::Disks,
        Access::List(|s| &s.robot.disks, |s, disks| s.robot.disks = disks),
        "Arc lengths of the spacer disks, from the base up.",
    ),
    key(
        "robot.primary.outer_diameter",
        Length,
        DIAMETERS,
        number!(robot.primary.outer_diameter),
        "Outer diameter of the central tube.",
    )
    .illustrative(),
    key(
        "robot.primary.inner_diameter",
        Length,
        below_key("robot.primary.outer_diameter"),
        number!(robot.primary.inner_diameter),
        "Inner diameter of the central tube; 0 means a solid wire.",
    )
    .illustrative(),
    key(
        "robot.primary.youngs_modulus",
        Modulus,
        MODULI,
        number!(robot.primary.youngs_modulus),
        "Modulus of elasticity of the central tube.",
    )
    .usual_range(1e9, 120e9)
    .illustrative(),
    key(
        "robot.secondary.outer_diameter",
        Length,
        DIAMETERS,
        number!(robot.secondary.outer_diameter),
        "Outer diameter of each of the three outer tubes.",
    )
    .illustrative(),
    key(
        "robot.secondary.inner_diameter",
        Length,
        below_key("robot.secondary.outer_diameter"),
        number!(robot.secondary.inner_diameter),
        "Inner diameter of each of the three outer tubes; 0 means a solid wire.",
    )
    .illustrative(),
    key(
        "robot.secondary.youngs_modulus",
        Modulus,
        MODULI,
        number!(robot.secondary.youngs_modulus),
        "Modulus of elasticity of each of the three outer tubes.",
    )
    .usual_range(1e9, 120e9)
    .illustrative(),
    key(
        "motion.theta_start",
        Angle,
        Allowed::Bend { theta_l: true },
        number!(motion.theta_start),
        "Tangent angle of the tip before the motion; a quarter turn (90°, π/2) is straight.",
    )
    .usual_range(-FRAC_PI_2, PI),
    key(
        "motion.theta_end",
        Angle,
        Allowed::Bend { theta_l: true },
        number!(motion.theta_end),
        "Tangent angle of the tip after the motion.",
    )
    .usual_range(-FRAC_PI_2, PI),
    key(
        "motion.delta",
        Angle,
        between(-MAX_TURN, MAX_TURN),
        number!(motion.delta),
        "Direction of the bending plane about the straight backbone.",
    )
    .usual_range(-PI, PI)
    .illustrative(),
    key("motion.start", Time, NOT_NEGATIVE, number!(motion.start), "When the motion starts; the robot is at rest before.")
        // A step at least remains for the motion.
        .usual_of(|s| (0.0, (s.motion.finish - 0.05).max(s.motion.finish / 2.0))),
    key(
        "motion.finish",
        Time,
        Allowed::Range(Limit::BeyondKey("motion.start", None), Limit::None),
        number!(motion.finish),
        "When the motion ends; the robot is at rest afterwards.",
    )
    .usual_of(|s| (s.motion.start + 0.05, s.motion.end.max(s.motion.start + 0.1))),
    key("motion.end", Time, Allowed::RunEnd(None), number!(motion.end), "When the run ends.")
        .usual_of(|s| {
            // The filter is not longer than the run.
            let low = (s.filter.length as f64 / s.loop_rate).max(1.0);
            (low, (low + 1.0).max(20.0))
        })
        .illustrative(),
    key(
        "contact.disk",
        Count,
        Allowed::Disk(None),
        Access::Whole(
            |s| match s.contact.place {
                Place::Nowhere => Some(0),
                Place::Disk(disk) => Some(disk.get()),
                Place::ArcLength(_) => None,
            },
            |s, disk| s.contact.place = Place::disk(disk),
        ),
        "The disk at which the beam meets the backbone, counted from 1 at the base; 0 means no contact.",
    )
    .usual_of(|s| (0.0, s.robot.disks.len() as f64)),
    key(
        "contact.arc_length",
        Length,
        at_most_key("robot.length"),
        Access::Number(
            |s| match s.contact.place {
                Place::ArcLength(at) => Some(at),
                _ => None,
            },
            |s, at| s.contact.place = Place::ArcLength(at),
        ),
        "Arc length at which the beam meets the backbone.",
    )
    .instead_of("contact.disk", 0.015),
    key(
        "contact.time",
        Time,
        NOT_NEGATIVE,
        Access::Number(
            |s| match s.contact.start {
                Start::Time(time) => Some(time),
                Start::Bend(_) => None,
            },
            |s, time| s.contact.start = Start::Time(time),
        ),
        "When the backbone reaches the beam: contact starts at the bend commanded then.",
    )
    .usual_of(RUN)
    .illustrative(),
    key(
        "contact.bend",
        Angle,
        Allowed::Bend { theta_l: false },
        Access::Number(
            |s| match s.contact.start {
                Start::Bend(bend) => Some(bend),
                Start::Time(_) => None,
            },
            |s, bend| s.contact.start = Start::Bend(bend),
        ),
        "Bend at which the backbone reaches the beam; 0 means straight.",
    )
    .instead_of("contact.time", 0.98),
    key(
        "contact.kind",
        Word,
        Allowed::Words(&["clamp", "plane", "cylinder"]),
        one_of!(contact.kind, ContactKind::ALL),
        "How the beam holds the backbone: clamp holds position and slope, as in the paper; plane is a flat side against a disk, \
         cylinder a round beam along which the backbone slides, both without friction.",
    ),
    key(
        "contact.rounding",
        Length,
        at_most_key("robot.length"),
        number!(contact.rounding),
        "Radius of a round beam and of the backbone's envelope together; used by the cylinder.",
    )
    .usual_range(0.0, 0.01)
    .illustrative(),
    key(
        "tracker.rate",
        Frequency,
        between(1e-3, 1e6),
        number!(tracker.rate),
        "How often the tracker delivers a new reading; between two readings the loop uses the last one.",
    )
    .usual_range(10.0, 500.0),
    key(
        "tracker.position_noise",
        Length,
        between(0.0, 1.0),
        number!(tracker.position_noise),
        "Standard deviation of the tracker's white noise on each coordinate.",
    )
    .usual_range(0.0, 0.001)
    .illustrative(),
    key(
        "tracker.orientation_noise",
        Angle,
        between(0.0, PI),
        number!(tracker.orientation_noise),
        "Standard deviation of the white noise that turns the marker about each axis of the base.",
    )
    .usual_range(0.0, PI / 180.0)
    .illustrative(),
    key(
        "tracker.position_resolution",
        Length,
        between(0.0, 1.0),
        number!(tracker.position_resolution),
        "Coordinates are rounded to multiples of this; 0 means no rounding.",
    )
    .usual_range(0.0, 0.001)
    .illustrative(),
    key(
        "tracker.orientation_resolution",
        Angle,
        between(0.0, PI),
        number!(tracker.orientation_resolution),
        "Angles are rounded to multiples of this; 0 means no rounding.",
    )
    .usual_range(0.0, PI / 180.0)
    .illustrative(),
    key(
        "tracker.latency",
        Time,
        between(0.0, MAX_TIME),
        number!(tracker.latency),
        "Age of a reading when it arrives.",
    )
    .usual_range(0.0, 0.2)
    .illustrative(),
    key(
        "tracker.mounting",
        Word,
        Allowed::Words(&["bending-axis", "aligned"]),
        either!(tracker.mounting, Mounting::BendingAxis, Mounting::Aligned),
        "How the marker is mounted: with its x axis along the bending axis, or aligned with the end disk, where its angles are singular at a bend of 90°.",
    )
    .illustrative(),
    key(
        "load_cells.epsilon_tau",
        Ratio,
        Allowed::Range(Limit::At(0.0), Limit::Beyond(1.0)),
        number!(load_cells.epsilon_tau),
        "Relative error of the three load cells, which sets the bound ε_c; friction counts as part of it.",
    )
    .usual_range(0.0, 0.5),
    key(
        "load_cells.errors",
        Word,
        Allowed::Words(&["common", "independent"]),
        either!(load_cells.errors, CellErrors::Common, CellErrors::Independent),
        "Whether all three cells have the error ε_τ, or each its own error within ±ε_τ, drawn from the seed.",
    ),
    key(
        "load_cells.noise",
        Force,
        between(0.0, MAX_FORCE),
        number!(load_cells.noise),
        "Standard deviation of white noise on each load cell.",
    )
    .usual_range(0.0, 5.0)
    .illustrative(),
    key(
        "load_cells.preload",
        Force,
        between(-MAX_FORCE, MAX_FORCE),
        number!(load_cells.preload),
        "The same force added to all three secondary backbones.",
    )
    .usual_range(0.0, 50.0)
    .illustrative(),
    key(
        "load.force",
        Force,
        Allowed::Vector(MAX_FORCE),
        vector!(load.force),
        "Force at the end disk's centre, along the axes of the base.",
    )
    .usual_range(-5.0, 5.0)
    .illustrative(),
    key(
        "load.moment",
        Moment,
        Allowed::Vector(MAX_MOMENT),
        vector!(load.moment),
        "Moment on the end disk, along the axes of the base.",
    )
    .usual_range(-0.05, 0.05)
    .illustrative(),
    key("load.start", Time, NOT_NEGATIVE, number!(load.start), "From this time on the load grows linearly.")
        .usual_of(|s| (0.0, s.load.finish))
        .illustrative(),
    key(
        "load.finish",
        Time,
        Allowed::Range(Limit::Key("load.start", None), Limit::None),
        number!(load.finish),
        "From this time on the load has its full value.",
    )
    .usual_of(|s| (s.load.start, s.motion.end.max(s.load.start + 0.1)))
    .illustrative(),
    key(
        "filter.length",
        Count,
        Allowed::FilterLength(None),
        whole!(filter.length),
        "Readings in the moving average, one per loop step. A longer average has less noise but reacts later; 1 means no filter.",
    )
    .usual_of(|s| (1.0, libm::floor(s.motion.end * s.loop_rate).clamp(2.0, 2000.0))),
    key(
        "filter.averaging",
        Word,
        Allowed::Words(&["readings", "rotations"]),
        either!(filter.averaging, Averaging::Readings, Averaging::Rotations),
        "Average the six readings one by one, as in the paper, or the rotations themselves.",
    ),
    detection::DETECTORS,
    detection::XI1,
    detection::XI1_RULE,
    detection::XI1_FACTOR,
    detection::XI2,
    detection::CONSISTENT,
    detection::VELOCITY,
    detection::CUSUM,
    detection::GLR,
    detection::ARMED_FROM,
    detection::ARMING,
    detection::MIN_SPEED,
    detection::RELEASE,
    detection::HOLD,
    key(
        "estimation.kind",
        Word,
        Allowed::Words(&["clamp", "plane", "as-simulated"]),
        one_of!(estimation.kind, EstimationKind::ALL),
        "What Eq. 24 takes the contact to be: clamp is a beam that holds position and slope, as in the paper; plane is one that only \
         touches; as-simulated is what contact.kind says (a plane for a cylinder), with the bend at which the contact truly began; for a log, \
         with that of the scenario's contact.",
    ),
];
