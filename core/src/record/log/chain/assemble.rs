//! From logs of all disks to a recording: everything on one clock.

use super::super::assemble::clock::{self, Ticks};
use super::super::assemble::{MAX_ENTRIES, OnClock, Orders, ordered};
use super::super::frame::{Fit, Tracker, all_placed};
use super::super::gather::Track;
use super::{ChainColumn, ChainLog, Format, joints, merged};
use crate::model::chain::free;
use crate::model::configuration::bend_from_theta_l;
use crate::model::orientation::{from_euler, vee};
use crate::model::{Configuration, Mat3, Pose, Vec3};
use crate::record::Entry;
use crate::record::chain::{ChainRecording, Told};
use crate::record::log::{Commands, Log, LogError, Rate, Report, Setup};
use crate::scenario::chain::{ChainSegment, Tracked};
use crate::scenario::text::number;
use crate::scenario::{ChainScenario, Mounting};
use crate::sensors::tracker::{tip_from_marker, unwrapped};

/// Logs of all disks as a recording, with the scenario that it is judged by.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ChainAssembled {
    /// How the first file is written.
    pub format: Format,
    /// The columns of all files.
    pub columns: Vec<ChainColumn>,
    /// The nominal scenario at the loop's rate, without contacts: nobody knows them.
    pub scenario: ChainScenario,
    /// The recording, without truth.
    pub recording: ChainRecording,
    /// What was done on the way, with what the readers had to report.
    pub report: Report,
    /// Who said how fast the loop ran.
    pub rate: Rate,
    /// Where the commands of each segment came from.
    pub commands: Vec<Commands>,
    /// What was subtracted from the log's times, s.
    pub start: f64,
    /// Where the log's frame is, as it was fitted to the readings of each tracker; none where it was not.
    pub fits: Vec<Option<Fit>>,
}

/// Puts logs of all disks on the loop's clock, as [`crate::record::log::assemble()`] does it with one.
///
/// # Errors
/// When a disk has no readings or a segment no commands, the model cannot follow a command, or the recording would be too long.
pub fn assemble(log: ChainLog, scenario: &ChainScenario, setup: &Setup) -> Result<ChainAssembled, LogError> {
    let ChainLog { format, mut logs, columns, rows, notes, .. } = log;
    joints::resolve(&mut logs, scenario)?;
    has_readings(&mut logs, scenario)?;
    let mut reports: Vec<Report> = logs.iter().map(|log| log.report.clone()).collect();
    let commands = sources(&logs, scenario, setup.commands, &mut reports)?;
    let clocked = logs.iter().max_by_key(|log| clock::times(log).map_or(0, <[f64]>::len));
    let clocked = clocked.ok_or_else(|| LogError::file("holds no row that can be used"))?;
    let times = clock::times(clocked)?;
    let scenario = match setup.rate {
        Rate::Scenario => scenario.without_contacts(),
        Rate::Log => {
            let rated = scenario.without_contacts().at_rate(clock::rate(times)?);
            rated.map_err(|error| LogError::file(format!("with this log, {error}")))?
        }
    };
    let mut shared = Report { notes, ..Report::default() };
    let start = clock::start(times[0], clocked.origin, scenario.common(), &mut shared);
    let most = setup.most.unwrap_or(MAX_ENTRIES).min(MAX_ENTRIES / logs.len());
    let values = logs.iter().map(|log| log.readings.len() + log.commands.len()).sum();
    let ticks = Ticks::new((times, values), scenario.common().loop_rate, most, &mut shared)?;
    let told = Ordered::of(&logs, &scenario, &commands, &mut reports, start)?;
    let placed = placed(&logs, &scenario, &told, setup, start)?;
    told.compare(&placed, &scenario, &mut reports);
    let clock = OnClock { ticks: &ticks, start, loop_rate: scenario.common().loop_rate, hold: setup.hold };
    let forces = Track::default();
    let each: Vec<Vec<Entry>> = (0..logs.len())
        .map(|k| {
            let motion = |time: f64| motion(&scenario.segments[k], time);
            let orders = match commands[k] {
                Commands::Motion => Orders::Motion(&motion),
                _ => Orders::Log(&told.tracks[k], scenario.segments[k].motion().delta),
            };
            clock.entries((&placed[k].0, &forces), &orders, &mut reports[k])
        })
        .collect();
    let fits: Vec<Option<Fit>> = placed.iter().map(|(_, fit)| *fit).collect();
    for (report, fit) in reports.iter_mut().zip(&fits) {
        report.notes.extend(fit.map(|fit| format!("the log's frame is {}", fit.told())));
    }
    let recording = recording(&each, &placed, &told);
    let report = merged(&reports, rows, &shared.notes);
    let start = clocked.origin + start;
    Ok(ChainAssembled { format, columns, scenario, recording, report, rate: setup.rate, commands, start, fits })
}

/// What a segment is told by its scenario at a time (s): bend and δ, and the rates of θL and δ.
fn motion(segment: &ChainSegment, time: f64) -> ([f64; 2], [f64; 2]) {
    let [(theta_l, theta_l_rate), (delta, delta_rate)] = segment.command(time);
    ([bend_from_theta_l(theta_l), delta], [theta_l_rate, delta_rate])
}

/// Refuses that a disk with a tracker has no readings, or no orientation; those of other disks are dropped.
fn has_readings(logs: &mut [Log], scenario: &ChainScenario) -> Result<(), LogError> {
    let last = logs.len() - 1;
    let carries = |k: usize| scenario.tracked == Tracked::All || k == last;
    let lacking: Vec<String> =
        (0..logs.len()).filter(|k| carries(*k) && logs[*k].readings.is_empty()).map(|k| (k + 1).to_string()).collect();
    if !lacking.is_empty() {
        let (disks, none) = if lacking.len() == 1 { ("disk", "has") } else { ("disks", "have") };
        let trackers = logs.len() - lacking.len();
        let mut what = format!("{disks} {} {none} no readings", lacking.join(", "));
        if scenario.tracked == Tracked::All && trackers > 0 {
            what += &format!(": the scenario has trackers on all {} end disks, and there are {trackers}", logs.len());
        }
        let tip = !logs[last].readings.is_empty();
        let allowed = if tip { "with tracker.disks = \"tip\", a tracker on the last end disk alone" } else { "" };
        return Err(LogError { allowed: allowed.into(), ..LogError::file(what) });
    }
    for (k, log) in logs.iter_mut().enumerate() {
        if !carries(k) && !log.readings.is_empty() {
            log.report.notes.push("readings are not used: tracker.disks = \"tip\"".into());
            log.readings = Track::default();
        }
        if carries(k) && !log.has_orientation() {
            let what = format!("disk {} has no orientation, without which no detector of a chain works", k + 1);
            return Err(LogError::file(what));
        }
    }
    Ok(())
}

/// Where the commands of each segment come from. One that rests in the scenario needs none.
fn sources(
    logs: &[Log],
    scenario: &ChainScenario,
    asked: Option<Commands>,
    reports: &mut [Report],
) -> Result<Vec<Commands>, LogError> {
    let lacking = |k: &usize| !logs[*k].has_commands() && !scenario.segments[*k].rests_after(0.0);
    if asked == Some(Commands::Motion) {
        return Ok(vec![Commands::Motion; logs.len()]);
    }
    let lacking: Vec<String> = (0..logs.len()).filter(lacking).map(|k| (k + 1).to_string()).collect();
    if !lacking.is_empty() {
        let segments = if lacking.len() == 1 { "segment" } else { "segments" };
        let what = format!(
            "holds no command of {segments} {0}: name columns theta_l_{1} or bend_{1} and delta_{1}, or q1_{1}, q2_{1} and \
             q3_{1}; or take the scenario's motion or a second file",
            lacking.join(", "),
            lacking[0]
        );
        return Err(LogError::file(what).or(", with --commands"));
    }
    let each = logs.iter().zip(reports).map(|(log, report)| {
        if log.has_commands() {
            return Commands::Log;
        }
        report.notes.push("no command: it rests, as the scenario has it".into());
        Commands::Motion
    });
    Ok(each.collect())
}

/// What every segment was told, on the log's clock.
struct Ordered<'a> {
    tracks: Vec<Track<2>>,
    commands: &'a [Commands],
    segments: Vec<ChainSegment>,
    start: f64,
}

impl<'a> Ordered<'a> {
    fn of(
        logs: &[Log],
        scenario: &ChainScenario,
        commands: &'a [Commands],
        reports: &mut [Report],
        start: f64,
    ) -> Result<Self, LogError> {
        let segments = scenario.segments.clone();
        let each = logs.iter().zip(&segments).zip(reports).enumerate().map(|(k, ((log, segment), report))| {
            let track = ordered(log, &segment.alone, report).map(|track| joined(track, segment.motion().delta));
            track.map_err(|error| LogError { what: format!("segment {}: {}", k + 1, error.what), ..error })
        });
        Ok(Self { tracks: each.collect::<Result<_, _>>()?, commands, segments, start })
    }

    /// What a segment was told at a time (s) on the log's clock; none before its first command.
    fn at(&self, segment: usize, at: f64) -> Option<Configuration> {
        if self.commands[segment] == Commands::Motion {
            let ([bend, delta], _) = motion(&self.segments[segment], at - self.start);
            return Some(Configuration::new(bend, delta));
        }
        let track = &self.tracks[segment];
        let last = track.times.partition_point(|time| *time <= at).checked_sub(1)?;
        let [bend, delta] = track.values.get(last)?;
        Some(Configuration::new(*bend, *delta))
    }

    /// θ̇L and δ̇ (rad/s) at a time on the log's clock: differences of the commands around the last one then, whose place follows `next`,
    /// not of what the loop holds from one to the next. None where commands are the scenario's motion, or too few.
    fn rates(&self, segment: usize, at: f64, next: &mut usize) -> Option<[f64; 2]> {
        let track = &self.tracks[segment];
        while track.times.get(*next).is_some_and(|time| *time <= at + LATE) {
            *next += 1;
        }
        let last = next.checked_sub(1)?;
        let (before, after) = (last.saturating_sub(1), (last + 1).min(track.len() - 1));
        let span = track.times[after] - track.times[before];
        // What has rested up to now rests now: some detectors look only at what moves.
        let rests = |part: usize| last > before && track.values[last][part] == track.values[before][part];
        let rate = |part: usize| {
            let change = track.values[after][part] - track.values[before][part];
            if rests(part) { 0.0 } else { change / span }
        };
        // θL falls as the bend grows; at rest its rate is 0, not −0.
        (after > before).then(|| [0.0 - rate(0), 0.0 + rate(1)])
    }

    /// Where the model has an end disk at a time (s), in {B}, while nothing touches.
    fn disk(&self, segment: usize, at: f64) -> Option<Pose> {
        let base = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
        (0..=segment).try_fold(base, |base, k| {
            let end = free::pose(self.segments[k].alone.segment().length, self.at(k, at)?);
            Some(Pose {
                position: base.position + base.rotation * end.position,
                rotation: base.rotation * end.rotation,
            })
        })
    }

    /// How a segment's marker is mounted in a way: `disk_from_marker`.
    fn marker(&self, segment: usize, mounting: Mounting) -> Mat3 {
        tip_from_marker(mounting, self.segments[segment].motion().delta)
    }

    /// Says where first readings are far from where the model has them: in another frame or unit, or on another mounting.
    fn compare(&self, placed: &[(Track<6>, Option<Fit>)], scenario: &ChainScenario, reports: &mut [Report]) {
        let length: f64 = self.segments.iter().map(|segment| segment.alone.segment().length).sum();
        let mounting = scenario.common().tracker.mounting;
        for (k, ((readings, _), report)) in placed.iter().zip(reports).enumerate() {
            let rows = readings.times.iter().zip(&readings.values);
            let Some((disk, [x, y, z, angles @ ..])) =
                rows.filter_map(|(time, value)| Some((self.disk(k, *time)?, value))).next()
            else {
                continue;
            };
            let far = (Vec3::new(*x, *y, *z) - disk.position).norm();
            if far > FAR * length {
                report.notes.push(format!(
                    "the first reading is {} mm from where the model has the disk: are its unit and its frame right?",
                    number((far * 1e4).round() / 10.0)
                ));
            }
            let off = |mounting| angle(&(disk.rotation * self.marker(k, mounting)), &from_euler(angles));
            let turned = off(mounting);
            if turned > TURNED {
                let other = match mounting {
                    Mounting::Aligned => (Mounting::BendingAxis, "bending-axis"),
                    Mounting::BendingAxis => (Mounting::Aligned, "aligned"),
                };
                let fits = off(other.0) < TURNED;
                let hint = if fits { format!(", but as \"{}\" has it", other.1) } else { String::new() };
                report.notes.push(format!(
                    "the first reading is turned by {:.1}° against where the marker would be as tracker.mounting has it{hint}",
                    turned.to_degrees()
                ));
            }
        }
    }
}

/// Commands without jumps of δ by whole turns; the first is that nearest to `delta` (rad).
fn joined(mut track: Track<2>, mut delta: f64) -> Track<2> {
    for [_, own] in &mut track.values {
        *own = unwrapped(*own, delta);
        delta = *own;
    }
    track
}

/// A row may be late by this much, s, and still be an instant's own: the rounding of its stamp.
const LATE: f64 = 1e-9;
/// A first reading farther from the model than this share of the robot's length is said to be far.
const FAR: f64 = 0.1;
/// And one that is turned by more than this, rad: 5°.
const TURNED: f64 = 0.087_266_462_599_716_48;

/// The angle between two orientations, rad.
fn angle(a: &Mat3, b: &Mat3) -> f64 {
    let between = a.transpose() * b;
    libm::atan2(vee(&between).norm(), 0.5 * (between.trace() - 1.0))
}

/// The readings in {B}.
fn placed(
    logs: &[Log],
    scenario: &ChainScenario,
    told: &Ordered,
    setup: &Setup,
    start: f64,
) -> Result<Vec<(Track<6>, Option<Fit>)>, LogError> {
    let models: Vec<_> = (0..logs.len()).map(|k| move |at: f64| told.disk(k, at)).collect();
    let mounting = scenario.common().tracker.mounting;
    let carrying: Vec<usize> = (0..logs.len()).filter(|k| !logs[*k].readings.is_empty()).collect();
    let trackers: Vec<Tracker> = carrying
        .iter()
        .map(|k| Tracker { log: &logs[*k], marker: told.marker(*k, mounting), model: Some(&models[*k]) })
        .collect();
    let length = scenario.segments.iter().map(|segment| segment.alone.segment().length).sum();
    let found = all_placed(&trackers, &setup.frame, (length, scenario.common().detection.armed_from), start)?;
    let mut all = vec![(Track::default(), None); logs.len()];
    for (k, found) in carrying.into_iter().zip(found) {
        all[k] = found;
    }
    Ok(all)
}

/// What the loop stored of all segments.
fn recording(each: &[Vec<Entry>], placed: &[(Track<6>, Option<Fit>)], told: &Ordered) -> ChainRecording {
    let times = each[0].iter().map(|entry| entry.time).collect();
    let orders = each.iter().enumerate().map(|(segment, entries)| {
        let mut next = 0;
        let one = |entry: &Entry| {
            let own = [entry.theta_l_rate, entry.delta_rate];
            let rates = told.rates(segment, entry.time + told.start, &mut next).unwrap_or(own);
            Told { configuration: entry.configuration, rates }
        };
        entries.iter().map(one).collect()
    });
    let orders = orders.collect();
    let readings = each
        .iter()
        .zip(placed)
        .map(|(entries, (track, _))| (!track.is_empty()).then(|| entries.iter().map(|entry| entry.reading).collect()));
    ChainRecording { times, told: orders, readings: readings.collect(), truth: None }
}
