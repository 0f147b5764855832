//! Where a log's frame is against {B}: given, or fitted to a stretch without contact.

mod rotation;

use super::Log;
use super::error::LogError;
use super::gather::Track;
use crate::model::orientation::{from_euler, to_euler, vee};
use crate::model::{Configuration, Mat3, Pose, Vec3};
use crate::scenario::Plan;
use crate::scenario::text::number;
use crate::sensors::tracker::{tip_from_marker, unwrapped};
use libm::{atan2, sqrt};
use rotation::best;
use serde::Serialize;

/// Where the log's frame is: `base_from_log`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Frame {
    /// Its origin in {B}, m.
    pub position: [f64; 3],
    /// Its azimuth, elevation and roll in {B}, rad.
    pub angles: [f64; 3],
}

impl Frame {
    /// Reads `x,y,z,azimuth,elevation,roll` in m and rad.
    ///
    /// # Errors
    /// When it is not six finite numbers.
    pub fn parse(text: &str) -> Result<Self, LogError> {
        let parts: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
        let parts = parts.ok().filter(|parts| parts.iter().all(|part| part.abs() < 1e6));
        match parts.as_deref() {
            Some(&[x, y, z, azimuth, elevation, roll]) => {
                Ok(Self { position: [x, y, z], angles: [azimuth, elevation, roll] })
            }
            _ => Err(LogError::file(format!("{text:?} is no frame: write x,y,z,azimuth,elevation,roll in m and rad"))),
        }
    }
}

/// What is said about the frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Setting {
    /// It is {B}.
    #[default]
    Base,
    /// It is there.
    Given(Frame),
    /// It is fitted to the readings before `detection.armed_from`, in which nothing touches.
    Fitted,
}

/// A fitted frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Fit {
    /// Where it is.
    pub frame: Frame,
    /// How the marker is turned against the scenario's mounting: azimuth, elevation and roll, rad; none where it fits.
    pub marker: Option<[f64; 3]>,
    /// How many readings it was fitted to.
    pub readings: usize,
    /// The last of them, s.
    pub until: f64,
    /// What remains of the positions, root mean square, m.
    pub position_rms: f64,
    /// What remains of the orientations, root mean square, rad; none in a log without them.
    pub orientation_rms: Option<f64>,
}

impl Fit {
    /// In a sentence without full stop.
    #[must_use]
    pub fn told(&self) -> String {
        // Zero has no sign in words.
        let plain = |value: f64| format!("{value:.2}").replace("-0.00", "0.00");
        let turn = |angles: [f64; 3]| angles.map(|angle| plain(angle.to_degrees())).join(", ");
        let position = self.frame.position.map(|part| plain(part * 1e3)).join(", ");
        let mut text = format!(
            "fitted to {} readings until {:.3} s: at ({position}) mm, turned by ({})°",
            self.readings,
            self.until,
            turn(self.frame.angles)
        );
        if let Some(marker) = self.marker {
            text += &format!(", the marker turned by ({})°", turn(marker));
        }
        text += &format!("; remaining {:.3} mm", self.position_rms * 1e3);
        if let Some(rms) = self.orientation_rms {
            text += &format!(" and {:.3}°", rms.to_degrees());
        }
        text
    }
}

/// A marker whose orientation is off by more than this, rad, is mounted in another way: 1°.
const MOUNTED: f64 = 0.017_453_292_519_943_295;
/// Most steps of fitting the frame and the marker in turn, and a step that is rounding alone.
const TURNS: usize = 200;
const SETTLED: f64 = 1e-14;
/// A rotation less well determined than this is a guess.
const DETERMINED: f64 = 1e-4;

/// The readings in {B}, and the frame when it was fitted. `commanded` is the configuration at a time on the log's clock; `start`
/// (s) is where the scenario's clock begins on it.
pub(super) fn placed(
    log: &Log,
    plan: &Plan,
    setting: &Setting,
    commanded: Option<&dyn Fn(f64) -> Option<Configuration>>,
    start: f64,
) -> Result<(Track<6>, Option<Fit>), LogError> {
    let (scenario, segment) = (plan.scenario(), plan.segment());
    let marker = tip_from_marker(scenario.tracker.mounting, scenario.motion.delta);
    let model = |at: f64| commanded.and_then(|of| of(at)).map(|at| segment.arc(at).pose(segment.length));
    let tracker = Tracker { log, marker, model: commanded.map(|_| &model as &dyn Fn(f64) -> Option<Pose>) };
    let mut all = all_placed(&[tracker], setting, (segment.length, scenario.detection.armed_from), start)?;
    Ok(all.pop().unwrap_or_default())
}

/// A tracker, and what is known of its disk.
pub(super) struct Tracker<'a> {
    /// What it read.
    pub log: &'a Log,
    /// How it is mounted: `disk_from_marker`.
    pub marker: Mat3,
    /// Where the model has its disk at a time (s) on the log's clock; none where nothing is known of the commands.
    pub model: Option<&'a dyn Fn(f64) -> Option<Pose>>,
}

/// The same of several trackers in one frame, on a robot of a length (m) that nothing touches before `armed_from` (s).
pub(super) fn all_placed(
    trackers: &[Tracker],
    setting: &Setting,
    (length, armed_from): (f64, f64),
    start: f64,
) -> Result<Vec<(Track<6>, Option<Fit>)>, LogError> {
    let logs = trackers.iter().map(|tracker| &tracker.log.readings);
    match setting {
        Setting::Base => Ok(logs.map(|readings| (readings.clone(), None)).collect()),
        Setting::Given(frame) => Ok(logs.map(|readings| (moved(readings, frame, &Mat3::identity()), None)).collect()),
        Setting::Fitted => {
            let pairs = trackers.iter().map(|tracker| pairs(tracker, armed_from + start, start));
            let pairs = pairs.collect::<Option<Vec<_>>>().ok_or_else(|| {
                LogError::file("the frame cannot be fitted without commands").or(": give them with --commands")
            })?;
            let fits = fit(&pairs, length, armed_from)?;
            Ok(logs.zip(fits).map(|(log, (fit, marker))| (moved(log, &fit.frame, &marker), Some(fit))).collect())
        }
    }
}

/// Readings in {B}, with a constant turn of the marker.
fn moved(readings: &Track<6>, frame: &Frame, marker: &Mat3) -> Track<6> {
    let (rotation, shift) = (from_euler(&frame.angles), Vec3::from(frame.position));
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
    let values = readings.values.iter().map(turn).collect();
    Track { times: readings.times.clone(), lines: readings.lines.clone(), values, file: readings.file.clone() }
}

/// A reading and where the model has the marker.
struct Pair {
    time: f64,
    position: Vec3,
    rotation: Option<Mat3>,
    model_position: Vec3,
    model_rotation: Mat3,
}

fn pairs(tracker: &Tracker, until: f64, start: f64) -> Option<Vec<Pair>> {
    let Tracker { log, marker, model } = tracker;
    let model = (*model)?;
    let oriented = log.has_orientation();
    let readings = log.readings.times.iter().zip(&log.readings.values).take_while(|(time, _)| **time < until);
    let mut before = [f64::NAN; 3];
    let pair = |(time, value): (&f64, &[f64; 6])| {
        // What the loop held is older than the command beside it.
        let position = [value[0], value[1], value[2]];
        if std::mem::replace(&mut before, position) == position {
            return None;
        }
        let [x, y, z, angles @ ..] = value;
        let tip = model(*time)?;
        Some(Pair {
            time: time - start,
            position: Vec3::new(*x, *y, *z),
            rotation: oriented.then(|| from_euler(angles)),
            model_position: tip.position,
            model_rotation: tip.rotation * marker,
        })
    };
    Some(readings.filter_map(pair).collect())
}

/// Sums over the readings of a tracker in which both rotations are linear: one pass is enough for all steps.
struct Turns([[Mat3; 3]; 3]);

impl Turns {
    fn of(pairs: &[Pair]) -> Self {
        let mut sums = [[Mat3::zeros(); 3]; 3];
        for (measured, model) in pairs.iter().filter_map(|pair| Some((pair.rotation?, pair.model_rotation))) {
            for (i, row) in sums.iter_mut().enumerate() {
                for (j, sum) in row.iter_mut().enumerate() {
                    *sum += measured.row(j).transpose() * model.row(i);
                }
            }
        }
        Self(sums)
    }

    fn rotations(&self, marker: &Mat3) -> Mat3 {
        Mat3::from_fn(|i, j| self.0[i][j].dot(marker))
    }

    fn marker(&self, rotation: &Mat3) -> Mat3 {
        best(&(0..9).map(|k| self.0[k / 3][k % 3] * rotation[(k / 3, k % 3)]).sum()).0
    }
}

/// The frame, and for each tracker the turn of its marker that is applied on the right.
fn fit(trackers: &[Vec<Pair>], length: f64, armed_from: f64) -> Result<Vec<(Fit, Mat3)>, LogError> {
    let few = |what: &str| {
        LogError::file(format!(
            "the frame cannot be fitted: before detection.armed_from = {} s, while nothing touches, {what}",
            number(armed_from)
        ))
    };
    let all = || trackers.iter().flatten();
    if all().count() < 3 {
        return Err(few("there are fewer than three readings with a command"));
    }
    let share = 1.0 / all().count() as f64;
    let centre = all().map(|pair| pair.position).sum::<Vec3>() * share;
    let model_centre = all().map(|pair| pair.model_position).sum::<Vec3>() * share;
    // Positions count in lengths of the robot, as a turn of 1 rad does.
    let scale = 1.0 / (length * length);
    let positions: Mat3 =
        all().map(|pair| (pair.model_position - model_centre) * (pair.position - centre).transpose() * scale).sum();
    let turns: Vec<Turns> = trackers.iter().map(|pairs| Turns::of(pairs)).collect();
    let rotations =
        |markers: &[Mat3]| -> Mat3 { turns.iter().zip(markers).map(|(turns, marker)| turns.rotations(marker)).sum() };
    let mut markers = vec![Mat3::identity(); trackers.len()];
    let (from_positions, certain) = best(&positions);
    let (mut rotation, gap) = best(&(positions + rotations(&markers)));
    if gap < DETERMINED {
        return Err(few("the marker does not move enough"));
    }
    let off = |pairs: &Vec<Pair>| orientation_rms(pairs, &rotation, &Mat3::identity()).is_some_and(|rms| rms > MOUNTED);
    // Positions alone tell when a marker sits as the scenario has it.
    let turned = trackers.iter().any(off) && certain > DETERMINED;
    if turned {
        rotation = from_positions;
        for _ in 0..TURNS {
            markers = turns.iter().map(|turns| turns.marker(&rotation)).collect();
            let before = std::mem::replace(&mut rotation, best(&(positions + rotations(&markers))).0);
            if (rotation - before).norm() < SETTLED {
                break;
            }
        }
    }
    let shift = model_centre - rotation * centre;
    let frame = Frame { position: shift.into(), angles: to_euler(&rotation) };
    let off = |pair: &Pair| (rotation * pair.position + shift - pair.model_position).norm_squared();
    let each = trackers.iter().zip(markers).map(|(pairs, marker)| {
        let fit = Fit {
            frame,
            marker: turned.then(|| to_euler(&marker)),
            readings: pairs.len(),
            until: pairs.last().map_or(0.0, |last| last.time),
            position_rms: sqrt(pairs.iter().map(off).sum::<f64>() * (1.0 / pairs.len().max(1) as f64)),
            orientation_rms: orientation_rms(pairs, &rotation, &marker),
        };
        (fit, marker)
    });
    Ok(each.collect())
}

/// Root mean square of the angles between the marker and where the model has it, rad.
fn orientation_rms(pairs: &[Pair], rotation: &Mat3, marker: &Mat3) -> Option<f64> {
    let mut sum = 0.0;
    if pairs.is_empty() {
        return None;
    }
    for pair in pairs {
        let rest = (rotation * pair.rotation? * marker).transpose() * pair.model_rotation;
        let angle = atan2(vee(&rest).norm(), 0.5 * (rest.trace() - 1.0));
        sum += angle * angle;
    }
    Some(sqrt(sum / pairs.len() as f64))
}
