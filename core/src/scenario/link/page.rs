//! What a link says of the page beside the scenario: a short table of what one must know to see the same. Folded
//! groups and the like are the reader's own and stay out; so is the theme, unless somebody has chosen one.

use super::chain::ChainLink;
use crate::scenario::keys::allowed::Limit;
use crate::scenario::keys::{Allowed, Quantity, Value};
use crate::scenario::plan::MAX_TIME;
use crate::scenario::preset::CHAIN_NAMES;
use crate::scenario::refusal::{Refused, ScenarioError};
use crate::scenario::{Detectors, Method, Scenario};

/// What can stand on the page's stage, by the name that a link has for it.
pub const VIEWS: &[&str] = &[
    "robot",
    "chain",
    "figure-3",
    "figure-4",
    "figure-6",
    "figure-7",
    "figure-8",
    "table2",
    "map",
    "tuning",
    "detectors",
];
/// The view of several segments.
pub const CHAIN: &str = "chain";
/// How alarms are raised in the tuning view.
pub const RULES: &[&str] = &["fcd", "jfd", "or", "and"];
/// Slowest and fastest playback, seconds of the experiment per second.
pub const SPEEDS: (f64, f64) = (0.1, 4.0);
/// The most repeats of a study.
pub const MAX_REPEATS: u64 = 100_000;
/// Steps of the page's tour.
pub const TOUR_STEPS: u64 = 13;
/// The page's challenges.
pub const CHALLENGES: &[&str] = &["disk-1", "half", "blind", "clamp", "disk-3", "best"];
/// The page's themes: as the system says, or one of its own.
pub const THEMES: &[&str] = &["system", "dark", "light", "projector"];
const SWITCH: &[&str] = &["on", "off"];

/// What the page shows; a setting that is not in a link has its default.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// What stands on the stage, one of [`VIEWS`].
    pub view: &'static str,
    /// Where the cursor stands, s; none while it moves.
    pub time: Option<f64>,
    /// Seconds of the experiment per second of playback.
    pub speed: f64,
    /// Whether playback starts again at the end.
    pub looping: bool,
    /// How alarms are raised in the tuning view, one of [`RULES`].
    pub rule: &'static str,
    /// The share of runs without contact that may alarm, in the tuning view.
    pub false_alarms: f64,
    /// Repeats of each run in the tuning view.
    pub repeats: u64,
    /// The detectors that are compared in the tuning view.
    pub compare: Detectors,
    /// The step of the tour that is open over all this, from 1; none outside of the tour.
    pub tour: Option<u64>,
    /// The challenge that is open over all this, one of [`CHALLENGES`]; none outside of them, and the tour goes first.
    pub challenge: Option<&'static str>,
    /// The theme, one of [`THEMES`]; none leaves it to who looks.
    pub theme: Option<&'static str>,
    /// The experiment with several segments; none for the one in which that view opens.
    pub chain: Option<ChainLink>,
}

impl Default for Page {
    fn default() -> Self {
        Self {
            view: VIEWS[0],
            time: None,
            speed: 1.0,
            looping: true,
            rule: RULES[0],
            false_alarms: 0.05,
            repeats: 100,
            compare: Detectors::of(Method::ALL),
            tour: None,
            challenge: None,
            theme: None,
            chain: None,
        }
    }
}

/// One setting of the page.
#[derive(Debug, Clone, Copy)]
pub struct PageKey {
    /// Its name in a link.
    pub name: &'static str,
    /// What its number is.
    pub quantity: Quantity,
    /// What it may hold.
    pub allowed: Allowed,
    /// What it means.
    pub sentence: &'static str,
    get: fn(&Page) -> Option<Value>,
    set: fn(&mut Page, &Value),
}

/// All settings of the page, in the order in which a link has them.
pub const PAGE_KEYS: &[PageKey] = &[
    PageKey {
        name: "view",
        quantity: Quantity::Word,
        allowed: Allowed::Words(VIEWS),
        sentence: "What stands on the stage.",
        get: |page| Some(Value::Word(page.view)),
        set: |page, value| word(value, |word| page.view = word),
    },
    PageKey {
        name: "t",
        quantity: Quantity::Time,
        allowed: Allowed::Range(Limit::At(0.0), Limit::At(MAX_TIME)),
        sentence: "Where playback stands; without it, it plays.",
        get: |page| page.time.map(Value::Number),
        set: |page, value| number(value, |time| page.time = Some(time)),
    },
    PageKey {
        name: "speed",
        quantity: Quantity::Count,
        allowed: Allowed::Range(Limit::At(SPEEDS.0), Limit::At(SPEEDS.1)),
        sentence: "Seconds of the experiment per second of playback.",
        get: |page| Some(Value::Number(page.speed)),
        set: |page, value| number(value, |speed| page.speed = speed),
    },
    PageKey {
        name: "loop",
        quantity: Quantity::Word,
        allowed: Allowed::Words(SWITCH),
        sentence: "Whether playback starts again at the end.",
        get: |page| Some(Value::Word(SWITCH[usize::from(!page.looping)])),
        set: |page, value| word(value, |word| page.looping = word == SWITCH[0]),
    },
    PageKey {
        name: "rule",
        quantity: Quantity::Word,
        allowed: Allowed::Words(RULES),
        sentence: "How alarms are raised in the tuning view: by the centrode, by joint forces, by either, by both at once.",
        get: |page| Some(Value::Word(page.rule)),
        set: |page, value| word(value, |word| page.rule = word),
    },
    PageKey {
        name: "false_alarms",
        quantity: Quantity::Ratio,
        allowed: Allowed::Range(Limit::Beyond(0.0), Limit::Beyond(1.0)),
        sentence: "The share of runs without contact that may alarm, in the tuning view.",
        get: |page| Some(Value::Number(page.false_alarms)),
        set: |page, value| number(value, |share| page.false_alarms = share),
    },
    PageKey {
        name: "repeats",
        quantity: Quantity::Count,
        allowed: Allowed::Whole(1, MAX_REPEATS),
        sentence: "Repeats of each run in the tuning view.",
        get: |page| Some(Value::Whole(page.repeats)),
        set: |page, value| {
            if let Value::Whole(repeats) = value {
                page.repeats = *repeats;
            }
        },
    },
    PageKey {
        name: "compare",
        quantity: Quantity::Word,
        allowed: Allowed::Some(Method::KEYS),
        sentence: "The detectors that are compared in the tuning view.",
        get: |page| Some(Value::Words(page.compare.iter().map(Method::key).collect())),
        set: |page, value| {
            if let Value::Words(words) = value {
                let chosen = Method::ALL.iter().copied().filter(|method| words.contains(&method.key()));
                page.compare = Detectors::of(&chosen.collect::<Vec<_>>());
            }
        },
    },
    PageKey {
        name: "tour",
        quantity: Quantity::Count,
        allowed: Allowed::Whole(1, TOUR_STEPS),
        sentence: "The step at which the tour is open; the rest of the link is what the page goes back to after it.",
        get: |page| page.tour.map(Value::Whole),
        set: |page, value| {
            if let Value::Whole(step) = value {
                page.tour = Some(*step);
            }
        },
    },
    PageKey {
        name: "challenge",
        quantity: Quantity::Word,
        allowed: Allowed::Words(CHALLENGES),
        sentence: "The challenge that is open; the rest of the link is what the page goes back to after it.",
        get: |page| page.challenge.map(Value::Word),
        set: |page, value| word(value, |word| page.challenge = Some(word)),
    },
    PageKey {
        name: "theme",
        quantity: Quantity::Word,
        allowed: Allowed::Words(THEMES),
        sentence: "Dark, light, for a projector, or as the system says; without it, as whoever looks has it.",
        get: |page| page.theme.map(Value::Word),
        set: |page, value| word(value, |word| page.theme = Some(word)),
    },
    PageKey {
        name: CHAIN,
        quantity: Quantity::Word,
        allowed: Allowed::Words(CHAIN_NAMES),
        sentence: "The preset with several segments; keys behind chain. change it, as in chain.segment.2.motion.theta_end=0.9.",
        get: |page| page.chain.as_ref().map(|chain| Value::Word(chain.preset())),
        set: |page, value| word(value, |word| page.chain = ChainLink::of(word)),
    },
];

fn word(value: &Value, set: impl FnOnce(&'static str)) {
    if let Value::Word(word) = value {
        set(word);
    }
}

fn number(value: &Value, set: impl FnOnce(f64)) {
    if let Value::Number(value) = value {
        set(*value);
    }
}

impl Page {
    /// A page with a view, one of [`VIEWS`], and else as by default.
    #[must_use]
    pub fn of(view: &'static str) -> Self {
        Self { view, ..Self::default() }
    }

    /// What differs from the default, and the view where it would be guessed.
    pub(super) fn changes(&self) -> impl Iterator<Item = (&'static PageKey, Value)> {
        let default = Self::default();
        // A link with several segments that is silent about the view shows them.
        let guessed = self.chain.is_some();
        PAGE_KEYS.iter().filter_map(move |key| {
            let value = (key.get)(self)?;
            let said = guessed && key.name == "view" || (key.get)(&default).as_ref() != Some(&value);
            said.then_some((key, value))
        })
    }

    /// When the run that is shown ends, s: that of a scenario, or of several segments. With the key that says so.
    #[must_use]
    pub fn end(&self, scenario: &Scenario) -> (&'static str, f64) {
        match self.chain.as_ref().filter(|_| self.view == CHAIN).and_then(ChainLink::end) {
            Some(end) => ("end", end),
            None => ("motion.end", scenario.motion.end),
        }
    }

    /// Checks that the cursor stands inside a scenario's run.
    ///
    /// # Errors
    /// When it does not.
    pub fn within(&self, scenario: &Scenario) -> Result<(), ScenarioError> {
        let Some(time) = self.time else { return Ok(()) };
        let (key, end) = self.end(scenario);
        if time <= end {
            return Ok(());
        }
        let allowed = Allowed::Range(Limit::At(0.0), Limit::Key(key, Some(end)));
        Err(Refused::error("t", Quantity::Time, Value::Number(time), allowed))
    }

    /// Sets one of its keys from a text.
    ///
    /// # Errors
    /// When there is no such key, or it may not hold that.
    pub fn enter(&mut self, name: &str, text: &str) -> Result<(), ScenarioError> {
        let key = PAGE_KEYS.iter().find(|key| key.name == name).ok_or_else(|| ScenarioError::UnknownKey {
            key: name.into(),
            known: PAGE_KEYS.iter().map(|key| key.name).collect::<Vec<_>>().join(", "),
        })?;
        (key.set)(self, &key.read(text)?);
        Ok(())
    }
}

impl PageKey {
    /// What a page holds; none where playback has no fixed time.
    #[must_use]
    pub fn get(&self, page: &Page) -> Option<Value> {
        (self.get)(page)
    }

    /// Reads a value as a link has it.
    fn read(&self, text: &str) -> Result<Value, ScenarioError> {
        let read = match self.allowed {
            Allowed::Words(words) => words.iter().find(|word| **word == text).map(|word| Value::Word(word)),
            Allowed::Whole(least, most) => {
                text.parse().ok().filter(|whole| (least..=most).contains(whole)).map(Value::Whole)
            }
            Allowed::Some(words) => {
                let known = |part: &str| words.iter().find(|word| **word == part).copied();
                let chosen: Option<Vec<_>> = text.split(',').filter(|part| !part.is_empty()).map(known).collect();
                chosen.map(Value::Words)
            }
            range => text.parse().ok().filter(|number| range.has(*number)).map(Value::Number),
        };
        read.ok_or_else(|| Refused::error(self.name, self.quantity, Value::Other(text.into()), self.allowed))
    }
}
