//! Logs of experiments with several segments: written, read and judged.

use super::{Asked, MOST, detector, print, write_csv};
use crate::cli::analyze::{blame, bytes};
use crate::cli::output::{Failure, NewFile};
use centrode_core::record::chain::ChainRecording;
use centrode_core::record::log::chain::{ChainLog, ChainOptions, Expected, assemble, read};
use centrode_core::record::log::{Commands, Setup, write};
use centrode_core::scenario::ChainScenario;
use centrode_core::study::about::ChainAbout;
use centrode_core::study::chain::ChainRun;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The files of a log.
pub(in crate::cli) struct Files {
    /// A log of all trackers, or one for each of them, with the disk (from 1) where that is said.
    pub logs: Vec<(Option<usize>, PathBuf)>,
    /// A file with the commands.
    pub commands: Option<PathBuf>,
}

impl Files {
    /// Reads all of them.
    fn read(&self, scenario: &ChainScenario, options: &ChainOptions) -> Result<ChainLog, Failure> {
        let mut log = ChainLog::new(scenario.segments.len());
        let of = Expected::of(scenario);
        let disks = self.disks(&of)?;
        for ((_, path), disk) in self.logs.iter().zip(disks) {
            let name = path.display().to_string();
            let of = Expected { disk, ..of.clone() };
            let read = read(&name, bytes(path)?, &of, options).map_err(blame(path))?;
            log.take(read, if self.logs.len() > 1 { &name } else { "" }).map_err(blame(path))?;
        }
        if let Some(path) = &self.commands {
            // Mappings are for the log.
            let mut options = ChainOptions { mappings: Vec::new(), ..options.clone() };
            options.shared.format = None;
            let of = Expected { commands_alone: true, ..of };
            let name = path.display().to_string();
            let read = read(&name, bytes(path)?, &of, &options).map_err(blame(path))?;
            log.take_commands(read, &name).map_err(blame(path))?;
        }
        Ok(log)
    }

    /// Of which disk (from 0) each file tells; none of one that says so itself.
    fn disks(&self, of: &Expected) -> Result<Vec<Option<usize>>, Failure> {
        let named: Vec<usize> = self.logs.iter().filter_map(|(disk, _)| *disk).collect();
        if let Some(wrong) = named.iter().find(|disk| !(1..=of.segments).contains(*disk)) {
            return Err(Failure::Input(format!(
                "a log of disk {wrong}: the scenario has {0} segments; allowed: 1 to {0}",
                of.segments
            )));
        }
        if named.is_empty() && self.logs.len() == 1 {
            return Ok(vec![None]);
        }
        let mut free = of.trackers().filter(|disk| !named.contains(&(disk + 1)));
        let mut each = Vec::new();
        for (disk, _) in &self.logs {
            each.push(disk.map(|disk| disk - 1).or_else(|| free.next()));
        }
        if each.contains(&None) || free.next().is_some() {
            return Err(Failure::Input(format!(
                "{} logs, and {} end disks carry trackers: give one log for each, from the base, or one that holds them all",
                self.logs.len(),
                of.trackers().len()
            )));
        }
        Ok(each)
    }
}

/// Reads, judges and reports.
pub(in crate::cli) fn analyze(
    scenario: &ChainScenario,
    (files, options, setup): (&Files, &ChainOptions, Setup),
    asked: &Asked,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let told = asked.detector.map(|name| detector(scenario, name)).transpose()?;
    let log = files.read(scenario, options)?;
    let about = files.logs.first().map(|(_, path)| path.clone()).unwrap_or_default();
    let setup = Setup { most: Some(MOST), ..setup };
    let assembled = assemble(log, scenario, &setup).map_err(blame(&about))?;
    let csv = asked.csv.map(NewFile::create).transpose()?;
    let run = ChainRun::recorded(&assembled)
        .map_err(|unsettled| Failure::Input(format!("as the experiment begins, there is {unsettled}")))?;
    if let Some(file) = csv {
        write_csv(file, &run)?;
    }
    let mut report = run.report(told, &asked.after);
    report.log = Some(ChainAbout::new(&assembled));
    print(out, &report, asked.json)
}

/// A file that a log with several trackers can be written to.
pub(super) fn checked(path: &Path) -> Result<&Path, Failure> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("csv") => Ok(path),
        Some("tum" | "mcap") => Err(Failure::Input(format!(
            "--log {}: an experiment with several segments is written as .csv, with columns for every tracker",
            path.display()
        ))),
        other => {
            let what = other.map_or("the extension is missing".into(), |other| format!("unknown extension .{other}"));
            Err(Failure::Input(format!("--log {}: {what}; known is: .csv", path.display())))
        }
    }
}

/// Writes what the rig would have recorded.
pub(super) fn write_log(path: &Path, recording: &ChainRecording) -> Result<(), Failure> {
    let mut file = NewFile::create(path)?;
    let mut text = write::chain_csv_header(recording);
    for at in 0..recording.times.len() {
        write::chain_csv_row(&mut text, recording, at);
        file.write_all(text.as_bytes()).map_err(|error| file.blame(&error))?;
        text.clear();
    }
    file.finish()
}

/// Where the commands come from, by the flag.
pub(in crate::cli) fn commands(flag: Option<&Path>) -> (Option<PathBuf>, Option<Commands>) {
    match flag {
        Some(path) if path == Path::new("motion") => (None, Some(Commands::Motion)),
        other => (other.map(Path::to_path_buf), None),
    }
}
