//! Why a log is refused.

use super::report::Place;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Why a log is refused: where, what stands there, and what is allowed.
#[derive(Debug, Clone, PartialEq, Eq, Error, Serialize, Deserialize)]
#[error("{}{what}{}{allowed}", prefix(.place), if .allowed.is_empty() { "" } else { "; allowed: " })]
pub struct LogError {
    /// Where.
    pub place: Place,
    /// What stands there, or is missing.
    pub what: String,
    /// What is allowed in its place; empty where `what` says it.
    pub allowed: String,
}

fn prefix(place: &Place) -> String {
    if *place == Place::default() { String::new() } else { format!("{place}: ") }
}

impl LogError {
    /// About the file as a whole.
    #[must_use]
    pub fn file(what: impl Into<String>) -> Self {
        Self { place: Place::default(), what: what.into(), allowed: String::new() }
    }

    /// About one line.
    #[must_use]
    pub fn line(line: u64, what: impl Into<String>) -> Self {
        Self { place: Place::line(line), what: what.into(), allowed: String::new() }
    }

    /// About one cell, from 0, of a column with this header.
    #[must_use]
    pub fn cell(line: u64, column: usize, name: &str, what: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self { place: Place::cell(line, column, name), what: what.into(), allowed: allowed.into() }
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
