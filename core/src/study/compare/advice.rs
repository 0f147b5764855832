//! Which threshold of which detector to take.

use super::{Compared, Comparison};
use crate::detect::Method;
use crate::study::tuning::Point;
use crate::study::tuning::recommend::{Verdict, sooner};
use libm::{ceil, floor, log10, pow};

/// Thresholds at which so few runs without contact alarm are all tried; of more, those a step apart.
const ALL: usize = 20;
const STEP: f64 = 1.1;

/// Rising thresholds of three digits worth trying, from the largest values without contact (falling).
pub(super) fn levels(peaks: &[f64]) -> Vec<f64> {
    let mut levels = Vec::new();
    let mut alarms = 0;
    while let Some(&peak) = peaks.get(alarms) {
        levels.push(rounded_up(peak));
        alarms = if alarms < ALL { alarms + 1 } else { ceil(alarms as f64 * STEP) as usize };
    }
    levels.reverse();
    levels.dedup();
    levels
}

/// The next number of three digits; 0 for what is not above it.
fn rounded_up(value: f64) -> f64 {
    if value <= 0.0 {
        return 0.0;
    }
    let digits = 2.0 - floor(log10(value));
    // Each power is a whole number, which divides to the nearest number.
    let (power, large) = (pow(10.0, digits.abs()), digits < 0.0);
    if large { ceil(value / power) * power } else { ceil(value * power - 1e-9) / power }
}

/// The detector that is soonest at its advised threshold.
pub(super) fn soonest(detectors: &[Compared]) -> Option<&'static str> {
    let mut best: Option<(&'static str, &Point)> = None;
    for compared in detectors {
        if let Verdict::Take { point, .. } = &compared.advised
            && best.is_none_or(|(_, best)| sooner(point, best))
        {
            best = Some((compared.detector, point));
        }
    }
    best.map(|(detector, _)| detector)
}

impl Comparison {
    /// The detector whose advised threshold detects soonest, and what that threshold comes to.
    #[must_use]
    pub fn advice(&self) -> Option<(Method, &Point)> {
        let soonest = self.soonest?;
        let compared = self.detectors.iter().find(|compared| compared.detector == soonest)?;
        let method = *Method::ALL.iter().find(|method| method.key() == soonest)?;
        compared.taken().map(|point| (method, point))
    }
}

impl Compared {
    /// What the advised threshold comes to, where there is one.
    #[must_use]
    pub fn taken(&self) -> Option<&Point> {
        if let Verdict::Take { point, .. } = &self.advised { Some(point) } else { None }
    }

    /// The detector.
    #[must_use]
    pub fn method(&self) -> Method {
        Method::ALL.iter().copied().find(|method| method.key() == self.detector).unwrap_or(Method::Fcd)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_rise_have_three_digits_and_hold_every_count_of_few_alarms() {
        let peaks: Vec<f64> = (0..400).map(|k| 0.012_345 - 1e-5 * f64::from(k)).collect();
        let levels = levels(&peaks);
        assert!(levels.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(levels.len() > ALL && levels.len() < 60, "{}", levels.len());
        for level in &levels {
            let written: f64 = format!("{level:.2e}").parse().expect("a number");
            assert_eq!(written, *level);
        }
        let silent = |level: f64| peaks.iter().all(|peak| *peak <= level);
        assert!(silent(levels[levels.len() - 1]) && !silent(levels[levels.len() - 2]));
        assert!(super::levels(&[]).is_empty());
    }

    #[test]
    fn three_digits_are_reached_upward_at_every_size() {
        for (value, expected) in [(9.703_1, 9.71), (0.008_94, 0.008_94), (1234.0, 1240.0), (0.0, 0.0), (-1.0, 0.0)] {
            assert_eq!(rounded_up(value), expected);
        }
    }
}
