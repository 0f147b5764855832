//! What a person sets of an experiment with several segments.

use crate::model::chain::Torsion;
use crate::model::chain::path::Stands;
use crate::scenario::motion::from_rest_to_rest;
use crate::scenario::{Motion, Plan, Scenario, ScenarioError, motion};

/// An experiment with segments in series. What is said of the tracker, filters, detection and calibration holds for every segment.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainScenario {
    /// From the base; at least one.
    pub segments: Vec<ChainSegment>,
    /// What the backbone meets.
    pub contacts: Vec<ChainContact>,
    /// Which end disks carry trackers.
    pub tracked: Tracked,
    /// Thresholds of the screw motion deviation; none where it does not judge.
    pub smd: Option<Smd>,
}

/// A segment of a chain, with its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainSegment {
    /// An experiment with this segment alone, free: robot, motion of θL, and beside them all that is common to the segments.
    pub alone: Plan,
    /// Angle γ by which its secondary backbones are turned on the pitch circle, rad.
    pub joint_offset: f64,
    /// Stiffness in torsion.
    pub torsion: Torsion,
    /// δ after the motion, rad; before it, it is that of `alone`.
    pub delta_end: f64,
    /// When δ starts to move, s.
    pub delta_start: f64,
    /// When it is there, s.
    pub delta_finish: f64,
}

/// What a chain meets.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainContact {
    /// The segment, from 0.
    pub segment: usize,
    /// Arc length from that segment's base, m.
    pub at: f64,
    /// Where it stands, and since when.
    pub stands: Stands,
}

/// Which end disks carry trackers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tracked {
    /// Every segment's.
    #[default]
    All,
    /// That of the last segment alone.
    Tip,
}

/// Thresholds of the screw motion deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smd {
    /// Of the distance of the screw axes at the disk below, m.
    pub distance: f64,
    /// Of the angle between them, rad.
    pub angle: f64,
}

impl Default for Smd {
    fn default() -> Self {
        Self { distance: 0.003_5, angle: std::f64::consts::PI / 36.0 }
    }
}

/// Seeds of the segments' own errors are this far apart.
const APART: u64 = 0x9E37_79B9_7F4A_7C15;

/// The seed of a segment's own errors and tracker, from that of the experiment.
pub(super) fn seed_of(seed: u64, segment: usize) -> u64 {
    seed.wrapping_add(APART.wrapping_mul(segment as u64))
}

impl ChainSegment {
    /// What is told to θL.
    #[must_use]
    pub fn motion(&self) -> &Motion {
        &self.alone.scenario().motion
    }

    /// θL and δ commanded at a time (s), and their rates (rad/s).
    #[must_use]
    pub fn command(&self, time: f64) -> [(f64, f64); 2] {
        let delta = self.motion().delta;
        let turn = from_rest_to_rest(delta, self.delta_end, self.delta_start, self.delta_finish, time);
        [motion::command(self.motion(), time), turn]
    }

    /// Whether nothing is told to it that moves it after a time (s).
    #[must_use]
    pub fn rests_after(&self, time: f64) -> bool {
        let motion = self.motion();
        let bends = motion.theta_start != motion.theta_end && motion.finish > time;
        let turns = motion.delta != self.delta_end && self.delta_finish > time;
        !bends && !turns
    }

    /// The instants between which its motion is smooth, s.
    pub fn knots(&self) -> [f64; 4] {
        [self.motion().start, self.motion().finish, self.delta_start, self.delta_finish]
    }
}

impl ChainScenario {
    /// All that is common to the segments.
    #[must_use]
    pub fn common(&self) -> &Scenario {
        self.segments[0].alone.scenario()
    }

    /// The same without what the backbone meets.
    #[must_use]
    pub fn without_contacts(&self) -> Self {
        Self { contacts: Vec::new(), ..self.clone() }
    }

    /// The same with a loop of this rate, Hz.
    ///
    /// # Errors
    /// When it is not allowed.
    pub fn at_rate(&self, loop_rate: f64) -> Result<Self, ScenarioError> {
        let mut rated = self.clone();
        for segment in &mut rated.segments {
            segment.alone = Plan::new(&Scenario { loop_rate, ..segment.alone.scenario().clone() })?;
        }
        Ok(rated)
    }

    /// The same with another seed.
    #[must_use]
    pub fn with_seed(&self, seed: u64) -> Self {
        let mut seeded = self.clone();
        for (place, segment) in seeded.segments.iter_mut().enumerate() {
            segment.alone = segment.alone.with_seed(seed_of(seed, place));
        }
        seeded
    }
}
