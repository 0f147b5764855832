//! A simulated experiment as a log that a rig would have recorded: what the loop stored, without the truth.

use crate::model::orientation::quaternion_from_euler;
use crate::record::Entry;
use crate::record::chain::ChainRecording;
use std::fmt::Write;

type Value = fn(&Entry) -> f64;

/// The columns of a CSV log. The bend stands beside θL, because π/2 − θL loses the last bits of small bends.
const CSV: [(&str, Value); 13] = [
    ("time [s]", |entry| entry.time),
    ("x [m]", |entry| entry.reading.position.x),
    ("y [m]", |entry| entry.reading.position.y),
    ("z [m]", |entry| entry.reading.position.z),
    ("azimuth [rad]", |entry| entry.reading.angles[0]),
    ("elevation [rad]", |entry| entry.reading.angles[1]),
    ("roll [rad]", |entry| entry.reading.angles[2]),
    ("theta_l [rad]", |entry| entry.configuration.theta_l()),
    ("bend [rad]", |entry| entry.configuration.bend()),
    ("delta [rad]", |entry| entry.configuration.delta()),
    ("tau_1 [N]", |entry| entry.tau_lc.x),
    ("tau_2 [N]", |entry| entry.tau_lc.y),
    ("tau_3 [N]", |entry| entry.tau_lc.z),
];

/// The header of a CSV log, with its line end.
#[must_use]
pub fn csv_header() -> String {
    CSV.map(|(name, _)| name).join(",") + "\n"
}

/// Appends a row of a CSV log: numbers that are read back to the last bit; what is not defined stays empty.
pub fn csv_row(text: &mut String, entry: &Entry) {
    for (k, (_, value)) in CSV.iter().enumerate() {
        if k > 0 {
            text.push(',');
        }
        let value = value(entry);
        if !value.is_nan() {
            // Writing to a string does not fail.
            let _ = write!(text, "{value}");
        }
    }
    text.push('\n');
}

/// The columns of a CSV log of several segments that are those of one of them, each with its number in it.
const CHAIN: [&str; 9] = [
    "x [m]",
    "y [m]",
    "z [m]",
    "azimuth [rad]",
    "elevation [rad]",
    "roll [rad]",
    "theta_l [rad]",
    "bend [rad]",
    "delta [rad]",
];
/// How many of these are readings.
const READ: usize = 6;

/// The header of a CSV log of several segments, with its line end. Disks without a tracker have no columns of readings.
#[must_use]
pub fn chain_csv_header(recording: &ChainRecording) -> String {
    let mut text = String::from("time [s]");
    for (k, readings) in recording.readings.iter().enumerate() {
        let skipped = if readings.is_some() { 0 } else { READ };
        for column in &CHAIN[skipped..] {
            // Writing to a string does not fail.
            let _ = write!(text, ",{}", column.replacen(' ', &format!("_{} ", k + 1), 1));
        }
    }
    text + "\n"
}

/// Appends the row of instant `at` of such a log: numbers that are read back to the last bit; what is not defined stays empty.
pub fn chain_csv_row(text: &mut String, recording: &ChainRecording, at: usize) {
    let _ = write!(text, "{}", recording.times[at]);
    for (told, readings) in recording.told.iter().zip(&recording.readings) {
        let configuration = told[at].configuration;
        let orders = [configuration.theta_l(), configuration.bend(), configuration.delta()];
        let read = readings.as_ref().map(|readings| readings[at]);
        let read = read.iter().flat_map(|reading| reading.position.iter().copied().chain(reading.angles));
        for value in read.chain(orders) {
            text.push(',');
            if !value.is_nan() {
                let _ = write!(text, "{value}");
            }
        }
    }
    text.push('\n');
}

/// The first line of a TUM trajectory, with its line end.
#[must_use]
pub fn tum_header() -> &'static str {
    "# timestamp tx ty tz qx qy qz qw\n"
}

/// Appends a row of a TUM trajectory: for each new reading of the tracker, not for each instant of the loop.
pub fn tum_row(text: &mut String, entry: &Entry) {
    let [w, x, y, z] = quaternion_from_euler(&entry.reading.angles);
    let position = entry.reading.position;
    let _ = writeln!(text, "{} {} {} {} {x} {y} {z} {w}", entry.time, position.x, position.y, position.z);
}
