//! Quantities: SI inside, millimetres and degrees where a person reads and types.

use crate::scenario::text::number;
use std::f64::consts::PI;

/// What a number is, and so in which units it is shown and typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A length: m, shown in mm.
    Length,
    /// An angle: rad, shown in °.
    Angle,
    /// A time: s.
    Time,
    /// A share of something: 1, shown in %.
    Ratio,
    /// A moment: N·m, shown in mN·m.
    Moment,
    /// A force: N.
    Force,
    /// A frequency: Hz.
    Frequency,
    /// An angular speed: rad/s, shown in °/s.
    AngularSpeed,
    /// A speed: m/s, shown in mm/s.
    Speed,
    /// A modulus of elasticity: Pa, shown in GPa.
    Modulus,
    /// A number without unit.
    Count,
    /// No number: one of several words.
    Word,
}

/// A unit: its name, as it is written behind a number, and its size in SI as a numerator and a denominator, so that
/// 6.5 mm is the double nearest 0.0065 m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit(pub &'static str, pub f64, pub f64);

/// Who reads a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    /// One who writes files: SI and radians.
    Si,
    /// One who looks at the page: millimetres and degrees.
    Shown,
}

impl Quantity {
    /// The units that can be typed; the first is the one shown.
    #[must_use]
    #[rustfmt::skip]
    pub const fn units(self) -> &'static [Unit] {
        match self {
            Self::Length => &[
                Unit("mm", 1.0, 1e3), Unit("µm", 1.0, 1e6), Unit("μm", 1.0, 1e6), Unit("um", 1.0, 1e6), Unit("cm", 1.0, 1e2),
                Unit("m", 1.0, 1.0),
            ],
            Self::Angle => &[
                Unit("°", PI, 180.0), Unit("deg", PI, 180.0), Unit("degrees", PI, 180.0), Unit("rad", 1.0, 1.0),
                Unit("mrad", 1.0, 1e3),
            ],
            Self::Time => &[Unit("s", 1.0, 1.0), Unit("ms", 1.0, 1e3)],
            Self::Ratio => &[Unit("%", 1.0, 1e2)],
            Self::Moment => &[
                Unit("mN·m", 1.0, 1e3), Unit("mNm", 1.0, 1e3), Unit("N·mm", 1.0, 1e3), Unit("Nmm", 1.0, 1e3),
                Unit("N·m", 1.0, 1.0), Unit("Nm", 1.0, 1.0), Unit("N m", 1.0, 1.0),
            ],
            Self::Force => &[Unit("N", 1.0, 1.0), Unit("mN", 1.0, 1e3)],
            Self::Frequency => &[Unit("Hz", 1.0, 1.0), Unit("kHz", 1e3, 1.0)],
            Self::AngularSpeed => &[Unit("°/s", PI, 180.0), Unit("deg/s", PI, 180.0), Unit("rad/s", 1.0, 1.0)],
            Self::Speed => &[Unit("mm/s", 1.0, 1e3), Unit("cm/s", 1.0, 1e2), Unit("m/s", 1.0, 1.0)],
            Self::Modulus => &[Unit("GPa", 1e9, 1.0), Unit("MPa", 1e6, 1.0), Unit("Pa", 1.0, 1.0)],
            Self::Count | Self::Word => &[Unit("", 1.0, 1.0)],
        }
    }

    /// The unit it is shown in; empty for none.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        self.units()[0].0
    }

    /// The SI unit; empty for none.
    #[must_use]
    pub fn si_unit(self) -> &'static str {
        self.units().iter().find(|unit| unit.1 == 1.0 && unit.2 == 1.0).map_or("", |unit| unit.0)
    }

    /// An SI value in the unit shown.
    #[must_use]
    pub fn shown(self, si: f64) -> f64 {
        let Unit(_, over, under) = self.units()[0];
        // More digits than anyone types, and 0.01° does not come back as 0.009999999999999998°.
        rounded::<11>(si * under / over)
    }

    /// A value in the unit shown, in SI.
    #[must_use]
    pub fn si(self, shown: f64) -> f64 {
        let Unit(_, over, under) = self.units()[0];
        shown * over / under
    }

    /// A number and its unit as they are written: only the degree sign stands close to its number.
    #[must_use]
    pub fn joined(number: &str, unit: &str) -> String {
        let space = if unit.is_empty() || unit == "°" { "" } else { " " };
        format!("{number}{space}{unit}")
    }

    /// An SI value with its unit, as `units` has it.
    #[must_use]
    pub fn amount(self, si: f64, units: Units) -> String {
        let (text, unit) = match units {
            Units::Si => (readable(si), self.si_unit()),
            Units::Shown => (number(rounded::<5>(self.shown(si))).replace('-', "−"), self.unit()),
        };
        Self::joined(&text, unit)
    }
}

/// A number of the reference: with a power of ten where it would have many zeros.
#[must_use]
pub fn readable(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && size.is_finite() && !(1e-4..1e6).contains(&size) { format!("{value:e}") } else { number(value) }
}

/// A value with this many digits after its first.
fn rounded<const DIGITS: usize>(value: f64) -> f64 {
    format!("{value:.DIGITS$e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shown_comes_back_as_it_was_typed() {
        assert_eq!(Quantity::Angle.shown(Quantity::Angle.si(0.01)), 0.01);
        assert_eq!(Quantity::Length.si(6.5), 0.0065);
        assert_eq!(Quantity::Angle.shown(PI), 180.0);
        assert!(Quantity::Length.shown(f64::NAN).is_nan());
        assert_eq!(Quantity::Length.shown(f64::INFINITY), f64::INFINITY);
    }

    #[test]
    fn an_amount_has_the_reader_s_unit() {
        assert_eq!(Quantity::Length.amount(-0.0225, Units::Si), "-0.0225 m");
        assert_eq!(Quantity::Length.amount(-0.0225, Units::Shown), "−22.5 mm");
        assert_eq!(Quantity::Angle.amount(PI, Units::Shown), "180°");
        assert_eq!(Quantity::AngularSpeed.amount(PI, Units::Shown), "180 °/s");
        assert_eq!(Quantity::Modulus.amount(1e13, Units::Si), "1e13 Pa");
        assert_eq!(Quantity::Length.amount(1e-6, Units::Si), "1e-6 m");
        assert_eq!(Quantity::Frequency.amount(1e6, Units::Si), "1e6 Hz");
        assert_eq!(Quantity::Ratio.amount(1.0, Units::Si), "1");
        assert_eq!(Quantity::Ratio.amount(1.0, Units::Shown), "100 %");
    }
}
