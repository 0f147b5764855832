//! Rows about calibration: how the true robot differs from its model, and what a filter takes for granted.

use crate::app::controls::control::Scale::{Linear, Log};
use crate::app::controls::control::{Choice, Control};
use crate::app::controls::table::forces::part;
use crate::app::controls::table::{key, row};

/// How the true robot and tracker differ from their model.
pub const ERRORS: &[Control] = &[
    part("calibration.frame[0]", "calibration.frame", 0, "Frame x", 2, Linear(0.05)),
    part("calibration.frame[1]", "calibration.frame", 1, "Frame y", 2, Linear(0.05)),
    part("calibration.frame[2]", "calibration.frame", 2, "Frame z", 2, Linear(0.05)),
    part("calibration.frame_turn[0]", "calibration.frame_turn", 0, "Frame turn x", 2, Linear(0.05)),
    part("calibration.frame_turn[1]", "calibration.frame_turn", 1, "Frame turn y", 2, Linear(0.05)),
    part("calibration.frame_turn[2]", "calibration.frame_turn", 2, "Frame turn z", 2, Linear(0.05)),
    row("calibration.length", "Length error", 1, Linear(0.1)),
    row("calibration.bend_scale", "Bend scale error", 1, Linear(0.1)),
    row("calibration.bend_offset", "Bend offset", 2, Linear(0.05)),
    row("calibration.delta", "Direction error", 2, Linear(0.05)),
    row("calibration.latency", "Latency error", 3, Linear(0.001)),
    row("calibration.play", "Play", 2, Linear(0.1)),
    row("calibration.drift", "Tracker drift", 3, Linear(0.005)),
    row("calibration.drift_time", "Drift time", 1, Linear(0.1)),
    row("calibration.colour", "Noise correlation", 0, Linear(1.0)),
];

/// Whether they are drawn.
pub const ERROR_CHOICES: &[Choice] =
    &[Choice { of: key("calibration.draw"), label: "Errors are", hint: "", options: &["fixed", "drawn"] }];

/// Who knows of them.
pub const ERROR_NOTE: &str =
    "Only the true robot and its tracker have these errors; the model stays the robot as set above.";

/// What a calibration filter takes for granted.
pub const PRIOR: &[Control] = &[
    row("prior.translation", "Frame offset ±", 2, Linear(0.05)),
    row("prior.rotation", "Frame turn ±", 2, Linear(0.05)),
    row("prior.length", "Length ±", 1, Linear(0.1)),
    row("prior.bend_scale", "Bend scale ±", 1, Linear(0.1)),
    row("prior.bend_offset", "Bend offset ±", 2, Linear(0.05)),
    row("prior.delta", "Direction δ ±", 2, Linear(0.05)),
    row("prior.latency", "Latency ±", 3, Linear(0.001)),
    row("prior.free_bend", "Free bend q", 2, Linear(0.1)),
    row("prior.drift", "Assumed drift", 3, Linear(0.005)),
    row("prior.drift_time", "Assumed drift time", 1, Linear(0.1)),
    row("prior.position_noise", "Assumed position noise", 3, Log(0.001)),
    row("prior.orientation_noise", "Assumed orientation noise", 3, Log(0.001)),
    row("prior.colour", "Assumed noise correlation", 0, Linear(1.0)),
];

/// What the signs and words mean.
pub const PRIOR_NOTE: &str = "± is one standard deviation before the first reading. auto estimates the noise from the readings \
    before the motion, while the robot is still.";
