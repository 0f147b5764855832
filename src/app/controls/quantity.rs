//! Quantities as a person reads and types them: millimetres and degrees here, SI everywhere else.

use std::f64::consts::PI;

use crate::app::charts::notation;

/// What a number is, and so how it is shown and typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A length, shown in mm.
    Length,
    /// An angle, shown in °.
    Angle,
    /// A time, shown in s.
    Time,
    /// A ratio, shown in %.
    Ratio,
    /// A moment, shown in mN·m.
    Moment,
    /// A force, shown in N.
    Force,
    /// A frequency, shown in Hz.
    Frequency,
    /// An angular speed, shown in °/s.
    AngularSpeed,
    /// A modulus of elasticity, shown in GPa.
    Modulus,
    /// A number without unit.
    Count,
}

/// A unit: its name, and its size in SI as a numerator and a denominator, so that 6.5 mm is the double nearest 0.0065 m.
struct Unit(&'static str, f64, f64);

impl Quantity {
    /// The first is the one shown.
    #[rustfmt::skip]
    fn units(self) -> &'static [Unit] {
        match self {
            Self::Length => &[
                Unit("mm", 1.0, 1e3), Unit("µm", 1.0, 1e6), Unit("μm", 1.0, 1e6), Unit("um", 1.0, 1e6), Unit("cm", 1.0, 1e2), Unit("m", 1.0, 1.0),
            ],
            Self::Angle => &[
                Unit("°", PI, 180.0), Unit("deg", PI, 180.0), Unit("degrees", PI, 180.0), Unit("rad", 1.0, 1.0), Unit("mrad", 1.0, 1e3),
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
            Self::Modulus => &[Unit("GPa", 1e9, 1.0), Unit("MPa", 1e6, 1.0), Unit("Pa", 1.0, 1.0)],
            Self::Count => &[Unit("", 1.0, 1.0)],
        }
    }

    /// The unit it is shown in.
    #[must_use]
    pub fn unit(self) -> &'static str {
        self.units()[0].0
    }

    /// The SI unit, empty for none.
    #[must_use]
    pub fn si_unit(self) -> &'static str {
        self.units().iter().find(|unit| unit.1 == 1.0 && unit.2 == 1.0).map_or("", |unit| unit.0)
    }

    /// An SI value in the unit shown.
    #[must_use]
    pub fn shown(self, si: f64) -> f64 {
        let Unit(_, over, under) = self.units()[0];
        // More digits than anyone types, and 0.01° does not come back as 0.009999999999999998°.
        round_to(si * under / over, 12)
    }

    /// A value in the unit shown, in SI.
    #[must_use]
    pub fn si(self, shown: f64) -> f64 {
        let Unit(_, over, under) = self.units()[0];
        shown * over / under
    }

    /// Reads what a person typed, with or without unit; the result is in the unit shown.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn parse(self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let (number, unit) = split(text).ok_or_else(|| format!("“{}” is not a number", shorten(text)))?;
        if !number.is_finite() {
            return Err(format!("“{}” is not a finite number", shorten(text)));
        }
        if unit.is_empty() {
            return Ok(number);
        }
        let known = self.units().iter().position(|Unit(name, ..)| *name == unit);
        match (known, self.unit()) {
            (Some(0), _) => Ok(number),
            (Some(other), _) => {
                let Unit(_, over, under) = self.units()[other];
                Ok(self.shown(number * over / under))
            }
            (None, "") => Err(format!("“{}”: a plain number is expected, without unit", shorten(text))),
            (None, own) => Err(format!("“{}”: {own} is expected, not “{}”", shorten(text), shorten(unit))),
        }
    }
}

/// A number with `decimals` digits after the point, and one more where the value has it.
#[must_use]
pub fn number(value: f64, decimals: usize) -> String {
    let mut text = notation::number(value, decimals + 1);
    if value != 0.0 && !text.contains(|c: char| ('1'..='9').contains(&c)) && value.is_finite() {
        // What is not zero does not look like zero.
        return format!("{value:.0e}").replace('-', "−");
    }
    if text.ends_with('0') {
        text.pop();
    }
    if text.ends_with('.') {
        text.pop();
    }
    text
}

/// Rounds to this many significant digits.
#[must_use]
pub fn round_to(value: f64, digits: i32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let power = digits - 1 - value.abs().log10().floor() as i32;
    // Dividing by a power of ten is exact where multiplying by its inverse is not.
    let rounded = if power >= 0 {
        let scale = 10f64.powi(power);
        (value * scale).round() / scale
    } else {
        let scale = 10f64.powi(-power);
        (value / scale).round() * scale
    };
    if rounded.is_finite() { rounded } else { value }
}

/// The number at the start of a text, and the rest.
fn split(text: &str) -> Option<(f64, &str)> {
    if text.chars().count() > 64 {
        return None;
    }
    let ends = text.char_indices().map(|(at, c)| at + c.len_utf8()).rev();
    ends.filter_map(|end| {
        let (head, rest) = text.split_at(end);
        let mut head = head.trim().replace('−', "-");
        if head.matches(',').count() == 1 && !head.contains('.') {
            head = head.replace(',', ".");
        }
        Some((head.parse::<f64>().ok()?, rest.trim()))
    })
    .next()
}

/// A text short enough for a message.
#[must_use]
pub fn shorten(text: &str) -> String {
    if text.chars().count() <= 16 { text.into() } else { text.chars().take(15).chain(['…']).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_person_types_is_read() {
        for (quantity, text, shown) in [
            (Quantity::Length, "15", 15.0),
            (Quantity::Length, " 15 mm ", 15.0),
            (Quantity::Length, "50µm", 0.05),
            (Quantity::Length, "0.015 m", 15.0),
            (Quantity::Angle, "−90°", -90.0),
            (Quantity::Angle, "0.01 deg", 0.01),
            (Quantity::Time, "5,8", 5.8),
            (Quantity::Time, "5800 ms", 5.8),
            (Quantity::Ratio, "10 %", 10.0),
            (Quantity::Moment, "30 mN·m", 30.0),
            (Quantity::Moment, "0.03 N·m", 30.0),
            (Quantity::Count, "1e3", 1000.0),
        ] {
            assert_eq!(quantity.parse(text), Ok(shown), "{text}");
        }
        assert_eq!(Quantity::Angle.shown(Quantity::Angle.si(0.01)), 0.01);
    }

    #[test]
    fn nonsense_is_refused_in_words() {
        for text in ["", "abc", "nan", "inf", "1e999", "5.8 kg", "--3", "😀", "3 mm mm", "１２", &"9".repeat(5000)]
        {
            let message = Quantity::Length.parse(text).expect_err(text);
            assert!(message.contains('“') && message.chars().count() < 80, "{message}");
        }
        assert!(Quantity::Count.parse("3 mm").is_err());
    }

    #[test]
    fn numbers_keep_the_digits_they_have() {
        assert_eq!(number(5.8, 2), "5.80");
        assert_eq!(number(5.8125, 2), "5.812");
        assert_eq!(number(2.864_789, 2), "2.865");
        assert_eq!(number(2.5, 0), "2.5");
        assert_eq!(number(-0.0, 1), "0.0");
        assert_eq!(number(-1e-5, 1), "−1e−5");
        assert_eq!(Quantity::Length.parse("1e−5"), Ok(1e-5));
        assert_eq!(number(500.0, 0), "500");
        assert_eq!(number(-0.05, 2), "−0.05");
        assert_eq!(number(0.01, 3), "0.010");
        assert_eq!(number(f64::NAN, 1), "–");
        assert_eq!(round_to(123_456.0, 2), 120_000.0);
    }
}
