//! Numbers as a person reads and types them: millimetres and degrees here, SI everywhere else.

use crate::app::charts::notation;
use centrode_core::scenario::keys::Quantity;
use centrode_core::scenario::keys::quantity::Unit;

/// Reads what a person typed, with or without unit; the result is in the unit shown.
///
/// # Errors
/// What is wrong with it, in words.
pub fn parse(quantity: Quantity, text: &str) -> Result<f64, String> {
    let text = text.trim();
    if grouped(text) {
        return Err(format!("“{}” is ambiguous: leave the comma out, or write a decimal point", shorten(text)));
    }
    let (number, unit) = split(text).ok_or_else(|| format!("“{}” is not a number", shorten(text)))?;
    if !number.is_finite() {
        return Err(format!("“{}” is not a finite number", shorten(text)));
    }
    if unit.is_empty() {
        return Ok(number);
    }
    let known = quantity.units().iter().position(|Unit(name, ..)| *name == unit);
    match (known, quantity.unit()) {
        (Some(0), _) => Ok(number),
        (Some(other), _) => {
            let Unit(_, over, under) = quantity.units()[other];
            Ok(quantity.shown(number * over / under))
        }
        (None, "") => Err(format!("“{}”: a plain number is expected, without unit", shorten(text))),
        (None, own) => Err(format!("“{}”: {own} is expected, not “{}”", shorten(text), shorten(unit))),
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

/// Whether a text's only comma may part thousands as well as decimals: exactly three digits follow it. Behind a lone 0
/// it can only be decimal, as in 0,007.
fn grouped(text: &str) -> bool {
    let Some((before, after)) = text.split_once(',').filter(|(before, _)| !before.contains('.')) else { return false };
    let three = after.chars().take_while(char::is_ascii_digit).count() == 3;
    three && !matches!(before.trim().trim_start_matches(['-', '−', '+']), "" | "0")
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
            assert_eq!(parse(quantity, text), Ok(shown), "{text}");
        }
    }

    #[test]
    fn nonsense_is_refused_in_words() {
        for text in ["", "abc", "nan", "inf", "1e999", "5.8 kg", "--3", "😀", "3 mm mm", "１２", &"9".repeat(5000)]
        {
            let message = parse(Quantity::Length, text).expect_err(text);
            assert!(message.contains('“') && message.chars().count() < 80, "{message}");
        }
        assert!(parse(Quantity::Count, "3 mm").is_err());
    }

    #[test]
    fn a_comma_before_three_digits_is_not_guessed_at() {
        for text in ["1,000", "−1,500 mm", "12,345", "1,000 µm", "1,000e3"] {
            let message = parse(Quantity::Length, text).expect_err(text);
            assert!(message.contains("is ambiguous") && message.chars().count() < 90, "{message}");
        }
        for (text, value) in
            [("1,5", 1.5), ("1,00", 1.0), ("1,0000", 1.0), ("0,007", 0.007), ("-0,125", -0.125), (",125", 0.125)]
        {
            assert_eq!(parse(Quantity::Count, text), Ok(value), "{text}");
        }
    }

    #[test]
    fn numbers_keep_the_digits_they_have() {
        assert_eq!(number(5.8, 2), "5.80");
        assert_eq!(number(5.8125, 2), "5.812");
        assert_eq!(number(2.864_789, 2), "2.865");
        assert_eq!(number(2.5, 0), "2.5");
        assert_eq!(number(-0.0, 1), "0.0");
        assert_eq!(number(-1e-5, 1), "−1e−5");
        assert_eq!(parse(Quantity::Length, "1e−5"), Ok(1e-5));
        assert_eq!(number(500.0, 0), "500");
        assert_eq!(number(-0.05, 2), "−0.05");
        assert_eq!(number(0.01, 3), "0.010");
        assert_eq!(number(f64::NAN, 1), "–");
        assert_eq!(round_to(123_456.0, 2), 120_000.0);
    }
}
