//! A text file as lines, lines as cells, cells as numbers.

use crate::record::log::error::{LogError, quoted};
use csv_core::{ReadRecordResult, ReaderBuilder, Terminator};
use std::ops::Range;

/// What stands between cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Delimiter {
    /// One character.
    Byte(u8),
    /// Any number of spaces and tabs.
    Spaces,
}

impl Delimiter {
    /// The one that a header is divided by: most of semicolons, tabs and commas, in this order where there are as many.
    #[must_use]
    pub fn of(header: &[u8]) -> Self {
        let count = |delimiter: u8| header.iter().filter(|byte| **byte == delimiter).count();
        // Of equal counts `max_by_key` takes the last.
        Self::Byte(*b",\t;".iter().max_by_key(|delimiter| count(**delimiter)).unwrap_or(&b','))
    }
}

/// One line of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// Its number, from 1.
    pub number: u64,
    /// Where it stands.
    pub range: Range<usize>,
    /// Whether its end is marked: the last line of a file may have been cut.
    pub ended: bool,
}

/// The lines of a file.
#[derive(Debug)]
pub struct Lines {
    bytes: Vec<u8>,
    at: usize,
    number: u64,
    end: u8,
}

impl Lines {
    /// Before the first line, behind a byte order mark.
    ///
    /// # Errors
    /// When the file is empty or no UTF-8.
    pub fn new(bytes: Vec<u8>) -> Result<Self, LogError> {
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            return Err(LogError::file("is UTF-16: save it as UTF-8"));
        }
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        if bytes[at..].iter().all(u8::is_ascii_whitespace) {
            return Err(LogError::file("is empty"));
        }
        let end = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
        Ok(Self { bytes, at, number: 0, end })
    }

    /// The next line, without its end.
    pub fn next_line(&mut self) -> Option<Line> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let found = rest.iter().position(|byte| *byte == self.end);
        let length = found.unwrap_or(rest.len());
        let (start, mut stop) = (self.at, self.at + length);
        self.at = stop + usize::from(found.is_some());
        self.number += 1;
        if rest[..length].ends_with(b"\r") {
            stop -= 1;
        }
        Some(Line { number: self.number, range: start..stop, ended: found.is_some() })
    }

    /// The next line that is neither blank nor a comment.
    pub fn next_row(&mut self) -> Option<Line> {
        loop {
            let line = self.next_line()?;
            let text = self.text(&line).trim_ascii_start();
            if !text.is_empty() && !text.starts_with(b"#") {
                return Some(line);
            }
        }
    }

    /// What stands in a line.
    #[must_use]
    pub fn text(&self, line: &Line) -> &[u8] {
        &self.bytes[line.range.clone()]
    }

    /// Goes back to before a line.
    pub fn back(&mut self, line: &Line) {
        (self.at, self.number) = (line.range.start, line.number - 1);
    }

    /// Bytes read, and bytes in all.
    #[must_use]
    pub fn progress(&self) -> (usize, usize) {
        (self.at, self.bytes.len())
    }
}

/// Divides lines into cells.
#[derive(Debug)]
pub struct Cells {
    delimiter: Delimiter,
    core: csv_core::Reader,
    text: Vec<u8>,
    ends: Vec<usize>,
    ranges: Vec<Range<usize>>,
    /// Cells in front that do not count.
    skipped: usize,
}

impl Cells {
    /// Of lines with this delimiter.
    #[must_use]
    pub fn new(delimiter: Delimiter) -> Self {
        let byte = if let Delimiter::Byte(byte) = delimiter { byte } else { b' ' };
        let core = ReaderBuilder::new().delimiter(byte).terminator(Terminator::Any(b'\n')).build();
        Self { delimiter, core, text: Vec::new(), ends: Vec::new(), ranges: Vec::new(), skipped: 0 }
    }

    /// Divides a line.
    ///
    /// # Errors
    /// When a quote is not closed.
    pub fn divide(&mut self, line: &[u8], number: u64) -> Result<(), LogError> {
        self.ranges.clear();
        self.skipped = 0;
        let Delimiter::Byte(delimiter) = self.delimiter else {
            self.text.clear();
            for cell in line.split(u8::is_ascii_whitespace).filter(|cell| !cell.is_empty()) {
                let start = self.text.len();
                self.text.extend_from_slice(cell);
                self.ranges.push(start..self.text.len());
            }
            return Ok(());
        };
        let most = line.iter().filter(|byte| **byte == delimiter).count() + 2;
        self.text.resize(self.text.len().max(line.len() + 1), 0);
        self.ends.resize(self.ends.len().max(most), 0);
        self.core.reset();
        let (mut input, mut fed, mut written, mut ended) = (line, false, 0, 0);
        loop {
            let (result, read, out, ends) =
                self.core.read_record(input, &mut self.text[written..], &mut self.ends[ended..]);
            (written, ended) = (written + out, ended + ends);
            match result {
                ReadRecordResult::Record => break,
                // There is room for all: the whole line was read.
                ReadRecordResult::InputEmpty if !fed && read == input.len() => (input, fed) = (b"\n", true),
                _ => return Err(LogError::line(number, "a quote is not closed within the line")),
            }
        }
        let mut start = 0;
        for end in self.ends.iter().take(ended) {
            let range = start..*end;
            start = *end;
            self.ranges.push(trimmed(&self.text, range));
        }
        Ok(())
    }

    /// Counts places from this one on.
    pub fn skip(&mut self, cells: usize) {
        self.skipped = cells;
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// The cell in a place, without the space around it; empty where there is none.
    #[must_use]
    #[inline]
    pub fn get(&self, place: usize) -> &[u8] {
        self.ranges.get(self.skipped + place).map_or(&[], |range| &self.text[range.clone()])
    }
}

fn trimmed(text: &[u8], range: Range<usize>) -> Range<usize> {
    let cell = &text[range.clone()];
    let front = cell.len() - cell.trim_ascii_start().len();
    let start = range.start + front;
    start..start + cell.trim_ascii().len()
}

/// Reads numbers, all with the same decimal mark.
#[derive(Debug, Clone, Copy, Default)]
pub struct Numbers {
    /// The mark, and the line in which it was first seen.
    mark: Option<(u8, u64)>,
}

impl Numbers {
    /// The number in a cell; NaN for one that is empty or says that there is none.
    ///
    /// # Errors
    /// What is wrong with it.
    #[inline]
    pub fn read(&mut self, cell: &[u8], line: u64) -> Result<f64, String> {
        let Ok(text) = std::str::from_utf8(cell) else {
            return Err(format!("{} is not UTF-8, so no number", quoted(cell)));
        };
        if let Ok(value) = text.parse::<f64>() {
            if value.is_infinite() {
                return Err(format!("{} is not finite", quoted(cell)));
            }
            if self.mark.is_none_or(|(mark, _)| mark != b'.') && cell.contains(&b'.') {
                self.see(b'.', cell, line)?;
            }
            return Ok(value);
        }
        self.unusual(text, line)
    }

    #[cold]
    fn unusual(&mut self, text: &str, line: u64) -> Result<f64, String> {
        const NONE: [&str; 9] = ["", "na", "n/a", "#n/a", "null", "none", "-", "--", "?"];
        let cell = text.as_bytes();
        if NONE.contains(&text.to_ascii_lowercase().as_str()) {
            return Ok(f64::NAN);
        }
        let one_comma = cell.iter().filter(|byte| **byte == b',').count() == 1 && !cell.contains(&b'.');
        match text.replacen(',', ".", 1).parse::<f64>() {
            Ok(value) if one_comma && value.is_finite() => {
                self.see(b',', cell, line)?;
                Ok(value)
            }
            _ => Err(format!("{} is no number", quoted(cell))),
        }
    }

    fn see(&mut self, mark: u8, cell: &[u8], line: u64) -> Result<(), String> {
        let name = |mark| if mark == b',' { "a decimal comma" } else { "a decimal point" };
        match self.mark {
            Some((other, first)) if other != mark => {
                Err(format!("{} has {}, and line {first} has {}", quoted(cell), name(mark), name(other)))
            }
            _ => {
                self.mark = Some((mark, line));
                Ok(())
            }
        }
    }

    /// Whether the file has decimal commas.
    #[must_use]
    pub fn has_commas(&self) -> bool {
        matches!(self.mark, Some((b',', _)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(delimiter: Delimiter, line: &str) -> Vec<String> {
        let mut cells = Cells::new(delimiter);
        cells.divide(line.as_bytes(), 1).expect("divided");
        (0..cells.count()).map(|place| String::from_utf8_lossy(cells.get(place)).into_owned()).collect()
    }

    #[test]
    fn lines_are_divided_into_cells() {
        assert_eq!(cells(Delimiter::Byte(b','), "1, 2,\"a,b\",,"), ["1", "2", "a,b", "", ""]);
        assert_eq!(cells(Delimiter::Byte(b';'), "1,5; 2"), ["1,5", "2"]);
        assert_eq!(cells(Delimiter::Spaces, "  1 \t 2  3 "), ["1", "2", "3"]);
        assert!(
            Cells::new(Delimiter::Byte(b',')).divide(b"1,\"2", 7).expect_err("open").to_string().contains("line 7")
        );
    }

    #[test]
    fn lines_keep_their_numbers() {
        let mut lines = Lines::new(b"\xef\xbb\xbfa\r\n\r\n# no\r\nb".to_vec()).expect("text");
        let (first, second) = (lines.next_row().expect("a"), lines.next_row().expect("b"));
        assert_eq!((first.number, lines.text(&first), first.ended), (1, &b"a"[..], true));
        assert_eq!((second.number, lines.text(&second), second.ended), (4, &b"b"[..], false));
        assert_eq!(lines.next_row(), None);
    }

    #[test]
    fn a_file_has_one_decimal_mark() {
        let mut numbers = Numbers::default();
        assert_eq!(numbers.read(b"3", 1), Ok(3.0));
        assert_eq!(numbers.read(b"1,5", 2), Ok(1.5));
        assert!(numbers.read(b"1.5", 9).expect_err("mixed").contains("line 2"));
        for (cell, part) in
            [(&b"1,2,3"[..], "no number"), (b"1.2,3", "no number"), (b"inf", "finite"), (b"\xff", "UTF-8")]
        {
            assert!(Numbers::default().read(cell, 1).expect_err("refused").contains(part), "{cell:?}");
        }
        assert!(["", "NaN", "n/a"].iter().all(|cell| numbers.read(cell.as_bytes(), 1).is_ok_and(f64::is_nan)));
    }
}
