//! Studies made elsewhere: what is asked (JSON), and what is answered (postcard), piece by piece.
//!
//! A worker on the page has its own memory: it is told what to study and sends back what it has found.

use super::chain::ChainRun;
use super::chain::placing::{self, Part, Placing};
use super::compare::{self, Compare, Piece};
use super::tuning::tally::Tally;
use super::tuning::{self, Study};
use serde::{Deserialize, Serialize};

/// What is asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Number of the request, which its answers bear.
    pub id: u32,
    /// What is to be made.
    pub work: Work,
}

/// What is to be made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Work {
    /// Batches of a study of thresholds.
    Thresholds {
        /// The study.
        spec: tuning::Spec,
        /// The batches to make.
        batches: Vec<usize>,
    },
    /// Pieces of a comparison of detectors.
    Detectors {
        /// The comparison.
        spec: compare::Spec,
        /// The pieces to make, in this order.
        pieces: Vec<Piece>,
    },
    /// The contacts of an experiment with several segments, told and placed.
    Contacts(placing::Spec),
}

/// What is answered: what has been found since the answer before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// Number of the request.
    pub id: u32,
    /// What has been found.
    pub found: Found,
}

/// What has been found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Found {
    /// Place of a batch in the study of thresholds, and its tally, which has grown.
    Thresholds(Vec<(u32, Tally)>),
    /// Pieces of the comparison.
    Detectors(Vec<compare::Made>),
    /// Contacts, and estimates of them, in the order in which they were made.
    Contacts(Vec<Part>),
}

impl Answer {
    /// From bytes.
    ///
    /// # Errors
    /// When they are no answer.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        postcard::from_bytes(bytes).map_err(|error| format!("an answer of {} bytes: {error}", bytes.len()))
    }
}

/// The study on the side of whoever makes it.
#[derive(Debug, Clone)]
pub struct Remote {
    id: u32,
    making: Making,
}

#[derive(Debug, Clone)]
enum Making {
    Thresholds { study: Box<Study>, batches: Vec<usize>, grown: Vec<usize> },
    Detectors { compare: Box<Compare>, left: std::vec::IntoIter<Piece>, now: Option<Piece>, made: Vec<compare::Made> },
    Contacts { run: Box<ChainRun>, time: f64, placing: Placing, made: Vec<Part> },
}

impl Remote {
    /// Takes a request as JSON.
    ///
    /// # Errors
    /// When it is none, or asks for what cannot be.
    pub fn new(request: &str) -> Result<Self, String> {
        let Request { id, work } = serde_json::from_str(request).map_err(|error| error.to_string())?;
        let making = match work {
            Work::Thresholds { spec, batches } => {
                let study = Box::new(Study::new(spec).map_err(|error| error.to_string())?);
                Making::Thresholds { study, batches, grown: Vec::new() }
            }
            Work::Detectors { spec, pieces } => {
                let compare = Box::new(Compare::new(spec).map_err(|error| error.to_string())?);
                let mut left = pieces.into_iter();
                Making::Detectors { compare, now: left.next(), left, made: Vec::new() }
            }
            Work::Contacts(spec) => {
                let run = Box::new(spec.run()?);
                Making::Contacts { placing: Placing::new(&run), run, time: spec.time, made: Vec::new() }
            }
        };
        Ok(Self { id, making })
    }

    /// Makes one run, or as much; returns whether any are left.
    pub fn step(&mut self) -> bool {
        match &mut self.making {
            Making::Thresholds { study, batches, grown } => {
                let Some(batch) = study.next(|batch| batches.contains(&batch)) else { return false };
                let firsts = study.run((batch, study.batches()[batch].tally.runs));
                study.add(batch, &firsts);
                if !grown.contains(&batch) {
                    grown.push(batch);
                }
            }
            Making::Detectors { compare, left, now, made } => {
                let Some(piece) = *now else { return false };
                if let Some(whole) = compare.part(piece) {
                    made.push(whole);
                    *now = left.next();
                }
            }
            Making::Contacts { run, time, placing, made } => {
                let Some(part) = placing.make(run, *time) else { return false };
                placing.add(part.clone());
                made.push(part);
            }
        }
        true
    }

    /// What has been found since the last answer, as bytes.
    ///
    /// # Errors
    /// When it cannot be written, which only a type of unknown length could cause, of which an answer has none.
    pub fn answer(&mut self) -> Result<Vec<u8>, String> {
        let found = match &mut self.making {
            Making::Thresholds { study, grown, .. } => {
                let tally = |batch: usize| (batch as u32, study.batches()[batch].tally.clone());
                Found::Thresholds(std::mem::take(grown).into_iter().map(tally).collect())
            }
            Making::Detectors { made, .. } => Found::Detectors(std::mem::take(made)),
            Making::Contacts { made, .. } => Found::Contacts(std::mem::take(made)),
        };
        postcard::to_allocvec(&Answer { id: self.id, found }).map_err(|error| error.to_string())
    }
}
