//! `centrode table2`: the paper's Table II beside a simulated one.

use super::ScenarioArgs;
use super::draw::{self, Format};
use super::output::{Failure, NewFile, finish_csv, json, write_record};
use centrode_core::chart::csv::cell;
use centrode_core::scenario::Scenario;
use centrode_core::study::Job;
use centrode_core::study::table2::chart::with_words;
use centrode_core::study::table2::{Disk, PAPER_REPEATS, Row, Spread, Table2, Table2Job, paper_rows};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Flags of `centrode table2`.
#[derive(Debug, Args)]
pub struct Table2Args {
    /// Without a file or preset, `bench`. Its contact is ignored: each disk has the contact of the preset `disk-1`, `bench` or `disk-3`.
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Experiments on each disk, 1 to 100000.
    #[arg(long, value_name = "N", default_value_t = PAPER_REPEATS)]
    repeats: usize,
    /// Print JSON instead of a table: both tables and every experiment, in SI units.
    #[arg(long)]
    json: bool,
    /// Write both tables to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
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
}

impl Table2Args {
    /// Simulates and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let scenario = self.scenario.scenario_or("bench")?;
        let mut job = Table2Job::new(&scenario, self.repeats).map_err(|error| Failure::Input(error.to_string()))?;
        let format = self.svg.as_deref().map(|path| Format::of("--svg", path)).transpose()?;
        // A file that cannot be written is said before the work, not after it.
        let file = self.csv.as_deref().map(NewFile::create).transpose()?;
        let drawing = self.svg.as_deref().map(NewFile::create).transpose()?;
        job.finish();
        let table = job.table();
        if let (Some(mut file), Some(format)) = (drawing, format) {
            draw::write(&mut file, &with_words(&table, job.rows(), (&scenario, self.repeats)), format)?;
            file.finish()?;
        }
        if let Some(file) = file {
            csv(file, &table)?;
        }
        if self.json {
            let rows = Rows { paper: &paper_rows(), simulated: job.rows() };
            json(out, &Report { scenario: &scenario, repeats: self.repeats, table: &table, rows })
        } else {
            Ok(text(out, &table)?)
        }
    }
}

/// A quantity of a disk: its name and unit in CSV, and in the table with a scale and a number of digits.
struct Quantity {
    key: &'static str,
    si_unit: &'static str,
    label: &'static str,
    scale: f64,
    digits: usize,
    of: fn(&Disk) -> Spread,
}

const DEGREES: f64 = 180.0 / std::f64::consts::PI;

const QUANTITIES: [Quantity; 4] = [
    Quantity {
        key: "detection_time",
        si_unit: "s",
        label: "detected at [s]",
        scale: 1.0,
        digits: 3,
        of: |disk| disk.detection_time,
    },
    Quantity { key: "delay", si_unit: "s", label: "after contact [s]", scale: 1.0, digits: 3, of: |disk| disk.delay },
    Quantity {
        key: "theta_l",
        si_unit: "rad",
        label: "θL then [°]",
        scale: DEGREES,
        digits: 2,
        of: |disk| disk.theta_l,
    },
    Quantity {
        key: "location",
        si_unit: "m",
        label: "located at [mm]",
        scale: 1e3,
        digits: 2,
        of: |disk| disk.location,
    },
];

fn csv(file: NewFile, table: &Table2) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(file);
    let fixed = [
        "table",
        "disk",
        "arc_length [m]",
        "contact_time [s]",
        "repeats",
        "found",
        "false_alarms",
        "location_bias [m]",
    ];
    let titles = QUANTITIES.iter().flat_map(|quantity| {
        ["mean", "deviation"].map(|kind| format!("{}_{kind} [{}]", quantity.key, quantity.si_unit))
    });
    write_record(&mut csv, fixed.into_iter().map(String::from).chain(titles))?;
    for (name, disks) in [("paper", &table.paper), ("simulated", &table.simulated)] {
        for disk in disks {
            let fixed = [
                name.into(),
                disk.disk.to_string(),
                cell(disk.arc_length),
                cell(disk.contact_time),
                disk.repeats.to_string(),
                disk.found.to_string(),
                disk.false_alarms.map_or(String::new(), |count| count.to_string()),
                cell(disk.bias),
            ];
            let values = QUANTITIES.iter().map(|quantity| (quantity.of)(disk));
            let values = values.flat_map(|statistic| [cell(statistic.mean), cell(statistic.deviation)]);
            write_record(&mut csv, fixed.into_iter().chain(values))?;
        }
    }
    finish_csv(csv)
}

fn text(out: &mut impl Write, table: &Table2) -> io::Result<()> {
    let [one, ..] = &table.simulated;
    writeln!(out, "Table II: the paper's, and simulated with {} experiments on each disk", one.repeats)?;
    writeln!(out, "mean ± standard deviation where contact was found; – is not known, or not defined")?;
    for (paper, simulated) in table.paper.iter().zip(&table.simulated) {
        writeln!(out)?;
        let mut line =
            |label: &str, values: [String; 2]| writeln!(out, "{label:<22} {:>18} {:>18}", values[0], values[1]);
        line(&format!("disk {}", paper.disk), ["paper".into(), "simulated".into()])?;
        let both = [paper, simulated];
        line("true place [mm]", both.map(|disk| number(disk.arc_length * 1e3, 2)))?;
        line("contact from [s]", both.map(|disk| number(disk.contact_time, 3)))?;
        line("found", both.map(|disk| format!("{} of {}", disk.found, disk.repeats)))?;
        line("false alarms", both.map(|disk| disk.false_alarms.map_or("–".into(), |count| count.to_string())))?;
        for quantity in &QUANTITIES {
            line(quantity.label, both.map(|disk| plus_minus((quantity.of)(disk), quantity.scale, quantity.digits)))?;
        }
        line("estimate − truth [mm]", both.map(|disk| number(disk.bias * 1e3, 2)))?;
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
