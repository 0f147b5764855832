//! Which threshold to take, in which cell.

use super::rate::runs_to_show;
use super::watch::Rule;
use super::{Point, Study};
use serde::Serialize;

/// What is wished for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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
    let (mut runs, mut lowest, mut finds) = (0, f64::INFINITY, 0.0f64);
    let mut best: Option<(usize, usize, Point)> = None;
    let mut contact = false;
    for cell in cells {
        let (free, held) = study.runs(cell, wish.rule);
        runs = runs.max(free);
        // Whether the robot reaches the beam, the first run will say.
        contact = contact || held.is_some_and(|held| held == 0 || study.contact_time(cell).is_some());
        for (level, point) in study.curve(cell, wish.rule).into_iter().enumerate() {
            let upper = point.false_alarms.rate.high;
            lowest = lowest.min(upper);
            let Some(detection) = point.detection.filter(|_| upper <= wish.false_alarm_rate) else { continue };
            finds = finds.max(detection.detected.rate);
            if detection.median.is_nan() {
                continue;
            }
            if best.as_ref().is_none_or(|(_, _, best)| sooner(&point, best)) {
                best = Some((cell, level, point));
            }
        }
    }
    match best {
        Some((cell, level, point)) => Verdict::Take { cell, level, point: Box::new(point) },
        None if !contact => Verdict::NoContact,
        None if lowest <= wish.false_alarm_rate => Verdict::NoneFinds { best: finds },
        None if runs < runs_to_show(wish.false_alarm_rate) => {
            Verdict::TooFewRuns { needed: runs_to_show(wish.false_alarm_rate) }
        }
        None => Verdict::NoneQuiet { lowest },
    }
}

fn sooner(one: &Point, other: &Point) -> bool {
    let order = |point: &Point| {
        let detection = point.detection?;
        // Not defined is later than anything.
        let ninety = if detection.ninety.is_nan() { f64::INFINITY } else { detection.ninety };
        Some([detection.median, ninety, point.false_alarms.rate.rate])
    };
    order(one) < order(other)
}
