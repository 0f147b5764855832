//! What the interface asks for; one place applies it.

use crate::experiment::scenario::Threshold;

/// A change that a view asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Move the playback position to this time, s.
    Seek(f64),
    /// Set ξ1, N·m.
    SetXi1(Threshold),
    /// Set ξ2, m.
    SetXi2(Threshold),
    /// Set the time from which alarms are raised, s.
    SetArmedFrom(f64),
}
