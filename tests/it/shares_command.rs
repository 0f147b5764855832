//! `centrode study --shard` and `merge` as a program meets them, and the examples of `docs/STUDIES.md`.

use crate::cli::{centrode, scratch};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const STUDIES: &str = include_str!("../../docs/STUDIES.md");

/// A new folder, and the command in it.
struct Place(PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        let folder = scratch(name);
        fs::create_dir(&folder).expect("a new folder");
        Self(folder)
    }

    fn run(&self, args: &str) -> Output {
        let words = args.split(' ').filter(|word| !word.is_empty());
        let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
        command.args(words).current_dir(&self.0).output().expect("it starts")
    }

    /// What is printed by a command that succeeds.
    fn said(&self, args: &str) -> String {
        let output = self.run(args);
        assert!(output.status.success(), "{args}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// The line that a command is refused with.
    fn refused(&self, args: &str) -> String {
        let output = self.run(args);
        let line = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!((output.status.code(), line.lines().count()), (Some(2), 1), "{args}: {line}");
        assert!(output.stdout.is_empty(), "{args}");
        line
    }

    /// A shell script, in which the command is found by its name.
    fn script(&self, script: &str, variables: &[(&str, &str)]) {
        let command = Path::new(env!("CARGO_BIN_EXE_centrode")).parent().expect("a folder").to_owned();
        let path = std::env::var_os("PATH").unwrap_or_default();
        let path = std::env::join_paths(std::iter::once(command).chain(std::env::split_paths(&path))).expect("a path");
        let mut shell = Command::new("sh");
        shell.args(["-euc", script]).current_dir(&self.0).env("PATH", path).env("HOME", &self.0);
        let output = shell.envs(variables.iter().copied()).output().expect("a shell");
        assert!(output.status.success(), "{script}: {}", String::from_utf8_lossy(&output.stderr));
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).expect(name)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // Left behind by a failed test, it does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn merged_shares_print_and_write_what_the_whole_does() {
    for (k, study) in [
        "study --repeats 7 --sweep filter.length=300,600 --method or --false-alarms 0.3",
        "study --repeats 5 --detectors fcd-velocity,cusum --set loop_rate=100 --set filter.length=50 --rate 0.3",
    ]
    .iter()
    .enumerate()
    {
        let place = Place::new(&format!("shares-{k}"));
        let text = place.said(study);
        let json = place.said(&format!("{study} --json --csv whole.csv --svg whole.svg"));
        (1..=3).for_each(|share| {
            assert_eq!(place.said(&format!("{study} --shard {share}/3 --out part-{share}.json")), "");
        });
        let parts = "study merge part-2.json part-3.json part-2.json part-1.json";
        assert_eq!(place.said(parts), text);
        assert_eq!(place.said(&format!("{parts} --json --csv merged.csv --svg merged.svg")), json);
        for kind in ["csv", "svg"] {
            let [merged, whole] = ["merged", "whole"].map(|name| place.read(&format!("{name}.{kind}")));
            assert!(merged == whole && !whole.is_empty(), "{kind}");
        }
        // Another wish costs no run.
        let (flag, other) = if k == 0 { ("--false-alarms", "--rate") } else { ("--rate", "--false-alarms") };
        let wished = format!("{flag} 0.6");
        let study = study.replace(&format!("{flag} 0.3"), &wished);
        assert_eq!(place.said(&format!("{parts} {wished}")), place.said(&study));
        assert!(place.refused(&format!("{parts} {other} 0.6")).contains(other));
    }
}

#[test]
fn what_does_not_belong_together_is_refused_by_name() {
    let place = Place::new("refused-shares");
    let study = "study --repeats 2 --set loop_rate=100 --set filter.length=50";
    for (more, name) in [("", "one.json"), ("--set seed=9", "seed.json")] {
        place.said(&format!("{study} {more} --shard 1/2 --out {name}"));
    }
    fs::write(place.0.join("notes.json"), "{}").expect("written");
    let one = String::from_utf8(place.read("one.json")).expect("text");
    fs::write(place.0.join("cut.json"), &one[..one.len() / 2]).expect("written");
    for (args, part) in [
        ("study merge", "<PART.json>"),
        ("study merge one.json", "share 2/2 is missing"),
        ("study merge one.json seed.json", "seed.json is a share of another study than one.json: seed = 9, not 1"),
        ("study merge one.json notes.json", "notes.json is not a share of a study"),
        ("study merge one.json cut.json", "cut.json is damaged"),
        ("study merge one.json part-*.json", "cannot read part-*.json"),
        ("study --shard 1/2", "--out"),
        ("study --out x.json", "--shard"),
        ("study --shard 3/2 --out x.json", "\"3/2\" is not a share"),
        ("study --shard 1/2 --out x.json --json", "centrode study merge"),
        ("study --shard 1/2 --out no-such-folder/x.json", "no-such-folder"),
        ("map --shard 1/2", "only `centrode study` is made in shares"),
        ("table2 --shard 1/2 --out x.json", "only `centrode study` is made in shares"),
    ] {
        let line = place.refused(args);
        assert!(line.contains(part), "{args}: {line}");
    }
    assert!(!place.0.join("x.json").exists());
}

#[test]
fn an_interrupted_share_leaves_no_file() {
    let place = Place::new("interrupted-share");
    let args = ["study", "--repeats", "1000000", "--shard", "1/2", "--out", "part.json"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    let piped = std::process::Stdio::piped;
    let child = command.args(args).current_dir(&place.0).stdout(piped()).stderr(piped()).spawn().expect("it starts");
    let output = crate::files::interrupted(child, &place.0, "-INT", std::time::Duration::ZERO);
    assert_eq!(output.status.code(), Some(130));
    assert!(String::from_utf8_lossy(&output.stderr).contains("interrupted"));
    assert_eq!(fs::read_dir(&place.0).expect("a folder").count(), 0);
}

/// The shell scripts of the document that hold a word.
fn scripts(word: &str) -> Vec<&'static str> {
    let blocks = STUDIES.split("```sh\n").skip(1).filter_map(|block| block.split_once("```"));
    blocks.map(|(script, _)| script).filter(|script| script.contains(word)).collect()
}

#[test]
fn the_example_with_gnu_parallel_gives_the_whole() {
    let script = *scripts("| parallel centrode").first().expect("an example");
    let found = Command::new("parallel").arg("--version").output();
    let is_gnu = found.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).starts_with("GNU parallel"));
    // Who has no GNU parallel runs the same lines by xargs.
    let script = if is_gnu { script.to_owned() } else { script.replace("| parallel ", "| xargs -P 2 -I '{}' ") };
    println!("run by {}", if is_gnu { "GNU parallel" } else { "xargs, for there is no GNU parallel" });
    assert!(is_gnu || script.contains("xargs"), "{script}");
    let place = Place::new("parallel");
    place.script(&script, &[]);
    let line = script.lines().find(|line| line.contains("--shard")).expect("a share");
    let (_, study) = line.split_once("centrode ").expect("a study");
    let (study, _) = study.split_once(" --shard").expect("a share");
    let whole = centrode(&format!("{study} --json").split(' ').collect::<Vec<_>>());
    assert!(whole.status.success());
    assert!(place.read("study.json") == whole.stdout);
}

#[test]
fn the_example_with_slurm_makes_every_share() {
    let script = *scripts("#SBATCH").first().expect("an example");
    // As many shares and repeats as a test can make.
    let script = script.replace("--repeats 100000", "--repeats 3").replace("/64\"", "/2\"");
    let place = Place::new("slurm");
    for task in ["1", "2"] {
        place.script(&script, &[("SLURM_ARRAY_TASK_ID", task), ("SLURM_CPUS_PER_TASK", "1")]);
    }
    let merged = place.said("study merge part-1.json part-2.json");
    assert!(merged.starts_with("3 runs without and as many with contact"), "{merged}");
}
