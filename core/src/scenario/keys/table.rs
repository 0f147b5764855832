//! The table itself, in the order of the file.

mod calibration;
mod experiment;
mod prior;

use crate::scenario::keys::allowed::NOT_NEGATIVE;
use crate::scenario::keys::entry::{between, either, key, number, one_of, threshold, whole};
use crate::scenario::keys::quantity::Quantity::{AngularSpeed, Count, Length, Moment, Ratio, Time, Word};
use crate::scenario::keys::{Access, Allowed, Key};
use crate::scenario::{Averaging, EstimationKind, Scenario, Xi1Rule};
use std::f64::consts::PI;

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
    Group { path: "calibration", sentence: "How the true robot differs from its model." },
    Group { path: "filter", sentence: "The moving average over the tracker's readings." },
    Group { path: "detection", sentence: "Thresholds, and when they apply." },
    Group { path: "estimation", sentence: "How a contact is placed." },
    Group { path: "prior", sentence: "What the calibration filter takes for granted." },
];

const DIAMETERS: Allowed = between(1e-6, 1.0);
const MODULI: Allowed = between(1e6, 1e13);
/// From 0 to the end of the run.
const RUN: fn(&Scenario) -> (f64, f64) = |s| (0.0, s.motion.end);
/// 10°/s.
const FAST: f64 = PI / 18.0;

/// Everything that can be set; the keys of a group stand together.
pub const KEYS: &[Key] = &ALL;

const ALL: [Key; PARTS[0].len() + PARTS[1].len() + PARTS[2].len() + PARTS[3].len()] = joined(&PARTS);
const PARTS: [&[Key]; 4] = [experiment::KEYS, calibration::KEYS, JUDGING, prior::KEYS];

/// Several tables as one.
const fn joined<const N: usize>(parts: &[&[Key]]) -> [Key; N] {
    let mut all = [parts[0][0]; N];
    let (mut part, mut place, mut filled) = (0, 0, 0);
    while part < parts.len() {
        if place < parts[part].len() {
            all[filled] = parts[part][place];
            (place, filled) = (place + 1, filled + 1);
        } else {
            (part, place) = (part + 1, 0);
        }
    }
    all
}

/// What a recording is judged with.
const JUDGING: &[Key] = &[
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
    key(
        "detection.xi1",
        Moment,
        Allowed::Threshold,
        threshold!(detection.xi1),
        "Alarm when the joint force deviation Θ exceeds this.",
    )
    .usual_range(0.0, 0.1)
    .illustrative(),
    key(
        "detection.xi1_rule",
        Word,
        Allowed::Words(&["constant", "bound"]),
        either!(detection.xi1_rule, Xi1Rule::Constant, Xi1Rule::Bound),
        "Whether ξ1 is a constant, or k times the bound ε_c at the commanded shape.",
    )
    .illustrative(),
    key(
        "detection.xi1_factor",
        Count,
        NOT_NEGATIVE,
        number!(detection.xi1_factor),
        "k, where ξ1 is k times the bound ε_c at the commanded shape. Below 1, friction alone can raise an alarm.",
    )
    .usual_range(0.0, 5.0)
    .illustrative(),
    key(
        "detection.xi2",
        Length,
        Allowed::Threshold,
        threshold!(detection.xi2),
        "Alarm when the sensor's centrode is farther than this from the model's.",
    )
    .usual_range(0.0, 0.020),
    key(
        "detection.armed_from",
        Time,
        NOT_NEGATIVE,
        number!(detection.armed_from),
        "No alarm is raised before this time.",
    )
    .usual_of(RUN),
    key(
        "detection.min_speed",
        AngularSpeed,
        NOT_NEGATIVE,
        number!(detection.min_speed),
        "Centrodes are judged only while the end disk turns faster than this.",
    )
    .usual_range(0.0, FAST)
    .illustrative(),
    key(
        "detection.release",
        Ratio,
        between(0.0, 1.0),
        number!(detection.release),
        "An event is cleared once its value has stayed at or below this share of the threshold for detection.hold.",
    )
    .usual_range(0.0, 1.0)
    .illustrative(),
    key("detection.hold", Time, NOT_NEGATIVE, number!(detection.hold), "How long the value must stay low to clear an event; no event is shorter.")
        .usual_range(0.0, 2.0)
        .illustrative(),
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
