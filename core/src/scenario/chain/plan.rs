//! An experiment with several segments, resolved: what follows cannot fail.

use super::inputs::{ChainContact, ChainScenario, ChainSegment};
use crate::model::Configuration;
use crate::model::chain::path::{Path, Plane, Stands};
use crate::model::chain::{Bends, Rod, Unsettled, bends, stiffnesses};
use crate::model::configuration::bend_from_theta_l;
use crate::scenario::TrueRobot;
use libm::floor;
use std::sync::Arc;

/// An experiment that can be run: the motion of the true robot against what it meets.
#[derive(Debug, Clone)]
pub struct ChainPlan {
    scenario: ChainScenario,
    robot: Robot,
    path: Arc<Path>,
    samples: usize,
}

/// The true robot of a chain.
#[derive(Debug, Clone)]
struct Robot {
    segments: Vec<ChainSegment>,
    truths: Vec<TrueRobot>,
}

impl Robot {
    /// What a segment is told at a time (s).
    fn commanded(&self, segment: usize, time: f64) -> Configuration {
        let [(theta_l, _), (delta, _)] = self.segments[segment].command(time);
        Configuration::new(bend_from_theta_l(theta_l), delta)
    }

    /// What the joints of the true robot come to at a time (s).
    fn bends(&self, time: f64) -> Vec<Bends> {
        let truths = self.truths.iter().enumerate();
        truths.map(|(segment, truth)| bends(truth.configuration(self.commanded(segment, time)))).collect()
    }

    /// The instants between which all that is smooth: where motions begin and end, and where play is taken up.
    fn knots(&self, end: f64) -> Vec<f64> {
        let mut knots = vec![0.0, end];
        for (segment, truth) in self.segments.iter().zip(&self.truths) {
            knots.extend(segment.knots());
            knots.extend(taken_up(segment, truth));
        }
        knots.retain(|knot| (0.0..=end).contains(knot));
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        knots
    }
}

/// When a segment's play is taken up, s.
fn taken_up(segment: &ChainSegment, truth: &TrueRobot) -> Option<f64> {
    let (play, motion) = (truth.errors().play, segment.motion());
    let moved = |time: f64| (segment.command(time)[0].0 - motion.theta_start).abs();
    if play <= 0.0 || moved(motion.finish) <= play {
        return None;
    }
    let (mut low, mut high) = (motion.start, motion.finish);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if moved(middle) < play { low = middle } else { high = middle }
    }
    Some(high)
}

impl ChainPlan {
    /// Follows the true robot through its motion. The scenario was read, and so checked.
    ///
    /// # Errors
    /// Where the robot has no stable shape as it begins.
    pub fn new(scenario: &ChainScenario) -> Result<Self, Unsettled> {
        let truths: Vec<TrueRobot> = scenario.segments.iter().map(|segment| *segment.alone.true_robot()).collect();
        let robot = Robot { segments: scenario.segments.clone(), truths };
        let end = scenario.common().motion.end;
        let course = |time: f64| robot.bends(time);
        let planes: Vec<Plane> = scenario.contacts.iter().map(|contact| plane(contact, &robot)).collect();
        let path = Path::new(&rods(scenario, &robot.truths), &course, &robot.knots(end), &planes)?;
        let rate = scenario.common().loop_rate;
        let samples = floor(path.end() * rate + 1e-6) as usize + 1;
        Ok(Self { scenario: scenario.clone(), robot, path: Arc::new(path), samples })
    }

    /// What was asked for.
    #[must_use]
    pub fn scenario(&self) -> &ChainScenario {
        &self.scenario
    }

    /// The motion of the true robot.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What a segment is told at a time (s), and the rates of θL and δ (rad/s).
    #[must_use]
    pub fn command(&self, segment: usize, time: f64) -> (Configuration, [f64; 2]) {
        let [(_, theta_l), (_, delta)] = self.robot.segments[segment].command(time);
        (self.robot.commanded(segment, time), [theta_l, delta])
    }

    /// The bends of the true robot at a time (s), rad.
    #[must_use]
    pub fn bends(&self, time: f64) -> Vec<Bends> {
        self.robot.bends(time)
    }

    /// Number of loop samples, from t = 0 to the end or to where the chain buckles.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Time of sample `k`, s.
    #[must_use]
    pub fn time(&self, k: usize) -> f64 {
        k as f64 / self.scenario.common().loop_rate
    }
}

/// The true rods: distal backbones run inside proximal ones.
fn rods(scenario: &ChainScenario, truths: &[TrueRobot]) -> Vec<Rod> {
    let tubes: Vec<(f64, f64)> = scenario
        .segments
        .iter()
        .map(|segment| {
            let robot = &segment.alone.scenario().robot;
            (robot.primary.bending_stiffness(), robot.secondary.bending_stiffness())
        })
        .collect();
    let each = scenario.segments.iter().zip(truths).zip(stiffnesses(&tubes));
    each.map(|((segment, truth), bending_stiffness)| Rod {
        length: truth.segment().length,
        bending_stiffness,
        torsion: segment.torsion,
    })
    .collect()
}

fn plane(contact: &ChainContact, robot: &Robot) -> Plane {
    let ChainContact { segment, at, stands } = *contact;
    // A place is told on the nominal backbone, up to its end disk.
    let nominal = robot.segments[segment].alone.scenario().robot.length;
    let length = robot.truths[segment].segment().length;
    let at = if at == nominal { length } else { at.min(length) };
    let (Stands::From { time, .. } | Stands::Clamped { time }) = stands else {
        return Plane { segment, at, delta: 0.0, stands };
    };
    Plane { segment, at, delta: robot.commanded(segment, time).delta(), stands }
}
