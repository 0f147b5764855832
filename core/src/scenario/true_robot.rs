//! The robot as it truly is, against the nominal one of the model.

use crate::model::configuration::bend_from_theta_l;
use crate::model::orientation::from_vector;
use crate::model::{Configuration, Mat3, Pose, Segment, Vec3};
use crate::noise::{Normal, Source};
use crate::scenario::{Calibration, Draw, Scenario};

/// No drawn error exceeds so many standard deviations.
pub const MOST_DEVIATIONS: f64 = 4.0;
/// Relative errors of length and bend go this far.
const MOST_SHARE: f64 = 0.5;

/// The true robot and tracker of a scenario.
///
/// With no error every answer is the nominal one to the bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrueRobot {
    segment: Segment,
    /// Commanded bend before the motion, rad.
    start: f64,
    /// The errors themselves, whether they were drawn or not.
    errors: Calibration,
    /// What the tracker's frame is turned by; none where it is not.
    turn: Option<Mat3>,
}

impl TrueRobot {
    /// That of a scenario under its seed.
    #[must_use]
    pub fn of(scenario: &Scenario) -> Self {
        let calibration = scenario.calibration;
        let errors = if calibration.is_drawn() { drawn(&calibration, scenario.seed) } else { calibration };
        Self::with(scenario, errors)
    }

    /// The robot of a scenario without any error.
    #[must_use]
    pub fn nominal(scenario: &Scenario) -> Self {
        Self::with(scenario, Calibration::default())
    }

    fn with(scenario: &Scenario, errors: Calibration) -> Self {
        let mut segment = scenario.robot.segment();
        segment.length *= 1.0 + errors.length;
        let turn = (errors.frame_turn != [0.0; 3]).then(|| from_vector(&errors.frame_turn.into()));
        Self { segment, start: bend_from_theta_l(scenario.motion.theta_start), errors, turn }
    }

    /// The true segment.
    #[must_use]
    pub fn segment(&self) -> &Segment {
        &self.segment
    }

    /// The errors; drawn ones as they came out.
    #[must_use]
    pub fn errors(&self) -> &Calibration {
        &self.errors
    }

    /// The true bend (rad) at a commanded one of the motion.
    ///
    /// Before the motion the play lies on the side to which the motion goes, so that the true bend lags by all of it.
    #[must_use]
    pub fn bend(&self, commanded: f64) -> f64 {
        let Calibration { play, bend_scale, bend_offset, .. } = self.errors;
        let followed = if play > 0.0 {
            let moved = commanded - self.start;
            self.start + (moved.abs() - play).max(0.0).copysign(moved)
        } else {
            commanded
        };
        if (bend_scale, bend_offset) == (0.0, 0.0) { followed } else { (1.0 + bend_scale) * followed + bend_offset }
    }

    /// The true configuration at a commanded one of the motion.
    #[must_use]
    pub fn configuration(&self, commanded: Configuration) -> Configuration {
        let bend = self.bend(commanded.bend());
        match self.errors.delta {
            0.0 => commanded.with_bend(bend),
            error => Configuration::new(bend, commanded.delta() + error),
        }
    }

    /// True age (s) of a reading that is to be `latency` (s) old: never less than 0.
    #[must_use]
    pub fn age(&self, latency: f64) -> f64 {
        (latency + self.errors.latency).max(0.0)
    }

    /// A pose in {B} as the tracker's own frame has it.
    #[must_use]
    pub fn seen(&self, mut pose: Pose) -> Pose {
        if let Some(turn) = &self.turn {
            pose = Pose { position: turn * pose.position, rotation: turn * pose.rotation };
        }
        if self.errors.frame != [0.0; 3] {
            pose.position += Vec3::from(self.errors.frame);
        }
        pose
    }

    /// What true robots of a scenario lie between: one where nothing is drawn, else those at the most that length, scale and offset
    /// may be off. `keep` says which of the three count.
    fn extremes(scenario: &Scenario, keep: [bool; 3]) -> impl Iterator<Item = Self> {
        let calibration = scenario.calibration;
        let (corners, most) = if calibration.draw == Draw::Drawn { (8, MOST_DEVIATIONS) } else { (1, 1.0) };
        (0..corners).map(move |corner| {
            let error = |place: usize, size: f64| match (keep[place], corner >> place & 1) {
                (false, _) => 0.0,
                (true, 0) => most * size,
                (true, _) => -most * size,
            };
            let errors = Calibration {
                length: error(0, calibration.length),
                bend_scale: error(1, calibration.bend_scale),
                bend_offset: error(2, calibration.bend_offset),
                ..Calibration::default()
            };
            Self::with(scenario, errors)
        })
    }

    /// The path of the first of length, scale and offset with which one of the true robots is refused.
    pub(super) fn refused(scenario: &Scenario, fault: impl Fn(&Self) -> bool) -> Option<&'static str> {
        let steps = [
            ("calibration.length", [true, false, false]),
            ("calibration.bend_scale", [true, true, false]),
            ("calibration.bend_offset", [true, true, true]),
        ];
        let beyond = |robot: &Self| robot.errors.length.abs().max(robot.errors.bend_scale.abs()) > MOST_SHARE;
        let bad = |robot: &Self| beyond(robot) || fault(robot);
        steps
            .into_iter()
            .find(|(_, keep)| Self::extremes(scenario, *keep).any(|robot| bad(&robot)))
            .map(|(path, _)| path)
    }
}

/// Errors with these standard deviations, drawn from a seed. Each has its own draw, whatever the others are.
fn drawn(sizes: &Calibration, seed: u64) -> Calibration {
    let mut normal = Normal::new(seed, Source::Calibration);
    let mut error = |size: f64| size * normal.draw().clamp(-MOST_DEVIATIONS, MOST_DEVIATIONS);
    Calibration {
        frame: sizes.frame.map(&mut error),
        frame_turn: sizes.frame_turn.map(&mut error),
        length: error(sizes.length),
        bend_scale: error(sizes.bend_scale),
        bend_offset: error(sizes.bend_offset),
        delta: error(sizes.delta),
        latency: error(sizes.latency),
        draw: Draw::Fixed,
        ..*sizes
    }
}
