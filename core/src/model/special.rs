//! The few functions of an angle in which the model's `0/0` at the straight configuration hides.
//!
//! Each is written with half angles, or as a series where half angles still cancel, so that it is exact
//! to rounding everywhere and exact at zero.

use libm::sincos;

/// Below this the slope of `sin x / x` is summed as a series: eleven terms reach rounding at 1, and above
/// it the closed form loses less than two bits. A smaller value would let the closed form cancel, a
/// larger one would need more terms.
const SERIES_LIMIT: f64 = 1.0;

/// `2k/(2k+1)!` for k = 1, 2, …: the series of `(sin x − x cos x)/x²` in `x, −x³, x⁵, …`.
const SLOPE_SERIES: [f64; 11] = {
    let mut terms = [0.0; 11];
    let mut factorial = 1.0;
    let mut k = 1;
    while k <= 11 {
        factorial *= (2 * k) as f64 * (2 * k + 1) as f64;
        terms[k - 1] = (2 * k) as f64 / factorial;
        k += 1;
    }
    terms
};

/// An angle in radians with the sine and cosine of its half, from which all the rest follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Angle {
    value: f64,
    sin_half: f64,
    cos_half: f64,
}

impl Angle {
    /// The angle `x`, finite.
    #[must_use]
    pub fn new(x: f64) -> Self {
        let (sin_half, cos_half) = sincos(0.5 * x);
        Self { value: x, sin_half, cos_half }
    }

    /// `x`.
    #[must_use]
    pub fn value(self) -> f64 {
        self.value
    }

    /// `sin x`.
    #[must_use]
    pub fn sine(self) -> f64 {
        2.0 * self.sin_half * self.cos_half
    }

    /// `cos x`.
    #[must_use]
    pub fn cosine(self) -> f64 {
        (self.cos_half - self.sin_half) * (self.cos_half + self.sin_half)
    }

    /// `1 − cos x`, without cancellation.
    #[must_use]
    pub fn versine(self) -> f64 {
        2.0 * self.sin_half * self.sin_half
    }

    /// `sin x / x`; 1 at zero.
    #[must_use]
    pub fn sinc(self) -> f64 {
        if self.value == 0.0 { 1.0 } else { self.sine() / self.value }
    }

    /// `(1 − cos x) / x²`; 1/2 at zero.
    #[must_use]
    pub fn versinc(self) -> f64 {
        let half = 0.5 * self.half_sinc();
        2.0 * half * half
    }

    /// `d/dx [(1 − cos x)/x] = (x sin x − (1 − cos x)) / x²`; 1/2 at zero.
    #[must_use]
    pub fn versine_ratio_slope(self) -> f64 {
        let q = self.half_sinc();
        0.5 * q * (2.0 * self.cos_half - q)
    }

    /// `−d/dx [sin x / x] = (sin x − x cos x) / x²`; `x/3` near zero.
    #[must_use]
    pub fn sinc_drop(self) -> f64 {
        let x = self.value;
        if x.abs() < SERIES_LIMIT {
            let square = x * x;
            x * SLOPE_SERIES.iter().rev().fold(0.0, |sum, term| term - square * sum)
        } else {
            (self.sine() - x * self.cosine()) / (x * x)
        }
    }

    /// `sin(x/2) / (x/2)`; 1 at zero.
    fn half_sinc(self) -> f64 {
        if self.value == 0.0 { 1.0 } else { 2.0 * self.sin_half / self.value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (x, sinc, versinc, versine_ratio_slope, sinc_drop), from mpmath at 50 digits (`tests/data/special.py`).
    const REFERENCE: &[(f64, f64, f64, f64, f64)] = &include!("../../../tests/data/special.in");

    fn close(ours: f64, reference: f64) -> bool {
        (ours - reference).abs() <= 4.0 * f64::EPSILON * reference.abs().max(1e-3)
    }

    #[test]
    fn matches_high_precision_on_both_sides_of_every_switch() {
        for &(x, sinc, versinc, slope, drop) in REFERENCE {
            for x in [x, -x] {
                let angle = Angle::new(x);
                assert!(close(angle.sinc(), sinc), "sinc({x})");
                assert!(close(angle.versinc(), versinc), "versinc({x})");
                assert!(close(angle.versine_ratio_slope(), slope), "versine_ratio_slope({x})");
                assert!(close(angle.sinc_drop(), drop * x.signum()), "sinc_drop({x})");
            }
        }
    }

    #[test]
    fn is_relatively_exact_where_it_vanishes() {
        for &(x, _, _, _, drop) in REFERENCE.iter().filter(|row| row.0 < 0.5) {
            let ours = Angle::new(x).sinc_drop();
            assert!((ours - drop).abs() <= 4.0 * f64::EPSILON * drop.abs(), "sinc_drop({x})");
        }
    }

    #[test]
    fn is_exact_at_zero() {
        let zero = Angle::new(0.0);
        assert_eq!((zero.sinc(), zero.versinc(), zero.versine_ratio_slope(), zero.sinc_drop()), (1.0, 0.5, 0.5, 0.0));
    }

    #[test]
    fn does_not_jump_at_the_series_switch() {
        let below = Angle::new(f64::from_bits(SERIES_LIMIT.to_bits() - 1)).sinc_drop();
        let above = Angle::new(SERIES_LIMIT).sinc_drop();
        assert!((above - below).abs() < 4.0 * f64::EPSILON, "{below} {above}");
    }
}
