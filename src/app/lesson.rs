//! The tour and the challenges: what is taught, as data, and what the page knows of how far a person has come.
//!
//! A step of the tour ([`tour`]) and a challenge ([`challenge`]) are texts, the commands that put the page where they begin, and what
//! tells from the page that they are done. What a person had set before is kept aside and given back at the end.

mod apply;
pub mod captions;
pub mod card;
pub mod menu;
pub mod plate;
pub mod tour;

use serde::{Deserialize, Serialize};

use crate::app::memo::recorded::Recorded;
use crate::app::state::State;
use plate::Plate;
use tour::STEPS;

/// Where one is in the lessons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum At {
    /// At a step of the tour, from 0.
    Tour(usize),
}

/// What is wished of the lessons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wish {
    /// Go to a step of the tour, from 0.
    Tour(usize),
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
    /// The step that a link asks for, until the page goes there.
    pub(super) due: Option<usize>,
    /// When the run was first detected as the step began, s; none before that is known.
    began: Option<Option<f64>>,
    /// The steps that are done.
    done: [bool; STEPS],
    /// The step that the tour goes on with.
    resume: usize,
    plate: Plate,
}

/// What was set before the lessons.
#[derive(Debug)]
pub(super) struct Kept {
    pub(super) state: State,
    log: Option<Recorded>,
}

impl Lesson {
    /// The step that the tour goes on with, from 0.
    #[must_use]
    pub fn resume(&self) -> usize {
        self.resume
    }

    /// Whether a step has been done.
    #[must_use]
    pub fn is_done(&self, step: usize) -> bool {
        self.done.get(step).copied().unwrap_or(false)
    }

    /// The plate of the first step.
    #[must_use]
    pub fn plate(&self) -> &Plate {
        &self.plate
    }
}
