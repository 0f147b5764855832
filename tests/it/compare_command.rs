//! `centrode study --detectors` as a program meets it: the core's numbers as JSON, as CSV and drawn, and the advice over detectors.

use crate::cli::{centrode, json, scratch};
use centrode_core::detect::Method;
use centrode_core::scenario::preset::find;
use centrode_core::study::Job;
use centrode_core::study::compare::{Compare, Comparison, Spec, with};
use centrode_core::study::report::AFTER;
use centrode_core::study::tuning::recommend::Verdict;
use serde_json::Value;

/// A loop as fast as the tracker, which makes many runs cheap.
const SETS: [&str; 3] = ["loop_rate=100", "filter.length=50", "estimation.plants=[\"clamp\"]"];
const METHODS: [Method; 3] = [Method::Fcd, Method::FcdVelocity, Method::Cusum];

fn args<'a>(repeats: &'a str, rate: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let sets = SETS.into_iter().flat_map(|set| ["--set", set]);
    let end = ["--repeats", repeats, "--detectors", "fcd,fcd-velocity,cusum", "--rate", rate];
    ["study"].into_iter().chain(sets).chain(end).chain(more.iter().copied()).collect()
}

fn library(repeats: usize, rate: f64) -> Comparison {
    let mut draft = find("bench").and_then(|preset| preset.draft()).expect("bench");
    SETS.iter().for_each(|set| draft.set(set).expect(set));
    let scenario = with(&draft.finish().expect("valid"), &METHODS);
    let spec = Spec { scenario, repeats, rate, detector: Method::Cusum, after: AFTER.to_vec() };
    let mut compare = Compare::new(spec).expect("possible");
    compare.finish();
    compare.comparison()
}

#[test]
fn the_command_has_the_core_s_numbers_and_csv_those_of_json() {
    let (table, drawing) = (scratch("compare.csv"), scratch("compare.svg"));
    let (table_name, drawing_name) = (table.to_str().expect("path"), drawing.to_str().expect("path"));
    let told = json(&args("12", "0.3", &["--json", "--csv", table_name, "--svg", drawing_name]));
    let expected = serde_json::to_value(library(12, 0.3)).expect("JSON");
    for (key, value) in expected.as_object().expect("an object") {
        assert_eq!(&told[key], value, "{key}");
    }
    let [text, svg] = [&table, &drawing].map(|path| std::fs::read_to_string(path).expect("a file"));
    [&table, &drawing].into_iter().for_each(|path| std::fs::remove_file(path).expect("removed"));
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    let column = |name: &str| rows[0].iter().position(|head| *head == name).expect(name);
    let of = |kind: &str, name: &str| rows.iter().filter(|row| row[0] == kind && row[1] == name).collect::<Vec<_>>();
    // What is not defined is null there and empty here.
    let same = |row: &[&str], head: &str, value: &Value| {
        let cell = row[column(head)];
        assert_eq!(cell.parse::<f64>().ok(), value.as_f64(), "{head}: {cell:?} for {value}");
    };
    for compared in told["detectors"].as_array().expect("a list") {
        let name = compared["detector"].as_str().expect("a key");
        let curve = compared["curve"].as_array().expect("a list");
        let levels = of("threshold", name);
        assert!(levels.len() == curve.len() && curve.len() > 3, "{name}: {} and {}", levels.len(), curve.len());
        for (row, point) in levels.into_iter().zip(curve) {
            same(row, "threshold [SI]", &point["threshold"]);
            same(row, "false_alarms", &point["false_alarms"]["count"]);
            same(row, "false_alarm_high [1]", &point["false_alarms"]["high"]);
            same(row, "time_to_false_alarm [s]", &point["false_alarms"]["mean_time"]);
            same(row, "early", &point["detection"]["early"]["count"]);
            same(row, "found", &point["detection"]["detected"]["count"]);
            same(row, "delay_median [s]", &point["detection"]["median"]);
            same(row, "delay_median_high [s]", &point["detection"]["median_high"]);
            same(row, "delay_90 [s]", &point["detection"]["ninety"]);
        }
        for kind in ["own", "equal"] {
            let row = of(kind, name)[0];
            same(row, "threshold [SI]", &compared[kind]["threshold"]);
            same(row, "false_alarm_rate [1]", &compared[kind]["false_alarms"]["rate"]);
            same(row, "delay_median [s]", &compared[kind]["median"]);
        }
    }
    let bounds = told["bounds"].as_array().expect("a list");
    assert!(bounds.len() > 10 && of("bound", "").len() == bounds.len());
    for (row, bound) in of("bound", "").into_iter().zip(bounds) {
        same(row, "false_alarm_rate [1]", &bound["rate"]);
        same(row, "delay_median [s]", &bound["median"]);
    }
    let places = told["places"].as_array().expect("a list");
    assert!(places.len() == AFTER.len() && of("place", "marginal").len() == places.len());
    for (row, place) in of("place", "marginal").into_iter().zip(places) {
        same(row, "since_contact [s]", &place["since"]);
        same(row, "rms [m]", &place["rms"]);
        same(row, "covered", &place["coverage"]["count"]);
        same(row, "bound [m]", &place["bound"]);
    }
    assert!(of("place-bound", "").len() > 30);
    for word in ["No test can beat", "No unbiased estimate can beat", "12 repeats", "view=detectors", "CUSUM"] {
        assert!(svg.contains(word), "it lacks {word:?}");
    }
}

#[test]
fn bounds_fall_with_the_rate_and_lie_below_the_curves() {
    let comparison = library(60, 0.05);
    assert!(
        comparison
            .bounds
            .windows(2)
            .all(|pair| { pair[0].rate < pair[1].rate && pair[0].delay.median >= pair[1].delay.median })
    );
    assert_eq!(comparison.bound.map(|bound| bound.median), {
        let bound = comparison.bounds.iter().find(|bound| bound.rate == 0.05);
        bound.map(|bound| bound.delay.median)
    });
    for compared in &comparison.detectors {
        // Rising thresholds: fewer alarms, later.
        for pair in compared.curve.windows(2) {
            let alarms = |k: usize| pair[k].false_alarms.rate.count;
            assert!(pair[0].threshold < pair[1].threshold && alarms(0) >= alarms(1), "{pair:?}");
        }
        let quiet = compared.curve.last().expect("a level");
        assert_eq!(quiet.false_alarms.rate.count, 0);
        let delay = quiet.detection.expect("a contact").median;
        let bound = comparison.bounds[0].delay.median;
        assert!(delay + 1e-9 >= bound, "{}: {delay} s, bound {bound} s", compared.detector);
    }
    let bounds: Vec<f64> = comparison.place_bounds.iter().map(|limit| limit.bound).collect();
    assert!(bounds.len() > 30 && bounds.windows(2).all(|pair| pair[0] >= pair[1]), "more readings say more");
}

#[test]
fn advice_takes_the_soonest_threshold_that_is_shown_to_be_quiet_and_names_the_soonest_detector() {
    let comparison = library(80, 0.05);
    for compared in &comparison.detectors {
        let Verdict::Take { level, ref point, .. } = compared.advised else { panic!("{:?}", compared.advised) };
        // As text, in which what is not defined equals itself.
        assert_eq!(format!("{:?}", compared.curve[level]), format!("{point:?}"));
        assert!(point.false_alarms.rate.high <= 0.05, "{point:?}");
        let median = |point: &centrode_core::study::tuning::Point| point.detection.expect("a contact").median;
        let quiet = compared.curve.iter().filter(|other| other.false_alarms.rate.high <= 0.05);
        let soonest = quiet.map(median).fold(f64::INFINITY, f64::min);
        assert!(soonest.is_finite() && median(point) <= soonest, "{point:?}");
    }
    assert_eq!(comparison.soonest, Some("cusum"));
    assert_eq!(comparison.advice().map(|(method, _)| method), Some(Method::Cusum));
    let said = centrode(&args("80", "0.05", &[]));
    let said = String::from_utf8(said.stdout).expect("text");
    assert!(said.contains("\nsoonest         cusum at ") && said.contains("0 of 80 (0.0 to 4.6 %)"), "{said}");
    // Too few runs show nothing, and it says how many would.
    let few = library(10, 0.05);
    assert!(few.detectors.iter().all(|compared| compared.advised == Verdict::TooFewRuns { needed: 73 }));
    assert_eq!(few.soonest, None);
    let said = centrode(&args("10", "0.05", &[]));
    assert!(String::from_utf8_lossy(&said.stdout).contains("at least --repeats 73"));
}

#[test]
fn flags_that_belong_to_the_other_study_are_refused() {
    for (flag, part) in [
        (&["--sweep", "filter.length=100,200"][..], "--sweep and --method"),
        (&["--method", "fcd"], "--sweep and --method"),
        (&["--svg", "a.gif"], "--svg a.gif"),
        (&["--csv", "no-such-folder/a.csv"], "no-such-folder"),
    ] {
        let output = centrode(&args("3", "0.05", flag));
        let line = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{flag:?}: {line}");
        assert!(line.contains(part) && line.trim_end().lines().count() == 1, "{flag:?}: {line}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_factor_on_the_bound_has_no_unit_and_flags_of_the_other_study_are_refused() {
    let out = centrode(&[
        "study",
        "--preset",
        "bench",
        "--repeats",
        "3",
        "--detectors",
        "jfd",
        "--set",
        "detection.xi1_rule=bound",
    ]);
    let text = String::from_utf8(out.stdout).expect("UTF-8");
    let row = text.lines().find(|line| line.starts_with("jfd")).expect("a row");
    assert!(row.contains(" 1.500 ") && !row.contains("mN"), "{row}");
    let with = ["study", "--repeats", "3", "--detectors", "fcd"];
    for (args, said) in [
        ([&with[..], &["--late", "2"]].concat(), "--late"),
        ([&with[..], &["--false-alarms", "0.1"]].concat(), "--false-alarms"),
        (vec!["study", "--repeats", "3", "--after", "0.1"], "--after"),
        (vec!["study", "--repeats", "3", "--rate", "0.1"], "--detectors"),
    ] {
        let output = centrode(&args);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && told.contains(said), "{args:?}: {told}");
    }
}
