//! Where a log's frame is: given, or fitted to a stretch without contact.

use super::Log;
use super::assemble::Commands;
use super::error::LogError;
use super::gather::Track;
use super::report::Report;
use crate::model::orientation::{from_euler, to_euler};
use crate::model::{Mat3, Vec3};
use crate::scenario::Plan;
use crate::sensors::tracker::unwrapped;
use serde::Serialize;

/// Where the log's frame is against {B}: `base_from_log`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Frame {
    /// Its origin, m.
    pub position: [f64; 3],
    /// Its azimuth, elevation and roll, rad.
    pub angles: [f64; 3],
}

/// What is said about the frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Setting {
    /// It is {B}.
    #[default]
    Base,
    /// It is there.
    Given(Frame),
}

/// A fitted frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Fit {
    /// Where it is.
    pub frame: Frame,
}

/// The readings in {B}.
pub(super) fn placed(
    log: &Log,
    _plan: &Plan,
    setting: &Setting,
    _source: Commands,
    _ordered: &Track<2>,
    _start: f64,
    _report: &mut Report,
) -> Result<(Track<6>, Option<Fit>), LogError> {
    Ok(match setting {
        Setting::Base => (log.readings.clone(), None),
        Setting::Given(frame) => (moved(&log.readings, frame, &Mat3::identity()), None),
    })
}

/// Readings in {B}: `base_from_log` on the left, a constant turn of the marker on the right.
fn moved(readings: &Track<6>, frame: &Frame, marker: &Mat3) -> Track<6> {
    let rotation = from_euler(&frame.angles);
    let shift = Vec3::from(frame.position);
    let mut before: Option<[f64; 3]> = None;
    let turn = |[x, y, z, angles @ ..]: &[f64; 6]| {
        let position = rotation * Vec3::new(*x, *y, *z) + shift;
        let mut turned = to_euler(&(rotation * from_euler(angles) * marker));
        if let Some(before) = before {
            turned = std::array::from_fn(|i| unwrapped(turned[i], before[i]));
        }
        before = Some(turned);
        [position.x, position.y, position.z, turned[0], turned[1], turned[2]]
    };
    Track {
        times: readings.times.clone(),
        lines: readings.lines.clone(),
        values: readings.values.iter().map(turn).collect(),
    }
}
