//! What Cargo knows of the packages that everything is built from.

use crate::run::{cargo, output};
use anyhow::{Context, Result};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// A package.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Package {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Where it comes from; none for ours.
    pub source: Option<String>,
    /// Its licence as an expression of SPDX; none where it states none.
    pub licence: Option<String>,
    /// Who wrote it, as it says.
    pub authors: Vec<String>,
    /// What it says about itself.
    pub description: String,
    /// The oldest Rust that it states.
    pub rust_version: Option<String>,
    /// The folder of its files.
    pub folder: PathBuf,
}

impl Package {
    /// Whether it is one of this repository.
    pub fn is_ours(&self) -> bool {
        self.source.is_none()
    }
}

/// Which edges of the graph are followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edges {
    /// What is linked into the product.
    Normal,
    /// What runs while it is built, too.
    Build,
}

/// All packages, and what each is built from.
pub struct Metadata {
    packages: BTreeMap<String, Package>,
    /// By package: the others, and how it needs them.
    needs: BTreeMap<String, Vec<(String, BTreeSet<Kind>)>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Normal,
    Build,
    Dev,
}

impl Metadata {
    /// Of the workspace, with what its lock file names. `arguments` choose a target or features.
    pub fn read(arguments: &[&str]) -> Result<Self> {
        let told = output(cargo().args(["metadata", "--format-version", "1", "--locked"]).args(arguments))?;
        Self::of(&serde_json::from_str(&told)?)
    }

    fn of(told: &Value) -> Result<Self> {
        let list = |value: &Value, key: &str| value[key].as_array().cloned().unwrap_or_default();
        let mut packages = BTreeMap::new();
        for package in list(told, "packages") {
            let text = |key: &str| package[key].as_str().map(str::to_owned);
            let manifest = PathBuf::from(text("manifest_path").context("a package without a manifest")?);
            let known = Package {
                name: text("name").context("a package without a name")?,
                version: text("version").context("a package without a version")?,
                source: text("source"),
                licence: text("license"),
                authors: list(&package, "authors")
                    .iter()
                    .filter_map(|author| author.as_str().map(String::from))
                    .collect(),
                description: text("description").unwrap_or_default(),
                rust_version: text("rust_version"),
                folder: manifest.parent().map(PathBuf::from).unwrap_or_default(),
            };
            packages.insert(text("id").context("a package without an id")?, known);
        }
        let mut needs = BTreeMap::new();
        for node in list(&told["resolve"], "nodes") {
            let edge = |edge: &Value| {
                let kind = |kind: &Value| match kind["kind"].as_str() {
                    Some("build") => Kind::Build,
                    Some("dev") => Kind::Dev,
                    _ => Kind::Normal,
                };
                (
                    edge["pkg"].as_str().unwrap_or_default().to_owned(),
                    list(edge, "dep_kinds").iter().map(kind).collect(),
                )
            };
            let id = node["id"].as_str().context("a node without an id")?.to_owned();
            needs.insert(id, list(&node, "deps").iter().map(edge).collect());
        }
        Ok(Self { packages, needs })
    }

    /// All packages, those of tests and tools included.
    pub fn all(&self) -> impl Iterator<Item = &Package> {
        self.packages.values()
    }

    /// One of our packages.
    pub fn ours(&self, name: &str) -> Result<&Package> {
        let found = self.packages.values().find(|package| package.is_ours() && package.name == name);
        found.with_context(|| format!("there is no package {name}"))
    }

    /// What one of our packages is made of, itself included, sorted.
    pub fn closure(&self, name: &str, edges: Edges) -> Result<Vec<&Package>> {
        let of = |(_, package): &(&String, &Package)| package.is_ours() && package.name == name;
        let (root, _) = self.packages.iter().find(of).with_context(|| format!("there is no package {name}"))?;
        let (mut seen, mut left) = (BTreeSet::new(), vec![root.as_str()]);
        while let Some(id) = left.pop() {
            if seen.insert(id) {
                left.extend(self.edges(id, edges));
            }
        }
        let mut found: Vec<&Package> = seen.into_iter().filter_map(|id| self.packages.get(id)).collect();
        found.sort();
        Ok(found)
    }

    fn edges(&self, id: &str, edges: Edges) -> impl Iterator<Item = &str> {
        let wanted: &[Kind] = if edges == Edges::Normal { &[Kind::Normal] } else { &[Kind::Normal, Kind::Build] };
        let of = self.needs.get(id).into_iter().flatten();
        let followed = of.filter(move |(_, kinds)| wanted.iter().any(|kind| kinds.contains(kind)));
        followed.map(|(id, _)| id.as_str())
    }
}

/// A version as numbers, as far as it has them: `1.89` is `[1, 89]`.
pub fn numbers(version: &str) -> Vec<u64> {
    version.split(['.', '-', '+']).map_while(|part| part.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_core_is_made_of_what_its_manifest_names() {
        let metadata = Metadata::read(&[]).unwrap();
        let names = |edges| -> Vec<&str> {
            metadata.closure("centrode-core", edges).unwrap().iter().map(|package| package.name.as_str()).collect()
        };
        let normal = names(Edges::Normal);
        assert!(normal.contains(&"nalgebra") && normal.contains(&"centrode-core") && normal.contains(&"serde_json"));
        assert!(!normal.contains(&"egui") && !normal.contains(&"proptest") && !normal.contains(&"autocfg"));
        assert!(names(Edges::Build).contains(&"autocfg"));
        let core = metadata.ours("centrode-core").unwrap();
        assert!(core.is_ours() && core.rust_version.is_some());
        assert!(metadata.ours("nalgebra").is_err());
    }

    #[test]
    fn versions_are_compared_as_numbers() {
        assert!(numbers("1.9") < numbers("1.89") && numbers("1.89") < numbers("1.89.1"));
        assert_eq!(numbers("1.95.0-nightly"), [1, 95, 0]);
    }
}
