//! The headless command: one file per subcommand.
//!
//! Exit code 0 for work done, 2 for bad input with one line on standard error, 130 after an interrupt, which leaves no part
//! of a file behind. A closed pipe ends it quietly.

#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "the command is what reads and writes files")]

mod analyze;
mod chain;
mod draw;
mod estimating;
mod figure;
mod interrupt;
mod link;
mod logfile;
mod map;
mod model;
mod output;
mod report;
mod run;
mod study;
mod table2;

use centrode_core::scenario::chain::ChainDraft;
use centrode_core::scenario::link::page::CHAIN;
use centrode_core::scenario::link::{Link, Page};
use centrode_core::scenario::preset::{self, CHAINS, PRESETS};
use centrode_core::scenario::text::{DEFAULT_TOML, Draft};
use centrode_core::scenario::{ChainScenario, Scenario, ScenarioError};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, Parser, Subcommand};
use output::Failure;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Contact detection on a continuum robot, headless: the same core and the same numbers as the page.
#[derive(Debug, Parser)]
#[command(name = "centrode", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Evaluate the model in one configuration.
    Model(model::ModelArgs),
    /// Draw one of the paper's figures from simulated runs, or write its numbers.
    Figure(figure::FigureArgs),
    /// Simulate a scenario and report threshold crossings and the estimated contact location.
    Run(run::RunArgs),
    /// Judge a log of a rig: the same detectors on recorded data.
    Analyze(analyze::AnalyzeArgs),
    /// Repeat the experiment on disks 1, 2 and 3 and set it beside the paper's Table II.
    Table2(table2::Table2Args),
    /// Map which contacts are detectable: the largest threshold and cell error for each place and bend at contact.
    Map(map::MapArgs),
    /// Tune thresholds: false alarms, delay and the best filter, from repeats with and without contact.
    Study(study::StudyArgs),
    /// Print the link to a scenario, for a page at an address.
    Link(link::LinkArgs),
    /// List the presets.
    Presets,
    /// Print the default scenario as TOML, with a comment on every key.
    Scenario,
}

/// Where a scenario comes from.
#[derive(Debug, Clone, Args)]
struct ScenarioArgs {
    /// Scenario file (TOML); without it, the default scenario.
    #[arg(value_name = "SCENARIO.toml", conflicts_with = "preset")]
    file: Option<PathBuf>,
    /// Start from a preset instead of a file (see `centrode presets`).
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Start from the link of a page: its address, or what stands behind the # in it. A link that cannot be read whole is refused.
    #[arg(long, value_name = "URL", conflicts_with_all = ["file", "preset"])]
    link: Option<String>,
    /// Override one key, as in contact.disk=3; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
}

/// No scenario file is larger than this, bytes.
const MAX_FILE: u64 = 1 << 20;

impl ScenarioArgs {
    fn scenario(&self) -> Result<Scenario, Failure> {
        self.resolved(None)
    }

    /// The experiment with several segments that is named, with its preset where it is one; none where it has one segment.
    fn draft(&self) -> Result<Option<(ChainDraft, Option<&str>)>, Failure> {
        let (place, bytes) = match (&self.file, &self.preset, self.link()?) {
            (_, _, Some(link)) => {
                let Some(chain) = link.page.chain.filter(|_| link.page.view == CHAIN) else { return Ok(None) };
                let preset = preset::find_chain(chain.preset()).map(|preset| preset.name);
                let draft = chain.draft.overridden(self.sets.iter().map(String::as_str));
                let refused = |error| Failure::Input(format!("--link with --set: {error}"));
                return draft.map(|draft| Some((draft, preset))).map_err(refused);
            }
            (Some(path), ..) => (path.display().to_string(), read(path)?),
            (None, Some(name), None) => match preset::find_chain(name) {
                Some(preset) => (format!("preset {name}"), preset.toml.as_bytes().to_vec()),
                None => return Ok(None),
            },
            (None, None, None) => return Ok(None),
        };
        if !ChainScenario::is_of(&bytes) {
            return Ok(None);
        }
        let place = if self.sets.is_empty() { place } else { format!("{place} with --set") };
        let draft = ChainDraft::read(&bytes, &self.sets);
        let named = self.preset.as_deref().filter(|_| self.file.is_none());
        draft.map(|draft| Some((draft, named))).map_err(|error| Failure::Input(format!("{place}: {error}")))
    }

    /// The experiment with several segments that is named; none where it has one.
    fn chain(&self) -> Result<Option<ChainScenario>, Failure> {
        let Some((draft, _)) = self.draft()? else { return Ok(None) };
        draft.scenario().map(Some).map_err(|error| Failure::Input(error.to_string()))
    }

    /// The scenario, from a preset where neither file nor preset is named.
    fn scenario_or(&self, preset: &str) -> Result<Scenario, Failure> {
        self.resolved(Some(preset))
    }

    /// The link that is named, whole.
    fn link(&self) -> Result<Option<Link>, Failure> {
        let Some(text) = &self.link else { return Ok(None) };
        let (link, broken) = Link::read(text);
        if broken.is_empty() {
            return Ok(Some(link));
        }
        let told: Vec<_> = broken.iter().map(|broken| broken.refusal()).collect();
        Err(Failure::Input(format!("--link: {}", told.join("; "))))
    }

    /// What the named link says of the page; none without a link.
    fn page(&self) -> Result<Option<Page>, Failure> {
        Ok(self.link()?.map(|link| link.page))
    }

    fn resolved(&self, otherwise: Option<&str>) -> Result<Scenario, Failure> {
        let named = |place: String| move |error: ScenarioError| Failure::Input(format!("{place}: {error}"));
        if let Some(scenario) = self.chain()? {
            let segments = scenario.segments.len();
            return Err(Failure::Input(format!(
                "this experiment has [[segment]], {segments} of them: only `centrode run` and `centrode analyze` take it"
            )));
        }
        let link = self.link()?;
        let (place, mut draft) = match (&self.file, self.preset.as_deref().or(otherwise)) {
            _ if let Some(link) = &link => ("--link".into(), Draft::from_scenario(link.scenario())),
            (Some(path), _) => {
                let place = path.display().to_string();
                let draft = Draft::from_bytes(&read(path)?).map_err(named(place.clone()))?;
                (place, draft)
            }
            (None, Some(name)) => {
                let preset = preset::find(name).map_err(named("--preset".into()))?;
                (format!("preset {name}"), preset.draft().map_err(named(name.into()))?)
            }
            (None, None) => ("scenario".into(), Draft::default()),
        };
        for text in &self.sets {
            draft.set(text).map_err(named("--set".into()))?;
        }
        let place = if self.sets.is_empty() { place } else { format!("{place} with --set") };
        draft.finish().map_err(named(place))
    }
}

/// The bytes of a file that a person wrote.
fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable = |error| Failure::Input(format!("cannot read {}: {error}", path.display()));
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(MAX_FILE + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > MAX_FILE {
        return Err(Failure::Input(format!("{}: larger than 1 MiB, not a scenario", path.display())));
    }
    Ok(bytes)
}

/// Runs the command line of this process.
#[must_use]
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            // Nothing is left to say when even the help finds no reader.
            let _ = error.print();
            return ExitCode::SUCCESS;
        }
        Err(error) if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            return Failure::Input(
                "name a subcommand: model, run, figure, table2, map, study, analyze, link, presets or scenario (see --help)"
                    .into(),
            )
            .report();
        }
        Err(error) if names(&error, "--shard") => return Failure::Input(WITHOUT_SHARES.into()).report(),
        Err(error) => return Failure::Input(one_line(&error.to_string())).report(),
    };
    interrupt::listen();
    let mut out = io::BufWriter::new(io::stdout().lock());
    let done = match &cli.command {
        Command::Model(args) => args.execute(&mut out),
        Command::Run(args) => args.execute(&mut out),
        Command::Analyze(args) => args.execute(&mut out),
        Command::Figure(args) => args.execute(&mut out),
        Command::Table2(args) => args.execute(&mut out),
        Command::Map(args) => args.execute(&mut out),
        Command::Study(args) => args.execute(&mut out),
        Command::Link(args) => args.execute(&mut out),
        Command::Presets => presets(&mut out),
        Command::Scenario => out.write_all(DEFAULT_TOML.as_bytes()).map_err(Failure::Output),
    };
    match done.and_then(|()| out.flush().map_err(Failure::Output)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// What has no shares, and why.
const WITHOUT_SHARES: &str = "--shard: only `centrode study` is made in shares; a run, a figure and a map are computed once, without repeats to split, \
     and table2 is made at once";

/// Whether an argument that is not known begins like this.
fn names(error: &clap::Error, flag: &str) -> bool {
    let argument = error.get(ContextKind::InvalidArg);
    let known = matches!(argument, Some(ContextValue::String(argument)) if argument == flag);
    known && error.kind() == ErrorKind::UnknownArgument
}

fn presets(out: &mut impl Write) -> Result<(), Failure> {
    let width = PRESETS.iter().map(|preset| preset.name.len()).max().unwrap_or(0);
    for preset in PRESETS.iter().chain(CHAINS) {
        writeln!(out, "{:width$}  {}", preset.name, preset.summary())?;
    }
    Ok(())
}

/// The first paragraph of clap's message, without its prefix, on one line.
fn one_line(message: &str) -> String {
    let paragraph: Vec<_> = message.lines().take_while(|line| !line.is_empty()).map(str::trim).collect();
    let line = paragraph.join(" ");
    format!("{} (see --help)", line.strip_prefix("error: ").unwrap_or(&line))
}
