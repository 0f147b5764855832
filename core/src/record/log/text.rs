//! Logs as text: rows of numbers below a header, or in an order that the format fixes.

pub mod lines;
pub mod row;

use super::error::{LogError, quoted};
use super::gather::Clock;
use super::header::{Column, Role, columns};
use super::report::{Happening, Place};
use super::rotation::Orientation;
use super::{Format, Log, Options, Progress};
use crate::model::configuration::bend_from_theta_l;
use lines::{Cells, Delimiter, Line, Lines, Numbers};
use row::{Ordered, Row, Slot, Turn};

/// Reads a text log row by row.
#[derive(Debug)]
pub struct TextReader {
    lines: Lines,
    cells: Cells,
    numbers: Numbers,
    row: Row,
    width: usize,
    /// Whether rows may be shorter or longer than the header.
    ragged: bool,
    clock: Clock,
    min_quality: Option<f64>,
    log: Log,
}

/// The columns of a TUM trajectory.
const TUM: [Role; 8] = [Role::Time, Role::X, Role::Y, Role::Z, Role::Qx, Role::Qy, Role::Qz, Role::Qw];

/// Whether the first row of a file is eight numbers with spaces between them.
#[must_use]
pub fn looks_like_tum(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let first = start
        .split(|byte| *byte == b'\n')
        .map(<[u8]>::trim_ascii)
        .find(|line| !line.is_empty() && !line.starts_with(b"#"));
    first.is_some_and(|line| {
        let mut cells = line.split(u8::is_ascii_whitespace).filter(|cell| !cell.is_empty());
        cells.by_ref().take(TUM.len()).filter(|cell| is_number(cell)).count() == TUM.len() && cells.next().is_none()
    })
}

fn is_number(cell: &[u8]) -> bool {
    Numbers::default().read(cell, 0).is_ok_and(|value| !value.is_nan())
}

/// What stands above the rows.
struct Head {
    delimiter: Delimiter,
    columns: Vec<Column>,
    /// Line of the header, from 1.
    line: u64,
}

impl TextReader {
    /// Reads the header.
    ///
    /// # Errors
    /// When it does not say enough.
    pub fn new(format: Format, bytes: Vec<u8>, options: &Options) -> Result<Self, LogError> {
        let mut lines = Lines::new(bytes)?;
        let mut head = match format {
            Format::Csv => csv_head(&mut lines, options)?,
            Format::Tum => tum_head(),
        };
        let mut notes = Vec::new();
        let row = Row::new(&mut head.columns, head.line, &mut notes)?;
        if let Delimiter::Byte(b';' | b'\t') = head.delimiter {
            let name = if head.delimiter == Delimiter::Byte(b';') { "semicolons" } else { "tabs" };
            notes.push(format!("cells are divided by {name}"));
        }
        let mut log = Log::new(format, head.columns);
        log.report.notes = notes;
        Ok(Self {
            lines,
            cells: Cells::new(head.delimiter),
            numbers: Numbers::default(),
            row,
            width: log.columns.len(),
            ragged: false,
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
        let cells = self.cells.len();
        let extra = (self.width..cells).any(|place| !self.cells.get(place).is_empty());
        if !self.ragged && (cells < self.width || extra) {
            let what = format!("has {cells} cells, and the header has {}", self.width);
            return Err(LogError::line(number, what));
        }
        self.values(number)
    }

    /// Reads every cell before the clock decides, so that none goes unread.
    fn values(&mut self, line: u64) -> Result<(), LogError> {
        let Self { row, cells, numbers, clock, log, min_quality, .. } = self;
        let mut one = |slot: &Slot| value(cells, numbers, slot, line);
        let time = one(&row.time)?;
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

/// Words of trackers, small.
const GOOD: [&str; 9] = ["ok", "good", "valid", "tracked", "visible", "enabled", "true", "yes", "online"];
const BAD: [&str; 12] = [
    "bad",
    "missing",
    "lost",
    "invalid",
    "false",
    "no",
    "disabled",
    "offline",
    "outofvolume",
    "partiallyoutofvolume",
    "toofewmarkers",
    "occluded",
];

/// Whether a reading of this quality is dropped.
fn is_bad(cell: &[u8], numbers: &mut Numbers, least: Option<f64>, line: u64) -> Result<bool, String> {
    if let Ok(value) = numbers.read(cell, line) {
        return Ok(!(value > 0.0 && least.is_none_or(|least| value >= least)));
    }
    let word: String = String::from_utf8_lossy(cell).chars().filter(|c| c.is_alphanumeric()).collect();
    let word = word.to_lowercase();
    match (GOOD.contains(&word.as_str()), BAD.contains(&word.as_str())) {
        (true, _) => Ok(false),
        (_, true) => Ok(true),
        _ => Err(format!("{} says nothing about the quality", quoted(cell))),
    }
}

fn tum_head() -> Head {
    let units = |role: Role| role.dimension().si().name;
    let columns = TUM.iter().enumerate().map(|(place, role)| Column::fixed(place, role.key(), *role, units(*role)));
    Head { delimiter: Delimiter::Spaces, columns: columns.collect(), line: 1 }
}

fn csv_head(lines: &mut Lines, options: &Options) -> Result<Head, LogError> {
    let first = lines.next_row().ok_or_else(|| LogError::file("holds comments alone"))?;
    let text = lines.text(&first);
    let delimiter = Delimiter::of(text);
    let headers = headers(text, delimiter, first.number)?;
    if headers.iter().all(|cell| is_number(cell.as_bytes())) {
        // Rows without a header: a person says which column is what by its number.
        let named = |place: usize| if options.mappings.is_empty() { None } else { Some(format!("#{}", place + 1)) };
        let names: Option<Vec<String>> = (0..headers.len()).map(named).collect();
        let what = "holds numbers, not the names of columns: add a header as in \"time [s],x [mm],…\", or say which column is \
                    what with --map time=#1 and so on";
        let names = names.ok_or_else(|| LogError::line(first.number, what))?;
        let columns = columns(&names, first.number, &options.mappings)?;
        let line = first.number;
        lines.back(&first);
        return Ok(Head { delimiter, columns, line });
    }
    Ok(Head { delimiter, columns: columns(&headers, first.number, &options.mappings)?, line: first.number })
}

/// The cells of a header.
fn headers(text: &[u8], delimiter: Delimiter, line: u64) -> Result<Vec<String>, LogError> {
    let mut cells = Cells::new(delimiter);
    cells.divide(text, line)?;
    (0..cells.len())
        .map(|place| {
            let cell = cells.get(place);
            let utf8 = std::str::from_utf8(cell).map(Into::into);
            utf8.map_err(|_| {
                LogError::cell(line, place, "", format!("{} is not UTF-8: save the file as UTF-8", quoted(cell)), "")
            })
        })
        .collect()
}
