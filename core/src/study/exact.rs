//! Numbers in files and messages that give their bits back: JSON has no word for what is not finite.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number, which JSON holds as itself where it is finite, and as a word where it is not.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Told {
    Finite(f64),
    Other(String),
}

const WORDS: [(&str, f64); 3] = [("inf", f64::INFINITY), ("-inf", f64::NEG_INFINITY), ("nan", f64::NAN)];

/// Writes a number.
///
/// # Errors
/// When the writer fails.
pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if !serializer.is_human_readable() || value.is_finite() {
        return value.serialize(serializer);
    }
    let word = WORDS.iter().find(|(_, known)| known.to_bits() == value.to_bits()).map_or("nan", |(word, _)| word);
    word.serialize(serializer)
}

/// Reads what [`serialize`] writes.
///
/// # Errors
/// When it is no number.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    if !deserializer.is_human_readable() {
        return f64::deserialize(deserializer);
    }
    match Told::deserialize(deserializer)? {
        Told::Finite(value) => Ok(value),
        Told::Other(word) => {
            let known = WORDS.iter().find(|(known, _)| *known == word).map(|(_, value)| *value);
            known.ok_or_else(|| D::Error::custom(format!("{word:?} is not a number")))
        }
    }
}

/// A number with such a form, to be put into a list.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Exact(#[serde(with = "self")] pub f64);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_and_postcard_give_every_number_back() {
        for value in [0.1 + 0.2, -0.0, 5e-324, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let text = serde_json::to_string(&Exact(value)).expect("JSON");
            let read: Exact = serde_json::from_str(&text).expect(&text);
            let bytes = postcard::to_allocvec(&Exact(value)).expect("bytes");
            let sent: Exact = postcard::from_bytes(&bytes).expect("a number");
            assert_eq!((read.0.to_bits(), sent.0.to_bits()), (value.to_bits(), value.to_bits()), "{text}");
        }
        assert!(serde_json::from_str::<Exact>("\"much\"").is_err() && serde_json::from_str::<Exact>("null").is_err());
    }
}
