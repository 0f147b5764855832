//! Which values of which keys are compared.

use crate::scenario::keys::{self, Allowed, Key, Quantity, Value};
use crate::scenario::text::number;
use crate::scenario::{Override, Refused, ScenarioError};
use std::str::FromStr;
use thiserror::Error;

/// The most values of one sweep.
pub const MAX_VALUES: usize = 10_000;
/// The most cells of one study.
pub const MAX_CELLS: usize = 10_000;

/// A key and the values it takes in turn, written `key=a:b:n` (n values from a to b, evenly) or `key=v1,v2`.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Dotted key.
    pub key: String,
    /// Values as TOML.
    pub values: Vec<String>,
}

/// Why a sweep is refused.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// Not a sweep at all.
    #[error("{0:?} is not a sweep: write key=a:b:n, as in filter.length=100:1000:10, or key=v1,v2")]
    Malformed(String),
    /// A range that cannot be.
    #[error("{0:?}: {1}")]
    Range(String, String),
    /// More than can be compared.
    #[error("{0}")]
    Many(String),
    /// A key that two sweeps have.
    #[error("{0} is swept twice")]
    Twice(String),
    /// A key or value that the scenario refuses.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
}

impl FromStr for Sweep {
    type Err = SweepError;

    fn from_str(text: &str) -> Result<Self, SweepError> {
        let malformed = || SweepError::Malformed(text.into());
        let (key, values) = text.split_once('=').ok_or_else(malformed)?;
        let (key, values) = (key.trim().to_owned(), values.trim());
        if key.is_empty() || values.is_empty() {
            return Err(malformed());
        }
        let values = match values.split(':').collect::<Vec<_>>()[..] {
            [from, to, count] if !values.contains(['"', '[']) => range(text, [from, to, count])?,
            [_] => list(values),
            _ => return Err(malformed()),
        };
        if values.iter().any(String::is_empty) {
            return Err(malformed());
        }
        if values.len() > MAX_VALUES {
            return Err(SweepError::Many(format!(
                "{key} takes {} values; at most {MAX_VALUES} are allowed",
                values.len()
            )));
        }
        Ok(Self { key, values })
    }
}

fn range(text: &str, [from, to, count]: [&str; 3]) -> Result<Vec<String>, SweepError> {
    let wrong = |what: String| SweepError::Range(text.into(), what);
    let end = |end: &str| {
        let value = end.trim().parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| wrong(format!("{:?} is not a number", end.trim())))
    };
    let (from, to) = (end(from)?, end(to)?);
    let count: usize = count.trim().parse().ok().filter(|count| (2..=MAX_VALUES).contains(count)).ok_or_else(|| {
        wrong(format!("{:?} is not a number of values, a whole number from 2 to {MAX_VALUES}", count.trim()))
    })?;
    let steps = (count - 1) as f64;
    Ok((0..count)
        .map(|k| {
            // To twelve digits: 0.1 + 0.2 is 0.3 as it was meant.
            let value = from + (to - from) * (k as f64 / steps);
            number(format!("{value:.11e}").parse().unwrap_or(value))
        })
        .collect())
}

/// Splits at commas, but not inside brackets or quotes.
fn list(values: &str) -> Vec<String> {
    let (mut depth, mut quoted) = (0, false);
    let parts = values.split(|character| {
        match character {
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth -= 1,
            _ => {}
        }
        character == ',' && depth == 0 && !quoted
    });
    parts.map(|part| part.trim().to_owned()).collect()
}

impl Sweep {
    /// The values as numbers of 0 or more, rising, for a threshold.
    ///
    /// # Errors
    /// When one is none.
    pub fn levels(&self) -> Result<Vec<f64>, SweepError> {
        let mut levels = Vec::with_capacity(self.values.len());
        for value in &self.values {
            let level = value.parse::<f64>().ok().filter(|level| *level >= 0.0 && level.is_finite());
            levels.push(level.ok_or_else(|| {
                let allowed = Allowed::Need("a swept threshold is a finite number, 0 or more");
                Refused::error(self.key.clone(), Quantity::Count, Value::Other(value.clone()), allowed)
            })?);
        }
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        Ok(levels)
    }
}

/// Every combination of the sweeps' values, the last sweep changing fastest; one empty one without sweeps.
///
/// Ends of ranges may miss whole numbers: where a key holds whole numbers, values are rounded to one.
///
/// # Errors
/// [`SweepError::Twice`] when a key is swept twice, [`SweepError::Many`] when there are more than [`MAX_CELLS`],
/// [`SweepError::Scenario`] when there is no such key or it holds no such value.
pub fn combinations(sweeps: &[Sweep]) -> Result<Vec<Vec<Override>>, SweepError> {
    let mut cells: Vec<Vec<Override>> = vec![Vec::new()];
    for (k, sweep) in sweeps.iter().enumerate() {
        if sweeps[..k].iter().any(|before| before.key == sweep.key) {
            return Err(SweepError::Twice(sweep.key.clone()));
        }
        if cells.len() * sweep.values.len() > MAX_CELLS {
            return Err(SweepError::Many(format!("the sweeps make more than {MAX_CELLS} combinations")));
        }
        let whole = keys::find(&sweep.key).is_some_and(Key::is_whole);
        let mut values: Vec<Override> = Vec::with_capacity(sweep.values.len());
        for value in &sweep.values {
            let rounded = value.parse::<f64>().ok().filter(|_| whole).map(|value| format!("{}", libm::rint(value)));
            let value: Override = format!("{}={}", sweep.key, rounded.as_ref().unwrap_or(value)).parse()?;
            if !values.iter().any(|known| known.written() == value.written()) {
                values.push(value);
            }
        }
        let with = |cell: &Vec<Override>, value: &Override| {
            let mut cell = cell.clone();
            cell.push(value.clone());
            cell
        };
        cells = cells.iter().flat_map(|cell| values.iter().map(move |value| with(cell, value))).collect();
    }
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        text.parse::<Sweep>().expect(text).values
    }

    #[test]
    fn ranges_and_lists_are_read_as_meant() {
        assert_eq!(values("filter.length=100:300:3"), ["100", "200", "300"]);
        assert_eq!(values("tracker.position_noise=0:0.3:4"), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(values("x = 5:1:2"), ["5", "1"]);
        assert_eq!(values("filter.averaging=readings, rotations"), ["readings", "rotations"]);
        assert_eq!(values("robot.disks=[0.01, 0.02],[0.015]"), ["[0.01, 0.02]", "[0.015]"]);
        assert_eq!(values("seed=7"), ["7"]);
    }

    #[test]
    fn what_is_no_sweep_is_refused() {
        for text in [
            "",
            "x",
            "x=",
            "=1",
            "x=1:2",
            "x=1:2:1",
            "x=1:2:1.5",
            "x=a:2:3",
            "x=1:inf:3",
            "x=1,,2",
            "x=1:2:3:4",
            "x=0:1:99999",
        ] {
            assert!(text.parse::<Sweep>().is_err(), "{text}");
        }
        assert!(values("detection.xi2=off,1").len() == 2);
        assert!("detection.xi2=off,1".parse::<Sweep>().and_then(|sweep| sweep.levels()).is_err());
    }

    #[test]
    fn combinations_are_all_of_them_and_whole_where_they_must_be() {
        let sweeps: Vec<Sweep> =
            ["filter.length=100:150:3", "contact.disk=1,2"].map(|text| text.parse().expect(text)).into();
        let cells = combinations(&sweeps).expect("cells");
        assert_eq!(cells.len(), 6);
        assert_eq!(
            cells[1].iter().map(ToString::to_string).collect::<Vec<_>>(),
            ["filter.length=100", "contact.disk=2"]
        );
        let sweep: Sweep = "filter.length=1:3:9".parse().expect("a sweep");
        assert_eq!(combinations(std::slice::from_ref(&sweep)).expect("cells").len(), 3);
        assert!(combinations(&[sweep.clone(), sweep]).is_err());
    }
}
