//! Every test, in stages; everything it needs is installed first.

use crate::build::{self, Which};
use crate::run::{cargo, run};
use crate::tools::{self, WASM};
use crate::{engines, foreign, package, reproduce, serve, theory};
use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Options of `cargo xtask test`.
#[derive(Args)]
pub struct Options {
    /// Stages to run [default: all but aarch64 and reproducible]
    stages: Vec<Stage>,
    /// Test the page that is fast to build instead of the published one
    #[arg(long)]
    dev: bool,
    /// Arguments for the tests themselves, such as part of a test's name
    #[arg(last = true)]
    arguments: Vec<String>,
}

/// The product with all its features. Not the whole workspace: xtask is asked for by itself, as the alias does, for its
/// dependencies would be built a second time with the product's choice of features.
const PRODUCT: [&str; 7] =
    ["--package", "centrode", "--package", "centrode-core", "--package", "centrode-theory", "--all-features"];

impl Options {
    fn wants(&self, stage: Stage) -> bool {
        self.stages.contains(&stage) || self.stages.is_empty() && !stage.is_long()
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Stage {
    /// The code is formatted
    Format,
    /// No warning from clippy, natively and for the page
    Lint,
    /// No warning from the documentation
    Doc,
    /// What neither command nor interface needs compiles without them, and the command without the interface
    Pure,
    /// Everything that runs natively: command, headless interface, the rules of the house
    Native,
    /// Everything computed has the same bits on an emulated aarch64; only when it is named, for it builds everything computed a second time
    Aarch64,
    /// What others use is packed and compiled as they get it, and with the oldest Rust that it states
    Package,
    /// The page and what lies beside it are built, no larger than they may be, and the list of their parts follows its schema
    Page,
    /// The built page in real browsers: Chromium, Firefox and WebKit
    Browser,
    /// Built in another folder, the published page is the same bytes; only when it is named, for it builds everything a second time
    Reproducible,
}

impl Stage {
    /// Whether it runs only when it is named, as before everything that is published.
    fn is_long(self) -> bool {
        matches!(self, Self::Aarch64 | Self::Reproducible)
    }
}

/// Runs the stages asked for, all of them even when one fails, and sums up.
pub fn command(options: &Options) -> Result<()> {
    let all = Stage::value_variants();
    let wanted: Vec<Stage> = all.iter().filter(|stage| options.wants(**stage)).copied().collect();
    let mut results: Vec<(Stage, Duration, Result<()>)> = Vec::new();
    let mut dist = None;
    for stage in wanted {
        println!("\n── {} ──", name(stage));
        let start = Instant::now();
        let result = perform(stage, options, &mut dist);
        let time = start.elapsed();
        match &result {
            Ok(()) => println!("── {}: ok, {:.1} s", name(stage), time.as_secs_f64()),
            Err(error) => println!("── {}: FAILED: {error:#}", name(stage)),
        }
        results.push((stage, time, result));
    }
    println!("\nstage     result     time");
    for (stage, time, result) in &results {
        let word = if result.is_ok() { "ok" } else { "FAILED" };
        println!("{:<9} {word:<6} {:>6.1} s", name(*stage), time.as_secs_f64());
    }
    let failed: Vec<String> =
        results.iter().filter(|(_, _, result)| result.is_err()).map(|(stage, ..)| name(*stage)).collect();
    if !failed.is_empty() {
        bail!("failed: {}", failed.join(", "));
    }
    Ok(())
}

fn name(stage: Stage) -> String {
    stage.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

fn perform(stage: Stage, options: &Options, dist: &mut Option<PathBuf>) -> Result<()> {
    match stage {
        Stage::Format => {
            tools::component("rustfmt", "fmt")?;
            run(cargo().args(["fmt", "--all", "--check"]))
        }
        Stage::Lint => lint(),
        Stage::Doc => doc(),
        Stage::Pure => {
            tools::component("clippy", "clippy")?;
            clippy(&["--package", "centrode", "--lib", "--no-default-features"])?;
            clippy(&["--package", "centrode", "--lib", "--bins"])
        }
        Stage::Native => {
            tools::software_gpu()?;
            tools::parallel();
            run(cargo().arg("test").args(PRODUCT).arg("--").args(&options.arguments))?;
            run(cargo().args(["test", "--package", "xtask", "--"]).args(&options.arguments))
        }
        Stage::Aarch64 => foreign::check(),
        Stage::Package => package::check(),
        Stage::Page => page(options.dev, dist).map(drop),
        Stage::Reproducible => reproduce::check(&page(false, dist)?),
        Stage::Browser => {
            let (browser, axe) = (tools::browser()?, tools::axe()?);
            engines::install()?;
            let rows = engines::rows()?;
            // Not at the root, so that an absolute address anywhere in the page shows.
            let dist = page(options.dev, dist)?;
            let page = serve::background(&dist, "/deep/path/")?;
            let tested = run(cargo()
                .arg("test")
                .args(PRODUCT)
                .args(["--test", "browser", "--"])
                .args(&options.arguments)
                .env("CENTRODE_PAGE", page)
                .env("CENTRODE_DIST", &dist)
                .env("CENTRODE_BROWSER", browser)
                .env("CENTRODE_ROWS", &rows)
                .env("CENTRODE_AXE", axe));
            tested.and(engines::table(&rows, !options.arguments.is_empty()))
        }
    }
}

/// Builds the page once.
fn page(dev: bool, dist: &mut Option<PathBuf>) -> Result<PathBuf> {
    if let Some(dist) = dist {
        return Ok(dist.clone());
    }
    let built = build::build(if dev { Which::Dev } else { Which::WithSingle })?;
    theory::check(&std::fs::read_to_string(built.join(theory::NAME))?)?;
    reproduce::names_no_place(&built)?;
    build::sbom::check(&built.join(build::sbom::NAME))?;
    Ok(dist.insert(built).clone())
}

fn lint() -> Result<()> {
    tools::component("clippy", "clippy")?;
    tools::wasm_target()?;
    clippy(&[&PRODUCT[..], &["--all-targets"]].concat())?;
    // The browser tests are no default target, and beside all of those Cargo would not look at them.
    clippy(&[&PRODUCT[..], &["--test", "browser"]].concat())?;
    clippy(&["--package", "xtask", "--all-targets"])?;
    clippy(&["--package", "centrode", "--lib", "--target", WASM, "--no-default-features", "--features", "app"])
}

fn clippy(what: &[&str]) -> Result<()> {
    run(cargo().arg("clippy").args(what).args(["--", "-D", "warnings"]))
}

fn doc() -> Result<()> {
    for what in [&PRODUCT[..], &["--package", "xtask"]] {
        run(cargo()
            .arg("doc")
            .args(what)
            .args(["--no-deps", "--document-private-items"])
            .env("RUSTDOCFLAGS", "-D warnings"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        options: Options,
    }

    #[test]
    fn stages_and_arguments_are_told_apart() {
        let line = Line::try_parse_from(["test", "native", "browser", "--", "slider"]).unwrap();
        assert_eq!(line.options.stages, [Stage::Native, Stage::Browser]);
        assert_eq!(line.options.arguments, ["slider"]);
        assert!(Line::try_parse_from(["test", "everything"]).is_err());
        // What builds everything twice is not among what runs by itself.
        assert!(!line.options.wants(Stage::Page));
        let all = Line::try_parse_from(["test"]).unwrap().options;
        assert!(all.wants(Stage::Page) && all.wants(Stage::Browser));
        assert!(!all.wants(Stage::Aarch64) && !all.wants(Stage::Reproducible));
    }
}
