//! Scenarios as TOML text: reading, overriding one key, and saying what is wrong where.

use crate::scenario::Scenario;
use crate::scenario::{Plan, ScenarioError};
use toml::{Table, Value};

/// The default scenario, every key with its unit and meaning, as `centrode scenario` prints it.
pub const DEFAULT_TOML: &str = include_str!("../../../assets/scenario.toml");

/// Keys of which a scenario holds one or the other: setting one removes its partner.
const EITHER_OR: [(&str, &str); 2] = [("disk", "arc_length"), ("time", "bend")];

/// A scenario being put together: a file or preset, then overrides, then a check.
#[derive(Debug, Clone, Default)]
pub struct Draft {
    table: Table,
}

impl Draft {
    /// From a scenario in hand.
    #[must_use]
    pub fn from_scenario(scenario: &Scenario) -> Self {
        Self { table: Table::try_from(scenario).unwrap_or_default() }
    }

    /// From a file's bytes.
    ///
    /// # Errors
    /// When they are not UTF-8, or not TOML.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ScenarioError> {
        let text =
            std::str::from_utf8(bytes).map_err(|error| ScenarioError::NotText { offset: error.valid_up_to() })?;
        Self::from_toml(text)
    }

    /// From TOML; missing keys have their defaults.
    ///
    /// # Errors
    /// When it is not TOML.
    pub fn from_toml(text: &str) -> Result<Self, ScenarioError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let table = text.parse::<Table>().map_err(|error| ScenarioError::Syntax {
            line: error.span().map_or(1, |span| 1 + text[..span.start.min(text.len())].matches('\n').count()),
            message: error.message().replace('\n', " "),
        })?;
        Ok(Self { table })
    }

    /// Overrides one key with `key=value`; the value is TOML, or a bare word.
    ///
    /// # Errors
    /// When the text is not `key=value`, or the key cannot hold another key.
    pub fn set(&mut self, text: &str) -> Result<(), ScenarioError> {
        let malformed = || ScenarioError::Override { text: text.into() };
        let (key, value) = text.split_once('=').ok_or_else(malformed)?;
        let (key, value) = (key.trim(), value.trim());
        if key.is_empty() || value.is_empty() {
            return Err(malformed());
        }
        let value = match format!("value = {value}").parse::<Table>() {
            Ok(mut table) if table.len() == 1 => table.remove("value").ok_or_else(malformed)?,
            _ => Value::String(value.into()),
        };
        let (groups, name) = key.rsplit_once('.').unwrap_or(("", key));
        let mut table = &mut self.table;
        for group in groups.split('.').filter(|group| !group.is_empty()) {
            let entry = table.entry(group).or_insert_with(|| Value::Table(Table::new()));
            table = entry.as_table_mut().ok_or_else(|| ScenarioError::UnknownKey {
                key: key.into(),
                known: format!("{group}, which holds no keys of its own"),
            })?;
        }
        if groups == "contact" {
            for (one, other) in EITHER_OR {
                for (set, dropped) in [(one, other), (other, one)] {
                    if name == set {
                        table.remove(dropped);
                    }
                }
            }
        }
        table.insert(name.into(), value);
        Ok(())
    }

    /// Whether the value under a key is a whole number.
    #[must_use]
    pub fn is_whole(&self, key: &str) -> bool {
        let (groups, name) = key.rsplit_once('.').unwrap_or(("", key));
        let mut table = Some(&self.table);
        for group in groups.split('.').filter(|group| !group.is_empty()) {
            table = table.and_then(|table| table.get(group)).and_then(Value::as_table);
        }
        table.and_then(|table| table.get(name)).is_some_and(Value::is_integer)
    }

    /// The draft itself when every key in it exists.
    ///
    /// # Errors
    /// The first key that does not.
    pub fn known_keys_only(self) -> Result<Self, ScenarioError> {
        check_keys(&self.table)?;
        Ok(self)
    }

    /// The scenario, checked.
    ///
    /// # Errors
    /// The first key that is unknown or value that is impossible.
    pub fn finish(self) -> Result<Scenario, ScenarioError> {
        let this = self.known_keys_only()?;
        let scenario: Scenario = serde_path_to_error::deserialize(Value::Table(this.table.clone()))
            .map_err(|error| type_error(&this.table, &error))?;
        Plan::new(&scenario)?;
        Ok(scenario)
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

/// The keys that exist in a group ("" for the top).
fn known_keys(group: &str) -> Option<Vec<String>> {
    let top: Table = toml::Value::try_from(Scenario::default()).ok()?.as_table()?.clone();
    let mut table = &top;
    for name in group.split('.').filter(|name| !name.is_empty()) {
        table = table.get(name)?.as_table()?;
    }
    let mut keys: Vec<String> = table.keys().cloned().collect();
    if group == "contact" {
        keys = EITHER_OR.iter().flat_map(|(one, other)| [(*one).into(), (*other).into()]).collect();
    }
    Some(keys)
}

fn check_keys(table: &Table) -> Result<(), ScenarioError> {
    fn walk(table: &Table, group: &str) -> Result<(), ScenarioError> {
        let Some(known) = known_keys(group) else {
            return Ok(());
        };
        for (key, value) in table {
            let path = if group.is_empty() { key.clone() } else { format!("{group}.{key}") };
            if !known.contains(key) {
                return Err(ScenarioError::UnknownKey { key: path, known: known.join(", ") });
            }
            if let Value::Table(inner) = value {
                walk(inner, &path)?;
            }
        }
        Ok(())
    }
    walk(table, "")
}

fn type_error(table: &Table, error: &serde_path_to_error::Error<toml::de::Error>) -> ScenarioError {
    let path = error.path().to_string();
    let mut value = None;
    let mut inner = Some(table);
    for name in path.split('.') {
        let (name, index) = name.split_once('[').map_or((name, None), |(name, index)| (name, Some(index)));
        value = inner.and_then(|table| table.get(name));
        if let Some(index) = index.and_then(|index| index.trim_end_matches(']').parse::<usize>().ok()) {
            value = value.and_then(|list| list.get(index));
        }
        inner = value.and_then(Value::as_table);
    }
    let value = value.map_or_else(String::new, ToString::to_string).replace('\n', " ");
    let allowed = match (path.as_str(), inner) {
        ("seed", _) => "a whole number from 0 to 9223372036854775807",
        ("contact.disk", _) => "a whole number, 0 or more",
        ("filter.length", _) => "a whole number, 1 or more",
        ("detection.xi1" | "detection.xi2", _) => "a number, 0 or more, or \"off\"",
        ("tracker.mounting", _) => "\"bending-axis\" or \"aligned\"",
        ("filter.averaging", _) => "\"readings\" or \"rotations\"",
        ("robot.disks", _) => "a list of arc lengths in m",
        ("load.force", _) => "three numbers, [x, y, z] in N",
        ("load.moment", _) => "three numbers, [x, y, z] in N·m",
        ("load_cells.errors", _) => "\"common\" or \"independent\"",
        ("detection.xi1_rule", _) => "\"constant\" or \"bound\"",
        ("contact", Some(_)) => "either disk or arc_length, and either time or bend, not both",
        ("contact", None) => "a table with disk or arc_length, and time or bend",
        _ if matches!(known_keys(&path), Some(keys) if !keys.is_empty()) => "a table of keys",
        _ => "a number",
    };
    ScenarioError::Value { key: path, value, allowed: allowed.into() }
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
                if let Value::Table(inner) = value {
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
        for text in
            ["contact.arc_length=0.011", "contact.bend=0.4", "detection.xi1=off", "seed=99", "robot.disks=[0.01]"]
        {
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
            ("[contact]\ndisk = -1", &["contact.disk", "-1", "whole"]),
            ("[contact]\ndisk = 1.5", &["contact.disk", "1.5", "whole"]),
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
            ("[motion]\nend = 1e9", &["motion.end", "1000000000", "1e8"]),
            ("[motion]\nfinish = 2", &["motion.finish", "2", "after"]),
            ("seed = -1", &["seed", "-1", "whole"]),
            ("loop_rate = 1e308", &["loop_rate", "1e308", "1000000 Hz"]),
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
