//! `centrode map` as a program meets it.

use crate::cli::{centrode, json, scratch};
use centrode_core::scenario::Scenario;
use centrode_core::study::Job;
use centrode_core::study::map::MapJob;

#[test]
fn json_and_csv_hold_the_library_s_map() {
    let path = scratch("map.csv");
    let name = path.to_str().expect("path");
    let ours = json(&["map", "--columns", "5", "--rows", "4", "--json", "--out", name]);
    let text = std::fs::read_to_string(&path).expect("a file");
    std::fs::remove_file(&path).expect("removed");
    let mut job = MapJob::new(&Scenario::default(), 5, 4).expect("valid");
    job.finish();
    let map = job.map();
    let rows: Vec<Vec<_>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["arc_length [m]", "bend [rad]", "largest_xi2 [m]", "largest_epsilon_tau [1]"]);
    assert_eq!(rows.len(), 21);
    for (cell, row) in rows[1..].iter().enumerate() {
        let values = [map.arc_lengths[cell / 5], map.bends[cell % 5], map.deviation[cell], map.epsilon[cell]];
        for (field, value) in row.iter().zip(values) {
            assert_eq!(field.parse::<f64>().ok(), (!value.is_nan()).then_some(value), "{row:?}");
        }
        assert_eq!(ours["largest_xi2"][cell].as_f64(), Some(map.deviation[cell]));
    }
    let found = map.deviation.iter().filter(|&&value| value > 0.007).count();
    assert_eq!(ours["centrode"]["found"], found);
    assert!((1..20).contains(&found), "{found}");
}

#[test]
fn what_is_never_judged_is_empty_and_null() {
    let path = scratch("unjudged.csv");
    let name = path.to_str().expect("path");
    let set = "detection.min_speed=10";
    let ours = json(&["map", "--columns", "2", "--rows", "2", "--json", "--out", name, "--set", set]);
    let text = std::fs::read_to_string(&path).expect("a file");
    std::fs::remove_file(&path).expect("removed");
    assert!(text.lines().skip(1).all(|line| line.split(',').nth(2) == Some("")), "{text}");
    assert!(ours["largest_xi2"][0].is_null() && ours["contact"]["largest_xi2"].is_null());
    assert_eq!(ours["centrode"]["judged"], 0);
    let words = centrode(&["map", "--columns", "2", "--rows", "2", "--set", set]);
    assert!(String::from_utf8_lossy(&words.stdout).contains("nothing is judged"));
}

#[test]
fn bad_input_is_one_line_and_writes_nothing() {
    let path = scratch("refused.csv");
    let name = path.to_str().expect("path");
    let odd = scratch("refused.gif");
    let odd_name = odd.to_str().expect("path");
    for (args, part) in [
        (&["map", "--columns", "1", "--out", name][..], "2..=1000"),
        (&["map", "--rows", "1001", "--out", name], "2..=1000"),
        (&["map", "--set", "filter.length=0", "--out", name], "filter.length"),
        (&["map", "--out", odd_name], ".gif"),
        (&["map", "--out", "map"], "extension"),
        (&["map", "--out", "no-such-folder/map.csv"], "no-such-folder"),
    ] {
        let output = centrode(args);
        let message = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{args:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains(part), "{args:?}: {message}");
    }
    assert!(!path.exists() && !odd.exists());
}
