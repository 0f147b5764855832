//! Simulates the paper's experiment with a noisy tracker, and says what the detectors make of it.
//!
//! ```sh
//! cargo run --release --package centrode-core --example simulate
//! ```

use centrode_core::detect::Method;
use centrode_core::run::simulate;
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Detectors, ScenarioError};
use centrode_core::study::report::AFTER;

fn main() -> Result<(), ScenarioError> {
    print!("{}", report()?);
    Ok(())
}

/// The events of one run, and where its contact is.
pub fn report() -> Result<String, ScenarioError> {
    // A preset is a scenario by name; every field can be set.
    let mut scenario = find("bench")?.scenario()?;
    scenario.seed = 7;
    scenario.detection.detectors = Detectors::of(&[Method::Fcd, Method::Cusum]);
    let run = simulate(&scenario)?;

    let mut text = String::new();
    if let Some(time) = run.contact_time() {
        text += &format!("contact at {time:.3} s\n");
    }
    for event in run.events() {
        let Some(delay) = run.contact_time().map(|time| event.raised - time) else { continue };
        text += &format!("{} raised at {:.3} s, {delay:+.3} s\n", event.detector.key(), event.raised);
    }
    // Lengths are in m along the backbone: disk 2 is at 15 mm.
    for estimate in run.judged.estimates(&run.recording, Method::Cusum, AFTER) {
        let place = &estimate.location;
        let [mean, low, high] = [place.mean, place.low, place.high].map(|length| length * 1e3);
        text += &format!("{:.2} s after cusum: {mean:.2} mm ({low:.2} to {high:.2})\n", estimate.after);
    }
    Ok(text)
}
