//! Names of places in the program, for the messages of a panic: the same wherever it is built, and none of this machine.

use crate::metadata::Metadata;
use crate::run::{output, root};
use crate::tools::WASM;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

/// Places on this machine, and what they are called in the program.
pub fn places() -> Result<BTreeMap<PathBuf, String>> {
    let metadata = Metadata::read(&["--all-features"])?;
    let registries = metadata.all().filter(|package| !package.is_ours());
    let registries = registries.filter_map(|package| package.folder.parent().map(PathBuf::from));
    let mut places: BTreeMap<PathBuf, String> = registries.map(|folder| (folder, "registry".into())).collect();
    places.insert(root(), "centrode".into());
    // With the sources of the standard library at hand, the compiler would name those.
    let sysroot = PathBuf::from(output(Command::new("rustc").args(["--print", "sysroot"]))?.trim());
    places.insert(sysroot.join("lib/rustlib/src/rust"), format!("/rustc/{}", commit()?));
    Ok(places)
}

/// The commit of the compiler, by which it names its own sources.
fn commit() -> Result<String> {
    let told = output(Command::new("rustc").arg("--version").arg("--verbose"))?;
    let line = told.lines().find_map(|line| line.strip_prefix("commit-hash: "));
    Ok(line.context("rustc tells no commit")?.to_owned())
}

/// The setting of Cargo by which the compiler takes the other names.
pub fn setting() -> Result<String> {
    let flag = |(from, to): (PathBuf, String)| format!("--remap-path-prefix={}={to}", from.display());
    let flags: Vec<String> = places()?.into_iter().map(flag).collect();
    // As TOML, which quotes like JSON.
    Ok(format!("target.{WASM}.rustflags={}", serde_json::to_string(&flags)?))
}
