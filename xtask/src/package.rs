//! The packages that others use: packed and compiled as they get them, and with the oldest Rust that they state.

use crate::metadata::{Edges, Metadata, Package, numbers};
use crate::run::{cargo, output, run, target};
use anyhow::{Context as _, Result, bail};
use std::path::{MAIN_SEPARATOR, PathBuf};
use std::process::Command;
use std::{env, fs};

/// Those that others use.
const USED: [&str; 2] = ["centrode-core", "centrode"];

/// Packed, they compile to be looked at, not to be run.
const FAST: [&str; 2] = ["profile.dev.opt-level=0", "profile.dev.package.centrode-core.opt-level=0"];

/// Packs them, and compiles what was packed.
pub fn check() -> Result<()> {
    // All that is fetched is what the lock file names; packing fetches nothing.
    run(cargo().args(["fetch", "--locked", "--quiet"]))?;
    let packages = USED.iter().flat_map(|name| ["--package", name]);
    let fast = FAST.iter().flat_map(|setting| ["--config", setting]);
    let metadata = Metadata::read(&[])?;
    forget(&metadata)?;
    run(cargo().args(["package", "--locked", "--offline", "--allow-dirty"]).args(packages).args(fast))?;
    USED.iter().try_for_each(|name| oldest(&metadata, metadata.ours(name)?))
}

/// Removes what earlier runs unpacked and compiled. Cargo knows it by name and version alone, and would compile the package above with an old
/// one below it.
fn forget(metadata: &Metadata) -> Result<()> {
    forget_compiled()?;
    let own = || env::home_dir().map(|home| home.join(".cargo"));
    let Some(home) = env::var_os("CARGO_HOME").map(PathBuf::from).or_else(own) else { return Ok(()) };
    let Ok(registries) = fs::read_dir(home.join("registry").join("src")) else { return Ok(()) };
    // One on this machine has no host in its name.
    let local = registries.flatten().filter(|registry| registry.file_name().to_string_lossy().starts_with('-'));
    for registry in local {
        for name in USED {
            let old = registry.path().join(format!("{name}-{}", metadata.ours(name)?.version));
            if old.is_dir() {
                fs::remove_dir_all(&old).with_context(|| format!("cannot remove {}", old.display()))?;
            }
        }
    }
    Ok(())
}

/// Removes what tells cargo that a package was compiled, where it was one that a run had unpacked.
fn forget_compiled() -> Result<()> {
    let debug = target().join("debug");
    let (Ok(known), Ok(files)) = (fs::read_dir(debug.join(".fingerprint")), fs::read_dir(debug.join("deps"))) else {
        return Ok(());
    };
    let is_unpacked =
        |file: &PathBuf| fs::read_to_string(file).is_ok_and(|text| text.contains(&format!("src{MAIN_SEPARATOR}-")));
    let lists = files.flatten().map(|file| file.path()).filter(|file| file.extension().is_some_and(|end| end == "d"));
    let ours = lists.filter(|file| file.file_name().is_some_and(|name| name.to_string_lossy().starts_with("centrode")));
    let unpacked: Vec<String> = ours
        .filter(is_unpacked)
        .filter_map(|file| Some(file.file_stem()?.to_str()?.rsplit_once('-')?.1.to_owned()))
        .collect();
    for one in known.flatten() {
        let name = one.file_name().to_string_lossy().into_owned();
        if name.rsplit_once('-').is_some_and(|(_, hash)| unpacked.iter().any(|of| of == hash)) {
            fs::remove_dir_all(one.path()).with_context(|| format!("cannot remove {}", one.path().display()))?;
        }
    }
    Ok(())
}

/// Compiles a package with the oldest Rust that it states, or says why not and what was looked at instead.
fn oldest(metadata: &Metadata, package: &Package) -> Result<()> {
    let (name, stated) = (&package.name, stated(package)?);
    let newer = newer(metadata, package)?;
    if !newer.is_empty() {
        bail!("{name} states Rust {stated}, but {} ask for a newer one", newer.join(", "));
    }
    if numbers(&this()?).starts_with(&numbers(stated)) {
        println!("{name}: Rust {stated} is the one at work, by which all of it is compiled");
        return Ok(());
    }
    let installed = Command::new("rustup")
        .args(["toolchain", "install", stated, "--profile", "minimal", "--no-self-update"])
        .status()
        .is_ok_and(|status| status.success());
    if !installed {
        println!(
            "{name}: NOT compiled with Rust {stated}, which rustup could not install; none of its dependencies asks for a newer one"
        );
        return Ok(());
    }
    // Ours is started anew, as the other toolchain's own.
    run(Command::new("rustup")
        .args(["run", stated, "cargo", "check", "--locked", "--package", name])
        .current_dir(crate::run::root())
        .env("CARGO_TARGET_DIR", target().join("oldest"))
        .env_remove("RUSTUP_TOOLCHAIN")
        .env_remove("CARGO")
        .env_remove("RUSTC"))?;
    println!("{name}: compiled with Rust {stated}");
    Ok(())
}

fn stated(package: &Package) -> Result<&str> {
    match &package.rust_version {
        Some(version) => Ok(version),
        None => bail!("{} states no Rust", package.name),
    }
}

/// What a package is built from that asks for a newer Rust than it states.
fn newer(metadata: &Metadata, package: &Package) -> Result<Vec<String>> {
    let least = numbers(stated(package)?);
    let asks = |part: &&Package| part.rust_version.as_deref().is_some_and(|version| short(numbers(version)) > least);
    let parts = metadata.closure(&package.name, Edges::Build)?;
    Ok(parts.into_iter().filter(asks).map(|part| format!("{} {}", part.name, part.version)).collect())
}

/// Without zeros at its end: 1.89.0 is 1.89.
fn short(mut version: Vec<u64>) -> Vec<u64> {
    while version.len() > 2 && version.last() == Some(&0) {
        version.pop();
    }
    version
}

/// The version of the Rust at work.
fn this() -> Result<String> {
    let told = output(Command::new("rustc").arg("--version"))?;
    Ok(told.split(' ').nth(1).unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::root;
    use std::fs;

    #[test]
    fn no_dependency_asks_for_a_newer_rust_than_a_package_states() {
        let metadata = Metadata::read(&[]).unwrap();
        for name in USED {
            assert_eq!(newer(&metadata, metadata.ours(name).unwrap()).unwrap(), Vec::<String>::new(), "{name}");
        }
        // And one that asked for more would be found.
        let modest = Package { rust_version: Some("1.60".into()), ..metadata.ours("centrode-core").unwrap().clone() };
        assert!(newer(&metadata, &modest).unwrap().iter().any(|part| part.starts_with("nalgebra ")));
        assert_eq!(short(vec![1, 89, 0]), [1, 89]);
    }

    #[test]
    fn each_has_a_readme_a_licence_and_its_version_in_a_changelog() {
        let metadata = Metadata::read(&[]).unwrap();
        for name in USED {
            let package = metadata.ours(name).unwrap();
            assert_eq!(package.licence.as_deref(), Some("MIT OR Apache-2.0"));
            let read = |file: &str| fs::read_to_string(package.folder.join(file)).unwrap();
            for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
                assert_eq!(read(licence), fs::read_to_string(root().join(licence)).unwrap());
            }
            let version = format!("\n## [{}]", package.version);
            assert!(read("CHANGELOG.md").contains(&version), "{name}: CHANGELOG.md has no{version}");
            assert!(read("README.md").starts_with("# "));
        }
        let stated = metadata.ours("centrode-core").unwrap().rust_version.clone().unwrap();
        let readme = fs::read_to_string(root().join("core/README.md")).unwrap();
        assert!(readme.contains(&format!("Rust {stated} or newer")), "the README states another Rust than {stated}");
    }
}
