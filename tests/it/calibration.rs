//! The true robot against the nominal one: errors of its calibration.

use crate::support::assert_near;
use centrode_core::model::orientation::{from_euler, from_vector};
use centrode_core::model::{Mat3, Vec3};
use centrode_core::plant::{Happening, Shape};
use centrode_core::record::{Recorder, Recording};
use centrode_core::run::simulate;
use centrode_core::scenario::{Calibration, ContactKind, Draw, Mounting, Place, Plan, Scenario, Start};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// A short, coarse run without noise, with or without contact on disk 2.
fn scenario(contact: bool) -> Scenario {
    let mut scenario = Scenario { loop_rate: 50.0, ..Scenario::default() };
    scenario.filter.length = 20;
    scenario.tracker.rate = 50.0;
    if !contact {
        scenario.contact.place = Place::Nowhere;
    }
    scenario
}

fn plan(scenario: &Scenario) -> Plan {
    Plan::new(scenario).expect("possible")
}

fn recording(scenario: &Scenario) -> Recording {
    Recording::simulated(&plan(scenario))
}

fn with(calibration: Calibration, scenario: &Scenario) -> Scenario {
    Scenario { calibration, ..scenario.clone() }
}

/// The bend of a true shape that nothing holds, rad.
fn bend(shape: &Shape) -> f64 {
    let Shape::Free(arc) = shape else { panic!("held: {shape:?}") };
    arc.configuration.bend()
}

/// Every reading of two scenarios agrees within `most`, turned angles and positions (m) alike.
fn assert_same_readings(one: &Scenario, other: &Scenario, most: f64) {
    for (a, b) in recording(one).entries.iter().zip(&recording(other).entries) {
        assert!((a.reading.position - b.reading.position).norm() <= most, "{a:?}\n{b:?}");
        let (a, b) = (from_euler(&a.reading.angles), from_euler(&b.reading.angles));
        assert!((a - b).norm() <= most, "{a} {b}");
    }
}

#[test]
fn a_frame_error_moves_each_reading_rigidly() {
    let nominal = scenario(true);
    let (frame, frame_turn) = ([0.001, -0.002, 0.0005], [0.02, 0.05, -0.03]);
    let moved = with(Calibration { frame, frame_turn, ..Calibration::default() }, &nominal);
    let turn: Mat3 = from_vector(&frame_turn.into());
    let (nominal, moved) = (recording(&nominal), recording(&moved));
    for (a, b) in nominal.entries.iter().zip(&moved.entries) {
        assert_near(&b.reading.position, &(turn * a.reading.position + Vec3::from(frame)), 1e-16, "position");
        assert!((from_euler(&b.reading.angles) - turn * from_euler(&a.reading.angles)).norm() < 1e-12);
        assert_eq!(a.tau_lc, b.tau_lc, "the load cells know no frame");
    }
    assert_eq!(nominal.truth, moved.truth);
}

#[test]
fn a_length_error_is_another_length_of_the_plant() {
    for kind in [None, Some(ContactKind::Clamp), Some(ContactKind::Plane), Some(ContactKind::Cylinder)] {
        for length in [-0.15, 0.04] {
            let mut nominal = scenario(kind.is_some());
            nominal.contact.kind = kind.unwrap_or_default();
            let mut other = nominal.clone();
            other.robot.length *= 1.0 + length;
            let erring = with(Calibration { length, ..Calibration::default() }, &nominal);
            assert_eq!(recording(&erring), recording(&other), "{kind:?} {length}");
        }
    }
}

#[test]
fn errors_of_the_bend_are_another_motion() {
    for contact in [false, true] {
        let nominal = scenario(contact);
        let (bend_scale, bend_offset) = (-0.04, 0.05);
        let erring = with(Calibration { bend_scale, bend_offset, ..Calibration::default() }, &nominal);
        let mut other = nominal.clone();
        let truly = |theta_l: f64| FRAC_PI_2 - ((1.0 + bend_scale) * (FRAC_PI_2 - theta_l) + bend_offset);
        other.motion.theta_start = truly(nominal.motion.theta_start);
        other.motion.theta_end = truly(nominal.motion.theta_end);
        assert_same_readings(&erring, &other, 1e-12);
        let (erring, other) = (recording(&erring), recording(&other));
        for (a, b) in erring.entries.iter().zip(&other.entries) {
            assert_near(&a.tau_lc, &b.tau_lc, 1e-9, "load cells");
        }
        assert_eq!(erring.contact_time(), other.contact_time());
        assert_ne!(erring.entries[0].configuration, other.entries[0].configuration, "commands stay what they are");
    }
}

#[test]
fn an_error_of_the_direction_is_another_direction() {
    let mut nominal = scenario(true);
    nominal.tracker.mounting = Mounting::Aligned;
    // Off the singular orientation of that mounting.
    (nominal.motion.delta, nominal.motion.theta_end) = (0.3, 0.2);
    let erring = with(Calibration { delta: 0.07, ..Calibration::default() }, &nominal);
    let mut other = nominal.clone();
    other.motion.delta = 0.3 + 0.07;
    assert_same_readings(&erring, &other, 1e-15);
    assert_eq!(recording(&erring).truth, recording(&other).truth);
}

#[test]
fn an_error_of_the_latency_is_another_latency_and_never_a_look_ahead() {
    let mut nominal = scenario(true);
    for (latency, error, age) in [(0.1, 0.05, 0.15000000000000002), (0.1, -0.04, 0.1 - 0.04), (0.01, -0.3, 0.0)] {
        nominal.tracker.latency = latency;
        let erring = with(Calibration { latency: error, ..Calibration::default() }, &nominal);
        let mut other = nominal.clone();
        other.tracker.latency = age;
        assert_eq!(recording(&erring).entries, recording(&other).entries, "{latency} {error}");
    }
}

#[test]
fn play_lets_the_true_bend_follow_behind_by_its_size() {
    for back in [false, true] {
        let mut erring = scenario(false);
        if back {
            std::mem::swap(&mut erring.motion.theta_start, &mut erring.motion.theta_end);
        }
        erring.calibration.play = 0.06;
        let (start, toward) = if back { (FRAC_PI_2, -1.0) } else { (0.0, 1.0) };
        let recorded = recording(&erring);
        let (mut rested, mut followed) = (0, 0);
        for (entry, truth) in recorded.entries.iter().zip(recorded.truth.iter().flatten()) {
            let (commanded, truly) = (entry.configuration.bend(), bend(&truth.shape));
            if (commanded - start).abs() <= 0.06 {
                assert_eq!(truly, start);
                rested += usize::from(commanded != start);
            } else {
                assert_near_number(truly, commanded - toward * 0.06);
                followed += 1;
            }
        }
        assert!(rested > 10 && followed > 100, "{rested} {followed}");
        // Asked for in any order, the plant answers the same.
        let plan = plan(&erring);
        let plant = centrode_core::plant::Plant::new(&plan);
        for (entry, truth) in recorded.entries.iter().rev().zip(recorded.truth.iter().flatten().rev()) {
            assert_eq!(plant.shape(entry.configuration), truth.shape);
        }
    }
}

fn assert_near_number(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-15, "{a} {b}");
}

#[test]
fn a_contact_by_time_begins_at_that_command_and_one_by_bend_at_that_true_bend() {
    let mut erring = scenario(true);
    erring.loop_rate = 1000.0;
    let begins = |scenario: &Scenario| {
        let run = simulate(scenario).expect("possible");
        let met = *run.plant_events().iter().find(|event| event.what == Happening::Met).expect("met");
        (met.time, met.bend, run.plan.true_robot().bend(run.commanded(run.place(met.time)).bend()))
    };
    let nominal = begins(&erring);
    erring.calibration = Calibration { bend_scale: 0.03, bend_offset: 0.02, play: 0.01, ..Calibration::default() };
    let by_time = begins(&erring);
    assert_eq!(by_time.0, nominal.0);
    assert!(by_time.1 > nominal.1 && by_time.2 > by_time.1 && by_time.2 - by_time.1 < 1e-3, "{by_time:?}");
    erring.contact.start = Start::Bend(nominal.1);
    let by_bend = begins(&erring);
    assert!(by_bend.0 < nominal.0, "the true bend runs ahead of the command");
    assert!(by_bend.1 == nominal.1 && by_bend.2 > by_bend.1 && by_bend.2 - by_bend.1 < 1e-3, "{by_bend:?}");
}

/// Standard deviations of the default prior.
fn usual() -> Calibration {
    Calibration {
        draw: Draw::Drawn,
        frame: [0.001; 3],
        frame_turn: [PI / 180.0; 3],
        length: 0.02,
        bend_scale: 0.02,
        bend_offset: PI / 180.0,
        delta: PI / 90.0,
        latency: 0.010,
        play: 0.03,
        ..Calibration::default()
    }
}

/// The errors of a plan beside their standard deviations.
fn errors(errors: &Calibration) -> [f64; 11] {
    let Calibration { frame: [x, y, z], frame_turn: [a, b, c], .. } = *errors;
    [x, y, z, a, b, c, errors.length, errors.bend_scale, errors.bend_offset, errors.delta, errors.latency]
}

#[test]
fn drawn_errors_have_the_spread_that_is_asked_for() {
    const SEEDS: u64 = 400;
    let base = plan(&with(usual(), &scenario(true)));
    let drawn: Vec<_> = (0..SEEDS).map(|seed| errors(base.with_seed(seed).true_robot().errors())).collect();
    for (k, size) in errors(&usual()).into_iter().enumerate() {
        let of = |power| drawn.iter().map(|errors| (errors[k] / size).powi(power)).sum::<f64>() / SEEDS as f64;
        let (mean, square) = (of(1), of(2));
        // Four standard errors of a mean and of a variance over 400 draws.
        assert!(mean.abs() < 0.2 && (square - 1.0).abs() < 4.0 * (2.0_f64 / 400.0).sqrt(), "{k}: {mean} {square}");
        assert!(drawn.iter().all(|errors| errors[k].abs() <= 4.0 * size));
    }
    for (k, one) in drawn.iter().enumerate() {
        assert!(drawn[..k].iter().all(|other| other != one), "seed {k} repeats another");
        assert_eq!(*one, errors(base.with_seed(k as u64).true_robot().errors()));
    }
    let robot = *base.with_seed(7).true_robot();
    assert_eq!(robot.errors().play, 0.03, "a size in either case");
    let same = with(Calibration { delta: 0.0, ..usual() }, &Scenario { seed: 7, ..scenario(true) });
    let same = plan(&same);
    assert_eq!(same.true_robot().errors().length, robot.errors().length, "each has a draw of its own");
    assert_eq!(same.true_robot().errors().latency, robot.errors().latency);
}

#[test]
fn a_seed_gives_the_plan_that_it_would_have_been_made_with() {
    for kind in [ContactKind::Clamp, ContactKind::Plane] {
        let mut base = with(usual(), &scenario(true));
        base.contact.kind = kind;
        let seeded = plan(&base).with_seed(99);
        base.seed = 99;
        assert_eq!(seeded, plan(&base));
        assert_ne!(seeded.contacts(), plan(&scenario(true)).contacts());
        assert_eq!(seeded.segment(), plan(&scenario(true)).segment(), "the model knows nothing of it");
    }
}

#[test]
fn errors_that_leave_no_robot_are_refused_by_name() {
    let mut reaching = scenario(true);
    reaching.contact.place = Place::ArcLength(0.0295);
    let mut round = scenario(true);
    round.contact.kind = ContactKind::Cylinder;
    let full = {
        let mut full = scenario(false);
        full.motion.theta_end = FRAC_PI_2 - 6.0;
        full
    };
    let default = Calibration::default();
    for (base, calibration, key) in [
        (&reaching, Calibration { length: -0.05, ..default }, "calibration.length = -0.05"),
        (&reaching, Calibration { length: 0.01, draw: Draw::Drawn, ..default }, "calibration.length = 0.01"),
        (&full, Calibration { bend_scale: 0.06, ..default }, "calibration.bend_scale = 0.06"),
        (&full, Calibration { bend_offset: 0.3, ..default }, "calibration.bend_offset = 0.3"),
        (&full, Calibration { bend_offset: -0.1, draw: Draw::Drawn, ..default }, "calibration.bend_offset = -0.1"),
        (&round, Calibration { length: 0.2, draw: Draw::Drawn, ..default }, "calibration.length = 0.2"),
        (&round, Calibration { latency: 2.0, ..default }, "calibration.latency = 2 "),
        (&round, Calibration { colour: 1.0, ..default }, "calibration.colour = 1 "),
        (&round, Calibration { drift_time: 0.0, ..default }, "calibration.drift_time = 0 "),
        (&round, Calibration { play: -0.1, ..default }, "calibration.play = -0.1"),
        (&round, Calibration { frame: [0.0, 0.0, 2.0], ..default }, "calibration.frame[2] = 2 "),
        (&round, Calibration { frame_turn: [f64::NAN, 0.0, 0.0], ..default }, "calibration.frame_turn[0] = nan"),
    ] {
        let refused = Plan::new(&with(calibration, base)).expect_err(key).to_string();
        assert!(refused.starts_with(key), "{key}: {refused}");
    }
    // The same errors are possible where nothing stands in their way.
    assert!(Plan::new(&with(Calibration { length: -0.05, ..default }, &scenario(true))).is_ok());
    assert!(Plan::new(&with(Calibration { bend_scale: -0.06, ..default }, &full)).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whatever_a_plan_lets_be_drawn_can_be_run(
        sizes in prop::array::uniform5(-0.2..0.2_f64),
        (kind, theta_end, rounding) in (0..3_usize, -3.0..4.0_f64, 0.0..0.03_f64),
        place in 0.0..0.03_f64,
        seeds in prop::collection::vec(any::<u64>(), 8),
        play in 0.0..2.0_f64,
    ) {
        let mut wild = scenario(true);
        wild.loop_rate = 5.0;
        wild.contact.place = Place::ArcLength(place);
        (wild.contact.kind, wild.contact.rounding) = (ContactKind::ALL[kind], rounding);
        wild.motion.theta_end = theta_end;
        let [length, bend_scale, bend_offset, delta, latency] = sizes;
        let draw = Draw::Drawn;
        wild.calibration =
            Calibration { draw, length, bend_scale, bend_offset, delta, latency, play, ..Calibration::default() };
        if let Ok(plan) = Plan::new(&wild) {
            for seed in seeds {
                let plan = plan.with_seed(seed);
                prop_assert!(plan.contact().is_some());
                for (entry, _) in Recorder::new(&plan) {
                    prop_assert!(entry.reading.position.iter().all(|x| x.is_finite()));
                }
            }
        }
    }
}
