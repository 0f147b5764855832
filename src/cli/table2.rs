//! `centrode table2`: the paper's Table II beside simulated ones.

use super::ScenarioArgs;
use super::draw::{self, Format};
use super::output::{Failure, NewFile, json};
use centrode_core::scenario::Scenario;
use centrode_core::scenario::link::Page;
use centrode_core::study::Job;
use centrode_core::study::export::signed;
use centrode_core::study::table2::chart::{made, with_words};
use centrode_core::study::table2::export::{QUANTITIES, csv, latex};
use centrode_core::study::table2::ours::Ours;
use centrode_core::study::table2::{PAPER_REPEATS, Row, Spread, Table2, Table2Job, paper_rows};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Flags of `centrode table2`.
#[derive(Debug, Args)]
pub struct Table2Args {
    /// Without a file, preset or link, `bench`. Place and time of its contact are ignored: each disk has those of the preset `disk-1`, `bench` or `disk-3`.
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Experiments on each disk, 1 to 100000.
    #[arg(long, value_name = "N", default_value_t = PAPER_REPEATS)]
    repeats: usize,
    /// Print JSON instead of a table: all tables and every experiment, in SI units.
    #[arg(long)]
    json: bool,
    /// Write all tables to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write all tables to a LaTeX file, a plain tabular with units in its head.
    #[arg(long, value_name = "FILE")]
    latex: Option<PathBuf>,
    /// Draw every estimate against the true place to a file, .svg or .png.
    #[arg(long, value_name = "FILE.{svg,png}")]
    svg: Option<PathBuf>,
}

#[derive(Serialize)]
struct Report<'a> {
    scenario: &'a Scenario,
    repeats: usize,
    #[serde(flatten)]
    table: &'a Table2,
    rows: Rows<'a>,
}

#[derive(Serialize)]
struct Rows<'a> {
    paper: &'a [Row],
    simulated: &'a [Row],
    other: &'a [Row],
}

impl Table2Args {
    /// Simulates and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let scenario = self.scenario.scenario_or("bench")?;
        let mut job = Table2Job::new(&scenario, self.repeats).map_err(|error| Failure::Input(error.to_string()))?;
        let format = self.svg.as_deref().map(|path| Format::of("--svg", path)).transpose()?;
        // A file that cannot be written is said before the work, not after it.
        let [numbers, tabular] = [&self.csv, &self.latex].map(|path| path.as_deref().map(NewFile::create).transpose());
        let (numbers, tabular) = (numbers?, tabular?);
        let drawing = self.svg.as_deref().map(NewFile::create).transpose()?;
        job.finish();
        let table = job.table();
        if let (Some(mut file), Some(format)) = (drawing, format) {
            let chart = with_words(&table, [job.rows(), job.other_rows()], (&scenario, self.repeats));
            draw::write(&mut file, &signed(chart, &scenario, Page::of("table2")), format)?;
            file.finish()?;
        }
        let written = [
            numbers.map(|file| (file, csv(&table))),
            tabular.map(|file| (file, latex(&table, &made(&scenario, self.repeats)))),
        ];
        for (mut file, text) in written.into_iter().flatten() {
            file.write_all(text.as_bytes()).map_err(|error| file.blame(&error))?;
            file.finish()?;
        }
        if self.json {
            let rows = Rows { paper: &paper_rows(), simulated: job.rows(), other: job.other_rows() };
            json(out, &Report { scenario: &scenario, repeats: self.repeats, table: &table, rows })
        } else {
            Ok(text(out, &table)?)
        }
    }
}

fn text(out: &mut impl Write, table: &Table2) -> io::Result<()> {
    let [one, ..] = &table.simulated;
    writeln!(
        out,
        "Table II: the paper's, and simulated with {} {} on each disk by kind of contact",
        one.repeats,
        if one.repeats == 1 { "experiment" } else { "experiments" }
    )?;
    writeln!(out, "mean ± standard deviation where contact was found; – is not known, or not defined")?;
    for k in 0..table.paper.len() {
        writeln!(out)?;
        let mut line = |label: &str, values: [String; 3]| {
            writeln!(out, "{label:<22} {:>18} {:>18} {:>18}", values[0], values[1], values[2])
        };
        let all = [&table.paper[k], &table.simulated[k], &table.other[k]];
        line(&format!("disk {}", all[0].disk), ["paper", table.kind.name(), table.other_kind.name()].map(Into::into))?;
        line("true place [mm]", all.map(|disk| number(disk.arc_length * 1e3, 2)))?;
        line("contact from [s]", all.map(|disk| number(disk.contact_time, 3)))?;
        line("found", all.map(|disk| format!("{} of {}", disk.found, disk.repeats)))?;
        line("false alarms", all.map(|disk| disk.false_alarms.map_or("–".into(), |count| count.to_string())))?;
        for quantity in &QUANTITIES {
            line(quantity.label, all.map(|disk| plus_minus((quantity.of)(disk), quantity.scale, quantity.digits)))?;
        }
        line("estimate − truth [mm]", all.map(|disk| number(disk.bias * 1e3, 2)))?;
        if let Some(Ours { disk, placed, covered }) = table.ours.map(|ours| ours[k]) {
            let mut ours = |label: &str, value: String| line(label, ["–".into(), value, "–".into()]);
            ours("cusum: found", format!("{} of {}", disk.found, disk.repeats))?;
            ours("false alarms", disk.false_alarms.map_or("–".into(), |count| count.to_string()))?;
            ours("detected at [s]", plus_minus(disk.detection_time, 1.0, 3))?;
            ours("after contact [s]", plus_minus(disk.delay, 1.0, 3))?;
            ours("0.5 s later at [mm]", plus_minus(disk.location, 1e3, 2))?;
            let held = if placed > 0 { format!("{:.0} %", covered * 100.0) } else { "–".into() };
            ours("95 % hold the truth", held)?;
        }
    }
    Ok(())
}

fn number(value: f64, digits: usize) -> String {
    if value.is_nan() { "–".into() } else { format!("{value:.digits$}") }
}

fn plus_minus(statistic: Spread, scale: f64, digits: usize) -> String {
    let mean = number(statistic.mean * scale, digits);
    if statistic.deviation.is_nan() {
        mean
    } else {
        format!("{mean} ± {}", number(statistic.deviation * scale, digits))
    }
}
