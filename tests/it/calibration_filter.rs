//! The calibration filter, its detectors and its estimates, against readings and values of an independent prototype
//! (`tests/data/detection`).

use centrode_core::detect::calibration::course::{Listener, Model, Moment, Planner, planar};
use centrode_core::detect::calibration::marginal::{History, Question, estimate};
use centrode_core::detect::calibration::{Belief, Command, Noise, cusum};
use centrode_core::model::Pose;
use centrode_core::scenario::Kind;
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;

const LENGTH: f64 = 0.030;

/// What the prototype read and concluded.
struct Golden {
    name: String,
    value: Value,
    readings: Vec<Pose>,
}

fn golden() -> Vec<Golden> {
    let name = |calibration: &str, disk: u32| format!("{calibration}-seed1-disk{disk}");
    let names = ["exact", "miscal"].iter().flat_map(|calibration| (1..=3).map(move |disk| name(calibration, disk)));
    names
        .map(|name| {
            let path = format!("{}/tests/data/detection/{name}.json", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(path).expect("stored");
            let value: Value = serde_json::from_str(&text).expect("JSON");
            let read = &value["readings"];
            let [x, z, angle] = ["x_m", "z_m", "angle_rad"].map(|key| numbers(&read[key]));
            let readings = (0..x.len()).map(|k| planar(x[k], z[k], angle[k])).collect();
            Golden { name, value, readings }
        })
        .collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

fn reading(time: &Value) -> usize {
    (number(time) * 100.0).round() as usize
}

/// The paper's motion, at 100 Hz.
fn commands() -> Vec<Command> {
    let command = |k: u32| {
        let time = f64::from(k) / 100.0;
        let u = ((time - 3.0) / 5.0).clamp(0.0, 1.0);
        let v = 1.0 - u;
        let bend = FRAC_PI_2 * u * u * u * (10.0 + u * (6.0 * u - 15.0));
        Command { time, bend, rate: FRAC_PI_2 * 30.0 * (u * v) * (u * v) / 5.0, delta: 0.0 }
    };
    (0..=1000).map(command).collect()
}

/// With noise `factor` times that of the prototype's "lo", and so much freedom (°) of the bend.
fn model(factor: f64, free_bend: f64) -> Model {
    let noise = Noise { position: 5e-5 * factor, orientation: (0.01 * factor).to_radians(), colour: 0.0 };
    Model { length: LENGTH, belief: Belief { free_bend: free_bend.to_radians(), ..Belief::default() }, noise }
}

fn moments(model: &Model, with_bank: bool) -> Vec<Moment> {
    Planner::all(model, &commands(), with_bank)
}

/// Relative above 1.
fn off(ours: f64, theirs: f64) -> f64 {
    (ours - theirs).abs() / theirs.abs().max(1.0)
}

#[test]
fn the_age_of_the_contact_that_cusum_looks_for_follows_the_noise() {
    assert_eq!([1.0, 10.0].map(|factor| cusum::age(&model(factor, 2.0), commands().into_iter())), [3, 12]);
}

#[test]
fn statistics_and_alarms_are_the_prototypes() {
    // The first takes the robot for calibrated.
    for (part, calibrated, free_bend) in
        [("c_known", true, 0.0), ("d_nuisance", false, 0.0), ("d_free_bend", false, 2.0)]
    {
        let mut model = model(1.0, free_bend);
        if calibrated {
            model.belief.deviations.fill(0.0);
        }
        let moments = moments(&model, true);
        for Golden { name, value, readings } in golden() {
            let mut listener = Listener::new(&model, cusum::age(&model, commands().into_iter()));
            let heard: Vec<_> =
                moments.iter().zip(&readings).map(|(moment, pose)| listener.hear(moment, pose)).collect();
            let glr = &value[part];
            for (i, theirs) in numbers(&glr["glr"]).into_iter().enumerate() {
                assert!(off(heard[301 + 5 * i].glr, theirs) < 1e-3, "{name} {part} {i}");
            }
            let alarm = |over: &dyn Fn(usize) -> bool| (501..1001).find(|&k| over(k)).expect("an alarm");
            let threshold = number(&glr["threshold"]);
            assert_eq!(alarm(&|k| heard[k].glr > threshold), reading(&glr["alarm_s"]), "{name} {part}");
            if free_bend == 0.0 {
                continue;
            }
            let sum = &value["e_cusum"];
            for (i, theirs) in numbers(&sum["statistic"]).into_iter().enumerate() {
                assert!(off(heard[301 + 5 * i].cusum, theirs) < 1e-8, "{name} cusum {i}");
            }
            let threshold = number(&sum["threshold"]);
            assert_eq!(alarm(&|k| heard[k].cusum > threshold), reading(&sum["alarm_s"]), "{name} cusum");
            for (k, design) in sum["design_vectors"].as_object().expect("vectors") {
                let k: usize = k.parse().expect("a reading");
                // The prototype has the components in another order, which changes the vector but not its length.
                let size = numbers(design).iter().map(|w| w * w).sum::<f64>();
                assert!((2.0 * moments[k].half / size - 1.0).abs() < 1e-8, "{name} at {k}");
            }
        }
    }
}

#[test]
fn places_are_the_prototypes() {
    let model = model(1.0, 2.0);
    let moments = moments(&model, false);
    for Golden { name, value, readings } in golden() {
        let part = &value["d_free_bend"];
        for theirs in part["relinearised"].as_array().expect("estimates") {
            let k = reading(&theirs["at_s"]);
            let history = History { model: &model, moments: &moments, readings: &readings[..=k] };
            let ask = |kinds, parts| {
                let question = Question { first: (reading(&part["alarm_s"])).saturating_sub(100), kinds, parts };
                estimate(&history, &question).expect("it moved")
            };
            // The prototype tries beginnings at readings alone.
            let ours = ask(&[Kind::Clamp], 1);
            let mm = |key: &str| number(&theirs[key]) * 1e-3;
            let (mean, expected) = (ours.place.mean, mm("s_mean_mm"));
            assert!((mean - expected).abs() < 2e-5, "{name} at {k}: {mean} {expected}");
            // Its quantiles are points of its grid, which is 0.1 mm apart.
            for (ours, theirs) in [(ours.place.low, mm("s_q025_mm")), (ours.place.high, mm("s_q975_mm"))] {
                assert!((ours - theirs).abs() < 1e-4, "{name} at {k}: {ours} {theirs}");
            }
            // What the readings say of the calibration before the contact.
            let (found, deviation) = (numbers(&theirs["eta_hat"]), numbers(&theirs["eta_hat_std"]));
            for (place, of) in [(0, 0), (2, 1), (4, 2), (6, 3), (7, 4), (8, 5), (10, 6)] {
                let [ours, spread] = [0, 1].map(|which| ours.calibration[which][place]);
                // A reading more or less: the prototype looks for the beginning on a finer grid.
                assert!((ours - found[of]).abs() < 0.3 * deviation[of], "{name} at {k}: error {of}");
                assert!((spread / deviation[of] - 1.0).abs() < 0.05, "{name} at {k}: deviation {of}");
            }
            let finer = ask(&[Kind::Clamp], 4);
            let truth = number(&value["s_c_m"]);
            assert!(
                (finer.place.mean - truth).abs() < 3.0 * (finer.place.high - finer.place.low) / 4.0,
                "{name} at {k}"
            );
            let grid = finer.posterior[1][0] - finer.posterior[0][0];
            let sum: f64 = finer.posterior.iter().map(|[_, density]| density * grid).sum();
            assert!((sum - 1.0).abs() < 1e-6, "{name}: {sum}");
            let both = ask(Kind::ALL, 4);
            let clamp = both.kinds.iter().find(|(kind, _)| *kind == Kind::Clamp).expect("tried").1;
            let late = k > reading(&part["alarm_s"]) + 40;
            assert!(clamp > 0.3 && (!late || name.ends_with('1') || clamp > 0.99), "{name} at {k}: {clamp}");
        }
    }
}

#[test]
fn a_planar_experiment_does_not_care_where_its_plane_is() {
    // Turned about the straight backbone, a planar experiment gives the same: what is out of its plane is apart.
    let (model, turn) = (model(1.0, 2.0), 0.7);
    let (sin, cos) = f64::sin_cos(-turn);
    let about = centrode_core::model::Mat3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let Golden { readings, .. } = golden().swap_remove(4);
    let turned: Vec<Pose> = readings
        .iter()
        .map(|pose| Pose { position: about * pose.position, rotation: about * pose.rotation * about.transpose() })
        .collect();
    let course = |delta: f64, readings: &[Pose]| {
        let commands: Vec<Command> = commands().into_iter().map(|command| Command { delta, ..command }).collect();
        let moments = Planner::all(&model, &commands, false);
        let mut listener = Listener::new(&model, cusum::age(&model, commands.iter().copied()));
        moments.iter().zip(readings).map(|(moment, pose)| listener.hear(moment, pose).cusum).collect::<Vec<_>>()
    };
    for (here, there) in course(0.0, &readings).into_iter().zip(course(turn, &turned)) {
        assert!(off(here, there) < 1e-7, "{here} {there}");
    }
    assert!(course(0.0, &readings)[700] > 100.0);
}
