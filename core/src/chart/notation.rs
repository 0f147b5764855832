//! How symbols are written: `_x` is an x below the line, as in `θ_L`, and `__` an underscore; numbers have a true minus.

/// A part of a text that is written in one way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stretch {
    /// Its characters.
    pub text: String,
    /// Whether they stand below the line.
    pub low: bool,
}

/// Parts a text. A `_` at the very end lowers nothing and is left out.
#[must_use]
pub fn runs(text: &str) -> Vec<Stretch> {
    let mut runs: Vec<Stretch> = Vec::new();
    let mut low = false;
    for character in text.chars() {
        if character == '_' && !low {
            low = true;
            continue;
        }
        low &= character != '_';
        match runs.last_mut() {
            Some(run) if run.low == low => run.text.push(character),
            _ => runs.push(Stretch { text: character.into(), low }),
        }
        low = false;
    }
    runs
}

/// A text that is shown as it stands, such as a key.
#[must_use]
pub fn plain(text: &str) -> String {
    text.replace('_', "__")
}

/// A text whose symbols are as in print, whichever way they were typed: indices below the line, and norms with their own bar.
#[must_use]
pub fn printed(text: &str) -> String {
    text.replace("ξ1", "ξ_1").replace("ξ2", "ξ_2").replace("θL", "θ_L").replace("||", "‖")
}

/// A number with a true minus sign; `–` where it is not defined.
#[must_use]
pub fn number(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(size) if size.bytes().all(|b| b == b'0' || b == b'.') => size.into(),
        Some(size) => format!("−{size}"),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_underscore_lowers_one_character() {
        let run = |text: &str, low| Stretch { text: text.into(), low };
        assert_eq!(runs("ε_c of θ_L"), [run("ε", false), run("c", true), run(" of θ", false), run("L", true)]);
        assert_eq!(runs("a__b_"), [run("a_b", false)]);
        assert_eq!(runs(&plain("min_speed")), [run("min_speed", false)]);
        assert_eq!(printed("θL, ξ2, ||c||"), "θ_L, ξ_2, ‖c‖");
    }

    #[test]
    fn numbers_have_a_minus_and_no_negative_zero() {
        assert_eq!(number(-1.25, 1), "−1.2");
        assert_eq!(number(-0.001, 2), "0.00");
        assert_eq!(number(7.0, 2), "7.00");
        assert_eq!(number(f64::NAN, 2), "–");
        assert_eq!(number(f64::INFINITY, 2), "–");
    }
}
