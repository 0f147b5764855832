//! What the detectors reach on a robot that is not calibrated: simulated, and held with the interval of its counts.

use centrode_core::detect::Method;
use centrode_core::scenario::preset::find;
use centrode_core::study::Job;
use centrode_core::study::compare::{At, Compare, Comparison, Spec, with};

/// Calibration errors of the prior's sizes, drawn anew in each repeat, in a loop that runs as fast as the tracker.
const MISCALIBRATED: &[&str] = &[
    "loop_rate=100",
    "filter.length=50",
    "calibration.draw=drawn",
    "calibration.frame=[0.001, 0.001, 0.001]",
    "calibration.frame_turn=[0.01745, 0.01745, 0.01745]",
    "calibration.length=0.02",
    "calibration.bend_scale=0.02",
    "calibration.bend_offset=0.01745",
    "calibration.delta=0.0349",
    "calibration.latency=0.01",
];
const LO: [&str; 2] = ["tracker.position_noise=5e-5", "tracker.orientation_noise=1.745329e-4"];
const HI: [&str; 2] = ["tracker.position_noise=5e-4", "tracker.orientation_noise=1.745329e-3"];

fn compared(preset: &str, sets: &[&str], repeats: usize, places: bool) -> Comparison {
    let mut draft = find(preset).and_then(|preset| preset.draft()).expect(preset);
    MISCALIBRATED.iter().chain(sets).for_each(|set| draft.set(set).expect(set));
    if !places {
        draft.set("estimation.estimators=[]").expect("none");
    }
    let scenario = with(&draft.finish().expect("valid"), &[Method::Cusum]);
    let spec = Spec { scenario, repeats, rate: 0.01, detector: Method::Cusum, after: vec![0.1, 0.25, 0.5] };
    let mut compare = Compare::new(spec).expect("possible");
    compare.finish();
    compare.comparison()
}

fn own(comparison: &Comparison) -> &At {
    comparison.detectors[0].own.as_ref().expect("on")
}

/// Whether a count may be one of a share of at most `most`.
fn at_most(at: &At, most: f64) -> bool {
    at.false_alarms.low <= most
}

#[test]
fn contacts_are_found_within_hundredths_of_a_second_by_a_robot_that_is_not_calibrated() {
    for (noise, medians, ninety) in [(LO, [0.08, 0.05, 0.04], [0.10, 0.07, 0.06]), (HI, [0.37, 0.22, 0.17], [1.0; 3])] {
        for (disk, preset) in ["disk-1", "bench", "disk-3"].into_iter().enumerate() {
            let comparison = compared(preset, &noise, 200, false);
            let at = own(&comparison);
            assert!(at_most(at, 0.02) && at.found.high >= 0.98, "{preset}: {at:?}");
            let late = 1e-9;
            assert!(at.median <= medians[disk] + late && at.ninety <= ninety[disk] + late, "{preset}: {at:?}");
            // No test is faster that has as few false alarms.
            let bound = comparison.bound.as_ref().expect("a contact");
            assert!(bound.median <= at.median + 1e-9 && bound.median > 0.0, "{preset}: {bound:?} {at:?}");
            assert!(comparison.white.count >= 196 && comparison.white.of == 200, "{preset}: {:?}", comparison.white);
        }
    }
}

#[test]
fn a_place_has_an_interval_that_is_true() {
    // Limits as root mean squares (mm) at 0.1, 0.25 and 0.5 s.
    let (clamp, both) = ("estimation.plants=[\"clamp\"]", "estimation.plants=[\"clamp\", \"plane\"]");
    for (preset, kind, plants, limits) in [
        ("disk-1", "clamp", clamp, [1.0, 0.45, 0.20]),
        ("bench", "clamp", clamp, [1.25, 0.45, 0.20]),
        ("disk-3", "clamp", clamp, [1.35, 0.45, 0.20]),
        ("disk-1", "plane", both, [f64::INFINITY, f64::INFINITY, 1.1]),
        ("bench", "plane", both, [f64::INFINITY, f64::INFINITY, 0.7]),
        ("disk-3", "plane", both, [f64::INFINITY, f64::INFINITY, 0.25]),
    ] {
        let kind_set = format!("contact.kind={kind}");
        let comparison = compared(preset, &[LO[0], LO[1], &kind_set, plants], 150, true);
        assert_eq!(comparison.places.len(), 3, "{preset} {kind}");
        for (place, limit) in comparison.places.iter().zip(limits) {
            // What so many repeats leave open of a root mean square: two of its standard errors.
            let room = 1.0 + 2.0 / (2.0 * place.count as f64).sqrt();
            assert!(place.rms * 1e3 <= limit * room, "{preset} {kind}: {place:?}");
            let coverage = place.coverage.expect("an interval");
            let least = if kind == "plane" { 0.90 } else { 0.92 };
            assert!(coverage.high >= least && coverage.rate >= least - 0.03, "{preset} {kind}: {place:?}");
            assert!(coverage.low <= 0.98 && place.count > 140, "{preset} {kind}: {place:?}");
            let bound = place.bound.expect("after the contact");
            assert!(kind == "plane" || place.rms * room > bound, "{preset}: {place:?}");
        }
    }
}

#[test]
fn a_place_between_those_that_are_tried_at_first_is_nearly_as_good() {
    // A tracker so good that its posterior is narrower than the first grid, and what is of second order in the calibration shows.
    let tracker = ["tracker.position_noise=1e-5", "tracker.orientation_noise=3e-5"];
    let at = "contact.arc_length=0.01505";
    let comparison = compared("bench", &[tracker[0], tracker[1], "estimation.plants=[\"clamp\"]", at], 60, true);
    for place in &comparison.places {
        let (bound, coverage) = (place.bound.expect("after"), place.coverage.expect("an interval"));
        assert!(place.rms > 0.7 * bound && place.rms < 1.6 * bound, "{place:?}");
        assert!(coverage.rate > 0.7, "{place:?}");
    }
}

#[test]
fn play_colour_and_drift_alarm_only_who_does_not_reckon_with_them() {
    let compare = |sets: [&str; 2]| compared("bench", &[LO[0], LO[1], sets[0], sets[1]], 200, false);
    for (truth, reckoned, most, ignored, least) in [
        ("calibration.play=0.0349", "prior.free_bend=0.0349", 0.03, "prior.free_bend=0", 0.9),
        ("calibration.colour=0.5", "prior.colour=auto", 0.02, "prior.colour=0", 0.25),
        ("calibration.drift=0.0001", "prior.drift=0.0001", 0.02, "prior.drift=0", 0.25),
    ] {
        let (good, bad) = (compare([truth, reckoned]), compare([truth, ignored]));
        assert!(at_most(own(&good), most), "{reckoned}: {:?}", own(&good));
        assert!(own(&bad).false_alarms.low > least, "{ignored}: {:?}", own(&bad));
        // Whoever tests innovations is told so.
        assert!(good.white.count >= 196, "{reckoned}: {:?}", good.white);
        assert!(bad.white.count < 100, "{ignored}: {:?}", bad.white);
    }
}

#[test]
fn an_alarm_of_the_paper_is_placed_by_the_posterior_too() {
    let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("preset");
    (scenario.loop_rate, scenario.filter.length) = (100.0, 50);
    let scenario = with(&scenario, &[Method::Fcd]);
    let spec = Spec { scenario, repeats: 4, rate: 0.3, detector: Method::Fcd, after: vec![0.0] };
    let mut compare = Compare::new(spec).expect("possible");
    while !compare.progress().is_complete() {
        compare.step();
    }
    let comparison = compare.comparison();
    let names: Vec<&str> = comparison.detectors.iter().map(|compared| compared.detector).collect();
    let placed: Vec<_> = comparison.places.iter().map(|place| (place.estimator, place.count)).collect();
    assert_eq!((names, placed), (vec!["fcd"], vec![("marginal", 4)]));
}

#[test]
fn a_comparison_that_cannot_be_made_says_why() {
    let spec = |preset: &str| {
        let scenario = find(preset).and_then(|preset| preset.scenario()).expect(preset);
        Spec { scenario, repeats: 10, rate: 0.01, detector: Method::Cusum, after: vec![0.0] }
    };
    let refused = |spec: Spec| Compare::new(spec).err().map(|error| error.to_string()).expect("impossible");
    assert!(refused(spec("free")).contains("nothing to find"));
    assert!(refused(Spec { repeats: 0, ..spec("bench") }).contains("repeats = 0"));
    assert!(refused(Spec { rate: 1.0, ..spec("bench") }).contains("rate = 1"));
    let none = with(&spec("bench").scenario, &[]);
    assert!(refused(Spec { scenario: none, ..spec("bench") }).contains("no detector"));
}
