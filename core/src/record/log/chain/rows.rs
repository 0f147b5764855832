//! The long form: a row for each time and disk, with a column that tells the disk.

use super::Expected;
use super::names::{digits, first_number, word};
use crate::record::log::error::{LogError, quoted};
use crate::record::log::header::{plain, with_unit};
use crate::record::log::text::lines::{Cells, Delimiter, Lines};
use std::collections::BTreeMap;
use std::ops::Range;

/// What a column that tells the disk is called, letters alone; the first of these that there is.
const NAMES: [&str; 20] = [
    "disk",
    "disc",
    "diskid",
    "enddisk",
    "segment",
    "segmentid",
    "tool",
    "toolid",
    "toolname",
    "tracker",
    "trackerid",
    "sensor",
    "sensorid",
    "marker",
    "markerid",
    "body",
    "link",
    "childframeid",
    "id",
    "name",
];

/// The column of a header that tells the disk, from 0.
pub fn column(headers: &[String]) -> Option<usize> {
    let names: Vec<String> = headers.iter().map(|header| plain(with_unit(header).0)).collect();
    NAMES.iter().find_map(|wanted| names.iter().position(|name| name == wanted))
}

/// A file's rows by disk: each disk's as a file of its own, the others' lines left blank, so that lines keep their numbers.
#[derive(Debug)]
pub struct Divided {
    /// Disk (from 0) and file.
    pub files: Vec<(usize, Vec<u8>)>,
    /// What a person should know.
    pub notes: Vec<String>,
}

/// What the rows of one disk are called, and where it stands first.
struct Label {
    text: Vec<u8>,
    line: u64,
}

/// Divides the rows by the cells in a place (from 0).
///
/// # Errors
/// When a cell tells no disk, or one that there is not.
pub fn divide(
    bytes: &[u8],
    (place, header): (usize, &str),
    (delimiter, bare): (Delimiter, bool),
    of: &Expected,
) -> Result<Divided, LogError> {
    let mut lines = Lines::new(bytes.to_vec())?;
    let mut cells = Cells::new(delimiter);
    let mut labels: Vec<Label> = Vec::new();
    let mut known: BTreeMap<Vec<u8>, usize> = BTreeMap::new();
    let mut rows: Vec<(Range<usize>, Option<usize>, bool)> = Vec::new();
    let mut headed = bare;
    while let Some(line) = lines.next_line() {
        let text = lines.text(&line);
        let start = text.trim_ascii_start();
        if start.is_empty() || start.starts_with(b"#") {
            rows.push((line.range.start..line.range.start, None, true));
            continue;
        }
        if !std::mem::replace(&mut headed, true) {
            rows.push((line.range.clone(), None, true));
            continue;
        }
        let label = match cells.divide(text, line.number) {
            Err(_) if !line.ended => 0,
            Err(error) => return Err(error),
            Ok(()) if !line.ended && cells.get(place).is_empty() => 0,
            Ok(()) => *known.entry(cells.get(place).to_vec()).or_insert_with_key(|text| {
                labels.push(Label { text: text.clone(), line: line.number });
                labels.len() - 1
            }),
        };
        rows.push((line.range.clone(), Some(label), line.ended));
    }
    let (disks, notes) = disks(&labels, (place, header), of)?;
    let mut files: Vec<(usize, Vec<u8>)> = Vec::new();
    // Two labels may be one disk, as 1 and 1.0 are.
    for disk in (0..of.segments).filter(|disk| disks.contains(&Some(*disk))) {
        let mut file = Vec::new();
        for (range, of, ended) in &rows {
            if of.is_none_or(|label| disks[label] == Some(disk)) {
                file.extend_from_slice(&bytes[range.clone()]);
            }
            if *ended {
                file.push(b'\n');
            }
        }
        files.push((disk, file));
    }
    Ok(Divided { files, notes })
}

/// Of which disk each label is; none of the base's.
fn disks(
    labels: &[Label],
    (place, header): (usize, &str),
    of: &Expected,
) -> Result<(Vec<Option<usize>>, Vec<String>), LogError> {
    let refuse = |label: &Label, what: &str| {
        let allowed = format!("1 to {0}, from the base; or names of {0} disks in that order", of.segments);
        LogError::cell(label.line, place, header, format!("{} {what}", quoted(&label.text)), allowed)
    };
    if let Some(label) = labels.iter().find(|label| label.text.is_empty()) {
        return Err(refuse(label, "tells no disk"));
    }
    let words: Vec<String> =
        labels.iter().map(|label| String::from_utf8_lossy(&label.text).trim().to_lowercase()).collect();
    if let Some(disks) = words.iter().map(|text| word(text, of.segments)).collect::<Option<Vec<_>>>() {
        return Ok((disks.into_iter().map(Some).collect(), Vec::new()));
    }
    if let Some(numbers) = words.iter().map(|text| number(text)).collect::<Option<Vec<u64>>>() {
        let first = first_number(numbers.iter().copied(), of.segments);
        let mut notes = Vec::new();
        let each = labels.iter().zip(&numbers).map(|(label, number)| match number.checked_sub(first) {
            None => {
                notes.push(format!("rows of {header} {number}, the base, are not used"));
                Ok(None)
            }
            Some(disk) if disk < of.segments as u64 => Ok(Some(disk as usize)),
            Some(_) => Err(refuse(label, &format!("is no disk: the scenario has {} segments", of.segments))),
        });
        return Ok((each.collect::<Result<_, _>>()?, notes));
    }
    if labels.len() != of.trackers().len() {
        let last = labels.get(of.trackers().len()).or(labels.last());
        let what = format!("is one of {} names, and {} end disks carry trackers", labels.len(), of.trackers().len());
        return Err(last.map_or_else(|| LogError::file("holds a header alone"), |label| refuse(label, &what)));
    }
    let names: Vec<String> = labels.iter().map(|label| quoted(&label.text)).collect();
    let note = format!("disks are taken in the order in which they appear, from the base: {}", names.join(", "));
    Ok((of.trackers().map(Some).collect(), vec![note]))
}

/// The number of a label: `2`, `2.0`, `disk 2`.
fn number(text: &str) -> Option<u64> {
    if let Ok(number) = text.parse::<f64>() {
        return ((0.0..1e6).contains(&number) && number.fract() == 0.0).then_some(number as u64);
    }
    match digits(text).as_slice() {
        &[(start, end)] => text[start..end].parse().ok(),
        _ => None,
    }
}
