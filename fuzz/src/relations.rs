//! What ought to change nothing: turning the base, mirroring, and beginning later.

use centrode_core::run::Run;
use centrode_core::scenario::{Calibration, CellErrors, Load, Mounting, Plan, Scenario, Start};

/// Turned by a third the three secondary backbones change places; in between they differ a little in how they push (Eq. 10).
const THIRD: f64 = std::f64::consts::TAU / 3.0;
/// Turned by this, rad, nothing changes places.
const TURN: f64 = 0.7;
/// Later by this, s: a whole number of the loop's and of the tracker's periods.
const LATER: f64 = 1.0;
/// Rates of the loop and of the tracker, Hz.
const RATES: [f64; 2] = [10.0, 5.0];
/// Readings come at some of the loop's samples only: so many more until the filter holds what it can.
const SPARE: usize = 4;
/// Centrodes are compared where the disk turns faster than this, rad/s: below it their distance is rounding, enlarged.
const SLOWEST: f64 = 0.02;

/// Panics when a detector sees a difference that is none, in one of the four ways of making one.
pub fn hold(scenario: &Scenario, way: u8) {
    // Short, exact, and with nothing in it that knows which way the base lies, or what time it is.
    let Some(plain) = plain(scenario) else { return };
    let Ok(plan) = Plan::new(&plain) else { return };
    let run = Run::new(plan);
    let turned =
        |delta| Scenario { motion: centrode_core::scenario::Motion { delta, ..plain.motion.clone() }, ..plain.clone() };
    match way % 4 {
        0 => same(("turned", false), &run, &turned(plain.motion.delta + TURN), 0),
        1 => same(("turned by a third", true), &run, &turned(plain.motion.delta + THIRD), 0),
        2 => same(("mirrored", true), &run, &turned(-plain.motion.delta), 0),
        _ => same(("later", true), &run, &later(&plain), (LATER * plain.loop_rate) as usize),
    }
}

fn plain(scenario: &Scenario) -> Option<Scenario> {
    let mut plain = scenario.clone();
    let [rate, tracker] = RATES;
    (plain.loop_rate, plain.tracker.rate) = (rate, tracker);
    (plain.calibration, plain.load) = (Calibration::default(), Load::default());
    (plain.tracker.position_noise, plain.tracker.orientation_noise) = (0.0, 0.0);
    (plain.tracker.position_resolution, plain.tracker.orientation_resolution) = (0.0, 0.0);
    plain.tracker.mounting = Mounting::BendingAxis;
    (plain.load_cells.noise, plain.load_cells.errors) = (0.0, CellErrors::Common);
    // Nothing is decided at the very instant of a sample, where rounding would decide.
    let between = |time: f64| ((time * rate).floor() + 0.37) / rate;
    plain.detection.armed_from = between(plain.detection.armed_from);
    plain.tracker.latency = between(plain.tracker.latency);
    if let Start::Time(time) = plain.contact.start {
        plain.contact.start = Start::Time(between(time));
    }
    let samples = plain.motion.end * rate;
    plain.filter.length = plain.filter.length.clamp(2, 4);
    (10.0..=150.0).contains(&samples).then_some(plain)
}

fn later(scenario: &Scenario) -> Scenario {
    let mut later = scenario.clone();
    for time in
        [&mut later.motion.start, &mut later.motion.finish, &mut later.motion.end, &mut later.detection.armed_from]
    {
        *time += LATER;
    }
    if let Start::Time(time) = &mut later.contact.start {
        *time += LATER;
    }
    later
}

/// Compares what is seen, so many samples later; `forces` says whether those of the backbones are the same, too.
fn same((how, forces): (&str, bool), run: &Run, scenario: &Scenario, by: usize) {
    let Ok(plan) = Plan::new(scenario) else { return };
    let other = Run::new(plan);
    // Who begins later has filled the filter at rest.
    let [rate, tracker] = RATES;
    let filled = (rate * (scenario.filter.length as f64 / tracker + scenario.tracker.latency)) as usize + SPARE;
    for k in if by > 0 { filled } else { 0 }..run.len() {
        let (one, two) = (run.sample(k), other.sample(k + by));
        assert_eq!(one.in_contact, two.in_contact, "{how}: contact at {} s", one.time);
        if one.judgement.speed.min(two.judgement.speed) < SLOWEST {
            continue;
        }
        // A residual is what is left of moments that cancel: it is no more exact than they are.
        let moment = scenario.robot.pitch_radius * one.tau_lc.norm().max(two.tau_lc.norm());
        for (name, a, b, rounding) in [
            ("deviation", one.judgement.deviation, two.judgement.deviation, 0.0),
            ("speed", one.judgement.speed, two.judgement.speed, 0.0),
            ("residual", one.judgement.residual, two.judgement.residual, 1e-12 * moment),
        ] {
            let near = (a - b).abs() <= 1e-8 + 1e-6 * a.abs() + rounding || a.is_nan() && b.is_nan();
            assert!(near || name == "residual" && !forces, "{how}: {name} is {a}, and {b}, at {} s", one.time);
        }
    }
}
