//! A table of a chain's file: its values, and where they stand.

use super::{ChainError, Fault};
use crate::model::Vec3;
use crate::scenario::keys::{Allowed, Quantity, Units, Value};
use crate::scenario::refusal::{Refused, ScenarioError};
use toml::Table;
use toml::de::{DeTable, DeValue};

/// A table by its dotted path, tables of a list counted from 1.
pub(super) struct Group<'a> {
    path: String,
    table: &'a Table,
    /// The same table with the place of everything in the text.
    spans: Option<&'a DeTable<'a>>,
    text: &'a str,
    /// Where the table begins; none for the whole file.
    start: Option<usize>,
}

/// The line, from 1, of a place in a text.
pub(super) fn line(text: &str, place: usize) -> usize {
    1 + text.bytes().take(place).filter(|byte| *byte == b'\n').count()
}

/// The text of a file.
pub(super) fn text(bytes: &[u8]) -> Result<&str, ChainError> {
    let text =
        std::str::from_utf8(bytes).map_err(|error| whole(ScenarioError::NotText { offset: error.valid_up_to() }))?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// Its tables.
pub(super) fn parsed(text: &str) -> Result<Table, ChainError> {
    text.parse::<Table>().map_err(|error| {
        let line = error.span().map_or(1, |span| line(text, span.start));
        whole(ScenarioError::Syntax { line, message: error.message().replace('\n', " ") })
    })
}

/// A fault of the text as a whole.
pub(super) fn whole(error: ScenarioError) -> ChainError {
    ChainError { line: None, fault: Fault::Scenario(error) }
}

/// A number, whole or not.
pub(super) fn float(value: &toml::Value) -> Option<f64> {
    match value {
        toml::Value::Float(number) => Some(*number),
        toml::Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}

impl<'a> Group<'a> {
    /// The whole file.
    pub fn top(text: &'a str, table: &'a Table, spans: Option<&'a DeTable<'a>>) -> Self {
        Self { path: String::new(), table, spans, text, start: None }
    }

    pub fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    pub fn value(&self, key: &str) -> Option<&'a toml::Value> {
        self.table.get(key)
    }

    pub fn key(&self, key: &str) -> String {
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }

    /// The line of a place, or of the table.
    fn line(&self, place: Option<usize>) -> Option<usize> {
        place.or(self.start).map(|place| line(self.text, place))
    }

    /// The line of a key of a group, where it is in the text.
    pub fn line_of(&self, [group, key]: [&str; 2]) -> Option<usize> {
        let inner = self.spans?.get(group)?.get_ref();
        Some(line(self.text, inner.as_table()?.get_key_value(key)?.0.span().start))
    }

    /// An error at a key.
    pub fn at(&self, key: &str, error: ScenarioError) -> ChainError {
        let place = self.spans.and_then(|spans| Some(spans.get_key_value(key)?.0.span().start));
        ChainError { line: self.line(place), fault: Fault::Scenario(error) }
    }

    /// Refuses a key's value.
    pub fn refuse(&self, key: &str, quantity: Quantity, value: Value, allowed: Allowed) -> ChainError {
        self.at(key, Refused::error(self.key(key), quantity, value, allowed))
    }

    /// Refuses a key's value as it stands in the file.
    pub fn refuse_as_written(&self, key: &str, quantity: Quantity, allowed: Allowed) -> ChainError {
        let written = self.value(key).map(|value| value.to_string().replace('\n', " ")).unwrap_or_default();
        self.refuse(key, quantity, Value::Other(written), allowed)
    }

    /// Refuses that a key is not given.
    pub fn missing(&self, key: &str, allowed: &str) -> ChainError {
        ChainError { line: self.line(None), fault: Fault::Missing { key: self.key(key), allowed: allowed.into() } }
    }

    /// Refuses the first key that is none of these.
    pub fn knows(&self, known: &[&str]) -> Result<(), ChainError> {
        let unknown = self.table.keys().find(|key| !known.contains(&key.as_str()));
        unknown.map_or(Ok(()), |key| {
            let error = ScenarioError::UnknownKey { key: self.key(key), known: known.join(", ") };
            Err(self.at(key, error))
        })
    }

    /// A number; without a default it must be given.
    pub fn number(
        &self,
        key: &str,
        quantity: Quantity,
        allowed: Allowed,
        default: Option<f64>,
    ) -> Result<f64, ChainError> {
        match (self.value(key), default) {
            (None, Some(default)) => Ok(default),
            (None, None) => Err(self.missing(key, &allowed.words(quantity, Units::Si))),
            (Some(value), _) => match float(value) {
                Some(number) if number.is_finite() && allowed.has(number) => Ok(number),
                Some(number) => Err(self.refuse(key, quantity, Value::Number(number), finite(allowed))),
                None => Err(self.refuse_as_written(key, quantity, allowed)),
            },
        }
    }

    /// A whole number; it must be given.
    pub fn whole(&self, key: &str, least: usize, most: usize) -> Result<usize, ChainError> {
        let allowed = Allowed::Whole(least as u64, most as u64);
        let Some(value) = self.value(key) else {
            return Err(self.missing(key, &allowed.words(Quantity::Count, Units::Si)));
        };
        let number = value.as_integer().and_then(|number| usize::try_from(number).ok());
        number
            .filter(|number| (least..=most).contains(number))
            .ok_or_else(|| self.refuse_as_written(key, Quantity::Count, allowed))
    }

    /// Three finite numbers; they must be given.
    pub fn vector(&self, key: &str, allowed: &'static str) -> Result<Vec3, ChainError> {
        let Some(value) = self.value(key) else { return Err(self.missing(key, allowed)) };
        let numbers: Option<Vec<f64>> = value.as_array().and_then(|items| items.iter().map(float).collect());
        match numbers.as_deref() {
            Some(&[x, y, z]) => Ok(Vec3::new(x, y, z)),
            _ => Err(self.refuse_as_written(key, Quantity::Count, Allowed::Need(allowed))),
        }
    }

    /// A table within this one, if it is given.
    pub fn table(&self, key: &str, allowed: &'static str) -> Result<Option<Self>, ChainError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let table =
            value.as_table().ok_or_else(|| self.refuse_as_written(key, Quantity::Word, Allowed::Need(allowed)))?;
        let spanned = self.spans.and_then(|spans| spans.get(key));
        Ok(Some(Self {
            path: self.key(key),
            table,
            spans: spanned.and_then(|value| value.get_ref().as_table()),
            text: self.text,
            start: spanned.map_or(self.start, |value| Some(value.span().start)),
        }))
    }

    /// The tables of a list, none where it is not given.
    pub fn tables(&self, key: &str, most: usize) -> Result<Vec<Self>, ChainError> {
        const LIST: &str = "tables, each under its own [[segment]] or [[contact]]";
        let refuse = |need| self.refuse_as_written(key, Quantity::Word, Allowed::Need(need));
        let Some(value) = self.value(key) else { return Ok(Vec::new()) };
        let items = value.as_array().ok_or_else(|| refuse(LIST))?;
        if items.len() > most {
            let count = Value::Other(format!("{} tables", items.len()));
            return Err(self.refuse(key, Quantity::Count, count, Allowed::Need("at most 12 of them")));
        }
        let spans = self.spans.and_then(|spans| spans.get(key)?.get_ref().as_array());
        let each = items.iter().enumerate().map(|(place, item)| {
            let spanned = spans.and_then(|spans| spans.get(place));
            Ok(Self {
                path: format!("{}[{}]", self.key(key), place + 1),
                table: item.as_table().ok_or_else(|| refuse(LIST))?,
                spans: spanned.and_then(|item| DeValue::as_table(item.get_ref())),
                text: self.text,
                start: spanned.map(|item| item.span().start),
            })
        });
        each.collect()
    }
}

/// What is allowed in place of a number that is not finite.
fn finite(allowed: Allowed) -> Allowed {
    if allowed == Allowed::Number { Allowed::Need("a finite number") } else { allowed }
}
