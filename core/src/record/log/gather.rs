//! Values of a log as they come, row by row, into its tracks.

use super::Log;
use super::report::{Happening, Place, Report};
use super::rotation::Orientation;
use crate::sensors::tracker::unwrapped;

/// Values and when they were stamped.
#[derive(Debug, Clone, PartialEq)]
pub struct Track<const D: usize> {
    /// s, each later than the one before.
    pub times: Vec<f64>,
    /// Line or message of each, from 1.
    pub lines: Vec<u32>,
    /// The values.
    pub values: Vec<[f64; D]>,
    /// Name of the second file that holds them; empty for the log's own.
    pub file: String,
}

impl<const D: usize> Default for Track<D> {
    fn default() -> Self {
        Self { times: Vec::new(), lines: Vec::new(), values: Vec::new(), file: String::new() }
    }
}

impl<const D: usize> Track<D> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Appends a value stamped after all others.
    pub(super) fn push(&mut self, time: f64, line: u64, value: [f64; D]) {
        self.times.push(time);
        self.lines.push(u32::try_from(line).unwrap_or(u32::MAX));
        self.values.push(value);
    }
}

/// The clock of one source: it only goes forward.
#[derive(Debug, Clone, Default)]
pub struct Clock {
    last: Option<f64>,
}

impl Clock {
    /// Whether a row stamped `time` (s) counts; one that does not is counted in the report.
    pub fn takes(&mut self, time: f64, place: impl FnOnce() -> Place, report: &mut Report) -> bool {
        if time.is_nan() {
            report.add(Happening::NoTime, place(), None);
            return false;
        }
        match self.last {
            Some(last) if time < last => report.add(Happening::StepBack, place(), Some(time)),
            Some(last) if time == last => report.add(Happening::RepeatedTime, place(), Some(time)),
            _ => {
                self.last = Some(time);
                return true;
            }
        }
        false
    }
}

impl Log {
    /// Takes a reading of the tracker: position (m) and orientation.
    pub(super) fn reading(&mut self, time: f64, line: u64, position: [f64; 3], orientation: Orientation) {
        let Self { report, readings, .. } = self;
        let place = || Place::line(line);
        let angles = orientation.angles().filter(|_| position.iter().all(|part| !part.is_nan()));
        let Some((mut angles, normalised)) = angles else {
            return report.add(Happening::UndefinedReading, place(), Some(time));
        };
        if normalised {
            report.add(Happening::Normalised, place(), Some(time));
        }
        if let Some([_, _, _, before @ ..]) = readings.values.last() {
            let joined: [f64; 3] = std::array::from_fn(|i| unwrapped(angles[i], before[i]));
            if orientation != Orientation::None && joined != angles {
                report.add(Happening::Unwrapped, place(), Some(time));
                angles = joined;
            }
        }
        let [x, y, z] = position;
        let [azimuth, elevation, roll] = angles;
        let value = [x, y, z, azimuth, elevation, roll];
        let same = |before: &[f64; 6]| before.iter().zip(&value).all(|(a, b)| a == b || a.is_nan() && b.is_nan());
        if readings.values.last().is_some_and(same) {
            report.add(Happening::RepeatedReading, place(), Some(time));
        }
        readings.push(time, line, value);
    }

    /// Takes a command: bend and δ (rad); a δ that the log does not hold is NaN.
    pub(super) fn command(&mut self, time: f64, line: u64, bend: f64, delta: Option<f64>) {
        if bend.is_nan() || delta.is_some_and(f64::is_nan) {
            return self.report.add(Happening::UndefinedCommand, Place::line(line), Some(time));
        }
        self.commands.push(time, line, [bend, delta.unwrap_or(f64::NAN)]);
    }

    /// Takes commanded joint values, m.
    pub(super) fn joints(&mut self, time: f64, line: u64, joints: [f64; 3]) {
        if joints.iter().any(|joint| joint.is_nan()) {
            return self.report.add(Happening::UndefinedCommand, Place::line(line), Some(time));
        }
        self.joints.push(time, line, joints);
    }

    /// Takes what the load cells read, N.
    pub(super) fn forces(&mut self, time: f64, line: u64, forces: [f64; 3]) {
        if forces.iter().any(|force| force.is_nan()) {
            self.report.add(Happening::UndefinedForce, Place::line(line), Some(time));
        }
        self.forces.push(time, line, forces);
    }
}
