//! The same bits on another kind of processor: everything is computed on an emulated aarch64 and compared with what is stored.

use crate::run::{cargo, output, root};
use crate::tools;
use anyhow::{Context, Result, bail};
use std::fs;

const TARGET: &str = "aarch64-unknown-linux-gnu";
const LINKER: &str = "aarch64-linux-gnu-gcc";
const EMULATOR: &str = "qemu-aarch64-static";
const LIBRARIES: &str = "/usr/aarch64-linux-gnu";

/// What brings them in Debian.
const PACKAGES: [&str; 3] = ["qemu-user-static", "gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross"];

/// Computes and compares.
pub fn check() -> Result<()> {
    if cfg!(all(target_os = "linux", target_arch = "aarch64")) {
        println!("this is an aarch64: `native` has compared the bits");
        return Ok(());
    }
    if [LINKER, EMULATOR].into_iter().any(|program| tools::on_path(&[program]).is_none()) {
        tools::install(&PACKAGES).context("aarch64 is compiled for by a linker of its own, and emulated")?;
    }
    tools::rust_target(TARGET, "the same bits are looked for on aarch64")?;
    let computed = output(
        cargo()
            .args(["run", "--package", "centrode-core", "--example", "fingerprints", "--target", TARGET])
            .env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER", LINKER)
            .env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER", format!("{EMULATOR} -L {LIBRARIES}")),
    )?;
    let stored = fs::read_to_string(root().join("tests/data/fingerprints.json"))?;
    let others = apart(&serde_json::from_str(&computed)?, &serde_json::from_str(&stored)?);
    if !others.is_empty() {
        bail!("other bits on aarch64: {}", others.join(", "));
    }
    println!("aarch64 computes the same bits");
    Ok(())
}

type Hashes = std::collections::BTreeMap<String, String>;

/// The names of what differs, or is in one alone.
fn apart(ours: &Hashes, stored: &Hashes) -> Vec<String> {
    let names: std::collections::BTreeSet<_> = ours.keys().chain(stored.keys()).collect();
    names.into_iter().filter(|name| ours.get(*name) != stored.get(*name)).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_is_named() {
        let hashes = |pairs: &[(&str, &str)]| -> Hashes {
            pairs.iter().map(|(name, hash)| ((*name).into(), (*hash).into())).collect()
        };
        let stored = hashes(&[("map", "1"), ("study", "2"), ("table2", "3")]);
        assert!(apart(&stored, &stored).is_empty());
        let ours = hashes(&[("map", "1"), ("study", "4"), ("figure 3", "5")]);
        assert_eq!(apart(&ours, &stored), ["figure 3", "study", "table2"]);
    }
}
