//! Judges a log of a rig: reads its bytes, puts it on the loop's clock, and says which contacts there are.
//!
//! ```sh
//! cargo run --release --package centrode-core --example judge -- assets/logs/clean.csv
//! ```

#![allow(clippy::disallowed_methods, reason = "an example reads files and arguments")]

use centrode_core::detect::{Settings, judge};
use centrode_core::record::log::{Options, Reader, Setup, assemble};
use centrode_core::scenario::preset::find;
use std::error::Error;
use std::fmt::Write;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name a log: .csv, .tum or .mcap")?;
    print!("{}", report(&path, std::fs::read(&path)?)?);
    Ok(())
}

/// The events of a log. The core reads no files: whoever calls it brings the bytes.
pub fn report(name: &str, bytes: Vec<u8>) -> Result<String, Box<dyn Error>> {
    let mut reader = Reader::new(name, bytes, &Options::default())?;
    while !reader.work(10_000)?.is_done() {}
    let log = reader.finish()?;
    // The robot, its filter and thresholds. A log does not know what was true, and nothing here does.
    let nominal = find("bench")?.scenario()?;
    let assembled = assemble(&log, &nominal, &Setup::default())?;
    let recording = &assembled.recording;
    let judged = judge(recording, &Settings::of(&assembled.plan).on(recording));

    let mut text = format!("{name}: {} instants, commands: {}\n", recording.entries.len(), assembled.commands.told());
    for event in &judged.events {
        let cleared = event.cleared.map_or("stands at the end".into(), |time| format!("cleared at {time:.3} s"));
        writeln!(text, "{} raised at {:.3} s, {cleared}", event.detector.key(), event.raised)?;
    }
    if let Some(detection) = judged.detection() {
        writeln!(text, "Eq. 24 places the contact at {:.2} mm", detection.location * 1e3)?;
    }
    Ok(text)
}
