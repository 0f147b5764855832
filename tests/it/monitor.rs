//! The calibration filter on a stream and on a whole recording, with gaps, and where the commands are not known.

use centrode_core::detect::estimates::marginal;
use centrode_core::detect::{Judged, Method, Settings, judge};
use centrode_core::model::Vec3;
use centrode_core::record::Recording;
use centrode_core::record::log::{Commands, Log, Options, Setup, assemble};
use centrode_core::run::{Anew, Replay, Run, Simulation, simulate};
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Detectors, Estimated, Place, Plan, Scenario};

fn preset(name: &str) -> Scenario {
    let mut scenario = find(name).and_then(|preset| preset.scenario()).expect(name);
    scenario.detection.detectors = Detectors::of(&[Method::Fcd, Method::Cusum, Method::Glr]);
    scenario
}

/// The statistics of the filter's detectors, bit for bit.
fn bits(judged: &Judged) -> Vec<[u64; 2]> {
    judged
        .evidence
        .iter()
        .map(|evidence| [evidence.judgement.cusum, evidence.judgement.glr].map(f64::to_bits))
        .collect()
}

#[track_caller]
fn assert_stream_is_run(scenario: &Scenario, what: &str) {
    let run = simulate(scenario).expect("possible");
    let mut stream = Simulation::new(&run.plan);
    let streamed: Vec<_> = stream.by_ref().map(|x| [x.judgement.cusum, x.judgement.glr].map(f64::to_bits)).collect();
    let kept = bits(&run.judged);
    let first = streamed.iter().zip(&kept).position(|(a, b)| a != b);
    assert_eq!((streamed.len(), first), (kept.len(), None), "{what}");
    assert_eq!(stream.events(), run.events(), "{what}");
    assert_eq!(stream.watched().map(|watched| watched.model), run.judged.watched.as_ref().map(|x| x.model), "{what}");
    assert!(run.judged.evidence.iter().any(|x| x.judgement.cusum > 1.0 && x.judgement.glr > 1.0), "{what}: nothing");
}

#[test]
fn a_stream_and_a_recording_have_the_same_statistics_to_the_last_bit() {
    let known = |value| Estimated::Known(value);
    for name in ["bench", "paper", "touch-2"] {
        for latency in [0.0, 0.013] {
            for given in [false, true] {
                let mut scenario = preset(name);
                scenario.tracker.latency = latency;
                if given {
                    let prior = &mut scenario.prior;
                    (prior.position_noise, prior.orientation_noise) = (known(1e-4), known(1e-3));
                    prior.colour = known(0.1);
                }
                assert_stream_is_run(&scenario, &format!("{name}, latency {latency} s, noise given: {given}"));
            }
        }
    }
    for latency in [0.0, 0.013] {
        let mut scenario = preset("bench");
        (scenario.tracker.rate, scenario.tracker.latency) = (90.0, latency);
        assert_stream_is_run(&scenario, "90 Hz");
        scenario.motion.start = 0.0;
        assert_stream_is_run(&scenario, "90 Hz, moving from the start");
    }
}

#[test]
fn without_a_still_stretch_the_noise_is_the_declared_one() {
    let mut scenario = preset("bench");
    (scenario.tracker.position_noise, scenario.tracker.orientation_noise) = (2e-4, 6e-4);
    scenario.motion.start = 0.0;
    assert_stream_is_run(&scenario, "moving from the start");
    let noise = |scenario: &Scenario| {
        let run = simulate(scenario).expect("possible");
        run.judged.watched.expect("watched").model.noise
    };
    let declared = noise(&scenario);
    assert_eq!([declared.position, declared.orientation, declared.colour], [2e-4, 6e-4, 0.0]);
    scenario.motion.start = 3.0;
    let measured = noise(&scenario).position;
    assert!(measured != 2e-4 && (measured / 2e-4 - 1.0).abs() < 0.15, "{measured}");
}

#[test]
fn the_filter_goes_on_after_a_gap() {
    let whole = simulate(&preset("bench")).expect("possible");
    let alarm = whole.judged.first(Method::Cusum).expect("an alarm").raised;
    let gap = |from: usize, to: usize| {
        let mut recording = Recording { truth: None, ..whole.recording.clone() };
        for entry in &mut recording.entries[from..to] {
            entry.reading.position = Vec3::repeat(f64::NAN);
            entry.reading.angles = [f64::NAN; 3];
        }
        recording
    };
    let placed = |judged: &Judged, recording: &Recording| {
        judged.estimates(recording, Method::Cusum, &[0.5]).first().expect("placed").location
    };
    let known = placed(&whole.judged, &whole.recording);
    // Before the motion, on the way, and over the contact.
    for (from, to, late, off) in [(1000, 1500, 0.05, 1e-4), (4500, 4800, 0.05, 1e-4), (5700, 5900, 0.15, 5e-4)] {
        let recording = gap(from, to);
        let judged = judge(&recording, &Settings::of(&whole.plan));
        let replayed: Vec<_> = Replay::new(&recording, &Settings::of(&whole.plan))
            .map(|x| [x.judgement.cusum, x.judgement.glr].map(f64::to_bits))
            .collect();
        assert_eq!(replayed, bits(&judged), "{from}");
        let heard = judged.watched.as_ref().expect("watched");
        assert_eq!(heard.heard.len(), 1001 - (to - from) / 10, "{from}");
        let missing = &judged.evidence[from..to];
        let held = missing[0].judgement.cusum;
        assert!(held.is_finite() && missing.iter().all(|x| x.judgement.cusum == held), "{from}: not held");
        let again = judged.first(Method::Cusum).expect("an alarm").raised;
        assert!(again >= 5.8 && again < alarm + late, "{from}: {again} s");
        let place = placed(&judged, &recording);
        assert!((place.mean - known.mean).abs() < off && place.low < place.high, "{from}: {place:?} {known:?}");
    }
}

#[test]
fn commands_estimated_from_the_tracker_let_the_calibration_filter_rest() {
    let scenario = preset("bench");
    let simulated = simulate(&scenario).expect("possible");
    let mut text = String::from("# timestamp tx ty tz qx qy qz qw\n");
    for entry in simulated.recording.entries.iter().step_by(10) {
        let reading = &entry.reading;
        let turn = centrode_core::model::orientation::from_euler(&reading.angles);
        let q = nalgebra::UnitQuaternion::from_matrix(&turn);
        let p = reading.position;
        text += &format!("{} {} {} {} {} {} {} {}\n", entry.time, p.x, p.y, p.z, q.i, q.j, q.k, q.w);
    }
    let log = Log::read("free.tum", text.into_bytes(), &Options::default()).expect("a log");
    let judged = |commands: Option<Commands>| {
        let made = assemble(&log, &scenario, &Setup { commands, ..Setup::default() }).expect("a recording");
        assert_eq!(made.recording.commanded, made.commands != Commands::Estimated);
        let judged = judge(&made.recording, &Settings::of(&made.plan));
        (made, judged)
    };
    let (made, told) = judged(Some(Commands::Motion));
    assert!(told.settings.watches() && told.first(Method::Cusum).is_some() && told.first(Method::Glr).is_some());
    assert!(!told.estimates(&made.recording, Method::Fcd, &[0.0]).is_empty());

    let (made, silent) = judged(None);
    assert_eq!(made.commands, Commands::Estimated);
    assert!(!silent.settings.watches() && silent.watched.is_none() && silent.whiteness().is_none());
    assert!(silent.evidence.iter().all(|x| x.judgement.cusum.is_nan() && x.judgement.glr.is_nan()));
    assert!(silent.first(Method::Cusum).is_none() && silent.first(Method::Glr).is_none());
    assert!(silent.first(Method::Fcd).is_some(), "the centrode judges nevertheless");
    assert!(silent.estimates(&made.recording, Method::Fcd, &[0.0]).is_empty(), "no marginal estimate");
    let replayed = Replay::new(&made.recording, &Settings::of(&made.plan));
    assert!(replayed.into_iter().all(|x| x.judgement.cusum.is_nan() && x.judgement.glr.is_nan()));

    // Nor when it is judged once more, by a plan that knows nothing of the log.
    let mut run = Run::recorded(made.plan, made.recording).expect("entries");
    let mut changed = scenario.clone();
    changed.filter.length = 250;
    assert_eq!(run.update(Plan::new(&changed).expect("possible")), Anew::Evidence);
    assert!(run.judged.watched.is_none() && run.samples().all(|x| x.judgement.cusum.is_nan()));
    assert!(told.watched.is_some_and(|watched| marginal(&watched, &told.settings.placing, 6.0, 6.5).is_some()));
}

#[test]
fn what_is_expected_beforehand_does_not_depend_on_how_often_the_tracker_reads() {
    // A tracker that sees nothing: what is left is how long the robot has moved.
    let last = |rate: f64| {
        let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("preset");
        scenario.detection.detectors.set(Method::Cusum, true);
        scenario.contact.place = Place::Nowhere;
        scenario.tracker.rate = rate;
        scenario.prior.position_noise = Estimated::Known(1.0);
        scenario.prior.orientation_noise = Estimated::Known(3.0);
        let run = simulate(&scenario).expect("a run");
        let moves = scenario.motion.finish - scenario.motion.start;
        let watched = run.judged.watched.as_ref().expect("watched");
        let contact = watched.heard.last().expect("a reading").contact;
        assert!((contact - (1.0 - (-0.1 * moves).exp())).abs() < 0.01, "{rate} Hz: {contact}");
        contact
    };
    let [slow, fast] = [100.0, 1000.0].map(last);
    assert!((slow - fast).abs() < 1e-3, "{slow} and {fast}");
}
