//! The runs of a study, on all cores.

use crate::cli::interrupt;
use centrode_core::study::Job;
use centrode_core::study::tuning::Study;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::iter::{ParallelBridge, ParallelIterator};
use std::io::{self, IsTerminal};
use std::sync::{Mutex, PoisonError};

/// Makes all runs, or those that are finished when an interrupt comes; returns whether one did.
///
/// Runs begin in order, so that what an interrupt leaves are the first repeats. What they come to are whole numbers:
/// the order in which threads finish does not show.
pub fn work(study: Study) -> (Study, bool) {
    interrupt::defer();
    let of = study.progress().of;
    let bar = bar(of);
    let counted = Mutex::new(study.clone());
    let wanted = (0..of).take_while(|_| !interrupt::noted());
    wanted.par_bridge().for_each(|piece| {
        let piece = study.piece(piece);
        let firsts = study.run(piece);
        counted.lock().unwrap_or_else(PoisonError::into_inner).add(piece.0, &firsts);
        bar.inc(1);
    });
    bar.finish_and_clear();
    let study = counted.into_inner().unwrap_or_else(PoisonError::into_inner);
    let partial = !study.missing().is_empty();
    (study, partial)
}

/// On a terminal only: a program that reads standard error wants none.
fn bar(of: u64) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(of);
    match ProgressStyle::with_template("{bar:40} {pos} of {len} runs, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
