//! The whole study from its shares.

use super::asked::{Begun, checksum, probe_detectors, probe_thresholds};
use super::{Asked, FORMAT, Part, Share};
use crate::scenario::Detectors;
use crate::study::compare::Compare;
use crate::study::remote::Found;
use crate::study::tuning::Study;
use crate::study::tuning::recommend::Wish;
use std::collections::BTreeMap;
use thiserror::Error;

/// Missing shares that a refusal names.
const NAMED: usize = 10;

/// Why shares do not make a whole.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MergeError {
    /// A file of another kind.
    #[error("{name} is not a share of a study")]
    NoShare {
        /// The file.
        name: String,
    },
    /// A file that a later or earlier program wrote.
    #[error("{name} has version {version} of the format; this program reads version {FORMAT}")]
    Format {
        /// The file.
        name: String,
        /// Its version.
        version: u32,
    },
    /// A file that was changed or cut.
    #[error("{name} is damaged: {what}; make this share anew")]
    Damaged {
        /// The file.
        name: String,
        /// What is wrong.
        what: String,
    },
    /// A share of a study that cannot be.
    #[error("{name}: {refusal}")]
    Impossible {
        /// The file.
        name: String,
        /// Why it cannot be.
        refusal: String,
    },
    /// A share of another study than the first.
    #[error("{name} is a share of another study than {first}: {what}")]
    Foreign {
        /// The file.
        name: String,
        /// The first file.
        first: String,
        /// In what the studies differ.
        what: String,
    },
    /// A share whose numbers this program would not compute.
    #[error(
        "{name} was made by a program that computes otherwise (centrode {program}); make this share anew with this one"
    )]
    Program {
        /// The file.
        name: String,
        /// The version of the program that made it.
        program: String,
    },
    /// Two files with one share that do not say the same.
    #[error("{name} and {other} are both share {share}, but differ; one of them is wrong")]
    Differ {
        /// The file.
        name: String,
        /// The one before.
        other: String,
        /// The share.
        share: Share,
    },
    /// Shares that no file has.
    #[error("{}", missing(.0))]
    Missing(Vec<Share>),
    /// No file at all.
    #[error("no share is given")]
    Nothing,
}

fn missing(shares: &[Share]) -> String {
    let mut named: Vec<String> = shares.iter().take(NAMED).map(ToString::to_string).collect();
    if shares.len() > NAMED {
        named.push(format!("and {} more", shares.len() - NAMED));
    }
    match shares {
        [one] => format!("share {one} is missing"),
        _ => format!("shares {} are missing", named.join(", ")),
    }
}

/// The whole.
#[derive(Debug, Clone)]
pub enum Whole {
    /// A study of thresholds, and what its advice holds to.
    Thresholds(Box<Study>, Wish),
    /// A comparison of detectors, and those that judge in the scenario as it is set.
    Detectors(Box<Compare>, Detectors),
}

/// Shares being put together: one file after the other, in any order, of which no more is kept than is counted.
///
/// ```
/// use centrode_core::scenario::preset::find;
/// use centrode_core::study::Job;
/// use centrode_core::study::share::{Merge, Part, Share, Whole};
/// use centrode_core::study::tuning::recommend::Wish;
/// use centrode_core::study::tuning::watch::Rule;
/// use centrode_core::study::tuning::{Spec, Study};
///
/// let spec = Spec::of(find("bench")?.scenario()?, 3);
/// let wish = Wish { rule: Rule::Fcd, false_alarm_rate: 0.05 };
/// let mut merge = Merge::default();
/// for number in [2, 1] {
///     let share = Share::new(number, 2).expect("one of two");
///     let mut study = Study::new(spec.clone())?;
///     for piece in share.range(study.progress().of).map(|piece| study.piece(piece)).collect::<Vec<_>>() {
///         let firsts = study.run(piece);
///         study.add(piece.0, &firsts);
///     }
///     let file = Part::of_thresholds(&study, wish, share).to_text()?;
///     merge.add(&format!("part-{number}.json"), file.as_bytes())?;
/// }
/// let Whole::Thresholds(merged, _) = merge.finish()? else { panic!("a study of thresholds") };
/// let mut whole = Study::new(spec)?;
/// whole.finish();
/// assert_eq!(*merged, whole);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Merge {
    first: Option<First>,
    /// The name and the checksum of each share so far.
    made: BTreeMap<Share, (String, u32)>,
}

/// The file that says what is merged.
#[derive(Debug, Clone)]
struct First {
    name: String,
    asked: Asked,
    of: u32,
    /// What this program's own repeat comes to.
    probe: u32,
    begun: Begun,
}

impl First {
    fn new(name: &str, part: &Part) -> Result<Self, MergeError> {
        let impossible = |refusal| MergeError::Impossible { name: name.into(), refusal };
        let begun = part.study.begin().map_err(impossible)?;
        let probe = match &begun {
            Begun::Thresholds(study, _) => probe_thresholds(study),
            Begun::Detectors(compare, _) => probe_detectors(compare),
        };
        Ok(Self { name: name.into(), asked: part.study.clone(), of: part.share.of(), probe, begun })
    }

    /// In what a share differs from one of this study.
    fn differs(&self, part: &Part) -> Option<String> {
        if let Some(what) = part.study.differs(&self.asked) {
            return Some(what);
        }
        let (of, own) = (part.share.of(), self.of);
        (of != own).then(|| format!("one of {of} shares, not of {own}"))
    }
}

impl Merge {
    /// Counts in the share that a file holds; one that is there already changes nothing.
    ///
    /// # Errors
    /// When it is no share, damaged, of another study than the first, or of a program that computes otherwise: by the file's name.
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), MergeError> {
        let part = Part::read(name, bytes)?;
        let mut first = match self.first.take() {
            Some(first) => first,
            None => First::new(name, &part)?,
        };
        let counted = self.count(&mut first, name, &part);
        self.first = Some(first);
        counted
    }

    fn count(&mut self, first: &mut First, name: &str, part: &Part) -> Result<(), MergeError> {
        if let Some(what) = first.differs(part) {
            return Err(MergeError::Foreign { name: name.into(), first: first.name.clone(), what });
        }
        if part.probe != first.probe {
            return Err(MergeError::Program { name: name.into(), program: part.program.clone() });
        }
        let (share, sum) = (part.share, checksum(&part.found));
        match self.made.get(&share) {
            Some((_, known)) if *known == sum => return Ok(()),
            Some((other, _)) => return Err(MergeError::Differ { name: name.into(), other: other.clone(), share }),
            None => {}
        }
        if !first.begun.count(share, &part.found) {
            let what = format!("these are not the runs of share {share}");
            return Err(MergeError::Damaged { name: name.into(), what });
        }
        self.made.insert(share, (name.into(), sum));
        Ok(())
    }

    /// The whole, once every share is there.
    ///
    /// # Errors
    /// [`MergeError::Missing`] with the shares that are not, [`MergeError::Nothing`] without any.
    pub fn finish(self) -> Result<Whole, MergeError> {
        let first = self.first.ok_or(MergeError::Nothing)?;
        let all = (1..=first.of).filter_map(|number| Share::new(number, first.of));
        let missing: Vec<Share> = all.filter(|share| !self.made.contains_key(share)).collect();
        if !missing.is_empty() {
            return Err(MergeError::Missing(missing));
        }
        Ok(match first.begun {
            Begun::Thresholds(study, wish) => Whole::Thresholds(study, wish),
            Begun::Detectors(compare, judging) => Whole::Detectors(compare, judging),
        })
    }
}

impl Begun {
    /// Counts in what the runs of a share came to; returns whether these are its runs.
    fn count(&mut self, share: Share, found: &Found) -> bool {
        let range = share.range(self.pieces());
        match (self, found) {
            (Self::Thresholds(study, _), Found::Thresholds(tallies)) => study.join(&range, tallies),
            (Self::Detectors(compare, _), Found::Detectors(made)) => {
                let repeats = made.iter().map(|made| made.0);
                repeats.eq(range) && made.iter().all(|made| compare.add(made.clone()))
            }
            _ => false,
        }
    }
}
