//! Experiments with several segments: presets, contacts that are told and placed, and what is refused.

use crate::cli::{centrode, json, scratch};
use centrode_core::detect::Method;
use centrode_core::detect::chain::ChainMethod;
use centrode_core::model::Vec3;
use centrode_core::scenario::preset::{CHAINS, find_chain};
use centrode_core::scenario::{ChainPlan, ChainScenario, Kind};
use centrode_core::study::chain::ChainRun;
use serde_json::Value;
use std::fs;

fn run(preset: &str, sets: &[&str], seed: u64) -> ChainRun {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let scenario = find_chain(preset).expect(preset).chain(&sets).unwrap_or_else(|error| panic!("{preset}: {error}"));
    ChainRun::new(ChainPlan::new(&scenario.with_seed(seed)).expect("a stable shape"))
}

fn told<'a>(report: &'a Value, key: &str) -> &'a Vec<Value> {
    report[key].as_array().expect(key)
}

#[test]
fn every_preset_runs_and_says_what_happens() {
    for preset in CHAINS {
        let report = json(&["run", "--json", "--preset", preset.name]);
        let what: Vec<&str> =
            told(&report, "plant_events").iter().map(|event| event["what"].as_str().expect("what")).collect();
        let expected: &[&str] = match preset.name {
            "two-contacts" => &["met", "met"],
            "reopened" => &["met", "met", "opened"],
            "buckling" => &["met", "buckled"],
            _ => &["met"],
        };
        assert_eq!(what, expected, "{}", preset.name);
        assert!(!told(&report, "events").is_empty(), "{}", preset.name);
    }
}

#[test]
fn contacts_are_told_one_by_one_with_segment_and_place() {
    let report = json(&["run", "--json", "--preset", "two-contacts", "--after", "0.5"]);
    let found = told(&report, "found");
    assert_eq!(found.len(), 2, "{report}");
    for (found, (segment, time)) in found.iter().zip([(2, 5.2), (3, 6.8)]) {
        let estimate = &found["estimates"][0];
        assert_eq!(estimate["segment"], segment, "{found}");
        assert!(estimate["probabilities"][segment - 1].as_f64().expect("probability") > 0.95, "{found}");
        assert!((estimate["at"].as_f64().expect("at") - 0.015).abs() < 0.6e-3, "{found}");
        assert!((estimate["began"].as_f64().expect("began") - time).abs() < 0.03, "{found}");
        let [low, high] = ["low", "high"].map(|key| estimate[key].as_f64().expect(key));
        let [along_low, along_high] = ["along_low", "along_high"].map(|key| estimate[key].as_f64().expect(key));
        assert!(low < 0.015 && 0.015 < high, "{found}");
        let base = 0.03 * (segment as f64 - 1.0);
        assert!((along_low - base - low).abs() < 1e-3 && (along_high - base - high).abs() < 1e-3, "{found}");
    }
}

#[test]
fn a_second_contact_is_placed_as_if_the_first_were_known() {
    let mut off = Vec::new();
    for seed in 2..=6 {
        let run = run("two-contacts", &[], seed);
        let found = run.judged.contacts(ChainMethod::Of(Method::Cusum), &[0.5]);
        assert_eq!(found.len(), 2, "seed {seed}");
        let estimate = &found[1].estimates[0];
        assert_eq!(estimate.segment, 2, "seed {seed}: {:?}", estimate.probabilities);
        let width = estimate.place.high - estimate.place.low;
        assert!((0.2e-3..0.8e-3).contains(&width), "seed {seed}: {:?}", estimate.place);
        off.push((estimate.place.mean - 0.015) / (0.25 * width));
    }
    // In standard deviations. Of five at most one is beyond two, and their mean is not beyond three of its own.
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    assert!(off.iter().filter(|off| off.abs() > 2.0).count() <= 1 && mean.abs() < 3.0 / 5_f64.sqrt(), "{off:?}");
}

#[test]
fn the_segment_is_right_and_the_place_near_over_several_seeds() {
    let mut off = [Vec::new(), Vec::new(), Vec::new()];
    for seed in 4..=12 {
        let segment = seed as usize % 3;
        let set = format!("contact[1].segment={}", segment + 1);
        let run = run("three-segments", &[&set], seed);
        let found = run.judged.contacts(ChainMethod::Of(Method::Cusum), &[0.5]);
        assert_eq!(found.len(), 1, "seed {seed}");
        let estimate = &found[0].estimates[0];
        assert_eq!(estimate.segment, segment, "seed {seed}: {:?}", estimate.probabilities);
        off[segment].push(estimate.place.mean - 0.015);
    }
    // Three times the RMS that is asked of 200 runs.
    for (off, most) in off.iter().zip([1.05e-3, 0.75e-3, 0.45e-3]) {
        assert!(off.iter().all(|off| off.abs() < most), "{off:?}");
    }
}

#[test]
fn on_five_segments_intervals_hold_the_contact_that_all_trackers_see() {
    let preset = find_chain("three-segments").expect("a preset").toml;
    let (three, contact) = preset.split_once("[[contact]]").expect("a contact");
    let second = three.split("[[segment]]").nth(2).expect("segments");
    let five = format!(
        "{three}{}[[contact]]{}",
        format!("[[segment]]{second}").repeat(2),
        contact.replace("segment = 3", "segment = 5")
    );
    let held = (1..=6).filter(|seed| {
        let scenario = ChainScenario::from_bytes(five.as_bytes(), &[]).expect("a scenario").with_seed(*seed);
        let run = ChainRun::new(ChainPlan::new(&scenario).expect("stable"));
        let found = run.judged.contacts(ChainMethod::Of(Method::Cusum), &[0.5]);
        let estimate = &found[0].estimates[0];
        assert_eq!(estimate.segment, 4, "seed {seed}");
        let truth = 4.0 * 0.03 + scenario.contacts[0].at;
        (estimate.along.low..=estimate.along.high).contains(&truth)
    });
    let held = held.count();
    assert!(held >= 5, "{held} of 6");
}

#[test]
fn a_free_robot_hardly_ever_raises_an_alarm_of_the_calibration_filter() {
    let mut alarms = 0;
    for seed in 1..=10 {
        let scenario = find_chain("three-segments").and_then(|preset| preset.chain(&[]).ok()).expect("valid");
        let run = ChainRun::new(ChainPlan::new(&scenario.without_contacts().with_seed(seed)).expect("free"));
        let cusum =
            |event: &&centrode_core::detect::chain::ChainEvent| event.detector == ChainMethod::Of(Method::Cusum);
        alarms += usize::from(run.judged.events.iter().any(|event| cusum(&event)));
        let truth = run.recording.truth.as_ref().expect("simulated");
        assert!(truth.iter().all(|truth| truth.active.is_empty() && truth.margin == 1.0));
    }
    // By design one run in a hundred.
    assert!(alarms <= 1, "{alarms} of 10 runs");
}

#[test]
fn segments_above_the_contact_show_what_they_would_alone() {
    let quiet = ["tracker.position_noise=0", "tracker.orientation_noise=0", "contact[1].segment=2"];
    let (held, free) =
        (run("three-segments", &quiet, 1), run("three-segments", &[quiet[0], quiet[1], "contact=[]"], 1));
    let (above, alone) = (&held.judged.relative[2].entries, &free.judged.relative[2].entries);
    for (held, free) in above.iter().zip(alone) {
        assert!((held.reading.position - free.reading.position).norm() < 1e-10, "{}", held.time);
    }
    let last = above.len() - 1;
    let carried = |run: &ChainRun| run.recording.truth.as_ref().expect("simulated")[last].disks[2].position;
    assert!((carried(&held) - carried(&free)).norm() > 1e-3);
}

#[test]
fn a_plane_that_comes_to_stand_touches_the_backbone_then() {
    let run = run("three-segments", &["contact[1].tilt=0.2"], 1);
    let (normal, offset) = run.plan.path().plane(0).expect("it stands");
    let at = |time: f64| run.plan.path().pose(time, &run.plan.bends(time), 2, 0.015);
    let (pose, later) = (at(5.8), at(7.0));
    assert!((normal.dot(&pose.position) - offset).abs() < 1e-12);
    assert!(normal.dot(&(pose.rotation * Vec3::z())).abs() < 1e-12, "the tangent lies in it");
    assert!((normal.dot(&later.position) - offset).abs() < 1e-11, "it presses: {:?}", run.plan.path().happened());
}

#[test]
fn a_clamp_freezes_what_rests_below_it_and_is_refused_where_that_moves() {
    let still =
        ["segment[1].motion.theta_end=1.5707963267948966", "segment[2].motion.delta_end=0", "contact[1].segment=2"];
    let sets: Vec<&str> = still.into_iter().chain(["contact[1].kind=clamp"]).collect();
    let run = run("three-segments", &sets, 1);
    let disks = |time: f64| run.plan.path().at(time, &run.plan.bends(time)).disks;
    assert_eq!(disks(5.8)[0], disks(9.0)[0]);
    assert!((disks(5.8)[1].position - disks(9.0)[1].position).norm() > 1e-3);
    let refused = centrode(&["run", "--preset", "three-segments", "--set", "contact[1].kind=clamp"]);
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2));
    assert!(message.contains("contact[1].kind") && message.contains("below it"), "{message}");
}

#[test]
fn a_bend_says_when_a_contact_stands() {
    let by_bend = json(&["run", "--json", "--preset", "buckling"]);
    let time = by_bend["contacts"][0]["time"].as_f64().expect("time");
    let by_time =
        json(&["run", "--json", "--preset", "three-segments", "--set", "contact[1].time=5.09", "--detector", "cusum"]);
    assert!((5.0..5.2).contains(&time), "{time}");
    assert_eq!(by_time["contacts"][0]["time"], 5.09);
    assert!(by_bend["end"].as_f64().expect("end") < 6.2, "the run ends where it buckles");
}

#[test]
fn a_tracker_on_the_tip_alone_notices_and_places() {
    let report = json(&["run", "--json", "--preset", "tip-only", "--after", "0.5"]);
    let events = told(&report, "events");
    assert!(events.iter().all(|event| event["segment"] == 3), "{report}");
    for detector in ["cusum", "smd"] {
        let after = |event: &&Value| event["detector"] == detector && event["raised"].as_f64().expect("raised") >= 5.8;
        assert!(events.iter().find(after).is_some_and(|event| event["cleared"].is_null()), "{detector}: {report}");
    }
    let found = told(&report, "found");
    assert_eq!(found.len(), 1, "{report}");
    let estimate = &found[0]["estimates"][0];
    assert_eq!(estimate["segment"], 2, "{estimate}");
    assert!(estimate["probabilities"][1].as_f64().expect("probability") > 0.9, "{estimate}");
    let [at, low, high] = ["at", "low", "high"].map(|key| estimate[key].as_f64().expect(key));
    assert!((at - 0.015).abs() < 0.8e-3 && low < 0.015 && 0.015 < high, "{estimate}");
}

#[test]
fn a_plane_askew_is_placed_with_its_tilt() {
    let report = json(&["run", "--json", "--preset", "oblique", "--after", "0.5"]);
    let estimate = &told(&report, "found")[0]["estimates"][0];
    let [at, tilt, plane] = [&estimate["at"], &estimate["tilt"], &estimate["kinds"]["plane"]]
        .map(|value| value.as_f64().expect("a number"));
    assert!((at - 0.015).abs() < 0.5e-3, "{estimate}");
    assert!((tilt.to_degrees() - 40.0).abs() < 4.0 && plane > 0.99, "{estimate}");
}

#[test]
fn a_clamp_is_told_from_a_plane_where_what_is_below_rests() {
    let still = [
        "segment[1].motion.theta_end=1.5707963267948966",
        "segment[2].motion.theta_end=1.5707963267948966",
        "segment[2].motion.delta_end=0",
        "contact[1].kind=clamp",
    ];
    let run = run("three-segments", &still, 1);
    let found = run.judged.contacts(ChainMethod::Of(Method::Cusum), &[0.5]);
    let estimate = &found[0].estimates[0];
    let clamp = estimate.kinds.iter().find(|(kind, _)| *kind == Kind::Clamp).expect("thought of").1;
    assert!(estimate.segment == 2 && clamp > 0.5, "{estimate:?}");
    assert!(estimate.place.low < 0.015 && 0.015 < estimate.place.high, "{:?}", estimate.place);
    assert!((estimate.place.mean - 0.015).abs() < 1e-3, "{:?}", estimate.place);
}

#[test]
fn csv_has_a_row_for_every_sample_and_columns_for_every_segment() {
    let path = scratch("chain-run.csv");
    let file = path.to_str().expect("text");
    let done = centrode(&["run", "--preset", "oblique", "--csv", file]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let text = fs::read_to_string(&path).expect("a file");
    fs::remove_file(path).expect("it was there");
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    for name in ["time [s]", "theta_l_1 [rad]", "disk_1_x [m]", "screw_angle_1 [rad]", "force_1 [N]"] {
        assert!(header.contains(&name), "{name}");
    }
    assert_eq!(lines.clone().count(), 10_001);
    assert!(lines.all(|line| line.split(',').count() == header.len()));
}

#[test]
fn with_a_tracker_on_the_tip_alone_files_hold_what_judges() {
    let [csv, svg] = ["chain-tip.csv", "chain-tip.svg"].map(scratch);
    let [table, drawing] = [&csv, &svg].map(|path| path.to_str().expect("text"));
    let done = centrode(&["run", "--preset", "tip-only", "--csv", table, "--figure", drawing]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let [text, drawn] = [&csv, &svg].map(|path| fs::read_to_string(path).expect("a file"));
    [csv, svg].into_iter().for_each(|path| fs::remove_file(path).expect("it was there"));
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let most = |name: &str| {
        let at = rows[0].iter().position(|column| *column == name).expect(name);
        rows[1..].iter().filter_map(|row| row[at].parse().ok()).fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(most("cusum_3 [1]") > 30.0 && most("screw_angle_3 [rad]") > 0.0);
    assert_eq!([most("cusum_1 [1]"), most("cusum_2 [1]")], [f64::NEG_INFINITY; 2]);
    assert!(drawn.contains("Segment 3: ") && !drawn.contains("Segment 2: "), "one disk is judged");
    let refused = centrode(&["run", "--preset", "tip-only", "--detector", "fcd"]);
    let why = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(2) && why.contains("those that do: cusum, smd"), "{why}");
}

#[test]
fn what_cannot_be_is_refused_in_one_line_with_the_key() {
    let segment = "[[segment]]\ntorsion = 5\n[segment.motion]\ntheta_end = 1.0\n";
    for (text, parts) in [
        ("[robot]\nlength = 0.03\n[[segment]]\n", &["robot", "[[segment]]"][..]),
        ("[[segment]]\nlenght = 0.03\n", &["line 2", "segment[1].lenght", "length"]),
        ("[[segment]]\nlength = -1\n", &["segment[1].length", "-1"]),
        ("[[segment]]\ntorsion = 0\n", &["segment[1].torsion", "rigid"]),
        ("[[segment]]\n[segment.motion]\ntheta_end = 9\n", &["segment[1].motion.theta_end", "9"]),
        ("[[segment]]\n[segment.motion]\ndelta_start = 5\ndelta_finish = 4\n", &["delta_finish", "after delta_start"]),
        ("end = -1\n[[segment]]\n", &["end", "-1"]),
        ("[tracker]\ndisks = \"some\"\n[[segment]]\n", &["line 2", "tracker.disks", "tip"]),
        ("[detection]\ndetectors = [\"jfd\"]\n[[segment]]\n", &["detection.detectors", "smd"]),
        ("[detection]\nsmd_angle = -1\n[[segment]]\n", &["detection.smd_angle", "0 rad"]),
        ("[filter]\nlength = 0\n[[segment]]\n", &["filter.length", "0"]),
        ("[[segment]]\n[[contact]]\nsegment = 2\nat = 0.01\ntime = 5\n", &["line 3", "contact[1].segment", "1 to 1"]),
        ("[[segment]]\n[[contact]]\nsegment = 1\ndisk = 4\ntime = 5\n", &["contact[1].disk", "1 to 3"]),
        ("[[segment]]\n[[contact]]\nsegment = 1\ndisk = 1\nat = 0.01\ntime = 5\n", &["contact[1].at", "not both"]),
        ("[[segment]]\n[[contact]]\nsegment = 1\ndisk = 1\n", &["contact[1].time", "missing"]),
        ("[[segment]]\n[[contact]]\nsegment = 1\ndisk = 1\ntime = 99\n", &["contact[1].time", "99"]),
        ("[[segment]]\n[[contact]]\nsegment = 1\ndisk = 1\nbend = 1\n", &["contact[1].bend", "passes"]),
        ("[[segment]]\n[[contact]]\nsegment = 1\ndisk = 1\nkind = \"rope\"\ntime = 5\n", &["contact[1].kind", "clamp"]),
        (
            "[[segment]]\n[[contact]]\nsegment = 1\ndisk = 1\nnormal = [2, 0, 0]\noffset = 0\n",
            &["contact[1].normal", "unit"],
        ),
    ] {
        let error = ChainScenario::from_bytes(text.as_bytes(), &[]).expect_err(text).to_string();
        for part in parts {
            assert!(error.contains(part), "{text:?} → {error:?} lacks {part:?}");
        }
        assert!(!error.contains('\n'), "{error:?}");
    }
    for set in ["segment[3].length=0.03", "=1", "segment.length=1", "contact[0].at=1"] {
        assert!(ChainScenario::from_bytes(segment.as_bytes(), &[set.to_owned()]).is_err(), "{set}");
    }
}

#[test]
fn flags_of_one_segment_are_refused_and_other_subcommands_say_which_takes_it() {
    for (args, part) in [
        (&["run", "--preset", "oblique", "--log", "x.tum"][..], "written as .csv"),
        (&["run", "--preset", "oblique", "--figure", "x.bmp"][..], "--figure"),
        (&["run", "--preset", "oblique", "--detector", "jfd"][..], "those that do"),
        (&["run", "--preset", "oblique", "--set", "end=1e6"][..], "end"),
        (&["study", "--preset", "oblique"][..], "centrode run"),
    ] {
        let refused = centrode(args);
        let message = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{args:?}: {message}");
        assert!(message.contains(part) && message.trim_end().lines().count() == 1, "{args:?}: {message}");
    }
}
