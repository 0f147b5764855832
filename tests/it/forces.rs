//! Joint forces as the load cells see them: errors, preload, a wrench on the end disk, and both rules of ξ1.

use centrode_core::detect::Method;
use centrode_core::model::{Vec3, Wrench};
use centrode_core::plant::Plant;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::{CellErrors, Place, Scenario, Xi1Rule};
use centrode_core::scenario::{Plan, preset};
use centrode_core::sensors::cells::SimulatedCells;

/// Without contact, with a preload (N) and related cell errors.
fn free(errors: CellErrors, preload: f64) -> Scenario {
    let mut scenario = Scenario::default();
    scenario.contact.place = Place::Nowhere;
    scenario.load_cells.errors = errors;
    scenario.load_cells.preload = preload;
    scenario
}

fn run(scenario: &Scenario) -> Run {
    simulate(scenario).expect("a valid scenario")
}

fn largest_residual(run: &Run) -> f64 {
    run.samples().map(|sample| sample.judgement.residual).fold(0.0, f64::max)
}

fn alarms(run: &Run, method: Method) -> usize {
    run.crossings().iter().filter(|crossing| crossing.method == method).count()
}

#[test]
fn independent_errors_are_drawn_from_the_seed_within_the_bound() {
    let errors = |seed| {
        let mut scenario = free(CellErrors::Independent, 0.0);
        scenario.seed = seed;
        *SimulatedCells::new(&Plan::new(&scenario).expect("valid")).errors()
    };
    assert_eq!(errors(1), errors(1));
    let drawn: Vec<Vec3> = (0..500).map(errors).collect();
    assert!(drawn.windows(2).all(|pair| pair[0] != pair[1]));
    let all = || drawn.iter().flat_map(|errors| errors.iter().copied());
    assert!(all().all(|error| error.abs() <= 0.1));
    // 1500 draws: the mean of an even law over ±0.1 has a standard error of 0.0015, its deviation is 0.1/√3.
    let mean = all().sum::<f64>() / 1500.0;
    let deviation = (all().map(|error| error * error).sum::<f64>() / 1500.0).sqrt();
    assert!(mean.abs() < 0.006 && (deviation - 0.0577).abs() < 0.003, "{mean}, {deviation}");
}

#[test]
fn free_motion_stays_within_the_bound_that_fits_the_errors() {
    for seed in 0..20 {
        for (errors, preload) in [
            (CellErrors::Common, 0.0),
            (CellErrors::Common, 20.0),
            (CellErrors::Independent, 0.0),
            (CellErrors::Independent, 20.0),
        ] {
            let scenario = Scenario { seed, ..free(errors, preload) };
            for sample in run(&scenario).samples().step_by(50) {
                let judgement = &sample.judgement;
                let bound = match errors {
                    CellErrors::Common => judgement.common_bound,
                    CellErrors::Independent => judgement.independent_bound,
                };
                assert!(
                    judgement.residual <= bound * (1.0 + 1e-9) + 1e-15,
                    "seed {seed}, {errors:?} at {}",
                    sample.time
                );
            }
        }
    }
}

#[test]
fn preload_adds_to_the_residual_only_where_the_cells_err_apart() {
    let largest = |errors, preload| largest_residual(&run(&free(errors, preload)));
    let (without, with) = (largest(CellErrors::Common, 0.0), largest(CellErrors::Common, 20.0));
    assert!((with - without).abs() < 1e-12, "{without} → {with}");
    let (without, with) = (largest(CellErrors::Independent, 0.0), largest(CellErrors::Independent, 20.0));
    assert!(with > 1.5 * without, "{without} → {with}");
}

#[test]
fn a_threshold_that_follows_the_shape_tells_contact_from_a_common_error() {
    let mut scenario = free(CellErrors::Common, 0.0);
    scenario.detection.armed_from = 0.0;
    scenario.detection.xi1_rule = Xi1Rule::Bound;
    for (epsilon, factor) in [(0.1, 1.0), (0.3, 1.0), (0.0, 1.0), (0.1, 1.5)] {
        scenario.load_cells.epsilon_tau = epsilon;
        scenario.detection.xi1_factor = factor;
        assert_eq!(alarms(&run(&scenario), Method::Jfd), 0, "ε_τ = {epsilon}, k = {factor}");
    }
    scenario.detection.xi1_factor = 0.9;
    assert!(alarms(&run(&scenario), Method::Jfd) > 0, "below the bound friction alone alarms");

    let mut held = Scenario::default();
    held.detection.xi1_rule = Xi1Rule::Bound;
    let run = run(&held);
    let crossing = run.crossings().iter().find(|crossing| crossing.method == Method::Jfd).expect("found");
    assert!(crossing.time > run.contact_time().expect("contact") && crossing.value > crossing.threshold);
    let shape_bound = run.sample_at(crossing.time).judgement.shape_bound;
    assert!((crossing.threshold - 1.5 * shape_bound).abs() < 1e-15);
}

#[test]
fn the_bound_at_the_shape_is_equation_16_of_the_free_robot() {
    let scenario = free(CellErrors::Common, 3.0);
    for sample in run(&scenario).samples().step_by(100) {
        let (common, shape) = (sample.judgement.common_bound, sample.judgement.shape_bound);
        assert!((common - shape).abs() <= 1e-10 * shape + 1e-16, "{common} ≠ {shape} at {}", sample.time);
    }
}

#[test]
fn xi1_off_silences_both_rules() {
    for rule in [Xi1Rule::Constant, Xi1Rule::Bound] {
        let mut scenario = preset::find("load-at-rest").and_then(|preset| preset.scenario()).expect("a preset");
        scenario.detection.xi1_rule = rule;
        scenario.detection.xi1 = centrode_core::scenario::Threshold::OFF;
        assert_eq!(alarms(&run(&scenario), Method::Jfd), 0);
    }
}

#[test]
fn a_load_at_rest_is_caught_by_the_joint_forces_and_not_by_the_centrode() {
    let loaded = preset::find("load-at-rest").and_then(|preset| preset.scenario()).expect("a preset");
    let with = run(&loaded);
    let found: Vec<f64> = with.crossings().iter().filter(|x| x.method == Method::Jfd).map(|x| x.time).collect();
    let (start, finish) = (loaded.load.start, loaded.load.finish);
    assert!(found.first().is_some_and(|&time| time > start && time < finish), "{found:?}");
    assert!(loaded.motion.finish + 0.5 <= start, "the robot and its filter rest before the load comes");
    assert_eq!((with.detection(), alarms(&with, Method::Fcd)), (None, 0));

    let mut unloaded = loaded.clone();
    unloaded.load.force = [0.0; 3];
    assert_eq!(alarms(&run(&unloaded), Method::Jfd), 0);
}

#[test]
fn a_load_grows_evenly_and_stays() {
    let mut scenario = Scenario::default();
    scenario.load.force = [1.0, -2.0, 3.0];
    scenario.load.moment = [0.01, 0.0, -0.02];
    let wrench = |scenario: &Scenario, time| {
        let plan = Plan::new(scenario).expect("valid");
        Plant::new(&plan).wrench(time)
    };
    for (time, share) in [(0.0, 0.0), (8.5, 0.0), (8.75, 0.25), (9.5, 1.0), (1e6, 1.0)] {
        let expected = Wrench { force: Vec3::new(1.0, -2.0, 3.0) * share, moment: Vec3::new(0.01, 0.0, -0.02) * share };
        assert_eq!(wrench(&scenario, time), expected, "at {time}");
    }
    // A load that comes at once is whole from its first instant.
    scenario.load.finish = scenario.load.start;
    assert_eq!(wrench(&scenario, 8.5).force.z, 3.0);
    assert_eq!(wrench(&scenario, 8.499).force.z, 0.0);
}

#[test]
fn perfect_cells_show_the_wrench_as_its_work_on_the_shape() {
    // Θ of a loaded robot with perfect cells is ‖J_xψᵀ W_e‖ (Eqs. 11, 12), by differences of the tip's pose.
    let mut scenario = free(CellErrors::Common, 1.0);
    scenario.load_cells.epsilon_tau = 0.0;
    scenario.motion.delta = 0.7;
    scenario.load.force = [0.3, 0.5, -0.2];
    scenario.load.start = 0.0;
    scenario.load.finish = 0.0;
    let run = run(&scenario);
    let sample = run.sample_at(5.5);
    let force = Vec3::from(scenario.load.force);
    let work = |theta_l: f64, delta: f64| {
        let configuration = centrode_core::model::Configuration::from_theta_l(theta_l, delta);
        run.plan.segment().arc(configuration).pose(run.plan.segment().length).position.dot(&force)
    };
    let (theta, delta, h) = (sample.theta_l, 0.7, 1e-6);
    let by_theta = (work(theta + h, delta) - work(theta - h, delta)) / (2.0 * h);
    let by_delta = (work(theta, delta + h) - work(theta, delta - h)) / (2.0 * h);
    let expected = by_theta.hypot(by_delta);
    assert!((sample.judgement.residual - expected).abs() < 1e-8 * expected.max(1.0), "{expected}");
}
