//! Why a log is refused.

use super::report::Place;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Why a log is refused: where, what stands there, and what is allowed.
#[derive(Debug, Clone, PartialEq, Eq, Error, Serialize, Deserialize)]
#[error("{}", told(self, .way))]
#[non_exhaustive]
pub struct LogError {
    /// Where.
    pub place: Place,
    /// What stands there, or is missing.
    pub what: String,
    /// What is allowed in its place; empty where `what` says it.
    pub allowed: String,
    /// The command's own way out, with the punctuation that leads to it; empty where there is none. A page has others.
    pub way: Box<str>,
}

fn told(LogError { place, what, allowed, .. }: &LogError, way: &str) -> String {
    let colon = if allowed.is_empty() { "" } else { "; allowed: " };
    format!("{}{what}{way}{colon}{allowed}", prefix(place))
}

fn prefix(place: &Place) -> String {
    if *place == Place::default() { String::new() } else { format!("{place}: ") }
}

impl LogError {
    /// About the file as a whole.
    #[must_use]
    pub fn file(what: impl Into<String>) -> Self {
        Self { place: Place::default(), what: what.into(), allowed: String::new(), way: "".into() }
    }

    /// About one line.
    #[must_use]
    pub fn line(line: u64, what: impl Into<String>) -> Self {
        Self { place: Place::line(line), what: what.into(), allowed: String::new(), way: "".into() }
    }

    /// About one cell, from 0, of a column with this header.
    #[must_use]
    pub fn cell(line: u64, column: usize, name: &str, what: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self { place: Place::cell(line, column, name), what: what.into(), allowed: allowed.into(), way: "".into() }
    }

    /// The same with the command's way out.
    #[must_use]
    pub fn or(self, way: impl Into<Box<str>>) -> Self {
        Self { way: way.into(), ..self }
    }

    /// In words without full stop, for whoever has no flags to give.
    #[must_use]
    pub fn without_flags(&self) -> String {
        let said = told(self, "");
        // On the command line the file's name stands before it.
        let lacks_subject = ["is ", "holds ", "has "].iter().any(|verb| said.starts_with(verb));
        if lacks_subject { format!("The file {said}") } else { said }
    }
}

/// A cell as a message quotes it: short, and without what would break the line.
#[must_use]
pub fn quoted(cell: &[u8]) -> String {
    const MOST: usize = 32;
    let text = String::from_utf8_lossy(&cell[..cell.len().min(4 * MOST)]);
    let short: String = text.chars().take(MOST).collect();
    let more = if short.len() < text.len() || cell.len() > 4 * MOST { "…" } else { "" };
    format!("{short:?}{more}")
}
