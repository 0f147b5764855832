//! The records of an MCAP file, and the chunks that hold them compressed.

use crate::record::log::error::{LogError, quoted};
use std::io::Read;

/// How an MCAP file begins and ends.
pub const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// Operation codes of the records that are read or written.
pub mod op {
    /// Profile and library.
    pub const HEADER: u8 = 0x01;
    /// Where the summary is.
    pub const FOOTER: u8 = 0x02;
    /// A type of messages.
    pub const SCHEMA: u8 = 0x03;
    /// A topic.
    pub const CHANNEL: u8 = 0x04;
    /// A message.
    pub const MESSAGE: u8 = 0x05;
    /// Records, compressed or not.
    pub const CHUNK: u8 = 0x06;
    /// The end of the messages.
    pub const DATA_END: u8 = 0x0f;
}

/// A record: its operation code and where its body is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Record {
    /// Its operation code.
    pub op: u8,
    /// Where its body stands.
    pub body: std::ops::Range<usize>,
}

/// The record that begins at `at`; none where the bytes end within it.
#[must_use]
pub fn record(bytes: &[u8], at: usize) -> Option<Record> {
    let (op, rest) = bytes.get(at..)?.split_first()?;
    let length = u64::from_le_bytes(*rest.first_chunk::<8>()?);
    let start = at + 9;
    let end = start.checked_add(usize::try_from(length).ok()?)?;
    (end <= bytes.len()).then_some(Record { op: *op, body: start..end })
}

/// Reads the fields of a record.
#[derive(Debug)]
pub struct Fields<'a>(pub &'a [u8]);

impl<'a> Fields<'a> {
    /// A whole number of two bytes.
    pub fn u16(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    /// A whole number of four bytes.
    pub fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    /// A whole number of eight bytes.
    pub fn u64(&mut self) -> Option<u64> {
        self.take().map(u64::from_le_bytes)
    }

    /// Bytes behind their number.
    pub fn bytes(&mut self) -> Option<&'a [u8]> {
        let length = self.u32()? as usize;
        let (bytes, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(bytes)
    }

    /// A text.
    pub fn text(&mut self) -> Option<String> {
        Some(String::from_utf8_lossy(self.bytes()?).into_owned())
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*bytes)
    }
}

/// A chunk may be this many times as long as its bytes in the file, or have [`SMALL`] bytes.
const RATIO: usize = 1000;
/// A chunk of this many bytes is never too long.
const SMALL: usize = 1 << 20;

/// The records within a chunk, from the body of its record.
///
/// # Errors
/// When it is broken, compressed in a way that is not known, or unreasonably long.
pub fn chunk(body: &[u8], message: u64) -> Result<Vec<u8>, LogError> {
    let broken = |what: &str| LogError::line(message, format!("a chunk {what}"));
    let mut fields = Fields(body);
    let head = || broken("has no whole head");
    let (_, _) = (fields.u64().ok_or_else(head)?, fields.u64().ok_or_else(head)?);
    let length = fields.u64().ok_or_else(head)?;
    let crc = fields.u32().ok_or_else(head)?;
    let compression = fields.text().ok_or_else(head)?;
    let stored = usize::try_from(fields.u64().ok_or_else(head)?).ok().and_then(|length| fields.0.get(..length));
    let stored = stored.ok_or_else(|| broken("is longer than its record"))?;
    let most = stored.len().saturating_mul(RATIO).max(SMALL);
    let length = usize::try_from(length).ok().filter(|length| *length <= most);
    let length = length.ok_or_else(|| broken("says that it is more than 1000 times as long as its bytes"))?;
    let records = match compression.as_str() {
        "" => stored.to_vec(),
        "zstd" => zstd(stored, length).map_err(|error| broken(&format!("is no zstd: {error}")))?,
        "lz4" => limited(lz4_flex::frame::FrameDecoder::new(stored), length)
            .map_err(|error| broken(&format!("is no lz4: {error}")))?,
        other => {
            return Err(LogError {
                allowed: "none, zstd, lz4".into(),
                ..broken(&format!("is compressed by {}", quoted(other.as_bytes())))
            });
        }
    };
    if records.len() != length {
        return Err(broken(&format!("holds {} bytes and says {length}", records.len())));
    }
    if crc != 0 && crc32fast::hash(&records) != crc {
        return Err(broken("is damaged: its checksum is another"));
    }
    Ok(records)
}

/// All that a reader gives, but at most one byte more than `length`.
fn limited(reader: impl Read, length: usize) -> Result<Vec<u8>, std::io::Error> {
    let mut out = Vec::new();
    reader.take(length as u64 + 1).read_to_end(&mut out)?;
    Ok(out)
}

fn zstd(mut stored: &[u8], length: usize) -> Result<Vec<u8>, String> {
    let mut out = Vec::new();
    while !stored.is_empty() && out.len() <= length {
        let decoder = ruzstd::decoding::StreamingDecoder::new(&mut stored).map_err(|error| error.to_string())?;
        out.extend(limited(decoder, length - out.len()).map_err(|error| error.to_string())?);
    }
    Ok(out)
}
