//! The keys of `detection`, each in its place in the table.

use super::RUN;
use crate::scenario::keys::allowed::NOT_NEGATIVE;
use crate::scenario::keys::entry::{between, either, key, number, some_of, threshold};
use crate::scenario::keys::quantity::Quantity::{AngularSpeed, Count, Length, Moment, Ratio, Speed, Time, Word};
use crate::scenario::keys::{Access, Allowed, Key};
use crate::scenario::{Arming, Method, Xi1Rule};
use std::f64::consts::PI;

/// 10°/s.
const FAST: f64 = PI / 18.0;

pub(super) const DETECTORS: Key = key(
    "detection.detectors",
    Word,
    Allowed::Some(Method::KEYS),
    some_of!(detection.detectors, Method),
    "The detectors that judge: fcd and jfd are the paper's; fcd-consistent delays and averages the model's centrode as the sensor's is; \
     fcd-velocity compares velocities, not centrodes; cusum and glr are likelihood ratios of a contact after calibration.",
)
.illustrative();

pub(super) const XI1: Key = key(
    "detection.xi1",
    Moment,
    Allowed::Threshold,
    threshold!(detection.xi1),
    "Alarm when the joint force deviation Θ exceeds this.",
)
.usual_range(0.0, 0.1)
.illustrative();

pub(super) const XI1_RULE: Key = key(
    "detection.xi1_rule",
    Word,
    Allowed::Words(&["constant", "bound"]),
    either!(detection.xi1_rule, Xi1Rule::Constant, Xi1Rule::Bound),
    "Whether ξ1 is a constant, or k times the bound ε_c at the commanded shape.",
)
.illustrative();

pub(super) const XI1_FACTOR: Key = key(
    "detection.xi1_factor",
    Count,
    NOT_NEGATIVE,
    number!(detection.xi1_factor),
    "k, where ξ1 is k times the bound ε_c at the commanded shape. Below 1, friction alone can raise an alarm.",
)
.usual_range(0.0, 5.0)
.illustrative();

pub(super) const XI2: Key = key(
    "detection.xi2",
    Length,
    Allowed::Threshold,
    threshold!(detection.xi2),
    "Alarm when the sensor's centrode is farther than this from the model's.",
)
.usual_range(0.0, 0.020);

pub(super) const CONSISTENT: Key = key(
    "detection.consistent",
    Length,
    Allowed::Threshold,
    threshold!(detection.consistent),
    "Alarm of fcd-consistent when the sensor's centrode is farther than this from that of the commanded pose, delayed and averaged \
     in the same way.",
)
.usual_range(0.0, 0.020)
.illustrative();

pub(super) const VELOCITY: Key = key(
    "detection.velocity",
    Speed,
    Allowed::Threshold,
    threshold!(detection.velocity),
    "Alarm of fcd-velocity when the distance of the centrodes times the speed of turning exceeds this.",
)
.usual_range(0.0, 0.005)
.illustrative();

pub(super) const CUSUM: Key = key(
    "detection.cusum",
    Count,
    Allowed::Threshold,
    threshold!(detection.cusum),
    "Alarm when Page's cumulative sum of the log likelihood ratio of a contact exceeds this; natural logarithm.",
)
.usual_range(0.0, 30.0)
.illustrative();

pub(super) const GLR: Key = key(
    "detection.glr",
    Count,
    Allowed::Threshold,
    threshold!(detection.glr),
    "Alarm when the largest log likelihood ratio over places and times of a contact exceeds this; natural logarithm.",
)
.usual_range(0.0, 30.0)
.illustrative();

pub(super) const ARMED_FROM: Key = key(
    "detection.armed_from",
    Time,
    NOT_NEGATIVE,
    number!(detection.armed_from),
    "The detectors of detection.arming raise no alarm before this time.",
)
.usual_of(RUN);

pub(super) const ARMING: Key = key(
    "detection.arming",
    Word,
    Allowed::Words(&["paper", "all"]),
    either!(detection.arming, Arming::Paper, Arming::All),
    "Which detectors wait for detection.armed_from: the paper's, fcd and jfd, or all. The others can raise an alarm from the start.",
)
.illustrative();

pub(super) const MIN_SPEED: Key = key(
    "detection.min_speed",
    AngularSpeed,
    NOT_NEGATIVE,
    number!(detection.min_speed),
    "Centrodes are judged only while the end disk turns faster than this; fcd-velocity needs no such limit.",
)
.usual_range(0.0, FAST)
.illustrative();

pub(super) const RELEASE: Key = key(
    "detection.release",
    Ratio,
    between(0.0, 1.0),
    number!(detection.release),
    "An event is cleared once its value has stayed at or below this share of the threshold for detection.hold.",
)
.usual_range(0.0, 1.0)
.illustrative();

pub(super) const HOLD: Key = key(
    "detection.hold",
    Time,
    NOT_NEGATIVE,
    number!(detection.hold),
    "How long the value must stay low to clear an event; no event is shorter.",
)
.usual_range(0.0, 2.0)
.illustrative();
