//! What a key holds.

use crate::scenario::keys::quantity::{Quantity, Units};
use crate::scenario::text::number;

/// What a key holds, or was to hold; numbers in SI.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(u64),
    /// One of the words that the key knows.
    Word(&'static str),
    /// A number that is switched off, by the word that stands in its place.
    Off(&'static str),
    /// Some of the words that the key knows.
    Words(Vec<&'static str>),
    /// Several numbers.
    List(Vec<f64>),
    /// Something that the key cannot hold, as it was written.
    Other(String),
}

impl Value {
    /// The value as a message names it, with its unit where the page reads it.
    #[must_use]
    pub fn told(&self, quantity: Quantity, units: Units) -> String {
        match (self, units) {
            (Self::Number(value), Units::Shown) => quantity.amount(*value, units),
            (Self::List(values), Units::Shown) => {
                let amounts: Vec<_> = values.iter().map(|&value| quantity.amount(value, units)).collect();
                format!("[{}]", amounts.join(", "))
            }
            _ => self.to_toml(),
        }
    }

    /// The value as TOML.
    #[must_use]
    pub fn to_toml(&self) -> String {
        match self {
            Self::Number(value) => number(*value),
            Self::Whole(value) => value.to_string(),
            Self::Word(word) | Self::Off(word) => format!("\"{word}\""),
            Self::Words(words) => {
                let words: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
                format!("[{}]", words.join(", "))
            }
            Self::List(values) => format!("[{}]", values.iter().map(|&v| number(v)).collect::<Vec<_>>().join(", ")),
            Self::Other(text) => text.clone(),
        }
    }
}
