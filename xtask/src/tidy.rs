//! The rules of the house that are ours to check: who may import whom, how long a file may be, why a dependency is there.

mod dependencies;
mod rules;

use crate::run::root;
use anyhow::{Result, bail};
use std::fs;
use std::path::{Path, PathBuf};

/// Folders and files of the repository that the rules look at.
const WATCHED: [&str; 9] = ["core", "src", "theory", "tests", "benches", "examples", "web", "xtask", "index.html"];
const KINDS: [&str; 5] = ["rs", "js", "css", "html", "wgsl"];

/// `cargo xtask tidy`.
pub fn command() -> Result<()> {
    let offences = check(&root())?;
    for offence in &offences {
        println!("{offence}");
    }
    match offences.len() {
        0 => Ok(()),
        count => bail!("{count} offences against the rules of the house"),
    }
}

/// Every offence, as `file:line: rule`.
fn check(root: &Path) -> Result<Vec<String>> {
    let mut files = Vec::new();
    for watched in WATCHED {
        collect(&root.join(watched), &mut files)?;
    }
    files.sort();
    let mut offences = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file)?;
        let name = file.strip_prefix(root).unwrap_or(&file);
        let name = name.to_string_lossy().replace('\\', "/");
        for (line, rule) in rules::offences(&name, &text) {
            offences.push(format!("{name}:{line}: {rule}"));
        }
    }
    offences.extend(dependencies::check(root)?);
    Ok(offences)
}

fn collect(path: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    if path.is_dir() {
        for entry in fs::read_dir(path)? {
            collect(&entry?.path(), files)?;
        }
    } else if path.extension().is_some_and(|kind| KINDS.iter().any(|watched| kind == *watched)) {
        files.push(path.to_owned());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_house_keeps_its_rules() {
        let offences = super::check(&crate::run::root()).unwrap();
        assert!(offences.is_empty(), "\n{}\n", offences.join("\n"));
    }
}
