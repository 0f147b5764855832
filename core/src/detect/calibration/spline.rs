//! A natural cubic spline through values at even places.

/// The first knot is at 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spline<const N: usize> {
    /// From knot to knot.
    spacing: f64,
    values: [f64; N],
    /// Second derivatives by the knot's number.
    bends: [f64; N],
}

impl<const N: usize> Spline<N> {
    /// Through values at 0 and then every `spacing`.
    #[must_use]
    pub fn new(spacing: f64, values: [f64; N]) -> Self {
        let (mut bends, mut upper) = ([0.0; N], [0.0; N]);
        for i in 1..N.saturating_sub(1) {
            let below = 4.0 - upper[i - 1];
            upper[i] = 1.0 / below;
            bends[i] = (6.0 * (values[i + 1] - 2.0 * values[i] + values[i - 1]) - bends[i - 1]) / below;
        }
        for i in (1..N.saturating_sub(1)).rev() {
            bends[i] -= upper[i] * bends[i + 1];
        }
        Self { spacing, values, bends }
    }

    /// The value at a place; beyond the last knots it goes on as the last cubics do.
    #[must_use]
    pub fn at(&self, place: f64) -> f64 {
        let knot = place / self.spacing;
        let i = (knot.max(0.0) as usize).min(N - 2);
        let (a, b) = (i as f64 + 1.0 - knot, knot - i as f64);
        let bend = |t: f64| t * (t * t - 1.0) / 6.0;
        a * self.values[i] + b * self.values[i + 1] + bend(a) * self.bends[i] + bend(b) * self.bends[i + 1]
    }

    /// The largest of the values.
    #[must_use]
    pub fn most(&self) -> f64 {
        self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_goes_through_its_knots_and_near_what_they_were_taken_from() {
        let spline = Spline::<20>::new(0.05, std::array::from_fn(|i| libm::sin(0.25 * i as f64)));
        for knot in 0..20 {
            let place = 0.05 * f64::from(knot);
            assert!((spline.at(place) - libm::sin(5.0 * place)).abs() < 1e-14);
            let between = place + 0.02;
            if between > 0.2 && between < 0.7 {
                assert!((spline.at(between) - libm::sin(5.0 * between)).abs() < 2e-5, "{between}");
            }
        }
    }
}
