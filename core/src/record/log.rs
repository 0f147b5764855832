//! Logs of a rig: reading and writing the files, and making a recording of what they hold.
//!
//! Everything works on bytes. A [`Reader`] reads a piece at a time into a [`Log`], which holds what the file holds: readings,
//! commands and load cells, each with its own times. [`assemble`](mod@assemble) puts them on the loop's clock, as a
//! [`Recording`](super::Recording) without truth. Nothing is repaired silently: a [`Report`] counts what was dropped and what
//! was held, and a [`LogError`] names line and column. `docs/LOGS.md` specifies the formats.

pub mod assemble;
pub mod chain;
pub mod error;
pub mod frame;
pub mod gather;
pub mod header;
pub mod mcap;
pub mod remote;
pub mod report;
pub mod rotation;
pub mod text;
pub mod units;
pub mod write;

pub use assemble::{Assembled, Commands, Rate, Setup, assemble};
pub use error::LogError;
pub use gather::Track;
pub use header::{Column, Mapping, Origin, Role};
pub use report::{Count, Happening, Place, Report};

use mcap::{McapReader, Topic};
use serde::{Deserialize, Serialize};
use text::TextReader;

/// The largest log that is read, bytes.
pub const MAX_BYTES: u64 = 1 << 30;

/// How a log is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Format {
    /// Columns with a header.
    Csv,
    /// `timestamp tx ty tz qx qy qz qw`, as the TUM benchmark has it.
    Tum,
    /// `#timestamp [ns], p_RS_R_x [m], …`, as the EuRoC data sets have it: the quaternion's scalar first.
    Euroc,
    /// NDI tool tracking: one group of columns for each tool.
    Ndi,
    /// ROS messages in an MCAP container.
    Mcap,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Csv, Self::Tum, Self::Euroc, Self::Ndi, Self::Mcap];

    /// Its key on the command line.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Tum => "tum",
            Self::Euroc => "euroc",
            Self::Ndi => "ndi",
            Self::Mcap => "mcap",
        }
    }

    /// What it is called.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Csv => "CSV",
            Self::Tum => "TUM trajectory",
            Self::Euroc => "EuRoC trajectory",
            Self::Ndi => "NDI tool tracking",
            Self::Mcap => "MCAP",
        }
    }

    /// What a file with this name and content is taken for.
    #[must_use]
    pub fn guess(name: &str, bytes: &[u8]) -> Self {
        let extension = name.rsplit_once('.').map_or(String::new(), |(_, extension)| extension.to_lowercase());
        match extension.as_str() {
            "mcap" => Self::Mcap,
            _ if bytes.starts_with(mcap::container::MAGIC) => Self::Mcap,
            "tum" => Self::Tum,
            _ if text::head::looks_like_euroc(bytes) => Self::Euroc,
            _ if text::ndi::looks_like(bytes) => Self::Ndi,
            _ if text::head::looks_like_tum(bytes) => Self::Tum,
            _ => Self::Csv,
        }
    }
}

/// How a log is read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Its format; none to guess it.
    pub format: Option<Format>,
    /// Columns that a person says what they are.
    pub mappings: Vec<Mapping>,
    /// Readings of a lower quality are dropped; none drops those of 0 or less.
    pub min_quality: Option<f64>,
    /// Which tool of an NDI file: its number from 1, or a part of its name.
    pub tool: Option<String>,
    /// Rate of the tracker, Hz, where a file numbers its frames and has no times.
    pub frame_rate: Option<f64>,
    /// Which topics of an MCAP file, where several could be meant.
    pub topics: Vec<String>,
    /// Whether a topic may be one of another file that is read with the same options.
    pub partly: bool,
    /// What the columns of a CSV file are, where that is decided already: [`chain`] does so for each of several trackers.
    pub columns: Option<Vec<Column>>,
    /// The segment (from 0, and of how many) whose joints are read in an MCAP file that names the segments of joints.
    pub segment: Option<(usize, usize)>,
}

/// What a log holds, before it is a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Log {
    /// How it is written.
    pub format: Format,
    /// Its columns, as they were understood.
    pub columns: Vec<Column>,
    /// Readings of the tracker: x, y, z (m), azimuth, elevation, roll (rad; NaN in a log without orientation), in the log's frame.
    pub readings: Track<6>,
    /// Commanded bend and δ, rad; δ is NaN in a log without it.
    pub commands: Track<2>,
    /// Commanded joint values, m: in place of `commands`.
    pub joints: Track<3>,
    /// What the load cells read, N; NaN where the log has no number.
    pub forces: Track<3>,
    /// What its times are counted from, s: 0, or the first row's time where a double of it would lose digits.
    pub origin: f64,
    /// The topics of an MCAP file.
    pub topics: Vec<Topic>,
    /// What was done with its rows.
    pub report: Report,
}

impl Log {
    pub(crate) fn new(format: Format, columns: Vec<Column>) -> Self {
        Self {
            format,
            columns,
            readings: Track::default(),
            commands: Track::default(),
            joints: Track::default(),
            forces: Track::default(),
            origin: 0.0,
            topics: Vec::new(),
            report: Report::default(),
        }
    }

    /// Reads a whole file at once.
    ///
    /// # Errors
    /// Where it is refused, and why.
    pub fn read(name: &str, bytes: Vec<u8>, options: &Options) -> Result<Self, LogError> {
        let mut reader = Reader::new(name, bytes, options)?;
        while !reader.work(usize::MAX)?.is_done() {}
        reader.finish()
    }

    /// Whether its readings have an orientation.
    #[must_use]
    pub fn has_orientation(&self) -> bool {
        self.readings.values.first().is_some_and(|value| !value[3].is_nan())
    }

    /// Whether it holds commands.
    #[must_use]
    pub fn has_commands(&self) -> bool {
        !self.commands.is_empty() || !self.joints.is_empty()
    }

    /// Takes commands, and load cells where this log has none, from a second one with the same clock, a file called `name`.
    ///
    /// # Errors
    /// When the second one holds no commands.
    pub fn take_commands(&mut self, mut other: Self, name: &str) -> Result<(), LogError> {
        if !other.has_commands() {
            return Err(LogError::file("holds no command: name columns theta_l or bend, or q1, q2 and q3"));
        }
        self.report.merge(&other.report, name);
        if other.origin != self.origin {
            let later = other.origin - self.origin;
            let tracks = [&mut other.commands.times, &mut other.joints.times, &mut other.forces.times];
            tracks.into_iter().flatten().for_each(|time| *time += later);
        }
        for file in [&mut other.commands.file, &mut other.joints.file, &mut other.forces.file] {
            *file = name.into();
        }
        (self.commands, self.joints) = (other.commands, other.joints);
        if self.forces.is_empty() {
            self.forces = other.forces;
        }
        Ok(())
    }
}

/// How far a reader has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Bytes read.
    pub done: usize,
    /// Bytes of the file.
    pub of: usize,
}

impl Progress {
    /// Whether all is read.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.done >= self.of
    }
}

/// Reads a log a piece at a time, so that whoever drives it can show progress and stop.
#[derive(Debug)]
pub struct Reader {
    inner: Inner,
}

#[derive(Debug)]
enum Inner {
    Text(Box<TextReader>),
    Mcap(Box<McapReader>),
}

impl Reader {
    /// Looks at the beginning of a file called `name`.
    ///
    /// # Errors
    /// When it is empty, its format is not known, or its header does not say enough.
    pub fn new(name: &str, bytes: Vec<u8>, options: &Options) -> Result<Self, LogError> {
        if bytes.len() as u64 > MAX_BYTES {
            return Err(LogError::file("is larger than 1 GiB: cut it into parts"));
        }
        let format = options.format.unwrap_or_else(|| Format::guess(name, &bytes));
        let inner = match format {
            Format::Mcap => Inner::Mcap(Box::new(McapReader::new(bytes, options)?)),
            text => Inner::Text(Box::new(TextReader::new(text, bytes, options)?)),
        };
        Ok(Self { inner })
    }

    /// How it is written.
    #[must_use]
    pub fn format(&self) -> Format {
        match &self.inner {
            Inner::Text(text) => text.log().format,
            Inner::Mcap(_) => Format::Mcap,
        }
    }

    /// The columns of a text log, as they were understood.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        match &self.inner {
            Inner::Text(text) => &text.log().columns,
            Inner::Mcap(_) => &[],
        }
    }

    /// The topics of an MCAP file, as far as it is read.
    #[must_use]
    pub fn topics(&self) -> Vec<Topic> {
        match &self.inner {
            Inner::Text(_) => Vec::new(),
            Inner::Mcap(mcap) => mcap.topics().cloned().collect(),
        }
    }

    /// Reads at most `rows` more.
    ///
    /// # Errors
    /// The first row that cannot be read, with line and column.
    pub fn work(&mut self, rows: usize) -> Result<Progress, LogError> {
        match &mut self.inner {
            Inner::Text(text) => text.work(rows),
            Inner::Mcap(mcap) => mcap.work(rows),
        }
    }

    /// What was read.
    ///
    /// # Errors
    /// When there was nothing of use, or several topics could be meant.
    pub fn finish(self) -> Result<Log, LogError> {
        let log = match self.inner {
            Inner::Text(text) => text.finish(),
            Inner::Mcap(mcap) => mcap.finish()?,
        };
        if log.readings.is_empty() && !log.has_commands() && log.forces.is_empty() {
            return Err(LogError::file(format!("holds no row that can be used ({} were read)", log.report.rows)));
        }
        Ok(log)
    }
}
