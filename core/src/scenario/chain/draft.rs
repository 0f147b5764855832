//! An experiment with several segments as a person edits it: its text as a table, of which values are set one by one.

use super::group::{Group, parsed, text, whole};
use super::read::{inner, replace};
use super::{ChainError, ChainScenario};
use crate::scenario::preset::{CHAINS, Preset};
use crate::scenario::refusal::ScenarioError;
use crate::scenario::text::number;
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;
use toml::{Table, Value};

/// The text of an experiment that can be read: [`ChainDraft::scenario`] never fails on what the functions here give. Numbers that are written
/// in two ways are equal.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ChainDraft {
    table: Table,
}

impl PartialEq for ChainDraft {
    fn eq(&self, other: &Self) -> bool {
        same_table(&self.table, &other.table)
    }
}

/// One change of a text. Paths are those of `--set`: `segment[2].motion.theta_end`, `contact[1]`.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// Puts a value where there is another or none.
    Set(String, Value),
    /// Takes a value away, or one of a list.
    Remove(String),
    /// Puts a table behind the others of a list.
    Add(&'static str, Table),
}

impl ChainDraft {
    /// The text of one of [`CHAINS`]; of the first where the preset is none of them.
    ///
    /// # Panics
    /// Never with presets that come with the program, which a test reads.
    #[must_use]
    pub fn of(preset: &Preset) -> Self {
        static READ: [OnceLock<ChainDraft>; CHAINS.len()] = [const { OnceLock::new() }; CHAINS.len()];
        let place = CHAINS.iter().position(|known| known.name == preset.name).unwrap_or(0);
        let read =
            || Self::from_bytes(CHAINS[place].toml.as_bytes()).expect("presets that come with the program can be read");
        READ[place].get_or_init(read).clone()
    }

    /// Reads TOML from bytes.
    ///
    /// # Errors
    /// Those of [`ChainScenario::from_bytes`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ChainError> {
        Self::read(bytes, &[])
    }

    /// The same with values of keys in place of those in the text.
    ///
    /// # Errors
    /// Likewise.
    pub fn read(bytes: &[u8], overrides: &[String]) -> Result<Self, ChainError> {
        ChainScenario::from_bytes(bytes, overrides)?;
        let mut table = parsed(text(bytes)?)?;
        overrides.iter().try_for_each(|text| replace(&mut table, text)).map_err(whole)?;
        Ok(Self { table })
    }

    /// What it says.
    ///
    /// # Errors
    /// Never for a text that came of the functions here; one that was stored may be of another version.
    pub fn scenario(&self) -> Result<ChainScenario, ChainError> {
        ChainScenario::read(&Group::top("", &self.table, None), &self.table)
    }

    /// A value as it is written; none where the default holds.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<&Value> {
        let mut at: Option<&Value> = None;
        for part in path.split('.') {
            let table = match at {
                None => &self.table,
                Some(value) => value.as_table()?,
            };
            let (key, number) = listed(part).map_or((part, None), |(key, number)| (key, Some(number)));
            at = table.get(key);
            if let Some(number) = number {
                at = at?.as_array()?.get(number);
            }
        }
        at
    }

    /// The text with some changes.
    ///
    /// # Errors
    /// When what comes of them cannot be read: the first thing that is wrong, with its key and what is allowed.
    pub fn with(&self, changes: impl IntoIterator<Item = Change>) -> Result<Self, ChainError> {
        let mut changed = self.clone();
        changes.into_iter().try_for_each(|change| changed.change(change)).map_err(whole)?;
        changed.scenario()?;
        Ok(changed)
    }

    /// The text with values in the place of others, each `key=value` as `--set` takes it.
    ///
    /// # Errors
    /// As for [`Self::with`].
    pub fn overridden<'a>(&self, overrides: impl IntoIterator<Item = &'a str>) -> Result<Self, ChainError> {
        let mut changed = self.clone();
        overrides.into_iter().try_for_each(|text| replace(&mut changed.table, text)).map_err(whole)?;
        changed.scenario()?;
        Ok(changed)
    }

    fn change(&mut self, change: Change) -> Result<(), ScenarioError> {
        let none = |path: &str| ScenarioError::Override { text: path.into() };
        match change {
            Change::Add(list, table) => {
                let list_of = self.table.entry(list).or_insert_with(|| Value::Array(Vec::new()));
                list_of.as_array_mut().ok_or_else(|| none(list))?.push(Value::Table(table));
            }
            Change::Set(path, value) => {
                let (last, at) = self.inside(&path).ok_or_else(|| none(&path))?;
                at.insert(last, value);
            }
            Change::Remove(path) => {
                let (last, at) = self.inside(&path).ok_or_else(|| none(&path))?;
                match listed(&last) {
                    None => drop(at.remove(&last)),
                    Some((key, number)) => {
                        let list = at.get_mut(key).and_then(Value::as_array_mut).filter(|list| number < list.len());
                        list.ok_or_else(|| none(&path))?.remove(number);
                    }
                }
            }
        }
        Ok(())
    }

    /// The last part of a path, and the table that it is in.
    fn inside(&mut self, path: &str) -> Option<(String, &mut Table)> {
        let (groups, last) = path.rsplit_once('.').map_or(("", path), |(groups, last)| (groups, last));
        let mut at = &mut self.table;
        for part in groups.split('.').filter(|part| !part.is_empty()) {
            at = inner(at, part)?;
        }
        Some((last.into(), at))
    }

    /// What is to be set of another text to have this one: keys and values as `--set` takes them.
    #[must_use]
    pub fn differences(&self, base: &Self) -> Vec<(String, String)> {
        let mut out = Vec::new();
        for (key, value) in &self.table {
            differ(key, base.table.get(key), value, &mut out);
        }
        for (key, value) in base.table.iter().filter(|(key, _)| !self.table.contains_key(*key)) {
            let empty = match value {
                Value::Array(_) => "[]",
                Value::Table(_) => "{}",
                // The one value at the top that presets give.
                _ => "10",
            };
            out.push((key.clone(), empty.into()));
        }
        out
    }

    /// As a file.
    #[must_use]
    pub fn to_toml(&self) -> String {
        toml::to_string(&self.table).unwrap_or_default()
    }
}

/// A part of a path that counts from 1 in a list: its key, and the place from 0.
fn listed(part: &str) -> Option<(&str, usize)> {
    let (key, number) = part.strip_suffix(']')?.split_once('[')?;
    Some((key, number.parse::<usize>().ok()?.checked_sub(1)?))
}

/// Whether two values say the same, whole or not.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Table(a), Value::Table(b)) => same_table(a, b),
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        _ => match (super::group::float(a), super::group::float(b)) {
            (Some(a), Some(b)) => a.to_bits() == b.to_bits(),
            _ => a == b,
        },
    }
}

fn same_table(a: &Table, b: &Table) -> bool {
    a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| same(a, b)))
}

fn differ(path: &str, base: Option<&Value>, own: &Value, out: &mut Vec<(String, String)>) {
    match (base, own) {
        (Some(base), own) if same(base, own) => {}
        (Some(Value::Table(base)), Value::Table(own)) if base.keys().all(|key| own.contains_key(key)) => {
            for (key, value) in own {
                differ(&format!("{path}.{key}"), base.get(key), value, out);
            }
        }
        (Some(Value::Array(base)), Value::Array(own)) if base.len() == own.len() && told_apart(base, own) => {
            for (place, (base, own)) in base.iter().zip(own).enumerate() {
                differ(&format!("{path}[{}]", place + 1), Some(base), own, out);
            }
        }
        _ => out.push((path.into(), written(own))),
    }
}

/// Whether lists of tables differ in values alone.
fn told_apart(base: &[Value], own: &[Value]) -> bool {
    base.iter().zip(own).all(|(base, own)| match (base, own) {
        (Value::Table(base), Value::Table(own)) => base.keys().all(|key| own.contains_key(key)),
        _ => false,
    })
}

/// A value on one line.
fn written(value: &Value) -> String {
    match value {
        // A whole number −0 has no sign.
        Value::Float(value) if *value == 0.0 && value.is_sign_negative() => "-0.0".into(),
        Value::Float(value) => number(*value),
        Value::Array(items) => format!("[{}]", items.iter().map(written).collect::<Vec<_>>().join(",")),
        Value::Table(table) => {
            let each = table.iter().map(|(key, value)| format!("{key}={}", written(value)));
            format!("{{{}}}", each.collect::<Vec<_>>().join(","))
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::preset::find_chain;

    fn draft(name: &str) -> ChainDraft {
        ChainDraft::of(find_chain(name).expect("a preset"))
    }

    #[test]
    fn what_differs_makes_the_one_text_of_the_other() {
        for base in CHAINS {
            for own in CHAINS {
                let (base, own) = (ChainDraft::of(base), ChainDraft::of(own));
                let texts: Vec<String> =
                    own.differences(&base).iter().map(|(key, value)| format!("{key}={value}")).collect();
                let made = base.overridden(texts.iter().map(String::as_str)).expect("it can be read");
                assert_eq!(made.scenario(), own.scenario());
                assert_eq!(made.differences(&own), []);
            }
        }
    }

    #[test]
    fn a_value_is_set_a_contact_comes_and_goes() {
        let draft = draft("two-contacts");
        let path = "segment[2].motion.theta_end";
        let moved = draft.with([Change::Set(path.into(), Value::Float(0.5))]).expect("possible");
        assert_eq!(moved.get(path), Some(&Value::Float(0.5)));
        assert_eq!(moved.differences(&draft), [(path.into(), "0.5".into())]);
        let contact: Table = "segment = 1\nat = 0.02\ntime = 4".parse().expect("a table");
        let more = moved.with([Change::Add("contact", contact)]).expect("possible");
        assert_eq!(more.scenario().expect("possible").contacts.len(), 3);
        let fewer = more.with([1, 1, 1].map(|k| Change::Remove(format!("contact[{k}]")))).expect("possible");
        assert_eq!(fewer.scenario().expect("possible").contacts.len(), 0);
        assert_eq!(fewer.differences(&moved), [("contact".into(), "[]".into())]);
    }

    #[test]
    fn what_is_set_takes_the_place_of_what_says_the_same_in_another_way() {
        let draft = draft("three-segments");
        let contact = |set: &[&str]| {
            let scenario = draft.overridden(set.iter().copied()).and_then(|draft| draft.scenario());
            scenario.map(|scenario| scenario.contacts[0].clone()).map_err(|error| error.to_string())
        };
        assert_eq!(contact(&["contact[1].at=0.012"]).map(|contact| contact.at), Ok(0.012));
        assert_eq!(contact(&["contact[1].at=0.012", "contact[1].disk=3"]), contact(&["contact[1].disk=3"]));
        assert_eq!(contact(&["contact[1].bend=0.5", "contact[1].time=5.8"]), contact(&[]));
        let plane = ["contact[1].normal=[0.0, 0.0, 1.0]", "contact[1].offset=0.05"];
        assert_eq!(contact(&plane), contact(&[plane[1], plane[0]]));
        let [from, tilted] = ["contact[1].time=5.8", "contact[1].tilt=0.2"];
        assert_eq!(contact(&[from, tilted, plane[0], plane[1]]), contact(&plane));
        assert!(contact(&plane[1..]).is_err_and(|why| why.contains("normal")), "an offset of nothing");
    }

    #[test]
    fn what_cannot_be_read_changes_nothing_and_says_why() {
        let draft = draft("two-contacts");
        let refused = draft.with([Change::Set("segment[2].length".into(), Value::Float(-1.0))]).expect_err("negative");
        assert!(refused.to_string().contains("segment[2].length = -1"), "{refused}");
        for path in ["segment[9].length", "contact[0].at", "contact[3]"] {
            assert!(draft.with([Change::Remove(path.into())]).is_err(), "{path}");
        }
    }

    #[test]
    fn a_file_reads_back_to_what_was_saved() {
        for preset in CHAINS {
            let draft = ChainDraft::of(preset);
            let read = ChainDraft::from_bytes(draft.to_toml().as_bytes()).expect("it was written");
            assert_eq!(read.scenario(), draft.scenario(), "{}", preset.name);
        }
    }
}
