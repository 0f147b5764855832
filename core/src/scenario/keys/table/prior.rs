//! What a calibration filter takes for granted.

use crate::scenario::keys::allowed::Limit;
use crate::scenario::keys::entry::{between, estimated, key, number};
use crate::scenario::keys::quantity::Quantity::{Angle, Length, Ratio, Time};
use crate::scenario::keys::{Access, Allowed, Key};
use crate::scenario::plan::MAX_TIME;
use std::f64::consts::PI;

const DEGREE: f64 = PI / 180.0;

/// The keys of the group.
pub(super) const KEYS: &[Key] = &[
    key(
        "prior.translation",
        Length,
        between(0.0, 1.0),
        number!(prior.translation),
        "Standard deviation of the offset of the tracker's frame along each axis of the base; 0 believes it exactly.",
    )
    .usual_range(0.0, 0.005)
    .illustrative(),
    key(
        "prior.rotation",
        Angle,
        between(0.0, PI),
        number!(prior.rotation),
        "Standard deviation of the turn of the tracker's frame about each axis of the base; 0 believes it exactly.",
    )
    .usual_range(0.0, 5.0 * DEGREE)
    .illustrative(),
    key(
        "prior.length",
        Ratio,
        between(0.0, 1.0),
        number!(prior.length),
        "Standard deviation of the relative error of robot.length; 0 believes it exactly.",
    )
    .usual_range(0.0, 0.1)
    .illustrative(),
    key(
        "prior.bend_scale",
        Ratio,
        between(0.0, 1.0),
        number!(prior.bend_scale),
        "Standard deviation of the relative error of the bend; 0 believes it exactly.",
    )
    .usual_range(0.0, 0.1)
    .illustrative(),
    key(
        "prior.bend_offset",
        Angle,
        between(0.0, PI),
        number!(prior.bend_offset),
        "Standard deviation of the offset of the bend; 0 believes it exactly.",
    )
    .usual_range(0.0, 5.0 * DEGREE)
    .illustrative(),
    key(
        "prior.delta",
        Angle,
        between(0.0, PI),
        number!(prior.delta),
        "Standard deviation of the error of motion.delta; 0 believes it exactly.",
    )
    .usual_range(0.0, 5.0 * DEGREE)
    .illustrative(),
    key(
        "prior.latency",
        Time,
        between(0.0, 1.0),
        number!(prior.latency),
        "Standard deviation of the error of tracker.latency; 0 believes it exactly.",
    )
    .usual_range(0.0, 0.050)
    .illustrative(),
    key(
        "prior.free_bend",
        Angle,
        between(0.0, PI),
        number!(prior.free_bend),
        "Standard deviation q with which the bend of every reading is free, so that play and actuation cannot raise an alarm.",
    )
    .usual_range(0.0, 5.0 * DEGREE)
    .illustrative(),
    key(
        "prior.drift",
        Length,
        between(0.0, 1.0),
        number!(prior.drift),
        "Standard deviation of a slow error of the tracker on each coordinate; 0 reckons with none.",
    )
    .usual_range(0.0, 0.0005)
    .illustrative(),
    key(
        "prior.drift_time",
        Time,
        Allowed::Range(Limit::Beyond(0.0), Limit::At(MAX_TIME)),
        number!(prior.drift_time),
        "Correlation time of that slow error.",
    )
    .usual_range(0.1, 10.0)
    .illustrative(),
    key(
        "prior.position_noise",
        Length,
        Allowed::Estimated(Limit::At(1.0)),
        estimated!(prior.position_noise),
        "Standard deviation of the tracker's noise on each coordinate.",
    )
    .usual_range(0.0, 0.001)
    .illustrative(),
    key(
        "prior.orientation_noise",
        Angle,
        Allowed::Estimated(Limit::At(PI)),
        estimated!(prior.orientation_noise),
        "Standard deviation of the tracker's noise about each axis.",
    )
    .usual_range(0.0, DEGREE)
    .illustrative(),
    key(
        "prior.colour",
        Ratio,
        Allowed::Estimated(Limit::Beyond(1.0)),
        estimated!(prior.colour),
        "Correlation of the tracker's noise from one reading to the next; 0 takes it as white.",
    )
    .usual_range(0.0, 0.9)
    .illustrative(),
];
