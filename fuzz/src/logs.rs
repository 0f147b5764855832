//! Logs: a file is read piece by piece, and a recording made of it.

use centrode_core::record::log::chain::{self, ChainLog, ChainOptions, Expected};
use centrode_core::record::log::{Commands, Format, Options, Rate, Reader, Setup, assemble};
use centrode_core::scenario::Scenario;
use centrode_core::scenario::chain::ChainScenario;
use centrode_core::scenario::preset::find_chain;
use std::sync::LazyLock;

/// Reads bytes as a log of a format. Nothing may panic; whether the log is refused does not matter.
pub fn read(format: Format, bytes: &[u8]) {
    let options =
        Options { format: Some(format), tool: Some("1".into()), frame_rate: Some(100.0), ..Options::default() };
    let Ok(mut reader) = Reader::new("fuzzed", bytes.to_vec(), &options) else { return };
    loop {
        match reader.work(16) {
            Ok(progress) if progress.is_done() => break,
            Ok(_) => {}
            Err(_) => return,
        }
    }
    let Ok(log) = reader.finish() else { return };
    // Slow enough that a recording stays small.
    let scenario = Scenario { loop_rate: 10.0, ..Scenario::default() };
    for commands in [None, Some(Commands::Motion)] {
        let _ = assemble(&log, &scenario, &Setup { rate: Rate::Scenario, commands, ..Setup::default() });
    }
}

/// Three segments, slow enough that a recording stays small.
static TWO_CONTACTS: LazyLock<ChainScenario> = LazyLock::new(|| {
    let slow = ["loop_rate=10".into(), "filter.length=10".into()];
    find_chain("two-contacts").expect("it is shipped").chain(&slow).expect("possible")
});

/// Reads bytes as a log of three trackers, in whatever format they look like. Nothing may panic; whether the log is refused does not matter.
pub fn read_several(bytes: &[u8]) {
    let scenario = &*TWO_CONTACTS;
    let mut log = ChainLog::new(scenario.segments.len());
    let read = chain::read("fuzzed", bytes.to_vec(), &Expected::of(scenario), &ChainOptions::default());
    if read.and_then(|read| log.take(read, "")).is_ok() {
        let _ = chain::assemble(log, scenario, &Setup::default());
    }
}
