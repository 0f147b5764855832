//! Which threshold to take, in which cell.

use super::rate::runs_to_show;
use super::watch::Rule;
use super::{Point, Study};
use serde::{Deserialize, Serialize};

/// What is wished for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wish {
    /// How alarms are raised.
    #[serde(rename = "method")]
    pub rule: Rule,
    /// The most runs without contact that may alarm, as a share above 0 and below 1.
    pub false_alarm_rate: f64,
}

/// The answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "verdict", rename_all = "kebab-case")]
pub enum Verdict {
    /// Take this one.
    Take {
        /// The cell.
        cell: usize,
        /// The place of its threshold among the cell's levels.
        level: usize,
        /// The evidence.
        point: Box<Point>,
    },
    /// No threshold has shown itself as quiet as that, and with so few runs none could.
    TooFewRuns {
        /// The fewest repeats with which one could.
        needed: u64,
    },
    /// No threshold is quiet enough.
    NoneQuiet {
        /// The lowest upper end of an interval that was reached.
        lowest: f64,
    },
    /// Those that are quiet enough find fewer than half of the contacts in time.
    NoneFinds {
        /// The largest share that one of them finds.
        best: f64,
    },
    /// There is no contact to find.
    NoContact,
}

/// The threshold that finds contact soonest among those whose false alarms are shown, by the upper end of the 95 %
/// interval, to be at most as frequent as wished. Soonest is the least median delay; of equals the one with the
/// smaller delay by which 90 % are found, then with fewer false alarms, then the first.
#[must_use]
pub fn recommend(study: &Study, wish: &Wish) -> Verdict {
    recommend_among(study, 0..study.cells().len(), wish)
}

/// The same among some of the cells.
///
/// # Panics
/// When there is no such cell.
#[must_use]
pub fn recommend_among(study: &Study, cells: impl IntoIterator<Item = usize>, wish: &Wish) -> Verdict {
    let mut search = Search::new(wish.false_alarm_rate);
    for cell in cells {
        let (free, held) = study.runs(cell, wish.rule);
        // Whether the robot reaches the beam, the first run will say.
        search.enter(free, held.is_some_and(|held| held == 0 || study.contact_time(cell).is_some()));
        for (level, point) in study.curve(cell, wish.rule).into_iter().enumerate() {
            search.look(cell, level, point);
        }
    }
    search.verdict()
}

/// The search for the soonest threshold among those quiet enough, whatever they are thresholds of.
#[derive(Debug, Clone)]
pub struct Search {
    rate: f64,
    runs: u64,
    lowest: f64,
    finds: f64,
    contact: bool,
    best: Option<(usize, usize, Point)>,
}

impl Search {
    /// With the most runs without contact that may alarm, as a share above 0 and below 1.
    #[must_use]
    pub fn new(rate: f64) -> Self {
        Self { rate, runs: 0, lowest: f64::INFINITY, finds: 0.0, contact: false, best: None }
    }

    /// Enters a cell of so many runs without contact, in which there is or may be a contact to find.
    pub fn enter(&mut self, runs: u64, contact: bool) {
        self.runs = self.runs.max(runs);
        self.contact |= contact;
    }

    /// Looks at what one level of a cell comes to.
    pub fn look(&mut self, cell: usize, level: usize, point: Point) {
        let upper = point.false_alarms.rate.high;
        self.lowest = self.lowest.min(upper);
        let Some(detection) = point.detection.filter(|_| upper <= self.rate) else { return };
        self.finds = self.finds.max(detection.detected.rate);
        if !detection.median.is_nan() && self.best.as_ref().is_none_or(|(_, _, best)| sooner(&point, best)) {
            self.best = Some((cell, level, point));
        }
    }

    /// The answer.
    #[must_use]
    pub fn verdict(self) -> Verdict {
        let needed = runs_to_show(self.rate);
        match self.best {
            Some((cell, level, point)) => Verdict::Take { cell, level, point: Box::new(point) },
            None if !self.contact => Verdict::NoContact,
            None if self.lowest <= self.rate => Verdict::NoneFinds { best: self.finds },
            None if self.runs < needed => Verdict::TooFewRuns { needed },
            None => Verdict::NoneQuiet { lowest: self.lowest },
        }
    }
}

/// Whether one finds contact sooner than another: by the median delay, then the 90 %, then the false alarms.
#[must_use]
pub fn sooner(one: &Point, other: &Point) -> bool {
    let order = |point: &Point| {
        let detection = point.detection?;
        // Not defined is later than anything.
        let ninety = if detection.ninety.is_nan() { f64::INFINITY } else { detection.ninety };
        Some([detection.median, ninety, point.false_alarms.rate.rate])
    };
    order(one) < order(other)
}
