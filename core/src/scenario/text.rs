//! Scenarios as TOML text: reading, overriding one key, and saying what is wrong where.

use crate::scenario::Scenario;
use crate::scenario::keys::{self, Allowed, GROUPS, KEYS, Key, Quantity, Value};
use crate::scenario::overrides::Override;
use crate::scenario::refusal::{Refused, ScenarioError};
use toml::Table;

/// The default scenario, every key with its unit and meaning, as `centrode scenario` prints it.
pub const DEFAULT_TOML: &str = include_str!("../../assets/scenario.toml");

/// A scenario being put together: a file or preset, then overrides, then a check.
///
/// ```
/// use centrode_core::scenario::text::Draft;
///
/// let mut draft = Draft::from_toml("[filter]\nlength = 200")?;
/// draft.set("contact.disk=3")?;
/// assert_eq!(draft.finish()?.filter.length, 200);
/// let refused = Draft::from_toml("[filter]\nlenght = 200").expect_err("no such key").to_string();
/// assert!(refused.contains("filter.lenght") && refused.contains("length, averaging"), "{refused}");
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Draft {
    scenario: Scenario,
}

impl Draft {
    /// From a scenario in hand.
    #[must_use]
    pub fn from_scenario(scenario: &Scenario) -> Self {
        Self { scenario: scenario.clone() }
    }

    /// From a file's bytes.
    ///
    /// # Errors
    /// [`ScenarioError::NotText`] when they are not UTF-8, and those of [`Draft::from_toml`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ScenarioError> {
        let text =
            std::str::from_utf8(bytes).map_err(|error| ScenarioError::NotText { offset: error.valid_up_to() })?;
        Self::from_toml(text)
    }

    /// From TOML; missing keys have their defaults.
    ///
    /// # Errors
    /// [`ScenarioError::Syntax`] when it is not TOML, [`ScenarioError::UnknownKey`] for a key that does not exist,
    /// [`ScenarioError::Value`] for a value of another kind or two keys of which only one can be given.
    pub fn from_toml(text: &str) -> Result<Self, ScenarioError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let table = text.parse::<Table>().map_err(|error| ScenarioError::Syntax {
            line: error.span().map_or(1, |span| 1 + text[..span.start.min(text.len())].matches('\n').count()),
            message: error.message().replace('\n', " "),
        })?;
        Ok(Self { scenario: read_table(&table)? })
    }

    /// Overrides one key with `key=value`; the value is TOML, or a bare word.
    ///
    /// # Errors
    /// [`ScenarioError::Override`] when the text is not `key=value`, [`ScenarioError::UnknownKey`] for a key that does not exist,
    /// [`ScenarioError::Value`] for a value of another kind.
    pub fn set(&mut self, text: &str) -> Result<(), ScenarioError> {
        text.parse::<Override>()?.apply(&mut self.scenario);
        Ok(())
    }

    /// The scenario, checked.
    ///
    /// # Errors
    /// [`ScenarioError::Value`]: the first value that is impossible, with its key and what is allowed.
    pub fn finish(self) -> Result<Scenario, ScenarioError> {
        KEYS.iter().try_for_each(|key| key.check(&self.scenario))?;
        Ok(self.scenario)
    }
}

/// A scenario as a table has it, unchecked; missing keys have their defaults.
pub(super) fn read_table(table: &Table) -> Result<Scenario, ScenarioError> {
    let (mut scenario, mut values) = (Scenario::default(), Vec::new());
    read_group(&mut values, "", table)?;
    for (key, value) in values {
        key.set(&mut scenario, value)?;
    }
    Ok(scenario)
}

/// Reads what stands at a path: the values that it gives keys, in order.
pub(super) fn read_into(
    values: &mut Vec<(&'static Key, Value)>,
    path: &str,
    value: &toml::Value,
) -> Result<(), ScenarioError> {
    if let Some(key) = keys::find(path) {
        let value = key.read(value)?;
        // What is of another kind in itself, such as a vector of two numbers.
        key.set(&mut Scenario::default(), value.clone())?;
        values.push((key, value));
        return Ok(());
    }
    match (GROUPS.iter().find(|group| group.path == path), value) {
        (Some(_), toml::Value::Table(table)) => read_group(values, path, table),
        (Some(group), value) => Err(Refused::error(path, Quantity::Word, written(value), Allowed::Group(group.path))),
        (None, _) => Err(keys::unknown(path)),
    }
}

fn read_group(values: &mut Vec<(&'static Key, Value)>, group: &str, table: &Table) -> Result<(), ScenarioError> {
    for (name, value) in table {
        let path = if group.is_empty() { name.clone() } else { format!("{group}.{name}") };
        // A quoted name is one name, whatever it holds.
        if name.contains('.') {
            return Err(keys::unknown(&path));
        }
        read_into(values, &path, value)?;
        if let Some((key, other)) = keys::find(&path).and_then(|key| Some((key, key.other()?)))
            && table.contains_key(other.name())
        {
            return Err(key.refuse(written(value), Allowed::Without(other.path)));
        }
    }
    Ok(())
}

/// A value as it was written, on one line.
fn written(value: &toml::Value) -> Value {
    Value::Other(value.to_string().replace('\n', " "))
}

impl Key {
    /// Reads a value of the key's own kind; whether it is possible is for [`Key::check`] to say.
    ///
    /// # Errors
    /// When the value is of another kind.
    pub fn read(&self, value: &toml::Value) -> Result<Value, ScenarioError> {
        use toml::Value as Toml;
        let known = |word: &str| self.words().iter().find(|known| **known == word);
        let part = |place: usize, item: &Toml, allowed| {
            Refused::error(format!("{}[{place}]", self.path), self.quantity, written(item), allowed)
        };
        let read = match value {
            Toml::Integer(number) if self.is_whole() => u64::try_from(*number).ok().map(Value::Whole),
            Toml::Array(items) if self.is_list() => {
                let number = |(place, item)| float(item).ok_or_else(|| part(place, item, Allowed::Number));
                Some(Value::List(items.iter().enumerate().map(number).collect::<Result<_, _>>()?))
            }
            Toml::Array(items) if self.is_words() => {
                let words = self.any_of();
                let word = |(place, item): (usize, &Toml)| {
                    let known = item.as_str().and_then(|text| words.iter().find(|word| **word == text));
                    known.copied().ok_or_else(|| part(place, item, Allowed::Words(words)))
                };
                Some(Value::Words(items.iter().enumerate().map(word).collect::<Result<_, _>>()?))
            }
            Toml::String(word) if self.off() == Some(word.as_str()) => self.off().map(Value::Off),
            Toml::String(word) => known(word).map(|word| Value::Word(word)),
            _ if self.is_number() => float(value).map(Value::Number),
            _ => None,
        };
        read.ok_or_else(|| self.refuse(written(value), self.allowed))
    }
}

/// A number, whole or not.
fn float(value: &toml::Value) -> Option<f64> {
    match value {
        toml::Value::Float(number) => Some(*number),
        toml::Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}

impl Scenario {
    /// Reads a scenario from TOML and checks it; missing keys have their defaults.
    ///
    /// # Errors
    /// What is wrong, where, and what is allowed.
    pub fn from_toml(text: &str) -> Result<Self, ScenarioError> {
        Draft::from_toml(text)?.finish()
    }

    /// The scenario as TOML, every key written out.
    #[must_use]
    pub fn to_toml(&self) -> String {
        // Fails only for types that TOML lacks, of which a scenario has none.
        toml::to_string(self).unwrap_or_default()
    }
}

/// A number as a message shows it.
#[must_use]
pub fn number(value: f64) -> String {
    match value.abs() {
        size if size.is_nan() => "nan".into(),
        size if size != 0.0 && size.is_finite() && !(1e-6..1e15).contains(&size) => format!("{value:e}"),
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        Scenario::from_toml(text).expect_err(text).to_string()
    }

    #[test]
    fn the_printed_default_is_the_default() {
        assert_eq!(Scenario::from_toml(DEFAULT_TOML), Ok(Scenario::default()));
        assert_eq!(Scenario::from_toml(""), Ok(Scenario::default()));
    }

    #[test]
    fn the_printed_default_names_every_key() {
        let printed = DEFAULT_TOML.parse::<Table>().expect("TOML");
        let full = Table::try_from(Scenario::default()).expect("table");
        fn keys(table: &Table, group: &str, out: &mut Vec<String>) {
            for (key, value) in table {
                out.push(format!("{group}.{key}"));
                if let toml::Value::Table(inner) = value {
                    keys(inner, &format!("{group}.{key}"), out);
                }
            }
        }
        let (mut printed_keys, mut full_keys) = (Vec::new(), Vec::new());
        keys(&printed, "", &mut printed_keys);
        keys(&full, "", &mut full_keys);
        printed_keys.sort();
        full_keys.sort();
        assert_eq!(printed_keys, full_keys);
    }

    #[test]
    fn a_scenario_survives_its_own_text() {
        let mut draft = Draft::from_scenario(&Scenario::default());
        for text in [
            "contact.arc_length=0.011",
            "contact.bend=0.4",
            "detection.xi1=off",
            "detection.detectors=[]",
            "prior.colour=0.3",
            "seed=99",
            "robot.disks=[0.01]",
        ] {
            draft.set(text).expect(text);
        }
        let scenario = draft.finish().expect("valid");
        assert_eq!(Scenario::from_toml(&scenario.to_toml()), Ok(scenario));
    }

    #[test]
    fn an_override_replaces_its_partner() {
        let mut draft = Draft::from_toml("[contact]\ndisk = 1\ntime = 4.0").expect("TOML");
        draft.set("contact.arc_length = 0.01").expect("set");
        draft.set("contact.bend = 0.5").expect("set");
        draft.set("contact.disk = 3").expect("set");
        let toml = draft.finish().expect("valid").to_toml();
        assert!(toml.contains("disk = 3") && toml.contains("bend = 0.5"), "{toml}");
    }

    #[test]
    fn every_refusal_names_key_value_and_what_is_allowed() {
        for (text, parts) in [
            ("bogus = 1", &["bogus", "loop_rate"][..]),
            ("[robot]\nlenght = 1", &["robot.lenght", "length"]),
            ("[robot.primary]\nx = 1", &["robot.primary.x", "outer_diameter"]),
            ("robot = 3", &["robot", "3", "table"]),
            ("[robot]\nlength = -0.03", &["robot.length", "-0.03", "0.0001 m to 100 m"]),
            ("[robot]\nlength = nan", &["robot.length", "nan"]),
            ("[robot]\nlength = \"long\"", &["robot.length", "long", "a number"]),
            ("[robot]\nlength = 0.02", &["robot.disks[2]", "0.0225", "0.02"]),
            ("[robot]\npitch_radius = inf", &["robot.pitch_radius", "inf"]),
            ("[robot]\npitch_radius = 0.02", &["motion.theta_end", "secondary backbone"]),
            ("[robot]\ndisks = [0.01, 0.005]", &["robot.disks[1]", "0.005"]),
            ("[robot]\ndisks = 3", &["robot.disks", "list"]),
            ("[contact]\ndisk = 4", &["contact.disk", "4", "1 to 3"]),
            ("[contact]\ndisk = -1", &["contact.disk", "-1", "number of a disk"]),
            ("[contact]\ndisk = 1.5", &["contact.disk", "1.5", "number of a disk"]),
            ("[contact]\narc_length = 0.031", &["contact.arc_length", "0.031", "0.03"]),
            ("[contact]\ndisk = 1\narc_length = 0.01", &["contact", "not both"]),
            ("[contact]\ntime = 1\nbend = 0.01", &["contact", "not both"]),
            ("[contact]\nbend = 7", &["contact.bend", "7", "turn"]),
            ("[filter]\nlength = 0", &["filter.length", "0", "whole"]),
            ("[filter]\nlength = 2.5", &["filter.length", "2.5", "whole"]),
            ("[filter]\nlength = 20000", &["filter.length", "20000", "10001"]),
            ("[filter]\naveraging = \"median\"", &["filter.averaging", "median", "readings"]),
            ("[detection]\nxi2 = -0.007", &["detection.xi2", "-0.007", "0 m or more"]),
            ("[detection]\nxi2 = \"never\"", &["detection.xi2", "never", "off"]),
            ("[prior]\ncolour = 1", &["prior.colour", "1", "below 1", "auto"]),
            ("[prior]\nposition_noise = \"off\"", &["prior.position_noise", "off", "auto"]),
            ("[prior]\nposition_noise = -1", &["prior.position_noise", "-1", "0 m", "auto"]),
            ("[prior]\nlength = \"auto\"", &["prior.length", "auto", "from 0 to 1"]),
            ("[motion]\nend = 1e9", &["motion.end", "1000000000", "1e8"]),
            ("[motion]\nfinish = 2", &["motion.finish", "2", "after"]),
            ("seed = -1", &["seed", "-1", "whole"]),
            ("loop_rate = 1e308", &["loop_rate", "1e308", "1e6 Hz"]),
            ("contact = 3", &["contact", "3", "arc_length"]),
            ("[robot]\ndisks = []", &["contact.disk", "2", "no spacer disks"]),
            ("[robot]\ndisks = [0.01, true]", &["robot.disks[1]", "= true", "number"]),
            ("[load_cells]\npreload = 1e300", &["load_cells.preload", "1e300"]),
            ("[tracker]\nposition_noise = 1e308", &["tracker.position_noise", "1 m"]),
            ("[load]\nforce = 3", &["load.force", "3", "three numbers"]),
            ("[load]\nforce = [1, 2]", &["load.force", "[1, 2]", "three numbers"]),
            ("[load]\nmoment = [1, 2, 1e9]", &["load.moment[2]", "1000000000", "N·m"]),
            ("[load]\nforce = [nan, 0, 0]", &["load.force[0]", "nan", "N"]),
            ("[load]\nfinish = 8", &["load.finish", "8", "load.start = 8.5"]),
            ("[load_cells]\nerrors = \"all\"", &["load_cells.errors", "all", "independent"]),
            ("[detection]\nxi1_rule = \"shape\"", &["detection.xi1_rule", "shape", "bound"]),
            ("[detection]\nxi1_factor = -1", &["detection.xi1_factor", "-1", "0 or more"]),
            ("[detection]\ndetectors = [\"fcd\", \"sonar\"]", &["detection.detectors[1]", "sonar", "fcd-velocity"]),
            ("[detection]\ndetectors = [\"fcd\", 3]", &["detection.detectors[1]", "= 3", "cusum"]),
            ("[detection]\ndetectors = [\"glr\", \"jfd\", \"glr\"]", &["detection.detectors[2]", "glr", "before"]),
            ("[detection]\ndetectors = \"fcd\"", &["detection.detectors", "a list of any of", "jfd"]),
            ("[detection]\nvelocity = -1", &["detection.velocity", "-1", "0 m/s or more"]),
            ("[detection]\narming = \"none\"", &["detection.arming", "none", "paper"]),
            ("seed = [", &["line 1"]),
            ("a = 1\n[b", &["line 2"]),
        ] {
            let message = refused(text);
            for part in parts {
                assert!(message.contains(part), "{text:?} → {message:?} lacks {part:?}");
            }
            assert!(!message.contains('\n'), "{message:?} is more than a line");
        }
    }

    #[test]
    fn bytes_that_are_not_text_are_refused() {
        let message = Draft::from_bytes(b"seed = \xff").expect_err("bytes").to_string();
        assert!(message.contains("byte 7"), "{message}");
    }

    #[test]
    fn overrides_that_are_none_are_refused() {
        for text in ["seed", "=3", "seed=", "seed.x=1", "contact.disk.x=1", ".=2", "seed=1\nloop_rate=3"] {
            let mut draft = Draft::from_scenario(&Scenario::default());
            let refused = draft.set(text).err().or_else(|| draft.finish().err());
            assert!(refused.is_some(), "{text:?} was taken");
        }
    }
}
