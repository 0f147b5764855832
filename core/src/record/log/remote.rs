//! A log read elsewhere: what is asked (JSON), and what is answered (postcard), piece by piece.
//!
//! A worker on the page has its own memory: it is told how to read a file and sends back how far it has come, and at the end what
//! the file holds.

use super::error::LogError;
use super::gather::Track;
use super::header::{Column, Mapping, Origin, Role};
use super::mcap::Topic;
use super::report::Report;
use super::units::Dimension;
use super::{Format, Log, Options, Progress, Reader};
use serde::{Deserialize, Serialize};

/// Rows that are read between two looks at the clock.
const PIECE: usize = 4096;

/// What is asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Number of the request, which its answers bear.
    pub id: u32,
    /// Number of the file, by which whoever keeps it knows it.
    pub file: u32,
    /// The file's name.
    pub name: String,
    format: Option<Format>,
    mappings: Vec<String>,
    min_quality: Option<f64>,
    tool: Option<String>,
    frame_rate: Option<f64>,
    topics: Vec<String>,
}

impl Request {
    /// To read a file in a way.
    #[must_use]
    pub fn new(id: u32, file: u32, name: &str, options: &Options) -> Self {
        let Options { format, mappings, min_quality, tool, frame_rate, topics, partly: _, columns: _, segment: _ } =
            options;
        Self {
            id,
            file,
            name: name.into(),
            format: *format,
            mappings: mappings.iter().map(ToString::to_string).collect(),
            min_quality: *min_quality,
            tool: tool.clone(),
            frame_rate: *frame_rate,
            topics: topics.clone(),
        }
    }

    fn options(&self) -> Result<Options, LogError> {
        Ok(Options {
            format: self.format,
            mappings: self.mappings.iter().map(|text| Mapping::parse(text)).collect::<Result<_, _>>()?,
            min_quality: self.min_quality,
            tool: self.tool.clone(),
            frame_rate: self.frame_rate,
            topics: self.topics.clone(),
            partly: false,
            columns: None,
            segment: None,
        })
    }
}

/// How far a reader has come, or what came of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// So far.
    Reading(Progress),
    /// It was read.
    Read(Box<Log>),
    /// It was refused.
    Refused(LogError, Vec<Topic>),
}

/// What is answered.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Number of the request.
    pub id: u32,
    /// What came of it.
    pub outcome: Outcome,
}

impl Answer {
    /// From bytes.
    ///
    /// # Errors
    /// When they are no answer.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let malformed = |error: postcard::Error| format!("an answer of {} bytes: {error}", bytes.len());
        let (id, sent): (u32, Sent) = postcard::from_bytes(bytes).map_err(malformed)?;
        let outcome = match sent {
            Sent::Reading(done, of) => Outcome::Reading(Progress { done: done as usize, of: of as usize }),
            Sent::Read(packed) => {
                Outcome::Read(Box::new(packed.unpacked().ok_or("an answer that contradicts itself")?))
            }
            Sent::Refused(error, topics) => Outcome::Refused(error, topics),
        };
        Ok(Self { id, outcome })
    }
}

#[derive(Serialize, Deserialize)]
enum Sent {
    Reading(u64, u64),
    Read(Box<Packed>),
    Refused(LogError, Vec<Topic>),
}

/// A log without borrowed names, its values one after the other.
#[derive(Serialize, Deserialize)]
struct Packed {
    format: Format,
    columns: Vec<PackedColumn>,
    readings: Values,
    commands: Values,
    joints: Values,
    forces: Values,
    origin: f64,
    topics: Vec<Topic>,
    report: Report,
}

#[derive(Serialize, Deserialize)]
struct PackedColumn {
    place: u64,
    header: String,
    role: Option<Role>,
    unit: String,
    unit_given: bool,
    origin: Origin,
}

#[derive(Serialize, Deserialize)]
struct Values {
    times: Vec<f64>,
    lines: Vec<u32>,
    values: Vec<f64>,
}

impl Values {
    fn of<const D: usize>(track: Track<D>) -> Self {
        Self { times: track.times, lines: track.lines, values: track.values.into_flattened() }
    }

    fn track<const D: usize>(self) -> Option<Track<D>> {
        let (values, rest) = self.values.as_chunks::<D>();
        let count = self.times.len();
        let whole = rest.is_empty() && values.len() == count && self.lines.len() == count;
        let file = String::new();
        whole.then(|| Track { values: values.to_vec(), times: self.times, lines: self.lines, file })
    }
}

impl Packed {
    fn of(log: Log) -> Self {
        let Log { format, columns, readings, commands, joints, forces, origin, topics, report } = log;
        let column = |Column { place, header, role, unit, unit_given, origin }| PackedColumn {
            place: place as u64,
            header,
            role,
            unit: unit.into(),
            unit_given,
            origin,
        };
        Self {
            format,
            columns: columns.into_iter().map(column).collect(),
            readings: Values::of(readings),
            commands: Values::of(commands),
            joints: Values::of(joints),
            forces: Values::of(forces),
            origin,
            topics,
            report,
        }
    }

    fn unpacked(self) -> Option<Log> {
        let column = |PackedColumn { place, header, role, unit, unit_given, origin }| Column {
            place: place as usize,
            header,
            role,
            unit: role.map_or(Dimension::None, Role::dimension).unit(&unit).map_or("", |unit| unit.name),
            unit_given,
            origin,
        };
        Some(Log {
            format: self.format,
            columns: self.columns.into_iter().map(column).collect(),
            readings: self.readings.track()?,
            commands: self.commands.track()?,
            joints: self.joints.track()?,
            forces: self.forces.track()?,
            origin: self.origin,
            topics: self.topics,
            report: self.report,
        })
    }
}

/// The reader on the side of whoever reads.
#[derive(Debug)]
pub struct Remote {
    id: u32,
    reader: Option<Reader>,
    outcome: Outcome,
}

impl Remote {
    /// Takes a request as JSON, and the file's bytes.
    ///
    /// # Errors
    /// When it is none. A file that is refused is an answer.
    pub fn new(request: &str, bytes: Vec<u8>) -> Result<Self, String> {
        let request: Request = serde_json::from_str(request).map_err(|error| error.to_string())?;
        let progress = Progress { done: 0, of: bytes.len() };
        let reader = request.options().and_then(|options| Reader::new(&request.name, bytes, &options));
        let (reader, outcome) = match reader {
            Ok(reader) => (Some(reader), Outcome::Reading(progress)),
            Err(error) => (None, Outcome::Refused(error, Vec::new())),
        };
        Ok(Self { id: request.id, reader, outcome })
    }

    /// Reads some rows; returns whether any are left.
    pub fn step(&mut self) -> bool {
        let Some(mut reader) = self.reader.take() else { return false };
        self.outcome = match reader.work(PIECE) {
            Ok(progress) if !progress.is_done() => {
                self.reader = Some(reader);
                Outcome::Reading(progress)
            }
            Ok(_) => {
                let topics = reader.topics();
                match reader.finish() {
                    Ok(log) => Outcome::Read(Box::new(log)),
                    Err(error) => Outcome::Refused(error, topics),
                }
            }
            Err(error) => Outcome::Refused(error, reader.topics()),
        };
        self.reader.is_some()
    }

    /// How far it has come, or what came of it, as bytes; a log once only.
    ///
    /// # Errors
    /// When it cannot be written, which only a type of unknown length could cause, of which an answer has none.
    pub fn answer(&mut self) -> Result<Vec<u8>, String> {
        let nothing = Outcome::Reading(Progress { done: 0, of: 0 });
        let sent = match std::mem::replace(&mut self.outcome, nothing) {
            Outcome::Reading(Progress { done, of }) => Sent::Reading(done as u64, of as u64),
            Outcome::Read(log) => Sent::Read(Box::new(Packed::of(*log))),
            Outcome::Refused(error, topics) => Sent::Refused(error, topics),
        };
        postcard::to_allocvec(&(self.id, sent)).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "time [ms],Tx (mm),y [mm],z [mm],rx,ry,rz,note\n0,1,2,3,0,0,0,a\n10,1.5,2,3,0,0.1,0,b\n";

    fn answered(text: &str, options: &Options) -> Answer {
        let request = serde_json::to_string(&Request::new(7, 1, "a.csv", options)).expect("JSON");
        let mut remote = Remote::new(&request, text.into()).expect("a request");
        while remote.step() {}
        Answer::from_bytes(&remote.answer().expect("bytes")).expect("an answer")
    }

    #[test]
    fn what_was_read_elsewhere_is_what_is_read_here() {
        let mapped = Mapping::parse("z [m]=y [mm]").expect("a mapping");
        let options = Options { mappings: vec![mapped], ..Options::default() };
        for (text, options) in [(TEXT, &Options::default()), (&TEXT.replace(",z [mm]", ",u"), &options)] {
            let here = Log::read("a.csv", text.into(), options).map_err(|error| Outcome::Refused(error, Vec::new()));
            let here = here.map_or_else(|refused| refused, |log| Outcome::Read(Box::new(log)));
            assert_eq!(answered(text, options), Answer { id: 7, outcome: here });
        }
        assert!(matches!(answered("a,b\n", &Options::default()).outcome, Outcome::Refused(..)));
    }

    #[test]
    fn what_is_no_request_or_answer_is_refused() {
        assert!(Remote::new("{}", Vec::new()).is_err());
        assert!(Answer::from_bytes(&[1, 1, 3]).is_err());
    }
}
