//! The symbols: what each of them is called, its unit, and the anchor of its row in the theory.
//!
//! The page names a symbol under the pointer from this table, and `theory.html` makes its table of symbols from it.

use crate::chart::notation::printed;
use std::ops::Range;

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
    row("gamma", "γ", "angle by which a segment's secondary backbones are turned on their circle", "rad"),
    row("u", "U", "integrals of a segment's curvature about its own x and y axes, φ (sin δ, cos δ)", "rad"),
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
    row("ei", "EI", "bending stiffness of all backbones in a segment together", "N·m²"),
    row("gj", "GJ", "stiffness of a segment in torsion", "N·m²"),
    row("mu", "μ", "stability margin: 1 without a force, 0 where the robot buckles", "1"),
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
    row("screw-distance", "‖f_m − f_s‖", "distance between the screw axes of model and sensor, at the disk below", "m"),
    row("xi-d", "ξ_d", "threshold of ‖f_m − f_s‖", "m"),
    row("screw-angle", "α", "angle between the screw axes of model and sensor", "rad"),
    row("xi-angle", "ξ_α", "threshold of α", "rad"),
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

/// The symbols that a label holds, in its order, each once: `k in k·ε_c(θL)` has k, ε_c and θ_L. What is a unit there is no symbol,
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
    let mut found: Vec<&'static Symbol> = Vec::new();
    for (_, symbol) in spans(&bare(&printed(label))) {
        if found.iter().all(|other| other.id != symbol.id) {
            found.push(symbol);
        }
    }
    found
}

/// Where symbols stand in a text as it is drawn, without what lowers characters: ranges of characters, not of bytes.
///
/// ```
/// use centrode_core::symbols::spans;
///
/// let at = spans("ξ2 is 7 mm").into_iter().map(|(at, symbol)| (at, symbol.id)).collect::<Vec<_>>();
/// assert_eq!(at, [(0..2, "xi2")]);
/// ```
#[must_use]
pub fn spans(drawn: &str) -> Vec<(Range<usize>, &'static Symbol)> {
    let mut rest: Vec<char> = drawn.chars().collect();
    let mut found = Vec::new();
    for symbol in SYMBOLS.iter().filter(|symbol| symbol.text.contains('‖')) {
        let whole: Vec<char> = bare(symbol.text).chars().collect();
        let mut from = 0;
        while let Some(at) = rest[from..].windows(whole.len()).position(|window| window == whole) {
            let at = from + at..from + at + whole.len();
            from = at.end;
            rest[at.clone()].fill(' ');
            found.push((at, symbol));
        }
    }
    for at in words(&rest) {
        let word: String = rest[at.clone()].iter().collect();
        let symbol = SYMBOLS.iter().find(|symbol| symbol.text.chars().filter(|c| *c != '_').eq(word.chars()));
        if let Some(symbol) = symbol.filter(|symbol| !is_unit(&rest, &at) && can_be(symbol, &rest[at.end..])) {
            found.push((at, symbol));
        }
    }
    found.sort_by_key(|(at, _)| at.start);
    found
}

/// Names of units that are symbols, too, and of those that stand beside them.
const UNITS: [&str; 9] = ["s", "N", "m", "mm", "ms", "mN", "Nm", "rad", "J"];

/// Whether a symbol can be meant where `behind` follows: what has no unit of its own has none in brackets, as time has in `t (s)`.
fn can_be(symbol: &Symbol, behind: &[char]) -> bool {
    let unit = |unit: &str| behind.iter().copied().take(unit.chars().count() + 3).eq(format!(" ({unit})").chars());
    !symbol.unit.is_empty() || !UNITS.iter().any(|name| unit(name))
}

/// Whether a word is a unit where it stands: behind a number or what stands for one, in a product or a quotient of units, or
/// alone in brackets or altogether.
fn is_unit(text: &[char], at: &Range<usize>) -> bool {
    let apart = |c: &char| c.is_whitespace() || "()[],;:".contains(*c);
    let from = text[..at.start].iter().rposition(apart).map_or(0, |k| k + 1);
    let to = text[at.end..].iter().position(apart).map_or(text.len(), |k| at.end + k);
    let words: Vec<Range<usize>> = words(&text[from..to]);
    let known = |word: &Range<usize>| {
        let word: String = text[from..to][word.clone()].iter().collect();
        word.chars().all(|c| c.is_numeric()) || UNITS.contains(&word.as_str())
    };
    if !words.iter().all(known) {
        return false;
    }
    let before = text[..from].iter().rfind(|c| !c.is_whitespace());
    let bracketed = from > 0 && text[from - 1] == '(' && text.get(to) == Some(&')');
    let alone = at.len() == text.len();
    words.len() > 1 || bracketed || alone || before.is_some_and(|c| c.is_numeric() || "–…".contains(*c))
}

/// Without what lowers characters: labels lower them or not.
fn bare(text: &str) -> String {
    text.replace('_', "")
}

/// The words of a text, by their places.
fn words(text: &[char]) -> Vec<Range<usize>> {
    let mut words = Vec::new();
    let mut start = None;
    for (at, character) in text.iter().chain([&' ']).enumerate() {
        // What follows an apostrophe belongs to its word.
        match (character.is_alphanumeric() || "'’".contains(*character), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                words.push(from..at);
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
        let none = ["Contact disk", "Release", "Force y", "Time (s)", "Seed", "The tracker's", ""];
        let units = ["6.28 s", "7\u{a0}s later", "– s", "0.12 N", "Speed (mm/s)", "N·m", "t (s)", "s"];
        for label in none.into_iter().chain(units) {
            assert_eq!(within(label), [] as [&Symbol; 0], "{label}");
        }
        let ids = |label| within(label).iter().map(|symbol| symbol.id).collect::<Vec<_>>();
        assert_eq!(ids("hΛ (GLR)"), ["h-lambda"]);
        assert_eq!(ids("Length L"), ["l"]);
        assert_eq!(ids("ξ2 (centrode)"), ["xi2"]);
        assert_eq!(ids("Load cell error ε_τ"), ["epsilon-tau"]);
        assert_eq!(ids("α above ξ_α or ‖f_m − f_s‖ above ξ_d"), ["screw-angle", "xi-angle", "screw-distance", "xi-d"]);
        assert_eq!(ids("Arc length s (mm), force F (N), N of 250"), ["s", "f", "n"]);
    }
}
