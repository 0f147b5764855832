//! Known answers of the simulated experiment (`docs/MODEL.md`), and what every setting must do.

use centrode_core::detect::Method;
use centrode_core::plant::Plant;
use centrode_core::plant::Shape;
use centrode_core::run::{CHANNELS, Run, simulate};
use centrode_core::scenario::Plan;
use centrode_core::scenario::preset::PRESETS;
use centrode_core::scenario::{Averaging, Mounting, Place, Scenario, Start, Threshold};
use std::f64::consts::{FRAC_PI_2, PI};

fn contact(disk: u64, time: f64) -> Scenario {
    let mut scenario = Scenario::default();
    scenario.contact.place = Place::disk(disk);
    scenario.contact.start = Start::Time(time);
    scenario
}

fn run(scenario: &Scenario) -> Run {
    simulate(scenario).expect("a valid scenario")
}

fn bench(mut scenario: Scenario) -> Scenario {
    scenario.tracker.position_noise = 5e-5;
    scenario.tracker.orientation_noise = 0.01_f64.to_radians();
    scenario
}

fn fcd_times(run: &Run) -> Vec<f64> {
    run.crossings().iter().filter(|crossing| crossing.method == Method::Fcd).map(|crossing| crossing.time).collect()
}

fn peak(run: &Run, from: f64, to: f64) -> f64 {
    let within = run.samples().filter(|sample| sample.time >= from && sample.time <= to);
    within.map(|sample| sample.judgement.deviation).fold(0.0, f64::max)
}

#[test]
fn contact_on_disk_2_is_detected_at_6_279_s() {
    let run = run(&contact(2, 5.80));
    let detection = run.detection().expect("detected");
    assert!((detection.time - 6.279).abs() <= 0.003, "{detection:?}");
    assert!((detection.theta_l - run.sample_at(detection.time).theta_l).abs() < 1e-15);
    assert!((run.contact_time().expect("contact") - 5.801).abs() < 1e-9);
}

#[test]
fn contact_on_disk_3_is_detected_at_5_610_s_and_placed_near_14_mm() {
    let run = run(&contact(3, 5.30));
    let detection = run.detection().expect("detected");
    assert!((detection.time - 5.610).abs() <= 0.003, "{detection:?}");
    // Half a window of free motion is still in the average: the estimate falls short of the true 22.5 mm.
    assert!((detection.location - 0.014).abs() < 0.001, "{detection:?}");
}

#[test]
fn contact_on_disk_1_stays_below_7_mm_without_noise() {
    let run = run(&contact(1, 5.80));
    assert_eq!(run.detection(), None);
    assert!(peak(&run, 5.0, 7.9) < 0.007);
}

#[test]
fn without_contact_the_filter_alone_makes_0_77_mm() {
    let run = run(&contact(0, 5.80));
    let peak = peak(&run, 5.0, 7.9);
    assert!((peak - 0.77e-3).abs() <= 0.02e-3, "{peak}");
    assert!(run.crossings().iter().all(|crossing| crossing.time > 8.0), "{:?}", run.crossings());
    assert_eq!(run.contact_time(), None);
}

#[test]
fn the_contact_deviation_is_about_half_the_arc_length() {
    // ‖c_c − c_m‖ stays close to s_c/2 from contact (3.7, 7.4, 11.1 mm) to the end of the motion, a fifth above it.
    for (disk, s_c) in [(1, 7.5e-3), (2, 15e-3), (3, 22.5e-3)] {
        let mut scenario = contact(disk, 4.5);
        scenario.filter.length = 10;
        let run = run(&scenario);
        let ratio = |time| run.sample_at(time).judgement.deviation / (0.5 * s_c);
        assert!((ratio(4.6) - 1.0).abs() < 0.01, "disk {disk}: {}", ratio(4.6));
        for time in [5.5, 6.5, 7.5] {
            assert!((1.0..1.2).contains(&ratio(time)), "disk {disk} at {time} s: {}", ratio(time));
        }
    }
}

#[test]
fn repeats_with_a_quiet_tracker_scatter_by_hundredths_of_a_second() {
    let times: Vec<f64> = (1..=10)
        .map(|seed| {
            let scenario = Scenario { seed, ..bench(contact(2, 5.80)) };
            run(&scenario).detection().expect("detected").time
        })
        .collect();
    let (low, high) = times.iter().fold((f64::MAX, f64::MIN), |(low, high), &t| (low.min(t), high.max(t)));
    assert!(high > low && high - low < 0.06, "{times:?}");
    assert!(times.iter().all(|t| (t - 6.279).abs() < 0.05), "{times:?}");
}

#[test]
fn the_static_resolution_read_as_white_noise_raises_false_alarms_at_once() {
    let mut scenario = contact(0, 5.80);
    scenario.tracker.position_noise = 5e-4;
    scenario.tracker.orientation_noise = 0.1_f64.to_radians();
    let first = fcd_times(&run(&scenario))[0];
    assert!(first < 5.5, "{first}");
}

#[test]
fn a_filter_of_one_sample_or_of_broken_periods_gives_no_false_zero() {
    for length in [1, 505] {
        let mut scenario = contact(2, 5.80);
        scenario.filter.length = length;
        let run = run(&scenario);
        let mut undefined = 0;
        for sample in run.samples() {
            let judgement = &sample.judgement;
            assert_eq!(judgement.deviation.is_nan(), judgement.speed == 0.0, "at {}", sample.time);
            undefined += usize::from(judgement.deviation.is_nan());
            if sample.time > 4.0 && sample.time < 8.0 {
                assert!(judgement.deviation.is_nan() || judgement.deviation > 1e-9, "zero at {}", sample.time);
            }
        }
        assert!(undefined > 1000, "the robot rests for five seconds");
        assert!(run.detection().is_some(), "N = {length}");
    }
    // Unfiltered, the sensor shows a contact at the refresh that follows it.
    let mut scenario = contact(2, 5.80);
    scenario.filter.length = 1;
    let detection = run(&scenario).detection().expect("detected");
    assert!(detection.time > 5.8 && detection.time <= 5.83, "{detection:?}");
    assert!((detection.location - 0.015).abs() < 1e-3, "{detection:?}");
}

#[test]
fn the_bending_plane_does_not_matter() {
    let reference = run(&contact(2, 5.80));
    for delta in [0.7, FRAC_PI_2, -2.5] {
        let mut scenario = contact(2, 5.80);
        scenario.motion.delta = delta;
        for averaging in [Averaging::Readings, Averaging::Rotations] {
            scenario.filter.averaging = averaging;
            let turned = run(&scenario);
            for (a, b) in reference.samples().zip(turned.samples()).filter(|(a, _)| a.judgement.speed > 1e-3) {
                let (a, b) = (a.judgement.deviation, b.judgement.deviation);
                // Averaging quaternions weighs a wide window a little differently from averaging angles.
                assert!((a - b).abs() < 2e-6, "δ = {delta}, {averaging:?}: {a} {b}");
            }
            assert_eq!(turned.crossings().len(), reference.crossings().len());
        }
    }
}

#[test]
fn an_aligned_marker_is_lost_past_90_degrees_unless_rotations_are_averaged() {
    let worst = |averaging, mounting| {
        let mut scenario = bench(contact(0, 5.80));
        scenario.motion.theta_end = -0.35;
        scenario.tracker.mounting = mounting;
        scenario.filter.averaging = averaging;
        peak(&run(&scenario), 5.0, 7.4)
    };
    let lost = worst(Averaging::Readings, Mounting::Aligned);
    assert!(lost > 0.007, "{lost}");
    for (averaging, mounting) in
        [(Averaging::Rotations, Mounting::Aligned), (Averaging::Readings, Mounting::BendingAxis)]
    {
        let kept = worst(averaging, mounting);
        assert!(kept < 0.003, "{averaging:?}, {mounting:?}: {kept}");
    }
}

#[test]
fn moving_back_opens_the_contact() {
    let mut scenario = Scenario::default();
    (scenario.motion.theta_start, scenario.motion.theta_end) = (0.0, FRAC_PI_2);
    scenario.contact.start = Start::Bend(0.6);
    let run = run(&scenario);
    for sample in run.samples() {
        assert_eq!(sample.in_contact, FRAC_PI_2 - sample.theta_l > 0.6, "at {}", sample.time);
    }
    assert!(run.sample(0).in_contact && !run.sample(run.len() - 1).in_contact);
}

#[test]
fn a_contact_timed_in_a_straightening_motion_starts_then() {
    for (start, end) in [(0.0, FRAC_PI_2), (3.0, 0.2), (0.2, 3.0)] {
        let mut scenario = contact(2, 5.8);
        (scenario.motion.theta_start, scenario.motion.theta_end) = (start, end);
        let time = run(&scenario).contact_time().expect("contact");
        assert!((time - 5.801).abs() < 1e-9, "{start} to {end}: {time}");
    }
}

#[test]
fn a_robot_at_rest_has_no_speed_and_no_centrode() {
    let mut scenario = contact(2, 5.8);
    // Nothing hides what a rounding error would make of the rest.
    (scenario.detection.armed_from, scenario.detection.min_speed) = (0.0, 0.0);
    for averaging in [Averaging::Readings, Averaging::Rotations] {
        scenario.filter.averaging = averaging;
        scenario.motion.delta = 0.3;
        let run = run(&scenario);
        for sample in run.samples().filter(|sample| sample.time <= 3.0) {
            assert!(sample.judgement.speed == 0.0 && sample.judgement.deviation.is_nan(), "at {}", sample.time);
        }
        assert!(fcd_times(&run).iter().all(|&time| time > 5.8), "{averaging:?}: {:?}", fcd_times(&run));
    }
}

#[test]
fn bending_the_other_way_meets_a_beam_on_the_other_side() {
    let mirror = |theta_end| {
        let mut scenario = contact(2, 5.80);
        scenario.motion.theta_end = theta_end;
        run(&scenario)
    };
    let (there, back) = (mirror(0.0), mirror(PI));
    let (a, b) = (there.detection().expect("detected"), back.detection().expect("detected"));
    assert!((a.time - b.time).abs() < 2e-3 && (a.location - b.location).abs() < 1e-4, "{a:?} {b:?}");
}

#[test]
fn the_tracker_holds_rounds_and_ages_its_readings() {
    let mut scenario = contact(0, 5.8);
    scenario.tracker.position_resolution = 5e-4;
    scenario.tracker.latency = 0.25;
    let run = run(&scenario);
    for pair in run.samples().collect::<Vec<_>>().windows(2) {
        let refreshed = (pair[1].time * 100.0).fract() < 1e-9 || (pair[1].time * 100.0).fract() > 1.0 - 1e-9;
        assert!(refreshed || pair[0].reading == pair[1].reading, "changed between refreshes at {}", pair[1].time);
    }
    let plan = Plan::new(&scenario).expect("valid");
    let plant = Plant::new(&plan);
    for time in [4.0, 5.5, 7.0] {
        let aged = plant.shape(plant.command(time - 0.25).0).tip_pose().position;
        let reading = run.sample_at(time).reading.position;
        for i in 0..3 {
            assert!((reading[i] - aged[i]).abs() <= 2.5e-4 + 1e-12, "{} {}", reading[i], aged[i]);
            let steps = reading[i] / 5e-4;
            assert!((steps - steps.round()).abs() < 1e-9);
        }
    }
}

#[test]
fn a_resolution_too_fine_to_count_rounds_nothing() {
    let mut scenario = contact(2, 5.8);
    scenario.tracker.position_resolution = 1e-320;
    assert_eq!(run(&scenario).fingerprint(), run(&contact(2, 5.8)).fingerprint());
}

#[test]
fn the_residual_without_contact_is_the_bound() {
    let run = run(&contact(0, 5.8));
    for sample in run.samples() {
        let judgement = &sample.judgement;
        assert!((judgement.residual - judgement.common_bound).abs() < 1e-12, "at {}", sample.time);
    }
    assert!(run.sample(0).judgement.residual < 1e-12, "it vanishes with the bend");
    assert!(run.sample(9000).judgement.residual > 0.01);
}

#[test]
fn preload_moves_the_independent_bound_only() {
    let bounds = |preload| {
        let mut scenario = contact(0, 5.8);
        scenario.load_cells.preload = preload;
        let judgement = run(&scenario).sample(9000).judgement;
        (judgement.common_bound, judgement.independent_bound)
    };
    let (without, with) = (bounds(0.0), bounds(20.0));
    assert!((without.0 - with.0).abs() < 1e-12);
    assert!(with.1 > without.1 + 1e-3, "{without:?} {with:?}");
}

#[test]
fn contact_shows_in_the_joint_forces_at_once() {
    let mut scenario = contact(2, 5.80);
    scenario.load_cells.epsilon_tau = 0.0;
    scenario.detection.xi1 = Threshold::On(1e-3);
    let run = run(&scenario);
    let crossing = run.crossings().iter().find(|crossing| crossing.method == Method::Jfd).expect("noticed");
    assert!(crossing.time > 5.8 && crossing.time < 5.85, "{crossing:?}");
    assert!(run.sample_at(5.7).judgement.residual < 1e-12);
}

#[test]
fn a_contact_so_near_the_tip_that_statics_end_leaves_a_gap() {
    let mut scenario = contact(0, 5.8);
    scenario.contact.place = Place::ArcLength(0.03);
    let run = run(&scenario);
    let held = run.sample_at(6.5);
    assert!(held.judgement.residual.is_nan() && held.tau_lc.x.is_nan());
    assert!(run.detection().is_some());
}

#[test]
fn thresholds_that_are_off_never_cross() {
    let mut scenario = contact(2, 5.80);
    (scenario.detection.xi1, scenario.detection.xi2) = (Threshold::OFF, Threshold::OFF);
    let run = run(&scenario);
    assert!(run.crossings().is_empty() && run.detection().is_none());
}

#[test]
fn nothing_is_raised_before_arming() {
    let mut scenario = bench(contact(2, 3.5));
    scenario.detection.armed_from = 6.0;
    let run = run(&scenario);
    assert!(run.crossings().iter().all(|crossing| crossing.time >= 6.0));
    assert_eq!(run.detection().expect("detected").time, 6.0);
}

#[test]
fn the_true_backbone_is_one_curve() {
    let run = run(&contact(2, 5.80));
    let plant = Plant::new(&run.plan);
    let shape = plant.shape(plant.command(7.0).0);
    assert!(matches!(shape, Shape::Held(_)));
    let mut before = shape.pose(0.0).position;
    for k in 1..=300 {
        let here = shape.pose(0.03 * f64::from(k) / 300.0).position;
        assert!(((here - before).norm() - 1e-4).abs() < 1e-7, "at {k}");
        before = here;
    }
    // The part below the contact stays where it was.
    let at_contact = plant.shape(plant.command(5.80).0);
    assert!((shape.pose(0.01).position - at_contact.pose(0.01).position).norm() < 1e-12);
}

#[test]
fn every_preset_runs_and_says_what_it_shows() {
    for preset in PRESETS {
        let scenario = preset.scenario().expect(preset.name);
        assert!(preset.toml.starts_with("# ") && preset.summary().len() > 20, "{}", preset.name);
        let run = run(&scenario);
        assert!(!run.is_empty());
    }
    assert!(run(&PRESETS[0].scenario().expect("bench")).detection().is_some(), "the page opens on a detection");
}

#[test]
fn channels_have_names_units_and_times_in_step() {
    let mut names: Vec<_> = CHANNELS.iter().map(|channel| channel.name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), CHANNELS.len());
    let run = run(&Scenario::default());
    assert_eq!(run.len(), 10_001);
    assert_eq!(run.sample(10_000).time, 10.0);
}

#[test]
fn odd_rates_are_taken() {
    for (loop_rate, tracker_rate) in [(1000.0, 97.3), (250.0, 1000.0), (333.3, 100.0)] {
        let mut scenario = contact(2, 5.80);
        scenario.loop_rate = loop_rate;
        scenario.tracker.rate = tracker_rate;
        scenario.filter.length = (loop_rate * 0.5) as u64;
        let detection = run(&scenario).detection().expect("detected");
        assert!((detection.time - 6.279).abs() < 0.05, "{loop_rate} {tracker_rate}: {detection:?}");
    }
}
