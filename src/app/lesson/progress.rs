//! How far a person has come, as the browser keeps it.

use super::tour::STEPS;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// The step that the tour goes on with, from 1, those that are done, and the challenges that were met.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Progress {
    /// From 1.
    pub tour: usize,
    /// By name.
    pub met: BTreeSet<String>,
    /// From 1.
    #[serde(skip_serializing_if = "BTreeSet::is_empty")]
    pub done: BTreeSet<usize>,
}

impl Default for Progress {
    fn default() -> Self {
        Self { tour: 1, met: BTreeSet::new(), done: BTreeSet::new() }
    }
}

impl Progress {
    /// Reads what was kept; what cannot be read is as if nothing had been.
    #[must_use]
    pub fn read(text: &str) -> Self {
        let read: Self = serde_json::from_str(text).unwrap_or_default();
        let known = |name: &String| super::challenge::CHALLENGES.iter().any(|of| of.key == name);
        let done = read.done.into_iter().filter(|step| (1..=STEPS).contains(step)).collect();
        Self { tour: read.tour.clamp(1, STEPS), met: read.met.into_iter().filter(known).collect(), done }
    }

    /// As it is kept.
    #[must_use]
    pub fn text(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_kept_comes_back_and_nonsense_does_not() {
        let some = Progress { tour: 4, met: ["disk-1".to_owned()].into(), done: [2, 3].into() };
        assert_eq!(Progress::read(&some.text()), some);
        for text in [
            "",
            "{",
            "null",
            "[1]",
            r#"{"tour":-3}"#,
            r#"{"tour":"x","met":7}"#,
            "\u{0}",
            r#"{"met":["bogus"]}"#,
            r#"{"done":[0,99]}"#,
        ] {
            assert_eq!(Progress::read(text), Progress::default(), "{text}");
        }
        assert_eq!(Progress::read(r#"{"tour":99}"#).tour, STEPS);
    }
}
