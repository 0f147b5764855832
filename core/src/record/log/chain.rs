//! Logs with several trackers (docs/LOGS.md): one file that tells of all end disks, or a file for each.
//!
//! For each disk there is a [`Log`] as one tracker would have made it, read by the readers of one: columns are told apart by their
//! names, rows of the long form by a column, tools and topics by their names. [`assemble`](fn@assemble) puts them on one clock.

mod assemble;
mod columns;
mod joints;
mod mapping;
mod names;
mod read;
mod rows;
mod topics;

use super::gather::Track;
use super::report::{Count, Place, Report};
use super::{Column, Format, Log, LogError, Options};
use crate::scenario::ChainScenario;
use crate::scenario::chain::Tracked;
use serde::Serialize;

pub use assemble::{ChainAssembled, assemble};
pub use mapping::ChainMapping;
pub use read::{Read, read};

/// The names of joints as one segment (from 0) of `segments` alone would have them; those of other segments are empty.
pub(super) fn joints_of(names: Vec<String>, segment: usize, segments: usize) -> Vec<String> {
    match names::named(&names, 0, segments) {
        Ok((named, _)) => named
            .into_iter()
            .map(|named| if named.disk.is_none_or(|disk| disk == segment) { named.rest } else { String::new() })
            .collect(),
        Err(_) => names,
    }
}

/// What is known of a file with trackers before it is read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expected {
    /// How many segments there are.
    pub segments: usize,
    /// Which end disks carry trackers.
    pub tracked: Tracked,
    /// The disk (from 0) of which the whole file tells; none where that stands in it.
    pub disk: Option<usize>,
    /// Whether only its commands count.
    pub commands_alone: bool,
}

impl Expected {
    /// Of a file that says itself what of it is which disk's.
    #[must_use]
    pub fn of(scenario: &ChainScenario) -> Self {
        let segments = scenario.segments.len();
        Self { segments, tracked: scenario.tracked, disk: None, commands_alone: false }
    }

    /// The disks (from 0) that the file is to tell of.
    pub fn trackers(&self) -> std::ops::Range<usize> {
        match (self.disk, self.tracked) {
            (Some(disk), _) => disk..disk + 1,
            (None, Tracked::All) => 0..self.segments,
            (None, Tracked::Tip) => self.segments - 1..self.segments,
        }
    }

    /// The only one, where there is one alone.
    #[must_use]
    pub fn only(&self) -> Option<usize> {
        let trackers = self.trackers();
        (trackers.len() == 1).then_some(trackers.start)
    }
}

/// How a log with several trackers is read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ChainOptions {
    /// What one tracker's log has as well; of its mappings and its tool nothing is used.
    pub shared: Options,
    /// Columns that a person says what they are.
    pub mappings: Vec<ChainMapping>,
    /// The tools of an NDI file, one for each tracker from the base; none to take them in their order.
    pub tools: Vec<String>,
}

/// A column of a log with several trackers, as it was understood.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChainColumn {
    /// The segment of which it tells, from 1; null for all of them.
    pub segment: Option<usize>,
    /// What it is.
    #[serde(flatten)]
    pub column: Column,
}

/// What files with several trackers hold, before it is a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainLog {
    /// How the first file is written.
    pub format: Format,
    /// Of each segment from the base: readings of its end disk's tracker and its commands, all counted from one origin.
    pub logs: Vec<Log>,
    /// The columns of all files.
    pub columns: Vec<ChainColumn>,
    /// Rows of all files.
    pub rows: u64,
    /// What a person should know besides what each log reports.
    pub notes: Vec<String>,
    /// What its times are counted from, s; none before the first file.
    origin: Option<f64>,
}

impl ChainLog {
    /// Of so many segments, and nothing so far.
    #[must_use]
    pub fn new(segments: usize) -> Self {
        let logs = vec![Log::new(Format::Csv, Vec::new()); segments];
        let (columns, notes) = (Vec::new(), Vec::new());
        Self { format: Format::Csv, logs, columns, rows: 0, notes, origin: None }
    }

    /// Takes what a file tells; `name` is told with it where there are several.
    ///
    /// # Errors
    /// When another file told the same.
    pub fn take(&mut self, read: Read, name: &str) -> Result<(), LogError> {
        if self.origin.is_none() {
            self.format = read.format;
        }
        self.rows += read.rows;
        self.columns.extend(columns_of(&read.logs));
        self.notes
            .extend(read.notes.into_iter().map(|note| if name.is_empty() { note } else { format!("{name}: {note}") }));
        let mut logs = read.logs;
        if read.joints_either_way {
            self.notes.extend(joints::settle(&mut logs));
        }
        for (disk, log) in logs {
            let later = log.origin - *self.origin.get_or_insert(log.origin);
            self.put(disk, shifted(log, later), name)?;
        }
        Ok(())
    }

    /// Takes the commands of a second file called `name`, on the same clock, in place of its own.
    ///
    /// # Errors
    /// When it holds none.
    pub fn take_commands(&mut self, mut read: Read, name: &str) -> Result<(), LogError> {
        read.logs.retain(|(_, log)| log.has_commands());
        if read.logs.is_empty() {
            return Err(LogError::file("holds no command: name columns theta_l_1 or bend_1, or q1_1, q2_1 and q3_1"));
        }
        for log in &mut self.logs {
            (log.commands, log.joints) = (Track::default(), Track::default());
        }
        for (_, log) in &mut read.logs {
            log.readings = Track::default();
        }
        self.take(read, name)
    }

    fn put(&mut self, disk: usize, log: Log, name: &str) -> Result<(), LogError> {
        let own = &mut self.logs[disk];
        own.origin = self.origin.unwrap_or(0.0);
        let twice = |what: &str| {
            Err(LogError::file(format!("tells {what} of segment {} again: an earlier file did", disk + 1)))
        };
        if !log.readings.is_empty() {
            if !own.readings.is_empty() {
                return twice("readings");
            }
            own.readings = Track { file: name.into(), ..log.readings };
        }
        if !log.commands.is_empty() || !log.joints.is_empty() {
            if own.has_commands() {
                return twice("commands");
            }
            own.commands = Track { file: name.into(), ..log.commands };
            own.joints = Track { file: name.into(), ..log.joints };
        }
        if name.is_empty() {
            own.report = log.report;
        } else {
            own.report.merge(&log.report, name);
        }
        Ok(())
    }
}

/// A log whose times are counted from `later` (s) before its own origin.
fn shifted(mut log: Log, later: f64) -> Log {
    if later != 0.0 {
        let tracks = [&mut log.readings.times, &mut log.commands.times, &mut log.joints.times];
        tracks.into_iter().flatten().for_each(|time| *time += later);
    }
    log
}

/// The columns of a file whose logs these are, each told once.
fn columns_of(logs: &[(usize, Log)]) -> Vec<ChainColumn> {
    let mut columns: Vec<ChainColumn> = Vec::new();
    let width = logs.iter().map(|(_, log)| log.columns.len()).max().unwrap_or(0);
    // Columns of a topic or a tool are its own; those of a CSV file are the file's.
    let shared = logs.iter().all(|(_, log)| log.format == Format::Csv);
    for place in 0..width {
        let of = |(disk, log): &(usize, Log)| Some((*disk, log.columns.get(place)?.clone()));
        let all: Vec<(usize, Column)> = logs.iter().filter_map(of).collect();
        let told = |segment: Option<usize>, column: &Column| ChainColumn { segment, column: column.clone() };
        let used: Vec<&(usize, Column)> = all.iter().filter(|(_, column)| column.role.is_some()).collect();
        match used.as_slice() {
            [] => columns.extend(all.first().map(|(_, column)| told(None, column))),
            [(_, column), ..] if shared && used.len() == logs.len() && logs.len() > 1 => {
                columns.push(told(None, column))
            }
            each => columns.extend(each.iter().map(|(disk, column)| told(Some(disk + 1), column))),
        }
    }
    columns
}

/// One report of those of all segments: what is the same for all of them is told once, anything else with its segment.
fn merged(reports: &[Report], rows: u64, notes: &[String]) -> Report {
    let mut whole = Report { rows, notes: notes.to_vec(), ..Report::default() };
    let everywhere = |count: &Count| reports.iter().all(|report| report.counts.contains(count));
    let noted = |note: &String| reports.iter().filter(|report| report.notes.contains(note)).count();
    for (segment, report) in reports.iter().enumerate() {
        for note in &report.notes {
            let told = if noted(note) > 1 { note.clone() } else { format!("segment {}: {note}", segment + 1) };
            if !whole.notes.contains(&told) {
                whole.notes.push(told);
            }
        }
        for count in &report.counts {
            let mut count = count.clone();
            if !everywhere(&count) {
                let Place { name, .. } = &count.first;
                let comma = if name.is_empty() { "" } else { ", " };
                count.first.name = format!("segment {}{comma}{name}", segment + 1);
            } else if segment > 0 {
                continue;
            }
            let place = whole.counts.partition_point(|known| known.what <= count.what);
            whole.counts.insert(place, count);
        }
    }
    whole
}
