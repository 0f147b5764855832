//! What trackers say of their own readings.

use super::lines::Numbers;
use crate::record::log::error::quoted;
use crate::record::log::header::plain;

/// Words of trackers, small.
const GOOD: [&str; 9] = ["ok", "good", "valid", "tracked", "visible", "enabled", "true", "yes", "online"];
const BAD: [&str; 24] = [
    "bad",
    "missing",
    "lost",
    "invalid",
    "false",
    "no",
    "disabled",
    "offline",
    "occluded",
    "outofvolume",
    "partiallyoutofvolume",
    "toofewmarkers",
    "interference",
    "badfit",
    "databufferlimit",
    "algorithmlimit",
    "fellbehind",
    "outofsynch",
    "processingerror",
    "toolmissing",
    "trackingnotenabled",
    "toolunplugged",
    "notavailable",
    "error",
];

/// Whether a reading of this quality is dropped.
pub fn is_bad(cell: &[u8], numbers: &mut Numbers, least: Option<f64>, line: u64) -> Result<bool, String> {
    if let Ok(value) = numbers.read(cell, line) {
        return Ok(!(value > 0.0 && least.is_none_or(|least| value >= least)));
    }
    let word = plain(&String::from_utf8_lossy(cell));
    match (GOOD.contains(&word.as_str()), BAD.contains(&word.as_str())) {
        (true, _) => Ok(false),
        (_, true) => Ok(true),
        _ => Err(format!("{} says nothing about the quality", quoted(cell))),
    }
}
