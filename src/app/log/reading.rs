//! A log that is being read: by a helper, or a few rows in each frame.

use super::file::{File, Kept, Parts};
use crate::app::helper::Helper;
use centrode_core::record::log::mcap::Topic;
use centrode_core::record::log::remote::{Answer, Outcome, Request};
use centrode_core::record::log::{Log, LogError, Options, Progress, Reader};

/// Rows that are read in a frame where there is no helper.
const ROWS: usize = 8192;

/// Who reads.
#[derive(Debug)]
enum Work {
    /// The helper, asked by this number.
    There(u32),
    /// Nobody yet: the bytes are on their way, of the file of this number.
    Fetching(u32),
    /// This, between frames.
    Here(Box<Reader>),
}

/// Why a log was not read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Refused {
    /// In words, without full stop.
    pub why: String,
    /// The topics that the file has, as far as it was read; the desk puts them where they belong.
    topics: Vec<Topic>,
}

impl From<LogError> for Refused {
    fn from(error: LogError) -> Self {
        Self { why: error.without_flags(), topics: Vec::new() }
    }
}

#[derive(Debug)]
struct Reading {
    parts: Parts,
    /// The log, once the second file is being read.
    first: Option<Log>,
    work: Work,
    progress: Progress,
}

impl Reading {
    /// The file that is being read.
    fn file(&self) -> &File {
        self.parts.commands.as_ref().filter(|_| self.first.is_some()).unwrap_or(&self.parts.file)
    }
}

/// Who reads, and what.
#[derive(Debug, Default)]
pub struct Desk {
    helper: Option<Box<dyn Helper>>,
    request: u32,
    reading: Option<Reading>,
    /// What came of a log before its first row.
    early: Option<(Parts, Result<Log, Refused>)>,
    /// A file whose bytes are wanted from the surroundings.
    wanted: Option<u32>,
    frame_rate: f64,
}

impl Desk {
    /// With nothing to do; `helper` reads logs, if there is one.
    #[must_use]
    pub fn new(helper: Option<Box<dyn Helper>>) -> Self {
        Self { helper, ..Self::default() }
    }

    /// Begins to read a log and forgets what it read. `frame_rate` (Hz) is the tracker's.
    pub fn read(&mut self, parts: Parts, frame_rate: f64) {
        self.cancel();
        self.frame_rate = frame_rate;
        self.begin(parts, None);
    }

    /// Reads nothing any more.
    pub fn cancel(&mut self) {
        self.early = None;
        if let Some(Reading { work: Work::There(_), .. }) = self.reading.take()
            && let Some(helper) = &mut self.helper
        {
            helper.ask(None);
        }
    }

    /// The name of what is being read, and how much of it is, 0 to 1.
    #[must_use]
    pub fn progress(&self) -> Option<(&str, f32)> {
        let reading = self.reading.as_ref()?;
        let Progress { done, of } = reading.progress;
        Some((&reading.file().name, done as f32 / of.max(1) as f32))
    }

    /// The number of a file whose bytes are wanted, once.
    pub fn wanted(&mut self) -> Option<u32> {
        self.wanted.take()
    }

    fn options(&self, parts: &Parts, second: bool) -> Options {
        let asked = Options { frame_rate: Some(self.frame_rate), ..parts.asked.options.clone() };
        // As the command has it: what is said of columns is said of the log.
        if second {
            Options { mappings: Vec::new(), format: None, topics: parts.asked.second_topics.clone(), ..asked }
        } else {
            asked
        }
    }

    fn begin(&mut self, parts: Parts, first: Option<Log>) {
        let second = first.is_some();
        let file = parts.commands.as_ref().filter(|_| second).unwrap_or(&parts.file).clone();
        let options = self.options(&parts, second);
        let progress = Progress { done: 0, of: 1 };
        let work = match &file.kept {
            Kept::Here(bytes) => {
                let bytes = bytes.to_vec();
                return self.begin_here(parts, first, &file.name, bytes);
            }
            Kept::There(number) => {
                self.request += 1;
                let request = serde_json::to_string(&Request::new(self.request, *number, &file.name, &options));
                match (&mut self.helper, request) {
                    (Some(helper), Ok(request)) => {
                        helper.ask(Some(&request));
                        Work::There(self.request)
                    }
                    _ => {
                        self.wanted = Some(*number);
                        Work::Fetching(*number)
                    }
                }
            }
        };
        self.reading = Some(Reading { parts, first, work, progress });
    }

    fn begin_here(&mut self, parts: Parts, first: Option<Log>, name: &str, bytes: Vec<u8>) {
        let progress = Progress { done: 0, of: bytes.len() };
        match Reader::new(name, bytes, &self.options(&parts, first.is_some())) {
            Ok(reader) => {
                self.reading = Some(Reading { parts, first, work: Work::Here(Box::new(reader)), progress });
            }
            Err(error) => {
                let refused = Refused::from(error);
                let why = if first.is_some() { format!("{name}: {}", refused.why) } else { refused.why };
                self.early = Some((parts, Err(Refused { why, ..Refused::default() })));
            }
        }
    }

    /// The bytes that were [`wanted`](Self::wanted) have come, or why they cannot; or why the helper could not have them.
    pub fn fetched(&mut self, number: u32, bytes: Result<Vec<u8>, String>) {
        let waits = |reading: &Reading| match reading.work {
            Work::Fetching(wanted) => wanted == number,
            Work::There(_) => bytes.is_err() && matches!(reading.file().kept, Kept::There(there) if there == number),
            Work::Here(_) => false,
        };
        if !self.reading.as_ref().is_some_and(waits) {
            return;
        }
        let Some(reading) = self.reading.take() else { return };
        let name = reading.file().name.clone();
        match bytes {
            Ok(bytes) => self.begin_here(reading.parts, reading.first, &name, bytes),
            Err(why) => self.early = Some((reading.parts, Err(Refused { why, topics: Vec::new() }))),
        }
    }

    /// Reads on. Gives a log that is read, or why it is not.
    pub fn work(&mut self) -> Option<(Parts, Result<Log, Refused>)> {
        if self.helper.as_ref().is_some_and(|helper| helper.failure().is_some()) {
            // From now on everything is read here.
            self.helper = None;
            if let Some(Reading { parts, first, .. }) = self.reading.take_if(|r| matches!(r.work, Work::There(_))) {
                self.begin(parts, first);
            }
        }
        let outcome = match self.early.take() {
            Some(early) => return Some(early),
            None => self.step()?,
        };
        let Reading { mut parts, first, .. } = self.reading.take()?;
        let topics = match &outcome {
            Ok(log) => &log.topics,
            Err(refused) => &refused.topics,
        };
        parts.topics[usize::from(first.is_some())].clone_from(topics);
        let named = |refused: Refused, parts: &Parts| {
            let name = parts.commands.as_ref().map_or("", |file| &file.name);
            Refused { why: format!("{name}: {}", refused.why), ..refused }
        };
        match (outcome, first) {
            (Ok(log), None) if parts.commands.is_some() && !parts.asked.motion => {
                self.begin(parts, Some(log));
                None
            }
            (Ok(commands), Some(mut log)) => {
                let name = parts.commands.as_ref().map_or("", |file| &file.name);
                let taken = log.take_commands(commands, name).map_err(|error| named(error.into(), &parts));
                Some((parts, taken.map(|()| log)))
            }
            (Err(refused), Some(_)) => {
                let refused = named(refused, &parts);
                Some((parts, Err(refused)))
            }
            (outcome, None) => Some((parts, outcome)),
        }
    }

    /// Whether the next frame should come at once, to read on.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.early.is_some() || self.reading.as_ref().is_some_and(|reading| matches!(reading.work, Work::Here(_)))
    }

    /// A few rows, or what the helper has sent. What came of the file, once something did.
    fn step(&mut self) -> Option<Result<Log, Refused>> {
        let reading = self.reading.as_mut()?;
        match &mut reading.work {
            Work::Fetching(_) => None,
            Work::There(request) => {
                for answer in self.helper.as_mut()?.take() {
                    match Answer::from_bytes(&answer) {
                        Ok(Answer { id, .. }) if id != *request => {}
                        Ok(Answer { outcome: Outcome::Reading(progress), .. }) => reading.progress = progress,
                        Ok(Answer { outcome: Outcome::Read(log), .. }) => return Some(Ok(*log)),
                        Ok(Answer { outcome: Outcome::Refused(error, topics), .. }) => {
                            return Some(Err(Refused { topics, ..error.into() }));
                        }
                        Err(error) => {
                            let why = format!("What was read cannot be taken: {error}");
                            return Some(Err(Refused { why, topics: Vec::new() }));
                        }
                    }
                }
                None
            }
            Work::Here(reader) => match reader.work(ROWS) {
                Ok(progress) if !progress.is_done() => {
                    reading.progress = progress;
                    None
                }
                Ok(_) => {
                    let topics = reader.topics();
                    let done = Work::Fetching(u32::MAX);
                    let Work::Here(reader) = std::mem::replace(&mut reading.work, done) else { return None };
                    Some(reader.finish().map_err(|error| Refused { topics, ..error.into() }))
                }
                Err(error) => Some(Err(Refused { topics: reader.topics(), ..error.into() })),
            },
        }
    }
}
