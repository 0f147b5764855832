//! The targets of fuzzing on fixed inputs: those of `fuzz/corpus/`, the experiments that are shipped, and these spoilt.
//!
//! `cargo xtask fuzz` looks for more of them.

#[path = "../../fuzz/src/lib.rs"]
mod targets;

use centrode_core::scenario::preset::{CHAINS, PRESETS};
use std::path::{Path, PathBuf};
use targets::{TARGETS, run};

/// The inputs of a target.
fn inputs(name: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(name);
    let list = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = list.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

/// The same with some bytes changed, in a way that a seed says.
fn spoilt(bytes: &[u8], mut seed: u64) -> Vec<u8> {
    let mut next = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below.max(1)
    };
    let mut spoilt = bytes.to_vec();
    for _ in 0..=next(4) {
        let (at, count) = (next(spoilt.len() + 1), next(9));
        match next(4) {
            0 => spoilt.truncate(at),
            1 => {
                let end = (at + count).min(spoilt.len());
                spoilt.drain(at..end);
            }
            2 => spoilt.insert(at, b"0123456789.-=,\n\"[]e&#"[next(21)]),
            _ => spoilt.iter_mut().skip(at).take(1).for_each(|byte| *byte = next(256) as u8),
        }
    }
    spoilt
}

#[test]
fn every_target_holds_on_its_inputs_and_on_these_spoilt() {
    for (name, target) in TARGETS {
        let files = inputs(name);
        assert!(!files.is_empty(), "{name} has no input");
        for file in files {
            let bytes = std::fs::read(&file).expect("a file");
            println!("{}", file.display());
            target(&bytes);
            if name == "run" {
                // In all ways, of which its first byte names one, and by itself.
                (0..5).for_each(|way| target(&[&[way], bytes.get(1..).unwrap_or_default()].concat()));
            }
            (0..4).for_each(|seed| target(&spoilt(&bytes, seed)));
        }
    }
}

#[test]
fn every_experiment_that_is_shipped_holds_spoilt_too() {
    for preset in PRESETS.iter().chain(CHAINS) {
        (0..200).for_each(|seed| run("scenario", &spoilt(preset.toml.as_bytes(), seed)));
    }
}
