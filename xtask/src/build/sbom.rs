//! A list of everything that the page is built from, for programs to read: CycloneDX as JSON. It names no time and no place, so that the same
//! commit gives the same bytes.

use super::linked::{Name, Part};
use crate::licence::Expression;
use crate::run::{output, root, run};
use crate::tools;
use anyhow::{Context, Result};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Its name in the page.
pub const NAME: &str = "sbom.cdx.json";

/// The fonts inside the page and the theory: file, name and version.
const FONTS: [(&str, &str, &str); 3] = [
    ("assets/fonts/Inter-Regular.otf", "Inter Regular", "4.0"),
    ("assets/fonts/Inter-SemiBold.otf", "Inter SemiBold", "4.0"),
    ("theory/font/STIXTwoMath.woff2", "STIX Two Math", "2.12"),
];

/// The document.
pub fn document(parts: &[Part]) -> Result<String> {
    let page = parts.iter().find(|part| part.package.is_ours() && part.package.name == "centrode");
    let page = page.context("the page is not among its parts")?;
    let others = parts.iter().filter(|part| part.package != page.package);
    let mut components: Vec<Value> = others.map(component).collect::<Result<_>>()?;
    components.push(standard_library()?);
    for (file, name, version) in FONTS {
        let bytes = fs::read(root().join(file)).with_context(|| file.to_owned())?;
        components.push(json!({
            "type": "file", "bom-ref": file, "name": name, "version": version,
            "hashes": [hash(&hexadecimal(&bytes))], "licenses": [{ "expression": "OFL-1.1" }],
        }));
    }
    let needs = |part: &Part| {
        let on: Vec<String> = part.needs.iter().map(reference).collect();
        json!({ "ref": reference(&named(part)), "dependsOn": on })
    };
    let document = json!({
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": { "component": application(page)? },
        "components": components,
        "dependencies": parts.iter().map(needs).collect::<Vec<_>>(),
    });
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// What checks the document, by the schema that CycloneDX publishes.
const VALIDATOR: [&str; 4] =
    ["@cyclonedx/cyclonedx-library@6.13.1", "ajv@8.17.1", "ajv-formats@3.0.1", "ajv-formats-draft2019@1.6.1"];

/// Whether a built document is what CycloneDX says that it must be.
pub fn check(file: &Path) -> Result<()> {
    let modules =
        tools::npm(&VALIDATOR).context("the list of what the page is built from is held against its schema")?;
    let script = root().join("xtask/src/build/sbom-check.cjs");
    run(Command::new("node").arg(script).arg(file).env("NODE_PATH", modules))
        .with_context(|| format!("{} is no CycloneDX", file.display()))
}

fn application(page: &Part) -> Result<Value> {
    let mut value = component(page)?;
    value["type"] = "application".into();
    Ok(value)
}

fn component(part: &Part) -> Result<Value> {
    let package = &part.package;
    let licence = package.licence.as_deref().with_context(|| format!("{} states no licence", package.name))?;
    let mut value = json!({
        "type": "library",
        "bom-ref": reference(&named(part)),
        "name": package.name,
        "version": package.version,
        "description": package.description.split_whitespace().collect::<Vec<_>>().join(" "),
        // What only runs while the page is built is not in it.
        "scope": if part.is_linked { "required" } else { "excluded" },
        "licenses": [{ "expression": Expression::read(licence)?.to_string() }],
        "purl": reference(&named(part)),
    });
    if let Some(checksum) = &part.checksum {
        value["hashes"] = json!([hash(checksum)]);
    }
    Ok(value)
}

/// What the compiler brings and links.
fn standard_library() -> Result<Value> {
    let told = output(Command::new("rustc").arg("--version"))?;
    let version = told.split(' ').nth(1).context("rustc tells no version")?.trim();
    Ok(json!({
        "type": "library", "bom-ref": format!("rust-std@{version}"), "name": "rust-std", "version": version,
        "description": "The standard library of Rust", "scope": "required",
        "licenses": [{ "expression": "MIT OR Apache-2.0" }],
    }))
}

fn hash(hexadecimal: &str) -> Value {
    json!({ "alg": "SHA-256", "content": hexadecimal })
}

fn hexadecimal(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        // Writing to a text does not fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

fn named(part: &Part) -> Name {
    (part.package.name.clone(), part.package.version.clone())
}

/// The address of a package, as package managers agree on it.
fn reference((name, version): &Name) -> String {
    format!("pkg:cargo/{name}@{}", version.replace('+', "%2B"))
}

#[cfg(test)]
mod tests {
    use super::super::linked::parts;
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_part_is_named_once_and_every_reference_leads_somewhere() {
        let parts = parts().unwrap();
        let text = document(&parts).unwrap();
        assert_eq!(text, document(&parts).unwrap());
        assert!(!text.contains(&root().display().to_string()), "it names this machine");
        let document: Value = serde_json::from_str(&text).unwrap();
        assert_eq!((&document["bomFormat"], &document["specVersion"]), (&json!("CycloneDX"), &json!("1.6")));
        let list = |key: &str| document[key].as_array().unwrap().clone();
        let page = document["metadata"]["component"].clone();
        assert_eq!((&page["name"], &page["type"]), (&json!("centrode"), &json!("application")));
        let components: Vec<Value> = list("components").into_iter().chain([page]).collect();
        let refs: BTreeSet<&str> = components.iter().map(|part| part["bom-ref"].as_str().unwrap()).collect();
        assert_eq!(refs.len(), components.len());
        for node in list("dependencies") {
            assert!(refs.contains(node["ref"].as_str().unwrap()));
            assert!(node["dependsOn"].as_array().unwrap().iter().all(|on| refs.contains(on.as_str().unwrap())));
        }
        let egui = components.iter().find(|part| part["name"] == "egui").unwrap();
        assert_eq!(egui["hashes"][0]["content"].as_str().unwrap().len(), 64);
        assert_eq!(
            (&egui["scope"], &egui["licenses"][0]["expression"]),
            (&json!("required"), &json!("MIT OR Apache-2.0"))
        );
    }

    #[test]
    fn hashes_are_those_of_other_tools() {
        // printf abc | sha256sum
        assert_eq!(hexadecimal(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
