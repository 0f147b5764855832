//! A contact that is left again, and the next one, in a log of a robot that is not calibrated.

use centrode_core::detect::{Method, Settings, judge};
use centrode_core::model::contact::{clamped_tip, free_tip};
use centrode_core::model::orientation::from_vector;
use centrode_core::model::{Mat3, Vec3};
use centrode_core::noise::{Normal, Source};
use centrode_core::plant::Happening;
use centrode_core::record::log::{Log, Options, Setup, assemble};
use centrode_core::run::simulate;
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{ContactKind, Detectors, Estimated, Estimator, Mounting, Scenario, Start};
use centrode_core::study::report::Conclusions;
use std::fmt::Write;

const LENGTH: f64 = 0.030;
/// Bend at which the robot is held (rad), and where, in units of L: the first time, and the second.
const MET: f64 = 0.6;
const PLACES: [f64; 2] = [0.5, 0.7];

/// Up to 1 rad, back to 0.3 and up to 1.3, with rests between.
fn bend(time: f64) -> f64 {
    let smooth = |from: f64, until: f64| {
        let u = ((time - from) / (until - from)).clamp(0.0, 1.0);
        u * u * u * (10.0 + u * (6.0 * u - 15.0))
    };
    smooth(2.0, 6.0) - 0.7 * smooth(7.0, 10.0) + smooth(11.0, 15.0)
}

/// The first instant (s) after `from` at which the bend has passed [`MET`] upward.
fn met(from: u32) -> f64 {
    let times = (from * 1000..).map(|k| f64::from(k) / 1000.0);
    times.into_iter().find(|time| bend(*time) > MET).expect("passed")
}

/// What a tracker at 100 Hz reads, with noise of 0.05 mm and 0.01°, in a frame that is a millimetre and a degree off.
fn log(places: [f64; 2]) -> Log {
    let mut random = Normal::new(5, Source::Tracker);
    let (shift, turn) = (Vec3::new(1e-3, -5e-4, 8e-4), from_vector(&Vec3::new(0.01, 0.017, -0.008)));
    let mut text = String::from("time,x,y,z,rx,ry,rz,theta_l,delta\n");
    for k in 0..1700_u32 {
        let time = f64::from(k) / 100.0;
        let bend = bend(time);
        let place = places[usize::from(time > 8.5)];
        let tip = if bend > MET { clamped_tip(place, MET, bend) } else { free_tip(bend) } * LENGTH;
        let noise = |random: &mut Normal, size: f64| Vec3::new(random.draw(), random.draw(), random.draw()) * size;
        let (sin, cos) = bend.sin_cos();
        let tangent = Mat3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos);
        let position = turn * Vec3::new(tip.x, 0.0, tip.y) + shift + noise(&mut random, 5e-5);
        let jitter = from_vector(&noise(&mut random, 0.01_f64.to_radians()));
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(jitter * turn * tangent).scaled_axis();
        let theta_l = std::f64::consts::FRAC_PI_2 - bend;
        let (p, r) = (position, rotation);
        writeln!(text, "{time},{},{},{},{},{},{},{theta_l},0", p.x, p.y, p.z, r.x, r.y, r.z).expect("memory");
    }
    Log::read("there-and-back.csv", text.into_bytes(), &Options::default()).expect("a log")
}

fn scenario() -> Scenario {
    let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("bench");
    scenario.loop_rate = 100.0;
    scenario.filter.length = 50;
    scenario.tracker.mounting = Mounting::Aligned;
    scenario.prior.position_noise = Estimated::Known(5e-5);
    scenario.prior.orientation_noise = Estimated::Known(0.01_f64.to_radians());
    scenario.prior.colour = Estimated::Known(0.0);
    scenario.detection.detectors = Detectors::of(&[Method::Cusum, Method::Glr]);
    scenario
}

#[test]
fn a_release_is_noticed_and_the_next_contact_is_an_event_with_its_own_place() {
    let scenario = scenario();
    let made = assemble(&log(PLACES), &scenario, &Setup::default()).expect("a recording");
    let judged = judge(&made.recording, &Settings::of(&made.plan));
    let left = (7..11).map(f64::from).find(|time| bend(*time) < MET).expect("back");
    let events: Vec<_> = judged.events.iter().filter(|event| event.detector == Method::Cusum).collect();
    let [first, second] = events[..] else { panic!("{events:?}") };
    let soon = |raised: f64, met: f64| (0.0..0.1).contains(&(raised - met));
    assert!(soon(first.raised, met(2)) && soon(second.raised, met(11)), "{events:?}");
    assert!(first.cleared.is_some_and(|cleared| cleared < left + 0.5) && second.cleared.is_none(), "{events:?}");
    // Who looks for young contacts alone forgets a held one at rest, but is as fast with the next.
    let again = judged.events.iter().rfind(|event| event.detector == Method::Glr).expect("both");
    assert!(soon(again.raised, met(11)), "{again:?}");

    let conclusions = Conclusions::of(&judged, &made.recording, Method::Cusum, &[0.1, 0.5]);
    let [next] = &conclusions.next_estimates[..] else { panic!("one more") };
    assert_eq!(next.raised, second.raised);
    for (estimates, share, began) in
        [(&conclusions.estimates, PLACES[0], met(2)), (&next.estimates, PLACES[1], met(11))]
    {
        let marginal: Vec<_> = estimates.iter().filter(|x| x.estimator == Estimator::Marginal).collect();
        let [early, late] = marginal[..] else { panic!("{estimates:?}") };
        for estimate in [early, late] {
            let (place, found) = (share * LENGTH, estimate.location);
            assert!(found.low < place && place < found.high, "{share}: {estimate:?}");
            assert!((estimate.contact_time.expect("it says") - began).abs() < 0.05, "{estimate:?}");
        }
        assert!(late.location.high - late.location.low < 1.5e-3, "{late:?}");
        // The frame was found before the first contact, and is not mistaken for what the first contact did.
        let shift = late.calibration.expect("it says").frame[0];
        assert!((shift.mean - 1e-3).abs() < 4.0 * shift.deviation + 5e-5, "{shift:?}");
    }
}

#[test]
fn a_contact_that_holds_is_not_taken_for_one_that_has_been_left() {
    let noises = [None, Some((5e-5, 0.01_f64)), Some((2e-4, 0.04)), Some((5e-4, 0.1))];
    for (name, kind) in [("disk-1", ContactKind::Clamp), ("disk-1", ContactKind::Plane), ("bench", ContactKind::Plane)]
    {
        for (noise, finish) in [(0, 8.0), (1, 8.0), (2, 8.0), (3, 8.0), (2, 33.0), (3, 33.0)] {
            for seed in 1..=8 {
                let mut scenario = find(name).and_then(|preset| preset.scenario()).expect(name);
                (scenario.seed, scenario.contact.kind) = (seed, kind);
                scenario.calibration = find("miscalibrated").and_then(|x| x.scenario()).expect("preset").calibration;
                (scenario.loop_rate, scenario.filter.length) = (100.0, 50);
                scenario.contact.start = Start::Bend(0.6);
                (scenario.motion.finish, scenario.motion.end) = (finish, finish + 2.0);
                if let Some((position, orientation)) = noises[noise] {
                    scenario.tracker.position_noise = position;
                    scenario.tracker.orientation_noise = orientation.to_radians();
                }
                scenario.detection.detectors = Detectors::of(&[Method::Cusum]);
                let run = simulate(&scenario).expect("possible");
                assert!(run.plant_events().iter().all(|event| event.what == Happening::Met), "it holds to the end");
                let watched = run.judged.watched.as_ref().expect("watched");
                let left = watched.heard.iter().find_map(|heard| heard.left);
                assert!(left.is_none(), "{name} {kind:?} {noise} {finish} {seed}: {left:?}");
            }
        }
    }
}
