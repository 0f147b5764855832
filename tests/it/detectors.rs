//! The detectors: which judge, against which thresholds, from when on, and against an independent reference.

use centrode_core::detect::evidence::Evidence;
use centrode_core::detect::{Method, Settings, judge};
use centrode_core::model::orientation::to_euler;
use centrode_core::model::{Mat3, Vec3};
use centrode_core::record::Recording;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Arming, Detectors, Mounting, Place, Plan, Scenario, Threshold};
use centrode_core::sensors::tracker::{Reading, tip_from_marker, unwrapped};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Detectors that are computed of every run.
const COMPUTED: [Method; 4] = [Method::Fcd, Method::Jfd, Method::FcdConsistent, Method::FcdVelocity];

fn preset(name: &str) -> Scenario {
    find(name).and_then(|preset| preset.scenario()).expect(name)
}

fn run(scenario: &Scenario) -> Run {
    simulate(scenario).expect("possible")
}

/// What is not defined is null.
fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("numbers").iter().map(|number| number.as_f64().unwrap_or(f64::NAN)).collect()
}

/// The readings of a file as the loop stores them, with the commands of the default motion.
fn recording(plan: &Plan, readings: &Value) -> Recording {
    let [x, z, angle] = ["x_m", "z_m", "angle_rad"].map(|name| numbers(&readings[name]));
    let marker = tip_from_marker(Mounting::BendingAxis, 0.0);
    let mut taken: Vec<Reading> = Vec::new();
    for k in 0..x.len() {
        let (sin, cos) = angle[k].sin_cos();
        let mut angles = to_euler(&(Mat3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos) * marker));
        if let Some(before) = taken.last() {
            angles = [0, 1, 2].map(|i| unwrapped(angles[i], before.angles[i]));
        }
        taken.push(Reading { position: Vec3::new(x[k], 0.0, z[k]), angles });
    }
    let mut recording = Recording { truth: None, ..Recording::simulated(plan) };
    for (k, entry) in recording.entries.iter_mut().enumerate() {
        entry.reading = taken[k / 10];
    }
    recording
}

#[test]
fn the_consistent_deviation_is_that_of_an_independent_program() {
    for calibration in ["exact", "miscal"] {
        for disk in 1..=3 {
            let name = format!("{calibration}-seed1-disk{disk}.json");
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/detection").join(&name);
            let file: Value = serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON");
            let expected = &file["b_filter_consistent_fcd"];
            let mut scenario = Scenario::default();
            scenario.contact.place = Place::Nowhere;
            scenario.filter.length = expected["N"].as_u64().expect("N");
            let detection = &mut scenario.detection;
            detection.detectors = Detectors::of(&[Method::FcdConsistent]);
            detection.min_speed = expected["min_speed"].as_f64().expect("a speed");
            detection.consistent = Threshold::On(expected["xi2_m"].as_f64().expect("a threshold"));
            // The reference looks at samples after this time, not at it.
            detection.armed_from = expected["armed_after_s"].as_f64().expect("a time") + 0.0005;
            detection.arming = Arming::All;
            let floor = detection.min_speed;
            let plan = Plan::new(&scenario).expect("possible");
            let judged = judge(&recording(&plan, &file["readings"]), &Settings::of(&plan));

            let (times, deviations) = (numbers(&expected["deviation_at_s"]), numbers(&expected["deviation_m"]));
            assert!(times.len() == 50 && deviations.iter().filter(|x| x.is_finite()).count() > 30, "{name}");
            for (time, deviation) in times.iter().zip(deviations) {
                let own = judged.evidence[(time * 1000.0).round() as usize].judgement;
                // The readings have ten decimals, and a slow turn multiplies what is behind them.
                let least = if own.speed > floor { 1e-9 } else { 1e-7 * deviation.max(0.01) };
                let own = own.consistent;
                let same = if deviation.is_nan() { own.is_nan() } else { (own - deviation).abs() < least };
                assert!(same, "{name} at {time} s: {own} m, not {deviation} m");
            }
            let alarm = judged.events.first().map(|event| (event.detector, (event.raised * 1000.0).round()));
            let expected = expected["alarm_s"].as_f64().map(|time| (Method::FcdConsistent, (time * 1000.0).round()));
            assert_eq!(alarm, expected, "{name}");
        }
    }
}

#[test]
fn without_errors_and_contact_the_consistent_deviation_is_nothing() {
    for latency in [0.0, 0.0123] {
        let mut scenario = preset("free");
        (scenario.tracker.position_noise, scenario.tracker.orientation_noise) = (0.0, 0.0);
        scenario.tracker.latency = latency;
        scenario.detection.detectors = Detectors::of(&[Method::Fcd, Method::FcdConsistent]);
        scenario.detection.armed_from = 0.0;
        let run = run(&scenario);
        let thresholds = &scenario.detection;
        let largest = |method: Method| {
            let counted = run.samples().filter_map(|x| method.statistic(&x.judgement, x.time, thresholds).counted());
            counted.fold(0.0, f64::max)
        };
        // Commands in between two samples are taken from a straight line.
        let least = if latency == 0.0 { 1e-9 } else { 1e-6 };
        assert!(largest(Method::FcdConsistent) < least, "{} m", largest(Method::FcdConsistent));
        assert!(largest(Method::Fcd) > 7e-4, "{} m", largest(Method::Fcd));
    }
}

#[test]
fn every_detector_raises_its_own_events_and_none_when_it_does_not_judge() {
    let mut scenario = preset("bench");
    scenario.detection.detectors = Detectors::of(&COMPUTED);
    let all = run(&scenario);
    for method in COMPUTED {
        let event = all.judged.first(method).expect("an event");
        assert!(event.value > event.threshold, "{event:?}");
        assert_eq!(
            Some(event.threshold),
            method.threshold(&all.sample_at(event.raised).judgement, &scenario.detection)
        );
        assert_eq!(event.detection.is_some(), method.places(), "{event:?}");

        let mut without = scenario.clone();
        without.detection.detectors.set(method, false);
        let fewer = run(&without);
        assert!(fewer.judged.first(method).is_none() && fewer.crossings().iter().all(|x| x.method != method));
        let others = all.events().iter().filter(|event| event.detector != method);
        assert!(others.eq(fewer.events()), "{method:?}");

        let mut off = scenario.clone();
        *off.detection.of_mut(method) = Threshold::OFF;
        assert!(run(&off).judged.first(method).is_none(), "{method:?}");
    }
    scenario.detection.detectors = Detectors::NONE;
    let none = run(&scenario);
    assert!(none.events().is_empty() && none.crossings().is_empty() && none.detection().is_none());
    assert_eq!(none.fingerprint(), all.fingerprint());
}

#[test]
fn what_a_detector_needs_is_computed_only_where_it_judges() {
    let scenario = preset("bench");
    let consistent =
        |run: &Run| run.judged.evidence.iter().any(|Evidence { judgement, .. }| judgement.consistent.is_finite());
    let mut run = run(&scenario);
    assert!(!consistent(&run));
    let mut with = scenario;
    with.detection.detectors.set(Method::FcdConsistent, true);
    run.update(Plan::new(&with).expect("possible"));
    assert!(consistent(&run));
}

#[test]
fn the_velocity_deviation_is_defined_at_rest_and_is_the_speed_times_the_deviation() {
    let run = run(&preset("bench"));
    let whole = run.plan.scenario().filter.length as usize;
    assert!(run.samples().take(whole - 1).all(|sample| sample.judgement.velocity.is_nan()));
    for sample in run.samples().skip(whole - 1) {
        let judgement = sample.judgement;
        let expected = if judgement.speed == 0.0 { 0.0 } else { judgement.speed * judgement.deviation };
        assert_eq!(judgement.velocity, expected, "at {} s", sample.time);
    }
}

#[test]
fn only_the_paper_s_detectors_wait_unless_all_do() {
    let mut scenario = preset("disk-1");
    scenario.detection.detectors = Detectors::of(&COMPUTED);
    // Contact at 5.8 s, long before anyone is armed.
    scenario.detection.armed_from = 7.5;
    let first = |scenario: &Scenario, method| run(scenario).judged.first(method).map(|event| event.raised);
    for method in COMPUTED {
        *scenario.detection.of_mut(method) = Threshold::On(1e-4);
        let raised = first(&scenario, method).expect("an event");
        assert_eq!(raised < 7.5, !method.is_of_paper(), "{method:?}: {raised} s");
    }
    scenario.detection.arming = Arming::All;
    for method in COMPUTED {
        let raised = first(&scenario, method);
        assert!(raised.is_some_and(|raised| raised >= 7.5), "{method:?}: {raised:?}");
    }
}

#[test]
fn the_detection_is_that_of_the_paper_s_centrode_alone() {
    let mut scenario = preset("bench");
    let detection = run(&scenario).detection();
    scenario.detection.detectors = Detectors::of(&COMPUTED);
    let with = run(&scenario);
    assert!(detection.is_some() && with.detection() == detection);
    scenario.detection.detectors = Detectors::of(&[Method::FcdVelocity]);
    let without = run(&scenario);
    assert!(without.detection().is_none() && without.judged.first(Method::FcdVelocity).is_some());
}
