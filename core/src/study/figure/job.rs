//! Which figures there are, and the work they take.

use super::content::Content;
use super::{bend, bound, centrodes, deviations, residuals};
use crate::chart::Chart;
use crate::scenario::{Plan, Scenario, ScenarioError};
use crate::study::{Job, Progress};
use std::fmt::{self, Display};
use std::str::FromStr;
use thiserror::Error;

/// A figure of the paper that is made again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Number {
    /// The bound ε_c against the bend.
    Three,
    /// Loci of the fixed centrode, with and without constraint.
    Four,
    /// The joint force deviation with and without contact.
    Six,
    /// The joint force deviation over the bend, without contact.
    Seven,
    /// The centrode deviation, with detections.
    Eight,
}

impl Number {
    /// All of them, in the paper's order.
    pub const ALL: [Self; 5] = [Self::Three, Self::Four, Self::Six, Self::Seven, Self::Eight];

    /// Its number in the paper.
    #[must_use]
    pub fn digit(self) -> u8 {
        match self {
            Self::Three => 3,
            Self::Four => 4,
            Self::Six => 6,
            Self::Seven => 7,
            Self::Eight => 8,
        }
    }

    /// Name of the preset that sets it up.
    #[must_use]
    pub fn preset(self) -> &'static str {
        match self {
            Self::Three => "figure-3",
            Self::Four => "figure-4",
            Self::Six => "figure-6",
            Self::Seven => "figure-7",
            Self::Eight => "figure-8",
        }
    }

    /// What it shows, in a line.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Three => "Least detectable joint force deviation",
            Self::Four => "Fixed centrodes with and without constraint",
            Self::Six => "Joint force deviation with and without contact",
            Self::Seven => "Joint force deviation over the bend, without contact",
            Self::Eight => "Fixed centrode deviation and the detection of contact",
        }
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.digit())
    }
}

/// A figure that is not made.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("unknown figure {text:?}; known figures: {known}", known = Number::ALL.map(|number| number.to_string()).join(", "))]
pub struct UnknownFigure {
    /// What was asked for.
    pub text: String,
}

impl FromStr for Number {
    type Err = UnknownFigure;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let found = Self::ALL.into_iter().find(|number| number.to_string() == text);
        found.ok_or_else(|| UnknownFigure { text: text.into() })
    }
}

/// A figure being made: each step is at most one run of the experiment.
#[derive(Debug)]
pub struct FigureJob {
    number: Number,
    content: Box<dyn Content>,
    done: usize,
}

impl FigureJob {
    /// The work for a figure of a scenario; nothing is run yet.
    ///
    /// # Errors
    /// When the scenario is impossible: which key, which value, what is allowed.
    pub fn new(number: Number, scenario: &Scenario) -> Result<Self, ScenarioError> {
        let plan = Plan::new(scenario)?;
        let content: Box<dyn Content> = match number {
            Number::Three => Box::new(bound::Bounds::new(plan)),
            Number::Four => Box::new(centrodes::Centrodes::new(plan)?),
            Number::Six => Box::new(residuals::Residuals::new(plan)?),
            Number::Seven => Box::new(bend::OverBend::new(&plan)?),
            Number::Eight => Box::new(deviations::Deviations::new(plan)?),
        };
        Ok(Self { number, content, done: 0 })
    }

    /// Which figure it is.
    #[must_use]
    pub fn number(&self) -> Number {
        self.number
    }

    /// The figure as far as it is made.
    #[must_use]
    pub fn chart(&self) -> Chart {
        Chart { title: self.number.title().into(), ..self.content.chart() }
    }
}

impl Job for FigureJob {
    fn step(&mut self) {
        if self.done < self.content.pieces() {
            self.content.piece(self.done);
            self.done += 1;
        }
    }

    fn progress(&self) -> Progress {
        Progress { done: self.done as u64, of: self.content.pieces() as u64 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::preset;

    #[test]
    fn numbers_are_read_and_others_refused_with_those_that_exist() {
        for number in Number::ALL {
            assert_eq!(number.digit().to_string().parse(), Ok(number));
            assert!(preset::find(number.preset()).is_ok(), "{number}");
        }
        for text in ["5", "", "33", "three", " 3"] {
            let message = text.parse::<Number>().expect_err(text).to_string();
            assert!(message.contains("3, 4, 6, 7, 8") && message.contains(&format!("{text:?}")), "{message}");
        }
    }
}
