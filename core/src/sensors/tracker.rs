//! The tracker: a marker's position and Euler angles, refreshed, aged, disturbed, rounded and held.

mod disturbance;

use crate::model::orientation::{from_euler, to_euler};
use crate::model::{Mat3, Pose, Vec3};
use crate::scenario::{Mounting, Plan, Tracker, TrueRobot};
use disturbance::{Coloured, Drift};
use libm::{floor, rint, sincos};
use std::f64::consts::{PI, TAU};

/// One reading of the tracker: x_s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Position of the marker, which sits at the centre of the end disk, in {B}, m.
    pub position: Vec3,
    /// Azimuth, elevation, roll of the marker in {B}, rad; whole turns are kept from reading to reading.
    pub angles: [f64; 3],
}

/// The simulated tracker.
#[derive(Debug, Clone)]
pub struct SimulatedTracker {
    settings: Tracker,
    /// R̃_gᵀ: `tip_from_marker`.
    tip_from_marker: Mat3,
    robot: TrueRobot,
    noise: Coloured,
    drift: Drift,
    held: Option<(f64, Reading)>,
}

impl SimulatedTracker {
    /// The tracker of a plan.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let scenario = plan.scenario();
        let tip_from_marker = tip_from_marker(scenario.tracker.mounting, scenario.motion.delta);
        Self {
            settings: scenario.tracker.clone(),
            tip_from_marker,
            robot: *plan.true_robot(),
            noise: Coloured::new(scenario.seed, scenario.calibration.colour),
            drift: Drift::new(scenario.seed, &scenario.calibration),
            held: None,
        }
    }

    /// The tracker on the end disk of one segment of several, whose plan alone this is: what is wrong with the frame of all of them, and when
    /// they read, is as `shared` has it, the plan of the first segment.
    #[must_use]
    pub fn one_of(shared: &Plan, plan: &Plan) -> Self {
        let drift = Drift::new(shared.scenario().seed, &shared.scenario().calibration);
        Self { robot: *shared.true_robot(), drift, ..Self::new(plan) }
    }

    /// The reading that the loop sees at `time` (s). When it is a new one, `tip` gives the pose of the end disk in {B} at the time
    /// (s) at which it was taken.
    pub fn read(&mut self, time: f64, tip: impl FnOnce(f64) -> Pose) -> Reading {
        let refresh = refresh(self.settings.rate, time);
        if let Some((at, reading)) = self.held
            && at == refresh
        {
            return reading;
        }
        let taken = (refresh / self.settings.rate).min(time) - self.robot.age(self.settings.latency);
        let reading = self.measure(refresh / self.settings.rate, tip(taken.max(0.0)));
        self.held = Some((refresh, reading));
        reading
    }

    /// What is read at a refresh at `time` (s) of a marker whose end disk is at `tip` in {B}.
    fn measure(&mut self, time: f64, tip: Pose) -> Reading {
        let settings = &self.settings;
        let tip = self.robot.seen(tip);
        let drifted = match self.drift.at(time) {
            Some(drift) => tip.position + drift,
            None => tip.position,
        };
        let noise = self.noise.position(settings.position_noise);
        let position = drifted.zip_map(&noise, |x, noise| rounded(x + noise, settings.position_resolution));
        let mut rotation = tip.rotation * self.tip_from_marker;
        if settings.orientation_noise > 0.0 {
            rotation = from_euler(&self.noise.orientation(settings.orientation_noise).into()) * rotation;
        }
        let mut angles = to_euler(&rotation).map(|angle| rounded(angle, settings.orientation_resolution));
        if let Some((_, before)) = &self.held {
            for (angle, before) in angles.iter_mut().zip(before.angles) {
                *angle = unwrapped(*angle, before);
            }
        }
        Reading { position, angles }
    }
}

/// How a marker is mounted on the end disk of a robot that bends in the plane `delta` (rad): R̃_gᵀ.
#[must_use]
pub fn tip_from_marker(mounting: Mounting, delta: f64) -> Mat3 {
    match mounting {
        Mounting::Aligned => Mat3::identity(),
        Mounting::BendingAxis => {
            // Turned about the tangent until x is the bending axis (sin δ, cos δ, 0).
            let (s, c) = sincos(delta);
            Mat3::new(s, -c, 0.0, c, s, 0.0, 0.0, 0.0, 1.0)
        }
    }
}

/// Which of the refreshes of a tracker of `rate` Hz is the last at `time` (s), from 0.
#[must_use]
pub fn refresh(rate: f64, time: f64) -> f64 {
    // A time one rounding error before a refresh is the refresh.
    floor(time * rate * (1.0 + 4.0 * f64::EPSILON))
}

/// The multiple of `step` nearest to `value`; `value` itself for a step of 0 or too small to count.
fn rounded(value: f64, step: f64) -> f64 {
    let steps = rint(value / step);
    if step > 0.0 && steps.is_finite() { step * steps } else { value }
}

/// `angle` plus the whole turns that bring it nearest to `before`, rad.
#[must_use]
pub fn unwrapped(angle: f64, before: f64) -> f64 {
    if (angle - before).abs() <= PI { angle } else { angle + TAU * rint((before - angle) / TAU) }
}
