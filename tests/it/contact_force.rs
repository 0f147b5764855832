//! The size of a contact force, by the load cells.

use centrode_core::detect::Method;
use centrode_core::detect::force::sizes;
use centrode_core::plant::Shape;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{CellErrors, ContactKind, Scenario, Start};

/// A plane at the contact of a preset, with or without errors of the cells, under a preload.
fn scenario(name: &str, epsilon_tau: f64) -> Scenario {
    let mut scenario = find(name).and_then(|preset| preset.scenario()).expect(name);
    scenario.contact.kind = ContactKind::Plane;
    let cells = &mut scenario.load_cells;
    (cells.epsilon_tau, cells.errors, cells.noise, cells.preload) = (epsilon_tau, CellErrors::Common, 0.0, 3.0);
    scenario
}

/// Time, truth and what the cells say of it, every 50 ms in contact, with the true place.
fn forces(run: &Run) -> Vec<(f64, f64, [f64; 3])> {
    let settings = &run.judged.settings;
    let place = run.plan.contact().expect("one").arc_length;
    let start = run.recording.entries[0].configuration.bend();
    let truth = run.recording.truth.as_ref().expect("simulated");
    let stiffness = run.segment().bending_stiffness();
    let entries = run.recording.entries.iter().zip(truth).step_by(50);
    let of = |(entry, truth): (&centrode_core::record::Entry, &centrode_core::record::Truth)| {
        let Shape::Touched(touched) = &truth.shape else { return None };
        let said = sizes(settings, (start, entry.configuration), &entry.tau_lc, place).expect("a force");
        Some((entry.time, touched.force(stiffness).expect("holds"), said))
    };
    entries.filter_map(of).collect()
}

#[test]
fn without_errors_the_force_is_the_true_one() {
    for name in ["disk-1", "bench", "disk-3"] {
        for back in [false, true] {
            let mut scenario = scenario(name, 0.0);
            if back {
                let motion = &mut scenario.motion;
                std::mem::swap(&mut motion.theta_start, &mut motion.theta_end);
                scenario.contact.start = Start::Time(5.5);
            }
            let all = forces(&simulate(&scenario).expect("possible"));
            assert!(all.len() > 30, "{name}: {}", all.len());
            for (time, truth, [low, mean, high]) in all {
                assert!(
                    (mean - truth).abs() <= 0.01 * truth + 1e-6,
                    "{name} {back} at {time} s: {mean} N of {truth} N"
                );
                assert_eq!([low, high], [mean; 2]);
            }
        }
    }
}

#[test]
fn errors_of_the_cells_leave_the_truth_within_the_bounds() {
    for name in ["disk-1", "bench", "disk-3"] {
        for epsilon_tau in [0.1, 0.02] {
            let all = forces(&simulate(&scenario(name, epsilon_tau)).expect("possible"));
            for (time, truth, [low, mean, high]) in &all {
                let what = format!("{name}, {epsilon_tau} at {time} s: {truth} N in {low} … {mean} … {high} N");
                // The cells read too much by 1/(1 − ε): the lower end is the truth, but for rounding.
                assert!(*low <= truth + 1e-6 && truth <= high && low <= mean && mean <= high, "{what}");
                assert!((low - truth).abs() < 0.01 * truth + 1e-6, "{what}");
                assert!(*time < 6.5 || *high > 1.02 * low, "{what}");
            }
        }
    }
}

#[test]
fn a_force_needs_a_place_a_motion_and_readings() {
    let run = simulate(&scenario("bench", 0.0)).expect("possible");
    let entry = run.recording.entries[7000];
    let ask = |start, bend: f64, tau, place| {
        sizes(&run.judged.settings, (start, entry.configuration.with_bend(bend)), &tau, place)
    };
    let bend = entry.configuration.bend();
    assert!(ask(0.0, bend, entry.tau_lc, 0.015).is_some_and(|[_, mean, _]| mean > 0.1));
    for place in [0.0, 0.03, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(ask(0.0, bend, entry.tau_lc, place), None, "{place}");
    }
    assert_eq!(ask(bend, bend, entry.tau_lc, 0.015), None, "nothing moved");
    assert_eq!(ask(0.0, f64::NAN, entry.tau_lc, 0.015), None);
    assert_eq!(ask(0.0, bend, entry.tau_lc * f64::NAN, 0.015), None);
    // Cells that tell of no bend at all tell of no force, and any others of no endless one.
    assert_eq!(ask(0.0, bend, entry.tau_lc * 0.0, 0.015), Some([0.0; 3]));
    let most = ask(0.0, bend, entry.tau_lc * 1e9, 0.015).expect("the most there is")[1];
    assert!(most.is_finite() && most > 0.1, "{most} N");
}

#[test]
fn a_report_tells_of_the_force_of_a_plane_and_of_no_other() {
    use centrode_core::study::report::{AFTER, Conclusions, Pressed};
    let told = |kind: ContactKind| -> (Option<Pressed>, Option<f64>) {
        let mut scenario = scenario("disk-3", 0.05);
        scenario.contact.kind = kind;
        let run = simulate(&scenario).expect("possible");
        let conclusions = Conclusions::of(&run.judged, &run.recording, Method::Cusum, AFTER);
        (conclusions.force, conclusions.estimates.last().map(|estimate| estimate.time))
    };
    let (force, last) = told(ContactKind::Plane);
    let (Pressed { force, truth }, last) = (force.expect("a plane"), last.expect("placed"));
    assert!((force.time - last).abs() < 1.5e-3, "{force:?}, {last}");
    let truth = truth.expect("simulated");
    assert!(force.low <= force.mean && force.mean <= force.high, "{force:?}");
    // The place is estimated, so the truth is near the interval's end and not at it.
    assert!(force.low * 0.9 < truth && truth < force.high, "{force:?}");
    assert_eq!(told(ContactKind::Clamp).0, None);
}
