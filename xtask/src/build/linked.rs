//! What the page is built from: the packages linked into its program, and those that run while it is built.

use crate::metadata::{Metadata, Package};
use crate::run::{cargo, output, root};
use crate::tools::WASM;
use anyhow::{Context, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// A package and its version.
pub type Name = (String, String);

/// A package of the page.
pub struct Part {
    /// The package.
    pub package: Package,
    /// Whether it is linked into the program; else it only runs while that is built.
    pub is_linked: bool,
    /// SHA-256 of what the registry holds, in hexadecimal digits; none for ours.
    pub checksum: Option<String>,
    /// What it is made of at first hand.
    pub needs: BTreeSet<Name>,
}

/// All of them, sorted by name.
pub fn parts() -> Result<Vec<Part>> {
    let metadata = Metadata::read(&["--all-features"])?;
    let known: BTreeMap<Name, &Package> = metadata.all().map(|package| (name(package), package)).collect();
    let linked = read(&tree("normal,no-proc-macro")?)?;
    let lock = checksums(&fs::read_to_string(root().join("Cargo.lock"))?)?;
    let part = |(name, needs): (Name, BTreeSet<Name>)| {
        let package = (*known.get(&name).with_context(|| format!("{name:?} is not known"))?).clone();
        Ok(Part { package, is_linked: linked.contains_key(&name), checksum: lock.get(&name).cloned(), needs })
    };
    read(&tree("normal,build")?)?.into_iter().map(part).collect()
}

fn name(package: &Package) -> Name {
    (package.name.clone(), package.version.clone())
}

/// As Cargo prints it for the page as it is built: a depth, a package and its version in each line. Cargo's metadata would mix in what
/// other packages of the workspace ask for.
fn tree(edges: &str) -> Result<String> {
    let page = ["--package", "centrode", "--no-default-features", "--features", "app", "--target", WASM];
    let shape = ["--prefix", "depth", "--format", " {p}", "--edges", edges];
    output(cargo().args(["tree", "--locked"]).args(page).args(shape))
}

fn read(tree: &str) -> Result<BTreeMap<Name, BTreeSet<Name>>> {
    let mut needs: BTreeMap<Name, BTreeSet<Name>> = BTreeMap::new();
    let mut above: Vec<Name> = Vec::new();
    for line in tree.lines() {
        let mut words = line.split(' ');
        let depth: usize = words.next().unwrap_or_default().parse().with_context(|| format!("no depth: {line}"))?;
        let (Some(package), Some(version)) = (words.next(), words.next()) else { continue };
        let name = (package.to_owned(), version.trim_start_matches('v').to_owned());
        above.truncate(depth);
        if let Some(parent) = above.last() {
            needs.entry(parent.clone()).or_default().insert(name.clone());
        }
        needs.entry(name.clone()).or_default();
        above.push(name);
    }
    Ok(needs)
}

fn checksums(lock: &str) -> Result<BTreeMap<Name, String>> {
    let table: toml::Table = lock.parse()?;
    let packages = table.get("package").and_then(toml::Value::as_array).context("the lock file has no package")?;
    let text = |package: &toml::Value, key: &str| package.get(key).and_then(toml::Value::as_str).map(String::from);
    let entry = |package| Some(((text(package, "name")?, text(package, "version")?), text(package, "checksum")?));
    Ok(packages.iter().filter_map(entry).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_made_of_what_its_program_holds() {
        let parts = parts().unwrap();
        let part = |name: &str| parts.iter().find(|part| part.package.name == name);
        for name in ["centrode", "centrode-core", "egui", "wgpu", "nalgebra", "wasm-bindgen"] {
            assert!(part(name).unwrap().is_linked, "{name}");
        }
        // What makes code, and what the command or tests need.
        assert!(!part("serde_derive").unwrap().is_linked);
        for name in ["clap", "rayon", "resvg", "proptest", "egui_kittest"] {
            assert!(part(name).is_none(), "{name}");
        }
        assert!(parts.iter().all(|part| part.package.is_ours() == part.checksum.is_none()));
        assert!(part("centrode").unwrap().needs.iter().any(|(name, _)| name == "centrode-core"));
    }

    #[test]
    fn a_tree_is_read_by_its_depths() {
        let read = read("0 a v1.0.0 (/a)\n1 b v2.0.0\n2 c v3.0.0+x (proc-macro)\n1 c v3.0.0+x (*)\n").unwrap();
        let name = |name: &str, version: &str| (name.to_owned(), version.to_owned());
        let [a, b, c] = [name("a", "1.0.0"), name("b", "2.0.0"), name("c", "3.0.0+x")];
        assert_eq!(read[&a], BTreeSet::from([b.clone(), c.clone()]));
        assert_eq!((&read[&b], &read[&c]), (&BTreeSet::from([c.clone()]), &BTreeSet::new()));
    }
}
