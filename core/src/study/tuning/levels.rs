//! The thresholds that a study looks at, all in one pass over each run.

use crate::detect::Method;
use crate::model::Configuration;
use crate::scenario::{Scenario, Thresholds, Xi1Rule};
use libm::{floor, log10};
use serde::{Deserialize, Serialize};

/// Levels from one step up, and above them coarser ones.
const FINE: u64 = 200;
const COARSE: u64 = 10;
const COARSE_COUNT: u64 = 40;

/// Thresholds by detector, rising: ξ2 in m; ξ1 in N·m while it is a constant, or k in k·ε_c while it follows the shape.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Levels(Vec<(Method, Vec<f64>)>);

impl Levels {
    /// Levels that suit a scenario's robot, in round steps.
    ///
    /// ξ2 goes up in steps of about L/300 (0.1 mm for the paper's robot), ξ1 in steps of about a hundredth of the bending
    /// moment at one radian (1 mN·m), k in steps of 0.05: 200 steps, then 40 tenfold ones.
    #[must_use]
    pub fn usual(scenario: &Scenario) -> Self {
        let segment = scenario.robot.segment();
        let moment = segment.energy_gradient(&Configuration::new(1.0, 0.0)).theta_l.abs();
        let xi1 = match scenario.detection.xi1_rule {
            Xi1Rule::Constant => round_unit(moment / 100.0),
            Xi1Rule::Bound => (5, -2),
        };
        let steps = [(Method::Fcd, round_unit(segment.length / 300.0)), (Method::Jfd, xi1)];
        Self(steps.map(|(detector, step)| (detector, rising(step))).into())
    }

    /// The levels of a detector; empty where it has none.
    #[must_use]
    pub fn of(&self, detector: Method) -> &[f64] {
        self.0.iter().find(|(known, _)| *known == detector).map_or(&[], |(_, levels)| levels)
    }

    /// Gives a detector other levels, rising.
    pub fn put(&mut self, detector: Method, levels: Vec<f64>) {
        match self.0.iter_mut().find(|(known, _)| *known == detector) {
            Some((_, known)) => *known = levels,
            None => self.0.push((detector, levels)),
        }
    }

    /// The same, with the levels that `other` has in place of its own.
    #[must_use]
    pub fn replaced(mut self, other: &Self) -> Self {
        other.0.iter().for_each(|(detector, levels)| self.put(*detector, levels.clone()));
        self
    }

    /// The same, with what a scenario sets among them.
    #[must_use]
    pub fn with_own(mut self, thresholds: &Thresholds) -> Self {
        for (detector, levels) in &mut self.0 {
            with(levels, detector.setting(thresholds));
        }
        self
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is at most `most`, as that factor and power.
fn round_unit(most: f64) -> (u64, i32) {
    // A hair of room, so that 0.03/300 is the step of 1e-4 that it means.
    let most = most * (1.0 + 1e-9);
    let power = floor(log10(most)) as i32;
    let factor = [5, 2].into_iter().find(|&factor| scaled(factor, power) <= most).unwrap_or(1);
    (factor, power)
}

/// `value · 10^power`, the double nearest to it as a person would type it.
fn scaled(value: u64, power: i32) -> f64 {
    format!("{value}e{power}").parse().unwrap_or(f64::NAN)
}

fn rising((factor, power): (u64, i32)) -> Vec<f64> {
    let fine = 1..=FINE;
    let coarse = (1..=COARSE_COUNT).map(|k| FINE + k * COARSE);
    fine.chain(coarse).map(|k| scaled(k * factor, power)).collect()
}

/// Puts a level in its place, unless it is there.
fn with(levels: &mut Vec<f64>, own: Option<f64>) {
    if let Some(own) = own
        && let Err(place) = levels.binary_search_by(|level| level.total_cmp(&own))
    {
        levels.insert(place, own);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Threshold;

    #[test]
    fn levels_of_the_papers_robot_are_those_of_its_sliders() {
        let levels = Levels::usual(&Scenario::default());
        let [xi2, xi1] = [Method::Fcd, Method::Jfd].map(|detector| levels.of(detector));
        assert_eq!(xi2[..3], [1e-4, 2e-4, 3e-4]);
        assert_eq!(xi2[69], 0.007);
        assert_eq!(xi2.len(), 240);
        assert_eq!(xi1[..2], [0.001, 0.002]);
        assert!(xi1.contains(&0.03));
    }

    #[test]
    fn the_scenarios_own_threshold_is_among_them_whatever_the_robot() {
        let mut scenario = Scenario::default();
        scenario.detection.xi2 = Threshold::On(0.007_123);
        scenario.detection.xi1_rule = Xi1Rule::Bound;
        scenario.detection.xi1_factor = 1.234;
        for length in [1e-3, 0.03, 0.1, 7.7, 100.0] {
            scenario.robot.length = length;
            let levels = Levels::usual(&scenario).with_own(&scenario.detection);
            for (detector, own) in [(Method::Fcd, 0.007_123), (Method::Jfd, 1.234)] {
                let values = levels.of(detector);
                assert!(values.contains(&own), "{detector:?}: {values:?}");
                assert!(values.is_sorted_by(|a, b| a < b) && values[0] > 0.0, "{values:?}");
            }
        }
    }

    #[test]
    fn levels_that_are_given_replace_the_usual_ones_of_their_detector() {
        let mut given = Levels::default();
        given.put(Method::Jfd, vec![0.01, 0.02]);
        let usual = Levels::usual(&Scenario::default());
        let levels = usual.clone().replaced(&given);
        assert_eq!(levels.of(Method::Jfd), [0.01, 0.02]);
        assert_eq!(levels.of(Method::Fcd), usual.of(Method::Fcd));
    }

    #[test]
    fn steps_are_one_two_or_five() {
        assert_eq!(
            [0.0001, 0.00019, 0.0002, 0.0009, 3.0].map(round_unit),
            [(1, -4), (1, -4), (2, -4), (5, -4), (2, 0)]
        );
    }
}
