//! Why a scenario is refused.

use crate::scenario::keys::{Allowed, Quantity, Units, Value};
use std::fmt;
use thiserror::Error;

/// Why a scenario is refused.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ScenarioError {
    /// A value that cannot be.
    #[error("{0}")]
    Value(Box<Refused>),
    /// A key that does not exist.
    #[error("unknown key {key}; known keys: {known}")]
    UnknownKey {
        /// Dotted key.
        key: String,
        /// The keys that exist at this place.
        known: String,
    },
    /// Text that is not TOML.
    #[error("line {line}: {message}")]
    Syntax {
        /// Line in the text, from 1.
        line: usize,
        /// What is wrong there.
        message: String,
    },
    /// Bytes that are not text.
    #[error("not text: byte {offset} is not UTF-8; a scenario is a TOML file in UTF-8")]
    NotText {
        /// Offset of the first bad byte.
        offset: usize,
    },
    /// An override that is not `key=value`.
    #[error("{text:?} is not an override: write key=value, as in contact.disk=3")]
    Override {
        /// The text given.
        text: String,
    },
    /// A preset that does not exist.
    #[error("unknown preset {name:?}; known presets: {known}")]
    UnknownPreset {
        /// The name given.
        name: String,
        /// The names that exist.
        known: String,
    },
}

/// A value that cannot be: data, of which words are made where a person reads them.
#[derive(Debug, Clone, PartialEq)]
pub struct Refused {
    /// Dotted key, with the place in a list in brackets.
    pub key: String,
    /// What its number is.
    pub quantity: Quantity,
    /// The value.
    pub value: Value,
    /// What would be allowed.
    pub allowed: Allowed,
}

impl Refused {
    /// The refusal of a value.
    #[must_use]
    pub fn error(key: impl Into<String>, quantity: Quantity, value: Value, allowed: Allowed) -> ScenarioError {
        ScenarioError::Value(Box::new(Self { key: key.into(), quantity, value, allowed }))
    }

    /// In a sentence without full stop, as `units` has it.
    #[must_use]
    pub fn told(&self, units: Units) -> String {
        let value = self.value.told(self.quantity, units);
        format!("{} = {value} is not allowed: {}", self.key, self.allowed.words(self.quantity, units))
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Units::Si))
    }
}
