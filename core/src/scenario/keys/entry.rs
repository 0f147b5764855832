//! What an entry of the table is written with.

use crate::scenario::Scenario;
use crate::scenario::keys::allowed::Limit;
use crate::scenario::keys::quantity::Quantity;
use crate::scenario::keys::{Access, Allowed, Key, Usual};

macro_rules! number {
    ($($path:ident).+) => { Access::Number(|s| Some(s.$($path).+), |s, value| s.$($path).+ = value) };
}
macro_rules! whole {
    ($($path:ident).+) => { Access::Whole(|s| Some(s.$($path).+), |s, value| s.$($path).+ = value) };
}
macro_rules! threshold {
    ($($path:ident).+) => { Access::Threshold(|s| s.$($path).+, |s, value| s.$($path).+ = value) };
}
macro_rules! estimated {
    ($($path:ident).+) => { Access::Estimated(|s| s.$($path).+, |s, value| s.$($path).+ = value) };
}
macro_rules! vector {
    ($($path:ident).+) => { Access::Vector(|s| &s.$($path).+, |s, value| s.$($path).+ = value) };
}
/// One of some words.
macro_rules! one_of {
    ($($path:ident).+, $all:expr) => {
        Access::Word(
            |s| $all.iter().position(|one| *one == s.$($path).+).unwrap_or_default(),
            |s, i| s.$($path).+ = $all.get(i).copied().unwrap_or_default(),
        )
    };
}
/// One of two words.
macro_rules! either {
    ($($path:ident).+, $first:path, $second:path) => {
        Access::Word(|s| usize::from(s.$($path).+ == $second), |s, i| s.$($path).+ = if i == 0 { $first } else { $second })
    };
}
/// Some of a list.
macro_rules! some_of {
    ($($path:ident).+, $of:ty) => {
        Access::Words(
            |s, place| <$of>::ALL.get(place).is_some_and(|&one| s.$($path).+.has(one)),
            |s, places| {
                let chosen = places.iter().filter_map(|&place| <$of>::ALL.get(place).copied());
                s.$($path).+ = crate::scenario::Choice::of(&chosen.collect::<Vec<_>>());
            },
        )
    };
}
pub(super) use {either, estimated, number, one_of, some_of, threshold, vector, whole};

pub(super) const fn key(
    path: &'static str,
    quantity: Quantity,
    allowed: Allowed,
    access: Access,
    sentence: &'static str,
) -> Key {
    Key { path, quantity, allowed, sentence, illustrative: false, usual: Usual::None, instead_of: None, access }
}

impl Key {
    pub(super) const fn illustrative(self) -> Self {
        Self { illustrative: true, ..self }
    }

    pub(super) const fn usual_range(self, low: f64, high: f64) -> Self {
        Self { usual: Usual::Range(low, high), ..self }
    }

    pub(super) const fn usual_of(self, ends: fn(&Scenario) -> (f64, f64)) -> Self {
        Self { usual: Usual::Of(ends), ..self }
    }

    pub(super) const fn instead_of(self, path: &'static str, example: f64) -> Self {
        Self { instead_of: Some((path, example)), ..self }
    }
}

pub(super) const fn between(least: f64, most: f64) -> Allowed {
    Allowed::Range(Limit::At(least), Limit::At(most))
}

pub(super) const fn at_most_key(path: &'static str) -> Allowed {
    Allowed::Range(Limit::At(0.0), Limit::Key(path, None))
}

pub(super) const fn below_key(path: &'static str) -> Allowed {
    Allowed::Range(Limit::At(0.0), Limit::BeyondKey(path, None))
}
