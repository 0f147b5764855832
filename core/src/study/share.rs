//! Studies in shares, made wherever there is a machine: each share is a file, and all of them together are the bits of the whole.
//!
//! Pieces of a study are numbered, and a share is a range of them. What they come to is counted in whole numbers, or kept one by one, so
//! it does not matter who makes which share, in which order, or whether one is made twice. Reading order: `part` (a share as a file),
//! `asked` (of which study it is), `merge` (the whole).

mod asked;
mod merge;
mod part;

pub use asked::Asked;
pub use merge::{Merge, MergeError, Whole};
pub use part::{FORMAT, Part};

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;
use thiserror::Error;

/// The most shares of one study.
pub const MAX_SHARES: u32 = 1_000_000;

/// One of the equal shares of a study's pieces, written `3/64`: the third of 64.
///
/// ```
/// use centrode_core::study::share::Share;
///
/// let share: Share = "2/3".parse()?;
/// assert_eq!(share.range(10), 3..6);
/// assert!("4/3".parse::<Share>().is_err());
/// # Ok::<(), centrode_core::study::share::ShareError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Share {
    of: u32,
    number: u32,
}

/// Why a text names no share.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "{0:?} is not a share: write K/N, as in 3/64 for the third of 64, with K from 1 to N and N at most {MAX_SHARES}"
)]
pub struct ShareError(String);

impl Share {
    /// The share of a number, counted from 1, among so many; none where there is no such share.
    #[must_use]
    pub fn new(number: u32, of: u32) -> Option<Self> {
        ((1..=MAX_SHARES).contains(&of) && (1..=of).contains(&number)).then_some(Self { of, number })
    }

    /// Its number, counted from 1.
    #[must_use]
    pub fn number(self) -> u32 {
        self.number
    }

    /// Of how many it is one.
    #[must_use]
    pub fn of(self) -> u32 {
        self.of
    }

    /// Its pieces among so many: one more or less than any other share has. Where there are fewer pieces than shares some have none.
    #[must_use]
    pub fn range(self, pieces: u64) -> Range<u64> {
        // The product is below 2^84, and the quotient at most `pieces`.
        let end = |number: u32| (u128::from(pieces) * u128::from(number) / u128::from(self.of)) as u64;
        end(self.number - 1)..end(self.number)
    }
}

impl FromStr for Share {
    type Err = ShareError;

    fn from_str(text: &str) -> Result<Self, ShareError> {
        let parts = text.split_once('/');
        let numbers = parts.and_then(|(number, of)| Some((number.trim().parse().ok()?, of.trim().parse().ok()?)));
        numbers.and_then(|(number, of)| Self::new(number, of)).ok_or_else(|| ShareError(text.into()))
    }
}

impl TryFrom<String> for Share {
    type Error = ShareError;

    fn try_from(text: String) -> Result<Self, ShareError> {
        text.parse()
    }
}

impl From<Share> for String {
    fn from(share: Share) -> Self {
        share.to_string()
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_equal_and_cover_every_piece_once() {
        for (of, pieces) in [(1, 7), (3, 10), (64, 800), (64, 5), (7, 0), (MAX_SHARES, u64::MAX)] {
            let shares = [1, 2, of / 2, of - 1, of].map(|number| Share::new(number.clamp(1, of), of).expect("a share"));
            let size = pieces / u64::from(of);
            for range in shares.map(|share| share.range(pieces)) {
                assert!((size..=size + 1).contains(&(range.end - range.start)), "{range:?}");
            }
            let next = |number: u32| Share::new(number, of).map(|share| share.range(pieces));
            assert_eq!(next(1).map(|range| range.start), Some(0));
            assert_eq!(next(of).map(|range| range.end), Some(pieces));
            (1..of.min(100)).for_each(|k| assert_eq!(next(k).map(|r| r.end), next(k + 1).map(|r| r.start)));
        }
    }

    #[test]
    fn what_is_no_share_is_refused() {
        for text in ["", "3", "0/3", "4/3", "1/0", "-1/3", "1/1000001", "1/2/3", "a/b", "1.5/3", "99999999999/3"] {
            let refusal = text.parse::<Share>().expect_err(text).to_string();
            assert!(refusal.starts_with(&format!("{text:?} is not a share")), "{refusal}");
        }
        assert_eq!("64/64".parse().ok(), Share::new(64, 64));
    }
}
