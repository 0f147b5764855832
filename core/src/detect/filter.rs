//! The moving average over the tracker's readings, and the backward difference behind it.

use crate::model::orientation::{Quaternion, from_euler_sin_cos, quaternion_from_euler, vector_of_ratio, vee};
use crate::model::{Mat3, Twist, Vec3};
use crate::scenario::{Averaging, Filter};
use crate::sensors::tracker::Reading;
use libm::{sincos, sqrt};

/// The mean of the last N vectors, at a cost that does not depend on N.
///
/// The running sum carries its rounding errors in a second number (an error-free two-sum), so that an hour of
/// adding and subtracting leaves it as exact as a sum made afresh. Until N vectors have come, the mean is that
/// of those that have.
#[derive(Debug, Clone)]
pub struct MovingAverage<const D: usize> {
    length: usize,
    ring: Vec<[f64; D]>,
    oldest: usize,
    sum: [f64; D],
    error: [f64; D],
    mean: [f64; D],
    /// One over the number of vectors in it.
    share: f64,
}

impl<const D: usize> MovingAverage<D> {
    /// An average over `length` vectors, at least 1.
    #[must_use]
    pub fn new(length: usize) -> Self {
        let length = length.max(1);
        Self { length, ring: Vec::new(), oldest: 0, sum: [0.0; D], error: [0.0; D], mean: [0.0; D], share: 1.0 }
    }

    /// Takes one vector in and returns the mean and its change since the one before.
    ///
    /// The change is exactly zero when the vector that comes equals the one that goes. The first is zero.
    pub fn push(&mut self, next: &[f64; D]) -> ([f64; D], [f64; D]) {
        let first = self.ring.is_empty();
        let growing = self.ring.len() < self.length;
        // What a new vector is measured against: while the mean grows, the mean itself.
        let gone = if growing {
            self.ring.push(*next);
            self.share = 1.0 / self.ring.len() as f64;
            if first { *next } else { self.mean }
        } else {
            let oldest = std::mem::replace(&mut self.ring[self.oldest], *next);
            self.oldest = if self.oldest + 1 == self.length { 0 } else { self.oldest + 1 };
            oldest
        };
        let (share, mut change) = (self.share, [0.0; D]);
        if !growing {
            for ((sum, error), gone) in self.sum.iter_mut().zip(&mut self.error).zip(&gone) {
                (*sum, *error) = add(*sum, *error, -gone);
            }
        }
        // One plain loop for each step, so that components are worked side by side.
        for ((sum, error), next) in self.sum.iter_mut().zip(&mut self.error).zip(next) {
            (*sum, *error) = add(*sum, *error, *next);
        }
        for ((change, next), gone) in change.iter_mut().zip(next).zip(&gone) {
            *change = (next - gone) * share;
        }
        for (i, mean) in self.mean.iter_mut().enumerate() {
            // What does not change keeps its bits: a robot at rest has no speed, not one of a rounding error.
            if change[i] != 0.0 || share == 1.0 {
                *mean = (self.sum[i] + self.error[i]) * share;
            }
        }
        (self.mean, change)
    }
}

/// Adds `x` to a sum that carries its rounding errors in a second number.
#[inline]
fn add(sum: f64, error: f64, x: f64) -> (f64, f64) {
    let total = sum + x;
    let rounded = total - sum;
    (total, error + ((sum - (total - rounded)) + (x - rounded)))
}

/// Position and motion of the end disk as the sensor shows them, in {B}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilteredMotion {
    /// p_s, m.
    pub position: Vec3,
    /// ṗ_s (m/s) and ω_s (rad/s).
    pub twist: Twist,
}

impl FilteredMotion {
    /// Where there is no reading.
    pub const UNDEFINED: Self = {
        let undefined = Vec3::new(f64::NAN, f64::NAN, f64::NAN);
        Self { position: undefined, twist: Twist { linear: undefined, angular: undefined } }
    };
}

/// The filter of the whole pose. A value: it can be fed a sensor's readings or a model's.
#[derive(Debug, Clone)]
pub struct PoseFilter {
    position: MovingAverage<3>,
    /// Mean position, m, and its last step.
    at: ([f64; 3], [f64; 3]),
    orientation: Orientation,
    rate: f64,
}

#[derive(Debug, Clone)]
enum Orientation {
    Readings(Angles),
    Rotations(Quaternions),
}

/// Averages of the three Euler angles.
#[derive(Debug, Clone)]
struct Angles {
    average: MovingAverage<3>,
    /// The means before the last reading and after it, rad.
    before: Option<[f64; 3]>,
    mean: Option<[f64; 3]>,
    change: [f64; 3],
    /// The rotation last made, of which angles, and their sines and cosines.
    made: Option<([f64; 3], Mat3)>,
    sin_cos: [(f64, f64); 3],
}

/// Averages of quaternions.
#[derive(Debug, Clone)]
struct Quaternions {
    average: MovingAverage<4>,
    last: Option<([f64; 3], Quaternion)>,
    before: Quaternion,
    mean: Quaternion,
    change: Quaternion,
}

impl PoseFilter {
    /// A filter of the given settings in a loop of `rate` Hz.
    #[must_use]
    pub fn new(settings: &Filter, rate: f64) -> Self {
        let length = settings.length as usize;
        let orientation = match settings.averaging {
            Averaging::Readings => Orientation::Readings(Angles {
                average: MovingAverage::new(length),
                before: None,
                mean: None,
                change: [0.0; 3],
                made: None,
                sin_cos: [(0.0, 1.0); 3],
            }),
            Averaging::Rotations => Orientation::Rotations(Quaternions {
                average: MovingAverage::new(length),
                last: None,
                before: [0.0; 4],
                mean: [0.0; 4],
                change: [0.0; 4],
            }),
        };
        Self { position: MovingAverage::new(length), at: ([0.0; 3], [0.0; 3]), orientation, rate }
    }

    /// Takes one reading in; the motion is the backward difference of the averages.
    pub fn push(&mut self, reading: &Reading) -> FilteredMotion {
        self.take(reading);
        self.motion()
    }

    /// Takes one reading in, without asking for the motion.
    pub fn take(&mut self, reading: &Reading) {
        self.at = self.position.push(&reading.position.into());
        match &mut self.orientation {
            Orientation::Readings(angles) => angles.take(&reading.angles),
            Orientation::Rotations(quaternions) => quaternions.take(&reading.angles),
        }
    }

    /// The motion as of the last reading.
    pub fn motion(&mut self) -> FilteredMotion {
        let turn = match &mut self.orientation {
            Orientation::Readings(angles) => angles.turn(),
            Orientation::Rotations(quaternions) => quaternions.turn(),
        };
        let (position, step) = self.at;
        FilteredMotion {
            position: position.into(),
            twist: Twist { linear: Vec3::from(step) * self.rate, angular: turn * self.rate },
        }
    }

    /// Whether ‖ω_s‖ is known to be at most `speed` (rad/s) without being computed: no product of three rotations turns farther
    /// than their angles together.
    #[must_use]
    pub fn turns_at_most(&self, speed: f64) -> bool {
        // Room for the roundings of the rotation itself.
        const ROUNDING: f64 = 1e-15;
        match &self.orientation {
            Orientation::Readings(Angles { change, .. }) => {
                let most = change[0].abs() + change[1].abs() + change[2].abs();
                (most * (1.0 + 1e-12) + ROUNDING) * self.rate <= speed
            }
            Orientation::Rotations(_) => false,
        }
    }
}

impl Angles {
    fn take(&mut self, angles: &[f64; 3]) {
        self.before = self.mean;
        let (mean, change) = self.average.push(angles);
        (self.mean, self.change) = (Some(mean), change);
    }

    /// The rotation vector of the last step in {B}, rad: `[Ω_s]^∨ Δt` with Ω_s = Ṙ_s R_sᵀ (Eq. 18), in which the constant mounting
    /// R̃_g cancels.
    fn turn(&mut self) -> Vec3 {
        let (Some(before), Some(mean)) = (self.before, self.mean) else { return Vec3::zeros() };
        if self.change == [0.0; 3] {
            return Vec3::zeros();
        }
        let previous = self.rotation(before);
        let rotation = self.rotation(mean);
        vee(&(rotation * previous.transpose()))
    }

    fn rotation(&mut self, angles: [f64; 3]) -> Mat3 {
        let known = match self.made {
            Some((of, rotation)) if of == angles => return rotation,
            Some((of, _)) => Some(of),
            None => None,
        };
        // In most experiments one of the three angles moves: the sines of the others stay.
        for i in 0..3 {
            if known.is_none_or(|of| of[i] != angles[i]) {
                self.sin_cos[i] = sincos(angles[i]);
            }
        }
        let rotation = from_euler_sin_cos(&self.sin_cos);
        self.made = Some((angles, rotation));
        rotation
    }
}

impl Quaternions {
    fn take(&mut self, angles: &[f64; 3]) {
        let quaternion = match self.last {
            Some((same, quaternion)) if same == *angles => quaternion,
            _ => {
                // A rotation has two quaternions: take the one on the side of the reading before.
                let fresh = quaternion_from_euler(angles);
                let turned = self.last.is_some_and(|(_, old)| dot(&fresh, &old) < 0.0);
                let quaternion = if turned { fresh.map(|x| -x) } else { fresh };
                self.last = Some((*angles, quaternion));
                quaternion
            }
        };
        self.before = self.mean;
        (self.mean, self.change) = self.average.push(&quaternion);
    }

    /// The rotation vector of the last step in {B}, rad.
    fn turn(&self) -> Vec3 {
        let size = sqrt(dot(&self.before, &self.before) * dot(&self.mean, &self.mean));
        if size > 0.0 { vector_of_ratio(&self.change, &self.before) * (2.0 / size) } else { Vec3::zeros() }
    }
}

fn dot(a: &Quaternion, b: &Quaternion) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings as multiples of 2⁻⁴⁰ below 1: sums of them are exact in i64.
    fn reading(k: u64) -> i64 {
        (k.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407) >> 24) as i64 - (1 << 39)
    }

    #[test]
    fn does_not_drift_over_an_hour() {
        let unit = 1.0 / (1i64 << 40) as f64;
        // A large step that comes and goes is what spoils a plain running sum.
        let step = |k: u64| {
            if (1_000_000..1_000_100).contains(&k) { 1_000_000_000 } else { 1 }
        };
        let length = 500;
        let mut average = MovingAverage::<1>::new(length);
        let mut exact = 0i128;
        for k in 0..3_600_000u64 {
            let value = i128::from(reading(k)) * step(k);
            exact += value;
            if let Some(old) = k.checked_sub(length as u64) {
                exact -= i128::from(reading(old)) * step(old);
            }
            let mean = average.push(&[reading(k) as f64 * step(k) as f64 * unit]).0[0];
            if k > 3_500_000 {
                let reference = exact as f64 * unit / length as f64;
                assert!((mean - reference).abs() <= 2.0 * f64::EPSILON * reference.abs(), "{k}: {mean} {reference}");
            }
        }
    }

    #[test]
    fn a_length_of_one_is_the_reading_itself() {
        let mut average = MovingAverage::<1>::new(1);
        for k in 0..1000 {
            let x = reading(k) as f64 * 1e-3;
            assert_eq!(average.push(&[x]).0[0], x);
        }
    }

    #[test]
    fn before_it_is_full_it_averages_what_has_come() {
        let mut average = MovingAverage::<1>::new(10);
        for k in 1..=5 {
            let mean = average.push(&[f64::from(k)]).0[0];
            assert_eq!(mean, f64::from(k + 1) / 2.0);
        }
    }

    #[test]
    fn changes_add_up_to_the_mean() {
        let mut average = MovingAverage::<2>::new(7);
        let mut sum = average.push(&[0.3, -1.0]).0;
        for k in 0..100 {
            let (mean, change) = average.push(&[reading(k) as f64 * 1e-12, f64::from(k as u32)]);
            for i in 0..2 {
                sum[i] += change[i];
                assert!((sum[i] - mean[i]).abs() < 1e-12, "{k}");
            }
        }
    }
}
