//! `centrode run`: simulate one scenario, sample by sample.
//!
//! A long run needs no more memory than a short one, but for its events and, in JSON, its threshold crossings: 40 bytes each, and
//! at most [`MAX_CROSSINGS`](centrode_core::study::report::MAX_CROSSINGS) of them.

use super::ScenarioArgs;
use super::chain;
use super::draw::{self, Format};
use super::estimating::Estimating;
use super::logfile::LogFile;
use super::output::{Failure, NewFile, Table, say};
use super::report::{Report, print, too_many};
use centrode_core::run::{MAX_KEPT, Run, Simulation};
use centrode_core::scenario::link::Page;
use centrode_core::scenario::{ChainScenario, Plan};
use centrode_core::study::export::signed;
use centrode_core::study::report::{Conclusions, Tally};
use centrode_core::study::timeline::{Timeline, simulated};
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
    #[command(flatten)]
    estimating: Estimating,
    /// Write every channel at loop rate to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write what a rig would have recorded, without the truth, to a log; the extension says how.
    #[arg(long, value_name = "FILE.{csv,tum,mcap}")]
    log: Option<PathBuf>,
    /// Draw what the detectors hold against their thresholds.
    #[arg(long, value_name = "FILE.{svg,png}")]
    figure: Option<PathBuf>,
}

impl RunArgs {
    /// Simulates and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        if let Some(scenario) = self.scenario.chain()? {
            return self.chain(&scenario, out);
        }
        let scenario = self.scenario.scenario()?;
        let plan = Plan::new(&scenario).map_err(|error| Failure::Input(error.to_string()))?;
        let (detector, after) = (self.estimating.detector()?, self.estimating.after()?);
        let format = self.figure.as_deref().map(|path| Format::of("--figure", path)).transpose()?;
        let mut csv =
            self.csv.as_deref().map(|path| Table::create(path, true, scenario.detection.detectors)).transpose()?;
        let figure = self.figure.as_deref().map(NewFile::create).transpose()?;
        let mut log = self.log.as_deref().map(|path| LogFile::create(path, &plan)).transpose()?;
        let mut simulation = Simulation::new(&plan);
        let mut tally = Tally::new(self.json);
        let mut timeline = figure.is_some().then(|| Timeline::new(&scenario, plan.samples()));
        while let Some(sample) = simulation.next() {
            tally.add(&sample, &simulation.take_crossings(), &scenario.detection).map_err(too_many)?;
            if let Some(timeline) = &mut timeline {
                timeline.push(&sample);
            }
            if let Some(log) = &mut log {
                log.write(simulation.entry())?;
            }
            if let Some(csv) = &mut csv {
                csv.write(&sample)?;
            }
        }
        if let Some(csv) = csv {
            csv.finish()?;
        }
        if let (Some(mut file), Some(timeline), Some(format)) = (figure, timeline, format) {
            let chart = simulated(timeline, &plan, simulation.events(), simulation.plant_events());
            let chart = signed(chart, &scenario, Page::default());
            draw::write(&mut file, &chart, format)?;
            file.finish()?;
        }
        if let Some(log) = log {
            log.finish()?;
        }
        // A run that can be kept is looked at once more, as a whole.
        let conclusions = if plan.samples() <= MAX_KEPT {
            let run = Run::new(plan.clone());
            Conclusions::of(&run.judged, &run.recording, detector, &after)
        } else {
            let samples = plan.samples();
            say(&format!(
                "no contact is placed: the run has {samples} samples, and at most {MAX_KEPT} are kept for that"
            ));
            Conclusions::default()
        };
        let truth = Some((&plan, simulation.plant_events()));
        let report = Report::new(scenario, tally, simulation.events(), truth, conclusions, None);
        print(out, &report, self.json)
    }

    /// The same with several segments.
    fn chain(&self, scenario: &ChainScenario, out: &mut impl Write) -> Result<(), Failure> {
        let (detector, after) = (self.estimating.named(), self.estimating.after()?);
        let (csv, figure) = (self.csv.as_deref(), self.figure.as_deref());
        let asked = chain::Asked { detector, after, json: self.json, csv, figure };
        chain::execute(scenario, &asked, self.log.as_deref(), out)
    }
}
