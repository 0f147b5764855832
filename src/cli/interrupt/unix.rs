//! Signals and modes of files as Unix has them.

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::fs::{self, Permissions};
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::thread;

/// Calls `heard` at every interrupt, in a thread of its own.
pub fn on_interrupt(heard: impl Fn() + Send + 'static) -> io::Result<()> {
    let mut signals = Signals::new(heeded(&status()))?;
    thread::Builder::new().spawn(move || signals.forever().for_each(|_| heard())).map(drop)
}

/// The signals that interrupt a process with this status. A script's background job ignores SIGINT as well, but only a
/// person who means it sends it one.
fn heeded(status: &str) -> Vec<i32> {
    let mut signals = vec![SIGINT, SIGTERM];
    if !ignores(status, SIGHUP) {
        signals.push(SIGHUP);
    }
    signals
}

/// The status of this process as Linux gives it. Other systems tell it to `unsafe` code only; there a hangup always
/// interrupts.
fn status() -> String {
    fs::read_to_string("/proc/self/status").unwrap_or_default()
}

/// Whether a process with this status ignores a signal. Its line has a hexadecimal mask, whose first bit is signal 1.
fn ignores(status: &str, signal: i32) -> bool {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u128::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}

/// Readable as the process's umask has it, not by the owner alone.
pub fn usual_permissions() -> Option<Permissions> {
    Some(Permissions::from_mode(0o666))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hangup_that_is_ignored_is_not_heeded() {
        let status = |mask: &str| format!("Name:\tcentrode\nSigBlk:\t0000000000000001\nSigIgn:\t{mask}\nSigCgt:\t0\n");
        // SIGPIPE, which every Rust program ignores, is the thirteenth bit.
        for (mask, heard) in [("0000000000001000", true), ("0000000000001001", false), ("no mask", true)] {
            assert_eq!(heeded(&status(mask)).contains(&SIGHUP), heard, "{mask}");
        }
        assert_eq!(heeded(""), [SIGINT, SIGTERM, SIGHUP]);
    }
}
