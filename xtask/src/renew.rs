//! Replacing what tests compare with, after a change that was meant.

use crate::run::{cargo, run};
use crate::tools;
use anyhow::Result;
use clap::ValueEnum;

/// What can be replaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Stored {
    /// The pictures of the page in tests/snapshots: look at each one before it is committed
    Pictures,
    /// The commented default scenario and the reference of keys, written from the table of keys
    Keys,
    /// The hashes of everything computed in tests/data/fingerprints.json: only when numbers were meant to change
    Fingerprints,
    /// The drawings that documents show: look at each one before it is committed
    Drawings,
    /// The icons of the installed page, made of assets/icons/icon.svg
    Icons,
}

impl Stored {
    /// The test binary that compares it, the part of it that does, and the variable that has it store.
    fn test(self) -> [&'static str; 3] {
        match self {
            Self::Pictures => ["interface", "pictures::", "UPDATE_SNAPSHOTS"],
            Self::Keys => ["it", "keys::", "UPDATE_SNAPSHOTS"],
            Self::Fingerprints => ["it", "fingerprints::", "UPDATE_FINGERPRINTS"],
            Self::Drawings => ["it", "documented::", "UPDATE_SNAPSHOTS"],
            Self::Icons => ["it", "icons::", "UPDATE_SNAPSHOTS"],
        }
    }
}

/// Runs the tests that compare, and has them store what they find.
pub fn command(stored: Stored) -> Result<()> {
    if stored == Stored::Pictures {
        tools::software_gpu()?;
    }
    let [binary, part, variable] = stored.test();
    run(cargo().args(["test", "--all-features", "--test", binary, part]).env(variable, "1"))
}
