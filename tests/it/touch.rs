//! Beams that only touch: one configuration by the command, whole runs, what is refused, and what is placed where.

use crate::cli::centrode;
use centrode_core::plant::{Happening, Shape};
use centrode_core::run::{Run, Simulation, simulate};
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{ContactKind, EstimationKind, Place, Plan, Scenario, Start};
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;

fn preset(name: &str) -> Scenario {
    find(name).and_then(|preset| preset.scenario()).expect(name)
}

/// Without noise, with a kind of contact.
fn quiet(name: &str, kind: ContactKind) -> Scenario {
    let mut scenario = preset(name);
    (scenario.tracker.position_noise, scenario.tracker.orientation_noise) = (0.0, 0.0);
    scenario.contact.kind = kind;
    scenario
}

fn model(args: &[&str]) -> Value {
    let output = centrode(&[&["model", "--json"], args].concat());
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn highest(run: &Run) -> f64 {
    let judged = run.samples().filter(|sample| sample.time >= 5.0 && sample.judgement.speed > 0.05);
    judged.map(|sample| sample.judgement.deviation).fold(0.0, f64::max)
}

#[test]
fn model_prints_the_reference() {
    let data: Value = serde_json::from_str(include_str!("../../core/tests/data/touch.json")).expect("reference data");
    let (length, stiffness) = (0.03, 0.002 + 3.0 * 0.001);
    for case in data["cases"].as_array().expect("cases") {
        let number = |key: &str| case[key].as_str().expect(key).parse::<f64>().expect(key);
        let bend = number("phi");
        let theta_l = (FRAC_PI_2 - bend).to_string();
        let (contact, met) = ((number("s_c") * length).to_string(), number("phi_contact").to_string());
        let ours = model(&[
            "--theta-l",
            &theta_l,
            "--contact",
            &contact,
            "--kind",
            "plane",
            "--bend-at-contact",
            &met,
            "--ep-ip",
            "0.002",
            "--es-is",
            "0.001",
        ]);
        let tolerance = if bend <= 1.0001 * FRAC_PI_2 { 1e-9 } else { 1e-6 };
        let near = |key: &str, ours: &Value, reference: f64, scale: f64| {
            let ours = ours.as_f64().expect(key);
            assert!((ours - reference * scale).abs() <= tolerance * scale.max(1.0), "{key} at {case}: {ours}");
        };
        near("force", &ours["contact_force"], number("contact_force_L2_over_EI"), stiffness / (length * length));
        near("slope", &ours["contact_slope"], number("slope_at_contact"), 1.0);
        near("above", &ours["curvature_above"], number("curvature_above_L"), 1.0 / length);
        near("base", &ours["curvature_base"], number("curvature_base_L"), 1.0 / length);
        for (key, x, z) in [
            ("tip_position", "tip_x", "tip_z"),
            ("constrained_position", "tip_x", "tip_z"),
            ("tip_rate", "dtip_x_dphi", "dtip_z_dphi"),
            ("contact_position", "contact_x", "contact_z"),
            ("constrained_centrode", "centrode_x", "centrode_z"),
        ] {
            let at = |place: usize| ours[key][place].as_f64().expect(key);
            for (place, reference) in [(0, number(x)), (1, 0.0), (2, number(z))] {
                assert!((at(place) - reference * length).abs() <= tolerance * length, "{key} at {case}: {}", ours[key]);
            }
        }
    }
}

#[test]
fn the_right_model_returns_the_truth_and_the_wrong_one_another_place() {
    for (contact, met, wrong) in [("0.0075", "0.96", 5.77), ("0.015", "0.96", 11.98), ("0.0225", "0.6685", 19.02)] {
        let place = |kind: &str| {
            let given = ["--theta-l", "0.09", "--contact", contact, "--bend-at-contact", met, "--kind", kind];
            let answer = model(&given);
            ["located_clamp", "located_plane"].map(|key| answer[key]["arc_length"].as_f64().expect(key) * 1e3)
        };
        let truth = contact.parse::<f64>().expect("a number") * 1e3;
        let ([clamp, _], [as_clamp, plane]) = (place("clamp"), place("plane"));
        assert!((clamp - truth).abs() < 1e-6 && (plane - truth).abs() < 1e-6, "{clamp} {plane}");
        assert!((as_clamp - wrong).abs() < 0.006, "{as_clamp}");
    }
}

#[test]
fn the_deviation_is_a_fifth_smaller_and_a_threshold_of_7_mm_misses_disk_2() {
    for (name, clamp, plane) in [("disk-1", 3.81, 3.00), ("bench", 7.42, 6.02), ("disk-3", 11.87, 10.29)] {
        for (kind, peak) in [(ContactKind::Clamp, clamp), (ContactKind::Plane, plane)] {
            let run = simulate(&quiet(name, kind)).expect(name);
            assert!((highest(&run) * 1e3 - peak).abs() < 0.006, "{name} {kind:?}: {}", highest(&run));
        }
    }
    assert_eq!(simulate(&quiet("bench", ContactKind::Plane)).expect("a run").detection(), None);
    let third = simulate(&quiet("disk-3", ContactKind::Plane)).expect("a run").detection().expect("detected");
    assert!((third.time - 5.66).abs() < 0.003 && (third.location - 0.01346).abs() < 1e-5, "{third:?}");
}

#[test]
fn what_eq_24_assumes_moves_the_place_and_nothing_else() {
    let mut scenario = quiet("disk-3", ContactKind::Plane);
    let mut run = simulate(&scenario).expect("a run");
    let before = run.detection().expect("detected");
    scenario.estimation.kind = EstimationKind::Plane;
    run.update(Plan::new(&scenario).expect("possible"));
    let plane = run.detection().expect("detected");
    assert_eq!((plane.time, plane.theta_l), (before.time, before.theta_l));
    assert!(plane.location > before.location + 0.001, "{plane:?} {before:?}");
    assert_eq!(run.events(), simulate(&scenario).expect("a run").events(), "brought up to date, or anew");
    // Once the average holds nothing but contact, knowing kind and bend leaves only its lag.
    scenario.estimation.kind = EstimationKind::AsSimulated;
    scenario.detection.armed_from = 7.0;
    let settled = simulate(&scenario).expect("a run").detection().expect("detected");
    assert!((settled.location - 0.0225).abs() < 0.001, "{settled:?}");
}

#[test]
fn a_run_says_when_the_segment_snaps_off_and_goes_on_free() {
    let scenario = preset("snap");
    let run = simulate(&scenario).expect("a run");
    let [met, snapped] = run.plant_events() else { panic!("{:?}", run.plant_events()) };
    assert_eq!((met.what, snapped.what), (Happening::Met, Happening::Snapped));
    assert!((snapped.bend.to_degrees() + 111.98).abs() < 0.01, "{snapped:?}");
    let at = run.place(snapped.time);
    let held = |k: usize| matches!(run.truth(k).expect("simulated").shape, Shape::Touched(_));
    assert!(held(at - 1) && !held(at) && !held(run.len() - 1));
    // Nothing is made up at the snap: what is defined before is defined after.
    let tip = |k: usize| run.truth(k).expect("simulated").shape.tip_pose().position;
    assert!((at - 2..at + 2).all(|k| tip(k).iter().all(|x| x.is_finite())));
    assert!((tip(at) - tip(at - 1)).norm() > 10.0 * (tip(at - 1) - tip(at - 2)).norm(), "it jumps");
    let plan = Plan::new(&scenario).expect("possible");
    let mut stream = Simulation::new(&plan);
    stream.by_ref().for_each(drop);
    assert_eq!(stream.plant_events(), run.plant_events());
    let output = centrode(&["run", "--preset", "snap"]);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(text.contains("at 7.203 s (bend -112.0°) the segment snaps off the beam"), "{text}");
}

#[test]
fn a_beam_that_lets_go_is_an_event_too() {
    let run = simulate(&preset("letting-go")).expect("a run");
    let what: Vec<_> = run.plant_events().iter().map(|event| event.what).collect();
    assert_eq!(what, [Happening::Met, Happening::Opened]);
    assert_eq!(run.plant_events()[1].bend, 0.6);
    assert_eq!(simulate(&preset("free")).expect("a run").plant_events(), []);
}

#[test]
fn joint_forces_are_continuous_at_contact_and_smaller_than_a_clamps() {
    let residuals = |kind| {
        let run = simulate(&quiet("bench", kind)).expect("a run");
        let first = run.place(run.contact_time().expect("contact"));
        [first - 1, first, first + 1, run.len() - 1].map(|k| run.sample(k).judgement.residual)
    };
    let (clamp, plane) = (residuals(ContactKind::Clamp), residuals(ContactKind::Plane));
    assert!(plane[1] - plane[0] < 1e-3 * plane[3] && plane[2] - plane[1] < 1e-3 * plane[3], "{plane:?}");
    assert!(plane[3] < 0.8 * clamp[3], "{plane:?} {clamp:?}");
}

#[test]
fn what_is_impossible_is_refused_by_key() {
    let refused = |change: &dyn Fn(&mut Scenario)| {
        let mut scenario = preset("touch-2");
        change(&mut scenario);
        Plan::new(&scenario).expect_err("impossible").to_string()
    };
    let told = refused(&|s| s.contact.place = Place::ArcLength(0.0));
    assert!(told.contains("contact.arc_length") && told.contains("contact.kind"), "{told}");
    let told = refused(&|s| s.contact.place = Place::ArcLength(0.03));
    assert!(told.contains("contact.arc_length"), "{told}");
    let told = refused(&|s| (s.contact.kind, s.contact.rounding) = (ContactKind::Cylinder, 0.04));
    assert!(told.contains("contact.rounding"), "{told}");
    // On the inside of the bend it has to fit into the arc.
    let told = refused(&|s| {
        (s.contact.kind, s.contact.rounding, s.contact.start) = (ContactKind::Cylinder, 0.02, Start::Bend(2.0));
    });
    assert!(told.contains("contact.rounding") && told.contains("0.015"), "{told}");
    for (args, parts) in [
        (&["--kind", "plane"][..], &["--contact", "between the base and the end disk"][..]),
        (&["--kind", "cylinder", "--contact", "0.01", "--rounding", "0.05"], &["--rounding", "0.03"]),
        (&["--kind", "plane", "--contact", "0.01", "--bend-at-contact", "nan"], &["--bend-at-contact"]),
        (&["--kind", "wall"], &["wall", "clamp, plane, cylinder"]),
    ] {
        let output = centrode(&[&["model", "--theta-l", "0.5"], args].concat());
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && parts.iter().all(|part| told.contains(part)), "{args:?}: {told}");
    }
    let given = ["model", "--theta-l", "3.6", "--contact", "0.0225", "--kind", "plane", "--bend-at-contact", "2.3562"];
    let output = centrode(&given);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && told.contains("--theta-l = 3.6") && told.contains("snaps off"), "{told}");
}

#[test]
fn kind_and_rounding_are_keys_like_others() {
    let output = centrode(&["run", "--json", "--preset", "cylinder", "--set", "contact.rounding=0.001"]);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["scenario"]["contact"]["kind"], "cylinder");
    assert_eq!(report["plant"][0]["what"], "met");
}

#[test]
fn what_only_a_clamp_can_hold_is_shown_with_a_clamp_alone() {
    let path = std::env::temp_dir().join(format!("centrode-{}-base.svg", std::process::id()));
    let output = centrode(&["figure", "4", "--set", "contact.arc_length=0", "--out", path.to_str().expect("UTF-8")]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let drawn = std::fs::read_to_string(&path).expect("written");
    let _ = std::fs::remove_file(path);
    assert!(!drawn.contains("flat beam"));
    let output = centrode(&["table2", "--json", "--repeats", "1", "--set", "robot.disks=[0.0075,0.015,0.03]"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!((&table["simulated"][0]["repeats"], &table["other"][0]["repeats"]), (&1.into(), &0.into()));
}
