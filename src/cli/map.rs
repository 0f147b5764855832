//! `centrode map`: which contacts can be seen at all, by bend and place.

use super::ScenarioArgs;
use super::draw::{self, Kind};
use super::output::{Failure, NewFile, json};
use crate::experiment::text::number;
use crate::experiment::{Plan, Scenario};
use crate::study::Job;
use crate::study::map::{Map, MapJob, SIDES};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Flags of `centrode map`.
#[derive(Debug, Args)]
pub struct MapArgs {
    /// The page's preset `bench` when neither file nor preset is named. Its contact is marked; the map does not depend on it.
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Bends at contact, from the start of the motion to its end.
    #[arg(long, value_name = "N", default_value = "100", allow_hyphen_values = true, value_parser = side)]
    columns: usize,
    /// Places of the contact, from base to tip.
    #[arg(long, value_name = "N", default_value = "100", allow_hyphen_values = true, value_parser = side)]
    rows: usize,
    /// File to write: its extension says how, svg, png or csv (one row for each cell, SI units).
    #[arg(long, value_name = "FILE.{svg,png,csv}")]
    out: Option<PathBuf>,
    /// Print the whole map as JSON instead of its values at the scenario's contact; null where nothing is judged.
    #[arg(long)]
    json: bool,
}

fn side(text: &str) -> Result<usize, String> {
    let (least, most) = SIDES;
    text.parse()
        .ok()
        .filter(|side| (least..=most).contains(side))
        .ok_or_else(|| format!("a whole number from {least} to {most}"))
}

#[derive(Debug, Serialize)]
struct Report<'a> {
    scenario: &'a Scenario,
    #[serde(flatten)]
    map: &'a Map,
}

impl MapArgs {
    /// Computes, prints, and writes what is asked for.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let kind = self.out.as_deref().map(Kind::of).transpose()?;
        let scenario = self.scenario.scenario_or("bench")?;
        let refused = |error: crate::experiment::ScenarioError| Failure::Input(error.to_string());
        let plan = Plan::new(&scenario).map_err(refused)?;
        let mut job = MapJob::new(&scenario, self.columns, self.rows).map_err(refused)?;
        let mut file = self.out.as_deref().map(NewFile::create).transpose()?;
        job.finish();
        let map = job.map();
        if let (Some(file), Some(kind), Some(path)) = (&mut file, kind, &self.out) {
            let bytes = match kind {
                Kind::Drawing(format) => draw::map(map, &plan, format)
                    .map_err(|error| Failure::Input(format!("cannot draw {}: {error}", path.display())))?,
                Kind::Csv => csv(map).map_err(Failure::Output)?,
            };
            file.write_all(&bytes).map_err(|error| file.blame(&error))?;
        }
        if let Some(file) = file {
            file.finish()?;
        }
        if self.json { json(out, &Report { scenario: &scenario, map }) } else { Ok(summary(out, map, &plan)?) }
    }
}

/// One row for each cell; what is not judged stays empty.
fn csv(map: &Map) -> io::Result<Vec<u8>> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record(["arc_length [m]", "bend [rad]", "largest_xi2 [m]", "largest_epsilon_tau [1]"])?;
    let cell = |value: f64| if value.is_nan() { String::new() } else { value.to_string() };
    for (row, arc_length) in map.arc_lengths.iter().enumerate() {
        for (column, bend) in map.bends.iter().enumerate() {
            let k = map.cell(row, column);
            csv.write_record([*arc_length, *bend, map.deviation[k], map.epsilon[k]].map(cell))?;
        }
    }
    csv.into_inner().map_err(|error| io::Error::other(error.to_string()))
}

fn summary(out: &mut impl Write, map: &Map, plan: &Plan) -> io::Result<()> {
    let scenario = plan.scenario();
    let shown = |value: f64, scale: f64, unit: &str| {
        if value.is_nan() { "nothing is judged".into() } else { format!("{:.2} {unit}", value * scale) }
    };
    match plan.contact() {
        None => writeln!(out, "contact       none")?,
        Some(contact) => {
            writeln!(
                out,
                "contact       {:.1} mm along the backbone, at a bend of {:.1}°",
                contact.arc_length * 1e3,
                contact.bend.to_degrees()
            )?;
            let values = [crate::study::map::largest_deviation, crate::study::map::largest_epsilon];
            let [deviation, epsilon] = values.map(|value| value(plan, contact));
            writeln!(out, "largest ξ2    {} (it is {})", shown(deviation, 1e3, "mm"), threshold(scenario))?;
            let assumed = scenario.load_cells.epsilon_tau * 100.0;
            writeln!(out, "largest ε_τ   {} (it is {} %)", shown(epsilon, 100.0, "%"), number(assumed))?;
        }
    }
    let seen = |values: &[f64], level: Option<f64>| {
        let found = values.iter().filter(|&&value| level.is_some_and(|level| value > level)).count();
        100.0 * found as f64 / values.len() as f64
    };
    writeln!(
        out,
        "of all contacts from base to tip and over the motion, {:.1} % are found by ξ2 and {:.1} % by the joint forces",
        seen(&map.deviation, scenario.detection.xi2.value()),
        seen(&map.epsilon, Some(scenario.load_cells.epsilon_tau))
    )
}

fn threshold(scenario: &Scenario) -> String {
    scenario.detection.xi2.value().map_or_else(|| "off".into(), |xi2| format!("{:.2} mm", xi2 * 1e3))
}
