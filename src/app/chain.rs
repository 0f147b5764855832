//! Segments in series: what is set of them, the run that follows, and the views that show it in the places of those of one segment.

pub mod apply;
pub mod backbone;
pub mod controls;
pub mod log;
pub mod memo;
pub mod own;
pub mod plots;
pub mod thumb;
pub mod words;

use std::collections::BTreeMap;

use crate::app::helper::Helper;
use centrode_core::scenario::ChainScenario;
use centrode_core::scenario::chain::ChainDraft;
use centrode_core::scenario::preset::{self, CHAINS, Preset};
use centrode_core::study::chain::course::Shown;
use memo::Memo;
use serde::{Deserialize, Serialize};

/// What a person sets of several segments.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ChainState {
    /// Name of the preset that resets go back to.
    pub preset: String,
    /// The experiment.
    pub draft: ChainDraft,
    /// The segment that is looked at, from 0.
    pub segment: usize,
    /// The contact that is looked at, from 0.
    pub contact: usize,
    /// Whether the plots show every segment.
    pub all: bool,
    /// Which of what a run has to show they show then.
    pub shown: usize,
}

impl Default for ChainState {
    fn default() -> Self {
        Self::of(&CHAINS[0])
    }
}

impl ChainState {
    /// That of a preset.
    #[must_use]
    pub fn of(preset: &Preset) -> Self {
        let draft = ChainDraft::of(preset);
        // Looked at first is what the first contact is on.
        let segment = draft.scenario().ok().and_then(|scenario| Some(scenario.contacts.first()?.segment));
        Self { preset: preset.name.into(), draft, segment: segment.unwrap_or(0), contact: 0, all: true, shown: 0 }
    }

    /// The chosen preset; the first when its name is unknown.
    #[must_use]
    pub fn preset(&self) -> &'static Preset {
        preset::find_chain(&self.preset).unwrap_or(&CHAINS[0])
    }
}

/// What the page knows of several segments besides what is set.
#[derive(Default)]
pub struct Chain {
    /// The run; none before it is looked at.
    pub memo: Option<Memo>,
    /// Who places contacts, until the run has it.
    helper: Option<Box<dyn Helper>>,
    /// A log in place of the simulation.
    pub logs: log::Logs,
    /// What the preset says.
    base: Option<(String, ChainScenario)>,
    /// What was refused last, by path.
    pub notes: BTreeMap<String, String>,
    /// Values of what is switched off, by path, as shown.
    remembered: BTreeMap<String, f64>,
}

/// The pictures of the views as they were last shown.
#[derive(Default)]
pub struct Pictures {
    /// Plots over time.
    pub plots: plots::PlotsState,
    /// Where along the backbone.
    pub backbone: backbone::BackboneState,
}

impl Chain {
    /// Nothing is looked at yet; `helper` places contacts, if there is one.
    #[must_use]
    pub fn new(helper: Option<Box<dyn Helper>>) -> Self {
        Self { helper, ..Self::default() }
    }

    /// Brings the run up to date with what is set, if it is looked at. Returns whether that had changed.
    pub fn update(&mut self, state: &ChainState, seen: bool) -> bool {
        if !seen {
            if self.memo.as_ref().is_some_and(Memo::is_working) {
                self.memo.iter_mut().for_each(Memo::rest);
            }
            return false;
        }
        if self.base.as_ref().is_none_or(|(name, _)| *name != state.preset) {
            let base = ChainDraft::of(state.preset()).scenario().ok();
            self.base = base.map(|base| (state.preset.clone(), base));
        }
        match &mut self.memo {
            Some(memo) => memo.update(&state.draft, self.logs.shown.as_ref()),
            None => {
                self.memo = Some(Memo::new(&state.draft, self.logs.shown.as_ref(), self.helper.take()));
                true
            }
        }
    }

    /// What resets go back to.
    #[must_use]
    pub fn base(&self) -> Option<&ChainScenario> {
        self.base.as_ref().map(|(_, base)| base)
    }

    /// Whether estimates are still to be made.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.memo.as_ref().is_some_and(Memo::is_working)
    }
}

/// What the plots of every segment show: what was chosen of all that a run has.
#[must_use]
pub fn chosen(state: &ChainState, all: &[Shown]) -> Shown {
    all.get(state.shown).or(all.last()).copied().unwrap_or(Shown::Bend)
}
