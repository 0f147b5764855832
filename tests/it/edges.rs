//! The calibration filter at the edge of what it is made for: no noise, rounding, robots beyond belief, too short a rest.

use centrode_core::detect::estimates::Estimated;
use centrode_core::detect::{Judged, Method, Settings, judge};
use centrode_core::record::Recording;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::{Detectors, Estimated as Noise, Place, Scenario, Start, Threshold};

/// The default scenario, whose tracker has no noise, with a contact on a disk at a time (s).
fn exact(disk: u64, time: f64) -> Scenario {
    let mut scenario = Scenario::default();
    scenario.detection.detectors = Detectors::of(&[Method::Cusum]);
    scenario.contact.place = Place::disk(disk);
    scenario.contact.start = Start::Time(time);
    scenario
}

fn placed(run: &Run, after: f64) -> Estimated {
    let estimates = run.judged.estimates(&run.recording, Method::Cusum, &[after]);
    estimates.into_iter().next().expect("placed")
}

#[test]
fn a_tracker_without_noise_is_the_best_of_all() {
    for disk in 1..=3 {
        for time in [4.5, 5.2, 5.8, 6.4] {
            let run = simulate(&exact(disk, time)).expect("possible");
            let what = format!("disk {disk} at {time} s");
            let noise = run.judged.watched.as_ref().expect("watched").model.noise;
            assert_eq!(noise.colour, 0.0, "{what}: rounding has no colour");
            let event = run.judged.first(Method::Cusum).expect("an alarm");
            let delay = event.raised - run.contact_time().expect("met");
            assert!((0.0..0.15).contains(&delay) && event.cleared.is_none(), "{what}: {event:?}");
            let (place, truth) = (placed(&run, 0.5).location, run.plan.contact().expect("one").arc_length);
            assert!((place.mean - truth).abs() < 0.5e-3, "{what}: {place:?}");
        }
    }
}

#[test]
fn steps_of_the_tracker_are_noise_and_not_contacts() {
    let mut scenario = exact(0, 5.8);
    (scenario.contact.place, scenario.tracker.position_resolution) = (Place::Nowhere, 1e-5);
    scenario.tracker.orientation_resolution = 0.01_f64.to_radians();
    let run = simulate(&scenario).expect("possible");
    assert_eq!(run.judged.first(Method::Cusum), None);
    let noise = run.judged.watched.as_ref().expect("watched").model.noise;
    assert!(noise.orientation > 0.0028_f64.to_radians(), "{noise:?}");
}

#[test]
fn no_place_lies_off_the_backbone_however_wrong_the_robot_is() {
    let wrong: [fn(&mut Scenario); 4] = [
        |scenario| scenario.calibration.latency = 1.0,
        |scenario| scenario.calibration.play = 1.0,
        |scenario| scenario.calibration.bend_scale = 0.3,
        |scenario| scenario.calibration.frame = [0.05, 0.0, 0.0],
    ];
    let mut refused = 0;
    for wrong in wrong {
        let mut scenario = exact(2, 5.8);
        scenario.tracker.position_noise = 5e-5;
        scenario.tracker.orientation_noise = 2e-4;
        wrong(&mut scenario);
        let run = simulate(&scenario).expect("possible");
        let estimates = run.judged.estimates(&run.recording, Method::Cusum, &[0.0, 0.1, 0.5]);
        refused += 3 - estimates.len();
        for estimate in estimates {
            let place = estimate.location;
            let ordered = 0.0 <= place.low && place.low <= place.mean && place.mean <= place.high;
            assert!(ordered && place.high <= 1.1 * run.segment().length, "{place:?}");
        }
    }
    assert!(refused > 0, "some are beyond belief");
}

#[test]
fn a_time_that_adds_up_to_a_reading_s_holds_that_reading() {
    let run = simulate(&exact(2, 5.8)).expect("possible");
    let watched = run.judged.watched.as_ref().expect("watched");
    for (k, arrived) in watched.readings.arrived.iter().enumerate().skip(10) {
        // As a person adds it up.
        let (before, after) = (watched.readings.arrived[k - 10], 0.1);
        assert_eq!(watched.at(before + after), Some(k), "{before} + {after} is {arrived}");
    }
}

#[test]
fn a_likelihood_ratio_that_is_switched_on_for_its_places_alone_has_its_bank() {
    let scenario = exact(2, 5.8);
    let run = simulate(&scenario).expect("possible");
    let mut settings = run.judged.settings.clone();
    settings.thresholds.detectors.set(Method::Glr, true);
    let judged = judge(&run.recording, &settings);
    assert!(judged.first(Method::Glr).is_some());
}

#[test]
fn contacts_are_dated_by_when_readings_were_taken() {
    for latency in [0.0, 0.1, 0.3] {
        let mut scenario = exact(2, 5.8);
        scenario.tracker.latency = latency;
        let run = simulate(&scenario).expect("possible");
        let began = placed(&run, 0.5).contact_time.expect("dated");
        let truth = run.contact_time().expect("met");
        assert!((began - truth).abs() < 0.02, "{latency} s late: {began} s, in truth {truth} s");
    }
}

#[test]
fn noise_that_could_not_be_measured_is_said_to_be_taken_on_trust() {
    let mut scenario = exact(2, 5.8);
    scenario.detection.cusum = Threshold::On(9.3);
    let run = simulate(&scenario).expect("possible");
    assert!(!run.judged.noise_unmeasured());
    let from = run.recording.entries.partition_point(|entry| entry.time < 4.5);
    let cut = Recording { entries: run.recording.entries[from..].to_vec(), ..run.recording.clone() };
    let judged = |settings: &Settings| -> Judged { judge(&cut, settings) };
    let mut settings = run.judged.settings.clone();
    assert!(judged(&settings).noise_unmeasured());
    settings.watching.noise = [Noise::Known(1e-5), Noise::Known(1e-5), Noise::Known(0.0)].map(|known| known.value());
    assert!(!judged(&settings).noise_unmeasured());
}
