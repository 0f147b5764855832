//! The symbols: what each of them is called, its unit, and the anchor of its row in the theory.
//!
//! The page names a symbol under the pointer from this table, and `theory.html` makes its table of symbols from it.

use crate::chart::notation::printed;

/// A symbol of the model, of the detectors or of their settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Symbol {
    /// Its name in addresses: lower case letters, digits and `-`.
    pub id: &'static str,
    /// The symbol, in the notation of charts ([`crate::chart::notation`]).
    pub text: &'static str,
    /// What it is, to be read behind the symbol.
    pub name: &'static str,
    /// SI unit; 1 for none, empty where its parts differ.
    pub unit: &'static str,
}

impl Symbol {
    /// The name of its row in `theory.html`.
    ///
    /// ```
    /// use centrode_core::symbols::find;
    ///
    /// assert_eq!(find("xi2").map(|symbol| symbol.anchor()).as_deref(), Some("sym-xi2"));
    /// ```
    #[must_use]
    pub fn anchor(&self) -> String {
        format!("sym-{}", self.id)
    }

    /// A line that names it, with its unit where it has one.
    #[must_use]
    pub fn line(&self) -> String {
        match self.unit {
            "" | "1" => format!("{}: {}", self.text, self.name),
            unit => format!("{}: {} ({unit})", self.text, self.name),
        }
    }
}

const fn row(id: &'static str, text: &'static str, name: &'static str, unit: &'static str) -> Symbol {
    Symbol { id, text, name, unit }
}

/// All of them: geometry, motion, statics, contact, detection.
pub const SYMBOLS: &[Symbol] = &[
    row("l", "L", "length of the primary backbone, from base disk to end disk", "m"),
    row("s", "s", "arc length along the primary backbone, from the base", "m"),
    row("r", "r", "radius of the circle on which the secondary backbones stand", "m"),
    row("beta", "β", "angle between neighbouring secondary backbones, 2π/3", "rad"),
    row("theta-0", "θ_0", "tangent angle at the base, π/2", "rad"),
    row("theta-l", "θ_L", "tangent angle at the end disk in the bending plane; π/2 is straight", "rad"),
    row("theta-s", "θ_s", "tangent angle at arc length s", "rad"),
    row("phi", "φ", "bend, θ_0 − θ_L; positive toward (cos δ, −sin δ, 0)", "rad"),
    row("phi-s", "φ_s", "bend of the part below arc length s, φ s/L", "rad"),
    row("delta", "δ", "direction of the bending plane about the base's z axis", "rad"),
    row("psi", "ψ", "configuration, (θ_L, δ)", "rad"),
    row("q", "q_i", "how far secondary backbone i is pushed, L_i − L", "m"),
    row("l-i", "L_i", "length of secondary backbone i", "m"),
    row("p", "p", "position of a disk's centre in the base frame", "m"),
    row("rot", "R", "rotation from a disk's frame to the base frame", "1"),
    row("t", "t", "twist of a disk, linear velocity above angular velocity", ""),
    row("j-x", "J_x_ψ", "Jacobian from configuration rates to the twist of a disk", ""),
    row("j-q", "J_q_ψ", "Jacobian from configuration rates to joint speeds", "m/rad"),
    row("omega", "ω", "angular velocity of the end disk", "rad/s"),
    row("omega-matrix", "Ω", "matrix of the cross product with ω", "rad/s"),
    row("e", "E", "elastic energy of the segment", "J"),
    row("ep-ip", "E_PI_P", "bending stiffness of the primary backbone", "N·m²"),
    row("es-is", "E_SI_S", "bending stiffness of each secondary backbone", "N·m²"),
    row("tau", "τ", "forces in the secondary backbones", "N"),
    row("tau-lc", "τ_l_c", "forces that the load cells read", "N"),
    row("epsilon-tau", "ε_τ", "relative error of a load cell, friction included", "1"),
    row("w-e", "W_e", "wrench of the surroundings on the end disk, force above moment", ""),
    row("theta", "Θ", "joint force deviation, of what the load cells read from the model", "N·m"),
    row("epsilon-c", "ε_c", "joint force deviation that load cell errors alone can cause", "N·m"),
    row("xi1", "ξ_1", "threshold of the joint force deviation", "N·m"),
    row("k", "k", "factor of a threshold that follows ε_c", "1"),
    row("c-m", "c_m", "centrode that the model expects without contact", "m"),
    row("c-s", "c_s", "centrode that the tracker measures", "m"),
    row("c-c", "c_c", "centrode that the model expects with a contact", "m"),
    row("deviation", "‖c_m − c_s‖", "centrode deviation, of the measured centrode from the model's", "m"),
    row("xi2", "ξ_2", "threshold of the centrode deviation", "m"),
    row("s-c", "s_c", "arc length of the contact", "m"),
    row("phi-c", "φ_c", "bend when the contact began", "rad"),
    row("kappa", "κ", "curvature of the primary backbone", "1/m"),
    row("f", "F", "force of a beam that only touches", "N"),
    row("n", "N", "length of the moving average, in samples of the loop", "1"),
    row("c-f", "c_f", "the model's centrode, sampled, delayed and averaged as the sensor's is", "m"),
    row("xi-f", "ξ_f", "threshold of ‖c_f − c_s‖", "m"),
    row("xi-v", "ξ_v", "threshold of ‖ω_s‖‖c_m − c_s‖", "m/s"),
    row("nu", "ν", "innovations: readings less all that the calibration filter could predict, of unit variance", "1"),
    row("eta", "η", "errors of the calibration", ""),
    row("g", "g", "cumulative sum, a log likelihood ratio", "1"),
    row("h", "h", "threshold of the cumulative sum", "1"),
    row("lambda", "Λ", "largest log likelihood ratio over places and beginnings", "1"),
    row("h-lambda", "h_Λ", "threshold of Λ", "1"),
];

/// The symbol of a name in addresses.
#[must_use]
pub fn find(id: &str) -> Option<&'static Symbol> {
    SYMBOLS.iter().find(|symbol| symbol.id == id)
}

/// The symbols that a label holds, in its order, each once: `k in k·ε_c(θL)` has k, ε_c and θ_L. A letter alone in brackets is a unit,
/// and `‖c_m − c_s‖` is one symbol.
///
/// ```
/// use centrode_core::symbols::within;
///
/// let ids = |label| within(label).iter().map(|symbol| symbol.id).collect::<Vec<_>>();
/// assert_eq!(ids("k in k·ε_c(θL)"), ["k", "epsilon-c", "theta-l"]);
/// assert_eq!(ids("Centrode deviation ‖c_m − c_s‖ (mm)"), ["deviation"]);
/// assert_eq!(ids("Time (s)"), [] as [&str; 0]);
/// ```
#[must_use]
pub fn within(label: &str) -> Vec<&'static Symbol> {
    let mut rest: String = bare(&printed(label));
    let mut found: Vec<(usize, &'static Symbol)> = Vec::new();
    for symbol in SYMBOLS.iter().filter(|symbol| symbol.text.starts_with('‖')) {
        if let Some(at) = rest.find(&bare(symbol.text)) {
            found.push((at, symbol));
            let text = bare(symbol.text);
            rest.replace_range(at..at + text.len(), &" ".repeat(text.len()));
        }
    }
    for (at, word) in words(&rest) {
        let bracketed = rest[..at].ends_with('(') && rest[at + word.len()..].starts_with(')');
        let unit = bracketed && word.len() == 1;
        let symbol = SYMBOLS.iter().find(|symbol| bare(symbol.text) == word && !unit);
        if let Some(symbol) = symbol.filter(|symbol| found.iter().all(|(_, other)| other.id != symbol.id)) {
            found.push((at, symbol));
        }
    }
    found.sort_by_key(|(at, _)| *at);
    found.into_iter().map(|(_, symbol)| symbol).collect()
}

/// Without what lowers characters: labels lower them or not.
fn bare(text: &str) -> String {
    text.replace('_', "")
}

/// The words of a text, with their places.
fn words(text: &str) -> Vec<(usize, &str)> {
    let mut words = Vec::new();
    let mut start = None;
    for (at, character) in text.char_indices().chain([(text.len(), ' ')]) {
        match (character.is_alphanumeric(), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                words.push((from, &text[from..at]));
                start = None;
            }
            _ => {}
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::course::measure;

    #[test]
    fn names_and_symbols_are_there_once() {
        for (k, symbol) in SYMBOLS.iter().enumerate() {
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            assert!(!symbol.id.is_empty() && symbol.id.chars().all(plain), "{}", symbol.id);
            assert!(!symbol.name.is_empty() && !symbol.name.ends_with('.'), "{}", symbol.id);
            assert_eq!(find(symbol.id), Some(symbol));
            for other in &SYMBOLS[..k] {
                assert!(symbol.id != other.id && bare(symbol.text) != bare(other.text), "{}", symbol.id);
            }
        }
    }

    #[test]
    fn what_a_detector_judges_and_its_threshold_are_symbols() {
        for &method in crate::detect::Method::ALL {
            let measure = measure(method);
            for text in [measure.symbol, measure.threshold] {
                assert!(!within(text).is_empty(), "{text}");
            }
        }
    }

    #[test]
    fn words_without_symbols_have_none() {
        for label in ["Contact disk", "Release", "Force y", "Time (s)", "Seed", ""] {
            assert_eq!(within(label), [] as [&Symbol; 0], "{label}");
        }
        let ids = |label| within(label).iter().map(|symbol| symbol.id).collect::<Vec<_>>();
        assert_eq!(ids("hΛ (GLR)"), ["h-lambda"]);
        assert_eq!(ids("Length L"), ["l"]);
        assert_eq!(ids("ξ2 (centrode)"), ["xi2"]);
        assert_eq!(ids("Load cell error ε_τ"), ["epsilon-tau"]);
    }
}
