//! When each threshold would first have raised an alarm: all of them in one pass over a run.

use super::levels::Levels;
use crate::detect::evidence::deviation;
use crate::detect::filter::PoseFilter;
use crate::detect::{Method as Detector, Standing, Statistic};
use crate::scenario::{Plan, Thresholds, Xi1Rule};
use crate::sensors::cells::SimulatedCells;
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
    /// By either; levels are those of ξ2, ξ1 is the scenario's.
    Or,
    /// By both being above at one instant; levels are those of ξ2, ξ1 is the scenario's.
    And,
}

impl Rule {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Fcd, Self::Jfd, Self::Or, Self::And];

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

    /// The detectors that it looks at.
    #[must_use]
    pub fn detectors(self) -> &'static [Detector] {
        match self {
            Self::Fcd => &[Detector::Fcd],
            Self::Jfd => &[Detector::Jfd],
            Self::Or | Self::And => &[Detector::Fcd, Detector::Jfd],
        }
    }

    /// The levels of its threshold: those of the first of its detectors.
    #[must_use]
    pub fn levels(self, levels: &Levels) -> &[f64] {
        match self.detectors().first() {
            Some(Detector::Jfd) => &levels.xi1,
            _ => &levels.xi2,
        }
    }
}

/// No alarm.
pub const NEVER: u32 = u32::MAX;

/// By rule and level, the sample of the first alarm, or [`NEVER`].
pub type Firsts = Vec<Vec<u32>>;

/// What has been crossed so far in one run.
///
/// A threshold has raised its alarm once the value was above it, so the thresholds still silent are those above the
/// largest value so far: they are crossed in rising order, and one mark for each rule suffices.
#[derive(Debug, Clone)]
struct Watch<'a> {
    levels: &'a Levels,
    thresholds: &'a Thresholds,
    firsts: Firsts,
    /// By rule, how many of its levels have been crossed.
    crossed: Vec<usize>,
    /// The centrode deviation last looked at: the alarm keeps its state while nothing is judged.
    deviation: f64,
    forces_above: bool,
}

impl<'a> Watch<'a> {
    fn new(levels: &'a Levels, thresholds: &'a Thresholds) -> Self {
        Self {
            levels,
            thresholds,
            firsts: Rule::ALL.iter().map(|rule| vec![NEVER; rule.levels(levels).len()]).collect(),
            crossed: vec![0; Rule::ALL.len()],
            deviation: f64::NEG_INFINITY,
            forces_above: false,
        }
    }

    /// Looks at both values of one sample; those that do not count leave the alarms as they were.
    fn look(&mut self, sample: u32, [deviation, residual]: [Statistic; 2], shape_bound: f64) {
        if let Some(residual) = residual.counted() {
            let unit = match self.thresholds.xi1_rule {
                Xi1Rule::Constant => 1.0,
                Xi1Rule::Bound => shape_bound,
            };
            self.raise(Rule::Jfd, sample, |level| residual > level * unit);
            self.forces_above = self.thresholds.xi1_at(shape_bound).is_some_and(|xi1| residual > xi1);
        }
        if let Some(deviation) = deviation.counted() {
            self.deviation = deviation;
            self.raise(Rule::Fcd, sample, |level| deviation > level);
            self.raise(Rule::Or, sample, |level| deviation > level);
        }
        if self.forces_above {
            self.raise(Rule::Or, sample, |_| true);
            let deviation = self.deviation;
            self.raise(Rule::And, sample, |level| deviation > level);
        }
    }

    fn raise(&mut self, rule: Rule, sample: u32, above: impl Fn(f64) -> bool) {
        let (levels, which) = (rule.levels(self.levels), rule as usize);
        let crossed = &mut self.crossed[which];
        while *crossed < levels.len() && above(levels[*crossed]) {
            self.firsts[which][*crossed] = sample;
            *crossed += 1;
        }
    }
}

/// Runs a plan and says when each level of each rule was first crossed. `shared` is what the plan's repeats have in common.
#[must_use]
pub fn first_alarms(plan: &Plan, levels: &Levels, shared: &Shared) -> Firsts {
    let scenario = plan.scenario();
    let (segment, thresholds) = (plan.segment(), &scenario.detection);
    let mut watch = Watch::new(levels, thresholds);
    let mut filter = PoseFilter::new(&scenario.filter, scenario.loop_rate);
    let mut cells = SimulatedCells::new(plan);
    let script = shared.script();
    for (k, (step, reading)) in script.steps().iter().zip(script.readings(plan)).enumerate() {
        filter.take(&reading);
        let known = shared.residual(k);
        let tau_lc = if known.is_none() { Some(cells.read(&step.tau)) } else { None };
        if step.time < thresholds.armed_from {
            continue;
        }
        let expected = shared.expectation(k);
        let residual = match (known, tau_lc) {
            (Some(residual), _) => residual,
            (None, Some(tau_lc)) => expected.residual(segment, &step.configuration, &tau_lc),
            (None, None) => f64::NAN,
        };
        let standing = Detector::Jfd.standing(residual, 0.0, step.time, thresholds);
        let forces = Statistic { value: residual, standing };
        let centrode = if filter.turns_at_most(thresholds.min_speed) {
            Statistic { value: f64::NAN, standing: Standing::Silent }
        } else {
            let motion = filter.motion();
            let (_, value) = deviation(&expected.centrode, &motion);
            let speed = motion.twist.angular.norm();
            Statistic { value, standing: Detector::Fcd.standing(value, speed, step.time, thresholds) }
        };
        watch.look(k as u32, [centrode, forces], expected.shape_bound);
    }
    watch.firsts
}
