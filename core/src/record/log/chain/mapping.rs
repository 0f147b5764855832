//! What a person says of the columns of a log with several trackers.

use super::names::digits;
use crate::record::log::error::LogError;
use crate::record::log::header::{Mapping, with_unit};

/// A column that a person says what it is, and of which disk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChainMapping {
    /// The disk, from 0; none for what all share, and what the column's place says.
    pub disk: Option<usize>,
    /// Whether the column tells the disk of each row.
    pub tells_disk: bool,
    /// What it is.
    pub mapping: Mapping,
}

impl ChainMapping {
    /// Reads `x_2=column`, `x_2 [mm]=column`, `time=column`, `disk=column` and `unused=column`, for so many segments.
    ///
    /// # Errors
    /// When it is not of that form, or there is no such name, unit or disk.
    pub fn parse(text: &str, segments: usize) -> Result<Self, LogError> {
        let (key, column) = text.split_once('=').unwrap_or((text, ""));
        if key.trim() == "disk" && !column.trim().is_empty() {
            let mapping = Mapping { role: None, unit: None, column: column.trim().into() };
            return Ok(Self { disk: None, tells_disk: true, mapping });
        }
        let (name, unit) = with_unit(key.trim());
        let Some((rest, number)) = numbered(name) else {
            return Ok(Self { disk: None, tells_disk: false, mapping: Mapping::parse(text)? });
        };
        if number == 0 || number > segments {
            let allowed = format!("1 to {segments}");
            return Err(LogError { allowed, ..LogError::file(format!("{name} is of disk {number}")) });
        }
        let unit = unit.map_or_else(String::new, |unit| format!(" [{unit}]"));
        let mapping = Mapping::parse(&format!("{rest}{unit}={column}"))?;
        Ok(Self { disk: Some(number - 1), tells_disk: false, mapping })
    }
}

/// A key and the number of its disk: `x_2`, `q1_2`; `tau_1` and `q1` have none.
fn numbered(name: &str) -> Option<(&str, usize)> {
    let (start, end) = digits(name).first().copied().filter(|(_, end)| *end == name.len())?;
    let number = name[start..end].parse().ok()?;
    let rest = name[..start].trim_end_matches('_');
    Mapping::parse(&format!("{rest}=#1")).ok()?;
    Some((rest, number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mappings_name_disks() {
        let of = |text: &str| {
            let ChainMapping { disk, mapping, .. } = ChainMapping::parse(text, 3).expect(text);
            format!("{:?} {mapping}", disk.map(|disk| disk + 1))
        };
        assert_eq!(of("x_2 [mm]=Tx"), "Some(2) x [mm]=Tx");
        assert_eq!(of("theta_l_3=#7"), "Some(3) theta_l=#7");
        assert_eq!(of("q1_2=a"), "Some(2) q1=a");
        assert_eq!(of("q1=a"), "None q1=a");
        assert_eq!(of("time=a"), "None time=a");
        assert_eq!(of("unused=a"), "None unused=a");
        for (text, part) in [("x_4=a", "disk 4"), ("u_1=a", "u_1"), ("x_1", "name=column")] {
            let refused = ChainMapping::parse(text, 3).expect_err(text).to_string();
            assert!(refused.contains(part), "{refused:?} lacks {part:?}");
        }
    }
}
