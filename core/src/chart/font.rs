//! How wide a text is in the page's font, without the font.

mod widths;

use super::notation::runs;
use widths::{EM, REGULAR, STRONG, Table};

/// Names of the font, and what a viewer without it may take.
pub const FAMILY: &str = "Inter, Helvetica, Arial, sans-serif";
/// The same in the heavier weight, which some systems know as a font of its own.
pub const STRONG_FAMILY: &str = "Inter Semi Bold, Inter, Helvetica, Arial, sans-serif";
/// Weight of the heavier font.
pub const STRONG_WEIGHT: u16 = 600;
/// Size of an index below the line, in sizes of its text.
pub const LOW: f64 = 0.76;
/// How far an index sinks, in sizes of its text.
pub const SUNK: f64 = 0.17;
/// From the middle of a line down to its baseline, in sizes of its text: half the height of a capital.
pub const MIDDLE: f64 = 0.364;
/// Width of a character that the font has not, em.
const UNKNOWN: f64 = 0.7;

fn advance(table: Table, character: char) -> Option<u16> {
    let (first, widths) = table.iter().rev().find(|(first, _)| *first <= character)?;
    widths.get(character as usize - *first as usize).copied().filter(|width| *width > 0)
}

/// Whether the font has a character.
#[must_use]
pub fn has(character: char) -> bool {
    advance(REGULAR, character).is_some()
}

/// Width of characters as they stand, in sizes of the text.
#[must_use]
pub fn plain_width(text: &str, strong: bool) -> f64 {
    let table = if strong { STRONG } else { REGULAR };
    text.chars().map(|c| advance(table, c).map_or(UNKNOWN, |width| f64::from(width) / EM)).sum()
}

/// Width of a text with its indices below the line, in points at `size`.
#[must_use]
pub fn width(text: &str, size: f64, strong: bool) -> f64 {
    runs(text).iter().map(|run| plain_width(&run.text, strong) * if run.low { LOW * size } else { size }).sum()
}

/// Text in lines of at most a width; a word that is wider has its own line, and is broken after `&` and `,`, as in a link.
#[must_use]
pub fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.split('\n') {
        let mut line = String::new();
        for word in paragraph.split(' ') {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if width(&longer, size, false) <= most {
                line = longer;
            } else if width(word, size, false) <= most {
                lines.push(std::mem::replace(&mut line, word.to_owned()));
            } else {
                let lead = if line.is_empty() { String::new() } else { line + " " };
                line = broken(&mut lines, lead, word, size, most);
            }
        }
        lines.push(line);
    }
    lines
}

/// Breaks a word that is wider than a line, the first of which begins with `line`; returns what begins the next.
fn broken(lines: &mut Vec<String>, mut line: String, word: &str, size: f64, most: f64) -> String {
    for part in word.split_inclusive(['&', ',']) {
        let longer = format!("{line}{part}");
        if line.is_empty() || width(&longer, size, false) <= most {
            line = longer;
        } else {
            lines.push(std::mem::replace(&mut line, part.to_owned()).trim_end().to_owned());
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_equally_wide_and_indices_are_small() {
        let widths = ['0', '1', '4', '9'].map(|figure| plain_width(&figure.to_string(), false));
        assert!(widths.iter().all(|width| *width == widths[0] && *width > 0.5));
        assert_eq!(width("θ_L", 10.0, false), 10.0 * (plain_width("θ", false) + LOW * plain_width("L", false)));
        assert!(plain_width("threshold", true) > plain_width("threshold", false));
        assert!(has('Θ') && has('−') && has('‖') && !has('\u{e000}'));
    }

    #[test]
    fn lines_keep_to_the_width_and_lose_no_word() {
        let text = "one two three four five\nsix";
        let lines = lines(text, 10.0, 60.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| width(line, 10.0, false) <= 60.0), "{lines:?}");
        assert_eq!(lines.join(" "), text.replace('\n', " "));
        assert_eq!(super::lines("unbreakable", 10.0, 1.0), ["unbreakable"]);
    }

    #[test]
    fn a_link_is_broken_between_its_settings() {
        let text = "Centrode #preset=bench&seed=7&contact.disk=3&robot.disks=0.01,0.02,0.03&detection.xi2=0.005";
        let lines = lines(text, 10.0, 160.0);
        assert!(lines.len() > 3 && lines.iter().all(|line| width(line, 10.0, false) <= 160.0), "{lines:?}");
        assert!(lines[0].starts_with("Centrode #preset=bench&"), "{lines:?}");
        assert!(lines[..lines.len() - 1].iter().all(|line| line.ends_with(['&', ','])), "{lines:?}");
        assert_eq!(lines.concat(), text);
    }
}
