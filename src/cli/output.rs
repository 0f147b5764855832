//! How the command ends, and how it writes files and JSON.

use super::interrupt::Part;
use centrode_core::run::Sample;
use centrode_core::scenario::Detectors;
use centrode_core::study::channels;
use serde::Serialize;
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Exit code for what cannot be done as asked.
const BAD_INPUT: u8 = 2;
/// Exit code after an interrupt, as shells have it: 128 + SIGINT.
pub const INTERRUPTED: u8 = 130;

/// Why the command stops early.
#[derive(Debug)]
pub enum Failure {
    /// What was asked for cannot be done: one line for standard error.
    Input(String),
    /// Standard output is gone.
    Output(io::Error),
    /// The person ended it; what was finished has been written.
    Interrupted(String),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

impl Failure {
    /// Says why, in one line, and gives the exit code.
    pub fn report(self) -> ExitCode {
        let (code, line) = match self {
            Self::Interrupted(line) => (INTERRUPTED, line),
            Self::Output(error) if error.kind() == ErrorKind::BrokenPipe => return ExitCode::SUCCESS,
            Self::Output(error) => (BAD_INPUT, format!("cannot write the output: {error}")),
            Self::Input(line) => (BAD_INPUT, line),
        };
        say(&line);
        ExitCode::from(code)
    }
}

/// Says something beside the output, in one line.
pub fn say(line: &str) {
    let line: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    // With standard error closed as well, the exit code is all that is left.
    let _ = writeln!(io::stderr(), "centrode: {line}");
}

/// Writes a value as indented JSON and a newline.
pub fn json(out: &mut impl Write, value: &impl Serialize) -> Result<(), Failure> {
    serde_json::to_writer_pretty(&mut *out, value).map_err(io::Error::from)?;
    Ok(writeln!(out)?)
}

/// Writes one record of a CSV file.
pub fn write_record(
    csv: &mut csv::Writer<NewFile>,
    fields: impl IntoIterator<Item = impl AsRef<[u8]>>,
) -> Result<(), Failure> {
    for field in fields {
        csv.write_field(field).map_err(|error| blame(csv, error))?;
    }
    csv.write_record(None::<&[u8]>).map_err(|error| blame(csv, error))
}

/// Completes a CSV file.
pub fn finish_csv(csv: csv::Writer<NewFile>) -> Result<(), Failure> {
    csv.into_inner().map_err(|error| Failure::Input(format!("cannot write the CSV: {error}")))?.finish()
}

fn blame(csv: &csv::Writer<NewFile>, error: csv::Error) -> Failure {
    let error = match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        // Only writing can fail here: every record has as many fields as the header.
        other => io::Error::other(format!("{other:?}")),
    };
    csv.get_ref().blame(&error)
}

/// Every channel of a run or a log as CSV, row by row.
#[derive(Debug)]
pub struct Table {
    file: NewFile,
    row: String,
    /// Whether the truth is known.
    truth: bool,
    detectors: Detectors,
}

impl Table {
    /// Opens the file and writes the header.
    pub fn create(path: &Path, truth: bool, detectors: Detectors) -> Result<Self, Failure> {
        let row = channels::header(detectors);
        let mut table = Self { file: NewFile::create(path)?, row, truth, detectors };
        table.flush()?;
        Ok(table)
    }

    /// Writes the row of a sample.
    pub fn write(&mut self, sample: &Sample) -> Result<(), Failure> {
        channels::row(&mut self.row, sample, self.truth, self.detectors);
        self.flush()
    }

    fn flush(&mut self) -> Result<(), Failure> {
        let written = self.file.write_all(self.row.as_bytes());
        self.row.clear();
        written.map_err(|error| self.file.blame(&error))
    }

    /// Completes the file.
    pub fn finish(self) -> Result<(), Failure> {
        self.file.finish()
    }
}

/// A file that appears under its name only when it is complete.
#[derive(Debug)]
pub struct NewFile {
    path: PathBuf,
    writer: BufWriter<Sink>,
}

/// Where the bytes go.
#[derive(Debug)]
enum Sink {
    Part(Part),
    /// A device or a pipe cannot be replaced: it is written to as it is.
    Device(File),
}

impl NewFile {
    /// Opens a file to write; what already stands under the name stays until [`NewFile::finish`].
    pub fn create(path: &Path) -> Result<Self, Failure> {
        // What a link points to is replaced, not the link.
        let target = fs::canonicalize(path);
        let path = target.as_deref().unwrap_or(path);
        let sink = match fs::metadata(path) {
            Ok(meta) if !meta.is_file() => File::options().write(true).open(path).map(Sink::Device),
            _ => Part::beside(path).map(Sink::Part),
        };
        let sink = sink.map_err(|error| unwritable(path, &error))?;
        Ok(Self { path: path.into(), writer: BufWriter::new(sink) })
    }

    /// Completes the file.
    pub fn finish(self) -> Result<(), Failure> {
        let done = self.writer.into_inner().map_err(io::IntoInnerError::into_error).and_then(|sink| match sink {
            Sink::Part(part) => part.complete(&self.path),
            Sink::Device(_) => Ok(()),
        });
        done.map_err(|error| unwritable(&self.path, &error))
    }

    /// Names the file in a failure to write it.
    pub fn blame(&self, error: &io::Error) -> Failure {
        unwritable(&self.path, error)
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Part(part) => part.write(bytes),
            Self::Device(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Part(part) => part.flush(),
            Self::Device(file) => file.flush(),
        }
    }
}

fn unwritable(path: &Path, error: &io::Error) -> Failure {
    if error.kind() == ErrorKind::BrokenPipe {
        return Failure::Output(ErrorKind::BrokenPipe.into());
    }
    Failure::Input(format!("cannot write {}: {error}", path.display()))
}
