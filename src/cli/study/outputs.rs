//! Where a study is written.

use crate::cli::draw::Format;
use crate::cli::output::{Failure, NewFile};
use clap::Args;
use std::path::PathBuf;

/// Flags that say where.
#[derive(Debug, Args)]
pub struct Outputs {
    /// Print JSON instead of a summary, in SI units: every cell with its curves.
    #[arg(long)]
    json: bool,
    /// Write every threshold of every cell, or detector, to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw operating curves and delays to a file, .svg or .png; with --detectors, their delays and the errors of places.
    #[arg(long, value_name = "FILE.{svg,png}")]
    svg: Option<PathBuf>,
}

/// Files that are open to be written.
#[derive(Debug)]
pub struct Files {
    /// Whether standard output gets JSON.
    pub json: bool,
    /// Every threshold.
    pub table: Option<NewFile>,
    /// Curves.
    pub drawing: Option<(NewFile, Format)>,
}

impl Outputs {
    /// Whether any of them is given.
    pub fn is_given(&self) -> bool {
        self.json || self.csv.is_some() || self.svg.is_some()
    }

    /// Opens the files: one that cannot be written is said before the work, not after it.
    pub fn open(&self) -> Result<Files, Failure> {
        let format = self.svg.as_deref().map(|path| Format::of("--svg", path)).transpose()?;
        let [table, drawing] = [&self.csv, &self.svg].map(|path| path.as_deref().map(NewFile::create));
        Ok(Files { json: self.json, table: table.transpose()?, drawing: drawing.transpose()?.zip(format) })
    }
}
