//! Which detectors a log lets work.

use super::Method;
use crate::record::log::{Commands, Log};
use serde::Serialize;

/// Whether a detector works on a log.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Outlook {
    /// The detector.
    pub detector: Method,
    /// Whether it can judge.
    pub works: bool,
    /// Why not, or what it loses, in a sentence without full stop; empty where nothing is missing.
    pub why: String,
}

/// Of every detector, on a log whose commands come from `source`.
#[must_use]
pub fn outlooks(log: &Log, source: Commands) -> Vec<Outlook> {
    let estimated = source == Commands::Estimated;
    let of = |detector| {
        let (works, why) = match detector {
            Method::Fcd if log.readings.is_empty() => {
                (false, "no readings of the tracker: FCD needs position and orientation")
            }
            Method::Fcd if !log.has_orientation() => (false, "no orientation: FCD needs it"),
            Method::Fcd if estimated => (
                true,
                "no command: FCD takes the bend from the tracker itself, so its noise counts twice, and an end disk that does \
                 not turn as commanded goes unnoticed",
            ),
            Method::Jfd if log.forces.is_empty() => (false, "no load cells: JFD needs tau_1, tau_2 and tau_3"),
            Method::Jfd if estimated => {
                (true, "no command: JFD takes the bend from the tracker, so the tracker's noise enters Θ")
            }
            _ => (true, ""),
        };
        Outlook { detector, works, why: why.into() }
    };
    Method::ALL.iter().copied().map(of).collect()
}
