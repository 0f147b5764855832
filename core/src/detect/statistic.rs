//! What a method holds against its threshold, and the one place that says whether that counts at an instant.

use super::evidence::Judgement;
pub use crate::scenario::Method;
use crate::scenario::keys::{self, Quantity};
use crate::scenario::{Threshold, Thresholds, Xi1Rule};

impl Method {
    /// The key of its threshold in a scenario.
    #[must_use]
    pub const fn threshold_key(self) -> &'static str {
        match self {
            Self::Fcd => "detection.xi2",
            Self::Jfd => "detection.xi1",
            Self::FcdConsistent => "detection.consistent",
            Self::FcdVelocity => "detection.velocity",
            Self::Cusum => "detection.cusum",
            Self::Glr => "detection.glr",
        }
    }

    /// What its values and its threshold are, and so in which units they are shown.
    #[must_use]
    pub const fn quantity(self) -> Quantity {
        match keys::find(self.threshold_key()) {
            Some(key) => key.quantity,
            None => Quantity::Count,
        }
    }

    /// What its setting is where ξ1 is what a scenario says it is.
    #[must_use]
    pub const fn setting_quantity(self, rule: Xi1Rule) -> Quantity {
        match (self, rule) {
            (Self::Jfd, Xi1Rule::Bound) => Quantity::Count,
            _ => self.quantity(),
        }
    }

    /// Its value at an instant, SI; NaN where it is not defined.
    #[must_use]
    pub fn value(self, judgement: &Judgement) -> f64 {
        match self {
            Self::Fcd => judgement.deviation,
            Self::Jfd => judgement.residual,
            Self::FcdConsistent => judgement.consistent,
            Self::FcdVelocity => judgement.velocity,
            Self::Cusum => judgement.cusum,
            Self::Glr => judgement.glr,
        }
    }

    /// Whether Eq. 24 places a contact at its alarm: it does where the sensor's centrode raises it.
    #[must_use]
    pub fn places(self) -> bool {
        matches!(self, Self::Fcd | Self::FcdConsistent | Self::FcdVelocity)
    }

    /// Its statistic at an instant at `time` (s).
    #[must_use]
    pub fn statistic(self, judgement: &Judgement, time: f64, thresholds: &Thresholds) -> Statistic {
        let value = self.value(judgement);
        Statistic { value, standing: self.standing(value, judgement.speed, time, thresholds) }
    }

    /// Whether a value counts at `time` (s) while the end disk turns at `speed` (rad/s). The one place that says so.
    #[must_use]
    pub fn standing(self, value: f64, speed: f64, time: f64, thresholds: &Thresholds) -> Standing {
        let moves = match self {
            Self::Fcd | Self::FcdConsistent => speed > thresholds.min_speed,
            Self::Jfd | Self::FcdVelocity | Self::Cusum | Self::Glr => true,
        };
        if !moves || value.is_nan() {
            Standing::Silent
        } else if thresholds.waits(self) && time < thresholds.armed_from {
            Standing::Unarmed
        } else {
            Standing::Counts
        }
    }

    /// Its threshold at an instant, in the unit of its values; none while switched off.
    #[must_use]
    pub fn threshold(self, judgement: &Judgement, thresholds: &Thresholds) -> Option<f64> {
        match self {
            Self::Jfd => thresholds.xi1_at(judgement.shape_bound),
            _ => thresholds.of(self).value(),
        }
    }

    /// What is set of its threshold, as a study counts it: SI, or k where ξ1 follows the shape; none while switched off. Times
    /// [`Method::unit`] it is the threshold.
    #[must_use]
    pub fn setting(self, thresholds: &Thresholds) -> Option<f64> {
        match (self, thresholds.xi1_rule) {
            (Self::Jfd, Xi1Rule::Bound) => thresholds.xi1.value().map(|_| thresholds.xi1_factor),
            _ => thresholds.of(self).value(),
        }
    }

    /// The unit of its setting where the free model's bound ε_c(θL) is `shape_bound` (N·m): that bound where the threshold
    /// follows the shape, else 1.
    #[must_use]
    pub fn unit(self, thresholds: &Thresholds, shape_bound: f64) -> f64 {
        match (self, thresholds.xi1_rule) {
            (Self::Jfd, Xi1Rule::Bound) => shape_bound,
            _ => 1.0,
        }
    }

    /// Thresholds in which what it does not look at, one of ξ1 and k, is the default.
    pub fn tidy(self, thresholds: &mut Thresholds) {
        let default = Thresholds::default();
        match (self, thresholds.xi1_rule, thresholds.xi1) {
            (Self::Jfd, Xi1Rule::Constant, _) => thresholds.xi1_factor = default.xi1_factor,
            (Self::Jfd, Xi1Rule::Bound, Threshold::On(_)) => thresholds.xi1 = default.xi1,
            _ => {}
        }
    }

    /// Thresholds in which what is set of its own plays no part, but for the unit.
    pub fn forget_setting(self, thresholds: &mut Thresholds) {
        *thresholds.of_mut(self) = Threshold::OFF;
        if self == Self::Jfd {
            thresholds.xi1_factor = Thresholds::default().xi1_factor;
        }
    }

    /// Thresholds in which its own plays no part.
    pub fn forget(self, thresholds: &mut Thresholds) {
        self.forget_setting(thresholds);
        if self == Self::Jfd {
            thresholds.xi1_rule = Thresholds::default().xi1_rule;
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
    /// In the unit of the method's [`Method::quantity`], SI; NaN where it is not defined.
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
    use crate::scenario::Arming;

    #[test]
    fn a_setting_times_its_unit_is_the_threshold() {
        for xi1_rule in [Xi1Rule::Constant, Xi1Rule::Bound] {
            let thresholds = Thresholds { xi1_rule, xi1_factor: 1.3, ..Thresholds::default() };
            let judgement = Judgement { shape_bound: 0.0123, ..judgement(0.0, 1.0, 0.0) };
            for &method in Method::ALL {
                let setting = method.setting(&thresholds).expect("on");
                let threshold = setting * method.unit(&thresholds, judgement.shape_bound);
                assert_eq!(method.threshold(&judgement, &thresholds), Some(threshold), "{method:?} {xi1_rule:?}");
                let mut forgotten = thresholds.clone();
                method.forget(&mut forgotten);
                assert_eq!(method.threshold(&judgement, &forgotten), None);
            }
        }
    }

    fn judgement(deviation: f64, speed: f64, residual: f64) -> Judgement {
        let velocity = if speed == 0.0 { 0.0 } else { speed * deviation };
        let consistent = deviation - 0.000_77;
        Judgement { deviation, speed, residual, consistent, velocity, cusum: residual, ..Judgement::UNDEFINED }
    }

    #[test]
    fn a_value_counts_once_armed_fast_enough_and_defined() {
        let thresholds = Thresholds { armed_from: 5.0, min_speed: 0.05, ..Thresholds::default() };
        for (method, deviation, speed, residual, time, standing) in [
            (Method::Fcd, 0.01, 0.06, 0.0, 5.0, Standing::Counts),
            (Method::Fcd, 0.01, 0.06, 0.0, 4.999, Standing::Unarmed),
            (Method::Fcd, 0.01, 0.05, 0.0, 5.0, Standing::Silent),
            (Method::Fcd, f64::NAN, 0.06, 0.0, 5.0, Standing::Silent),
            (Method::Jfd, 0.01, 0.0, 0.1, 5.0, Standing::Counts),
            (Method::Jfd, 0.01, 0.0, 0.1, 4.0, Standing::Unarmed),
            (Method::Jfd, 0.01, 0.06, f64::NAN, 6.0, Standing::Silent),
            (Method::FcdConsistent, 0.01, 0.06, 0.0, 1.0, Standing::Counts),
            (Method::FcdConsistent, 0.01, 0.05, 0.0, 6.0, Standing::Silent),
            (Method::FcdVelocity, 0.01, 0.01, 0.0, 1.0, Standing::Counts),
            (Method::FcdVelocity, f64::NAN, 0.0, 0.0, 6.0, Standing::Counts),
            (Method::Cusum, 0.0, 0.0, 3.0, 0.0, Standing::Counts),
            (Method::Cusum, 0.0, 0.0, f64::NAN, 6.0, Standing::Silent),
            (Method::Glr, 0.0, 1.0, 0.0, 6.0, Standing::Silent),
        ] {
            let statistic = method.statistic(&judgement(deviation, speed, residual), time, &thresholds);
            assert_eq!(statistic.standing, standing, "{method:?} {deviation} {speed} {residual} {time}");
            assert_eq!(statistic.counted().is_some(), standing == Standing::Counts);
            let all = Thresholds { arming: Arming::All, ..thresholds.clone() };
            let waits = standing == Standing::Counts && time < 5.0;
            let statistic = method.statistic(&judgement(deviation, speed, residual), time, &all);
            assert_eq!(statistic.standing, if waits { Standing::Unarmed } else { standing }, "{method:?}");
        }
    }

    #[test]
    fn values_are_shown_in_units_of_their_thresholds() {
        let units = Method::ALL.iter().map(|method| method.quantity().unit());
        assert!(units.eq(["mm", "mN·m", "mm", "mm/s", "", ""]));
        for &method in Method::ALL {
            let key = keys::find(method.threshold_key()).expect("a key");
            assert!(key.has_off() && key.number(&crate::scenario::Scenario::default()).is_some(), "{method:?}");
        }
    }
}
