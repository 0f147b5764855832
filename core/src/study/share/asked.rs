//! Of which study a share is, and how two studies differ.

use crate::scenario::keys::KEYS;
use crate::scenario::{Detectors, Override, Scenario};
use crate::study::Job;
use crate::study::compare::{self, Compare, Piece};
use crate::study::tuning::recommend::Wish;
use crate::study::tuning::{self, Study};
use serde::{Deserialize, Serialize};

/// The repeat that every share makes to show how its program computes.
const PROBED: u64 = 0;

/// The study that shares are made of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Asked {
    /// Of thresholds.
    Thresholds {
        /// The study.
        spec: tuning::Spec,
        /// What its advice is to hold to.
        wish: Wish,
    },
    /// Of detectors.
    Detectors {
        /// The comparison.
        spec: compare::Spec,
        /// The detectors that judge in the scenario as it is set, to which a drawing links.
        judging: Detectors,
    },
}

/// A study begun.
#[derive(Debug, Clone)]
pub(super) enum Begun {
    /// Of thresholds.
    Thresholds(Box<Study>, Wish),
    /// Of detectors.
    Detectors(Box<Compare>, Detectors),
}

impl Asked {
    /// Begins the study.
    pub(super) fn begin(&self) -> Result<Begun, String> {
        match self.clone() {
            Self::Thresholds { spec, wish } => Study::new(spec)
                .map(|study| Begun::Thresholds(Box::new(study), wish))
                .map_err(|error| error.to_string()),
            Self::Detectors { spec, judging } => {
                let compare = Compare::new(spec).map_err(|error| error.to_string())?;
                Ok(Begun::Detectors(Box::new(compare), judging))
            }
        }
    }

    fn scenario(&self) -> &Scenario {
        match self {
            Self::Thresholds { spec, .. } => &spec.scenario,
            Self::Detectors { spec, .. } => &spec.scenario,
        }
    }

    /// In what this study differs from another, in words; none where they are the same.
    pub(super) fn differs(&self, other: &Self) -> Option<String> {
        if self == other {
            return None;
        }
        match (self, other) {
            (Self::Thresholds { .. }, Self::Detectors { .. }) => {
                return Some("one of thresholds, not of detectors".into());
            }
            (Self::Detectors { .. }, Self::Thresholds { .. }) => {
                return Some("one of detectors, not of thresholds".into());
            }
            _ => {}
        }
        let (one, two) = (self.scenario(), other.scenario());
        if let Some(key) = KEYS.iter().find(|key| !key.agrees(one, two)) {
            return Some(match [one, two].map(|scenario| key.get(scenario)) {
                [Some(one), Some(two)] => format!("{} = {}, not {}", key.path, one.to_toml(), two.to_toml()),
                _ => format!("another {}", key.path),
            });
        }
        let not = |name: &str, one: &dyn ToString, two: &dyn ToString| {
            let (one, two) = (one.to_string(), two.to_string());
            (one != two).then(|| format!("{name} {one}, not {two}"))
        };
        let found = match (self, other) {
            (Self::Thresholds { spec: a, wish: wished }, Self::Thresholds { spec: b, wish }) => {
                not("--repeats", &a.repeats, &b.repeats)
                    .or_else(|| not("--late", &a.late, &b.late))
                    .or_else(|| not("cells", &cells(&a.cells), &cells(&b.cells)))
                    .or_else(|| not("--method", &wished.rule.name(), &wish.rule.name()))
                    .or_else(|| not("--false-alarms", &wished.false_alarm_rate, &wish.false_alarm_rate))
                    .or_else(|| Some("other thresholds".into()))
            }
            (Self::Detectors { spec: a, judging: one }, Self::Detectors { spec: b, judging: two }) => {
                not("--repeats", &a.repeats, &b.repeats)
                    .or_else(|| not("--rate", &a.rate, &b.rate))
                    .or_else(|| not("--detector", &a.detector.key(), &b.detector.key()))
                    .or_else(|| (one == two).then(|| "another --after".into()))
            }
            _ => None,
        };
        found.or_else(|| Some("another scenario".into()))
    }
}

fn cells(cells: &[Vec<Override>]) -> String {
    let cell = |cell: &Vec<Override>| cell.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    cells.iter().map(cell).collect::<Vec<_>>().join(", ")
}

impl Begun {
    /// Pieces of work.
    pub(super) fn pieces(&self) -> u64 {
        match self {
            Self::Thresholds(study, _) => study.progress().of,
            Self::Detectors(compare, _) => compare.progress().of,
        }
    }
}

/// A checksum of what one repeat of a study comes to: who computes otherwise gets another.
pub(super) fn probe_thresholds(study: &Study) -> u32 {
    let last = study.batches().len().saturating_sub(1);
    let runs = [0, last].map(|batch| {
        let firsts = study.run((batch, PROBED));
        (firsts.alarms, firsts.contact)
    });
    checksum(&runs)
}

/// The same of a comparison.
pub(super) fn probe_detectors(compare: &Compare) -> u32 {
    checksum(&compare.make(Piece(PROBED)))
}

/// Of a value as JSON, in which every number has the digits that give its bits back.
pub(super) fn checksum(value: &impl Serialize) -> u32 {
    // Only a map with keys that are no words could fail.
    crc32fast::hash(&serde_json::to_vec(value).unwrap_or_default())
}
