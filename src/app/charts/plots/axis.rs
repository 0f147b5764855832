//! The core's scale in the interface's points.

use centrode_core::chart::scale::Scale;
use centrode_core::chart::ticks::Tick;
use centrode_core::chart::ticks::ticks;
pub use centrode_core::chart::ticks::{Steps, rounded};

/// Maps values to points of the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis(Scale);

impl Axis {
    /// The range's lower end lies at the first point, its upper end at the second.
    #[must_use]
    pub fn new(range: [f64; 2], ends: [f32; 2]) -> Self {
        Self(Scale::new(range, ends.map(f64::from)))
    }

    /// Both ends of the range.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        self.0.range()
    }

    /// Value per point, positive.
    #[must_use]
    pub fn per_point(&self) -> f64 {
        self.0.per_point()
    }

    /// Where a value lies; see [`Scale::at`].
    #[must_use]
    pub fn at(&self, value: f64) -> f32 {
        self.0.at(value) as f32
    }

    /// The value at a point, within the range.
    #[must_use]
    pub fn value(&self, point: f32) -> f64 {
        self.0.value(point.into())
    }

    /// Whether the range holds a value.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        self.0.holds(value)
    }

    /// Round values at least `spacing` points apart, and how to write them.
    #[must_use]
    pub fn ticks(&self, spacing: f32, steps: Steps) -> Vec<Tick> {
        ticks(&self.0, spacing.into(), steps)
    }
}
