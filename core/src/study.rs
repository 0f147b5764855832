//! What runs show: one over time, and what one does not show: repeats, figures, tables and maps.
//!
//! Everything but the course of one run is a [`Job`] that works a piece at a time, so that a frame of the page, a worker or a loop on a
//! terminal can drive it, and whose result may be looked at before it is complete. Same inputs, same bits.

pub mod about;
pub mod chain;
pub mod channels;
pub mod compare;
pub mod course;
pub mod exact;
pub mod export;
pub mod figure;
pub mod map;
pub mod remote;
pub mod report;
pub mod seed;
pub mod share;
pub mod shared;
pub mod table2;
pub mod timeline;
pub mod tuning;

/// Work in pieces of a few milliseconds.
pub trait Job {
    /// Does one piece. Once nothing is left it does nothing.
    fn step(&mut self);

    /// How far it is.
    fn progress(&self) -> Progress;

    /// Does all that is left.
    fn finish(&mut self) {
        while !self.progress().is_complete() {
            self.step();
        }
    }
}

/// Pieces of work done, of all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Pieces done.
    pub done: u64,
    /// Pieces in all.
    pub of: u64,
}

impl Progress {
    /// Whether nothing is left to do.
    #[must_use]
    pub fn is_complete(self) -> bool {
        self.done >= self.of
    }
}
