//! How well contacts on three segments are told and placed: many runs of the preset `three-segments` with contacts around the middle of each
//! segment. `cargo run --release --example chain_contacts -- 200` prints the figures of docs/CHAIN.md.

#![allow(clippy::disallowed_methods, reason = "an example reads its arguments")]

use centrode_core::detect::Method;
use centrode_core::detect::chain::ChainMethod;
use centrode_core::noise::{Normal, Source};
use centrode_core::scenario::preset::find_chain;
use centrode_core::scenario::{ChainPlan, ChainScenario};
use centrode_core::study::chain::ChainRun;
use rayon::prelude::*;

/// Times after the alarm, s.
const AFTER: [f64; 3] = [0.1, 0.25, 0.5];

/// What one run came to, by time after the alarm: whether the segment is right, how far the place is off (m), whether the interval holds it, and
/// the probability that was given to the segment named.
struct Outcome {
    segment: usize,
    early: bool,
    told: Vec<Option<(bool, f64, bool, f64)>>,
}

fn scenario(sets: &[String]) -> Result<ChainScenario, String> {
    let preset = find_chain("three-segments").ok_or("no such preset")?;
    preset.chain(sets).map_err(|error| error.to_string())
}

fn outcome(seed: u64, sets: &[&str]) -> Result<Outcome, String> {
    let segment = (seed % 3) as usize;
    let at = 0.015 + 0.005 * Normal::new(seed, Source::Calibration).symmetric();
    let mut all: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    all.push(format!("contact[1].segment={}", segment + 1));
    let mut scenario = scenario(&all)?.with_seed(seed);
    scenario.contacts[0].at = at;
    let plan = ChainPlan::new(&scenario).map_err(|error| error.to_string())?;
    let run = ChainRun::new(plan);
    let found = run.judged.contacts(ChainMethod::Of(Method::Cusum), &AFTER);
    let first = found.first();
    let early = first.is_none_or(|found| found.alarm < 5.8);
    let told = AFTER.iter().map(|after| {
        let estimate = first?.estimates.iter().find(|estimate| estimate.after == *after)?;
        let right = estimate.segment == segment;
        let off = estimate.place.mean - at;
        let holds = estimate.place.low <= at && at <= estimate.place.high;
        Some((right, off, holds, estimate.probabilities[estimate.segment]))
    });
    Ok(Outcome { segment, early, told: told.collect() })
}

fn main() -> Result<(), String> {
    let runs: u64 = match std::env::args().nth(1) {
        None => 30,
        Some(count) => count.parse().map_err(|error| format!("how many runs: {error}"))?,
    };
    let placed = std::env::args().nth(2).is_none_or(|what| what != "free");
    for (name, sets) in
        [("all disks", &[][..]), ("all disks, 0.3° of play", &["calibration.play=0.005235987755982988"][..])]
            .into_iter()
            .filter(|_| placed)
    {
        let outcomes: Vec<Outcome> =
            (1..=runs).into_par_iter().map(|seed| outcome(seed, sets)).collect::<Result<_, _>>()?;
        let early = outcomes.iter().filter(|outcome| outcome.early).count();
        println!("{name}: {runs} runs, {early} with an alarm before the contact or none");
        for (k, after) in AFTER.iter().enumerate() {
            let told: Vec<_> =
                outcomes.iter().filter(|outcome| !outcome.early).filter_map(|outcome| outcome.told[k]).collect();
            let count = told.len() as f64;
            let share = |of: fn(&(bool, f64, bool, f64)) -> bool| {
                100.0 * told.iter().filter(|told| of(told)).count() as f64 / count
            };
            let mean = told.iter().map(|told| told.3).sum::<f64>() / count;
            println!(
                "  +{after:.2} s: {count} told, segment right {:.1} % (said {:.1} %), 95 % intervals hold {:.1} %",
                share(|told| told.0),
                100.0 * mean,
                share(|told| told.0 && told.2)
            );
            for segment in 0..3 {
                let squares: Vec<f64> = outcomes
                    .iter()
                    .filter(|outcome| outcome.segment == segment && !outcome.early)
                    .filter_map(|outcome| outcome.told[k])
                    .filter(|told| told.0)
                    .map(|told| told.1 * told.1)
                    .collect();
                let held = outcomes
                    .iter()
                    .filter(|outcome| outcome.segment == segment && !outcome.early)
                    .filter_map(|outcome| outcome.told[k])
                    .filter(|told| told.0 && told.2);
                let held = 100.0 * held.count() as f64 / squares.len() as f64;
                let rms = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
                println!(
                    "          segment {}: {:.3} mm RMS, {held:.0} % held, of {}",
                    segment + 1,
                    rms * 1e3,
                    squares.len()
                );
            }
        }
    }
    let free: Vec<Option<usize>> = (1..=runs)
        .into_par_iter()
        .map(|seed| {
            let scenario = scenario(&[])?.without_contacts().with_seed(seed);
            let run = ChainRun::new(ChainPlan::new(&scenario).map_err(|error| error.to_string())?);
            let alarm = run.judged.events.iter().find(|event| event.detector == ChainMethod::Of(Method::Cusum));
            Ok::<_, String>(alarm.map(|event| event.segment + 1))
        })
        .collect::<Result<_, _>>()?;
    let by: Vec<usize> = (1..=3).map(|segment| free.iter().filter(|alarm| **alarm == Some(segment)).count()).collect();
    println!("free: {} of {runs} runs with a false alarm, by segment {by:?}", by.iter().sum::<usize>());
    Ok(())
}
