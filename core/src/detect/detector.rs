//! Contact detection on a stream of measurements: FCD (Eqs. 17–19, 24) and JFD (Eqs. 12, 16).

use crate::detect::filter::Motion;
use crate::model::centrode::centrode;
use crate::model::{Configuration, Location, Rate, Segment, Vec3, locate};
use crate::scenario::Thresholds;
use serde::Serialize;

/// Added to ε_τ where the bound is a threshold, so that the last bits of Θ raise no alarm at k = 1 or without errors.
const ROUNDING: f64 = 1e-12;

/// How a contact is noticed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Fixed centrode deviation.
    Fcd,
    /// Joint force deviation.
    Jfd,
}

/// What the loop knows at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Measurement {
    /// Time, s.
    pub time: f64,
    /// The commanded configuration.
    pub configuration: Configuration,
    /// Position and motion of the end disk from the filtered tracker.
    pub motion: Motion,
    /// Load cell readings τ_lc, N.
    pub tau_lc: Vec3,
}

/// What both methods make of one instant. A value that is not defined is NaN, never 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// The model's centrode c_m, m (Eq. 17); its limit while the robot rests.
    pub model_centrode: Vec3,
    /// The sensor's centrode c_s, m (Eq. 18); not defined while ω_s = 0.
    pub sensor_centrode: Vec3,
    /// ‖c_m − c_s‖, m (Eq. 19); not defined while ω_s = 0.
    pub deviation: f64,
    /// ‖ω_s‖, rad/s.
    pub speed: f64,
    /// Θ, N·m (Eq. 12).
    pub residual: f64,
    /// ε_c for one error common to the three cells, N·m (Eq. 16).
    pub common_bound: f64,
    /// ε_c for independent errors of the cells, N·m.
    pub independent_bound: f64,
    /// ε_c(θL) of the free model at the commanded shape, N·m: what ξ1 follows when it follows the shape.
    pub shape_bound: f64,
}

impl Judgement {
    /// What the thresholds are held against at `time` (s): ‖c_m − c_s‖ (m) and Θ (N·m).
    ///
    /// None where the value is not defined or not judged: the alarm stays as it was. Before arming both lie below
    /// every threshold.
    #[must_use]
    pub fn looked_at(&self, time: f64, thresholds: &Thresholds) -> [Option<f64>; 2] {
        let moving = self.speed > thresholds.min_speed;
        let armed = time >= thresholds.armed_from;
        [(self.deviation, moving), (self.residual, true)].map(|(value, judged)| {
            let looked = judged && !value.is_nan();
            looked.then_some(if armed { value } else { f64::NEG_INFINITY })
        })
    }
}

/// A threshold crossed upward.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Crossing {
    /// Which value crossed.
    pub method: Method,
    /// When, s.
    pub time: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// The value: ‖c_m − c_s‖ in m, or Θ in N·m.
    pub value: f64,
    /// The threshold: ξ2 in m, or ξ1 in N·m.
    pub threshold: f64,
}

/// The first crossing of ξ2, with the place that Eq. 24 gives it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Detection {
    /// When, s.
    pub time: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// Estimated arc length of the contact, m.
    pub location: f64,
    /// ‖c_c(location) − c_s‖, m: how well the estimate explains the sensor.
    pub distance: f64,
}

/// Both methods, one instant after the other.
#[derive(Debug, Clone)]
pub struct Detector {
    segment: Segment,
    thresholds: Thresholds,
    epsilon_tau: f64,
    above: [bool; 2],
    detection: Option<Detection>,
}

impl Detector {
    /// A detector for a segment; `epsilon_tau` is the load cells' assumed relative error.
    #[must_use]
    pub fn new(segment: Segment, thresholds: Thresholds, epsilon_tau: f64) -> Self {
        Self { segment, thresholds, epsilon_tau, above: [false; 2], detection: None }
    }

    /// Judges one instant; `crossed` is called for each threshold crossed upward.
    pub fn judge(&mut self, measurement: &Measurement, mut crossed: impl FnMut(Crossing)) -> Judgement {
        let judgement = self.compare(measurement);
        let [deviation, residual] = judgement.looked_at(measurement.time, &self.thresholds);
        let values = [
            (Method::Fcd, deviation, self.thresholds.xi2.value()),
            (Method::Jfd, residual, self.thresholds.xi1_at(judgement.shape_bound)),
        ];
        for (which, (method, value, threshold)) in values.into_iter().enumerate() {
            let (Some(value), Some(threshold)) = (value, threshold) else {
                continue;
            };
            let above = value > threshold;
            let was = std::mem::replace(&mut self.above[which], above);
            if above && !was {
                let Measurement { time, configuration, .. } = *measurement;
                crossed(Crossing { method, time, theta_l: configuration.theta_l(), value, threshold });
                if method == Method::Fcd && self.detection.is_none() {
                    self.detection = self.locate(time, configuration, &judgement.sensor_centrode);
                }
            }
        }
        judgement
    }

    /// The first detection so far.
    #[must_use]
    pub fn detection(&self) -> Option<Detection> {
        self.detection
    }

    fn compare(&self, measurement: &Measurement) -> Judgement {
        let Measurement { configuration, motion, tau_lc, .. } = measurement;
        let (pose, jacobian) = self.segment.arc(*configuration).pose_and_jacobian(self.segment.length);
        let undefined = Vec3::repeat(f64::NAN);
        let model_centrode = jacobian.centrode(&pose.position, Rate::BENDING).unwrap_or(undefined);
        let sensor_centrode = centrode(&motion.position, &motion.twist).unwrap_or(undefined);
        let segment = &self.segment;
        Judgement {
            model_centrode,
            sensor_centrode,
            deviation: (model_centrode - sensor_centrode).norm(),
            speed: motion.twist.angular.norm(),
            residual: segment.residual(configuration, tau_lc),
            common_bound: segment.common_error_bound(configuration, tau_lc, self.epsilon_tau),
            independent_bound: segment.independent_error_bound(configuration, tau_lc, self.epsilon_tau),
            shape_bound: segment.shape_bound(configuration, self.epsilon_tau + ROUNDING),
        }
    }

    fn locate(&self, time: f64, configuration: Configuration, sensor_centrode: &Vec3) -> Option<Detection> {
        let Location { arc_length, distance } =
            locate(self.segment.length, configuration, Rate::BENDING, sensor_centrode)?;
        Some(Detection { time, theta_l: configuration.theta_l(), location: arc_length, distance })
    }
}
