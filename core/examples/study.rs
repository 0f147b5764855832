//! Tunes a threshold: how often each ξ2 gives a false alarm, how soon it detects the contact, and which to take.
//!
//! ```sh
//! cargo run --release --package centrode-core --example study
//! ```

use centrode_core::scenario::ScenarioError;
use centrode_core::scenario::preset::find;
use centrode_core::study::Job;
use centrode_core::study::tuning::recommend::{Verdict, Wish, recommend};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Spec, Study};

fn main() -> Result<(), ScenarioError> {
    print!("{}", report(100)?);
    Ok(())
}

/// What so many repeats with contact, and as many without, show.
pub fn report(repeats: usize) -> Result<String, ScenarioError> {
    let scenario = find("bench")?.scenario()?;
    // Two filters side by side; a cell changes what it lists.
    let cells = vec![vec!["filter.length=500".parse()?], vec!["filter.length=800".parse()?]];
    let mut study = Study::new(Spec { cells, ..Spec::of(scenario, repeats) })?;
    // A study is worked a run at a time, so that whoever drives it may show how far it is, or use other threads.
    while !study.progress().is_complete() {
        study.step();
    }
    let mut text = String::new();
    for (k, cell) in study.cells().iter().enumerate() {
        let Some(own) = study.own(k, Rule::Fcd).map(|level| study.point(k, Rule::Fcd, level)) else { continue };
        let alarms = own.false_alarms.rate;
        let set: String = cell.set.iter().map(|set| format!("{set}, ")).collect();
        text += &format!("{set}ξ2 = {:.1} mm: {} of {} false alarms\n", own.threshold * 1e3, alarms.count, alarms.of);
    }
    let wish = Wish { rule: Rule::Fcd, false_alarm_rate: 0.05 };
    let advice = match recommend(&study, &wish) {
        Verdict::Take { cell, point, .. } => {
            let length = study.cells()[cell].scenario.filter.length;
            let delay = point.detection.map_or(f64::NAN, |seen| seen.median);
            format!("take ξ2 = {:.1} mm with N = {length}: {delay:.3} s after contact", point.threshold * 1e3)
        }
        Verdict::TooFewRuns { needed } => format!("too few runs: {needed} repeats could show 5 %"),
        other => format!("no threshold: {other:?}"),
    };
    Ok(text + &advice + "\n")
}
