//! `centrode link`: a scenario in the address of a page.

use super::ScenarioArgs;
use super::output::Failure;
use centrode_core::scenario::link::page::CHAIN;
use centrode_core::scenario::link::{ChainLink, Link, Page};
use centrode_core::scenario::preset::{self, PRESETS};
use centrode_core::scenario::{Scenario, ScenarioError};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode link`.
#[derive(Debug, Args)]
#[command(allow_missing_positional = true)]
pub struct LinkArgs {
    /// With a preset or link, what differs from that preset is written; else from the preset that comes nearest.
    #[command(flatten)]
    source: ScenarioArgs,
    /// Scenario file (TOML), as a flag.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["file", "preset", "link"])]
    scenario: Option<PathBuf>,
    /// What the page shows: robot, chain, figure-3, figure-4, figure-6, figure-7, figure-8, table2, map, tuning or detectors.
    #[arg(long, value_name = "VIEW")]
    view: Option<String>,
    /// Where playback stands, in s; without it, it plays.
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    t: Option<String>,
    /// Step at which the page's tour is open, from 1; all else in the link is what the page goes back to after it.
    #[arg(long, value_name = "STEP", allow_hyphen_values = true, conflicts_with = "challenge")]
    tour: Option<String>,
    /// Challenge that is open, the same way: disk-1, half, blind, clamp, disk-3 or best.
    #[arg(long, value_name = "CHALLENGE")]
    challenge: Option<String>,
    /// Theme of the page: dark, light, projector or system; without it, that of whoever opens the link.
    #[arg(long, value_name = "THEME")]
    theme: Option<String>,
    /// Address of the page, as in `https://example.org/centrode/`; its query stays, what stands behind # is replaced.
    #[arg(value_name = "ADDRESS")]
    address: String,
}

impl LinkArgs {
    /// Prints the link.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let known = self.source.link()?;
        let source = match &self.scenario {
            Some(path) => &ScenarioArgs { file: Some(path.clone()), ..self.source.clone() },
            None => &self.source,
        };
        if let Some((draft, preset)) = source.draft()? {
            let mut page = known.map_or_else(Page::default, |link| link.page);
            (page.view, page.chain) = (CHAIN, Some(ChainLink::nearest(draft, preset)));
            self.enter(&mut page)?;
            return self.print(Link::new(&PRESETS[0], &Scenario::default(), page), out);
        }
        let scenario = source.scenario()?;
        let mut page = known.as_ref().map_or_else(Page::default, |link| link.page.clone());
        self.enter(&mut page)?;
        let preset = match (&self.source.preset, &known) {
            (Some(name), _) => preset::find(name).ok(),
            (None, Some(link)) => Some(link.preset()),
            (None, None) => None,
        };
        let link = match preset {
            Some(preset) => Link::new(preset, &scenario, page),
            None => Link::nearest(&scenario, page),
        };
        self.print(link, out)
    }

    fn print(&self, link: Result<Link, ScenarioError>, out: &mut impl Write) -> Result<(), Failure> {
        let link = link.map_err(|error| Failure::Input(error.to_string()))?;
        let text = link.at(&self.address).map_err(|error| Failure::Input(error.to_string()))?;
        Ok(writeln!(out, "{text}")?)
    }

    /// Sets what the flags say of the page.
    fn enter(&self, page: &mut Page) -> Result<(), Failure> {
        if self.tour.is_some() || self.challenge.is_some() {
            // One lesson is open at a time, and a flag comes after what a link says.
            (page.tour, page.challenge) = (None, None);
        }
        let flags = [
            ("view", &self.view),
            ("t", &self.t),
            ("tour", &self.tour),
            ("challenge", &self.challenge),
            ("theme", &self.theme),
        ];
        flags.into_iter().filter_map(|(key, text)| Some((key, text.as_ref()?))).try_for_each(|(key, text)| {
            page.enter(key, text).map_err(|error| Failure::Input(format!("--{key}: {error}")))
        })
    }
}
