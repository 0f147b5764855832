//! What a method holds against its threshold, and the one place that says whether that counts at an instant.

use super::evidence::Judgement;
use crate::scenario::Thresholds;
use serde::Serialize;

/// How a contact is noticed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Fixed centrode deviation ‖c_m − c_s‖ above ξ2 (Eq. 19).
    Fcd,
    /// Joint force deviation Θ above ξ1 (Eqs. 12, 16).
    Jfd,
}

impl Method {
    /// All of them, in the order in which they judge an instant.
    pub const ALL: [Self; 2] = [Self::Fcd, Self::Jfd];

    /// Its key in files and on the command line.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Fcd => "fcd",
            Self::Jfd => "jfd",
        }
    }

    /// The key of its threshold in a scenario.
    #[must_use]
    pub fn threshold_key(self) -> &'static str {
        match self {
            Self::Fcd => "detection.xi2",
            Self::Jfd => "detection.xi1",
        }
    }

    /// Its statistic at an instant at `time` (s).
    #[must_use]
    pub fn statistic(self, judgement: &Judgement, time: f64, thresholds: &Thresholds) -> Statistic {
        let value = match self {
            Self::Fcd => judgement.deviation,
            Self::Jfd => judgement.residual,
        };
        Statistic { value, standing: self.standing(value, judgement.speed, time, thresholds) }
    }

    /// Whether a value counts at `time` (s) while the end disk turns at `speed` (rad/s). The one place that says so.
    #[must_use]
    pub fn standing(self, value: f64, speed: f64, time: f64, thresholds: &Thresholds) -> Standing {
        let moves = match self {
            Self::Fcd => speed > thresholds.min_speed,
            Self::Jfd => true,
        };
        if !moves || value.is_nan() {
            Standing::Silent
        } else if time < thresholds.armed_from {
            Standing::Unarmed
        } else {
            Standing::Counts
        }
    }

    /// Its threshold at an instant: m for the centrode, N·m for joint forces; none while switched off.
    #[must_use]
    pub fn threshold(self, judgement: &Judgement, thresholds: &Thresholds) -> Option<f64> {
        match self {
            Self::Fcd => thresholds.xi2.value(),
            Self::Jfd => thresholds.xi1_at(judgement.shape_bound),
        }
    }
}

/// Whether a value is held against a threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// It is.
    Counts,
    /// Not yet armed: it lies below every threshold.
    Unarmed,
    /// Not defined, or the end disk turns too slowly: an alarm stays as it was.
    Silent,
}

/// A value of a method at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistic {
    /// m for the centrode, N·m for joint forces; NaN where it is not defined.
    pub value: f64,
    /// Whether it counts.
    pub standing: Standing,
}

impl Statistic {
    /// The value, where it counts.
    #[must_use]
    pub fn counted(&self) -> Option<f64> {
        (self.standing == Standing::Counts).then_some(self.value)
    }

    /// Whether it lies above a threshold; none where an alarm stays as it was.
    #[must_use]
    pub fn above(&self, threshold: f64) -> Option<bool> {
        match self.standing {
            Standing::Counts => Some(self.value > threshold),
            Standing::Unarmed => Some(false),
            Standing::Silent => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Vec3;

    #[test]
    fn a_value_counts_once_armed_fast_enough_and_defined() {
        let judgement = |deviation, speed, residual| Judgement {
            model_centrode: Vec3::zeros(),
            sensor_centrode: Vec3::zeros(),
            deviation,
            speed,
            residual,
            common_bound: 0.0,
            independent_bound: 0.0,
            shape_bound: 0.0,
        };
        let thresholds = Thresholds { armed_from: 5.0, min_speed: 0.05, ..Thresholds::default() };
        for (method, deviation, speed, residual, time, standing) in [
            (Method::Fcd, 0.01, 0.06, 0.0, 5.0, Standing::Counts),
            (Method::Fcd, 0.01, 0.06, 0.0, 4.999, Standing::Unarmed),
            (Method::Fcd, 0.01, 0.05, 0.0, 5.0, Standing::Silent),
            (Method::Fcd, f64::NAN, 0.06, 0.0, 5.0, Standing::Silent),
            (Method::Jfd, 0.01, 0.0, 0.1, 5.0, Standing::Counts),
            (Method::Jfd, 0.01, 0.0, 0.1, 4.0, Standing::Unarmed),
            (Method::Jfd, 0.01, 0.06, f64::NAN, 6.0, Standing::Silent),
        ] {
            let statistic = method.statistic(&judgement(deviation, speed, residual), time, &thresholds);
            assert_eq!(statistic.standing, standing, "{method:?} {deviation} {speed} {residual} {time}");
            assert_eq!(statistic.counted().is_some(), standing == Standing::Counts);
        }
    }
}
