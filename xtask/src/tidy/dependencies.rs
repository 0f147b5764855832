//! Every direct dependency has a row in `docs/DEPENDENCIES.md` that says where it is used and why, and every row a dependency.

use anyhow::{Context, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The document.
const DOCUMENT: &str = "docs/DEPENDENCIES.md";
/// The folders of the packages.
const PACKAGES: [&str; 5] = [".", "core", "theory", "xtask", "fuzz"];

/// Places by package: the packages that name it, with what for where that is tests or building.
type Places = BTreeMap<String, BTreeSet<String>>;

/// Every difference, as `file:line: rule`.
pub fn check(root: &Path) -> Result<Vec<String>> {
    let mut named = Places::new();
    for folder in PACKAGES {
        let path = root.join(folder).join("Cargo.toml");
        let manifest = fs::read_to_string(&path).with_context(|| path.display().to_string())?.parse()?;
        collect(&manifest, &mut named).with_context(|| path.display().to_string())?;
    }
    let text = fs::read_to_string(root.join(DOCUMENT))?;
    Ok(compare(&named, &text))
}

fn collect(manifest: &toml::Table, named: &mut Places) -> Result<()> {
    let name = manifest.get("package").and_then(|package| package.get("name")).and_then(toml::Value::as_str);
    let name = name.context("the package has no name")?;
    let targets = manifest.get("target").and_then(toml::Value::as_table).into_iter().flatten();
    let tables = targets.filter_map(|(_, target)| target.as_table()).chain([manifest]);
    for table in tables {
        for (kind, what) in [("dependencies", ""), ("dev-dependencies", " (tests)"), ("build-dependencies", " (build)")]
        {
            for (key, value) in table.get(kind).and_then(toml::Value::as_table).into_iter().flatten() {
                let package = value.get("package").and_then(toml::Value::as_str).unwrap_or(key);
                named.entry(package.into()).or_default().insert(format!("{name}{what}"));
            }
        }
    }
    Ok(())
}

/// The rows of the document whose table says where, each with its line.
fn rows(text: &str) -> Vec<(usize, &str, BTreeSet<String>, &str)> {
    let mut rows = Vec::new();
    let mut inside = false;
    for (number, line) in text.lines().enumerate() {
        let cells: Vec<&str> = line.trim().trim_matches('|').split('|').map(str::trim).collect();
        if !line.starts_with('|') {
            inside = false;
        } else if cells.get(1) == Some(&"where") {
            inside = true;
        } else if let ([name, places, why], true) = (&cells[..], inside)
            && !name.starts_with('-')
        {
            let places = places.split(',').map(|place| place.trim().to_owned()).collect();
            rows.push((number + 1, name.trim_matches('`'), places, *why));
        }
    }
    rows
}

fn compare(named: &Places, text: &str) -> Vec<String> {
    let mut left: BTreeMap<&str, &BTreeSet<String>> =
        named.iter().map(|(name, places)| (name.as_str(), places)).collect();
    let mut found = Vec::new();
    let words = |places: &BTreeSet<String>| places.iter().map(String::as_str).collect::<Vec<_>>().join(", ");
    for (line, name, places, why) in rows(text) {
        let at = format!("{DOCUMENT}:{line}: {name}");
        match left.remove(name) {
            None => found.push(format!("{at} is named twice, or in no manifest")),
            Some(known) if *known != places => {
                found.push(format!("{at} is used by {}, not by {}", words(known), words(&places)))
            }
            Some(_) if why.is_empty() => found.push(format!("{at}: why is it there?")),
            Some(_) => {}
        }
    }
    found.extend(
        left.into_iter().map(|(name, places)| format!("{DOCUMENT}:1: {name}, used by {}, has no row", words(places))),
    );
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_and_manifests_agree_row_by_row() {
        let manifest = "[package]\nname = \"a\"\n[dependencies]\nx = \"1\"\nz = { version = \"1\", package = \"y\" }\n\
                        [target.'cfg(unix)'.dev-dependencies]\nx = \"1\"\n";
        let mut named = Places::new();
        collect(&manifest.parse().unwrap(), &mut named).unwrap();
        let table = |rows: &str| {
            format!("| package | where | why |\n| --- | --- | --- |\n{rows}\n| other | kind | of table |\n")
        };
        let good = "| `x` | a (tests), a | sums |\n| `y` | a | products |\n";
        assert_eq!(compare(&named, &table(good)), Vec::<String>::new());
        for (rows, said) in [
            ("| `x` | a (tests), a | sums |\n", "DEPENDENCIES.md:1: y, used by a, has no row"),
            ("| `x` | a | sums |\n| `y` | a | products |\n", "DEPENDENCIES.md:3: x is used by a, a (tests), not by a"),
            ("| `x` | a, a (tests) | |\n| `y` | a | products |\n", "DEPENDENCIES.md:3: x: why is it there?"),
            (&format!("{good}| `x` | a | again |\n"), "DEPENDENCIES.md:5: x is named twice, or in no manifest"),
            (&format!("{good}| `w` | a | more |\n"), "w is named twice, or in no manifest"),
        ] {
            let found = compare(&named, &table(rows));
            assert!(found.len() == 1 && found[0].contains(said), "{said}: {found:?}");
        }
    }
}
