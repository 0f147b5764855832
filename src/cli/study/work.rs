//! The runs of a study, on all cores.

use crate::cli::interrupt;
use centrode_core::study::Job;
use centrode_core::study::compare::{Compare, Piece};
use centrode_core::study::share::Share;
use centrode_core::study::tuning::Study;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::iter::{ParallelBridge, ParallelIterator};
use std::io::{self, IsTerminal};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Makes all runs, or those that are finished when an interrupt comes; returns whether one did.
///
/// Runs begin in order, so that what an interrupt leaves are the first repeats. What they come to are whole numbers:
/// the order in which threads finish does not show.
pub fn work(study: Study) -> (Study, bool) {
    let of = study.progress().of;
    let study = thresholds(study, 0..of);
    let partial = !study.missing().is_empty();
    (study, partial)
}

/// The runs of one share, and whether they are all there.
pub fn share_of_thresholds(study: Study, share: Share) -> (Study, bool) {
    let range = share.range(study.progress().of);
    let wanted = range.end - range.start;
    let study = thresholds(study, range);
    let made = study.progress().done == wanted;
    (study, made)
}

fn thresholds(study: Study, pieces: Range<u64>) -> Study {
    let counted = study.clone();
    let make = |piece| {
        let piece = study.piece(piece);
        (piece.0, study.run(piece))
    };
    repeat(counted, pieces, make, |counted, (piece, firsts)| {
        counted.add(piece, &firsts);
    })
}

/// All repeats of a comparison, or those that are finished when an interrupt comes.
pub fn compare(compare: Compare) -> Compare {
    let of = compare.progress().of;
    detectors(compare, 0..of)
}

/// The repeats of one share, and whether they are all there.
pub fn share_of_detectors(compare: Compare, share: Share) -> (Compare, bool) {
    let range = share.range(compare.progress().of);
    let wanted = range.end - range.start;
    let compare = detectors(compare, range);
    let made = compare.repeats() == wanted;
    (compare, made)
}

fn detectors(compare: Compare, repeats: Range<u64>) -> Compare {
    let counted = compare.clone();
    let make = |repeat| compare.make(Piece(repeat));
    repeat(counted, repeats, make, |counted, made| {
        counted.add(made);
    })
}

/// Makes pieces of work on all cores until an interrupt comes, and counts each in.
fn repeat<T: Send, P: Send>(
    counted: T,
    pieces: Range<u64>,
    make: impl Fn(u64) -> P + Sync,
    add: impl Fn(&mut T, P) + Sync,
) -> T {
    interrupt::defer();
    let bar = bar(pieces.end - pieces.start);
    let counted = Mutex::new(counted);
    let wanted = pieces.take_while(|_| !interrupt::noted());
    wanted.par_bridge().for_each(|piece| {
        let made = make(piece);
        add(&mut counted.lock().unwrap_or_else(PoisonError::into_inner), made);
        bar.inc(1);
    });
    bar.finish_and_clear();
    counted.into_inner().unwrap_or_else(PoisonError::into_inner)
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
