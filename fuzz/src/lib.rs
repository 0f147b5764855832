//! What every target does: read a file piece by piece, and make a recording of it.

use centrode_core::record::log::{Commands, Format, Options, Rate, Reader, Setup, assemble};
use centrode_core::scenario::Scenario;

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
