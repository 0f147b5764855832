//! The page: wasm, its JavaScript, and the files of `web/`, assembled in `dist/`.

use crate::run::{cargo, root, run, target};
use crate::tools::{self, WASM};
use crate::{theory, transfer};
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Instant;

mod index;
pub mod licences;
mod linked;
pub mod paths;
pub mod sbom;
mod shaders;
pub mod single;

/// Files by their path inside the page.
type Files = BTreeMap<String, Vec<u8>>;

/// The program among the parts.
const PROGRAM: &str = "centrode_bg.wasm";
/// What keeps the page for when there is no network; its name stays, for browsers come back for it.
const KEEPER: &str = "offline-worker.js";
/// What makes the page an application that can be installed.
const MANIFEST: &str = "manifest.webmanifest";

/// What is built.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// The page as it is published.
    Published,
    /// The same, and beside it the page as a single file.
    WithSingle,
    /// Fast to build, large to load.
    Dev,
}

impl Which {
    /// Of a flag.
    pub fn dev(dev: bool) -> Self {
        if dev { Self::Dev } else { Self::Published }
    }
}

/// Builds the page and gives its directory.
pub fn build(which: Which) -> Result<PathBuf> {
    let dev = which == Which::Dev;
    let start = Instant::now();
    tools::wasm_target()?;
    let module = compile(dev)?;
    let parts = linked::parts()?;
    let beside = Beside::make(&parts)?;
    let mut bound = bind(&module)?;
    bound.insert(shaders::NAME.into(), shaders::module(&parts)?);
    let files = page(&root(), bound, &beside, which == Which::WithSingle)?;
    let dist = root().join("dist");
    write(&dist, &files)?;
    println!("page built in {:.1} s: dist/", start.elapsed().as_secs_f64());
    if !dev {
        transfer::check(&files)?;
    }
    Ok(dist)
}

/// Documents beside the page.
struct Beside {
    theory: theory::Made,
    /// Whose work the page is made of, HTML.
    licences: String,
    /// Everything that it is built from, CycloneDX as JSON.
    sbom: String,
}

impl Beside {
    fn make(parts: &[linked::Part]) -> Result<Self> {
        Ok(Self { theory: theory::make()?, licences: licences::page(parts)?, sbom: sbom::document(parts)? })
    }
}

/// Compiles the library as a wasm module.
fn compile(dev: bool) -> Result<PathBuf> {
    let profile = if dev { "web-dev" } else { "web" };
    // Not as crate-type in Cargo.toml: together with rlib it switches link-time optimisation off.
    run(cargo()
        .args(["rustc", "--lib", "--crate-type", "cdylib"])
        .args(["--package", "centrode", "--target", WASM])
        .args(["--no-default-features", "--features", "app"])
        .args(["--profile", profile])
        .args(["--config", &paths::setting()?])
        // They would take the place of that setting, and make another page.
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS"))?;
    Ok(target().join(WASM).join(profile).join("centrode.wasm"))
}

/// Makes the JavaScript side of the module.
fn bind(module: &Path) -> Result<Files> {
    let mut output = wasm_bindgen_cli_support::Bindgen::new()
        .input_path(module)
        .out_name("centrode")
        .web(true)?
        .typescript(false)
        .keep_debug(false)
        .remove_name_section(true)
        .generate_output()?;
    // Small JavaScript files that dependencies bring along.
    let mut files = Files::new();
    for (name, parts) in output.snippets() {
        for (i, text) in parts.iter().enumerate() {
            let path = format!("snippets/{name}/inline{i}.js");
            files.insert(path, text.as_bytes().to_vec());
        }
    }
    for (name, text) in output.local_modules() {
        files.insert(format!("snippets/{name}"), text.as_bytes().to_vec());
    }
    files.insert("centrode.js".into(), output.js().as_bytes().to_vec());
    files.insert(PROGRAM.into(), output.wasm_mut().emit_wasm());
    Ok(files)
}

/// All files of the page. What never changes under one name lies in a directory named by its content,
/// so that no browser can mix two builds.
fn page(root: &Path, mut parts: Files, beside: &Beside, with_single: bool) -> Result<Files> {
    for entry in fs::read_dir(root.join("web")).context("web/")? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.ends_with(".js") && name != KEEPER {
            parts.insert(name.into_owned(), fs::read(&path)?);
        }
    }
    for icon in ["icon.svg", "icon-180.png", "icon-192.png", "icon-512.png"] {
        parts.insert(icon.into(), fs::read(root.join("assets/icons").join(icon)).with_context(|| icon.to_owned())?);
    }
    let read = |name: &str| fs::read_to_string(root.join(name)).with_context(|| name.to_owned());
    let (html, style) = (read("index.html")?, read("web/style.css")?);
    let folder = format!("build-{:016x}", fingerprint(&parts));
    let bytes = parts[PROGRAM].len().to_string();
    let values = [
        ("BUILD", folder.as_str()),
        ("STYLE", style.trim_end()),
        ("POSTER", beside.theory.poster.trim_end()),
        ("WASM_BYTES", &bytes),
    ];
    let single = with_single.then(|| single::page(&html, &values, &parts, beside)).transpose()?;
    let index = index::secured(&index::fill(&index::beside(&html, index::From::Host)?, &values)?, index::From::Host)?;

    let mut files: Files = parts.into_iter().map(|(name, bytes)| (format!("{folder}/{name}"), bytes)).collect();
    let manifest = index::fill(&read("web/manifest.webmanifest")?, &values)?;
    files.insert(MANIFEST.into(), manifest.into_bytes());
    files.insert(theory::NAME.into(), beside.theory.html.clone().into_bytes());
    files.insert(licences::NAME.into(), beside.licences.clone().into_bytes());
    let kept = serde_json::to_string(&files.keys().collect::<Vec<_>>())?;
    let keeper = index::fill(&read(&format!("web/{KEEPER}"))?, &[("BUILD", &folder), ("FILES", &kept)])?;
    files.insert(KEEPER.into(), keeper.into_bytes());
    files.insert("index.html".into(), index.into_bytes());
    // Who looks at that has a network.
    files.insert(sbom::NAME.into(), beside.sbom.clone().into_bytes());
    files.extend(single.map(|single| (single::NAME.to_owned(), single)));
    // A host page to try the page in a frame on.
    files.insert("examples/embed.html".into(), fs::read(root.join("examples/embed.html"))?);
    Ok(files)
}

fn fingerprint(files: &Files) -> u64 {
    let mut hasher = DefaultHasher::new();
    files.hash(&mut hasher);
    hasher.finish()
}

/// Writes the files and nothing else into `dist`.
fn write(dist: &Path, files: &Files) -> Result<()> {
    if dist.exists() {
        fs::remove_dir_all(dist).context("cannot empty dist/")?;
    }
    for (name, bytes) in files {
        let path = dist.join(name);
        fs::create_dir_all(path.parent().unwrap_or(dist))?;
        fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beside() -> Beside {
        let theory = theory::Made { html: "theory".into(), poster: "<svg/>".into() };
        Beside { theory, licences: "licences".into(), sbom: "{}".into() }
    }

    fn parts() -> Files {
        Files::from([("centrode.js".into(), b"export default 1".to_vec()), ("centrode_bg.wasm".into(), vec![0; 123])])
    }

    #[test]
    fn every_reference_of_the_page_is_relative_and_exists() {
        let files = page(&root(), parts(), &beside(), false).unwrap();
        let index = String::from_utf8(files["index.html"].clone()).unwrap();
        let mut references = 0;
        for attribute in ["src=\"", "href=\""] {
            for rest in index.split(attribute).skip(1) {
                let reference = rest.split('"').next().unwrap();
                assert!(files.contains_key(reference), "{reference}");
                references += 1;
            }
        }
        assert!(references >= 5);
        let manifest = String::from_utf8(files[MANIFEST].clone()).unwrap();
        for rest in manifest.split("\"src\": \"").skip(1) {
            let reference = rest.split('"').next().unwrap();
            assert!(files.contains_key(reference), "{reference}");
        }
        assert!(!index.contains('@') || !index.contains("@BUILD@"));
        assert!(index.contains("data-wasm-bytes=\"123\""));
    }

    #[test]
    fn another_module_gets_another_address() {
        let folder = |files: &Files| files.keys().find(|name| name.starts_with("build-")).unwrap().clone();
        let one = page(&root(), parts(), &beside(), false).unwrap();
        let mut changed = parts();
        changed.insert("centrode_bg.wasm".into(), vec![1; 123]);
        let keeper = String::from_utf8(one[KEEPER].clone()).unwrap();
        assert!(
            keeper.contains(&format!("\"{}\"", folder(&one)))
                && keeper.contains("\"theory.html\"")
                && keeper.contains("\"licences.html\"")
        );
        let other = page(&root(), changed, &beside(), false).unwrap();
        assert_ne!(folder(&one), folder(&other));
        assert_eq!(folder(&one), folder(&page(&root(), parts(), &beside(), false).unwrap()));
    }
}
