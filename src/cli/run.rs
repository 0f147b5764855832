//! `centrode run`: simulate one scenario, sample by sample.
//!
//! A long run needs no more memory than a short one, but for its events and, in JSON, its threshold crossings: 40 bytes each, and
//! at most [`MAX_CROSSINGS`](super::report::MAX_CROSSINGS) of them.

use super::ScenarioArgs;
use super::logfile::LogFile;
use super::output::{Failure, NewFile, finish_csv, write_record};
use super::report::{Contact, Report, Tally};
use centrode_core::chart::csv::cell;
use centrode_core::run::{CHANNELS, Simulation};
use centrode_core::scenario::Plan;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    /// Write every channel at loop rate to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write what a rig would have recorded, without the truth, to a log; the extension says how.
    #[arg(long, value_name = "FILE.{csv,tum,mcap}")]
    log: Option<PathBuf>,
}

impl RunArgs {
    /// Simulates and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let scenario = self.scenario.scenario()?;
        let plan = Plan::new(&scenario).map_err(|error| Failure::Input(error.to_string()))?;
        let mut csv = self.csv.as_deref().map(NewFile::create).transpose()?.map(csv::Writer::from_writer);
        if let Some(csv) = &mut csv {
            let header = CHANNELS.iter().map(|channel| format!("{} [{}]", channel.name, channel.unit));
            write_record(csv, header)?;
        }
        let mut log = self.log.as_deref().map(|path| LogFile::create(path, &plan)).transpose()?;
        let mut simulation = Simulation::new(&plan);
        let mut tally = Tally::new(self.json);
        while let Some(sample) = simulation.next() {
            tally.add(&sample, &simulation.take_crossings(), &scenario.detection)?;
            if let Some(log) = &mut log {
                log.write(simulation.entry())?;
            }
            if let Some(csv) = &mut csv {
                write_record(csv, CHANNELS.iter().map(|channel| cell((channel.value)(&sample))))?;
            }
        }
        if let Some(csv) = csv {
            finish_csv(csv)?;
        }
        if let Some(log) = log {
            log.finish()?;
        }
        let contact_time = simulation.contact_time();
        let contact = plan.contact().zip(contact_time).map(|(contact, time)| Contact {
            time,
            arc_length: contact.arc_length,
            bend: contact.bend,
        });
        Report::new(scenario, tally, simulation.events(), contact, None).print(out, self.json)
    }
}
