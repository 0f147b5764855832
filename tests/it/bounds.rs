//! Detectors and estimates against what no detector and no estimator can do better.

use centrode_core::detect::Method;
use centrode_core::detect::calibration::bound::{self, Beginning, place};
use centrode_core::detect::calibration::course::{Moment, Planner};
use centrode_core::detect::estimates::marginal;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Choice, Detectors, Estimated, Kind, Scenario};

/// A preset with a loop at the tracker's rate, its noise known, and cusum alone.
fn preset(name: &str, seed: u64) -> Scenario {
    let mut scenario = find(name).and_then(|preset| preset.scenario()).expect(name);
    (scenario.loop_rate, scenario.seed) = (100.0, seed);
    scenario.filter.length = 50;
    (scenario.tracker.position_noise, scenario.tracker.orientation_noise) = (5e-5, 0.01_f64.to_radians());
    scenario.prior.position_noise = Estimated::Known(scenario.tracker.position_noise);
    scenario.prior.orientation_noise = Estimated::Known(scenario.tracker.orientation_noise);
    scenario.prior.colour = Estimated::Known(0.0);
    scenario.detection.detectors = Detectors::of(&[Method::Cusum]);
    scenario.estimation.plants = Choice::of(&[Kind::Clamp]);
    scenario
}

fn moments(run: &Run) -> Vec<Moment> {
    let watched = run.judged.watched.as_ref().expect("watched");
    Planner::all(&watched.model, &watched.readings.commands, false)
}

/// When a run's contact began.
fn began(run: &Run) -> Beginning {
    let watched = run.judged.watched.as_ref().expect("watched");
    let contact = run.plan.contact().expect("one");
    Beginning::of(&watched.readings.commands, contact.bend, contact.side).expect("readings before and after")
}

fn length(run: &Run) -> f64 {
    run.plan.segment().length
}

/// Readings from contact to alarm; many where there is none after it.
fn delay(run: &Run) -> usize {
    let watched = run.judged.watched.as_ref().expect("watched");
    let after = |raised: f64| watched.at(raised).and_then(|alarm| alarm.checked_sub(began(run).reading));
    run.judged.first(Method::Cusum).and_then(|event| after(event.raised)).unwrap_or(usize::MAX)
}

fn median(mut values: Vec<usize>) -> usize {
    values.sort_unstable();
    values[values.len() / 2]
}

#[test]
fn the_best_test_of_all_is_as_fast_as_an_independent_program_has_it_and_cusum_no_faster() {
    for (name, expected) in [("disk-1", 5_usize), ("bench", 3), ("disk-3", 2)] {
        let run = simulate(&preset(name, 1)).expect("possible");
        let contact = run.plan.contact().expect("one").arc_length;
        let best =
            bound::delay(&moments(&run), length(&run), (contact, began(&run)), 0.01, 0.5).expect("enough readings");
        assert_eq!(best, expected, "{name}: readings");
        let ours: Vec<usize> = (1..=31).map(|seed| delay(&simulate(&preset(name, seed)).expect("possible"))).collect();
        let ours = median(ours);
        assert!(ours >= best && ours <= 3 * best, "{name}: {ours} readings, and {best} of the best");
    }
}

#[test]
fn a_bound_on_the_place_falls_and_the_posterior_is_as_wide() {
    for name in ["disk-1", "bench", "disk-3"] {
        // Commands and noise are the same in every run, and so are moments and bound.
        let first = simulate(&preset(name, 1)).expect("possible");
        let (began, contact) = (began(&first), first.plan.contact().expect("one").arc_length);
        let bound = place(&moments(&first), length(&first), contact, began);
        assert!(bound.windows(2).all(|pair| pair[1] <= pair[0]), "{name}: {bound:?}");
        assert!(bound[100] < 0.1 * bound[5], "{name}: {bound:?}");
        let ratio = |seed: u64| {
            let run = simulate(&preset(name, seed)).expect("possible");
            let (watched, settings) = (run.judged.watched.as_ref().expect("watched"), &run.judged.settings);
            let alarm = run.judged.first(Method::Cusum).expect("an alarm").raised;
            let time = alarm + 0.5;
            let estimate = marginal(watched, &settings.placing, alarm, time).expect("placed");
            let [one, first, second] =
                estimate.posterior.iter().fold([0.0; 3], |[one, first, second], &[s, density]| {
                    let off = s - estimate.place.mean;
                    [one + density, first + density * off, second + density * off * off]
                });
            let mean = first / one;
            // The bound begins with the reading after the contact.
            let at = watched.at(time).expect("readings") - began.reading - 1;
            (second / one - mean * mean).sqrt() / bound[at]
        };
        let ratios: Vec<f64> = (1..=12).map(ratio).collect();
        assert!(ratios.iter().all(|ratio| (0.8..1.4).contains(ratio)), "{name}: {ratios:?}");
    }
}
