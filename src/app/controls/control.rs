//! What a control is: one row of a table, from which the panel draws label, slider, field and reset.

use crate::app::controls::quantity::{number, parse, shorten};
use centrode_core::scenario::Scenario;
use centrode_core::scenario::keys::{Key, Quantity};

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

impl Group {
    /// Whether it holds the control of a key.
    #[must_use]
    pub fn holds(&self, key: &str) -> bool {
        self.controls.iter().any(|control| control.key == key)
            || self.choices.iter().any(|choice| choice.of.path == key)
    }
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

/// A number that can be slid and typed. Values are in the unit shown unless said otherwise.
pub struct Control {
    /// Path in a scenario file, with the place in a list in brackets; its notes stand under it.
    pub key: &'static str,
    /// What it sets.
    pub of: &'static Key,
    /// Which part of it, for a list.
    pub part: Option<usize>,
    /// Name, also to assistive technology and tests.
    pub label: &'static str,
    /// Digits after the point.
    pub decimals: usize,
    /// How values lie along the slider.
    pub scale: Scale,
    /// What can be done with it besides, in a sentence; empty for nothing.
    pub hint: &'static str,
    /// Words in place of the number.
    pub words: Option<Words>,
    /// Where it means something; there it stands below the options of its group, on which this depends. None: everywhere.
    pub only: Option<fn(&Scenario) -> bool>,
}

/// For a control whose setting is not always a number.
#[derive(Clone, Copy)]
pub struct Words {
    /// Where the slider's handle stands, SI.
    pub place: fn(&Scenario) -> f64,
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
    /// What its number is.
    #[must_use]
    pub fn quantity(&self) -> Quantity {
        self.of.quantity
    }

    /// What it does, in a sentence or two.
    #[must_use]
    pub fn tip(&self) -> String {
        [self.of.sentence, self.hint].join(" ").trim_end().into()
    }

    /// Whether its number can be switched off.
    #[must_use]
    pub fn has_off(&self) -> bool {
        self.of.has_off()
    }

    /// Ends of the slider; what is typed may lie outside.
    #[must_use]
    pub fn range(&self, scenario: &Scenario) -> (f64, f64) {
        let (low, high) = self.of.usual(scenario);
        (self.quantity().shown(low), self.quantity().shown(high))
    }

    /// The value in the unit shown; none while it is switched off.
    #[must_use]
    pub fn value(&self, scenario: &Scenario) -> Option<f64> {
        let si = match (self.words, self.part) {
            (Some(words), _) => Some((words.place)(scenario)),
            (None, Some(part)) => self.of.list(scenario).and_then(|list| list.get(part)).copied(),
            (None, None) => self.of.number(scenario),
        };
        si.map(|si| self.quantity().shown(si))
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
        let off = || (self.of.off().unwrap_or("off").into(), "");
        self.value(scenario).map_or_else(off, |value| (number(value, self.decimals), self.quantity().unit()))
    }

    /// Sets it from the unit shown.
    pub fn slide(&self, scenario: &mut Scenario, value: f64) {
        let si = self.quantity().si(value);
        match self.part {
            Some(part) => self.of.set_part(scenario, part, si),
            None => self.of.set_number(scenario, si),
        }
    }

    /// Sets it from what a person typed.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn enter(&self, scenario: &mut Scenario, text: &str) -> Result<(), String> {
        if let Some(result) = self.words.and_then(|words| (words.enter)(scenario, text)) {
            return result;
        }
        if let Some(off) = self.of.off() {
            let word = text.trim().to_lowercase();
            if word == off || (off, word.as_str()) == ("off", "none") {
                self.of.switch_off(scenario);
                return Ok(());
            }
        }
        let value = parse(self.quantity(), text)?;
        if self.of.is_whole() && (value.fract() != 0.0 || value < 0.0) {
            return Err(format!("“{}”: a whole number is expected", shorten(text.trim())));
        }
        self.slide(scenario, value);
        Ok(())
    }

    /// Gives one scenario what another holds here.
    pub fn copy(&self, from: &Scenario, to: &mut Scenario) {
        match self.part {
            Some(part) => {
                if let Some(&value) = self.of.list(from).and_then(|list| list.get(part)) {
                    self.of.set_part(to, part, value);
                }
            }
            None => self.of.copy(from, to),
        }
    }

    /// Whether two scenarios differ here.
    #[must_use]
    pub fn differs(&self, scenario: &Scenario, other: &Scenario) -> bool {
        let part = |scenario| self.of.list(scenario).and_then(|list| list.get(self.part?));
        if self.part.is_some() { part(scenario) != part(other) } else { !self.of.agrees(scenario, other) }
    }
}

/// Options of which one holds, or any where the key holds several words.
#[derive(Debug)]
pub struct Choice {
    /// What it sets.
    pub of: &'static Key,
    /// Name.
    pub label: &'static str,
    /// What can be seen of it besides, in a sentence; empty for nothing.
    pub hint: &'static str,
    /// What the key's words are called here, in their order.
    pub options: &'static [&'static str],
}

impl Choice {
    /// What it does, in a sentence or two.
    #[must_use]
    pub fn tip(&self) -> String {
        [self.of.sentence, self.hint].join(" ").trim_end().into()
    }

    /// Whether two scenarios differ here.
    #[must_use]
    pub fn differs(&self, scenario: &Scenario, other: &Scenario) -> bool {
        !self.of.agrees(scenario, other)
    }
}
