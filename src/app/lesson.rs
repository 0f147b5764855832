//! The tour and the challenges: what is taught, as data, and what the page knows of how far a person has come.
//!
//! A step of the tour ([`tour`]) and a challenge ([`challenge`]) are texts, the commands that put the page where they begin, and what
//! tells from the page that they are done. What a person had set before is kept aside and given back at the end.

mod apply;
pub mod captions;
pub mod card;
pub mod challenge;
pub mod menu;
pub mod plate;
pub mod progress;
pub mod tour;

use serde::{Deserialize, Serialize};

use crate::app::memo::recorded::Recorded;
use crate::app::state::State;
use challenge::check::{Check, Verdict};
use plate::Plate;
use progress::Progress;

/// Where one is in the lessons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum At {
    /// At a step of the tour, from 0.
    Tour(usize),
    /// Choosing a challenge.
    Challenges,
    /// At a challenge, from 0.
    Challenge(usize),
}

/// What is wished of the lessons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wish {
    /// Go to a step of the tour, from 0.
    Tour(usize),
    /// Choose a challenge.
    Challenges,
    /// Begin a challenge, from 0.
    Challenge(usize),
    /// Show the challenge's hint, or hide it.
    UnfoldHint,
    /// Show its worked answer, or hide it.
    UnfoldAnswer,
    /// Do what the answer says.
    ShowAnswer,
    /// Leave, and go back to what was set before.
    Leave,
    /// Leave, and keep what is set now.
    Keep,
    /// Move something on the plate.
    Plate(plate::Move),
}

/// What is remembered of the lessons.
#[derive(Debug, Default)]
pub struct Lesson {
    /// What was set before.
    pub(super) kept: Option<Kept>,
    /// What a link asks for, until the page goes there.
    pub(super) due: Option<Wish>,
    /// When the run was first detected as the step began, s; none before that is known.
    began: Option<Option<f64>>,
    /// How far the person has come.
    progress: Progress,
    /// The same as the surroundings keep it; none where they keep nothing.
    kept_as: Option<String>,
    plate: Plate,
    /// Whether the open challenge is met.
    pub(super) check: Check,
    /// Whether its hint and its answer are shown.
    unfolded: (bool, bool),
}

/// What was set before the lessons.
#[derive(Debug)]
pub(super) struct Kept {
    pub(super) state: State,
    log: Option<Recorded>,
}

impl Lesson {
    /// As the surroundings have kept it; none where they keep nothing.
    #[must_use]
    pub fn new(kept: Option<String>) -> Self {
        let progress = kept.as_deref().map(Progress::read).unwrap_or_default();
        Self { kept_as: kept.map(|_| progress.text()), progress, ..Self::default() }
    }

    /// The step that the tour goes on with, from 0.
    #[must_use]
    pub fn resume(&self) -> usize {
        self.progress.tour - 1
    }

    /// Whether a step has been done.
    #[must_use]
    pub fn is_done(&self, step: usize) -> bool {
        self.progress.done.contains(&(step + 1))
    }

    /// Whether a challenge has been met, by its name.
    #[must_use]
    pub fn is_met(&self, key: &str) -> bool {
        self.progress.met.contains(key)
    }

    /// Whether the surroundings keep how far the person has come.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        self.kept_as.is_some()
    }

    /// Whether runs of a challenge that is open are to be made.
    #[must_use]
    pub fn is_measuring(&self, at: Option<At>) -> bool {
        matches!(at, Some(At::Challenge(_))) && self.check.is_working()
    }

    /// What is known of the open challenge.
    #[must_use]
    pub fn verdict(&self) -> Option<Verdict> {
        self.check.verdict()
    }

    /// The plate of the first step.
    #[must_use]
    pub fn plate(&self) -> &Plate {
        &self.plate
    }
}
