//! One share of a study as a file: which study, which share, what its runs came to, and a checksum of it all.

use super::asked::{checksum, probe_detectors, probe_thresholds};
use super::{Asked, MergeError, Share};
use crate::scenario::Detectors;
use crate::study::Job;
use crate::study::compare::{Compare, Made};
use crate::study::remote::Found;
use crate::study::tuning::Study;
use crate::study::tuning::recommend::Wish;
use serde::{Deserialize, Serialize};

/// The version of the format that is written, and the only one that is read.
pub const FORMAT: u32 = 1;

/// What tells the files from others.
const NAME: &str = "centrode share of a study";

/// One share of a study, made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// The study.
    pub study: Asked,
    /// Which share of it.
    pub share: Share,
    /// Version of the program that made it.
    pub program: String,
    /// A checksum of what one repeat comes to, by which a program is found out that computes otherwise.
    pub probe: u32,
    /// What the runs came to: whole numbers, or repeats one by one with the bits of their numbers.
    pub found: Found,
}

/// What is read first: it says what else there is.
#[derive(Serialize, Deserialize)]
struct Head {
    format: String,
    version: u32,
}

/// A file.
#[derive(Serialize, Deserialize)]
struct File<T> {
    #[serde(flatten)]
    head: Head,
    /// CRC-32 of the content as JSON without spaces.
    checksum: u32,
    content: T,
}

impl Part {
    /// A share of a study of thresholds, which has made the runs of that share and no others.
    #[must_use]
    pub fn of_thresholds(study: &Study, wish: Wish, share: Share) -> Self {
        let begun = study.batches().iter().enumerate().filter(|(_, batch)| batch.tally.runs > 0);
        let tallies = begun.map(|(place, batch)| (place as u32, batch.tally.clone())).collect();
        let asked = Asked::Thresholds { spec: study.spec().clone(), wish };
        Self::new(asked, share, probe_thresholds(study), Found::Thresholds(tallies))
    }

    /// A share of a comparison of detectors, which has made the repeats of that share. `judging` are the detectors of the scenario as it
    /// is set, instead of those that are compared.
    #[must_use]
    pub fn of_detectors(compare: &Compare, judging: Detectors, share: Share) -> Self {
        let range = share.range(compare.progress().of);
        let made = compare.made(range).map(|(repeat, outcome)| Made(repeat, outcome.clone())).collect();
        let asked = Asked::Detectors { spec: compare.spec().clone(), judging };
        Self::new(asked, share, probe_detectors(compare), Found::Detectors(made))
    }

    fn new(study: Asked, share: Share, probe: u32, found: Found) -> Self {
        Self { study, share, program: env!("CARGO_PKG_VERSION").into(), probe, found }
    }

    /// The text of its file.
    ///
    /// # Errors
    /// When it cannot be written as JSON, which only a map with keys that are no words could cause, of which it has none.
    pub fn to_text(&self) -> Result<String, String> {
        let head = Head { format: NAME.into(), version: FORMAT };
        let file = File { head, checksum: checksum(self), content: self };
        serde_json::to_string(&file).map(|text| text + "\n").map_err(|error| error.to_string())
    }

    /// Reads a file that is called `name`. How its JSON is spaced does not matter.
    ///
    /// # Errors
    /// [`MergeError::NoShare`] when it is no such file, [`MergeError::Format`] when it has another version of the format, and
    /// [`MergeError::Damaged`] when it was changed or cut.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, MergeError> {
        let damaged = |what: String| MergeError::Damaged { name: name.into(), what };
        let head: Head = match serde_json::from_slice(bytes) {
            Ok(head) => head,
            // What begins like one was cut or changed.
            Err(error) if begins(bytes) => return Err(damaged(error.to_string())),
            Err(_) => return Err(MergeError::NoShare { name: name.into() }),
        };
        if head.format != NAME {
            return Err(MergeError::NoShare { name: name.into() });
        }
        if head.version != FORMAT {
            return Err(MergeError::Format { name: name.into(), version: head.version });
        }
        let file: File<Self> = serde_json::from_slice(bytes).map_err(|error| damaged(error.to_string()))?;
        let sum = checksum(&file.content);
        if sum != file.checksum {
            return Err(damaged(format!("its checksum is {sum}, not {}", file.checksum)));
        }
        Ok(file.content)
    }
}

/// Whether bytes begin as a file of ours does, however it is spaced.
fn begins(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).replace(char::is_whitespace, "");
    start.starts_with(&format!("{{\"format\":\"{}\"", NAME.replace(' ', "")))
}
