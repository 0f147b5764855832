//! `centrode figure`: one of the paper's figures, simulated, as a drawing or as numbers.

use super::ScenarioArgs;
use super::draw::{self, Kind};
use super::output::{Failure, NewFile, cell, finish_csv, write_record};
use centrode_core::study::Job;
use centrode_core::study::figure::{Axis, Figure, FigureJob, Mark, Number, Style};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode figure`.
#[derive(Debug, Args)]
pub struct FigureArgs {
    /// Number of the figure in the paper: 3, 4, 6, 7 or 8.
    #[arg(value_name = "NUMBER")]
    number: String,
    /// Without a file or preset, the figure's own preset is drawn.
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
        let figure = job.figure();
        match kind {
            Kind::Drawing(format) => {
                draw::write(&mut file, draw::figure(&figure, format))?;
                file.finish()?;
            }
            Kind::Csv => csv(file, &figure)?,
        }
        Ok(writeln!(out, "figure {number}: {}, written to {}", figure.title, self.out.display())?)
    }
}

/// The figure's numbers, one row each: kind, name, x, y. A gap is a row with an empty y; of what stands over the
/// whole height y is empty, and of a span both ends have a row.
fn csv(file: NewFile, figure: &Figure) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(file);
    let title = |axis: &Axis| format!("{} [{}]", axis.name, axis.si_unit);
    write_record(&mut csv, ["kind", "series", "name", &title(&figure.x), &title(&figure.y)])?;
    for (k, series) in figure.series.iter().enumerate() {
        let kind = match series.style {
            Style::Line => "line",
            Style::Dashed => "dashed",
            Style::Triangles => "triangles",
            Style::Circles => "circles",
        };
        for [x, y] in &series.points {
            write_record(&mut csv, [kind, &k.to_string(), &series.name, &cell(*x), &cell(*y)])?;
        }
    }
    for vertical in &figure.verticals {
        let kind = match vertical.mark {
            Mark::Detection => "detection",
            Mark::Contact => "contact",
        };
        write_record(&mut csv, [kind, "", vertical.name, &cell(vertical.x), ""])?;
    }
    for span in &figure.spans {
        for x in span.ends {
            write_record(&mut csv, ["span", "", span.name, &cell(x), ""])?;
        }
    }
    finish_csv(csv)
}
