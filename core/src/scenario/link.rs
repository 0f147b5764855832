//! A link: everything that matters of a page, in the fragment of its address.
//!
//! It says what differs from a preset, by the keys of the table, and then what the page shows of it:
//! `#preset=bench&contact.disk=3&detection.xi2=0.005&view=tuning&t=6.28`. Numbers are in SI, lists have commas, and a key
//! that is not there has the preset's value or the page's default. Reading order: [`page`] (the page's own keys),
//! `read` (leniently, but telling all that was wrong), `command` (the same as a command line), `chain` (several segments).

mod chain;
mod command;
pub mod page;
mod percent;
mod read;

pub use chain::ChainLink;
pub use page::{PAGE_KEYS, Page, PageKey};
pub use read::{Broken, Why, no_key, read_text};

use crate::scenario::keys::{KEYS, Key, Value};
use crate::scenario::preset::{PRESETS, Preset};
use crate::scenario::text::number;
use crate::scenario::{Scenario, ScenarioError};
use std::fmt::Write;
use thiserror::Error;

/// No link is longer than this, bytes: what is longer is cut by programs that links pass through.
pub const MAX_LINK: usize = 8192;
/// The way of writing that is read here. It is written into no link until there is a second one.
pub const VERSION: u64 = 1;

/// A preset, what differs from it, and what the page shows of it. Its scenario is possible.
#[derive(Debug, Clone)]
pub struct Link {
    preset: &'static Preset,
    /// In the order of the table.
    changes: Vec<(&'static Key, Value)>,
    scenario: Scenario,
    /// What the page shows.
    pub page: Page,
}

impl PartialEq for Link {
    fn eq(&self, other: &Self) -> bool {
        (self.preset, &self.scenario, &self.page) == (other.preset, &other.scenario, &other.page)
    }
}

/// Why there is no link.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LinkError {
    /// It would be longer than [`MAX_LINK`].
    #[error(
        "the link would be {bytes} bytes long, and at most {MAX_LINK} are allowed: save the scenario as a file instead"
    )]
    TooLong {
        /// Its length.
        bytes: usize,
    },
    /// What it was to be appended to is no address.
    #[error("{address:?} is not the address of a page: write it in full, as in https://example.org/centrode/")]
    NotAddress {
        /// What was given.
        address: String,
    },
}

impl Link {
    /// The link to a scenario, said by what differs from a preset.
    ///
    /// # Errors
    /// When the scenario is impossible, or the page's time lies beyond its end.
    pub fn new(preset: &'static Preset, scenario: &Scenario, page: Page) -> Result<Self, ScenarioError> {
        KEYS.iter().try_for_each(|key| key.check(scenario))?;
        page.within(scenario)?;
        let changes = differences(&preset.scenario()?, scenario);
        Ok(Self { preset, changes, scenario: scenario.clone(), page })
    }

    /// The link to a scenario, said by what differs from the preset from which the least differs.
    ///
    /// # Errors
    /// When the scenario is impossible, or the page's time lies beyond its end.
    pub fn nearest(scenario: &Scenario, page: Page) -> Result<Self, ScenarioError> {
        let mut nearest = Self::new(&PRESETS[0], scenario, page)?;
        for preset in &PRESETS[1..] {
            if nearest.changes.is_empty() {
                break;
            }
            let other = Self::new(preset, scenario, nearest.page.clone())?;
            if other.changes.len() < nearest.changes.len() {
                nearest = other;
            }
        }
        Ok(nearest)
    }

    /// The preset from which it starts.
    #[must_use]
    pub fn preset(&self) -> &'static Preset {
        self.preset
    }

    /// What differs from the preset, in the order of the table.
    #[must_use]
    pub fn changes(&self) -> &[(&'static Key, Value)] {
        &self.changes
    }

    /// The scenario.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The fragment of the address, without `#`: the same text for the same link.
    ///
    /// # Errors
    /// When it is longer than [`MAX_LINK`].
    pub fn fragment(&self) -> Result<String, LinkError> {
        let mut text = format!("preset={}", self.preset.name);
        let scenario = self.changes.iter().map(|(key, value)| (key.path, written(value)));
        for (key, value) in scenario.chain(self.page.changes().map(|(key, value)| (key.name, written(&value)))) {
            // Writing to a String cannot fail. No name or value holds a character that would need to be escaped.
            let _ = write!(text, "&{key}={value}");
        }
        for (key, value) in self.page.chain.iter().flat_map(ChainLink::parts) {
            let _ = write!(text, "&{key}={value}");
        }
        checked(text)
    }

    /// The link for a page at an address: its query stays, its fragment is replaced.
    ///
    /// # Errors
    /// When that is no address, or the link is longer than [`MAX_LINK`].
    pub fn at(&self, address: &str) -> Result<String, LinkError> {
        let page = address.trim().split('#').next().unwrap_or_default();
        if !is_address(page) {
            return Err(LinkError::NotAddress { address: address.into() });
        }
        checked(format!("{page}#{}", self.fragment()?))
    }
}

fn checked(text: String) -> Result<String, LinkError> {
    if text.len() > MAX_LINK { Err(LinkError::TooLong { bytes: text.len() }) } else { Ok(text) }
}

/// Whether a text is `scheme://something` without what no address holds.
fn is_address(text: &str) -> bool {
    let Some((scheme, rest)) = text.split_once("://") else { return false };
    let named = scheme.starts_with(|first: char| first.is_ascii_alphabetic())
        && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    // Browsers keep | ^ { } \ ` in a query as they were typed.
    let stray = |c: char| c.is_whitespace() || c.is_control() || "\"<>".contains(c);
    named && !rest.is_empty() && !rest.starts_with(['?', ':']) && !rest.contains(stray)
}

/// A value as a link has it.
fn written(value: &Value) -> String {
    match value {
        Value::Number(value) => number(*value),
        Value::Whole(value) => value.to_string(),
        Value::Word(word) | Value::Off(word) => (*word).into(),
        Value::Words(words) => words.join(","),
        Value::List(values) => values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(","),
        Value::Other(text) => text.clone(),
    }
}

/// What one scenario holds otherwise than another, to the bit.
fn differences(base: &Scenario, scenario: &Scenario) -> Vec<(&'static Key, Value)> {
    let changed = |key: &'static Key| {
        let value = key.get(scenario)?;
        let same = key.get(base).is_some_and(|base| bits(&base) == bits(&value));
        (!same).then_some((key, value))
    };
    KEYS.iter().filter_map(changed).collect()
}

/// A value with −0 apart from 0, which differ in what is computed from them.
fn bits(value: &Value) -> (Vec<u64>, Option<&Value>) {
    match value {
        Value::Number(value) => (vec![value.to_bits()], None),
        Value::List(values) => (values.iter().map(|value| value.to_bits()).collect(), None),
        other => (Vec::new(), Some(other)),
    }
}
