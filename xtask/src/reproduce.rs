//! The published page is the same bytes wherever it is built: it is built again from a copy in another folder, by the copy's own tools.

use crate::build::paths;
use crate::run::{cargo, output, root, run};
use anyhow::{Context, Result, bail, ensure};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Compares a page that was built here with one that is built in a copy.
pub fn check(dist: &Path) -> Result<()> {
    let copy = Copy::make()?;
    run(cargo()
        .args(["xtask", "build", "--single-file"])
        .current_dir(&copy.0)
        .env("CARGO_TARGET_DIR", copy.0.join("target")))?;
    let [here, there] = [dist, &copy.0.join("dist")].map(files);
    let differences = differences(&here?, &there?);
    ensure!(differences.is_empty(), "built in another folder the page differs: {}", differences.join(", "));
    println!("built in {}, the page is the same bytes", copy.0.display());
    Ok(())
}

/// What the repository holds, in a folder that is gone with it.
struct Copy(PathBuf);

impl Copy {
    fn make() -> Result<Self> {
        let copy = Self(std::env::temp_dir().join(format!("centrode-elsewhere-{}", std::process::id())));
        // What is not committed yet is built as well.
        let listed = output(std::process::Command::new("git").current_dir(root()).args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ]))?;
        for name in listed.split('\0').filter(|name| root().join(name).is_file()) {
            let to = copy.0.join(name);
            fs::create_dir_all(to.parent().context("a file without a folder")?)?;
            fs::copy(root().join(name), to).with_context(|| name.to_owned())?;
        }
        Ok(copy)
    }
}

impl Drop for Copy {
    fn drop(&mut self) {
        // What is left behind does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

type Files = BTreeMap<String, Vec<u8>>;

/// All files in a folder, by their paths in it.
fn files(folder: &Path) -> Result<Files> {
    let (mut found, mut left) = (Files::new(), vec![folder.to_owned()]);
    while let Some(next) = left.pop() {
        for entry in fs::read_dir(&next).with_context(|| next.display().to_string())? {
            let path = entry?.path();
            if path.is_dir() {
                left.push(path);
            } else {
                found.insert(path.strip_prefix(folder)?.to_string_lossy().into_owned(), fs::read(&path)?);
            }
        }
    }
    Ok(found)
}

/// The names of files that differ or are missing on one side.
fn differences(here: &Files, there: &Files) -> Vec<String> {
    let names: std::collections::BTreeSet<&String> = here.keys().chain(there.keys()).collect();
    let told = |name: &String| match (here.get(name), there.get(name)) {
        (Some(a), Some(b)) if a == b => None,
        (Some(a), Some(b)) => {
            let place = a.iter().zip(b).position(|(a, b)| a != b).unwrap_or(a.len().min(b.len()));
            Some(format!("{name} ({} and {} bytes, from byte {place} on)", a.len(), b.len()))
        }
        (Some(_), None) => Some(format!("{name} (here only)")),
        (None, _) => Some(format!("{name} (there only)")),
    };
    names.into_iter().filter_map(told).collect()
}

/// Checks that nothing of the built page names a folder of this machine: what does would differ elsewhere.
pub fn names_no_place(dist: &Path) -> Result<()> {
    let places: Vec<String> = paths::places()?.into_keys().map(|place| place.display().to_string()).collect();
    let mut found = Vec::new();
    for (name, bytes) in files(dist)? {
        for place in &places {
            if holds(&bytes, place.as_bytes()) {
                found.push(format!("{name} names {place}"));
            }
        }
    }
    if !found.is_empty() {
        bail!("the page names folders of this machine: {}", found.join(", "));
    }
    Ok(())
}

fn holds(bytes: &[u8], part: &[u8]) -> bool {
    !part.is_empty() && bytes.windows(part.len()).any(|window| window == part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_byte_or_one_file_is_a_difference() {
        let files = |list: &[(&str, &str)]| -> Files {
            list.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())).collect()
        };
        let here = files(&[("a", "same"), ("b", "one"), ("c", "left")]);
        assert_eq!(differences(&here, &here), Vec::<String>::new());
        let there = files(&[("a", "same"), ("b", "ore"), ("d", "right")]);
        let told = ["b (3 and 3 bytes, from byte 1 on)", "c (here only)", "d (there only)"];
        assert_eq!(differences(&here, &there), told);
    }

    #[test]
    fn a_folder_of_this_machine_is_found_in_a_page() {
        let dist = std::env::temp_dir().join(format!("centrode-places-{}", std::process::id()));
        fs::create_dir_all(&dist).unwrap();
        fs::write(dist.join("clean.html"), "registry/egui/src/lib.rs").unwrap();
        assert!(names_no_place(&dist).is_ok());
        fs::write(dist.join("a.wasm"), format!("\0{}/src/lib.rs\0", root().display())).unwrap();
        let refusal = names_no_place(&dist).unwrap_err().to_string();
        fs::remove_dir_all(&dist).unwrap();
        assert!(refusal.contains(&format!("a.wasm names {}", root().display())), "{refusal}");
    }
}
