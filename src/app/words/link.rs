//! What the page says of links and files that it could not take as they were.

use crate::app::panels::notice::{Notice, Row};
use crate::app::words::refusal;
use centrode_core::scenario::keys::{self, Quantity, Units, Value};
use centrode_core::scenario::link::{Broken, PAGE_KEYS, Why};

/// The head of a scenario file that the page saves.
pub const FILE_HEAD: &str = "# Saved by the Centrode page, which opens it again; `centrode run FILE` runs it.\n\n";

/// What is said of a link with broken parts.
#[must_use]
pub fn notice(link: &str, broken: &[Broken]) -> Notice {
    let listed = broken.iter().map(|broken| format!("- {broken}\n")).collect::<String>();
    let text =
        "What is named here was not taken as the link has it; everything else was. The page shows what it could read.";
    Notice {
        title: "This link could not be read whole".into(),
        text: text.into(),
        rows: broken.iter().map(row).collect(),
        details: format!("This link could not be read whole:\n{link}\n{listed}"),
    }
}

fn row(broken: &Broken) -> Row {
    let why = sentence(&match &broken.why {
        Why::Refused(refused) => refusal::told(refused),
        other => other.to_string(),
    });
    let written = if broken.written().is_empty() { "The whole link".into() } else { broken.written() };
    Row { written, why: format!("{why}."), used: broken.used.as_ref().map(used).unwrap_or_default() }
}

/// What was used instead, as the page calls it.
fn used((key, value): &(&'static str, Value)) -> String {
    let page = || PAGE_KEYS.iter().find(|known| known.name == *key).map(|known| known.quantity);
    let quantity = keys::find(key).map(|key| key.quantity).or_else(page).unwrap_or(Quantity::Word);
    let shown = match value {
        Value::Word(word) | Value::Off(word) => (*word).into(),
        Value::Words(words) => words.join(", "),
        other => other.told(quantity, Units::Shown),
    };
    let name = refusal::called(key).unwrap_or(key);
    format!("Used instead: {name} {shown}.")
}

/// What is said of a file that was not saved.
#[must_use]
pub fn not_saved(name: &str, why: &str) -> Notice {
    let title = format!("{name} was not saved");
    Notice { text: format!("{}.", sentence(why)), rows: Vec::new(), details: format!("{title}: {why}"), title }
}

/// What is said of a state that is too long for an address.
#[must_use]
pub fn not_held() -> Notice {
    let title = "The address does not hold this scenario".to_owned();
    let text = "A link to it would be longer than 8 kB, and programs that links pass through would cut it. Reloading the page goes back \
                to what the address held last: keep this scenario as a file, by Share, Save scenario."
        .to_owned();
    Notice { details: format!("{title}\n{text}"), title, text, rows: Vec::new() }
}

/// What is said of a file that was not opened.
#[must_use]
pub fn not_opened(name: &str, why: &str) -> Notice {
    let title = format!("{name} was not opened");
    let text = format!("{}. Nothing was changed.", sentence(why));
    Notice { details: format!("{title}\n{text}"), title, text, rows: Vec::new() }
}

/// What is said when there is no link or command.
#[must_use]
pub fn no_link(why: &str) -> Notice {
    let title = "No link was copied".to_owned();
    let text = format!("{}.", sentence(why));
    Notice { details: format!("{title}\n{text}"), title, text, rows: Vec::new() }
}

/// With a capital at its start, unless it starts with a key or a symbol.
fn sentence(text: &str) -> String {
    let first = text.split_whitespace().next().unwrap_or_default();
    if !first.starts_with(|c: char| c.is_ascii()) || first.contains(['.', '_', '=', '"']) {
        return text.into();
    }
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
