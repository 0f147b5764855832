//! A file with one or several trackers as a log for each disk, all read by the readers of one tracker.

use super::columns::{self, of_disk};
use super::{ChainMapping, ChainOptions, Expected, rows};
use crate::record::log::error::{LogError, quoted};
use crate::record::log::text::head::{self, is_number};
use crate::record::log::text::lines::{Delimiter, Lines};
use crate::record::log::text::ndi;
use crate::record::log::{Column, Format, Log, Options};

/// What a file tells.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// How it is written.
    pub format: Format,
    /// Disks (from 0) of which it tells, with their logs; no disk twice.
    pub logs: Vec<(usize, Log)>,
    /// Rows or messages that were read.
    pub rows: u64,
    /// What a person should know.
    pub notes: Vec<String>,
    /// Whether joints could be numbered the other way round.
    pub joints_either_way: bool,
}

/// Reads a whole file called `name`.
///
/// # Errors
/// Where it is refused, and why, with the disk.
pub fn read(name: &str, bytes: Vec<u8>, of: &Expected, options: &ChainOptions) -> Result<Read, LogError> {
    let format = options.shared.format.unwrap_or_else(|| Format::guess(name, &bytes));
    let shared = Options { format: Some(format), ..options.shared.clone() };
    match format {
        Format::Csv => csv(name, bytes, of, (options, &shared)),
        Format::Ndi => tools(name, bytes, of, (options, &shared)),
        Format::Mcap => super::topics::read(name, bytes, of, (options, &shared)),
        Format::Tum | Format::Euroc => {
            let disk = of.only().ok_or_else(|| {
                let what = format!("holds one tracker, and {} end disks carry one", of.segments);
                LogError::file(what).or(": give a file for each of them, in order from the base")
            })?;
            let log = Log::read(name, bytes, &shared)?;
            let rows = log.report.rows;
            Ok(Read { format, logs: vec![(disk, log)], rows, notes: Vec::new(), joints_either_way: false })
        }
    }
}

/// The header of a CSV file, or numbers in its place where it has none.
struct Header {
    headers: Vec<String>,
    line: u64,
    delimiter: Delimiter,
    bare: bool,
}

impl Header {
    fn of(bytes: &[u8], options: &ChainOptions) -> Result<Self, LogError> {
        /// A header is shorter.
        const LONGEST: usize = 1 << 20;
        let mut lines = Lines::new(bytes[..bytes.len().min(LONGEST)].to_vec())?;
        let first = lines.next_row().ok_or_else(|| LogError::file("holds comments alone"))?;
        let delimiter = Delimiter::of(lines.text(&first));
        let mut headers = head::headers(lines.text(&first), delimiter, first.number)?;
        let bare = headers.iter().all(|cell| is_number(cell.as_bytes()));
        if bare && options.mappings.is_empty() {
            let what = "holds numbers, not the names of columns: add a header as in \"time [s],x_1 [mm],…\", or say which \
                        column is what";
            return Err(LogError::line(first.number, what).or(" with --map time=#1, --map x_1=#2 and so on"));
        }
        if bare {
            headers = (1..=headers.len()).map(|number| format!("#{number}")).collect();
        }
        Ok(Self { headers, line: first.number, delimiter, bare })
    }

    /// The column (from 0) that tells the disk of each row; none where the names of others do.
    fn disk(&self, of: &Expected, options: &ChainOptions) -> Option<usize> {
        let Self { headers, line, .. } = self;
        let mapped = options.mappings.iter().find(|said| said.tells_disk);
        if let Some(said) = mapped {
            return headers.iter().enumerate().position(|(place, header)| said.mapping.is_of(place, header));
        }
        let unused = |place: &usize| {
            let is_of = |said: &&ChainMapping| said.mapping.is_of(*place, &headers[*place]);
            options.mappings.iter().find(is_of).is_some_and(|said| said.mapping.role.is_none())
        };
        let found = rows::column(headers).filter(|place| of.disk.is_none() && !self.bare && !unused(place));
        found.filter(|_| !columns::names_disks(headers, *line, &options.mappings, of.segments))
    }
}

fn csv(
    name: &str,
    bytes: Vec<u8>,
    of: &Expected,
    (options, shared): (&ChainOptions, &Options),
) -> Result<Read, LogError> {
    let header = Header::of(&bytes, options)?;
    let Header { headers, line, delimiter, bare } = &header;
    let column = header.disk(of, options);
    let columns = columns::divide(headers, *line, (&options.mappings, of), column.is_some())?;
    let decided = |disk: usize| columns.disks.iter().find(|(own, _)| *own == disk).map(|(_, columns)| columns.clone());
    let (mut logs, mut rows, mut notes) = (Vec::new(), 0, Vec::new());
    if let Some(place) = column {
        let divided = rows::divide(&bytes, (place, &headers[place]), (*delimiter, *bare), of)?;
        drop(bytes);
        notes = divided.notes;
        for (disk, bytes) in divided.files {
            let Some(columns) = decided(disk) else { continue };
            let log = one(name, bytes, shared, (disk, columns))?;
            rows += log.report.rows;
            logs.push((disk, log));
        }
        logs.sort_by_key(|(disk, _)| *disk);
    } else {
        for (disk, columns) in &columns.disks {
            let log = one(name, bytes.clone(), shared, (*disk, columns.clone()))?;
            rows = log.report.rows;
            logs.push((*disk, log));
        }
    }
    Ok(Read { format: Format::Csv, logs, rows, notes, joints_either_way: columns.joints_either_way })
}

fn one(name: &str, bytes: Vec<u8>, shared: &Options, (disk, columns): (usize, Vec<Column>)) -> Result<Log, LogError> {
    let options = Options { columns: Some(columns), mappings: Vec::new(), ..shared.clone() };
    Log::read(name, bytes, &options).map_err(|error| of_disk(error, disk))
}

/// Several tools of an NDI file, in its order or as they are named.
fn tools(
    name: &str,
    bytes: Vec<u8>,
    of: &Expected,
    (options, shared): (&ChainOptions, &Options),
) -> Result<Read, LogError> {
    let there = ndi::tools(&bytes)?;
    let listed = || {
        let each = there.iter().enumerate().map(|(place, tool)| format!("{} ({tool})", place + 1));
        each.collect::<Vec<_>>().join(", ")
    };
    let disks: Vec<usize> = of.trackers().collect();
    let mut notes = Vec::new();
    let wanted: Vec<String> = if options.tools.is_empty() {
        if there.len() != disks.len() {
            let (tools, count) = (there.len(), told(disks.len()));
            let what = format!("holds {tools} tools: {}; {count}", listed());
            return Err(LogError::file(what).or(": name them in order from the base, each with --tool"));
        }
        if disks.len() > 1 {
            notes.push(format!("tools are taken in their order for the disks from the base: {}", listed()));
        }
        (1..=there.len()).map(|number| number.to_string()).collect()
    } else {
        options.tools.clone()
    };
    if wanted.len() != disks.len() {
        let names: Vec<String> = wanted.iter().map(|name| quoted(name.as_bytes())).collect();
        let what = format!("tools {} are named, and {}", names.join(", "), told(disks.len()));
        return Err(LogError { allowed: listed(), ..LogError::file(what) });
    }
    let mut logs = Vec::new();
    let mut rows = 0;
    for (disk, tool) in disks.into_iter().zip(wanted) {
        let options = Options { tool: Some(tool), ..shared.clone() };
        let log = Log::read(name, bytes.clone(), &options).map_err(|error| of_disk(error, disk))?;
        rows = log.report.rows;
        logs.push((disk, log));
    }
    Ok(Read { format: Format::Ndi, logs, rows, notes, joints_either_way: false })
}

/// How many trackers there are to be.
pub(super) fn told(trackers: usize) -> String {
    match trackers {
        1 => "one end disk is read from it".into(),
        more => format!("{more} end disks carry trackers"),
    }
}
