//! Reading a link: whatever it holds there is a scenario that can be run, and nothing that was wrong goes untold.

use super::chain::{BEFORE, ChainLink, path};
use super::page::CHAIN;
use super::percent::decoded;
use super::{Link, MAX_LINK, PAGE_KEYS, Page, VERSION, differences, is_address};
use crate::scenario::keys::{self, Allowed, GROUPS, Key, Quantity, Value};
use crate::scenario::preset::{self, CHAIN_NAMES, PRESETS, Preset};
use crate::scenario::refusal::Refused;
use crate::scenario::text::number;
use crate::scenario::{ChainError, Plan, Scenario, ScenarioError};
use std::fmt;
use thiserror::Error;

/// A part of a link that was not taken as it stands there.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Broken {
    /// The key as written; empty where there is none.
    pub key: String,
    /// The value as written.
    pub value: String,
    /// Why it was not taken.
    pub why: Why,
    /// The key and value that hold instead; none where it sets nothing at all.
    pub used: Option<(&'static str, Value)>,
}

/// Why a part of a link was not taken.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Why {
    /// The whole link is longer than [`MAX_LINK`].
    #[error("the link is {bytes} bytes long, and at most {MAX_LINK} are read")]
    TooLong {
        /// Its length.
        bytes: usize,
    },
    /// It is no text: a `%` without two digits behind it, or bytes that are not UTF-8.
    #[error("its percent-encoding is broken")]
    Encoding,
    /// It is not `key=value`.
    #[error("key=value is expected, as in contact.disk=3")]
    NotPair,
    /// The key stands in the link before.
    #[error("it is given more than once; the first one counts")]
    Twice,
    /// The link was written by a newer page.
    #[error("the link was written by a newer page, in a way that may differ; this page reads version {VERSION}")]
    Newer,
    /// The key does not exist or cannot hold the value, or the value is impossible together with the others.
    #[error(transparent)]
    Refused(#[from] ScenarioError),
    /// The same of an experiment with several segments.
    #[error(transparent)]
    Chain(ChainError),
}

/// The longest text of a link that a message repeats, characters.
const SHOWN: usize = 60;

/// A text as a message repeats it: short, and on one line.
fn clipped(text: &str) -> String {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    let mut short: String = text.chars().take(SHOWN).map(plain).collect();
    if text.chars().nth(SHOWN).is_some() {
        short.push('…');
    }
    short
}

impl Broken {
    /// What was written, as it was written.
    #[must_use]
    pub fn written(&self) -> String {
        let sign = if self.key.is_empty() { "" } else { "=" };
        format!("{}{sign}{}", self.key, self.value)
    }

    /// What is wrong, in SI and without what was used instead: for who uses nothing instead.
    #[must_use]
    pub fn refusal(&self) -> String {
        let written = self.written();
        if written.is_empty() { self.why.to_string() } else { format!("{written}: {}", self.why) }
    }
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.refusal())?;
        match &self.used {
            Some((key, value)) => write!(f, " ({key} = {} instead)", value.to_toml()),
            None => Ok(()),
        }
    }
}

/// One `key=value`.
#[derive(Debug)]
struct Given {
    key: &'static Key,
    text: String,
    value: Value,
}

/// What is wrong, with the key of the table where there is one.
struct Fault(Broken, Option<&'static Key>);

impl Link {
    /// Reads a link: a whole address, a fragment with `#`, or without. What is impossible is told, and has the preset's
    /// value instead; an empty link is the page as it opens.
    #[must_use]
    pub fn read(text: &str) -> (Self, Vec<Broken>) {
        Self::read_if(text, |scenario| Plan::new(scenario).map(drop))
    }

    /// The same for a reader who takes fewer scenarios than are possible: `check` says why not.
    #[must_use]
    pub fn read_if(text: &str, check: impl Fn(&Scenario) -> Result<(), ScenarioError>) -> (Self, Vec<Broken>) {
        let fragment = fragment(text);
        let mut reader = Reader::default();
        if fragment.len() > MAX_LINK {
            reader.fault("", "", Why::TooLong { bytes: fragment.len() }, None);
        } else {
            fragment.split('&').filter(|part| !part.is_empty()).for_each(|part| reader.part(part));
        }
        reader.finish(&check)
    }
}

/// The fragment in a whole address, or what was given as one.
fn fragment(text: &str) -> &str {
    let text = text.trim();
    match text.split_once('#') {
        Some((_, fragment)) => fragment,
        // Some programs encode the sign, too.
        None if is_address(text) => text.split_once("%23").map_or("", |(_, fragment)| fragment),
        None => text,
    }
}

#[derive(Default)]
struct Reader {
    preset: Option<&'static Preset>,
    seen: Vec<String>,
    given: Vec<Given>,
    /// Keys of an experiment with several segments.
    chain: Vec<(String, String)>,
    page: Page,
    faults: Vec<Fault>,
}

impl Reader {
    fn fault(&mut self, key: &str, value: &str, why: Why, of: Option<&'static Key>) {
        let broken = Broken { key: clipped(key), value: clipped(value), why, used: None };
        self.faults.push(Fault(broken, of));
    }

    fn part(&mut self, part: &str) {
        let Some(part) = decoded(part) else { return self.fault("", part, Why::Encoding, None) };
        let Some((name, text)) = part.split_once('=').filter(|(name, _)| !name.is_empty()) else {
            return self.fault("", &part, Why::NotPair, None);
        };
        let key = keys::find(name);
        if self.seen.iter().any(|seen| seen == name) {
            return self.fault(name, text, Why::Twice, key);
        }
        self.seen.push(name.into());
        if let Err(why) = self.take(name, text, key) {
            self.fault(name, text, why, key);
        }
    }

    fn take(&mut self, name: &str, text: &str, key: Option<&'static Key>) -> Result<(), Why> {
        match (name, key) {
            (_, Some(key)) => {
                let value = read_text(key, text)?;
                // A list of a wrong length is refused here.
                key.set(&mut Scenario::default(), value.clone())?;
                if let Some(other) =
                    key.other().filter(|other| self.given.iter().any(|given| given.key.path == other.path))
                {
                    return Err(key.refuse(Value::Other(clipped(text)), Allowed::Without(other.path)).into());
                }
                self.given.push(Given { key, text: text.into(), value });
            }
            ("preset", _) => {
                self.preset = Some(preset::find(text).map_err(|error| match error {
                    ScenarioError::UnknownPreset { name, known } => {
                        ScenarioError::UnknownPreset { name: clipped(&name), known }
                    }
                    other => other,
                })?)
            }
            (name, _) if name.starts_with(BEFORE) => self.chain.push((path(&name[BEFORE.len()..]), text.into())),
            ("v", _) if text.parse() == Ok(VERSION) => {}
            ("v", _) => return Err(Why::Newer),
            _ if PAGE_KEYS.iter().any(|key| key.name == name) => self.page.enter(name, text)?,
            _ => return Err(no_key(name, text).into()),
        }
        Ok(())
    }

    /// Puts together what was given; what is impossible is left out, until what remains is possible.
    fn finish(mut self, check: &impl Fn(&Scenario) -> Result<(), ScenarioError>) -> (Link, Vec<Broken>) {
        let preset = self.preset.unwrap_or(&PRESETS[0]);
        // Presets that come with the program are possible, which a test of all of them says.
        let base = preset.scenario().unwrap_or_default();
        let mut given = std::mem::take(&mut self.given);
        let scenario = loop {
            let scenario = applied(&base, &given, None);
            let Err(refused) = check(&scenario) else { break scenario };
            let Some(place) = culprit(&base, &given, &refused, check) else { break base.clone() };
            let Given { key, text, .. } = given.remove(place);
            self.fault(key.path, &text, refused.into(), Some(key));
        };
        self.finish_chain();
        if let Err(refused) = self.page.within(&scenario) {
            let time = self.page.time.map(number).unwrap_or_default();
            self.page.time = Some(self.page.end(&scenario).1);
            self.fault("t", &time, refused.into(), None);
        }
        let broken = self.faults.into_iter().map(|Fault(broken, key)| {
            let used = used(&broken, key, preset, &scenario, &self.page);
            Broken { used, ..broken }
        });
        let broken = broken.collect();
        (Link { preset, changes: differences(&base, &scenario), scenario, page: self.page }, broken)
    }
}

impl Reader {
    /// What was given of several segments. A link that says nothing of the view wants to show it.
    fn finish_chain(&mut self) {
        let given = std::mem::take(&mut self.chain);
        if self.page.chain.is_none() && (!given.is_empty() || self.page.view == CHAIN) {
            self.page.chain = ChainLink::of(CHAIN_NAMES[0]);
        }
        let Some(chain) = &mut self.page.chain else { return };
        for (key, value, why) in chain.take(given) {
            self.fault(&key, &value, why, None);
        }
        if !self.seen.iter().any(|seen| seen == "view") {
            self.page.view = CHAIN;
        }
    }
}

/// What holds in place of what was not taken.
fn used(
    broken: &Broken,
    key: Option<&'static Key>,
    preset: &Preset,
    scenario: &Scenario,
    page: &Page,
) -> Option<(&'static str, Value)> {
    if let Some(key) = key {
        let held = |key: &'static Key| Some((key.path, key.get(scenario)?));
        return held(key).or_else(|| held(key.other()?));
    }
    let whole = matches!(broken.why, Why::TooLong { .. });
    if whole || broken.key == "preset" {
        return Some(("preset", Value::Word(preset.name)));
    }
    let key = PAGE_KEYS.iter().find(|key| key.name == broken.key)?;
    Some((key.name, key.get(page)?))
}

/// A preset's scenario with what was given, all of it or all but one.
fn applied(base: &Scenario, given: &[Given], without: Option<usize>) -> Scenario {
    let mut scenario = base.clone();
    for (place, Given { key, value, .. }) in given.iter().enumerate() {
        if Some(place) != without {
            // What was read is of the key's own kind.
            let _ = key.set(&mut scenario, value.clone());
        }
    }
    scenario
}

/// Which of what was given is to blame: what is refused itself, or that without which it would not be; else the last.
/// None when nothing was given.
fn culprit(
    base: &Scenario,
    given: &[Given],
    refused: &ScenarioError,
    check: &impl Fn(&Scenario) -> Result<(), ScenarioError>,
) -> Option<usize> {
    let path = |error: &ScenarioError| match error {
        ScenarioError::Value(refused) => refused.key.split('[').next().unwrap_or_default().to_owned(),
        _ => String::new(),
    };
    let blamed = path(refused);
    let itself = given.iter().position(|given| given.key.path == blamed);
    let cured = |&place: &usize| {
        let without = applied(base, given, Some(place));
        check(&without).err().is_none_or(|error| path(&error) != blamed)
    };
    itself.or_else(|| (0..given.len()).find(cured)).or_else(|| given.len().checked_sub(1))
}

/// Reads the value of a key as a link has it.
///
/// # Errors
/// When the key cannot hold such a value.
pub fn read_text(key: &'static Key, text: &str) -> Result<Value, ScenarioError> {
    key.read(&toml_of(key, text))
}

/// The refusal of a name that is none of a link's keys, given with a value: a group of them, or unknown.
#[must_use]
pub fn no_key(name: &str, value: &str) -> ScenarioError {
    match GROUPS.iter().find(|group| group.path == name) {
        Some(group) => Refused::error(name, Quantity::Word, Value::Other(clipped(value)), Allowed::Group(group.path)),
        None => unknown_key(name),
    }
}

fn unknown_key(name: &str) -> ScenarioError {
    match keys::unknown(name) {
        ScenarioError::UnknownKey { known, .. } if !name.contains('.') => {
            let page = PAGE_KEYS.iter().map(|key| key.name).collect::<Vec<_>>().join(", ");
            ScenarioError::UnknownKey { key: clipped(name), known: format!("preset, {known}, {page}") }
        }
        ScenarioError::UnknownKey { known, .. } => ScenarioError::UnknownKey { key: clipped(name), known },
        other => other,
    }
}

/// What a link writes, as a scenario file would have it.
fn toml_of(key: &Key, text: &str) -> toml::Value {
    let one = |text: &str| match (text.parse::<i64>(), text.parse::<f64>()) {
        (Ok(whole), _) if key.is_whole() => toml::Value::Integer(whole),
        (_, Ok(number)) => toml::Value::Float(number),
        _ => toml::Value::String(clipped(text)),
    };
    if !key.is_list() && !key.is_words() {
        one(text)
    } else if text.is_empty() {
        toml::Value::Array(Vec::new())
    } else {
        toml::Value::Array(text.split(',').map(one).collect())
    }
}
