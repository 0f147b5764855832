//! Scenarios that come with the program.

use crate::scenario::text::Draft;
use crate::scenario::{ChainError, ChainScenario, Scenario, ScenarioError};
use std::sync::OnceLock;

/// A scenario with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Preset {
    /// Name, as `--preset` takes it.
    pub name: &'static str,
    /// Its TOML; the first line is a comment that says what it shows.
    pub toml: &'static str,
}

macro_rules! presets {
    ($($name:literal),* $(,)?) => {
        &[$(Preset { name: $name, toml: include_str!(concat!("../../assets/presets/", $name, ".toml")) }),*]
    };
}

macro_rules! chains {
    ($($name:literal),* $(,)?) => {
        /// Those with several segments, or with a beam out of the bending plane, which [`ChainScenario`] reads.
        pub const CHAINS: &[Preset] =
            &[$(Preset { name: $name, toml: include_str!(concat!("../../assets/presets/chain/", $name, ".toml")) }),*];
        /// Their names.
        pub const CHAIN_NAMES: &[&str] = &[$($name),*];
    };
}

/// All of them; the page opens on the first.
pub const PRESETS: &[Preset] = presets![
    "bench",
    "paper",
    "disk-1",
    "disk-3",
    "free",
    "mid-gap",
    "static-resolution",
    "gimbal-lock",
    "letting-go",
    "load-at-rest",
    "figure-3",
    "figure-4",
    "figure-6",
    "figure-7",
    "figure-8",
    "touch-1",
    "touch-2",
    "touch-3",
    "cylinder",
    "snap",
    "miscalibrated",
    "play",
];

chains!["three-segments", "two-contacts", "reopened", "buckling", "oblique", "tip-only"];

/// The preset of a name with several segments.
#[must_use]
pub fn find_chain(name: &str) -> Option<&'static Preset> {
    CHAINS.iter().find(|preset| preset.name == name)
}

impl Preset {
    /// The experiment of one of [`CHAINS`], with values of keys in place of its own.
    ///
    /// # Errors
    /// Never without these; a test reads them all.
    pub fn chain(&self, overrides: &[String]) -> Result<ChainScenario, ChainError> {
        ChainScenario::from_bytes(self.toml.as_bytes(), overrides)
    }

    /// What it shows, in a sentence.
    #[must_use]
    pub fn summary(&self) -> &'static str {
        self.toml.lines().next().unwrap_or_default().trim_start_matches('#').trim()
    }

    /// The scenario, open to overrides.
    ///
    /// # Errors
    /// Never for the presets that are shipped; a test reads them all.
    pub fn draft(&self) -> Result<Draft, ScenarioError> {
        Draft::from_toml(self.toml)
    }

    /// The scenario.
    ///
    /// # Errors
    /// Never for the presets that are shipped; a test reads them all.
    pub fn scenario(&self) -> Result<Scenario, ScenarioError> {
        // Every link is read against one: its text is read once.
        static READ: [OnceLock<Result<Scenario, ScenarioError>>; PRESETS.len()] =
            [const { OnceLock::new() }; PRESETS.len()];
        let read = || self.draft()?.finish();
        match PRESETS.iter().position(|preset| preset == self) {
            Some(place) => READ[place].get_or_init(read).clone(),
            None => read(),
        }
    }
}

/// The preset of a name.
///
/// ```
/// use centrode_core::scenario::preset::find;
///
/// let noisy = find("bench")?.scenario()?;
/// assert!(noisy.tracker.position_noise > 0.0);
/// assert!(find("bensh").expect_err("none of this name").to_string().contains("known presets: bench, paper"));
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
///
/// # Errors
/// [`ScenarioError::UnknownPreset`] when there is none, with the names that exist.
pub fn find(name: &str) -> Result<&'static Preset, ScenarioError> {
    PRESETS.iter().find(|preset| preset.name == name).ok_or_else(|| ScenarioError::UnknownPreset {
        name: name.into(),
        known: PRESETS.iter().map(|preset| preset.name).collect::<Vec<_>>().join(", "),
    })
}
