//! What a segment shows in the frame of the end disk below it.

use super::ChainSettings;
use crate::model::orientation::{from_euler, to_euler};
use crate::model::{Mat3, Pose, Vec3};
use crate::record::chain::ChainRecording;
use crate::record::{Entry, Recording};
use crate::sensors::tracker::{Reading, unwrapped};

/// The recording of a segment (from 0) as a rig with it alone would have made it. `None` where one of its end disks carries no tracker.
#[must_use]
pub fn relative(recording: &ChainRecording, settings: &ChainSettings, segment: usize) -> Option<Recording> {
    let tips = recording.readings[segment].as_ref()?;
    let bases = match segment.checked_sub(1) {
        None => None,
        Some(below) => Some((recording.readings[below].as_ref()?, settings.segments[below].clock.tip_from_marker)),
    };
    let mounting = settings.segments[segment].clock.tip_from_marker;
    let mut held: Option<(Reading, Reading, Reading)> = None;
    let entries = tips.iter().enumerate().map(|(k, tip)| {
        let reading = match bases {
            None => *tip,
            Some((bases, base_mounting)) => match held {
                Some((base, last, between)) if base == bases[k] && last == *tip => between,
                _ => {
                    let before = held.map(|(_, _, between)| between.angles);
                    let between = between((&bases[k], &base_mounting), (tip, &mounting), before);
                    held = Some((bases[k], *tip, between));
                    between
                }
            },
        };
        let told = &recording.told[segment][k];
        Entry {
            time: recording.times[k],
            configuration: told.configuration,
            theta_l_rate: told.rates[0],
            delta_rate: told.rates[1],
            reading,
            tau_lc: Vec3::repeat(f64::NAN),
        }
    });
    Some(Recording::stored(entries.collect()))
}

/// One marker's reading in the frame of another's disk, whole turns kept from reading to reading.
fn between(base: (&Reading, &Mat3), tip: (&Reading, &Mat3), before: Option<[f64; 3]>) -> Reading {
    let [base, end] = [base, tip].map(|(reading, mounting)| pose(reading, mounting));
    let into = base.rotation.transpose();
    let position = into * (end.position - base.position);
    let mut angles = to_euler(&(into * end.rotation * tip.1));
    if let Some(before) = before.filter(|angles| angles.iter().all(|angle| angle.is_finite())) {
        angles = [0, 1, 2].map(|k| unwrapped(angles[k], before[k]));
    }
    Reading { position, angles }
}

/// The disk on which a marker is mounted.
pub(super) fn pose(reading: &Reading, mounting: &Mat3) -> Pose {
    Pose { position: reading.position, rotation: from_euler(&reading.angles) * mounting.transpose() }
}
