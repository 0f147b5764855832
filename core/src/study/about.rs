//! How a log was read, told.

use crate::detect::outlook::{Outlook, outlooks};
use crate::record::log::assemble::Assembled;
use crate::record::log::chain::{ChainAssembled, ChainColumn};
use crate::record::log::frame::Fit;
use crate::record::log::{Column, Commands, Format, Log, Origin, Rate, Report};
use crate::scenario::text::number;
use serde::Serialize;
use std::io::Write;

/// How a log was read.
#[derive(Debug, Clone, Serialize)]
pub struct About {
    /// How it is written.
    pub format: Format,
    /// Its columns, as they were understood.
    pub columns: Vec<Column>,
    /// Rows read, of both files when there are two.
    pub rows: u64,
    /// Rate of the loop, Hz.
    pub loop_rate: f64,
    /// Who said so.
    pub loop_rate_from: Rate,
    /// Where the commands came from.
    pub commands: Commands,
    /// What was subtracted from the log's times, s.
    pub start: f64,
    /// Where its frame is against {B}, when it was fitted.
    pub frame: Option<Fit>,
    /// Which detectors work, and why not.
    pub detectors: Vec<Outlook>,
    /// What was done with its rows.
    pub report: Report,
}

/// How logs of several segments were read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChainAbout {
    /// How the first file is written.
    pub format: Format,
    /// The columns of all files, as they were understood.
    pub columns: Vec<ChainColumn>,
    /// Rows read, of all files.
    pub rows: u64,
    /// Rate of the loop, Hz.
    pub loop_rate: f64,
    /// Who said so.
    pub loop_rate_from: Rate,
    /// Where the commands of each segment came from.
    pub commands: Vec<Commands>,
    /// What was subtracted from the log's times, s.
    pub start: f64,
    /// Where its frame is against {B}, and how each marker sits, when that was fitted; null for a disk without a tracker.
    pub frames: Option<Vec<Option<Fit>>>,
    /// What was done with its rows.
    pub report: Report,
}

impl ChainAbout {
    /// Of a recording and how it came about.
    #[must_use]
    pub fn new(assembled: &ChainAssembled) -> Self {
        let ChainAssembled { format, columns, scenario, report, rate, commands, start, fits, .. } = assembled;
        Self {
            format: *format,
            columns: columns.clone(),
            rows: report.rows,
            loop_rate: scenario.common().loop_rate,
            loop_rate_from: *rate,
            commands: commands.clone(),
            start: *start,
            frames: fits.iter().any(Option::is_some).then(|| fits.clone()),
            report: report.clone(),
        }
    }

    /// Above the table of a run.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn table(&self, out: &mut impl Write) -> std::io::Result<()> {
        writeln!(out, "log         {}, {} rows", self.format.name(), self.rows)?;
        let of = |segment: Option<usize>| {
            let own = self.columns.iter().filter(move |own| own.segment == segment);
            // A name that says what it is but for its number needs no explanation.
            let plain = |column: &Column| column.origin == Origin::Named && column.unit_given && column.role.is_some();
            own.filter_map(|own| if plain(&own.column) { Some(own.column.header.clone()) } else { own.column.told() })
                .collect::<Vec<_>>()
                .join(", ")
        };
        let lines = std::iter::once(None).chain((1..=self.commands.len()).map(Some));
        for (segment, told) in lines.map(|segment| (segment, of(segment))).filter(|(_, told)| !told.is_empty()) {
            let name = segment.map_or_else(|| "columns".into(), |segment| format!("segment {segment}"));
            writeln!(out, "{name:<11} {told}")?;
        }
        let unused: Vec<&str> =
            self.columns.iter().filter(|own| own.column.role.is_none()).map(|own| own.column.header.as_str()).collect();
        if !unused.is_empty() {
            writeln!(out, "not used    {}", unused.join(", "))?;
        }
        writeln!(out, "loop        {} Hz: {}", number(self.loop_rate), self.loop_rate_from.told())?;
        let log = self.commands.contains(&Commands::Log);
        writeln!(out, "commands    {}", if log { Commands::Log.told() } else { Commands::Motion.told() })?;
        for sentence in self.report.sentences() {
            writeln!(out, "note        {sentence}")?;
        }
        writeln!(out)
    }
}

impl About {
    /// Of a log and its recording.
    #[must_use]
    pub fn new(log: &Log, assembled: &Assembled) -> Self {
        Self {
            format: log.format,
            columns: log.columns.clone(),
            rows: assembled.report.rows,
            loop_rate: assembled.plan.scenario().loop_rate,
            loop_rate_from: assembled.rate,
            commands: assembled.commands,
            start: assembled.start,
            frame: assembled.fit,
            detectors: outlooks(log, assembled.commands),
            report: assembled.report.clone(),
        }
    }

    /// Above the table of a run.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn table(&self, out: &mut impl Write) -> std::io::Result<()> {
        writeln!(out, "log         {}, {} rows", self.format.name(), self.rows)?;
        let columns: Vec<String> = self.columns.iter().filter_map(Column::told).collect();
        writeln!(out, "columns     {}", columns.join(", "))?;
        let unused: Vec<&str> =
            self.columns.iter().filter(|column| column.role.is_none()).map(|column| column.header.as_str()).collect();
        if !unused.is_empty() {
            writeln!(out, "not used    {}", unused.join(", "))?;
        }
        writeln!(out, "loop        {} Hz: {}", number(self.loop_rate), self.loop_rate_from.told())?;
        writeln!(out, "commands    {}", self.commands.told())?;
        for outlook in self.detectors.iter().filter(|outlook| !outlook.why.is_empty()) {
            let works = if outlook.works { "works" } else { "cannot work" };
            writeln!(out, "{:<11} {works}: {}", outlook.detector.key(), outlook.why)?;
        }
        for sentence in self.report.sentences() {
            writeln!(out, "note        {sentence}")?;
        }
        writeln!(out)
    }
}
