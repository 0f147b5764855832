//! Logs as text: rows of numbers below a header, or in an order that the format fixes.

pub mod head;
pub mod lines;
pub mod ndi;
pub mod quality;
pub mod row;

use super::error::{LogError, quoted};
use super::gather::Clock;
use super::report::{Happening, Place};
use super::rotation::Orientation;
use super::{Format, Log, Options, Progress};
use crate::model::configuration::bend_from_theta_l;
use head::Head;
use lines::{Cells, Delimiter, Line, Lines, Numbers};
use ndi::Groups;
use quality::is_bad;
use row::{Ordered, Row, Slot, Turn};

/// Reads a text log row by row.
#[derive(Debug)]
pub struct TextReader {
    lines: Lines,
    cells: Cells,
    numbers: Numbers,
    row: Row,
    width: usize,
    /// Where a tool's columns are, in a file with several.
    groups: Option<Groups>,
    /// What was subtracted from all times so far, in the unit of the first column of time.
    origin: Option<i64>,
    clock: Clock,
    min_quality: Option<f64>,
    log: Log,
}

impl TextReader {
    /// Reads the header.
    ///
    /// # Errors
    /// When it does not say enough.
    pub fn new(format: Format, bytes: Vec<u8>, options: &Options) -> Result<Self, LogError> {
        let mut lines = Lines::new(bytes)?;
        let Head { delimiter, mut columns, line, groups } = head::read(format, &mut lines, options)?;
        let mut notes = Vec::new();
        let mut row = Row::new(&mut columns, line, &mut notes)?;
        if let Some(groups) = &groups {
            groups.time(&mut row, options.frame_rate, &mut notes)?;
        }
        if let Delimiter::Byte(b';' | b'\t') = delimiter {
            let name = if delimiter == Delimiter::Byte(b';') { "semicolons" } else { "tabs" };
            notes.push(format!("cells are divided by {name}"));
        }
        let mut log = Log::new(format, columns);
        log.report.notes = notes;
        Ok(Self {
            lines,
            cells: Cells::new(delimiter),
            numbers: Numbers::default(),
            row,
            width: log.columns.len(),
            groups,
            origin: None,
            clock: Clock::default(),
            min_quality: options.min_quality,
            log,
        })
    }

    /// What was read so far.
    #[must_use]
    pub fn log(&self) -> &Log {
        &self.log
    }

    /// Reads at most `rows` more.
    ///
    /// # Errors
    /// The first row that cannot be read.
    pub fn work(&mut self, rows: usize) -> Result<Progress, LogError> {
        for _ in 0..rows {
            let Some(line) = self.lines.next_row() else {
                let (_, of) = self.lines.progress();
                return Ok(Progress { done: of, of });
            };
            self.take(&line)?;
        }
        let (done, of) = self.lines.progress();
        Ok(Progress { done, of })
    }

    /// What was read.
    #[must_use]
    pub fn finish(mut self) -> Log {
        if self.numbers.has_commas() {
            self.log.report.notes.push("numbers have decimal commas".into());
        }
        if let Some(origin) = self.origin.filter(|origin| *origin != 0) {
            self.log.origin = self.row.time.unit.si(origin as f64);
        }
        self.log
    }

    fn take(&mut self, line: &Line) -> Result<(), LogError> {
        let number = line.number;
        self.log.report.rows += 1;
        if !line.ended {
            // Whether the last digits are there, too, nobody can say.
            self.log.report.add(Happening::Cut, Place::line(number), None);
            return Ok(());
        }
        self.cells.divide(self.lines.text(line), number)?;
        if let Some(groups) = &self.groups {
            groups.select(&mut self.cells, number)?;
        } else {
            let cells = self.cells.count();
            let extra = (self.width..cells).any(|place| !self.cells.get(place).is_empty());
            if cells < self.width || extra {
                let what = format!("has {cells} cells, and the header has {}", self.width);
                return Err(LogError::line(number, what));
            }
        }
        self.values(number)
    }

    /// Reads every cell before the clock decides, so that none goes unread.
    fn values(&mut self, line: u64) -> Result<(), LogError> {
        let Self { row, cells, numbers, clock, log, min_quality, origin, .. } = self;
        let time = time(cells, numbers, row, origin, line)?;
        let mut one = |slot: &Slot| value(cells, numbers, slot, line);
        let position = row.position.as_ref().map(|slots| all(slots, &mut one)).transpose()?;
        let orientation = match &row.turn {
            None => Orientation::None,
            Some(Turn::Euler(slots)) => Orientation::Euler(all(slots, &mut one)?),
            Some(Turn::Quaternion(slots)) => Orientation::Quaternion(all(slots, &mut one)?),
            Some(Turn::Vector(slots)) => Orientation::Vector(all(slots, &mut one)?),
        };
        let command = match &row.ordered {
            Some(Ordered::Bend(bend, delta)) => Some((one(bend)?, delta.as_ref().map(&mut one).transpose()?)),
            Some(Ordered::ThetaL(theta_l, delta)) => {
                Some((bend_from_theta_l(one(theta_l)?), delta.as_ref().map(&mut one).transpose()?))
            }
            _ => None,
        };
        let joints = match &row.ordered {
            Some(Ordered::Joints(slots)) => Some(all(slots, &mut one)?),
            _ => None,
        };
        let forces = row.forces.as_ref().map(|slots| all(slots, &mut one)).transpose()?;
        let bad = match &row.quality {
            Some(slot) => is_bad(cells.get(slot.place), numbers, *min_quality, line).map_err(|what| {
                LogError::cell(line, slot.place, &slot.header, what, "a number, or a word such as ok, bad, missing")
            })?,
            None => false,
        };
        if !clock.takes(time, || Place::line(line), &mut log.report) {
            return Ok(());
        }
        match position {
            Some(_) if bad => log.report.add(Happening::BadQuality, Place::line(line), Some(time)),
            Some(position) => log.reading(time, line, position, orientation),
            None => {}
        }
        if let Some((bend, delta)) = command {
            log.command(time, line, bend, delta);
        }
        if let Some(joints) = joints {
            log.joints(time, line, joints);
        }
        if let Some(forces) = forces {
            log.forces(time, line, forces);
        }
        Ok(())
    }
}

fn all<const N: usize>(
    slots: &[Slot; N],
    one: &mut impl FnMut(&Slot) -> Result<f64, LogError>,
) -> Result<[f64; N], LogError> {
    let mut values = [0.0; N];
    for (value, slot) in values.iter_mut().zip(slots) {
        *value = one(slot)?;
    }
    Ok(values)
}

/// The time of a row, s. Whole numbers too large for a double lose no digits: they are counted from the first.
fn time(cells: &Cells, numbers: &mut Numbers, row: &Row, origin: &mut Option<i64>, line: u64) -> Result<f64, LogError> {
    /// Beyond this, a double has no room for every whole number.
    const LONG: u64 = 1 << 53;
    /// Whole seconds with nanoseconds beside them: about as many seconds lose the nanoseconds.
    const LONG_SECONDS: u64 = 1 << 20;
    let slot = &row.time;
    let whole = std::str::from_utf8(cells.get(slot.place)).ok().and_then(|text| text.parse::<i64>().ok());
    let least = if row.nanoseconds.is_some() { LONG_SECONDS } else { LONG };
    let Some(whole) = whole.filter(|whole| origin.is_some_and(|origin| origin != 0) || whole.unsigned_abs() > least)
    else {
        let whole = origin.get_or_insert(0);
        let time = value(cells, numbers, slot, line)? - slot.unit.si(*whole as f64);
        let more = row.nanoseconds.as_ref().map_or(Ok(0.0), |slot| value(cells, numbers, slot, line))?;
        return Ok(time + more);
    };
    // The limit on numbers is checked as for any other cell.
    value(cells, numbers, slot, line)?;
    let origin = *origin.get_or_insert(whole);
    let more = row.nanoseconds.as_ref().map_or(Ok(0.0), |slot| value(cells, numbers, slot, line))?;
    Ok(slot.unit.si(whole.saturating_sub(origin) as f64) + more)
}

/// The number of a slot in SI; NaN where there is none.
#[inline]
fn value(cells: &Cells, numbers: &mut Numbers, slot: &Slot, line: u64) -> Result<f64, LogError> {
    let refuse = |what: String| LogError::cell(line, slot.place, &slot.header, what, "a finite number");
    let value = slot.unit.si(numbers.read(cells.get(slot.place), line).map_err(refuse)?);
    if value.abs() > slot.most {
        let what = format!("{} is far too large", quoted(cells.get(slot.place)));
        let allowed = format!("±{:e} in SI; is the unit right?", slot.most);
        return Err(LogError::cell(line, slot.place, &slot.header, what, allowed));
    }
    Ok(value)
}
