//! Several words of a list.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::marker::PhantomData;

/// What a key may hold several of: at most 8 things.
pub trait Listed: Copy + PartialEq + Serialize + DeserializeOwned + 'static {
    /// All of them, in their order.
    const ALL: &'static [Self];

    /// As files have it.
    fn word(self) -> &'static str;
}

/// Some of the things of a list, each at most once. A file has them as a list of words.
///
/// ```
/// use centrode_core::scenario::{Detectors, Method};
///
/// let mut detectors = Detectors::of(&[Method::Cusum, Method::Fcd]);
/// assert_eq!(detectors.iter().collect::<Vec<_>>(), [Method::Fcd, Method::Cusum]);
/// detectors.set(Method::Fcd, false);
/// assert!(detectors.has(Method::Cusum) && !detectors.has(Method::Fcd));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice<T>(u8, PhantomData<T>);

impl<T: Listed> Choice<T> {
    /// None of them.
    pub const NONE: Self = Self(0, PhantomData);

    /// These.
    #[must_use]
    pub fn of(chosen: &[T]) -> Self {
        let mut choice = Self::NONE;
        chosen.iter().for_each(|&one| choice.set(one, true));
        choice
    }

    /// Whether one is among them.
    #[must_use]
    pub fn has(self, one: T) -> bool {
        self.0 & Self::bit(one) != 0
    }

    /// Takes one in, or out.
    pub fn set(&mut self, one: T, on: bool) {
        self.0 = if on { self.0 | Self::bit(one) } else { self.0 & !Self::bit(one) };
    }

    /// Each of them, in the order of the list.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = T> + Clone {
        T::ALL.iter().copied().filter(move |&one| self.has(one))
    }

    fn bit(one: T) -> u8 {
        T::ALL.iter().position(|known| *known == one).map_or(0, |place| 1 << place)
    }
}

impl<T: Listed> Serialize for Choice<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de, T: Listed> Deserialize<'de> for Choice<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut choice = Self::NONE;
        for one in Vec::<T>::deserialize(deserializer)? {
            if choice.has(one) {
                return Err(de::Error::custom(format!("{} stands there twice", one.word())));
            }
            choice.set(one, true);
        }
        Ok(choice)
    }
}
