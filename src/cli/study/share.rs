//! One share of a study, to be put together with the others later.

use super::outputs::Outputs;
use super::work;
use crate::cli::output::{Failure, NewFile};
use centrode_core::scenario::Detectors;
use centrode_core::study::compare::Compare;
use centrode_core::study::share::{Part, Share};
use centrode_core::study::tuning::Study;
use centrode_core::study::tuning::recommend::Wish;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Flags of one share.
#[derive(Debug, Args)]
pub struct ShareArgs {
    /// Make one share of the study only, as in 3/64, and write it to --out; `centrode study merge` puts the shares together.
    #[arg(long, value_name = "K/N", requires = "out")]
    shard: Option<Share>,
    /// The file of the share.
    #[arg(long, value_name = "FILE", requires = "shard")]
    out: Option<PathBuf>,
}

impl ShareArgs {
    /// The share that is to be made, and its file; none where the whole study is.
    pub fn open(&self, outputs: &Outputs) -> Result<Option<(Share, NewFile)>, Failure> {
        let Some((share, path)) = self.shard.zip(self.out.as_deref()) else { return Ok(None) };
        if outputs.is_given() {
            let line = "--shard makes a share, of which there is nothing to show: give --json, --csv and --svg to `centrode study merge`";
            return Err(Failure::Input(line.into()));
        }
        Ok(Some((share, NewFile::create(path)?)))
    }
}

/// Makes a share of a study of thresholds.
pub fn thresholds(share: Share, file: NewFile, study: Study, wish: Wish) -> Result<(), Failure> {
    let (study, made) = work::share_of_thresholds(study, share);
    write(made, share, file, || Part::of_thresholds(&study, wish, share))
}

/// Makes a share of a comparison of detectors.
pub fn detectors(share: Share, file: NewFile, compare: Compare, judging: Detectors) -> Result<(), Failure> {
    let (compare, made) = work::share_of_detectors(compare, share);
    write(made, share, file, || Part::of_detectors(&compare, judging, share))
}

/// Writes a share that is whole: a part of one is of no use.
fn write(made: bool, share: Share, mut file: NewFile, part: impl FnOnce() -> Part) -> Result<(), Failure> {
    if !made {
        return Err(Failure::Interrupted(format!("interrupted: share {share} is not whole, and not written")));
    }
    let text = part().to_text().map_err(Failure::Input)?;
    file.write_all(text.as_bytes()).map_err(|error| file.blame(&error))?;
    file.finish()
}
