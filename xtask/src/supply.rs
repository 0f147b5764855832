//! What `deny.toml` allows, checked without cargo-deny: licences, where packages come from, and which stand twice among them.
//!
//! The publishing workflow runs cargo-deny itself, which also asks for advisories.

use crate::licence::{self, Expression};
use crate::metadata::{Metadata, Package};
use crate::run::root;
use anyhow::{Context, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// What is allowed.
struct Allowed {
    licences: Vec<String>,
    /// Further ones, by package.
    exceptions: BTreeMap<String, Vec<String>>,
    registries: Vec<String>,
    /// Packages that may stand beside a newer version, as `name@version`, where the version may be shortened.
    twice: Vec<String>,
    targets: Vec<String>,
}

impl Allowed {
    fn read() -> Result<Self> {
        let table: toml::Table = fs::read_to_string(root().join("deny.toml"))?.parse()?;
        let list = |value: Option<&toml::Value>| value.and_then(toml::Value::as_array).cloned().unwrap_or_default();
        let words = |value: Option<&toml::Value>| -> Vec<String> {
            list(value).iter().filter_map(|value| value.as_str().map(String::from)).collect()
        };
        let at = |group: &str, key: &str| table.get(group).and_then(|group| group.get(key));
        let name = |entry: &toml::Value| {
            entry["crate"].as_str().context("deny.toml: a crate without a name").map(String::from)
        };
        let exception = |entry: &toml::Value| Ok((name(entry)?, words(entry.get("allow"))));
        Ok(Self {
            licences: licence::allowed()?,
            exceptions: list(at("licenses", "exceptions")).iter().map(exception).collect::<Result<_>>()?,
            registries: words(at("sources", "allow-registry")),
            twice: list(at("bans", "skip")).iter().map(name).collect::<Result<_>>()?,
            targets: words(at("graph", "targets")),
        })
    }

    fn metadata(&self) -> Result<Metadata> {
        let targets = self.targets.iter().flat_map(|target| ["--filter-platform", target]);
        Metadata::read(&["--all-features"].into_iter().chain(targets).collect::<Vec<_>>())
    }

    /// Why a package's licence is refused.
    fn licence(&self, package: &Package) -> Option<String> {
        let Package { name, version, licence, .. } = package;
        let Some(licence) = licence else { return Some(format!("{name} {version} states no licence")) };
        let further = self.exceptions.get(name).into_iter().flatten();
        let allowed: Vec<String> = self.licences.iter().chain(further).cloned().collect();
        match Expression::read(licence) {
            Ok(expression) if expression.taken(&allowed).is_some() => None,
            Ok(_) => Some(format!("{name} {version}: {licence} is not allowed")),
            Err(error) => Some(format!("{name} {version}: {error:#}")),
        }
    }

    /// Why the place that a package comes from is refused.
    fn source(&self, package: &Package) -> Option<String> {
        let source = package.source.as_ref()?;
        let known = |registry: &String| source.strip_prefix("registry+") == Some(registry);
        (!self.registries.iter().any(known)).then(|| format!("{} comes from {source}", package.name))
    }

    /// Packages that stand beside a newer version and may not; and those that may but do not any more.
    fn twice<'a>(&self, packages: impl Iterator<Item = &'a Package>) -> Vec<String> {
        let mut versions: BTreeMap<&str, BTreeSet<(Vec<u64>, &str)>> = BTreeMap::new();
        for package in packages {
            versions
                .entry(&package.name)
                .or_default()
                .insert((crate::metadata::numbers(&package.version), &package.version));
        }
        let mut left: BTreeSet<&String> = self.twice.iter().collect();
        let mut found = Vec::new();
        for (name, versions) in versions {
            let older = versions.len() - 1;
            for (_, version) in versions.into_iter().take(older) {
                let full = format!("{name}@{version}");
                let begins = |short: &&String| full == **short || full.starts_with(&format!("{short}."));
                match self.twice.iter().find(begins) {
                    Some(known) => drop(left.remove(known)),
                    None => found.push(format!("{full} stands beside a newer one")),
                }
            }
        }
        found.extend(
            left.into_iter().map(|known| format!("{known} is allowed twice, but does not stand twice any more")),
        );
        found
    }
}

fn refused<'a>(
    packages: impl Iterator<Item = &'a Package>,
    rule: impl Fn(&'a Package) -> Option<String>,
) -> Vec<String> {
    packages.filter_map(rule).collect()
}

#[test]
fn every_licence_is_allowed_and_every_package_comes_from_where_it_may() {
    let allowed = Allowed::read().unwrap();
    let metadata = allowed.metadata().unwrap();
    assert!(metadata.all().count() > 200);
    assert_eq!(refused(metadata.all(), |package| allowed.licence(package)), Vec::<String>::new());
    assert_eq!(refused(metadata.all(), |package| allowed.source(package)), Vec::<String>::new());
}

#[test]
fn no_package_stands_twice_that_need_not() {
    let allowed = Allowed::read().unwrap();
    assert_eq!(allowed.twice(allowed.metadata().unwrap().all()), Vec::<String>::new());
}

#[test]
fn what_is_not_allowed_is_found() {
    let allowed = Allowed::read().unwrap();
    let metadata = allowed.metadata().unwrap();
    let package = metadata.all().find(|package| package.name == "nalgebra").unwrap();
    let stating = |licence: Option<&str>| Package { licence: licence.map(String::from), ..package.clone() };
    for licence in [None, Some("GPL-3.0-only"), Some("MPL-2.0"), Some("MIT OR"), Some("")] {
        assert!(allowed.licence(&stating(licence)).is_some(), "{licence:?}");
    }
    for source in ["git+https://github.com/dimforge/nalgebra", "registry+https://example.org/index"] {
        let elsewhere = Package { source: Some(source.into()), ..package.clone() };
        assert!(allowed.source(&elsewhere).unwrap().contains(source));
    }
    let older = Package { version: "0.9.1".into(), ..package.clone() };
    let found = allowed.twice(metadata.all().chain([&older]));
    assert_eq!(found, ["nalgebra@0.9.1 stands beside a newer one"]);
    // One that has gone.
    let found = allowed.twice(metadata.all().filter(|package| package.name != "base64"));
    assert_eq!(found.len(), 1);
    assert!(found[0].starts_with("base64@0.22 is allowed twice"));
}
