//! A study made elsewhere: what is asked (JSON), and what is answered (postcard), piece by piece.
//!
//! A worker on the page has its own memory: it is told what to study and sends back what it has counted.

use super::tally::Tally;
use super::{Spec, Study};
use serde::{Deserialize, Serialize};

/// What is asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Number of the request, which its answers bear.
    pub id: u32,
    /// The study.
    pub spec: Spec,
    /// The batches to make.
    pub batches: Vec<usize>,
}

/// What is answered: tallies that have grown since the answer before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// Number of the request.
    pub id: u32,
    /// Place of a batch in the study, and its tally.
    pub tallies: Vec<(u32, Tally)>,
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
    study: Study,
    batches: Vec<usize>,
    grown: Vec<usize>,
}

impl Remote {
    /// Takes a request as JSON.
    ///
    /// # Errors
    /// When it is none, or asks for what cannot be.
    pub fn new(request: &str) -> Result<Self, String> {
        let Request { id, spec, batches } = serde_json::from_str(request).map_err(|error| error.to_string())?;
        let study = Study::new(spec).map_err(|error| error.to_string())?;
        Ok(Self { id, study, batches, grown: Vec::new() })
    }

    /// Makes one run; returns whether any are left.
    pub fn step(&mut self) -> bool {
        let Some(batch) = self.study.next(|batch| self.batches.contains(&batch)) else { return false };
        let firsts = self.study.run((batch, self.study.batches()[batch].tally.runs));
        self.study.add(batch, &firsts);
        if !self.grown.contains(&batch) {
            self.grown.push(batch);
        }
        true
    }

    /// What has grown since the last answer, as bytes.
    ///
    /// # Errors
    /// When it cannot be written, which only a type of unknown length could cause, of which an answer has none.
    pub fn answer(&mut self) -> Result<Vec<u8>, String> {
        let tally = |batch: usize| (batch as u32, self.study.batches()[batch].tally.clone());
        let tallies = std::mem::take(&mut self.grown).into_iter().map(tally).collect();
        postcard::to_allocvec(&Answer { id: self.id, tallies }).map_err(|error| error.to_string())
    }
}
