//! The numbers that the text quotes: each is computed when the page is built.

mod chain;

use anyhow::{Context, Result, bail};
use centrode_core::chart::notation::number;
use centrode_core::detect::Method;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::preset;
use std::collections::BTreeMap;

/// Noise of the tracker switched off.
const QUIET: [&str; 2] = ["tracker.position_noise=0", "tracker.orientation_noise=0"];

/// Numbers by their names, as they are printed.
#[derive(Debug, Default)]
pub struct Facts(BTreeMap<&'static str, String>);

impl Facts {
    /// The number of a name.
    pub fn get(&self, name: &str) -> Result<&str> {
        self.0.get(name).map(String::as_str).with_context(|| format!("there is no number called {name:?}"))
    }

    /// All names.
    #[cfg(test)]
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.0.keys().copied()
    }

    fn put(&mut self, name: &'static str, value: f64, decimals: usize, unit: &str) {
        let text = number(value, decimals);
        self.0.insert(name, if unit.is_empty() { text } else { format!("{text}\u{a0}{unit}") });
    }
}

impl Facts {
    /// An angle (rad).
    fn degrees(&mut self, name: &'static str, value: f64, decimals: usize) {
        self.0.insert(name, format!("{}°", number(value.to_degrees(), decimals)));
    }
}

/// A run of a preset with some keys set.
pub fn run(name: &str, sets: &[&str]) -> Result<Run> {
    let mut draft = preset::find(name)?.draft()?;
    for set in sets {
        draft.set(set)?;
    }
    Ok(simulate(&draft.finish()?)?)
}

/// The same with a tracker without noise.
pub fn quiet(name: &str, sets: &[&str]) -> Result<Run> {
    run(name, &[sets, &QUIET].concat())
}

/// The largest centrode deviation that counts, m.
fn largest(run: &Run) -> f64 {
    let thresholds = &run.judged.settings.thresholds;
    let counted = |sample: centrode_core::run::Sample| {
        Method::Fcd.statistic(&sample.judgement, sample.time, thresholds).counted()
    };
    run.samples().filter_map(counted).fold(0.0, f64::max)
}

/// Computes them.
pub fn facts() -> Result<Facts> {
    let mut facts = Facts::default();
    let bench = quiet("bench", &[])?;
    let scenario = bench.plan.scenario();
    facts.put("length", 1e3 * scenario.robot.length, 0, "mm");
    facts.put("window", scenario.filter.length as f64 / scenario.loop_rate, 1, "s");
    facts.put("samples", scenario.filter.length as f64, 0, "");
    let xi2 = scenario.detection.xi2.value().context("ξ2 is on")?;
    facts.put("xi2", 1e3 * xi2, 0, "mm");
    facts.put("twice-xi2", 2e3 * xi2, 0, "mm");
    detected(&mut facts, ["contact-2", "detected-2", "located-2"], &bench)?;
    facts.put("clamp-2", 1e3 * largest(&bench), 2, "mm");
    facts.put("plane-2", 1e3 * largest(&quiet("bench", &["contact.kind=plane"])?), 2, "mm");
    let third = quiet("disk-3", &[])?;
    detected(&mut facts, ["contact-3", "detected-3", "located-3"], &third)?;
    facts.put("clamp-1", 1e3 * largest(&quiet("disk-1", &[])?), 2, "mm");
    facts.put("free", 1e3 * largest(&quiet("bench", &["contact.disk=0"])?), 2, "mm");
    best(&mut facts)?;
    chain::facts(&mut facts)?;
    Ok(facts)
}

/// When a contact began and was detected, and where Eq. 24 placed it.
fn detected(facts: &mut Facts, [contact, detected, located]: [&'static str; 3], run: &Run) -> Result<()> {
    let detection = run.detection().context("a contact that is detected")?;
    facts.put(contact, run.contact_time().context("a contact")?, 2, "s");
    facts.put(detected, detection.time, 2, "s");
    facts.put(located, 1e3 * detection.location, 1, "mm");
    Ok(())
}

/// What the calibration filter says of a robot that is not calibrated.
fn best(facts: &mut Facts) -> Result<()> {
    let run = run("miscalibrated", &[])?;
    let began = run.contact_time().context("a contact")?;
    for (name, method) in [("fcd-delay", Method::Fcd), ("cusum-delay", Method::Cusum)] {
        let event = run.judged.first(method).with_context(|| format!("no alarm of {}", method.key()))?;
        facts.put(name, event.raised - began, 2, "s");
    }
    let contact = run.plan.contact().context("a contact")?;
    facts.put("truth", 1e3 * contact.arc_length, 1, "mm");
    let after = [0.0, 0.5];
    let names = [["first-low", "first-high", "first"], ["last-low", "last-high", "last"]];
    let estimates = run.judged.estimates(&run.recording, Method::Cusum, &after);
    if estimates.len() != after.len() {
        bail!("{} places instead of {}", estimates.len(), after.len());
    }
    for (estimate, [low, high, mean]) in estimates.iter().zip(names) {
        facts.put(low, 1e3 * estimate.location.low, 1, "mm");
        facts.put(high, 1e3 * estimate.location.high, 1, "mm");
        facts.put(mean, 1e3 * estimate.location.mean, 1, "mm");
    }
    Ok(())
}
