//! `centrode analyze`: judge a log as a run is judged.

use super::draw::{self, Format as Drawing};
use super::estimating::{Estimating, method};
use super::output::{Failure, NewFile, Table};
use super::report::{Report, print, too_many};
use super::{ScenarioArgs, chain};
use centrode_core::detect::outlook::outlooks;
use centrode_core::detect::{Settings, judge};
use centrode_core::record::log::chain::{ChainMapping, ChainOptions};
use centrode_core::record::log::frame::{Frame, Setting};
use centrode_core::record::log::{
    self, Commands, Format, Log, LogError, MAX_BYTES, Mapping, Options, Rate, Setup, assemble,
};
use centrode_core::run::Replay;
use centrode_core::scenario::link::Page;
use centrode_core::scenario::{ChainScenario, Detectors, Scenario};
use centrode_core::study::about::About;
use centrode_core::study::export::signed;
use centrode_core::study::report::{Conclusions, Tally};
use centrode_core::study::timeline::Timeline;
use clap::Args;
use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// Flags of `centrode analyze`.
#[derive(Debug, Args)]
pub struct AnalyzeArgs {
    /// The log: CSV, a TUM or EuRoC trajectory, NDI tool tracking or MCAP (see docs/LOGS.md). With several segments, one that holds
    /// all trackers, or one for each of them from the base.
    #[arg(value_name = "LOG", required_unless_present = "more")]
    logs: Vec<PathBuf>,
    /// The log of one tracker of several; with its disk's number in front, as in 2=FILE, in any order.
    #[arg(long = "log", value_name = "[DISK=]LOG")]
    more: Vec<PathBuf>,
    /// Take the commands from a second log with the same clock, or from the scenario's motion.
    #[arg(long, value_name = "FILE|motion")]
    commands: Option<PathBuf>,
    #[command(flatten)]
    scenario: Nominal,
    /// Judge with these detectors alone, in place of those of detection.detectors: fcd, jfd, fcd-consistent, fcd-velocity, cusum, glr.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    detectors: Vec<String>,
    /// Say what a column is, as in x="Tx (mm)" or time=#1, with a unit of its own before the =; may be repeated.
    #[arg(long = "map", value_name = "NAME=COLUMN")]
    maps: Vec<String>,
    /// Drop readings of a lower quality.
    #[arg(long, value_name = "NUMBER")]
    min_quality: Option<f64>,
    /// Read the log as csv, tum, euroc, ndi or mcap, whatever its name and content look like.
    #[arg(long, value_name = "FORMAT")]
    format: Option<String>,
    /// Which tool of an NDI file: its number, or a part of its port or name; with several trackers one for each, from the base.
    #[arg(long = "tool", value_name = "TOOL")]
    tools: Vec<String>,
    /// Which topic of an MCAP file; may be repeated, for poses, joints and wrenches.
    #[arg(long = "topic", value_name = "TOPIC")]
    topics: Vec<String>,
    /// Fit where the log's frame is, and how the marker is turned, to the readings before detection.armed_from.
    #[arg(long)]
    fit_frame: bool,
    /// Where the log's frame is in {B}, m and rad.
    #[arg(long, value_name = "X,Y,Z,AZIMUTH,ELEVATION,ROLL", allow_hyphen_values = true, conflicts_with = "fit_frame")]
    frame: Option<String>,
    /// Hold a reading, a command or a force for at most this long, s.
    #[arg(long, value_name = "SECONDS")]
    hold: Option<f64>,
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    estimating: Estimating,
    /// Write every channel at loop rate to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw what the detectors hold against their thresholds.
    #[arg(long, value_name = "FILE.{svg,png}")]
    figure: Option<PathBuf>,
}

/// The scenario that a log is judged by.
#[derive(Debug, Args)]
struct Nominal {
    /// Scenario file (TOML): model, mounting, filter and thresholds; without it, the default scenario.
    #[arg(long = "scenario", value_name = "SCENARIO.toml", conflicts_with = "preset")]
    file: Option<PathBuf>,
    /// Judge by a preset instead of a file (see `centrode presets`).
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Judge by the scenario of a page's link: its address, or what stands behind the # in it.
    #[arg(long, value_name = "URL", conflicts_with_all = ["file", "preset"])]
    link: Option<String>,
    /// Override one key, as in detection.xi2=0.005; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
}

impl Nominal {
    fn args(&self) -> ScenarioArgs {
        let Self { file, preset, link, sets } = self;
        ScenarioArgs { file: file.clone(), preset: preset.clone(), link: link.clone(), sets: sets.clone() }
    }

    /// The experiment with several segments that is named, judged by these detectors where any is; none where it has one segment.
    fn chain(&self, detectors: &[String]) -> Result<Option<ChainScenario>, Failure> {
        let mut args = self.args();
        if !detectors.is_empty() {
            args.sets.push(format!("detection.detectors={detectors:?}"));
        }
        args.chain()
    }

    /// The scenario, and whether it says how fast the loop ran.
    fn resolved(&self) -> Result<(Scenario, Rate), Failure> {
        let Self { file, preset, link, sets } = self;
        let args = self.args();
        let named = file.is_some() || preset.is_some() || link.is_some();
        let says = named || sets.iter().any(|set| set.trim_start().starts_with("loop_rate"));
        Ok((args.scenario()?, if says { Rate::Scenario } else { Rate::Log }))
    }
}

impl AnalyzeArgs {
    /// Reads, judges and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        if let Some(scenario) = self.scenario.chain(&self.detectors)? {
            return self.chain(&scenario, out);
        }
        let log_path = self.only_log()?;
        let (mut scenario, rate) = self.scenario.resolved()?;
        let (detector, after) = (self.estimating.detector()?, self.estimating.after()?);
        if !self.detectors.is_empty() {
            scenario.detection.detectors = self.detectors()?;
        }
        let drawing = self.figure.as_deref().map(|path| Drawing::of("--figure", path)).transpose()?;
        let frame = self.frame()?;
        let (log, commands) = self.read(&log_path, &scenario)?;
        let about_log = blame(&log_path);
        let setup = Setup { rate, commands, hold: self.hold, frame, most: None };
        let assembled = assemble(&log, &scenario, &setup).map_err(&about_log)?;
        for outlook in outlooks(&log, assembled.commands).iter().filter(|outlook| !outlook.works) {
            if self.detectors.iter().any(|name| name == outlook.detector.key()) {
                return Err(about_log(LogError::file(format!(
                    "--detectors {}: {}",
                    outlook.detector.key(),
                    outlook.why
                ))));
            }
        }
        let plan = &assembled.plan;
        // A log does not know what was true.
        let mut csv = self
            .csv
            .as_deref()
            .map(|path| Table::create(path, false, plan.scenario().detection.detectors))
            .transpose()?;
        let figure = self.figure.as_deref().map(NewFile::create).transpose()?;
        let entries = &assembled.recording.entries;
        let mut timeline = figure.is_some().then(|| Timeline::new(plan.scenario(), entries.len()));
        let mut replay = Replay::new(&assembled.recording, &Settings::of(plan));
        let mut tally = Tally::new(self.json);
        while let Some(sample) = replay.next() {
            tally.add(&sample, &replay.take_crossings(), &plan.scenario().detection).map_err(too_many)?;
            if let Some(timeline) = &mut timeline {
                timeline.push(&sample);
            }
            if let Some(csv) = &mut csv {
                csv.write(&sample)?;
            }
        }
        if let Some(csv) = csv {
            csv.finish()?;
        }
        if let (Some(mut file), Some(timeline), Some(drawing)) = (figure, timeline, drawing) {
            let name = log_path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
            let chart = timeline.of_log(&name, replay.events());
            draw::write(&mut file, &signed(chart, plan.scenario(), Page::default()), drawing)?;
            file.finish()?;
        }
        let about = About::new(&log, &assembled);
        let judged = judge(&assembled.recording, &Settings::of(plan));
        let conclusions = Conclusions::of(&judged, &assembled.recording, detector, &after);
        let report = Report::new(plan.scenario().clone(), tally, replay.events(), None, conclusions, Some(about));
        print(out, &report, self.json)
    }

    /// The same with several segments.
    fn chain(&self, scenario: &ChainScenario, out: &mut impl Write) -> Result<(), Failure> {
        chain::without_figure(self.figure.as_deref())?;
        let segments = scenario.segments.len();
        let shared = self.options(scenario.common().tracker.rate)?;
        let mapping = |text: &String| ChainMapping::parse(text, segments);
        let mappings = self.maps.iter().map(mapping).collect::<Result<Vec<_>, _>>();
        let mappings = mappings.map_err(|error| Failure::Input(format!("--map: {error}")))?;
        let (file, commands) = chain::commands(self.commands.as_deref());
        let files = chain::Files { logs: self.numbered_logs(), commands: file };
        let options = ChainOptions { shared, mappings, tools: self.tools.clone() };
        let setup = Setup { rate: Rate::Scenario, commands, hold: self.hold, frame: self.frame()?, most: None };
        let (detector, after) = (self.estimating.named(), self.estimating.after()?);
        let asked = chain::Asked { detector, after, json: self.json, csv: self.csv.as_deref(), figure: None };
        chain::analyze(scenario, (&files, &options, setup), &asked, out)
    }

    /// The log of an experiment with one segment.
    fn only_log(&self) -> Result<PathBuf, Failure> {
        let logs = self.numbered_logs();
        match (logs.as_slice(), self.tools.as_slice()) {
            ([(None, log)], [] | [_]) => Ok(log.clone()),
            ([(None, _)], _) => {
                Err(Failure::Input("--tool: several of them are for a scenario with [[segment]], one for each".into()))
            }
            _ => Err(Failure::Input(
                "several logs, or one with a disk's number, are for a scenario with [[segment]]: this one has one segment".into(),
            )),
        }
    }

    /// All logs, each with the number of its disk where that stands before it.
    fn numbered_logs(&self) -> Vec<(Option<usize>, PathBuf)> {
        let numbered = |path: &PathBuf| {
            let told = path.to_str().and_then(|text| text.split_once('='));
            let number = told.and_then(|(number, rest)| Some((number.parse().ok()?, PathBuf::from(rest))));
            number.map_or_else(|| (None, path.clone()), |(number, rest)| (Some(number), rest))
        };
        self.logs.iter().chain(&self.more).map(numbered).collect()
    }

    fn frame(&self) -> Result<Setting, Failure> {
        Ok(match &self.frame {
            Some(text) => {
                Setting::Given(Frame::parse(text).map_err(|error| Failure::Input(format!("--frame: {error}")))?)
            }
            None if self.fit_frame => Setting::Fitted,
            None => Setting::Base,
        })
    }

    fn detectors(&self) -> Result<Detectors, Failure> {
        let of = |name: &String| method("--detectors", name);
        Ok(Detectors::of(&self.detectors.iter().map(of).collect::<Result<Vec<_>, _>>()?))
    }

    /// How a log is read but for its mappings; `frame_rate` (Hz) is the tracker's.
    fn options(&self, frame_rate: f64) -> Result<Options, Failure> {
        let of = |name: &String| {
            Format::ALL.into_iter().find(|format| format.key() == name).ok_or_else(|| {
                let known = Format::ALL.map(Format::key).join(", ");
                Failure::Input(format!("--format: there is no format called {name:?}; known are: {known}"))
            })
        };
        let options = Options {
            format: self.format.as_ref().map(of).transpose()?,
            min_quality: self.min_quality,
            frame_rate: Some(frame_rate),
            topics: self.topics.clone(),
            partly: self.commands.as_deref().is_some_and(|path| path != Path::new("motion")),
            ..Options::default()
        };
        for (flag, value) in [("--min-quality", self.min_quality), ("--hold", self.hold)] {
            if value.is_some_and(|value| !(0.0..=f64::MAX).contains(&value)) {
                return Err(Failure::Input(format!("{flag}: not allowed; allowed: a number from 0 up")));
            }
        }
        Ok(options)
    }

    /// The log with its commands, and where they come from when that was said.
    fn read(&self, log: &Path, scenario: &Scenario) -> Result<(Log, Option<Commands>), Failure> {
        let mappings = self.maps.iter().map(|text| Mapping::parse(text)).collect::<Result<Vec<_>, _>>();
        let mappings = mappings.map_err(|error| Failure::Input(format!("--map: {error}")))?;
        let tool = self.tools.first().cloned();
        let options = Options { mappings, tool, ..self.options(scenario.tracker.rate)? };
        let mut log = read(log, &options)?;
        let Some(path) = self.commands.as_deref() else { return Ok((log, None)) };
        if path == Path::new("motion") {
            return Ok((log, Some(Commands::Motion)));
        }
        // Mappings are for the log; what it does not hold they may name in the file of commands.
        let other = read(path, &Options { mappings: Vec::new(), format: None, ..options })?;
        let known = |topic: &&String| [&log, &other].iter().any(|log| log.topics.iter().any(|has| has.name == **topic));
        if let Some(topic) = self.topics.iter().find(|topic| !known(topic)) {
            return Err(Failure::Input(format!("--topic: there is no topic {topic:?} in either file")));
        }
        log.take_commands(other, &path.display().to_string()).map_err(blame(path))?;
        Ok((log, Some(Commands::Log)))
    }
}

/// Names the file in a refusal.
pub fn blame(path: &Path) -> impl Fn(LogError) -> Failure {
    let path = path.display().to_string();
    move |error| Failure::Input(format!("{path}: {error}"))
}

/// The bytes of a log.
pub fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes))
        .map_err(|error| Failure::Input(format!("cannot read {}: {error}", path.display())))?;
    Ok(bytes)
}

fn read(path: &Path, options: &Options) -> Result<Log, Failure> {
    log::Log::read(&path.display().to_string(), bytes(path)?, options).map_err(blame(path))
}
