//! `centrode map`: which contacts are detectable, over the place of the contact and the bend at contact.

use super::ScenarioArgs;
use super::draw::{self, Kind};
use super::output::{Failure, NewFile, json};
use centrode_core::scenario::link::Page;
use centrode_core::scenario::{Plan, Scenario};
use centrode_core::study::Job;
use centrode_core::study::export::signed;
use centrode_core::study::map::chart::chart;
use centrode_core::study::map::{ContactMap, MapJob, largest_deviation, largest_epsilon};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Flags of `centrode map`.
#[derive(Debug, Args)]
pub struct MapArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Cells over the bend at contact.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u16).range(2..=1000))]
    columns: u16,
    /// Cells over the place of the contact.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u16).range(2..=1000))]
    rows: u16,
    /// File to write: its extension says how, svg, png or csv (every cell, units in the header).
    #[arg(long, value_name = "FILE.{svg,png,csv}")]
    out: Option<PathBuf>,
    /// Print JSON instead of a summary, in SI units: every cell, null where nothing is judged.
    #[arg(long)]
    json: bool,
}

/// What a map comes to. SI units; null where nothing is judged.
#[derive(Debug, Serialize)]
struct Report<'a> {
    scenario: &'a Scenario,
    /// The scenario's own contact.
    contact: Option<Own>,
    /// Of the cells in which something is judged; null with the threshold off.
    centrode: Sight,
    joint_forces: Sight,
    /// Rows' middles.
    arc_lengths: &'a [f64],
    /// Columns' middles.
    bends: &'a [f64],
    /// Row by row.
    largest_xi2: &'a [f64],
    largest_epsilon_tau: &'a [f64],
}

#[derive(Debug, Serialize)]
struct Own {
    arc_length: f64,
    bend: f64,
    largest_xi2: f64,
    largest_epsilon_tau: f64,
}

/// What one method can see with the scenario's setting.
#[derive(Debug, Serialize)]
struct Sight {
    /// ξ2 (m) or ε_τ; null when switched off.
    setting: Option<f64>,
    /// Cells in which something is judged, and in which contact is found.
    judged: usize,
    found: usize,
    /// The lowest place in whose row contact is found at some bend, m.
    lowest: f64,
}

impl Sight {
    fn new(map: &ContactMap, values: &[f64], setting: Option<f64>) -> Self {
        let finds = |&value: &f64| setting.is_some_and(|setting| value > setting);
        let first = values.iter().position(finds);
        Self {
            setting,
            judged: values.iter().filter(|value| !value.is_nan()).count(),
            found: values.iter().filter(|&value| finds(value)).count(),
            lowest: first.map_or(f64::NAN, |cell| map.arc_lengths[cell / map.bends.len()]),
        }
    }
}

impl MapArgs {
    /// Computes and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let scenario = self.scenario.scenario()?;
        let refused = |error: centrode_core::scenario::ScenarioError| Failure::Input(error.to_string());
        let plan = Plan::new(&scenario).map_err(refused)?;
        let mut job = MapJob::new(&scenario, self.columns.into(), self.rows.into()).map_err(refused)?;
        let kind = self.out.as_deref().map(Kind::of).transpose()?;
        // A file that cannot be written is said before the work, not after it.
        let file = self.out.as_deref().map(NewFile::create).transpose()?;
        job.finish();
        let map = job.map();
        if let (Some(mut file), Some(kind)) = (file, kind) {
            match kind {
                Kind::Drawing(format) => {
                    let chart = signed(chart(map, &plan), &scenario, Page::of("map"));
                    draw::write(&mut file, &chart, format)?;
                }
                Kind::Csv => file.write_all(map.csv().as_bytes()).map_err(|error| file.blame(&error))?,
            }
            file.finish()?;
        }
        let report = Report {
            contact: plan.contact().map(|contact| Own {
                arc_length: contact.arc_length,
                bend: contact.bend,
                largest_xi2: largest_deviation(&plan, contact),
                largest_epsilon_tau: largest_epsilon(&plan, contact),
            }),
            centrode: Sight::new(map, &map.deviation, scenario.detection.xi2.value()),
            joint_forces: Sight::new(map, &map.epsilon, Some(scenario.load_cells.epsilon_tau)),
            scenario: &scenario,
            arc_lengths: &map.arc_lengths,
            bends: &map.bends,
            largest_xi2: &map.deviation,
            largest_epsilon_tau: &map.epsilon,
        };
        if self.json { json(out, &report) } else { Ok(text(out, &report)?) }
    }
}

fn text(out: &mut impl Write, report: &Report<'_>) -> io::Result<()> {
    let shown = |value: f64, scale: f64, unit: &str| match value.is_nan() {
        true => "nothing is judged".to_owned(),
        false => format!("{:.2} {unit}", value * scale),
    };
    let Report { arc_lengths, bends, .. } = report;
    writeln!(out, "map         {} bends at contact by {} places, without noise", bends.len(), arc_lengths.len())?;
    match &report.contact {
        Some(own) => {
            let degrees = own.bend.to_degrees();
            writeln!(out, "contact     {:.1} mm along the backbone, at a bend of {degrees:.1}°", own.arc_length * 1e3)?;
            writeln!(out, "  largest ξ2 that finds it     {}", shown(own.largest_xi2, 1e3, "mm"))?;
            writeln!(out, "  largest ε_τ that shows it    {}", shown(own.largest_epsilon_tau, 100.0, "%"))?;
        }
        None => writeln!(out, "contact     none")?,
    }
    for (name, symbol, sight, scale, unit) in
        [("centrode", "ξ2", &report.centrode, 1e3, "mm"), ("forces", "ε_τ", &report.joint_forces, 100.0, "%")]
    {
        let Sight { setting, judged, found, lowest } = sight;
        let Some(setting) = setting else {
            writeln!(out, "{name:<11} {symbol} is off, so nothing is detected")?;
            continue;
        };
        write!(out, "{name:<11} {symbol} = {:.2} {unit} finds {found} of {judged} contacts judged", setting * scale)?;
        match lowest.is_nan() {
            true => writeln!(out)?,
            false => writeln!(out, ", the lowest at {:.2} mm", lowest * 1e3)?,
        }
    }
    Ok(())
}
