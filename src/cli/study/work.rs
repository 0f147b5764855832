//! The runs of a study, on all cores.

use centrode_core::study::Job;
use centrode_core::study::tuning::Study;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::iter::{ParallelBridge, ParallelIterator};
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Makes all runs, or those that are finished when an interrupt comes; returns whether one did.
///
/// Runs begin in order, so that what an interrupt leaves are the first repeats. What they come to are whole numbers:
/// the order in which threads finish does not show.
pub fn work(study: Study) -> (Study, bool) {
    let stop = Arc::new(AtomicBool::new(false));
    let heard = Arc::clone(&stop);
    let listening = ctrlc::set_handler(move || {
        if heard.swap(true, Ordering::Relaxed) {
            // Asked twice, it does not even finish what it writes.
            std::process::exit(super::super::output::INTERRUPTED.into());
        }
    });
    if let Err(error) = listening {
        let _ =
            writeln!(io::stderr(), "centrode: an interrupt will end this at once, without what is finished: {error}");
    }
    let of = study.progress().of;
    let bar = bar(of);
    let counted = Mutex::new(study.clone());
    let wanted = (0..of).take_while(|_| !stop.load(Ordering::Relaxed));
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
