//! One setting in place of another, as it is written on a command line and as the value that it gives a key.

use crate::scenario::keys::{self, GROUPS, KEYS, Key, Value};
use crate::scenario::text::read_into;
use crate::scenario::{Scenario, ScenarioError};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Keys with the values they take: one for a key, all of its keys for a group that is given as a whole.
///
/// Text is read once, here. Applied, it sets values; whether what comes of them is possible is for
/// [`Plan::new`](crate::scenario::Plan::new) to say.
///
/// ```
/// use centrode_core::scenario::{Override, Scenario};
///
/// let longer: Override = "filter.length=800".parse()?;
/// let mut scenario = Scenario::default();
/// longer.apply(&mut scenario);
/// assert_eq!(scenario.filter.length, 800);
/// assert!("filter.lenght=800".parse::<Override>().is_err());
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Override {
    path: String,
    written: String,
    values: Vec<(&'static Key, Value)>,
}

impl Override {
    /// Gives a key a value.
    ///
    /// # Errors
    /// [`ScenarioError::Value`] when the value is not of the key's kind.
    pub fn new(key: &'static Key, value: Value) -> Result<Self, ScenarioError> {
        key.set(&mut Scenario::default(), value.clone())?;
        Ok(Self { path: key.path.into(), written: value.to_toml(), values: vec![(key, value)] })
    }

    /// Sets the values.
    pub fn apply(&self, scenario: &mut Scenario) {
        for (key, value) in &self.values {
            // Of the key's own kind, which was seen when it was made.
            let _ = key.set(scenario, value.clone());
        }
    }

    /// Dotted path of the key or group.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The value as it was written.
    #[must_use]
    pub fn written(&self) -> &str {
        &self.written
    }
}

impl FromStr for Override {
    type Err = ScenarioError;

    /// Reads `key=value`; the value is TOML, or a bare word.
    fn from_str(text: &str) -> Result<Self, ScenarioError> {
        let malformed = || ScenarioError::Override { text: text.into() };
        let (path, written) = text.split_once('=').ok_or_else(malformed)?;
        let (path, written) = (path.trim(), written.trim());
        if path.is_empty() || written.is_empty() {
            return Err(malformed());
        }
        let value = match format!("value = {written}").parse::<toml::Table>() {
            Ok(mut table) if table.len() == 1 => table.remove("value").ok_or_else(malformed)?,
            _ => bare(path, written),
        };
        let mut values = Vec::new();
        if GROUPS.iter().any(|group| group.path == path) {
            // A group is given as a whole: what it does not name has its default.
            let (default, within) = (Scenario::default(), format!("{path}."));
            let inside = KEYS.iter().filter(|key| key.path.starts_with(&within));
            values.extend(inside.filter_map(|key| Some((key, key.get(&default)?))));
        }
        read_into(&mut values, path, &value)?;
        Ok(Self { path: path.into(), written: written.into(), values })
    }
}

/// What is no TOML: a bare word, or several with commas where the key holds several, in brackets or not.
fn bare(path: &str, written: &str) -> toml::Value {
    if !keys::find(path).is_some_and(Key::is_words) {
        return toml::Value::String(written.into());
    }
    let inside = written.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).unwrap_or(written);
    toml::Value::Array(inside.split(',').map(|word| toml::Value::String(word.trim().into())).collect())
}

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.path, self.written)
    }
}

impl TryFrom<String> for Override {
    type Error = ScenarioError;

    fn try_from(text: String) -> Result<Self, ScenarioError> {
        text.parse()
    }
}

impl From<Override> for String {
    fn from(set: Override) -> Self {
        set.to_string()
    }
}

impl PartialEq for Key {
    /// Two keys are one when their paths are.
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path
    }
}

/// Whole numbers of a key that holds them, by its path.
///
/// # Errors
/// [`ScenarioError::UnknownKey`] when there is no such key, [`ScenarioError::Value`] when it holds something else.
pub fn whole(path: &str, value: u64) -> Result<Override, ScenarioError> {
    match keys::find(path) {
        Some(key) => Override::new(key, Value::Whole(value)),
        None => Err(keys::unknown(path)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_group_is_given_as_a_whole_and_one_of_two_keys_replaces_the_other() {
        let mut scenario = Scenario::default();
        for text in ["contact.arc_length=0.011", "robot.primary={inner_diameter=0.0001}", "contact.disk=3"] {
            let set: Override = text.parse().expect(text);
            assert_eq!(set.to_string(), text);
            set.apply(&mut scenario);
        }
        assert_eq!(scenario.robot.primary.inner_diameter, 0.0001);
        assert_eq!(scenario.robot.primary.outer_diameter, Scenario::default().robot.primary.outer_diameter);
        assert_eq!(scenario.contact.place, crate::scenario::Place::disk(3));
        "contact={bend=0.4}".parse::<Override>().expect("a group").apply(&mut scenario);
        assert_eq!(scenario.contact.start, crate::scenario::Start::Bend(0.4));
        assert_eq!(scenario.contact.place, Scenario::default().contact.place);
    }

    #[test]
    fn it_comes_back_from_json_as_it_was_written() {
        for text in ["filter.averaging=rotations", "tracker.position_noise=0.10", "load.force=[1, 2, 3]"] {
            let set: Override = text.parse().expect(text);
            let json = serde_json::to_string(&set).expect("JSON");
            assert_eq!(json, format!("{text:?}"));
            assert_eq!(serde_json::from_str::<Override>(&json).expect("an override"), set);
        }
        assert!(serde_json::from_str::<Override>("\"seed=x\"").is_err());
    }

    #[test]
    fn several_words_need_no_quotes() {
        use crate::scenario::{Detectors, Method};
        for (text, methods) in [
            ("detection.detectors=glr", &[Method::Glr][..]),
            ("detection.detectors=fcd, glr", &[Method::Fcd, Method::Glr]),
            ("detection.detectors=[cusum,jfd]", &[Method::Jfd, Method::Cusum]),
            ("detection.detectors=[\"fcd-velocity\"]", &[Method::FcdVelocity]),
            ("detection.detectors=[]", &[]),
        ] {
            let mut scenario = Scenario::default();
            text.parse::<Override>().expect(text).apply(&mut scenario);
            assert_eq!(scenario.detection.detectors, Detectors::of(methods), "{text}");
        }
        for text in ["detection.detectors=fcd,fcd", "detection.detectors=fcd,sonar", "detection.detectors=3"] {
            let refused = text.parse::<Override>().expect_err(text).to_string();
            assert!(refused.contains("detection.detectors"), "{refused}");
        }
    }

    #[test]
    fn a_value_of_another_kind_is_refused() {
        assert_eq!(whole("filter.length", 200).expect("whole").to_string(), "filter.length=200");
        assert!(whole("filter.lenght", 200).is_err() && whole("filter.averaging", 200).is_err());
        let force = keys::find("load.force").expect("a key");
        assert!(Override::new(force, Value::List(vec![1.0])).is_err());
    }
}
