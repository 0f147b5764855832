//! What one figure is made of, a piece at a time.

use crate::chart::Chart;
use std::fmt::Debug;

/// What one figure is made of, a piece at a time.
pub trait Content: Debug + Send + Sync {
    /// Number of pieces.
    fn pieces(&self) -> usize;
    /// Does piece `k`, after all before it.
    fn piece(&mut self, k: usize);
    /// What there is so far.
    fn chart(&self) -> Chart;
}
