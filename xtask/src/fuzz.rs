//! Fuzzing: what is read, and whole experiments, on what libFuzzer thinks of. It needs nightly and cargo-fuzz, which are installed.

use crate::run::{root, target};
use crate::tools;
use anyhow::{Context, Result, bail};
use clap::Args;
use std::path::Path;
use std::process::Command;

/// Options of `cargo xtask fuzz`.
#[derive(Args)]
pub struct Options {
    /// Targets, one folder of fuzz/corpus/ each [default: all]
    targets: Vec<String>,
    /// How long each target runs
    #[arg(long, default_value_t = 1.0, value_name = "N", value_parser = minutes)]
    minutes: f64,
    /// Stop a target after so many executions, even if time is left
    #[arg(long, value_name = "N")]
    executions: Option<u64>,
    /// Bytes of the longest input: long ones take longer
    #[arg(long, default_value_t = 4096, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    longest: u32,
}

/// What came of a target.
struct Outcome {
    target: String,
    executions: u64,
    per_second: u64,
    holds: bool,
}

fn minutes(text: &str) -> Result<f64, String> {
    let minutes: f64 = text.parse().map_err(|_| "a number of minutes".to_owned())?;
    // libFuzzer takes 0 for no limit.
    if (1.0 / 60.0..=10_080.0).contains(&minutes) { Ok(minutes) } else { Err("from a second to a week".into()) }
}

/// Runs the targets one after the other and sums up.
pub fn command(options: &Options) -> Result<()> {
    let known = targets()?;
    if let Some(unknown) = options.targets.iter().find(|name| !known.contains(name)) {
        bail!("there is no target {unknown:?}; known: {}", known.join(", "));
    }
    let tool = tools::fuzzer()?;
    let wanted = if options.targets.is_empty() { &known } else { &options.targets };
    let outcomes: Vec<_> = wanted.iter().map(|name| fuzz(&tool, name, options)).collect::<Result<_>>()?;
    println!("\ntarget      executions  per second  result");
    for Outcome { target, executions, per_second, holds } in &outcomes {
        println!("{target:<10} {executions:>11} {per_second:>11}  {}", if *holds { "ok" } else { "FAILED" });
    }
    let failed: Vec<_> = outcomes.iter().filter(|outcome| !outcome.holds).map(|outcome| &*outcome.target).collect();
    if !failed.is_empty() {
        bail!("failed: {}; what they failed at lies in fuzz/artifacts/", failed.join(", "));
    }
    Ok(())
}

/// The targets, by the manifest.
fn targets() -> Result<Vec<String>> {
    let manifest: toml::Table = std::fs::read_to_string(root().join("fuzz/Cargo.toml"))?.parse()?;
    let list = manifest.get("bin").and_then(toml::Value::as_array).context("fuzz/Cargo.toml has no [[bin]]")?;
    Ok(list.iter().filter_map(|bin| bin.get("name")?.as_str().map(str::to_owned)).collect())
}

fn fuzz(tool: &Path, name: &str, options: &Options) -> Result<Outcome> {
    println!("\n── {name} ──");
    // What is found is kept beside what is built: the corpus in the repository grows by hand.
    let found = target().join("fuzz/corpus").join(name);
    std::fs::create_dir_all(&found)?;
    let log = target().join("fuzz").join(format!("{name}.log"));
    let seconds = (options.minutes * 60.0).ceil();
    let mut command = fuzzer(tool, name);
    command.arg(&found).arg(root().join("fuzz/corpus").join(name)).arg("--");
    command.args([&format!("-max_total_time={seconds}"), "-print_final_stats=1", "-timeout=60"]);
    command.arg(format!("-max_len={}", options.longest));
    command.args(options.executions.map(|most| format!("-runs={most}")));
    let file = std::fs::File::create(&log)?;
    let status = command.stdout(file.try_clone()?).stderr(file).status().context("cannot run cargo-fuzz")?;
    let text = String::from_utf8_lossy(&std::fs::read(&log)?).into_owned();
    let stat = |what: &str| {
        let line = text.lines().rev().find_map(|line| line.strip_prefix("stat::")?.strip_prefix(what));
        line.and_then(|rest| rest.trim_start_matches(':').trim().parse().ok())
    };
    let executions = stat("number_of_executed_units");
    if !status.success() || executions.is_none() {
        let last: Vec<_> = text.lines().rev().take(40).collect();
        last.iter().rev().for_each(|line| println!("{line}"));
    }
    let executions = executions.unwrap_or(0);
    let per_second = stat("average_exec_per_sec").unwrap_or(0);
    println!("{name}: {executions} executions, {per_second} a second");
    Ok(Outcome { target: name.to_owned(), executions, per_second, holds: status.success() && executions > 0 })
}

/// `cargo fuzz run`, without a sanitizer: no line of ours is unsafe, and checks of arithmetic and of assertions are on.
/// Numbers are compared everywhere: to follow each comparison takes half of the time.
fn fuzzer(tool: &Path, name: &str) -> Command {
    let mut command = Command::new(tool);
    command.current_dir(root()).args(["run", "--sanitizer", "none", "--no-trace-compares", "--target-dir"]);
    command.arg(target().join("fuzz/build")).arg(name).env("RUSTUP_TOOLCHAIN", tools::NIGHTLY);
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_target_has_a_program_and_inputs() {
        let targets = targets().unwrap();
        assert!(targets.len() > 10, "{targets:?}");
        for name in targets {
            assert!(root().join("fuzz/fuzz_targets").join(&name).with_extension("rs").is_file(), "{name}");
            assert!(std::fs::read_dir(root().join("fuzz/corpus").join(&name)).unwrap().next().is_some(), "{name}");
        }
    }

    #[test]
    fn minutes_are_limited() {
        assert_eq!(minutes("0.5"), Ok(0.5));
        for wrong in ["0", "-1", "nan", "inf", "soon"] {
            assert!(minutes(wrong).is_err(), "{wrong}");
        }
    }
}
