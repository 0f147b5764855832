//! How the true robot differs from its model.

use crate::scenario::Draw;
use crate::scenario::keys::allowed::Limit;
use crate::scenario::keys::entry::{between, either, key, number, vector};
use crate::scenario::keys::quantity::Quantity::{Angle, Length, Ratio, Time, Word};
use crate::scenario::keys::{Access, Allowed, Key};
use crate::scenario::plan::MAX_TIME;
use std::f64::consts::{PI, TAU};

/// 3°.
const TILT: f64 = PI / 60.0;

/// The keys of the group.
pub(super) const KEYS: &[Key] = &[
    key(
        "calibration.draw",
        Word,
        Allowed::Words(&["fixed", "drawn"]),
        either!(calibration.draw, Draw::Fixed, Draw::Drawn),
        "Whether frame, frame_turn, length, bend_scale, bend_offset, delta and latency are the errors themselves, or standard deviations \
         of normal errors that are drawn from the seed, anew in each repeat of a study, and never exceed four of them.",
    )
    .illustrative(),
    key(
        "calibration.frame",
        Length,
        Allowed::Vector(1.0),
        vector!(calibration.frame),
        "How far the tracker's frame is off: added to each position, along the axes of the base.",
    )
    .usual_range(-0.003, 0.003)
    .illustrative(),
    key(
        "calibration.frame_turn",
        Angle,
        Allowed::Vector(PI),
        vector!(calibration.frame_turn),
        "How far the tracker's frame is turned, as a rotation vector: it turns positions about the base, and orientations.",
    )
    .usual_range(-TILT, TILT)
    .illustrative(),
    key(
        "calibration.length",
        Ratio,
        between(-0.5, 0.5),
        number!(calibration.length),
        "Relative error of robot.length: the true backbone is longer by this share of it. Disks and contact keep their arc lengths.",
    )
    .usual_range(-0.05, 0.05)
    .illustrative(),
    key(
        "calibration.bend_scale",
        Ratio,
        between(-0.5, 0.5),
        number!(calibration.bend_scale),
        "Relative error of the bend: the true bend is larger than the commanded one by this share of it.",
    )
    .usual_range(-0.05, 0.05)
    .illustrative(),
    key(
        "calibration.bend_offset",
        Angle,
        between(-PI, PI),
        number!(calibration.bend_offset),
        "Added to the true bend.",
    )
    .usual_range(-TILT, TILT)
    .illustrative(),
    key(
        "calibration.delta",
        Angle,
        between(-PI, PI),
        number!(calibration.delta),
        "Added to the direction in which the true robot bends; the marker is mounted for motion.delta.",
    )
    .usual_range(-TILT, TILT)
    .illustrative(),
    key(
        "calibration.latency",
        Time,
        between(-1.0, 1.0),
        number!(calibration.latency),
        "How much older a reading is than tracker.latency says; no reading is younger than 0 s.",
    )
    .usual_range(0.0, 0.050)
    .illustrative(),
    key(
        "calibration.play",
        Angle,
        between(0.0, TAU),
        number!(calibration.play),
        "Backlash of the bend: the true bend stays until the command has moved by this, then follows behind it by this.",
    )
    .usual_range(0.0, 5.0 * PI / 180.0)
    .illustrative(),
    key(
        "calibration.drift",
        Length,
        between(0.0, 1.0),
        number!(calibration.drift),
        "Standard deviation of a slow error of the tracker on each coordinate (a Gauss–Markov process), drawn from the seed.",
    )
    .usual_range(0.0, 0.0005)
    .illustrative(),
    key(
        "calibration.drift_time",
        Time,
        Allowed::Range(Limit::Beyond(0.0), Limit::At(MAX_TIME)),
        number!(calibration.drift_time),
        "Correlation time of that slow error.",
    )
    .usual_range(0.1, 10.0)
    .illustrative(),
    key(
        "calibration.colour",
        Ratio,
        Allowed::Range(Limit::At(0.0), Limit::Beyond(1.0)),
        number!(calibration.colour),
        "Correlation of the tracker's noise from one reading to the next, at the same standard deviation; 0 means white noise.",
    )
    .usual_range(0.0, 0.9)
    .illustrative(),
];
