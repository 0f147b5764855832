//! The states of the page that the theory shows, each by its name in the text.

use anyhow::{Context, Result};
use centrode_core::scenario::link::{ChainLink, Link, Page, page};
use centrode_core::scenario::preset;

/// A state of the page: a preset, what differs from it, the view, and where the cursor stands (s); or a preset of several segments.
#[derive(Debug, Clone, Copy)]
pub struct State {
    /// Its name in the text.
    pub name: &'static str,
    preset: &'static str,
    sets: &'static [&'static str],
    view: &'static str,
    time: Option<f64>,
    chain: Option<&'static str>,
}

const fn at(name: &'static str, preset: &'static str, sets: &'static [&'static str], time: f64) -> State {
    State { name, preset, sets, view: "robot", time: Some(time), chain: None }
}

const fn view(name: &'static str, preset: &'static str, view: &'static str) -> State {
    State { name, preset, sets: &[], view, time: None, chain: None }
}

/// Several segments: a preset of the same name.
const fn chain(name: &'static str, time: f64) -> State {
    State { name, preset: "bench", sets: &[], view: page::CHAIN, time: Some(time), chain: Some(name) }
}

/// All of them.
pub const STATES: &[State] = &[
    view("figure-3", "figure-3", "figure-3"),
    view("figure-4", "figure-4", "figure-4"),
    view("figure-8", "figure-8", "figure-8"),
    view("map", "bench", "map"),
    at("bench", "bench", &[], 6.3),
    at("free", "free", &[], 5.5),
    at("disk-1", "disk-1", &[], 7.0),
    at("disk-3", "disk-3", &[], 5.61),
    at("disk-3-low", "disk-3", &["detection.xi2=0.004"], 5.61),
    at("disk-3-short", "disk-3", &["filter.length=100"], 5.61),
    at("plane-2", "bench", &["contact.kind=plane"], 6.45),
    at("plane-1", "bench", &["contact.disk=1", "contact.kind=plane"], 7.0),
    at("snap", "snap", &[], 7.2),
    at("gimbal-lock", "gimbal-lock", &[], 6.0),
    at("load-at-rest", "load-at-rest", &[], 8.5),
    at("independent", "bench", &["load_cells.errors=independent", "load_cells.preload=20"], 5.0),
    at("miscalibrated", "miscalibrated", &[], 6.0),
    chain("three-segments", 6.5),
    chain("two-contacts", 7.4),
    chain("buckling", 6.0),
];

/// The state of a name.
pub fn find(name: &str) -> Result<&'static State> {
    STATES.iter().find(|state| state.name == name).with_context(|| format!("there is no state called {name:?}"))
}

impl State {
    /// Its link.
    pub fn link(&self) -> Result<Link> {
        let named = || format!("state {:?}", self.name);
        let preset = preset::find(self.preset).with_context(named)?;
        let mut draft = preset.draft().with_context(named)?;
        for set in self.sets {
            draft.set(set).with_context(named)?;
        }
        let scenario = draft.finish().with_context(named)?;
        let chain = match self.chain {
            Some(chain) => Some(ChainLink::of(chain).with_context(named)?),
            None => None,
        };
        let page = Page { time: self.time, chain, ..Page::of(self.view) };
        Link::new(preset, &scenario, page).with_context(named)
    }

    /// The address of the page in this state, from the theory beside it.
    pub fn address(&self) -> Result<String> {
        Ok(format!("./#{}", self.link()?.fragment()?))
    }
}
