//! NDI tool tracking: one group of columns for each tool, each followed by its markers, of which a row says how many there are.

use super::head::{Head, headers};
use super::lines::{Cells, Delimiter, Lines};
use super::row::{Row, Slot};
use crate::record::log::Options;
use crate::record::log::error::{LogError, quoted};
use crate::record::log::header::{Column, Role, plain};
use crate::record::log::units::{Dimension, Unit};

/// Where the columns of one tool are in a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Groups {
    /// Where the first tool's group begins.
    start: usize,
    /// Columns of a group, without markers.
    width: usize,
    /// Place of the number of markers within a group.
    markers: Option<usize>,
    /// Columns of each marker.
    marker_width: usize,
    /// Which tool, from 0.
    tool: usize,
    /// Places within a group of whole seconds and nanoseconds, and of the frame's number.
    seconds: Option<(usize, usize)>,
    frame: Option<usize>,
    headers: Vec<String>,
}

/// Status, x, y, z.
const MARKER: usize = 4;

/// Whether a header begins a tool's group.
fn begins(name: &str) -> bool {
    name == "toolinfo" || name.strip_prefix("port").is_some_and(|rest| rest.parse::<u16>().is_ok())
}

/// Whether a file begins as NDI's do.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let first = start.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii).find(|line| !line.is_empty());
    let names: Vec<String> = first
        .unwrap_or_default()
        .split(|byte| *byte == b',')
        .take(64)
        .map(|cell| plain(&String::from_utf8_lossy(cell)))
        .collect();
    let has = |name: &str| names.iter().any(|other| other == name);
    names.iter().any(|name| begins(name)) && has("q0") && has("qx") && has("tx")
}

/// The tools of a file by its first row: the cells with which each one's group begins.
///
/// # Errors
/// When it has no header, or the row cannot be divided.
pub fn tools(bytes: &[u8]) -> Result<Vec<String>, LogError> {
    /// A header and a row are shorter.
    const LONGEST: usize = 1 << 20;
    let mut lines = Lines::new(bytes[..bytes.len().min(LONGEST)].to_vec())?;
    let head = head(&mut lines, &Options { tool: Some("1".into()), ..Options::default() })?;
    let (Some(groups), Some(first)) = (head.groups, lines.next_row()) else { return Ok(Vec::new()) };
    let mut cells = Cells::new(head.delimiter);
    cells.divide(lines.text(&first), first.number)?;
    Ok(groups.names(&cells, first.number)?.iter().map(|told| told.join(" ")).collect())
}

/// Reads the header, and which tool it is.
pub(super) fn head(lines: &mut Lines, options: &Options) -> Result<Head, LogError> {
    // The header may begin with a #.
    let line = loop {
        let line = lines.next_line().ok_or_else(|| LogError::file("holds no header"))?;
        if !lines.text(&line).trim_ascii().is_empty() {
            break line;
        }
    };
    let delimiter = Delimiter::of(lines.text(&line));
    let headers = headers(lines.text(&line), delimiter, line.number)?;
    let names: Vec<String> = headers.iter().map(|header| plain(header)).collect();
    let start = names.iter().position(|name| begins(name)).ok_or_else(|| {
        LogError::line(line.number, "has no column ToolInfo or Port 1, with which a tool's columns begin")
    })?;
    let group = &names[start..];
    let next = group.iter().skip(1).position(|name| begins(name)).map_or(group.len(), |place| place + 1);
    let group = &group[..next];
    let find = |wanted: &[&str]| group.iter().position(|name| wanted.contains(&name.as_str()));
    let markers = find(&["markers"]);
    let mut columns: Vec<Column> = (0..markers.map_or(group.len(), |place| place + 1))
        .map(|place| Column::unused(place, &headers[start + place]))
        .collect();
    for (role, unit, wanted) in [
        (Role::Qw, "1", &["q0"][..]),
        (Role::Qx, "1", &["qx"]),
        (Role::Qy, "1", &["qy"]),
        (Role::Qz, "1", &["qz"]),
        (Role::X, "mm", &["tx"]),
        (Role::Y, "mm", &["ty"]),
        (Role::Z, "mm", &["tz"]),
        (Role::Quality, "1", &["transformstatus", "status", "state"]),
        (Role::Time, "s", &["timespecs", "time", "timestamp", "frame"]),
    ] {
        // The first of the names that there is; markers have names of their own behind.
        let place = wanted.iter().find_map(|name| find(&[*name])).filter(|place| *place < columns.len());
        if let Some(place) = place {
            columns[place] = Column::fixed(place, &headers[start + place], role, unit);
        }
    }
    let seconds = find(&["timespecs"]).zip(find(&["timespecns"]));
    let mut groups = Groups {
        start,
        width: columns.len(),
        markers,
        marker_width: MARKER,
        tool: 0,
        seconds,
        frame: find(&["frame"]).filter(|_| find(&["timespecs", "time", "timestamp"]).is_none()),
        headers,
    };
    if let Some(first) = lines.next_row() {
        let mut cells = Cells::new(delimiter);
        cells.divide(lines.text(&first), first.number)?;
        groups.tool = groups.choose(&cells, options.tool.as_deref(), first.number)?;
        lines.back(&first);
    }
    Ok(Head { delimiter, columns, line: line.number, groups: Some(groups) })
}

impl Groups {
    /// What names each tool of a row: the cells with which its group begins.
    fn names(&self, cells: &Cells, line: u64) -> Result<Vec<Vec<String>>, LogError> {
        let mut names = Vec::new();
        let mut at = self.start;
        while at + self.width <= cells.count() {
            let told: Vec<String> = (at..at + 3.min(self.width))
                .map(|place| String::from_utf8_lossy(cells.get(place)).into_owned())
                .filter(|name| !name.is_empty())
                .collect();
            names.push(told);
            at = self.after(cells, at, line)?;
        }
        Ok(names)
    }

    /// Which tool is meant; without a name, the only one.
    fn choose(&self, cells: &Cells, wanted: Option<&str>, line: u64) -> Result<usize, LogError> {
        let names = self.names(cells, line)?;
        let listed = || {
            let tools = names.iter().enumerate().map(|(place, told)| format!("{} ({})", place + 1, told.join(" ")));
            tools.collect::<Vec<_>>().join(", ")
        };
        let found = match wanted {
            None if names.len() == 1 => return Ok(0),
            None if names.is_empty() => return Err(LogError::line(line, "holds no tool")),
            None => {
                let what = format!("holds {} tools: {}", names.len(), listed());
                return Err(LogError::line(line, what).or(": choose one with --tool"));
            }
            Some(wanted) => {
                let numbered = wanted
                    .parse::<usize>()
                    .ok()
                    .and_then(|number| number.checked_sub(1))
                    .filter(|place| *place < names.len());
                numbered.or_else(|| names.iter().position(|told| told.iter().any(|name| name.contains(wanted))))
            }
        };
        found.ok_or_else(|| LogError {
            allowed: listed(),
            ..LogError::line(line, format!("there is no tool {}", quoted(wanted.unwrap_or_default().as_bytes())))
        })
    }

    /// Where the group behind the one at `at` begins.
    fn after(&self, cells: &Cells, at: usize, line: u64) -> Result<usize, LogError> {
        let Some(place) = self.markers.map(|markers| at + markers) else { return Ok(at + self.width) };
        let cell = cells.get(place);
        let count = match std::str::from_utf8(cell).map(str::parse::<usize>) {
            _ if cell.is_empty() => 0,
            Ok(Ok(count)) if count <= cells.count() => count,
            _ => {
                let name = self.headers.get(place).map_or("Markers", String::as_str);
                return Err(LogError::cell(
                    line,
                    place,
                    name,
                    format!("{} is no number of markers", quoted(cell)),
                    "a whole number",
                ));
            }
        };
        Ok(at + self.width + count * self.marker_width)
    }

    /// Moves to the tool's columns in a row; in a row without them all its cells are empty.
    pub(super) fn select(&self, cells: &mut Cells, line: u64) -> Result<(), LogError> {
        let mut at = self.start;
        for _ in 0..self.tool {
            at = self.after(cells, at, line)?;
        }
        if at + self.width > cells.count() {
            let what = format!("has {} cells, too few for tool {}", cells.count(), self.tool + 1);
            return Err(LogError::line(line, what));
        }
        cells.skip(at);
        Ok(())
    }

    /// Says how a row's time is read: seconds and nanoseconds, or the frame's number at `rate` (Hz).
    pub(super) fn time(&self, row: &mut Row, rate: Option<f64>, notes: &mut Vec<String>) -> Result<(), LogError> {
        if let Some((_, nanoseconds)) = self.seconds {
            let unit = Dimension::Time.unit("ns").unwrap_or(Dimension::Time.si());
            row.nanoseconds = Some(Slot { place: nanoseconds, unit, ..row.time.clone() });
        } else if self.frame == Some(row.time.place) {
            let rate = rate.filter(|rate| *rate > 0.0).ok_or_else(|| {
                LogError::file("has frame numbers for times: say how fast the tracker is with tracker.rate")
            })?;
            row.time.unit = Unit::share("frames", rate);
            row.time.most = f64::MAX;
            notes.push(format!(
                "times are the tracker's frame numbers at tracker.rate = {} Hz",
                crate::scenario::text::number(rate)
            ));
        }
        Ok(())
    }
}
