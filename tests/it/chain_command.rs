//! `centrode model --chain`: the references as files, and what is refused.

use crate::cli::{centrode, json, scratch};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A case of the references as a file: segments, then contacts from their own segment's base.
fn file(case: &Value, torsion: &str) -> String {
    let list = |key: &str| case[key].as_array().expect(key).iter().map(|x| x.as_f64().expect(key)).collect::<Vec<_>>();
    let (lengths, stiffness, theta_l, delta) = (list("L"), list("EI"), list("theta_L"), list("delta"));
    let mut text = String::new();
    for i in 0..lengths.len() {
        text += &format!("[[segment]]\nlength = {:?}\nbending_stiffness = {:?}\n", lengths[i], stiffness[i]);
        text += &format!("torsion = {torsion}\ntheta_l = {:?}\ndelta = {:?}\n", theta_l[i], delta[i]);
    }
    for contact in case["contacts"].as_array().expect("contacts") {
        let segment = contact["segment"].as_u64().expect("segment");
        let at = contact["s"].as_f64().expect("s") - lengths[..segment as usize - 1].iter().sum::<f64>();
        text += &format!("[[contact]]\nsegment = {segment}\nat = {at:?}\n");
        text += &format!("normal = {}\noffset = {}\n", contact["normal"], contact["offset"]);
    }
    text
}

fn written(name: &str, text: &str) -> PathBuf {
    let path = scratch(name);
    fs::write(&path, text).expect("a file");
    path
}

fn command(path: &Path) -> Value {
    json(&["model", "--json", "--chain", path.to_str().expect("text")])
}

/// The largest difference between two lists of lists of numbers.
fn off(ours: &Value, reference: &Value) -> f64 {
    match (ours, reference) {
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len(), "{ours} {reference}");
            a.iter().zip(b).map(|(a, b)| off(a, b)).fold(0.0, f64::max)
        }
        (a, b) => (a.as_f64().expect("a number") - b.as_f64().expect("a number")).abs(),
    }
}

#[test]
fn the_command_prints_the_references() {
    let rigid = include_str!("../data/chain.json").replace("Infinity", "1");
    let twisting = include_str!("../data/chain_torsion.json");
    for (text, torsion) in [(rigid.as_str(), "\"rigid\""), (twisting, "5")] {
        let cases: Value = serde_json::from_str(text).expect("reference data");
        for case in cases["cases"].as_array().expect("cases") {
            let reference = if case["out"].is_null() { case } else { &case["out"] };
            let path = written(&format!("chain-{}-{}", case["id"], torsion.len()), &file(case, torsion));
            let ours = command(&path);
            fs::remove_file(path).expect("it was there");
            let disks = reference["disks"].as_array().expect("disks");
            for (ours, disk) in ours["disks"].as_array().expect("disks").iter().zip(disks) {
                assert!(off(&ours["position"], &disk["position"]) < 1e-12);
                assert!(off(&ours["rotation"], &disk["rotation"]) < 1e-10);
            }
            assert!(off(&ours["twist_per_rate"], &reference["twist_per_rate"]) < 1e-10);
            let largest =
                reference["force"].as_array().expect("forces").iter().filter_map(Value::as_f64).fold(1.0, f64::max);
            assert!(off(&ours["contact_forces"], &reference["force"]) < 1e-9 * largest);
            assert_eq!(ours["active"], reference["active"]);
            assert!(off(&ours["stability_margin"], &reference["smallest_reduced_eigenvalue"]) < 1e-9, "{}", case["id"]);
            assert_eq!(ours["twist_per_rate"].as_array().map(Vec::len), Some(disks.len()));
        }
    }
}

const ONE: &str = "[[segment]]\nlength = 0.03\nbending_stiffness = 0.005\ntorsion = 5\ntheta_l = 0.9\n\
                   [[contact]]\nsegment = 1\nat = 0.015\nnormal = [1.0, 0.0, 0.0]\noffset = 0.002\n";

/// Lines 1 to 10 of [`ONE`] with a replacement, and what the refusal must name.
#[test]
fn a_bad_file_is_refused_in_one_line_with_its_place() {
    for (from, to, parts) in [
        ("length", "lenght", &["line 2", "segment[1].lenght", "length, bending_stiffness"][..]),
        ("length = 0.03\n", "", &["line 1", "segment[1].length is missing", "0.0001 m to 100 m"]),
        ("length = 0.03", "length = -1", &["line 2", "segment[1].length = -1", "0.0001 m to 100 m"]),
        ("length = 0.03", "length = \"long\"", &["line 2", "segment[1].length = \"long\""]),
        ("bending_stiffness = 0.005\n", "", &["line 1", "segment[1].bending_stiffness is missing", "tubes"]),
        ("bending_stiffness = 0.005", "bending_stiffness = 0", &["line 3", "bending_stiffness = 0", "N·m²"]),
        ("bending_stiffness = 0.005", "bending_stiffness = nan", &["line 3", "bending_stiffness = nan", "finite"]),
        ("torsion = 5", "torsion = 0", &["line 4", "segment[1].torsion = 0", "GJ/EI", "rigid"]),
        ("torsion = 5", "torsion = \"loose\"", &["line 4", "torsion = \"loose\"", "rigid"]),
        ("theta_l = 0.9\n", "", &["line 1", "segment[1].theta_l is missing"]),
        ("theta_l = 0.9", "theta_l = 9", &["line 5", "segment[1].theta_l = 9", "turn"]),
        ("theta_l = 0.9", "theta_l = 0.9\ndelta = inf", &["line 6", "segment[1].delta = inf"]),
        ("segment = 1", "segment = 0", &["line 7", "contact[1].segment = 0", "from 1 to 1"]),
        ("segment = 1", "segment = 1.5", &["line 7", "contact[1].segment = 1.5", "whole"]),
        ("at = 0.015\n", "", &["line 6", "contact[1].at is missing"]),
        ("at = 0.015", "at = 0.031", &["line 8", "contact[1].at = 0.031", "0.03 m"]),
        ("at = 0.015", "at = 0", &["line 8", "contact[1].at = 0", "0.03 m"]),
        ("[1.0, 0.0, 0.0]", "[1.0, 0.0]", &["line 9", "contact[1].normal = [1.0, 0.0]", "unit vector"]),
        ("[1.0, 0.0, 0.0]", "[1.0, 1.0, 0.0]", &["line 9", "contact[1].normal", "unit vector"]),
        ("[1.0, 0.0, 0.0]", "[nan, 1.0, 0.0]", &["line 9", "contact[1].normal", "unit vector"]),
        ("offset = 0.002", "offset = true", &["line 10", "contact[1].offset = true", "from -1000 m"]),
        (
            "offset = 0.002",
            "offset = 0.002\nkind = \"plane\"",
            &["line 11", "contact[1].kind", "segment, at, normal, offset"],
        ),
        ("[[segment]]", "[segment]", &["line 1", "segment", "[[segment]]"]),
        ("[[segment]]", "[[robot]]", &["line 1", "robot", "segment, contact"]),
        ("length = 0.03", "length = = 0.03", &["line 2"]),
        (ONE, "", &["segment is missing"]),
        (
            "bending_stiffness = 0.005",
            "bending_stiffness = 1\nprimary = { outer_diameter = 0.001 }",
            &["line 3", "bending_stiffness", "every segment"],
        ),
        (
            "bending_stiffness = 0.005",
            "primary = { outer_diameter = 0.001, inner_diameter = 0.002 }",
            &["line 3", "segment[1].primary.inner_diameter = 0.002", "0.001 m"],
        ),
    ] {
        let path = written("bad-chain", &ONE.replacen(from, to, 1));
        let output = centrode(&["model", "--json", "--chain", path.to_str().expect("text")]);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{to:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        for part in [path.to_str().expect("text")].iter().chain(parts) {
            assert!(message.contains(part), "{to:?} → {message:?} lacks {part:?}");
        }
    }
    let output = centrode(&["model", "--chain", "no-such-file.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let both = centrode(&["model", "--chain", "x.toml", "--theta-l", "1"]);
    assert_eq!(both.status.code(), Some(2));
    assert_eq!(centrode(&["model"]).status.code(), Some(2));
}

#[test]
fn tubes_of_distal_segments_stiffen_those_below() {
    let tube = "{ outer_diameter = 0.0009, inner_diameter = 0.0007, youngs_modulus = 60e9 }";
    let segment = |inside: &str| format!("[[segment]]\nlength = 0.03\n{inside}\ntheta_l = 0.9\ndelta = 0.4\n");
    let tubes = segment(&format!("primary = {tube}\nsecondary = {tube}")).repeat(2);
    let one = 60e9 * std::f64::consts::PI / 64.0 * (0.0009f64.powi(4) - 0.0007f64.powi(4));
    let given: String = [7.0, 4.0].map(|times| segment(&format!("bending_stiffness = {:e}", times * one))).concat();
    let contact = "[[contact]]\nsegment = 2\nat = 0.02\nnormal = [1.0, 0.0, 0.0]\noffset = 0.02\n";
    let [ours, reference] = [tubes, given].map(|text| {
        let path = written("chain-of-tubes", &(text + contact));
        let answer = command(&path);
        fs::remove_file(path).expect("it was there");
        answer
    });
    assert!(ours["contact_forces"][0].as_f64().expect("a force") > 0.0);
    assert!(off(&ours["contact_forces"], &reference["contact_forces"]) < 1e-9);
}

#[test]
fn without_json_it_prints_a_table_a_person_reads() {
    let path = written("chain-table", ONE);
    let output = centrode(&["model", "--chain", path.to_str().expect("text")]);
    fs::remove_file(path).expect("it was there");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("text");
    for part in [
        "segment 1, length",
        "GJ/EI = 5",
        "disk position",
        "linear by theta_l 1",
        "contact 1 on segment 1",
        "presses",
        "stability margin",
    ] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
}

#[test]
fn an_unstable_shape_is_an_error_and_prints_nothing() {
    let segment = "[[segment]]\nlength = 0.03\nbending_stiffness = 1\ntorsion = \"rigid\"\ntheta_l = 0.7\n";
    // Met at 20° in each segment, in their common plane.
    let contact = "[[contact]]\nsegment = 3\nat = 0.015\nnormal = [0.6427876096865394, 0.0, -0.766044443118978]\noffset = -0.0238\n";
    let path = written("chain-buckled", &(segment.repeat(3) + contact));
    let output = centrode(&["model", "--json", "--chain", path.to_str().expect("text")]);
    fs::remove_file(path).expect("it was there");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{message}");
    assert!(message.contains("no stable shape") && message.contains("buckles"), "{message}");
}
