//! `centrode study` as a program meets it.

use crate::cli::{centrode, json, scratch};
use centrode_core::scenario::preset::find;
use centrode_core::study::Job;
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Spec, Study};
use serde_json::Value;
use std::process::{Command, Stdio};

fn library(repeats: usize, cells: &[&[&str]]) -> Study {
    let scenario = find("bench").and_then(|preset| preset.scenario()).expect("bench");
    let cells = cells.iter().map(|cell| cell.iter().map(|set| set.parse().expect(set)).collect()).collect();
    let mut study = Study::new(Spec { cells, ..Spec::of(scenario, repeats) }).expect("a study");
    study.finish();
    study
}

#[test]
fn json_holds_the_library_s_study() {
    let ours = json(&["study", "--repeats", "9", "--json", "--sweep", "filter.length=300,600"]);
    let theirs = library(9, &[&["filter.length=300"], &["filter.length=600"]]);
    assert_eq!(ours["partial"], false);
    for cell in 0..2 {
        for &rule in Rule::ALL {
            let point = theirs.own(cell, rule).map(|level| theirs.point(cell, rule, level));
            let expected = serde_json::to_value(point).expect("JSON");
            assert_eq!(ours["cells"][cell]["own"][rule.name()], expected, "{cell} {rule:?}");
            let curve = ours["cells"][cell]["curves"][rule.name()].as_array().expect("a curve").clone();
            let full = serde_json::to_value(theirs.curve(cell, rule)).expect("JSON");
            let full = full.as_array().expect("a list");
            // What is left out lies between two points that say the same.
            assert!(curve.len() < full.len() && curve.iter().all(|point| full.contains(point)), "{rule:?}");
            assert_eq!((curve.first(), curve.last()), (full.first(), full.last()));
        }
        assert_eq!(ours["cells"][cell]["contact_time"].as_f64(), theirs.contact_time(cell));
    }
    assert_eq!(ours["recommendation"]["verdict"], "too-few-runs");
    // Where a contact is cannot be tuned.
    let places = json(&["study", "--repeats", "3", "--json", "--sweep", "contact.disk=2,3", "--false-alarms", "0.7"]);
    assert!(places["recommendation"].is_null());
    assert_eq!(places["cells"][1]["advised"]["verdict"], "take");
}

#[test]
fn threads_change_no_byte_and_a_pipe_gets_no_progress_bar() {
    let run = |threads: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
        command.args(["study", "--repeats", "30", "--json", "--sweep", "contact.disk=1:3:3"]);
        command.env("RAYON_NUM_THREADS", threads).output().expect("it starts")
    };
    let (one, three) = (run("1"), run("3"));
    assert!(one.status.success() && one.stderr.is_empty(), "{}", String::from_utf8_lossy(&one.stderr));
    assert_eq!(one.stdout, three.stdout);
}

#[test]
fn csv_has_every_threshold_and_the_drawing_its_curves() {
    let (table, drawing) = (scratch("study.csv"), scratch("study.svg"));
    let (table_name, drawing_name) = (table.to_str().expect("path"), drawing.to_str().expect("path"));
    let sweeps = ["--sweep", "detection.xi2=0.004,0.002:x", "--sweep", "filter.length=400:800:3"];
    let refused = centrode(&[&["study"][..], &sweeps].concat());
    assert_eq!(refused.status.code(), Some(2));
    let args = ["study", "--repeats", "20", "--false-alarms", "0.5", "--csv", table_name, "--svg", drawing_name];
    let sweeps = ["--sweep", "detection.xi2=0.004,0.002", "--sweep", "filter.length=400:800:3"];
    let done = centrode(&[&args[..], &sweeps].concat());
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let [text, svg] = [&table, &drawing].map(|path| std::fs::read_to_string(path).expect("a file"));
    [&table, &drawing].into_iter().for_each(|path| std::fs::remove_file(path).expect("removed"));
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..3], ["filter.length", "method", "threshold [SI]"]);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    let levels = |length: &str, rule: &str| {
        let of = |row: &&Vec<&str>| row[0] == length && row[1] == rule;
        rows.iter().filter(of).map(|row| row[2].parse().expect("a number")).collect::<Vec<f64>>()
    };
    // Those that were asked for, and the scenario's own.
    assert_eq!(levels("600", "fcd"), [0.002, 0.004, 0.007]);
    assert!(levels("800", "jfd").len() > 100);
    assert!(svg.contains("</svg>") && svg.contains("20 repeats") && svg.contains("filter.length=600"));
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(said.contains("advice") && said.contains("soonest with at most 50 % false alarms"), "{said}");
}

#[test]
fn without_contact_there_is_nothing_to_advise() {
    let ours = json(&["study", "--repeats", "5", "--json", "--preset", "free"]);
    assert!(ours["cells"][0]["runs_contact"].is_null() && ours["cells"][0]["own"]["fcd"]["detection"].is_null());
    assert_eq!(ours["recommendation"]["verdict"], "no-contact");
    let said = centrode(&["study", "--repeats", "5", "--preset", "free"]);
    assert!(String::from_utf8_lossy(&said.stdout).contains("none: there is no contact to detect"));
}

#[test]
fn bad_input_is_one_line_and_writes_nothing() {
    let path = scratch("refused-study.csv");
    let name = path.to_str().expect("path");
    for (args, part) in [
        (&["--repeats", "0"][..], "repeats = 0"),
        (&["--repeats", "x"], "--repeats"),
        (&["--late", "nan"], "late = NaN"),
        (&["--late=-1"], "late = -1"),
        (&["--false-alarms", "0"], "--false-alarms 0"),
        (&["--false-alarms", "1"], "above 0 and below 1"),
        (&["--sweep", "filter.length"], "is not a sweep"),
        (&["--sweep", "filter.length=1:2:x"], "--sweep filter.length=1:2:x"),
        (&["--sweep", "filter.length=0:10:3"], "filter.length = 0"),
        (&["--sweep", "filter.lenght=1,2"], "filter.lenght"),
        (&["--sweep", "seed=1,2", "--sweep", "seed=3"], "seed is swept twice"),
        (&["--sweep", "seed=1:9999:9999", "--sweep", "filter.length=1:9:9"], "more than 10000"),
        (&["--sweep", "detection.xi2=off,0.1"], "detection.xi2 = off"),
        (&["--sweep", "detection.xi1_factor=1,2"], "sweep detection.xi1"),
        (&["--method", "both"], "--method"),
        (&["--svg", "a.gif"], "--svg a.gif"),
        (&["--svg", "a.csv"], "--svg a.csv"),
        (&["--svg", "no-such-folder/a.svg"], "no-such-folder"),
    ] {
        let output = centrode(&[&["study", "--csv", name][..], args].concat());
        let line = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {line}");
        assert!(line.contains(part) && line.trim_end().lines().count() == 1, "{args:?}: {line}");
        assert!(output.stdout.is_empty() && !path.exists(), "{args:?}");
    }
    // Nor a part of a file.
    let folder = path.parent().expect("a folder");
    let left = std::fs::read_dir(folder).expect("a folder").flatten();
    let parts = left.filter(|file| file.file_name().to_string_lossy().starts_with("refused-study.csv"));
    assert_eq!(parts.count(), 0);
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_what_is_finished_and_says_that_it_is_partial() {
    use std::time::Duration;
    let folder = scratch("interrupted-study");
    std::fs::create_dir(&folder).expect("a new folder");
    // On a machine with much to do the first run takes its time.
    let waits = [0.5, 2.0, 10.0, 60.0].map(Duration::from_secs_f64);
    let (output, report, runs) = waits
        .into_iter()
        .find_map(|wait| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
            command.args(["study", "--json", "--repeats", "1000000", "--csv", "x.csv"]).current_dir(&folder);
            let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
            let output = crate::files::interrupted(child, &folder, "-INT", wait);
            let report: Value = serde_json::from_slice(&output.stdout).ok()?;
            let runs = report["cells"][0]["runs_free"].as_u64().filter(|&runs| runs > 0)?;
            Some((output, report, runs))
        })
        .expect("some runs are made before the interrupt");
    let line = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{line}");
    assert!(line.contains("interrupted after") && line.lines().count() == 1, "{line}");
    assert_eq!(report["partial"], true);
    assert!(runs < 1_000_000, "{runs}");
    let text = std::fs::read_to_string(folder.join("x.csv")).expect("a file");
    assert!(text.lines().nth(1).is_some_and(|row| row.ends_with("true")) && text.contains(&format!(",{runs},")));
    assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), 1, "a part of a file is left");
    std::fs::remove_dir_all(&folder).expect("removed");
}
