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
    let of = |detector: Method| {
        let name = detector.key().to_uppercase();
        let (works, why) = match detector {
            Method::Jfd if log.forces.is_empty() => (false, "no load cells: JFD needs tau_1, tau_2 and tau_3".into()),
            Method::Jfd if estimated => {
                (true, "no command: JFD takes the bend from the tracker, so the tracker's noise enters Θ".into())
            }
            Method::Jfd => (true, String::new()),
            _ if log.readings.is_empty() => {
                (false, format!("no readings of the tracker: {name} needs position and orientation"))
            }
            _ if !log.has_orientation() => (false, format!("no orientation: {name} needs it")),
            Method::Cusum | Method::Glr if estimated => {
                (false, "no command: the calibration filter compares readings with the commanded pose".into())
            }
            Method::Fcd | Method::FcdConsistent | Method::FcdVelocity if estimated => (
                true,
                format!(
                    "no command: {name} takes the bend from the tracker itself, so its noise counts twice, and an end disk that \
                     does not turn as commanded goes unnoticed"
                ),
            ),
            Method::Fcd | Method::FcdConsistent | Method::FcdVelocity | Method::Cusum | Method::Glr => {
                (true, String::new())
            }
        };
        Outlook { detector, works, why }
    };
    Method::ALL.iter().copied().map(of).collect()
}
