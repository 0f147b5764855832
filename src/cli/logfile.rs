//! `--log FILE`: a simulated run as the log that a rig would have recorded.

use super::output::{Failure, NewFile};
use centrode_core::record::Entry;
use centrode_core::record::log::write;
use centrode_core::scenario::Plan;
use centrode_core::sensors::tracker::refresh;
use std::io::Write;
use std::path::Path;

/// A log that is being written, row by row.
#[derive(Debug)]
pub struct LogFile {
    file: NewFile,
    kind: Kind,
    text: String,
}

#[derive(Debug)]
enum Kind {
    Csv,
    /// The tracker's rate, Hz, and the refresh written last.
    Tum(f64, Option<f64>),
}

impl LogFile {
    /// Opens the log of a plan's run; its extension says how it is written.
    pub fn create(path: &Path, plan: &Plan) -> Result<Self, Failure> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        let kind = match extension.as_deref() {
            Some("csv") => Kind::Csv,
            Some("tum") => Kind::Tum(plan.scenario().tracker.rate, None),
            other => {
                let what =
                    other.map_or("the extension is missing".into(), |other| format!("unknown extension .{other}"));
                return Err(Failure::Input(format!("--log {}: {what}; known are: .csv, .tum", path.display())));
            }
        };
        let text = if matches!(kind, Kind::Csv) { write::csv_header() } else { write::tum_header().into() };
        let mut log = Self { file: NewFile::create(path)?, kind, text };
        log.flush()?;
        Ok(log)
    }

    /// Writes what the loop stored.
    pub fn write(&mut self, entry: Option<&Entry>) -> Result<(), Failure> {
        let Some(entry) = entry else { return Ok(()) };
        match &mut self.kind {
            Kind::Csv => write::csv_row(&mut self.text, entry),
            Kind::Tum(rate, last) => {
                let now = Some(refresh(*rate, entry.time));
                if std::mem::replace(last, now) == now {
                    return Ok(());
                }
                write::tum_row(&mut self.text, entry);
            }
        }
        self.flush()
    }

    /// Completes the file.
    pub fn finish(self) -> Result<(), Failure> {
        self.file.finish()
    }

    fn flush(&mut self) -> Result<(), Failure> {
        self.file.write_all(self.text.as_bytes()).map_err(|error| self.file.blame(&error))?;
        self.text.clear();
        Ok(())
    }
}
