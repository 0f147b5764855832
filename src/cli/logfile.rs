//! `--log FILE`: a simulated run as the log that a rig would have recorded.

use super::output::{Failure, NewFile};
use centrode_core::record::Entry;
use centrode_core::record::log::mcap::write as mcap;
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
    /// What is not in the file yet.
    pending: Vec<u8>,
    /// The tracker's rate, Hz, and the refresh written last.
    rate: f64,
    last: Option<f64>,
}

#[derive(Debug)]
enum Kind {
    Csv,
    Tum,
    /// The robot's pitch radius, m; readings and instants so far.
    Mcap(f64, u32, u32),
}

impl LogFile {
    /// Opens the log of a plan's run; its extension says how it is written.
    pub fn create(path: &Path, plan: &Plan) -> Result<Self, Failure> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        let mut pending = Vec::new();
        let kind = match extension.as_deref() {
            Some("csv") => {
                pending.extend(write::csv_header().into_bytes());
                Kind::Csv
            }
            Some("tum") => {
                pending.extend(write::tum_header().as_bytes());
                Kind::Tum
            }
            Some("mcap") => {
                mcap::begin(&mut pending);
                Kind::Mcap(plan.segment().pitch_radius, 0, 0)
            }
            other => {
                let what =
                    other.map_or("the extension is missing".into(), |other| format!("unknown extension .{other}"));
                return Err(Failure::Input(format!("--log {}: {what}; known are: .csv, .tum, .mcap", path.display())));
            }
        };
        let rate = plan.scenario().tracker.rate;
        Ok(Self { file: NewFile::create(path)?, kind, pending, rate, last: None })
    }

    /// Writes what the loop stored.
    pub fn write(&mut self, entry: Option<&Entry>) -> Result<(), Failure> {
        let Some(entry) = entry else { return Ok(()) };
        let now = Some(refresh(self.rate, entry.time));
        let fresh = std::mem::replace(&mut self.last, now) != now;
        let mut text = String::new();
        match &mut self.kind {
            Kind::Csv => write::csv_row(&mut text, entry),
            Kind::Tum if fresh => write::tum_row(&mut text, entry),
            Kind::Tum => {}
            Kind::Mcap(pitch_radius, readings, instants) => {
                if fresh {
                    mcap::pose(&mut self.pending, *readings, entry);
                    *readings = readings.wrapping_add(1);
                }
                mcap::state(&mut self.pending, *instants, entry, *pitch_radius);
                *instants = instants.wrapping_add(1);
            }
        }
        self.pending.extend(text.into_bytes());
        self.flush()
    }

    /// Completes the file.
    pub fn finish(mut self) -> Result<(), Failure> {
        if matches!(self.kind, Kind::Mcap(..)) {
            mcap::end(&mut self.pending);
        }
        self.flush()?;
        self.file.finish()
    }

    fn flush(&mut self) -> Result<(), Failure> {
        self.file.write_all(&self.pending).map_err(|error| self.file.blame(&error))?;
        self.pending.clear();
        Ok(())
    }
}
