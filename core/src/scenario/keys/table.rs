//! The table itself, in the order of the file.

mod calibration;
mod detection;
mod experiment;
mod prior;

use crate::scenario::keys::entry::{between, either, key, one_of, some_of, whole};
use crate::scenario::keys::quantity::Quantity::{Count, Word};
use crate::scenario::keys::{Access, Allowed, Key};
use crate::scenario::{Averaging, EstimationKind, Estimator, Kind, Scenario};

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
    Group { path: "detection", sentence: "The detectors, their thresholds, and when they apply." },
    Group { path: "estimation", sentence: "How a contact is placed." },
    Group { path: "prior", sentence: "What the calibration filter takes for granted." },
];

const DIAMETERS: Allowed = between(1e-6, 1.0);
const MODULI: Allowed = between(1e6, 1e13);
/// From 0 to the end of the run.
const RUN: fn(&Scenario) -> (f64, f64) = |s| (0.0, s.motion.end);

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
    key(
        "estimation.estimators",
        Word,
        Allowed::Some(Estimator::WORDS),
        some_of!(estimation.estimators, Estimator),
        "What places a contact after an alarm: eq24 is the paper's at that instant, settled the same one filter length later; marginal gives \
         an interval, with the errors of the calibration integrated out.",
    )
    .illustrative(),
    key(
        "estimation.plants",
        Word,
        Allowed::Some(Kind::WORDS),
        some_of!(estimation.plants, Kind),
        "Kinds of contact that the estimator marginal thinks possible, each as likely as the other beforehand.",
    )
    .illustrative(),
    key(
        "estimation.beginnings",
        Count,
        Allowed::Whole(1, 16),
        whole!(estimation.beginnings),
        "How many instants from one reading to the next the estimator marginal tries at most as the beginning of a contact.",
    )
    .usual_range(1.0, 16.0)
    .illustrative(),
];
