//! How values lie along a slider.

use crate::app::controls::control::Scale;
use crate::app::controls::quantity::round_to;

/// The share of a logarithmic rail that stands for zero.
const ZERO: f64 = 0.05;

/// A rail: which value lies where, from 0 at its left end to 1 at its right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rail {
    /// Values at the two ends.
    pub range: (f64, f64),
    /// How they lie in between.
    pub scale: Scale,
}

impl Rail {
    /// Where a value lies, 0 to 1; beyond the ends it stays at the end.
    #[must_use]
    pub fn place(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        let along = match self.scale {
            Scale::LogWhole => (value / low).ln() / (high / low).ln(),
            Scale::Log(smallest) if value < smallest => ZERO * value / smallest,
            Scale::Log(smallest) => ZERO + (1.0 - ZERO) * (value / smallest).ln() / (high / smallest).ln(),
            Scale::Linear(_) | Scale::Whole | Scale::Stops => (value - low) / (high - low),
        };
        if along.is_nan() { 0.0 } else { along.clamp(0.0, 1.0) }
    }

    /// The value at a place, on the scale's steps.
    #[must_use]
    pub fn value(&self, place: f64) -> f64 {
        let (low, high) = self.range;
        let place = place.clamp(0.0, 1.0);
        let value = match self.scale {
            Scale::LogWhole => round_to(low * (high / low).powf(place), 2).round(),
            Scale::Log(_) if place < ZERO * 0.5 => 0.0,
            Scale::Log(smallest) => {
                let along = ((place - ZERO) / (1.0 - ZERO)).max(0.0);
                round_to(smallest * (high / smallest).powf(along), 2)
            }
            Scale::Linear(step) => snapped(low + (high - low) * place, step),
            Scale::Whole | Scale::Stops => (low + (high - low) * place).round(),
        };
        if value.is_nan() { low } else { value.clamp(low.min(high), high.max(low)) }
    }

    /// The value this many steps further.
    #[must_use]
    pub fn step(&self, value: f64, steps: f64) -> f64 {
        let (low, high) = self.range;
        let further = match self.scale {
            Scale::Linear(step) => snapped(value + steps * step, step),
            Scale::Whole | Scale::Stops => (value + steps).round(),
            Scale::LogWhole | Scale::Log(_) => {
                let next = self.value(self.place(value) + steps / 60.0);
                let stuck = next.to_bits() == value.to_bits();
                if self.scale == Scale::LogWhole && stuck { value + steps.signum() } else { next }
            }
        };
        if further.is_nan() { low } else { further.clamp(low.min(high), high.max(low)) }
    }

    /// The value this many tenths of the rail further, and at least as many steps.
    #[must_use]
    pub fn page(&self, value: f64, pages: f64) -> f64 {
        let (step, page) = (self.step(value, pages.signum()), self.value(self.place(value) + 0.1 * pages));
        if pages > 0.0 { page.max(step) } else { page.min(step) }
    }
}

/// The multiple of `step` nearest to a value, without the dust of binary fractions.
fn snapped(value: f64, step: f64) -> f64 {
    round_to((value / step).round() * step, 12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_found_where_it_lies() {
        for (rail, values) in [
            (Rail { range: (0.0, 10.0), scale: Scale::Linear(0.01) }, [0.0, 5.8, 10.0]),
            (Rail { range: (0.0, 3.0), scale: Scale::Stops }, [0.0, 2.0, 3.0]),
            (Rail { range: (1.0, 2000.0), scale: Scale::LogWhole }, [1.0, 500.0, 2000.0]),
            (Rail { range: (0.0, 1.0), scale: Scale::Log(0.001) }, [0.0, 0.05, 1.0]),
        ] {
            for value in values {
                assert_eq!(rail.value(rail.place(value)), value, "{rail:?}");
            }
        }
    }

    #[test]
    fn steps_move_and_stop_at_the_ends() {
        let filter = Rail { range: (1.0, 2000.0), scale: Scale::LogWhole };
        assert_eq!(filter.step(1.0, 1.0), 2.0);
        assert_eq!(filter.step(1.0, -1.0), 1.0);
        assert_eq!(filter.step(2000.0, 1.0), 2000.0);
        let time = Rail { range: (0.0, 10.0), scale: Scale::Linear(0.01) };
        assert_eq!(time.step(5.8, 1.0), 5.81);
    }

    #[test]
    fn a_page_is_a_tenth_of_the_rail_and_at_least_a_step() {
        let time = Rail { range: (0.0, 10.0), scale: Scale::Linear(0.01) };
        assert_eq!((time.page(5.0, 1.0), time.page(5.0, -1.0), time.page(9.9, 2.0)), (6.0, 4.0, 10.0));
        let disk = Rail { range: (0.0, 3.0), scale: Scale::Stops };
        assert_eq!((disk.page(1.0, 1.0), disk.page(1.0, -1.0), disk.page(0.0, -1.0)), (2.0, 0.0, 0.0));
        let filter = Rail { range: (1.0, 2000.0), scale: Scale::LogWhole };
        assert_eq!((filter.page(100.0, 1.0), filter.page(1.0, 1.0)), (210.0, 2.0));
    }

    #[test]
    fn an_empty_rail_has_one_place() {
        for scale in [Scale::Linear(0.1), Scale::Stops, Scale::Log(0.001), Scale::LogWhole] {
            let rail = Rail { range: (0.0, 0.0), scale };
            assert!(rail.place(0.0).is_finite() && rail.value(0.5).is_finite(), "{scale:?}");
            assert_eq!(rail.page(0.0, 1.0), 0.0, "{scale:?}");
        }
    }
}
