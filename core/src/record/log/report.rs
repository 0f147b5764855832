//! What a log's reader did with what it found: counts, each with the first place where it happened.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Where something stands in a log.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Place {
    /// Line of a text file, or message of a binary one, from 1; none for the file as a whole.
    pub line: Option<u64>,
    /// Column, from 1; none for the line as a whole.
    pub column: Option<u64>,
    /// Header of the column or name of the topic; empty for none.
    pub name: String,
}

impl Place {
    /// A whole line.
    #[must_use]
    pub fn line(line: u64) -> Self {
        Self { line: Some(line), ..Self::default() }
    }

    /// One cell.
    #[must_use]
    pub fn cell(line: u64, column: usize, name: &str) -> Self {
        Self { line: Some(line), column: Some(column as u64 + 1), name: name.into() }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}")?;
        }
        if let Some(column) = self.column {
            let comma = if self.line.is_some() { ", " } else { "" };
            write!(f, "{comma}column {column}")?;
        }
        if !self.name.is_empty() {
            write!(f, " ({})", self.name)?;
        }
        Ok(())
    }
}

/// What can happen to rows of a log on their way into a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Happening {
    /// The file ends within a row.
    Cut,
    /// The clock stepped back.
    StepBack,
    /// A row with the time of the row before.
    RepeatedTime,
    /// A row without a time.
    NoTime,
    /// A reading that the tracker itself marks as bad.
    BadQuality,
    /// A reading with a part that is empty or not a number.
    UndefinedReading,
    /// A command with such a part.
    UndefinedCommand,
    /// A load cell without a number.
    UndefinedForce,
    /// A quaternion that is not of unit length.
    Normalised,
    /// An angle that went through a whole turn.
    Unwrapped,
    /// A reading equal to the one before.
    RepeatedReading,
    /// A row that a later one overtakes before the loop's next instant.
    PassedOver,
    /// An instant of the loop without a reading of its own.
    HeldReading,
    /// An instant of the loop without a command of its own.
    HeldCommand,
    /// An instant of the loop without load cells of its own.
    HeldForce,
    /// An instant at which the last reading is too old to be held.
    GapInReadings,
    /// An instant at which the last command is too old to be held.
    GapInCommands,
    /// An instant at which the load cells' last values are too old to be held.
    GapInForces,
}

impl Happening {
    /// What it is called and what was done, for `count` of them.
    #[must_use]
    pub fn words(self, count: u64) -> String {
        let (one, many, done) = match self {
            Self::Cut => ("row was cut at the end of the file", "rows were cut at the end of the file", "dropped"),
            Self::StepBack => ("row lies before an earlier one", "rows lie before an earlier one", "dropped"),
            Self::RepeatedTime => {
                ("row repeats the time of the row before", "rows repeat the time of the row before", "dropped")
            }
            Self::NoTime => ("row has no time", "rows have no time", "dropped"),
            Self::BadQuality => ("reading is marked as bad", "readings are marked as bad", "dropped"),
            Self::UndefinedReading => ("reading is not defined", "readings are not defined", "dropped"),
            Self::UndefinedCommand => ("command is not defined", "commands are not defined", "dropped"),
            Self::UndefinedForce => {
                ("row has a load cell without a number", "rows have a load cell without a number", "left undefined")
            }
            Self::Normalised => {
                ("quaternion is not of unit length", "quaternions are not of unit length", "divided by their length")
            }
            Self::Unwrapped => (
                "reading has an angle that jumps by a whole turn",
                "readings have an angle that jumps by a whole turn",
                "joined",
            ),
            Self::RepeatedReading => {
                ("reading equals the one before", "readings equal the one before", "taken as they are")
            }
            Self::PassedOver => (
                "row is overtaken by the next before the loop looks",
                "rows are overtaken by the next before the loop looks",
                "dropped",
            ),
            Self::HeldReading => {
                ("instant has no reading of its own", "instants have no reading of their own", "the last one was held")
            }
            Self::HeldCommand => {
                ("instant has no command of its own", "instants have no command of their own", "the last one was held")
            }
            Self::HeldForce => (
                "instant has no load cells of its own",
                "instants have no load cells of their own",
                "the last were held",
            ),
            Self::GapInReadings => {
                ("instant lies in a gap of the readings", "instants lie in gaps of the readings", "left undefined")
            }
            Self::GapInCommands => {
                ("instant lies in a gap of the commands", "instants lie in gaps of the commands", "left undefined")
            }
            Self::GapInForces => {
                ("instant lies in a gap of the load cells", "instants lie in gaps of the load cells", "left undefined")
            }
        };
        format!("{count} {}: {done}", if count == 1 { one } else { many })
    }
}

/// How often something happened, and where first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Count {
    /// What happened.
    pub what: Happening,
    /// How often.
    pub count: u64,
    /// Where it happened first.
    pub first: Place,
    /// When it happened first, s on the log's clock; none where there is no time.
    pub time: Option<f64>,
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what.words(self.count))?;
        let (first, place) = (if self.count == 1 { "" } else { "first " }, self.first.to_string());
        match (place.as_str(), self.time) {
            ("", Some(time)) => write!(f, " ({first}at {time:.3} s)"),
            ("", None) => Ok(()),
            (place, _) => write!(f, " ({first}{place})"),
        }
    }
}

/// What was done with the rows of a log. Nothing is ever interpolated.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Report {
    /// Rows of a text file, or messages of a binary one, that were read.
    pub rows: u64,
    /// Everything else that happened, in the order of [`Happening`].
    pub counts: Vec<Count>,
    /// What else a person should know, in sentences.
    pub notes: Vec<String>,
}

impl Report {
    /// Counts something once more.
    pub fn add(&mut self, what: Happening, first: Place, time: Option<f64>) {
        self.add_many(what, 1, first, time);
    }

    /// Counts something that happened `count` times, at first in a place and at a time.
    pub fn add_many(&mut self, what: Happening, count: u64, first: Place, time: Option<f64>) {
        let time = time.filter(|time| time.is_finite());
        match self.counts.binary_search_by_key(&what, |count| count.what) {
            _ if count == 0 => {}
            Ok(place) => self.counts[place].count += count,
            Err(place) => self.counts.insert(place, Count { what, count, first, time }),
        }
    }

    /// How often something happened.
    #[must_use]
    pub fn count(&self, what: Happening) -> u64 {
        self.counts.iter().filter(|count| count.what == what).map(|count| count.count).sum()
    }

    /// Adds what a second file was found to hold, each with the file's name; its rows count as the log's.
    pub fn merge(&mut self, other: &Self, name: &str) {
        self.rows += other.rows;
        for count in &other.counts {
            let within = &count.first.name;
            let named = if within.is_empty() { name.into() } else { format!("{name}, {within}") };
            let place = self.counts.partition_point(|known| known.what <= count.what);
            self.counts.insert(place, Count { first: Place { name: named, ..count.first.clone() }, ..count.clone() });
        }
        self.notes.extend(other.notes.iter().map(|note| format!("{name}: {note}")));
    }

    /// Everything in sentences without full stop, one each.
    pub fn sentences(&self) -> impl Iterator<Item = String> {
        self.notes.iter().cloned().chain(self.counts.iter().map(Count::to_string))
    }
}
