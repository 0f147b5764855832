//! `centrode figure`: one of the paper's figures, simulated, as a drawing or as numbers.

use super::ScenarioArgs;
use super::draw::{self, Kind};
use super::output::{Failure, NewFile};
use centrode_core::chart::csv::csv;
use centrode_core::scenario::link::Page;
use centrode_core::study::Job;
use centrode_core::study::export::signed;
use centrode_core::study::figure::{FigureJob, Number};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode figure`.
#[derive(Debug, Args)]
pub struct FigureArgs {
    /// Number of the figure in the paper: 3, 4, 6, 7 or 8.
    #[arg(value_name = "NUMBER")]
    number: String,
    /// Without a file, preset or link, the figure's own preset is drawn.
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// File to write: its extension says how, svg, png or csv (numbers in SI units).
    #[arg(long, value_name = "FILE.{svg,png,csv}")]
    out: PathBuf,
}

impl FigureArgs {
    /// Simulates, draws and writes.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let number: Number = self.number.parse().map_err(|error| Failure::Input(format!("{error}")))?;
        let kind = Kind::of(&self.out)?;
        let scenario = self.scenario.scenario_or(number.preset())?;
        let mut job = FigureJob::new(number, &scenario).map_err(|error| Failure::Input(error.to_string()))?;
        // A file that cannot be written is said before the work, not after it.
        let mut file = NewFile::create(&self.out)?;
        job.finish();
        let chart = signed(job.chart(), &scenario, Page::of(number.preset()));
        match kind {
            Kind::Drawing(format) => draw::write(&mut file, &chart, format)?,
            Kind::Csv => file.write_all(csv(&chart).as_bytes()).map_err(|error| file.blame(&error))?,
        }
        file.finish()?;
        Ok(writeln!(out, "figure {number}: {}, written to {}", chart.title, self.out.display())?)
    }
}
