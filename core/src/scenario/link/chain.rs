//! What a link says of an experiment with several segments: a preset, and what differs from it.

use super::percent::encoded;
use super::read::Why;
use crate::scenario::chain::ChainDraft;
use crate::scenario::preset::{self, CHAINS, Preset};

/// What stands before the keys of such an experiment.
pub(super) const BEFORE: &str = "chain.";

/// A key of a link as `--set` takes it: `segment.2.length` is `segment[2].length`.
pub(super) fn path(key: &str) -> String {
    let mut path = String::new();
    for part in key.split('.') {
        match part.bytes().all(|byte| byte.is_ascii_digit()) && !part.is_empty() && !path.is_empty() {
            true => path.extend(["[", part, "]"]),
            false if path.is_empty() => path.push_str(part),
            false => path.extend([".", part]),
        }
    }
    path
}

/// An experiment with several segments.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainLink {
    preset: &'static Preset,
    /// What it says.
    pub draft: ChainDraft,
}

impl ChainLink {
    /// That of a preset; none of that name otherwise.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        let preset = preset::find_chain(name)?;
        Some(Self { preset, draft: ChainDraft::of(preset) })
    }

    /// One that differs from a preset.
    #[must_use]
    pub fn new(name: &str, draft: ChainDraft) -> Option<Self> {
        Some(Self { draft, ..Self::of(name)? })
    }

    /// One of a preset, or of that from which the least differs.
    #[must_use]
    pub fn nearest(draft: ChainDraft, preset: Option<&str>) -> Self {
        let far = |preset: &&Preset| draft.differences(&ChainDraft::of(preset)).len();
        let nearest = || CHAINS.iter().min_by_key(far).unwrap_or(&CHAINS[0]);
        Self { preset: preset.and_then(preset::find_chain).unwrap_or_else(nearest), draft }
    }

    /// Name of the preset.
    #[must_use]
    pub fn preset(&self) -> &'static str {
        self.preset.name
    }

    /// What differs from the preset: keys and values as `--set` takes them.
    #[must_use]
    pub fn changes(&self) -> Vec<(String, String)> {
        self.draft.differences(&ChainDraft::of(self.preset))
    }

    /// The same as a link has it: no brackets, which addresses do not hold.
    pub(super) fn parts(&self) -> impl Iterator<Item = (String, String)> {
        let named = |(key, value): (String, String)| {
            (format!("{BEFORE}{}", key.replace('[', ".").replace(']', "")), encoded(&value))
        };
        self.changes().into_iter().map(named)
    }

    /// When its run ends, s, unless something gives way before.
    pub(super) fn end(&self) -> Option<f64> {
        self.draft.scenario().ok().map(|scenario| scenario.common().motion.end)
    }

    /// Takes what was given of it, keys and values; what is impossible is left out and given back with the reason, until what remains
    /// is possible.
    pub(super) fn take(&mut self, mut given: Vec<(String, String)>) -> Vec<(String, String, Why)> {
        let mut refused = Vec::new();
        while !given.is_empty() {
            let all = |without: Option<usize>| {
                let kept = given.iter().enumerate().filter(move |(place, _)| Some(*place) != without);
                let texts: Vec<String> = kept.map(|(_, (key, value))| format!("{key}={value}")).collect();
                self.draft.overridden(texts.iter().map(String::as_str))
            };
            let error = match all(None) {
                Ok(draft) => {
                    self.draft = draft;
                    return refused;
                }
                Err(error) => error,
            };
            // The one without which it is possible, or that is impossible by itself; else the last.
            let alone = |place: usize| {
                let (key, value) = &given[place];
                self.draft.overridden([format!("{key}={value}").as_str()])
            };
            let places = || 0..given.len();
            let place = places()
                .find(|&place| all(Some(place)).is_ok())
                .or_else(|| places().find(|&place| alone(place).is_err()))
                .unwrap_or(given.len() - 1);
            let why = alone(place).err().unwrap_or(error);
            let (key, value) = given.remove(place);
            refused.push((format!("{BEFORE}{key}"), value, Why::Chain(why)));
        }
        refused
    }
}
