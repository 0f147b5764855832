//! The one table of what can be set.
//!
//! A [`Key`] says path, quantity and unit, what is allowed, how a slider goes, and what it means in a sentence: once.
//! Scenario files and overrides are read by it, a plan is checked by it, the page's controls take their ranges and
//! sentences from it, refusals are made of it, and the commented default scenario and `docs/KEYS.md` are written from
//! it. Reading order: [`quantity`], [`value`], [`allowed`], [`table`], then [`document`].

pub mod allowed;
pub mod document;
mod entry;
pub mod quantity;
pub mod table;
pub mod value;

use crate::scenario::refusal::{Refused, ScenarioError};
use crate::scenario::{Estimated, Scenario, Threshold};
pub use allowed::Allowed;
pub use quantity::{Quantity, Units};
pub use table::{GROUPS, KEYS};
pub use value::Value;

/// One thing that can be set.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Dotted path, as in a scenario file.
    pub path: &'static str,
    /// What its number is.
    pub quantity: Quantity,
    /// What it may hold.
    pub allowed: Allowed,
    /// What it means.
    pub sentence: &'static str,
    /// Whether its default is illustrative: the paper gives none.
    pub illustrative: bool,
    /// Ends of its slider.
    pub usual: Usual,
    /// The key in place of which it can be given, and an example of its value (SI).
    pub instead_of: Option<(&'static str, f64)>,
    access: Access,
}

/// Ends of a slider, SI; what is typed may lie outside.
#[derive(Debug, Clone, Copy)]
pub enum Usual {
    /// It has none.
    None,
    /// From one to the other.
    Range(f64, f64),
    /// Where they hang on other settings.
    Of(fn(&Scenario) -> (f64, f64)),
}

/// How a key's value lies in a scenario. Where a getter gives none, the other of two keys is set.
#[derive(Debug, Clone, Copy)]
enum Access {
    Number(fn(&Scenario) -> Option<f64>, fn(&mut Scenario, f64)),
    Whole(fn(&Scenario) -> Option<u64>, fn(&mut Scenario, u64)),
    Threshold(fn(&Scenario) -> Threshold, fn(&mut Scenario, Threshold)),
    Estimated(fn(&Scenario) -> Estimated, fn(&mut Scenario, Estimated)),
    /// The word's place in the list of words.
    Word(fn(&Scenario) -> usize, fn(&mut Scenario, usize)),
    /// Whether the word at a place in the list of words is held, and which places are.
    Words(fn(&Scenario, usize) -> bool, fn(&mut Scenario, &[usize])),
    Vector(fn(&Scenario) -> &[f64; 3], fn(&mut Scenario, [f64; 3])),
    List(fn(&Scenario) -> &[f64], fn(&mut Scenario, Vec<f64>)),
}

const OFF: &str = "off";
const AUTO: &str = "auto";

/// The key of a path.
#[must_use]
pub const fn find(path: &str) -> Option<&'static Key> {
    let mut i = 0;
    while i < KEYS.len() {
        if same(KEYS[i].path.as_bytes(), path.as_bytes()) {
            return Some(&KEYS[i]);
        }
        i += 1;
    }
    None
}

/// `==`, which constants cannot have.
const fn same(a: &[u8], b: &[u8]) -> bool {
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

/// The names of what is in a group ("" for the top): keys, then groups.
#[must_use]
pub fn names(group: &str) -> Vec<&'static str> {
    let within = |path: &'static str| {
        let rest = if group.is_empty() { Some(path) } else { path.strip_prefix(group)?.strip_prefix('.') };
        rest.filter(|rest| !rest.is_empty() && !rest.contains('.'))
    };
    let (keys, groups) = (KEYS.iter().map(|key| key.path), GROUPS.iter().map(|group| group.path));
    keys.chain(groups).filter_map(within).collect()
}

/// Whether a path is that of a group.
#[must_use]
pub fn is_group(path: &str) -> bool {
    GROUPS.iter().any(|group| group.path == path)
}

/// The refusal of a path, with what is known at the place where it goes astray.
pub(super) fn unknown(path: &str) -> ScenarioError {
    let mut group = path;
    while let Some((before, _)) = group.rsplit_once('.') {
        group = before;
        if find(group).is_some() {
            return ScenarioError::UnknownKey {
                key: path.into(),
                known: format!("{group}, which holds no keys of its own"),
            };
        }
        if is_group(group) {
            return ScenarioError::UnknownKey { key: path.into(), known: names(group).join(", ") };
        }
    }
    ScenarioError::UnknownKey { key: path.into(), known: names("").join(", ") }
}

impl Key {
    /// Its name within its group.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.path.rsplit('.').next().unwrap_or(self.path)
    }

    /// The path of its group; empty for the top.
    #[must_use]
    pub fn group(&self) -> &'static str {
        self.path.rsplit_once('.').map_or("", |(group, _)| group)
    }

    /// Whether it holds whole numbers.
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        matches!(self.access, Access::Whole(..))
    }

    /// Whether it holds several numbers.
    #[must_use]
    pub const fn is_list(&self) -> bool {
        matches!(self.access, Access::Vector(..) | Access::List(..))
    }

    /// Whether it holds several words.
    #[must_use]
    pub const fn is_words(&self) -> bool {
        matches!(self.access, Access::Words(..))
    }

    /// Whether it holds a number that need not be whole.
    #[must_use]
    pub const fn is_number(&self) -> bool {
        matches!(self.access, Access::Number(..) | Access::Threshold(..) | Access::Estimated(..))
    }

    /// Whether it can hold a word in place of its number.
    #[must_use]
    pub const fn has_off(&self) -> bool {
        self.off().is_some()
    }

    /// The word that it holds while its number is switched off, where that is possible: "off" for no number at all, "auto" for one
    /// that is estimated.
    #[must_use]
    pub const fn off(&self) -> Option<&'static str> {
        match self.access {
            Access::Threshold(..) => Some(OFF),
            Access::Estimated(..) => Some(AUTO),
            _ => None,
        }
    }

    /// The words of which it holds one; empty for a number.
    #[must_use]
    pub const fn words(&self) -> &'static [&'static str] {
        match self.allowed {
            Allowed::Words(words) => words,
            _ => &[],
        }
    }

    /// The words of which it holds any; empty for a key that holds one, or a number.
    #[must_use]
    pub const fn any_of(&self) -> &'static [&'static str] {
        match self.allowed {
            Allowed::Some(words) => words,
            _ => &[],
        }
    }

    /// Ends of its slider in this scenario, SI.
    #[must_use]
    pub fn usual(&self, scenario: &Scenario) -> (f64, f64) {
        match self.usual {
            Usual::None => (0.0, 1.0),
            Usual::Range(low, high) => (low, high),
            Usual::Of(ends) => ends(scenario),
        }
    }

    /// What a scenario holds; none where the other of two keys is set.
    #[must_use]
    pub fn get(&self, scenario: &Scenario) -> Option<Value> {
        Some(match self.access {
            Access::Number(get, _) => Value::Number(get(scenario)?),
            Access::Whole(get, _) => Value::Whole(get(scenario)?),
            Access::Threshold(get, _) => get(scenario).value().map_or(Value::Off(OFF), Value::Number),
            Access::Estimated(get, _) => get(scenario).value().map_or(Value::Off(AUTO), Value::Number),
            Access::Word(get, _) => Value::Word(self.words().get(get(scenario)).copied().unwrap_or_default()),
            Access::Words(has, _) => {
                let words = self.any_of().iter().enumerate().filter(|(place, _)| has(scenario, *place));
                Value::Words(words.map(|(_, word)| *word).collect())
            }
            Access::Vector(get, _) => Value::List(get(scenario).to_vec()),
            Access::List(get, _) => Value::List(get(scenario).to_vec()),
        })
    }

    /// The number that a scenario holds, SI; none where it is no number, is switched off, or the other of two keys is set.
    #[must_use]
    pub fn number(&self, scenario: &Scenario) -> Option<f64> {
        match self.access {
            Access::Number(get, _) => get(scenario),
            Access::Whole(get, _) => get(scenario).map(|value| value as f64),
            Access::Threshold(get, _) => get(scenario).value(),
            Access::Estimated(get, _) => get(scenario).value(),
            _ => None,
        }
    }

    /// The whole number that a scenario holds, exactly.
    fn whole(&self, scenario: &Scenario) -> Option<u64> {
        match self.access {
            Access::Whole(get, _) => get(scenario),
            _ => None,
        }
    }

    /// The list that a scenario holds, SI; none where it is none.
    #[must_use]
    pub fn list<'a>(&self, scenario: &'a Scenario) -> Option<&'a [f64]> {
        match self.access {
            Access::Vector(get, _) => Some(get(scenario)),
            Access::List(get, _) => Some(get(scenario)),
            _ => None,
        }
    }

    /// Which of its words a scenario holds; the first for a key without words.
    #[must_use]
    pub fn chosen(&self, scenario: &Scenario) -> usize {
        match self.access {
            Access::Word(get, _) => get(scenario),
            _ => 0,
        }
    }

    /// Sets one of its words by its place; a key without it is left alone.
    pub fn choose(&self, scenario: &mut Scenario, place: usize) {
        if let Access::Word(_, set) = self.access
            && place < self.words().len()
        {
            set(scenario, place);
        }
    }

    /// Whether a scenario holds one of the words of which it holds any, by its place.
    #[must_use]
    pub fn holds(&self, scenario: &Scenario, place: usize) -> bool {
        matches!(self.access, Access::Words(has, _) if has(scenario, place))
    }

    /// Takes one of the words of which it holds any in or out, by its place; a key without it is left alone.
    pub fn hold(&self, scenario: &mut Scenario, place: usize, on: bool) {
        if let Access::Words(has, set) = self.access {
            let kept = |&other: &usize| if other == place { on } else { has(scenario, other) };
            let places: Vec<_> = (0..self.any_of().len()).filter(kept).collect();
            set(scenario, &places);
        }
    }

    /// Sets a number, SI. Whole numbers are rounded, from 0 up; a key that is no number is left alone.
    pub fn set_number(&self, scenario: &mut Scenario, value: f64) {
        match self.access {
            Access::Number(_, set) => set(scenario, value),
            Access::Whole(_, set) => set(scenario, libm::round(value) as u64),
            Access::Threshold(_, set) => set(scenario, Threshold::On(value)),
            Access::Estimated(_, set) => set(scenario, Estimated::Known(value)),
            _ => {}
        }
    }

    /// Sets one number of a list, SI; where there is none, nothing changes.
    pub fn set_part(&self, scenario: &mut Scenario, part: usize, value: f64) {
        let Some(mut list) = self.list(scenario).map(<[f64]>::to_vec) else { return };
        if let Some(place) = list.get_mut(part) {
            *place = value;
            match self.access {
                Access::Vector(_, set) => set(scenario, list.try_into().unwrap_or_default()),
                Access::List(_, set) => set(scenario, list),
                _ => {}
            }
        }
    }

    /// Switches its number off, where that is possible.
    pub fn switch_off(&self, scenario: &mut Scenario) {
        match self.access {
            Access::Threshold(_, set) => set(scenario, Threshold::OFF),
            Access::Estimated(_, set) => set(scenario, Estimated::AUTO),
            _ => {}
        }
    }

    /// Sets a value of the key's own kind; whether it is possible is for [`Key::check`] to say.
    ///
    /// # Errors
    /// When the value is of another kind.
    pub fn set(&self, scenario: &mut Scenario, value: Value) -> Result<(), ScenarioError> {
        match (self.access, value) {
            (Access::Number(_, set), Value::Number(value)) => set(scenario, value),
            (Access::Whole(_, set), Value::Whole(value)) => set(scenario, value),
            (Access::Threshold(_, set), Value::Number(value)) => set(scenario, Threshold::On(value)),
            (Access::Threshold(_, set), Value::Off(OFF)) => set(scenario, Threshold::OFF),
            (Access::Estimated(_, set), Value::Number(value)) => set(scenario, Estimated::Known(value)),
            (Access::Estimated(_, set), Value::Off(AUTO)) => set(scenario, Estimated::AUTO),
            (Access::List(_, set), Value::List(list)) => set(scenario, list),
            (Access::Vector(_, set), Value::List(list)) => match list.try_into() {
                Ok(vector) => set(scenario, vector),
                Err(list) => return Err(self.refuse(Value::List(list), self.allowed)),
            },
            (Access::Word(_, set), Value::Word(word)) => match self.words().iter().position(|known| *known == word) {
                Some(place) => set(scenario, place),
                None => return Err(self.refuse(Value::Word(word), self.allowed)),
            },
            (Access::Words(_, set), Value::Words(words)) => set(scenario, &self.places(&words)?),
            (_, value) => return Err(self.refuse(value, self.allowed)),
        }
        Ok(())
    }

    /// The places of some of its words.
    fn places(&self, words: &[&'static str]) -> Result<Vec<usize>, ScenarioError> {
        let mut places = Vec::new();
        for (at, word) in words.iter().enumerate() {
            let refuse =
                |allowed| Refused::error(format!("{}[{at}]", self.path), self.quantity, Value::Word(word), allowed);
            let known = self.any_of().iter().position(|known| known == word);
            let place = known.ok_or_else(|| refuse(Allowed::Words(self.any_of())))?;
            if places.contains(&place) {
                return Err(refuse(Allowed::Need("a word that does not stand in the list before")));
            }
            places.push(place);
        }
        Ok(places)
    }

    /// Gives one scenario what another holds, here or under the other of two keys.
    pub fn copy(&self, from: &Scenario, to: &mut Scenario) {
        let other = self.other().filter(|other| other.get(from).is_some());
        let key = other.unwrap_or(self);
        if let Some(value) = key.get(from) {
            // What a key gives is of its own kind.
            let _ = key.set(to, value);
        }
    }

    /// Whether two scenarios hold the same, here and under the other of two keys.
    #[must_use]
    pub fn agrees(&self, one: &Scenario, other: &Scenario) -> bool {
        let same = |key: &Self| key.get(one) == key.get(other);
        same(self) && self.other().is_none_or(same)
    }

    /// The other of two keys of which a scenario holds one.
    #[must_use]
    pub fn other(&self) -> Option<&'static Self> {
        let instead = |key: &&Key| key.instead_of.is_some_and(|(of, _)| of == self.path);
        match self.instead_of {
            Some((of, _)) => find(of),
            None => KEYS.iter().find(instead),
        }
    }

    /// Checks what a scenario holds here.
    ///
    /// # Errors
    /// When it is impossible: key, value, and what is allowed.
    pub fn check(&self, scenario: &Scenario) -> Result<(), ScenarioError> {
        self.fault(scenario).map_or(Ok(()), |(part, value, allowed)| {
            let path = part.map_or_else(|| self.path.into(), |part| format!("{}[{part}]", self.path));
            Err(Refused::error(path, self.quantity, value, allowed))
        })
    }

    /// The refusal of a value.
    #[must_use]
    pub fn refuse(&self, value: Value, allowed: Allowed) -> ScenarioError {
        Refused::error(self.path, self.quantity, value, allowed)
    }
}
