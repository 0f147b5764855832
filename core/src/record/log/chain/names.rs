//! Of which disk a column tells, by its name: `x_2`, `disk2.x`, `theta_l2`, `q2_1`.

use crate::record::log::Role;
use crate::record::log::error::LogError;
use crate::record::log::header::{looks_like, plain, with_unit};
use std::collections::BTreeSet;

/// Words that a disk's number stands behind, and that tell nothing else.
const WORDS: [&str; 14] = [
    "disk", "disc", "enddisk", "segment", "seg", "section", "tool", "tracker", "sensor", "marker", "body", "link",
    "tip", "end",
];
/// The same of one letter, where it is all that stands before the number.
const LETTERS: [&str; 3] = ["d", "s", "m"];
const SEPARATORS: &[char] = &['_', '.', '-', '/', ':', ' '];

/// A column by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Named {
    /// The disk, from 0; none where the name tells none.
    pub disk: Option<usize>,
    /// The header without it.
    pub rest: String,
}

/// Of every column of a header, for so many segments; and whether joints could be numbered the other way round.
///
/// # Errors
/// When a column tells of a disk that there is not.
pub fn named(headers: &[String], line: u64, segments: usize) -> Result<(Vec<Named>, bool), LogError> {
    let pairs: Vec<Option<[u64; 2]>> = headers.iter().map(|header| pair(with_unit(header).0)).collect();
    let order = Order::of(pairs.iter().flatten(), segments);
    let split = headers.iter().zip(&pairs).map(|(header, pair)| {
        let (name, unit) = with_unit(header);
        let (number, rest) = match (order, pair) {
            (Some(Order::DiskFirst | Order::Either), Some([disk, joint])) => (Number::Of(*disk), format!("q{joint}")),
            (Some(Order::DiskLast), Some([joint, disk])) => (Number::Of(*disk), format!("q{joint}")),
            _ => numbered(name, segments),
        };
        let rest = unit.map_or_else(|| rest.clone(), |unit| format!("{rest} [{unit}]"));
        (number, rest)
    });
    let split: Vec<(Number, String)> = split.collect();
    let counted = |(number, rest): &(Number, String)| match number {
        Number::Of(number) if told(rest) && !shared(rest) => Some(*number),
        _ => None,
    };
    let first = first_number(split.iter().filter_map(counted), segments);
    let each = headers.iter().zip(split).enumerate().map(|(place, (header, (number, rest)))| {
        let disk = match number {
            Number::None => None,
            Number::Place(place) => Some(place),
            Number::Of(_) if !told(&rest) => return Ok(Named { disk: None, rest: header.clone() }),
            // Below the first disk there is the base.
            Number::Of(number) if number < first => return Ok(Named { disk: None, rest: String::new() }),
            Number::Of(number) => match usize::try_from(number - first) {
                Ok(disk) if disk < segments => Some(disk),
                _ => return Err(unknown(header, (line, place), number, segments)),
            },
        };
        Ok(Named { disk, rest: if disk.is_some() { rest } else { header.clone() } })
    });
    Ok((each.collect::<Result<_, _>>()?, order == Some(Order::Either)))
}

/// Whether a column of this name tells of one disk alone.
fn told(rest: &str) -> bool {
    looks_like(with_unit(rest).0).is_some_and(|role| !matches!(role, Role::Tau1 | Role::Tau2 | Role::Tau3))
}

/// Whether one column of this name is enough for all disks.
fn shared(rest: &str) -> bool {
    matches!(looks_like(with_unit(rest).0), Some(Role::Time | Role::Quality))
}

fn unknown(header: &str, (line, place): (u64, usize), number: u64, segments: usize) -> LogError {
    let what = format!("tells of disk {number}, and the scenario has {segments} segments");
    LogError::cell(line, place, header, what, format!("disks 1 to {segments}, or 0 to {}", segments - 1))
}

/// The number of the first disk: 1; 0 where disks are counted from 0.
pub fn first_number(numbers: impl Iterator<Item = u64>, segments: usize) -> u64 {
    let numbers: BTreeSet<u64> = numbers.collect();
    // With as many numbers above 0 as there are segments, 0 is the base.
    u64::from(!numbers.contains(&0) || numbers.contains(&(segments as u64)))
}

/// What a name tells of the disk.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Number {
    None,
    /// As it is written.
    Of(u64),
    /// From 0.
    Place(usize),
}

/// A name's number of a disk, and the rest of the name.
fn numbered(name: &str, segments: usize) -> (Number, String) {
    if let Some((number, rest)) = behind_a_word(name).or_else(|| bare(name)) {
        return (Number::Of(number), rest);
    }
    match by_word(name, segments) {
        Some((place, rest)) => (Number::Place(place), rest),
        None => (Number::None, name.into()),
    }
}

/// Where digits stand in a name, the last first.
pub fn digits(name: &str) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (at, _) in name.char_indices().filter(|(_, c)| c.is_ascii_digit()) {
        match runs.last_mut().filter(|(_, end)| *end == at) {
            Some((_, end)) => *end = at + 1,
            None => runs.push((at, at + 1)),
        }
    }
    runs.reverse();
    runs
}

/// `disk2.x`, `x_disk_2`.
fn behind_a_word(name: &str) -> Option<(u64, String)> {
    digits(name).into_iter().find_map(|(start, end)| {
        let before = name[..start].trim_end_matches(SEPARATORS);
        let lone = LETTERS.contains(&before.to_lowercase().as_str()) && name[end..].starts_with(SEPARATORS);
        let kept = if lone { "" } else { without_words(before) };
        let rest = joined(kept, &name[end..]);
        (kept.len() < before.len() && looks_like(&rest).is_some())
            .then(|| Some((name[start..end].parse().ok()?, rest)))
            .flatten()
    })
}

fn without_words(name: &str) -> &str {
    let name = name.trim_end_matches(SEPARATORS);
    let start = name.rfind(|c: char| !c.is_alphabetic()).map_or(0, |at| at + 1);
    // A separator is one byte; another letter before the word would be its own.
    let word = name.get(start..).unwrap_or_default();
    if WORDS.contains(&word.to_lowercase().as_str()) { without_words(&name[..start]) } else { name }
}

/// `x2`, `2_x`, `x_mm_2`.
fn bare(name: &str) -> Option<(u64, String)> {
    digits(name).into_iter().find_map(|(start, end)| {
        let rest = joined(&name[..start], &name[end..]);
        looks_like(&rest).and_then(|_| Some((name[start..end].parse().ok()?, rest)))
    })
}

/// What stands before and behind a number, without it.
fn joined(before: &str, after: &str) -> String {
    let (front, back) = (before.trim_end_matches(SEPARATORS), after.trim_start_matches(SEPARATORS));
    let apart = front.len() < before.len() || back.len() < after.len();
    let between = if apart && !front.is_empty() && !back.is_empty() { "_" } else { "" };
    format!("{front}{between}{back}")
}

/// A disk by a word, from 0.
pub fn word(word: &str, segments: usize) -> Option<usize> {
    match word {
        "proximal" => Some(0),
        "middle" | "medial" | "mid" if segments == 3 => Some(1),
        "distal" | "tip" => Some(segments - 1),
        _ => None,
    }
}

/// `tip_x`, `x (mm) proximal`.
fn by_word(name: &str, segments: usize) -> Option<(usize, String)> {
    let words: Vec<&str> = name.split(SEPARATORS).filter(|part| !part.is_empty()).collect();
    let (first, last) = (words.first()?, words.last()?);
    let without_first = || word(&first.to_lowercase(), segments).map(|place| (place, words[1..].join("_")));
    let without_last = || word(&last.to_lowercase(), segments).map(|place| (place, words[..words.len() - 1].join("_")));
    without_first().or_else(without_last).filter(|(_, rest)| looks_like(rest).is_some())
}

/// The two numbers of `q2_1` and `joint_21`.
fn pair(name: &str) -> Option<[u64; 2]> {
    let letters: String = plain(name).chars().filter(|c| !c.is_ascii_digit()).collect();
    let numbers: Vec<u64> = name.chars().filter_map(|c| c.to_digit(10)).map(u64::from).collect();
    match numbers.as_slice() {
        &[first, second] if ["q", "joint"].contains(&letters.as_str()) => Some([first, second]),
        _ => None,
    }
}

/// Which of the two numbers of `q2_1` is the disk's.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Order {
    DiskFirst,
    DiskLast,
    /// Three of each: taken for the first.
    Either,
}

impl Order {
    fn of<'p>(pairs: impl Iterator<Item = &'p [u64; 2]>, segments: usize) -> Option<Self> {
        let (first, last): (BTreeSet<u64>, BTreeSet<u64>) = pairs.map(|[first, last]| (*first, *last)).unzip();
        // Four parts are a quaternion, three are joints.
        let whole = |numbers: &BTreeSet<u64>| numbers.iter().copied().eq(0..4) || numbers.iter().copied().eq(1..4);
        let disks = |numbers: &BTreeSet<u64>| numbers.len() <= segments;
        match (whole(&last) && disks(&first), whole(&first) && disks(&last)) {
            (true, true) => Some(Self::Either),
            (true, false) => Some(Self::DiskFirst),
            (false, true) => Some(Self::DiskLast),
            (false, false) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told_of(headers: &[&str], segments: usize) -> String {
        let headers: Vec<String> = headers.iter().map(|header| (*header).into()).collect();
        let (named, _) = named(&headers, 1, segments).unwrap_or_else(|error| panic!("{error}"));
        let each = named.iter().map(|Named { disk, rest }| match disk {
            Some(disk) => format!("{} {rest}", disk + 1),
            None => format!("- {rest}"),
        });
        each.collect::<Vec<_>>().join(", ")
    }

    #[test]
    fn names_tell_of_which_disk_they_are() {
        for (headers, told) in [
            (&["time [s]", "x1 [mm]", "qw_2", "disk3.x"][..], "- time [s], 1 x [mm], 2 qw, 3 x"),
            (&["x_mm_1", "x2_mm", "p3x"], "1 x_mm, 2 x_mm, 3 px"),
            (&["segment2_azimuth (deg)", "Marker 1 Tx (mm)"], "2 azimuth [deg], 1 Tx [mm]"),
            (&["theta_l1", "theta_l_2", "bend3", "delta_1"], "1 theta_l, 2 theta_l, 3 bend, 1 delta"),
            (&["/disk_2/pose/position/x", "end_disk_3_x"], "2 pose/position/x, 3 x"),
            (&["tip_x", "proximal.qw", "x middle"], "3 x, 1 qw, 2 x"),
            (&["d1_x", "s2.y", "status_3"], "1 x, 2 y, 3 status"),
            (&["disk2_q1", "tau_1", "force_2", "note 7"], "2 q1, - tau_1, - force_2, - note 7"),
            (&["x0", "x1", "x2"], "1 x, 2 x, 3 x"),
            (&["x0", "x1", "x2", "x3"], "- , 1 x, 2 x, 3 x"),
            (&["qw1", "qx1", "q0_2", "q1_2"], "1 qw, 1 qx, 2 q0, 2 q1"),
        ] {
            assert_eq!(told_of(headers, 3), told, "{headers:?}");
        }
    }

    #[test]
    fn joints_have_a_number_of_their_own() {
        assert_eq!(told_of(&["q1_1", "q1_2", "q1_3", "q2_1"], 2), "1 q1, 1 q2, 1 q3, 2 q1");
        assert_eq!(told_of(&["q1_2", "q2_2", "q3_2", "q1_1"], 2), "2 q1, 2 q2, 2 q3, 1 q1");
        assert_eq!(told_of(&["q11", "q12", "q13", "q31"], 3), "1 q1, 1 q2, 1 q3, 3 q1");
        assert_eq!(told_of(&["q1_0", "q1_1", "q1_2", "q1_3"], 3), "1 q0, 1 q1, 1 q2, 1 q3");
    }

    #[test]
    fn a_disk_that_there_is_not_is_refused() {
        let headers = ["time".to_owned(), "x4 [mm]".to_owned()];
        let refused = named(&headers, 1, 3).expect_err("no such disk").to_string();
        for part in ["line 1, column 2 (x4 [mm])", "disk 4", "3 segments", "disks 1 to 3"] {
            assert!(refused.contains(part), "{refused:?} lacks {part:?}");
        }
    }
}
