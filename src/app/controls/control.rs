//! What a control is: one row of a table, from which the panel draws label, slider, field and reset.

use crate::app::controls::quantity::{Quantity, number};
use centrode_core::scenario::Scenario;

/// A part of the panel that folds.
#[derive(Debug)]
pub struct Group {
    /// Its title.
    pub name: &'static str,
    /// Whether it is folded until someone opens it.
    pub folded: bool,
    /// Numbers.
    pub controls: &'static [Control],
    /// Options.
    pub choices: &'static [Choice],
    /// What is worth knowing about them, below; empty for nothing.
    pub note: &'static str,
}

/// How values lie along a slider, in the unit shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Evenly, in steps of this.
    Linear(f64),
    /// Whole numbers, evenly.
    Whole,
    /// Few whole numbers, each with its own stop.
    Stops,
    /// Whole numbers from 1, as many on the rail from 1 to 10 as from 10 to 100.
    LogWhole,
    /// Zero, then from this value up, as many from one to ten of it as from ten to a hundred.
    Log(f64),
}

impl Scale {
    /// Whether only whole numbers, 0 or more, are on it.
    #[must_use]
    pub fn is_whole(self) -> bool {
        matches!(self, Self::Whole | Self::Stops | Self::LogWhole)
    }
}

/// A number that can be slid and typed. Values are in the unit shown unless said otherwise.
pub struct Control {
    /// Key in a scenario file.
    pub key: &'static str,
    /// Name, also to assistive technology and tests.
    pub label: &'static str,
    /// What it is.
    pub quantity: Quantity,
    /// Digits after the point.
    pub decimals: usize,
    /// How values lie along the slider.
    pub scale: Scale,
    /// Ends of the slider; what is typed may lie outside.
    pub range: fn(&Scenario) -> (f64, f64),
    /// What it does, in a line.
    pub tip: &'static str,
    /// The value in SI; none while it is switched off.
    pub get: fn(&Scenario) -> Option<f64>,
    /// Sets the value, in SI.
    pub set: fn(&mut Scenario, f64),
    /// Copies the setting from one scenario into another.
    pub copy: fn(&Scenario, &mut Scenario),
    /// Switches it off, where that is possible.
    pub off: Option<fn(&mut Scenario)>,
    /// Words in place of the number.
    pub words: Option<Words>,
}

/// For a control whose setting is not always a number.
#[derive(Clone, Copy)]
pub struct Words {
    /// Name, where it is not the control's.
    pub label: fn(&Scenario) -> Option<&'static str>,
    /// Text and unit, where they are not the number's.
    pub show: fn(&Scenario) -> Option<(String, &'static str)>,
    /// Reads a text; none leaves it to the quantity.
    pub enter: fn(&mut Scenario, &str) -> Option<Result<(), String>>,
}

impl std::fmt::Debug for Control {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Control({})", self.key)
    }
}

impl Control {
    /// The value in the unit shown; none while it is switched off.
    #[must_use]
    pub fn value(&self, scenario: &Scenario) -> Option<f64> {
        (self.get)(scenario).map(|si| self.quantity.shown(si))
    }

    /// Name, for what the setting holds.
    #[must_use]
    pub fn label(&self, scenario: &Scenario) -> &'static str {
        self.words.and_then(|words| (words.label)(scenario)).unwrap_or(self.label)
    }

    /// Text and unit of the field.
    #[must_use]
    pub fn text(&self, scenario: &Scenario) -> (String, &'static str) {
        if let Some(shown) = self.words.and_then(|words| (words.show)(scenario)) {
            return shown;
        }
        self.value(scenario).map_or(("off".into(), ""), |value| (number(value, self.decimals), self.quantity.unit()))
    }

    /// Sets it from the unit shown.
    pub fn slide(&self, scenario: &mut Scenario, value: f64) {
        (self.set)(scenario, self.quantity.si(value));
    }

    /// Sets it from what a person typed.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn enter(&self, scenario: &mut Scenario, text: &str) -> Result<(), String> {
        if let Some(result) = self.words.and_then(|words| (words.enter)(scenario, text)) {
            return result;
        }
        if let (Some(off), "off" | "none") = (self.off, text.trim().to_lowercase().as_str()) {
            off(scenario);
            return Ok(());
        }
        let value = self.quantity.parse(text)?;
        if self.scale.is_whole() && (value.fract() != 0.0 || value < 0.0) {
            return Err(format!(
                "“{}”: a whole number is expected",
                crate::app::controls::quantity::shorten(text.trim())
            ));
        }
        self.slide(scenario, value);
        Ok(())
    }

    /// Whether two scenarios differ here.
    #[must_use]
    pub fn differs(&self, scenario: &Scenario, other: &Scenario) -> bool {
        differs(self.copy, scenario, other)
    }
}

/// Options of which one holds.
pub struct Choice {
    /// Key in a scenario file.
    pub key: &'static str,
    /// Name.
    pub label: &'static str,
    /// What it does, in a line.
    pub tip: &'static str,
    /// The options.
    pub options: &'static [&'static str],
    /// Which one holds.
    pub get: fn(&Scenario) -> usize,
    /// Picks one.
    pub set: fn(&mut Scenario, usize),
    /// Copies the setting from one scenario into another.
    pub copy: fn(&Scenario, &mut Scenario),
}

impl std::fmt::Debug for Choice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Choice({})", self.key)
    }
}

impl Choice {
    /// Whether two scenarios differ here.
    #[must_use]
    pub fn differs(&self, scenario: &Scenario, other: &Scenario) -> bool {
        differs(self.copy, scenario, other)
    }
}

fn differs(copy: fn(&Scenario, &mut Scenario), scenario: &Scenario, other: &Scenario) -> bool {
    let mut copied = scenario.clone();
    copy(other, &mut copied);
    copied != *scenario
}
