//! How a log was read, told.

use centrode_core::detect::outlook::{Outlook, outlooks};
use centrode_core::record::log::assemble::Assembled;
use centrode_core::record::log::frame::Fit;
use centrode_core::record::log::{Column, Commands, Format, Log, Rate, Report};
use centrode_core::scenario::text::number;
use serde::Serialize;
use std::io::Write;

/// How a log was read.
#[derive(Debug, Serialize)]
pub struct About {
    format: Format,
    columns: Vec<Column>,
    /// Rows read, of both files when there are two.
    rows: u64,
    /// Hz, and who said so.
    loop_rate: f64,
    loop_rate_from: Rate,
    commands: Commands,
    /// What was subtracted from the log's times, s.
    start: f64,
    /// Where its frame is against {B}, when it was fitted.
    frame: Option<Fit>,
    detectors: Vec<Outlook>,
    report: Report,
}

impl About {
    /// Of a log and its recording.
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
