//! Everything a person sets, and nothing that follows from it.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::app::chain::{self, ChainState};
use crate::app::controls::control::Control;
use crate::app::controls::table;
use crate::app::layout::sheet::Stop;
use crate::app::lesson::At;
use crate::app::stages::stage::Stage;
use crate::app::theme::ThemeChoice;
use centrode_core::scenario::preset::{self, PRESETS, Preset};
use centrode_core::scenario::{Detectors, Method, Scenario};
use centrode_core::study::tuning::watch::Rule;

/// How long before the motion playback opens and loops, s: the rest before it shows nothing.
pub const LEAD_IN: f64 = 0.4;

/// The inputs of the page.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct State {
    /// Name of the preset that resets go back to.
    pub preset: String,
    /// The experiment.
    pub scenario: Scenario,
    /// The experiment with several segments.
    pub chain: ChainState,
    /// Values of controls that are switched off, by key, as shown; they come back when switched on.
    pub remembered: BTreeMap<String, f64>,
    /// The cursor, s.
    pub time: f64,
    /// Whether the cursor moves.
    pub playing: bool,
    /// Seconds of the experiment per second.
    pub speed: f64,
    /// Whether playback starts again at the end.
    pub looping: bool,
    /// Whether the views show beside a beam that only touches what a clamp would make of the segment.
    pub frozen: bool,
    /// Dark or light.
    pub theme: ThemeChoice,
    /// Names of the groups of controls that are folded.
    pub folded: BTreeSet<String>,
    /// What stands on the stage.
    pub stage: Stage,
    /// What of the paper stood there last.
    pub paper: Stage,
    /// What is looked at while tuning.
    pub tuning: Tuning,
    /// What a small screen shows.
    pub tab: Tab,
    /// The times A and B that are held against each other, s.
    pub marks: [Option<f64>; 2],
    /// Whether a small screen's sheet holds the controls, and not the tabs.
    pub sheet: bool,
    /// How far that sheet is drawn out.
    pub stop: Stop,
    /// Whether the help is open.
    pub help: bool,
    /// Where one is in the lessons; none outside of them.
    pub lesson: Option<At>,
    /// Whether the run is heard, too.
    pub sound: bool,
    /// Whether the list of keys is open.
    pub keys: bool,
}

/// What is looked at while tuning.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Tuning {
    /// How alarms are raised.
    #[serde(rename = "method")]
    pub rule: Rule,
    /// The most runs without contact that may alarm, as a share.
    pub wish: f64,
    /// Repeats of each run.
    pub repeats: usize,
    /// The detectors that are compared.
    pub compare: Detectors,
}

impl Default for Tuning {
    fn default() -> Self {
        Self { rule: Rule::Fcd, wish: 0.05, repeats: 100, compare: Detectors::of(Method::ALL) }
    }
}

/// Where there is room for one of them only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tab {
    /// What the experiment came to.
    #[default]
    Result,
    /// The live plots.
    Plots,
    /// The bending plane.
    Plane,
}

impl Default for State {
    fn default() -> Self {
        let preset = &PRESETS[0];
        let scenario = shipped(preset);
        Self {
            preset: preset.name.into(),
            time: lead_in(&scenario),
            scenario,
            chain: ChainState::default(),
            remembered: BTreeMap::new(),
            playing: true,
            speed: 1.0,
            looping: true,
            frozen: false,
            theme: ThemeChoice::System,
            folded: table::GROUPS
                .iter()
                .map(|group| (group.name, group.folded))
                .chain(chain::controls::OWN)
                .filter(|(_, folded)| *folded)
                .map(|(name, _)| name.into())
                .collect(),
            stage: Stage::Robot,
            paper: Stage::PAPER[0],
            tuning: Tuning::default(),
            tab: Tab::Result,
            marks: [None; 2],
            sheet: false,
            stop: Stop::Half,
            help: false,
            lesson: None,
            sound: false,
            keys: false,
        }
    }
}

impl State {
    /// What a control that is switched off goes back to, SI; 0 for a key without control.
    #[must_use]
    pub fn otherwise_si(&self, key: &str, base: &Scenario) -> f64 {
        let value = |control: &Control| Some(control.quantity().si(self.otherwise(control, base)?));
        table::control(key).and_then(value).unwrap_or(0.0)
    }

    /// The chosen preset; the first when its name is unknown.
    #[must_use]
    pub fn preset(&self) -> &'static Preset {
        preset::find(&self.preset).unwrap_or(&PRESETS[0])
    }

    /// What a control that is switched off goes back to, in the unit shown: its value when it was last on, else the
    /// preset's (`base`), else the default, else a small one.
    #[must_use]
    pub fn otherwise(&self, control: &Control, base: &Scenario) -> Option<f64> {
        let remembered = self.remembered.get(control.key).copied();
        let small = || {
            let (low, high) = control.range(base);
            control.has_off().then_some(low + 0.1 * (high - low))
        };
        remembered.or_else(|| control.value(base)).or_else(|| control.value(&Scenario::default())).or_else(small)
    }
}

/// The scenario of a preset that comes with the program.
///
/// # Panics
/// When it is invalid, which a test of all of them excludes.
#[must_use]
pub fn shipped(preset: &Preset) -> Scenario {
    preset.scenario().expect("presets that come with the program are valid")
}

/// Where playback opens and loops to, s: shortly before the motion.
#[must_use]
pub fn lead_in(scenario: &Scenario) -> f64 {
    (scenario.motion.start - LEAD_IN).clamp(0.0, scenario.motion.end.max(0.0))
}
