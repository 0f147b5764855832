//! What the methods compute at each instant, before any threshold: filtered motion, centrodes, joint forces (Eqs. 12, 16–18), and what
//! is computed of each reading of the tracker.

use super::calibration::monitor::Monitor;
use super::calibration::watched::Watched;
use super::filter::{FilteredMotion, PoseFilter};
use super::judge::Settings;
use super::nominal::{Expected, Nominal};
use crate::model::centrode::centrode;
use crate::model::{Configuration, Covector, Rate, Segment, Vec3};
use crate::record::Entry;
use crate::scenario::Method;
use crate::sensors::tracker::Reading;

/// Added to ε_τ where the bound is a threshold, so that the last bits of Θ raise no alarm at k = 1 or without errors.
const ROUNDING: f64 = 1e-12;

/// What the methods make of one instant. A value that is not defined is NaN, never 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
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
    /// ‖c_m − c_s‖ with the centrode of the commanded pose that is sampled, delayed and averaged as the tracker's readings are, m;
    /// not defined while ω_s = 0, before the average is whole, nor where its detector is switched off.
    pub consistent: f64,
    /// Angle between the instantaneous screw axes of which these are the centrodes, rad; likewise.
    pub turned: f64,
    /// ‖ω_s‖·‖c_m − c_s‖, m/s; 0 while ω_s = 0, and not defined before the average is whole.
    pub velocity: f64,
    /// The cumulative sum of the log likelihood ratio of a contact, natural logarithm, 0 or more; not defined where its detector is
    /// switched off.
    pub cusum: f64,
    /// The largest log likelihood ratio of a contact, likewise.
    pub glr: f64,
}

impl Judgement {
    /// Where nothing is known.
    pub const UNDEFINED: Self = Self {
        model_centrode: UNDEFINED,
        sensor_centrode: UNDEFINED,
        deviation: f64::NAN,
        speed: f64::NAN,
        residual: f64::NAN,
        common_bound: f64::NAN,
        independent_bound: f64::NAN,
        shape_bound: f64::NAN,
        consistent: f64::NAN,
        turned: f64::NAN,
        velocity: f64::NAN,
        cusum: f64::NAN,
        glr: f64::NAN,
    };
}

/// What is computed once of each reading of the tracker, and holds until the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    /// [`Judgement::cusum`].
    pub cusum: f64,
    /// [`Judgement::glr`].
    pub glr: f64,
}

impl Held {
    /// Before the first reading.
    pub const UNDEFINED: Self = Self { cusum: f64::NAN, glr: f64::NAN };
}

/// What is known of one instant without a threshold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Evidence {
    /// Position and motion of the end disk as the filtered tracker shows them.
    pub motion: FilteredMotion,
    /// What the two methods make of it.
    pub judgement: Judgement,
}

/// What the free model expects in a commanded configuration: the same in every repeat.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Expectation {
    /// The model's centrode c_m, m (Eq. 17); NaN where it has none.
    pub centrode: Vec3,
    /// ∇E, N·m (Eq. 10).
    pub gradient: Covector,
    /// ε_c(θL) of the free model, N·m.
    pub shape_bound: f64,
}

impl Expectation {
    /// Of a segment, whose load cells may err by a share `epsilon_tau`.
    #[must_use]
    pub fn new(segment: &Segment, configuration: Configuration, epsilon_tau: f64) -> Self {
        Self::moving(segment, configuration, Rate::BENDING, epsilon_tau)
    }

    /// The same for a motion in which δ changes as well.
    #[must_use]
    pub fn moving(segment: &Segment, configuration: Configuration, rate: Rate, epsilon_tau: f64) -> Self {
        let (pose, jacobian) = segment.arc(configuration).pose_and_jacobian(segment.length);
        Self {
            centrode: jacobian.centrode(&pose.position, rate).unwrap_or(UNDEFINED),
            gradient: segment.energy_gradient(&configuration),
            shape_bound: segment.shape_bound(&configuration, epsilon_tau + ROUNDING),
        }
    }

    /// Θ, N·m, where the load cells read `tau_lc` (N): [`Segment::residual`] with the gradient already there.
    #[must_use]
    pub fn residual(&self, segment: &Segment, configuration: &Configuration, tau_lc: &Vec3) -> f64 {
        segment.generalised_force(configuration, tau_lc).minus(&self.gradient).norm()
    }
}

const UNDEFINED: Vec3 = Vec3::new(f64::NAN, f64::NAN, f64::NAN);

/// The sensor's centrode (m) and its distance from the model's (m); NaN where the end disk does not turn.
#[must_use]
pub fn deviation(model_centrode: &Vec3, motion: &FilteredMotion) -> (Vec3, f64) {
    let sensor_centrode = centrode(&motion.position, &motion.twist).unwrap_or(UNDEFINED);
    (sensor_centrode, (model_centrode - sensor_centrode).norm())
}

/// Angle between two axes of rotation, rad; NaN where one of them is none.
pub(super) fn angle_between(a: &Vec3, b: &Vec3) -> f64 {
    let none = a.norm() == 0.0 || b.norm() == 0.0;
    if none { f64::NAN } else { libm::atan2(a.cross(b).norm(), a.dot(b)) }
}

/// A moving average that begins anew after a gap.
#[derive(Debug, Clone)]
struct Averaged {
    filter: PoseFilter,
    /// The filter before its first reading.
    empty: PoseFilter,
    length: u64,
    /// Readings until the average is whole again after a gap.
    missing: u64,
    /// Readings in a row, as far as they matter.
    taken: u64,
}

impl Averaged {
    fn new(settings: &Settings) -> Self {
        let filter = PoseFilter::new(&settings.filter, settings.loop_rate);
        Self { empty: filter.clone(), filter, length: settings.filter.length, missing: 0, taken: 0 }
    }

    /// The motion as of the next reading. After a gap the average begins anew, and nothing is known until it is whole again: noise
    /// in an average of a few readings would raise alarms.
    fn motion(&mut self, reading: &Reading) -> FilteredMotion {
        if reading.position.x.is_nan() {
            (self.filter, self.missing, self.taken) = (self.empty.clone(), self.length, 0);
            return FilteredMotion::UNDEFINED;
        }
        let motion = self.filter.push(reading);
        self.taken = self.length.min(self.taken + 1);
        if self.missing == 0 {
            return motion;
        }
        self.missing -= 1;
        FilteredMotion::UNDEFINED
    }

    /// Whether the average has all its readings.
    fn is_whole(&self) -> bool {
        self.taken == self.length
    }
}

/// Entries in, evidence out: it keeps one filter length of readings.
#[derive(Debug, Clone)]
pub struct Observer {
    segment: Segment,
    epsilon_tau: f64,
    sensor: Averaged,
    /// What the tracker would read at the command, where a detector that judges needs it.
    nominal: Option<Nominal>,
    /// Its last reading, and the average over them, where the detector judges that compares with it.
    consistent: Option<(Reading, Averaged)>,
    monitor: Option<Monitor>,
    held: Held,
}

impl Observer {
    /// Before the first entry. `monitor` is the calibration filter, where a detector that judges rests on it.
    #[must_use]
    pub fn new(settings: &Settings, monitor: Option<Monitor>) -> Self {
        let judges = |method| settings.thresholds.detectors.has(method);
        let compares = [Method::FcdConsistent, Method::Cusum, Method::Glr].into_iter().any(judges);
        let none = Reading { position: UNDEFINED, angles: [f64::NAN; 3] };
        Self {
            segment: settings.segment,
            epsilon_tau: settings.epsilon_tau,
            sensor: Averaged::new(settings),
            nominal: compares.then(|| Nominal::new(&settings.segment, &settings.clock)),
            consistent: judges(Method::FcdConsistent).then(|| (none, Averaged::new(settings))),
            monitor,
            held: Held::UNDEFINED,
        }
    }

    /// What the calibration filter has heard.
    #[must_use]
    pub fn watched(&self) -> Option<Watched> {
        self.monitor.as_ref().map(Monitor::watched)
    }

    /// Takes the next entry.
    pub fn observe(&mut self, entry: &Entry) -> Evidence {
        let Entry { configuration, reading, tau_lc, .. } = entry;
        let motion = self.sensor.motion(reading);
        let rate = match entry.delta_rate {
            0.0 => Rate::BENDING,
            delta => Rate { theta_l: entry.theta_l_rate, delta },
        };
        let expected = Expectation::moving(&self.segment, *configuration, rate, self.epsilon_tau);
        if let Some(new) = self.nominal.as_mut().and_then(|nominal| nominal.take(entry)) {
            self.renew(&new, entry);
        }
        let (segment, epsilon_tau) = (&self.segment, self.epsilon_tau);
        let (sensor_centrode, deviation) = deviation(&expected.centrode, &motion);
        let speed = motion.twist.angular.norm();
        // Noise in an average of a few readings would raise alarms of detectors that do not wait.
        let whole = self.sensor.is_whole();
        let (consistent, turned) = self.consistent.as_mut().map_or((f64::NAN, f64::NAN), |(reading, average)| {
            let model = average.motion(reading);
            let apart =
                centrode(&model.position, &model.twist).map_or(f64::NAN, |model| (model - sensor_centrode).norm());
            (apart, angle_between(&model.twist.angular, &motion.twist.angular))
        });
        let judgement = Judgement {
            model_centrode: expected.centrode,
            sensor_centrode,
            deviation,
            speed,
            residual: expected.residual(segment, configuration, tau_lc),
            common_bound: segment.common_error_bound(configuration, tau_lc, epsilon_tau),
            independent_bound: segment.independent_error_bound(configuration, tau_lc, epsilon_tau),
            shape_bound: expected.shape_bound,
            consistent: if whole { consistent } else { f64::NAN },
            turned: if whole { turned } else { f64::NAN },
            velocity: match whole {
                false => f64::NAN,
                true if speed == 0.0 => 0.0,
                true => speed * deviation,
            },
            cusum: self.held.cusum,
            glr: self.held.glr,
        };
        Evidence { motion, judgement }
    }

    /// Takes a new reading of the tracker with what is expected of it: what follows from it holds until the next one.
    fn renew(&mut self, expected: &Expected, entry: &Entry) {
        if let Some(heard) = self.monitor.as_mut().and_then(|monitor| monitor.take(expected, entry)) {
            self.held = Held { cusum: heard.cusum, glr: heard.glr };
        }
        if let Some((held, _)) = &mut self.consistent {
            *held = expected.reading;
        }
    }
}
