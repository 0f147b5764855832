//! What the build and the tests need on a machine, installed when it is missing.

use crate::run::{output, run, target};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The target of the page.
pub const WASM: &str = "wasm32-unknown-unknown";

/// Adds the wasm target to the toolchain when it is missing.
pub fn wasm_target() -> Result<()> {
    rust_target(WASM, "the page is compiled for it")
}

/// Adds a target to the toolchain when it is missing; `why` is for the failure's message.
pub fn rust_target(name: &str, why: &str) -> Result<()> {
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    if Path::new(sysroot.trim()).join("lib/rustlib").join(name).join("lib").is_dir() {
        return Ok(());
    }
    run(Command::new("rustup").args(["target", "add", name]))
        .with_context(|| format!("rustup could not add the target {name} ({why})"))
}

/// Adds rustfmt or clippy to the toolchain when it is missing.
pub fn component(name: &str, probe: &str) -> Result<()> {
    let found = Command::new("cargo").args([probe, "--version"]).stdout(Stdio::null()).stderr(Stdio::null()).status();
    if found.is_ok_and(|status| status.success()) {
        return Ok(());
    }
    run(Command::new("rustup").args(["component", "add", name]))
        .with_context(|| format!("the tests need {name}, and rustup could not add it"))
}

/// Finds a Chromium, or installs one.
pub fn browser() -> Result<PathBuf> {
    if let Some(path) = find_browser() {
        return Ok(path);
    }
    install(&["chromium"]).context("the browser tests need Chromium or Chrome")?;
    find_browser().context("Chromium was installed, but is not to be found on the PATH")
}

fn find_browser() -> Option<PathBuf> {
    const NAMES: [&str; 5] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
    const MAC: [&str; 2] = [
        "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
        "/Applications/Chromium.app/Contents/MacOS/Chromium",
    ];
    if let Some(named) = std::env::var_os("CENTRODE_BROWSER") {
        return Some(named.into());
    }
    on_path(&NAMES).or_else(|| MAC.map(PathBuf::from).into_iter().find(|candidate| candidate.is_file()))
}

/// The first program of one of these names on the PATH.
pub fn on_path(names: &[&str]) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let candidates = |folder: PathBuf| names.iter().map(move |name| folder.join(name)).collect::<Vec<_>>();
    std::env::split_paths(&path).flat_map(candidates).find(|candidate| candidate.is_file())
}

/// Whether packages are Debian's here.
pub fn is_debian() -> bool {
    succeeds(Command::new("dpkg-query").arg("--version"))
}

/// Whether a Debian package is installed.
pub fn has_package(name: &str) -> bool {
    output(Command::new("dpkg-query").args(["--show", "--showformat=${Status}", name]))
        .is_ok_and(|status| status.ends_with(" installed"))
}

/// The script of axe-core, which finds what is wrong for assistive technology; brought by npm, for tests alone.
pub fn axe() -> Result<PathBuf> {
    let modules = npm(&["axe-core@4.10.3"]).context("the browser tests look at the page with axe-core")?;
    let script = modules.join("axe-core/axe.min.js");
    if !script.is_file() {
        bail!("npm brought axe-core without {}", script.display());
    }
    Ok(script)
}

/// Packages of npm at these versions, for tests alone: the folder of their modules. The first names the folder that they are kept in.
pub fn npm(packages: &[&str]) -> Result<PathBuf> {
    let folder = target().join("npm").join(packages[0].trim_start_matches('@').replace('/', "-"));
    let (modules, whole) = (folder.join("node_modules"), folder.join("installed"));
    if modules.is_dir() && std::fs::read_to_string(&whole).is_ok_and(|installed| installed == packages.join(" ")) {
        return Ok(modules);
    }
    if !succeeds(Command::new("npm").arg("--version")) {
        install(&["npm"])?;
    }
    std::fs::create_dir_all(&folder)?;
    let arguments =
        ["install", "--no-save", "--ignore-scripts", "--omit=optional", "--no-audit", "--no-fund", "--prefix"];
    run(Command::new("npm").args(arguments).arg(&folder).args(packages))
        .with_context(|| format!("npm could not bring {}", packages.join(", ")))?;
    std::fs::write(whole, packages.join(" "))?;
    Ok(modules)
}

/// A software Vulkan for machines without a GPU, so that wgpu draws in the headless interface tests.
pub fn software_gpu() -> Result<()> {
    // Elsewhere the system brings a driver of its own.
    if !cfg!(target_os = "linux") || has_vulkan_driver() {
        return Ok(());
    }
    install(&["mesa-vulkan-drivers"]).context("the interface tests need a Vulkan driver")
}

/// GNU parallel, by which an example of the documents is run. Without it the same lines are run by xargs, which is said.
pub fn parallel() {
    if succeeds(Command::new("parallel").arg("--version")) {
        return;
    }
    if let Err(error) = install(&["parallel"]) {
        println!("the example with GNU parallel is run by xargs: {error:#}");
    }
}

fn has_vulkan_driver() -> bool {
    ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"]
        .iter()
        .filter_map(|folder| std::fs::read_dir(folder).ok())
        .any(|mut entries| entries.next().is_some())
}

/// Installs Debian packages, as root or through sudo when that asks for no password.
pub fn install(packages: &[&str]) -> Result<()> {
    let list = packages.join(" ");
    let refusal = format!("please install: {list} (on Debian: apt-get install {list})");
    if !succeeds(Command::new("apt-get").arg("--version")) {
        bail!("{refusal}");
    }
    let prefix: &[&str] = if output(Command::new("id").arg("-u"))?.trim() == "0" {
        &[]
    } else if succeeds(Command::new("sudo").args(["-n", "true"])) {
        &["sudo", "-n"]
    } else {
        bail!("{refusal}");
    };
    println!("installing {list}");
    let apt = |arguments: &[&str]| {
        let words: Vec<&str> = prefix
            .iter()
            .chain(&["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-q"])
            .chain(arguments)
            .copied()
            .collect();
        run(Command::new(words[0]).args(&words[1..]).stdin(Stdio::null()))
    };
    let mut install = vec!["install", "-y", "--no-install-recommends"];
    install.extend(packages);
    apt(&["update"]).and_then(|()| apt(&install)).context(refusal)
}

fn succeeds(command: &mut Command) -> bool {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// The toolchain by which programs for fuzzing are instrumented.
pub const NIGHTLY: &str = "nightly";
/// The version of cargo-fuzz.
const FUZZER: &str = "0.13.2";

/// Finds cargo-fuzz and a nightly toolchain, or installs them.
pub fn fuzzer() -> Result<PathBuf> {
    if !succeeds(Command::new("rustc").arg("--version").env("RUSTUP_TOOLCHAIN", NIGHTLY)) {
        run(Command::new("rustup").args(["toolchain", "install", NIGHTLY, "--profile", "minimal"]))
            .context("fuzzing needs a nightly toolchain, and rustup could not bring it")?;
    }
    let folder = target().join("fuzz/tools");
    let tool = folder.join("bin/cargo-fuzz");
    if !tool.is_file() {
        run(Command::new("cargo")
            .args(["install", "cargo-fuzz", "--version", FUZZER, "--locked", "--root"])
            .arg(&folder)
            .env("CARGO_TARGET_DIR", folder.join("build")))
        .context("fuzzing needs cargo-fuzz, and cargo could not bring it")?;
    }
    Ok(tool)
}
