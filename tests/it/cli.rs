//! The headless command as a program meets it.

use serde_json::Value;
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

pub fn centrode(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_centrode")).args(args).output().expect("the command starts")
}

pub fn json(args: &[&str]) -> Value {
    let output = centrode(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A path that no other test uses.
pub fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("centrode-{}-{name}", std::process::id()))
}

fn close(ours: &Value, reference: &Value, tolerance: f64, what: &str) {
    match (ours, reference) {
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len(), "{what}");
            a.iter().zip(b).for_each(|(a, b)| close(a, b, tolerance, what));
        }
        _ => {
            let (a, b) = (ours.as_f64().expect(what), reference.as_f64().expect(what));
            assert!((a - b).abs() <= tolerance, "{what}: {a:e} against {b:e}");
        }
    }
}

#[test]
fn model_prints_the_reference() {
    let rows: Vec<Value> = serde_json::from_str(include_str!("../data/golden.json")).expect("reference data");
    for row in &rows {
        let text = |key: &str| row[key].to_string();
        let rate = format!("{},{}", row["rate"][0], row["rate"][1]);
        let ours = json(&[
            "model",
            "--json",
            "--theta-l",
            &text("theta_l"),
            "--delta",
            &text("delta"),
            "--s",
            &text("s"),
            "--contact",
            &text("s_c"),
            "--rate",
            &rate,
            "--length",
            &text("length"),
            "--pitch-radius",
            &text("pitch_radius"),
            "--ep-ip",
            &text("ep_ip"),
            "--es-is",
            &text("es_is"),
        ]);
        for (key, reference) in row.as_object().expect("an object") {
            // Inputs come back as given; what depends on scale is compared in the golden test of the library.
            close(&ours[key], reference, 1e-12, key);
        }
    }
}

#[test]
fn model_prints_a_table_without_json() {
    let output = centrode(&["model", "--theta-l", "0.5"]);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(output.status.success());
    for word in ["position(s)", "constrained centrode", "energy_gradient", "mm"] {
        assert!(text.contains(word), "{text}");
    }
}

#[test]
fn run_reports_the_known_answers() {
    let quiet = json(&["run", "--json"]);
    let detection = &quiet["detection"];
    assert!((detection["time"].as_f64().expect("time") - 6.279).abs() <= 0.003, "{detection}");
    assert_eq!(quiet["crossings"][0]["method"], "jfd");
    let fcd = &quiet["crossings"][1];
    assert_eq!((&fcd["method"], &fcd["time"], &fcd["threshold"]), (&"fcd".into(), &detection["time"], &0.007.into()));
    assert!(fcd["value"].as_f64() > Some(0.007));

    let third = json(&["run", "--json", "--set", "contact.disk=3", "--set", "contact.time=5.3"]);
    assert!((third["detection"]["time"].as_f64().expect("time") - 5.610).abs() <= 0.003);
    let free = json(&["run", "--json", "--set", "contact.disk=0"]);
    assert_eq!((&free["detection"], &free["contact"]), (&Value::Null, &Value::Null));
}

#[test]
fn run_takes_a_file_a_preset_and_overrides() {
    let path = scratch("scenario.toml");
    std::fs::write(&path, "seed = 5\n[contact]\ndisk = 3\ntime = 5.3\n").expect("written");
    let from_file = json(&["run", path.to_str().expect("path"), "--json", "--set", "contact.arc_length=0.02"]);
    std::fs::remove_file(&path).expect("removed");
    assert_eq!(from_file["scenario"]["seed"], 5);
    assert_eq!(from_file["contact"]["arc_length"], 0.02);
    let preset = json(&["run", "--preset", "disk-3", "--json"]);
    assert_eq!(preset["scenario"]["contact"]["disk"], 3);
}

#[test]
fn the_printed_scenario_can_be_run() {
    let output = centrode(&["scenario"]);
    let path = scratch("printed.toml");
    std::fs::write(&path, &output.stdout).expect("written");
    let ours = json(&["run", path.to_str().expect("path"), "--json"]);
    std::fs::remove_file(&path).expect("removed");
    assert_eq!(ours, json(&["run", "--json"]));
    let presets = String::from_utf8(centrode(&["presets"]).stdout).expect("UTF-8");
    assert!(presets.lines().count() > 5 && presets.starts_with("bench "), "{presets}");
}

#[test]
fn csv_holds_every_channel_at_loop_rate() {
    let path = scratch("run.csv");
    let output = centrode(&["run", "--csv", path.to_str().expect("path")]);
    assert!(output.status.success());
    let text = std::fs::read_to_string(&path).expect("a file");
    std::fs::remove_file(&path).expect("removed");
    let mut lines = text.lines();
    let header: Vec<_> = lines.next().expect("header").split(',').collect();
    assert!(header.contains(&"time [s]") && header.contains(&"deviation [m]") && header.contains(&"residual [N·m]"));
    let rows: Vec<Vec<_>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 10_001);
    assert!(rows.iter().all(|row| row.len() == header.len()));
    let column = |name: &str| header.iter().position(|title| *title == name).expect(name);
    assert_eq!(rows[0][column("deviation [m]")], "", "undefined at rest, not 0");
    let peak = rows[5000..7901]
        .iter()
        .map(|row| row[column("deviation [m]")].parse::<f64>().expect("a number"))
        .fold(0.0, f64::max);
    assert!(peak > 0.007);
}

#[test]
fn bad_input_is_one_line_and_exit_code_2() {
    let binary = scratch("binary.toml");
    std::fs::write(&binary, b"seed = 1\n\xff\xfe").expect("written");
    let broken = scratch("broken.toml");
    std::fs::write(&broken, "seed = 1\n[contact\n").expect("written");
    let folder = std::env::temp_dir();
    let (binary_path, broken_path) = (binary.to_str().expect("path"), broken.to_str().expect("path"));
    for (args, parts) in [
        (&["run", "--set", "contact.disk=9"][..], &["contact.disk", "9", "1 to 3"][..]),
        (&["run", "--set", "filter.length=0.5"], &["filter.length", "0.5", "whole"]),
        (&["run", "--set", "robot.length=-1"], &["robot.length", "-1"]),
        (&["run", "--set", "nonsense"], &["nonsense", "key=value"]),
        (&["run", "--set", "no.such.key=1"], &["no", "known"]),
        (&["run", "--preset", "no-such"], &["no-such", "bench"]),
        (&["run", "no-such-file.toml"], &["no-such-file.toml"]),
        (&["run", folder.to_str().expect("path")], &["cannot read"]),
        (&["run", binary_path], &[binary_path, "UTF-8"]),
        (&["run", broken_path], &[broken_path, "line 2"]),
        (&["run", "--csv", "no-such-folder/run.csv"], &["no-such-folder/run.csv"]),
        (&["run", "--bogus"], &["--bogus"]),
        (&["model", "--theta-l", "nan"], &["--theta-l", "finite"]),
        (&["model", "--theta-l", "1", "--s", "0.04"], &["--s", "0.04", "0.03"]),
        (&["model", "--theta-l", "1", "--rate", "1"], &["--rate", "comma"]),
        (&["model", "--theta-l", "1", "--length", "-2"], &["--length", "-2"]),
        (&["model"], &["--theta-l"]),
        (&["dance"], &["dance"]),
        (&[], &["model, run, figure, table2, map"]),
    ] {
        let output = centrode(args);
        let message = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{args:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{args:?}: {message}");
        assert!(output.stdout.is_empty(), "{args:?}");
        for part in parts {
            assert!(message.contains(part), "{args:?}: {message:?} lacks {part:?}");
        }
    }
    std::fs::remove_file(&binary).expect("removed");
    std::fs::remove_file(&broken).expect("removed");
}

#[test]
fn a_refused_run_leaves_an_existing_csv_alone() {
    let path = scratch("kept.csv");
    std::fs::write(&path, "precious").expect("written");
    let name = path.to_str().expect("path");
    assert_eq!(centrode(&["run", "--set", "seed=-1", "--csv", name]).status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(&path).expect("kept"), "precious");
    std::fs::remove_file(&path).expect("removed");
}

#[test]
fn a_closed_pipe_ends_quietly() {
    for args in [&["run", "--json"][..], &["scenario"], &["run", "--csv", "/dev/stdout"]] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_centrode"))
            .args(args)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let mut line = String::new();
        let mut stdout = BufReader::with_capacity(16, child.stdout.take().expect("piped"));
        stdout.read_line(&mut line).expect("a line");
        drop(stdout);
        let mut message = String::new();
        child.stderr.take().expect("piped").read_to_string(&mut message).expect("UTF-8");
        let status = child.wait().expect("ended");
        assert!(status.success() && message.is_empty(), "{args:?}: {status}: {message}");
    }
}

#[test]
fn run_lists_the_events_that_a_reader_wants() {
    let report = json(&["run", "--preset", "bench", "--json"]);
    let events = report["events"].as_array().expect("events");
    let of = |detector: &str| events.iter().filter(|event| event["detector"] == detector).collect::<Vec<_>>();
    let ([centrode], [forces]) = (&of("fcd")[..], &of("jfd")[..]) else { panic!("{events:?}") };
    let keys: Vec<&String> = centrode.as_object().expect("an object").keys().collect();
    assert_eq!(keys, ["cleared", "detector", "raised", "theta_l", "threshold", "value"]);
    assert!((centrode["raised"].as_f64().expect("s") - 6.26).abs() < 1e-9 && centrode["threshold"] == 0.007);
    assert_eq!(centrode["raised"], report["detection"]["time"]);
    assert!(forces["raised"].as_f64() < centrode["raised"].as_f64() && forces["cleared"].is_null());
    assert!(report["crossings"].as_array().is_some_and(|crossings| crossings.len() > 10));
}

#[test]
fn a_run_too_long_to_be_placed_says_so() {
    let long = ["run", "--preset", "bench", "--json", "--set", "motion.end=1000.5", "--set", "detection.xi2=off"];
    let output = centrode(&long);
    assert!(output.status.success());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("no contact is placed: the run has 1000501 samples") && said.lines().count() == 1, "{said}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["estimates"], Value::Array(Vec::new()));
}
