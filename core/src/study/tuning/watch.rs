//! When each threshold would first have raised an alarm: all of them in one pass over a run.

use super::levels::Levels;
use super::sight::Sight;
use crate::detect::{Method as Detector, Statistic};
use crate::scenario::{Plan, Thresholds};
use crate::study::shared::Shared;
use serde::{Deserialize, Serialize};

/// How an alarm is raised: by one detector, or by a combination of several.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rule {
    /// By the fixed centrode deviation above ξ2.
    Fcd,
    /// By the joint force deviation above ξ1.
    Jfd,
    /// By either of the paper's detectors; levels are those of ξ2, the other thresholds are the scenario's.
    Or,
    /// By both of the paper's detectors at one instant; levels are those of ξ2, the other thresholds are the scenario's.
    And,
}

/// Which of its detectors a rule wants to see above their thresholds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wants {
    /// One, whichever it is.
    Any,
    /// Each of them at one instant.
    All,
}

impl Rule {
    /// All of them.
    pub const ALL: &'static [Self] = &[Self::Fcd, Self::Jfd, Self::Or, Self::And];

    /// Short name, as in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fcd => "fcd",
            Self::Jfd => "jfd",
            Self::Or => "or",
            Self::And => "and",
        }
    }

    /// The detectors that it looks at, and which of them it wants above their thresholds. The first is the one whose threshold
    /// takes every level; the others have the scenario's.
    #[must_use]
    pub fn alarm(self) -> (Wants, &'static [Detector]) {
        match self {
            Self::Fcd => (Wants::Any, &[Detector::Fcd]),
            Self::Jfd => (Wants::Any, &[Detector::Jfd]),
            Self::Or => (Wants::Any, Detector::PAPER),
            Self::And => (Wants::All, Detector::PAPER),
        }
    }

    /// The detector whose threshold takes every level.
    #[must_use]
    pub fn swept(self) -> Detector {
        self.alarm().1.first().copied().unwrap_or(Detector::Fcd)
    }

    /// The detectors whose thresholds are the scenario's.
    #[must_use]
    pub fn fixed(self) -> &'static [Detector] {
        self.alarm().1.get(1..).unwrap_or_default()
    }

    /// The levels of its threshold.
    #[must_use]
    pub fn levels(self, levels: &Levels) -> &[f64] {
        levels.of(self.swept())
    }

    /// Thresholds in which nothing is left that does not matter to its first alarms: rules that agree in them, in their levels
    /// and in all else that is set raise the same alarms.
    #[must_use]
    pub fn matters(self, thresholds: &Thresholds) -> Thresholds {
        let mut left = of_any_rule(thresholds);
        for detector in Detector::ALL {
            if *detector == self.swept() {
                detector.forget_setting(&mut left);
            } else if !self.fixed().contains(detector) {
                detector.forget(&mut left);
            }
        }
        left
    }
}

/// Thresholds in which nothing is left that matters to the first alarms of no rule.
#[must_use]
pub fn of_any_rule(thresholds: &Thresholds) -> Thresholds {
    // What ends an event does not matter to the first; and rules look at their own detectors, whichever judge.
    let Thresholds { release, hold, detectors, arming, .. } = Thresholds::default();
    let mut left = Thresholds { release, hold, detectors, arming, ..thresholds.clone() };
    for detector in Detector::ALL {
        if Rule::ALL.iter().any(|rule| rule.fixed().contains(detector)) {
            detector.tidy(&mut left);
        } else {
            detector.forget_setting(&mut left);
        }
    }
    left
}

/// No alarm.
pub const NEVER: u32 = u32::MAX;

/// What one run came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Firsts {
    /// By rule and level, the sample of the first alarm, or [`NEVER`].
    pub alarms: Vec<Vec<u32>>,
    /// Truth: the first sample in contact.
    pub contact: Option<u32>,
}

/// What is known of one detector so far: while its value does not count, everything stays as it was.
#[derive(Debug, Clone, Copy)]
struct Lamp {
    detector: Detector,
    /// The scenario's own setting; none while switched off.
    setting: Option<f64>,
    /// The value that counted last; below every threshold before the first.
    value: f64,
    /// The unit of levels then.
    unit: f64,
    /// Whether it lay above the scenario's own threshold.
    above: bool,
}

/// A rule, and how many of its levels have been crossed.
#[derive(Debug, Clone)]
struct Mark {
    wants: Wants,
    /// Places of the lamps: the one whose levels are crossed, and the others.
    swept: usize,
    fixed: Vec<usize>,
    crossed: usize,
}

/// What has been crossed so far in one run.
///
/// A threshold has raised its alarm once the value was above it, so the thresholds still silent are those above the
/// largest value so far: they are crossed in rising order, and one mark for each rule suffices.
#[derive(Debug, Clone)]
struct Watch<'a> {
    thresholds: &'a Thresholds,
    lamps: Vec<Lamp>,
    levels: Vec<&'a [f64]>,
    marks: Vec<Mark>,
    alarms: Vec<Vec<u32>>,
}

impl<'a> Watch<'a> {
    fn new(levels: &'a Levels, thresholds: &'a Thresholds) -> Self {
        let lamp = |&detector: &Detector| Lamp {
            detector,
            setting: detector.setting(thresholds),
            value: f64::NEG_INFINITY,
            unit: 1.0,
            above: false,
        };
        let place =
            |detector: Detector| Detector::PAPER.iter().position(|&known| known == detector).unwrap_or_default();
        let mark = |rule: &Rule| Mark {
            wants: rule.alarm().0,
            swept: place(rule.swept()),
            fixed: rule.fixed().iter().map(|&detector| place(detector)).collect(),
            crossed: 0,
        };
        let levels: Vec<_> = Rule::ALL.iter().map(|rule| rule.levels(levels)).collect();
        Self {
            thresholds,
            lamps: Detector::PAPER.iter().map(lamp).collect(),
            marks: Rule::ALL.iter().map(mark).collect(),
            alarms: levels.iter().map(|levels| vec![NEVER; levels.len()]).collect(),
            levels,
        }
    }

    /// Looks at the values of one sample; those that do not count leave the alarms as they were.
    fn look(&mut self, sample: u32, shape_bound: f64, mut sees: impl FnMut(Detector) -> Statistic) {
        for lamp in &mut self.lamps {
            if let Some(value) = sees(lamp.detector).counted() {
                (lamp.value, lamp.unit) = (value, lamp.detector.unit(self.thresholds, shape_bound));
                lamp.above = lamp.setting.is_some_and(|setting| value > setting * lamp.unit);
            }
        }
        let lamps = &self.lamps;
        for ((mark, levels), alarms) in self.marks.iter_mut().zip(&self.levels).zip(&mut self.alarms) {
            let mut fixed = mark.fixed.iter().map(|&place| lamps[place].above);
            let Lamp { value, unit, .. } = lamps[mark.swept];
            // Whether the others decide by themselves.
            let decided = match mark.wants {
                Wants::Any => fixed.any(|above| above).then_some(true),
                Wants::All => fixed.any(|above| !above).then_some(false),
            };
            while let Some(level) = levels.get(mark.crossed)
                && decided.unwrap_or_else(|| value > level * unit)
            {
                alarms[mark.crossed] = sample;
                mark.crossed += 1;
            }
        }
    }
}

/// Runs a plan and says when each level of each rule was first crossed. `shared` is what the plan's repeats have in common.
#[must_use]
pub fn first_alarms(plan: &Plan, levels: &Levels, shared: &Shared) -> Firsts {
    let thresholds = &plan.scenario().detection;
    let mut watch = Watch::new(levels, thresholds);
    let mut sight = Sight::new(plan, shared);
    let script = shared.script();
    for (k, (step, reading)) in script.steps().iter().zip(script.readings(plan)).enumerate() {
        sight.take(k, step, &reading);
        if step.time >= thresholds.armed_from {
            watch.look(k as u32, shared.expectation(k).shape_bound, |detector| sight.sees(detector, k, step));
        }
    }
    Firsts { alarms: watch.alarms, contact: script.contact_sample().map(|sample| sample as u32) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::Standing;
    use crate::scenario::{Arming, Detectors, Scenario, Threshold};

    #[test]
    fn any_and_all_are_made_of_what_each_detector_sees() {
        let scenario = Scenario::default();
        let thresholds = Thresholds { xi1: Threshold::On(0.02), ..scenario.detection };
        let mut levels = Levels::default();
        levels.put(Detector::Fcd, vec![0.004, 0.006]);
        levels.put(Detector::Jfd, vec![0.01, 0.03]);
        let mut watch = Watch::new(&levels, &thresholds);
        let silent = f64::NAN;
        for (sample, (deviation, residual)) in
            [(0.003, 0.0), (0.005, 0.01), (silent, 0.025), (0.001, silent), (0.007, silent), (0.0, 0.04)]
                .iter()
                .enumerate()
        {
            watch.look(sample as u32, 0.0, |detector| {
                let value = if detector == Detector::Fcd { *deviation } else { *residual };
                let standing = if value.is_nan() { Standing::Silent } else { Standing::Counts };
                Statistic { value, standing }
            });
        }
        // Or: the forces alarm at 2 for all that the centrode has not; and: at 2 the centrode's last value still stands.
        let expected = [[1, 4], [2, 5], [1, 2], [2, 4]];
        for (rule, expected) in Rule::ALL.iter().zip(expected) {
            assert_eq!(watch.alarms[*rule as usize], expected, "{rule:?}");
        }
    }

    #[test]
    fn the_first_alarm_of_a_rule_depends_on_what_matters_to_it_alone() {
        let before = Thresholds::default();
        let xi1 = Thresholds { xi1: Threshold::On(0.05), xi1_factor: 3.0, hold: 1.0, ..before.clone() };
        let xi2 = Thresholds { xi2: Threshold::On(0.001), ..before.clone() };
        let speed = Thresholds { min_speed: 0.1, ..before.clone() };
        let mut others = Thresholds { detectors: Detectors::NONE, arming: Arming::All, ..before.clone() };
        for &detector in Detector::ALL.iter().filter(|detector| !detector.is_of_paper()) {
            *others.of_mut(detector) = Threshold::OFF;
        }
        for &rule in Rule::ALL {
            let same = |other: &Thresholds| rule.matters(other) == rule.matters(&before);
            assert_eq!(same(&xi1), matches!(rule, Rule::Fcd | Rule::Jfd), "{rule:?}");
            assert!(same(&xi2) && same(&others) && !same(&speed), "{rule:?}");
        }
    }
}
