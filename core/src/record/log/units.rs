//! Units of a log's columns, and what the columns may hold.

use std::f64::consts::PI;

/// What a column's numbers are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// s.
    Time,
    /// m.
    Length,
    /// rad.
    Angle,
    /// N.
    Force,
    /// 1.
    None,
}

/// A unit and its size in SI as a numerator and a denominator, so that 6.5 mm is the double nearest to 0.0065 m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// As a header has it.
    pub name: &'static str,
    over: f64,
    under: f64,
}

impl Unit {
    /// One `under`th of the SI unit.
    #[must_use]
    pub const fn share(name: &'static str, under: f64) -> Self {
        Self { name, over: 1.0, under }
    }

    /// A number of this unit in SI.
    #[must_use]
    #[inline]
    pub fn si(&self, value: f64) -> f64 {
        value * self.over / self.under
    }
}

impl Dimension {
    /// The units that a header may name; the first is SI. µ may be U+00B5 or U+03BC.
    #[must_use]
    pub const fn units(self) -> &'static [Unit] {
        match self {
            Self::Time => &[
                Unit { name: "s", over: 1.0, under: 1.0 },
                Unit { name: "ms", over: 1.0, under: 1e3 },
                Unit { name: "µs", over: 1.0, under: 1e6 },
                Unit { name: "μs", over: 1.0, under: 1e6 },
                Unit { name: "us", over: 1.0, under: 1e6 },
                Unit { name: "ns", over: 1.0, under: 1e9 },
            ],
            Self::Length => &[
                Unit { name: "m", over: 1.0, under: 1.0 },
                Unit { name: "mm", over: 1.0, under: 1e3 },
                Unit { name: "µm", over: 1.0, under: 1e6 },
                Unit { name: "μm", over: 1.0, under: 1e6 },
                Unit { name: "um", over: 1.0, under: 1e6 },
            ],
            Self::Angle => &[
                Unit { name: "rad", over: 1.0, under: 1.0 },
                Unit { name: "deg", over: PI, under: 180.0 },
                Unit { name: "°", over: PI, under: 180.0 },
            ],
            Self::Force => &[Unit { name: "N", over: 1.0, under: 1.0 }, Unit { name: "mN", over: 1.0, under: 1e3 }],
            Self::None => &[
                Unit { name: "1", over: 1.0, under: 1.0 },
                Unit { name: "", over: 1.0, under: 1.0 },
                Unit { name: "-", over: 1.0, under: 1.0 },
            ],
        }
    }

    /// The unit of a name.
    #[must_use]
    pub fn unit(self, name: &str) -> Option<Unit> {
        self.units().iter().find(|unit| unit.name == name).copied()
    }

    /// SI.
    #[must_use]
    pub const fn si(self) -> Unit {
        self.units()[0]
    }

    /// Numbers in SI go this far either way: what lies beyond was never measured.
    #[must_use]
    pub const fn most(self) -> f64 {
        match self {
            // Nanoseconds since 1970 fit in well.
            Self::Time => 1e11,
            Self::Length | Self::Force | Self::None => 1e6,
            Self::Angle => crate::scenario::plan::MAX_TURN,
        }
    }

    /// The names of the units, for a message.
    #[must_use]
    pub fn names(self) -> &'static str {
        match self {
            Self::Time => "s, ms, µs, ns",
            Self::Length => "m, mm, µm",
            Self::Angle => "rad, deg",
            Self::Force => "N, mN",
            Self::None => "1",
        }
    }
}
