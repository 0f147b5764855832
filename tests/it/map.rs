//! The detectability map against the simulation it foretells.

use centrode_core::run::Simulation;
use centrode_core::scenario::Plan;
use centrode_core::scenario::{Place, Scenario, Start};
use centrode_core::study::Job;
use centrode_core::study::map::{MapJob, largest_deviation, largest_epsilon};
use std::f64::consts::PI;

type Change = fn(&mut Scenario);

/// A scenario without noise, with a beam at a place and a bend.
fn touching(arc_length: f64, bend: f64) -> Scenario {
    let mut scenario = Scenario::default();
    scenario.contact.place = Place::ArcLength(arc_length);
    scenario.contact.start = Start::Bend(bend);
    scenario
}

/// The largest deviation that the simulation judges from contact on, m.
fn simulated(scenario: &Scenario) -> f64 {
    let plan = Plan::new(scenario).expect("valid");
    let mut touched = false;
    let judged = Simulation::new(&plan).filter(|sample| {
        touched |= sample.in_contact;
        let detection = &scenario.detection;
        touched && sample.time >= detection.armed_from && sample.judgement.speed > detection.min_speed
    });
    judged.map(|sample| sample.judgement.deviation).fold(f64::NAN, f64::max)
}

fn foretold(scenario: &Scenario) -> f64 {
    let plan = Plan::new(scenario).expect("valid");
    largest_deviation(&plan, plan.contact().expect("a beam"))
}

#[track_caller]
fn agrees(scenario: &Scenario, what: &str) {
    let (simulated, foretold) = (simulated(scenario), foretold(scenario));
    let tolerance = 0.02 * simulated + 5e-5;
    assert!((simulated - foretold).abs() < tolerance, "{what}: simulated {simulated}, foretold {foretold}");
}

#[test]
fn the_map_foretells_the_largest_deviation_of_the_simulation() {
    for arc_length in [0.002, 0.0075, 0.015, 0.0225, 0.027] {
        for degrees in [5.0f64, 30.0, 56.0, 80.0, 88.0] {
            agrees(&touching(arc_length, degrees.to_radians()), &format!("{arc_length} m at {degrees}°"));
        }
    }
}

#[test]
fn so_it_does_for_other_settings() {
    let vary: [(&str, Change); 12] = [
        ("another plane", |s| s.motion.delta = 2.1),
        ("a short filter", |s| s.filter.length = 50),
        ("a long filter", |s| s.filter.length = 1500),
        ("a filter longer than the rest before", |s| s.filter.length = 4000),
        ("latency", |s| s.tracker.latency = 0.08),
        ("armed late", |s| s.detection.armed_from = 7.0),
        ("armed from the start", |s| s.detection.armed_from = 0.0),
        ("a high floor", |s| s.detection.min_speed = 0.3),
        ("a robot of another size", |s| {
            s.robot.length = 0.06;
            s.robot.disks = vec![0.02, 0.04];
        }),
        ("a bend the other way", |s| {
            s.motion.theta_end = PI;
            s.contact.start = Start::Bend(-0.8);
        }),
        ("straightening", |s| {
            std::mem::swap(&mut s.motion.theta_start, &mut s.motion.theta_end);
            s.detection.armed_from = 3.5;
        }),
        ("a run that ends early", |s| s.motion.end = 7.0),
    ];
    for (what, change) in vary {
        let mut scenario = touching(0.0133, 0.7);
        change(&mut scenario);
        agrees(&scenario, what);
    }
}

#[test]
fn what_is_never_judged_has_no_value() {
    let mut scenario = touching(0.015, 0.7);
    scenario.detection.armed_from = 1e6;
    assert!(foretold(&scenario).is_nan() && simulated(&scenario).is_nan());
    scenario.detection.armed_from = 5.0;
    scenario.contact.start = Start::Bend(3.0);
    assert!(foretold(&scenario).is_nan(), "the bend is never reached");
    let plan = Plan::new(&scenario).expect("valid");
    assert!(largest_epsilon(&plan, plan.contact().expect("a beam")).is_nan());
}

/// Whether Θ shows the contact somewhere in the run when the cells err by `error` and ε_τ is `epsilon`.
fn shows(scenario: &Scenario, epsilon: f64, error: f64) -> bool {
    let mut scenario = scenario.clone();
    // The plant's cells err by ε_τ itself; for another error its readings are scaled.
    scenario.load_cells.epsilon_tau = 0.0;
    let plan = Plan::new(&scenario).expect("valid");
    let segment = *plan.segment();
    Simulation::new(&plan).filter(|s| s.in_contact && s.time >= scenario.detection.armed_from).any(|sample| {
        let configuration = centrode_core::model::Configuration::from_theta_l(sample.theta_l, scenario.motion.delta);
        let tau_lc = sample.tau_lc / (1.0 - error);
        segment.residual(&configuration, &tau_lc) > segment.common_error_bound(&configuration, &tau_lc, epsilon)
    })
}

#[test]
fn the_largest_epsilon_is_where_joint_forces_cease_to_show_the_contact() {
    for (arc_length, bend, delta) in [(0.0075, 0.6, 0.0), (0.015, 0.98, 0.4), (0.0225, 1.2, -1.0), (0.01, 1.5, 0.0)] {
        let mut scenario = touching(arc_length, bend);
        scenario.motion.delta = delta;
        let plan = Plan::new(&scenario).expect("valid");
        let epsilon = largest_epsilon(&plan, plan.contact().expect("a beam"));
        assert!(epsilon > 0.0 && epsilon < 1.0, "{epsilon}");
        let below = epsilon * 0.999;
        for share in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            assert!(shows(&scenario, below, share * below), "{arc_length} m: error {share} of {below}");
        }
        let above = epsilon * 1.001;
        assert!(!shows(&scenario, above, -above), "{arc_length} m at {above}");
    }
}

#[test]
fn the_map_is_made_of_its_cells_and_may_be_looked_at_before_it_is_done() {
    let scenario = Scenario::default();
    let plan = Plan::new(&scenario).expect("valid");
    let mut job = MapJob::new(&scenario, 4, 3).expect("valid");
    job.step();
    assert_eq!(job.map().deviation.iter().filter(|value| value.is_nan()).count(), 8);
    job.finish();
    let map = job.map();
    for (row, &arc_length) in map.arc_lengths.iter().enumerate() {
        for (column, &bend) in map.bends.iter().enumerate() {
            let contact = centrode_core::scenario::plan::PlannedContact::beyond(arc_length, bend, &scenario);
            let cell = map.cell(row, column);
            assert_eq!(map.nearest(arc_length, bend), Some((column, row)));
            assert_eq!(map.deviation[cell].to_bits(), largest_deviation(&plan, &contact).to_bits());
            assert_eq!(map.epsilon[cell].to_bits(), largest_epsilon(&plan, &contact).to_bits());
        }
    }
    assert_eq!(map.nearest(0.031, 0.5), None);
    assert_eq!(map.nearest(0.03, PI / 2.0), Some((3, 2)));
}

#[test]
fn odd_motions_make_a_map_all_the_same() {
    let vary: [Change; 6] = [
        |s| s.motion.theta_end = s.motion.theta_start,
        |s| s.filter.length = 1,
        |s| s.motion.end = 1.0,
        |s| s.detection.min_speed = 0.0,
        |s| {
            s.motion.start = 0.0;
            s.motion.finish = 1e-9;
            s.detection.armed_from = 0.0;
        },
        |s| s.tracker.latency = 1e9,
    ];
    for (k, change) in vary.into_iter().enumerate() {
        let mut scenario = Scenario::default();
        change(&mut scenario);
        let mut job = MapJob::new(&scenario, 5, 5).expect("valid");
        job.finish();
        assert!(job.map().deviation.iter().all(|value| !value.is_infinite()), "{k}");
    }
}
