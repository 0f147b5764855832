//! What stands above the rows of a text log, or what its format says of them.

use super::lines::{Cells, Delimiter, Lines, Numbers};
use super::ndi::{self, Groups};
use crate::record::log::error::{LogError, quoted};
use crate::record::log::header::{Column, Role, columns};
use crate::record::log::{Format, Options};

/// What stands above the rows.
#[derive(Debug)]
pub struct Head {
    /// What stands between cells.
    pub delimiter: Delimiter,
    /// The columns; in a file with several tools, those of one tool.
    pub columns: Vec<Column>,
    /// Line of the header, from 1.
    pub line: u64,
    /// Where a tool's columns are.
    pub groups: Option<Groups>,
}

/// Reads what stands above the rows.
///
/// # Errors
/// When it does not say what the columns are.
pub fn read(format: Format, lines: &mut Lines, options: &Options) -> Result<Head, LogError> {
    match format {
        Format::Csv => csv(lines, options),
        Format::Tum => Ok(fixed(Delimiter::Spaces, TUM, "s", TUM.len())),
        Format::Euroc => euroc(lines),
        Format::Ndi => ndi::head(lines, options),
        Format::Mcap => Err(LogError::file("is no text")),
    }
}

/// The columns of a TUM trajectory, and the first ones of EuRoC's.
const TUM: [Role; 8] = [Role::Time, Role::X, Role::Y, Role::Z, Role::Qx, Role::Qy, Role::Qz, Role::Qw];
const EUROC: [Role; 8] = [Role::Time, Role::X, Role::Y, Role::Z, Role::Qw, Role::Qx, Role::Qy, Role::Qz];

/// The first line of a file that says something.
fn first(bytes: &[u8], comments: bool) -> &[u8] {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = start.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    lines.find(|line| !line.is_empty() && (comments || !line.starts_with(b"#"))).unwrap_or_default()
}

/// Whether the first row of a file is eight numbers with spaces between them.
#[must_use]
pub fn looks_like_tum(bytes: &[u8]) -> bool {
    let mut cells = first(bytes, false).split(u8::is_ascii_whitespace).filter(|cell| !cell.is_empty());
    cells.by_ref().take(TUM.len()).filter(|cell| is_number(cell)).count() == TUM.len() && cells.next().is_none()
}

/// Whether a file begins as EuRoC's trajectories do.
#[must_use]
pub fn looks_like_euroc(bytes: &[u8]) -> bool {
    let first = first(bytes, true);
    first.starts_with(b"#timestamp") && first.contains(&b',')
}

/// Whether a cell holds a number.
#[must_use]
pub fn is_number(cell: &[u8]) -> bool {
    Numbers::default().read(cell, 0).is_ok_and(|value| !value.is_nan())
}

/// Columns in an order that the format fixes; what is behind them is not used.
fn fixed(delimiter: Delimiter, roles: [Role; 8], time: &'static str, width: usize) -> Head {
    let unit = |role: Role| if role == Role::Time { time } else { role.dimension().si().name };
    let mut columns: Vec<Column> =
        roles.iter().enumerate().map(|(place, role)| Column::fixed(place, role.key(), *role, unit(*role))).collect();
    columns.extend((roles.len()..width).map(|place| Column::unused(place, &format!("#{}", place + 1))));
    Head { delimiter, columns, line: 1, groups: None }
}

/// A trajectory as EuRoC has it: as many columns as the first row.
fn euroc(lines: &mut Lines) -> Result<Head, LogError> {
    let first = lines.next_row().ok_or_else(|| LogError::file("holds a header alone"))?;
    let mut cells = Cells::new(Delimiter::Byte(b','));
    cells.divide(lines.text(&first), first.number)?;
    let width = cells.count();
    lines.back(&first);
    if width < EUROC.len() {
        return Err(LogError::line(first.number, format!("has {width} cells, and a EuRoC trajectory has at least 8")));
    }
    Ok(fixed(Delimiter::Byte(b','), EUROC, "ns", width))
}

fn csv(lines: &mut Lines, options: &Options) -> Result<Head, LogError> {
    let first = lines.next_row().ok_or_else(|| LogError::file("holds comments alone"))?;
    let text = lines.text(&first);
    let delimiter = Delimiter::of(text);
    let headers = headers(text, delimiter, first.number)?;
    let bare = headers.iter().all(|cell| is_number(cell.as_bytes()));
    if let Some(columns) = options.columns.clone() {
        if bare {
            lines.back(&first);
        }
        return Ok(Head { delimiter, columns, line: first.number, groups: None });
    }
    if bare {
        // Rows without a header: a person says which column is what by its number.
        let named = |place: usize| if options.mappings.is_empty() { None } else { Some(format!("#{}", place + 1)) };
        let names: Option<Vec<String>> = (0..headers.len()).map(named).collect();
        let what = "holds numbers, not the names of columns: add a header as in \"time [s],x [mm],…\", or say which column is \
                    what";
        let names = names.ok_or_else(|| LogError::line(first.number, what).or(" with --map time=#1 and so on"))?;
        let columns = columns(&names, first.number, &options.mappings)?;
        let line = first.number;
        lines.back(&first);
        return Ok(Head { delimiter, columns, line, groups: None });
    }
    let columns = columns(&headers, first.number, &options.mappings)?;
    Ok(Head { delimiter, columns, line: first.number, groups: None })
}

/// The cells of the first lines of a text log that are neither blank nor comments, the header among them: for a person who says
/// what the columns are.
///
/// # Errors
/// When the file is empty or no text.
pub fn preview(bytes: &[u8], rows: usize) -> Result<Vec<Vec<String>>, LogError> {
    /// Lines longer than this are shown in part.
    const LONGEST: usize = 1 << 16;
    let most = bytes.len().min(LONGEST * (rows + 1));
    let mut lines = Lines::new(bytes[..most].to_vec())?;
    let mut cells: Option<Cells> = None;
    let mut shown = Vec::new();
    while let Some(line) = lines.next_row().filter(|_| shown.len() < rows) {
        let text = lines.text(&line);
        let cells = cells.get_or_insert_with(|| {
            Cells::new(if looks_like_tum(text) { Delimiter::Spaces } else { Delimiter::of(text) })
        });
        cells.divide(text, line.number)?;
        shown.push((0..cells.count()).map(|place| String::from_utf8_lossy(cells.get(place)).into_owned()).collect());
    }
    Ok(shown)
}

/// The cells of a header.
pub fn headers(text: &[u8], delimiter: Delimiter, line: u64) -> Result<Vec<String>, LogError> {
    let mut cells = Cells::new(delimiter);
    cells.divide(text, line)?;
    (0..cells.count())
        .map(|place| {
            let cell = cells.get(place);
            let utf8 = std::str::from_utf8(cell).map(Into::into);
            utf8.map_err(|_| {
                LogError::cell(line, place, "", format!("{} is not UTF-8: save the file as UTF-8", quoted(cell)), "")
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_rows_are_shown_as_cells() {
        let shown = |text: &str| preview(text.as_bytes(), 2).expect("text");
        assert_eq!(shown("# rig\nt;x\n\n1,5;2\n3;4\n"), [["t", "x"], ["1,5", "2"]]);
        assert_eq!(shown("0 1 2 3 0 0 0 1\n")[0].len(), 8);
        assert!(preview(b" ", 2).is_err());
    }

    #[test]
    fn formats_are_told_by_name_and_content() {
        for (name, content, format) in [
            ("a.csv", "time,x\n", Format::Csv),
            ("a.txt", "# a\n0 1 2 3 0 0 0 1\n", Format::Tum),
            ("a.tum", "", Format::Tum),
            ("data.csv", "#timestamp [ns], p_x\n", Format::Euroc),
            ("a.csv", "#Tools,ToolInfo,Frame#,Q0,Qx,Tx\n", Format::Ndi),
            ("a.csv", "Tools,Port 1,Frame,Q0,Qx,Tx\n", Format::Ndi),
            ("a", "\u{89}MCAP", Format::Csv),
            ("a.mcap", "", Format::Mcap),
        ] {
            assert_eq!(Format::guess(name, content.as_bytes()), format, "{name} {content}");
        }
    }
}
