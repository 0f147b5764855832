//! How well contacts on three segments are told and placed: many runs of the presets `three-segments` and `two-contacts` with contacts
//! around the middle of each segment. `cargo run --release --example chain_contacts -- 200` prints the figures of docs/CHAIN.md; `-- 200 tip` those of one case.

#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "an example reads its arguments and its clock")]

use centrode_core::detect::Method;
use centrode_core::detect::chain::ChainMethod;
use centrode_core::noise::{Normal, Source};
use centrode_core::scenario::chain::Stands;
use centrode_core::scenario::preset::find_chain;
use centrode_core::scenario::{ChainPlan, ChainScenario};
use centrode_core::study::chain::ChainRun;
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::time::{Duration, Instant};

/// Times after the alarm, s.
const AFTER: [f64; 3] = [0.1, 0.25, 0.5];
/// Where one estimate takes seconds.
const LATE: [f64; 1] = [0.5];
/// Probabilities between which runs are put together.
const GROUPS: [f64; 6] = [0.0, 0.5, 0.7, 0.9, 0.99, 1.0 + 1e-9];

/// Runs of one kind.
#[derive(Clone, Copy)]
struct Case {
    name: &'static str,
    title: &'static str,
    preset: &'static str,
    /// Which of its contacts is asked for, which of those found is to be it, and when it begins, s.
    contact: (usize, usize, f64),
    sets: &'static [&'static str],
    /// Whether planes stand with any tilt, each as likely as the others.
    tilted: bool,
    /// When contacts are placed, s after their alarms.
    after: &'static [f64],
}

const PLAY: &str = "calibration.play=0.005235987755982988";
const TIP: &str = "tracker.disks=tip";
const STILL: [&str; 4] = [
    "segment[1].motion.theta_end=1.5707963267948966",
    "segment[2].motion.theta_end=1.5707963267948966",
    "segment[2].motion.delta_end=0",
    "contact[1].kind=clamp",
];

const ALL: Case = Case {
    name: "all",
    title: "all disks",
    preset: "three-segments",
    contact: (0, 0, 5.8),
    sets: &[],
    tilted: false,
    after: &AFTER,
};
const TWO: Case = Case { preset: "two-contacts", ..ALL };

const CASES: [Case; 10] = [
    ALL,
    Case { name: "play", title: "all disks, 0.3° of play", sets: &[PLAY], ..ALL },
    Case {
        name: "errors",
        title: "all disks, 2 % of length, 1° of frame, 2° of δ (drawn)",
        sets: &[
            "calibration.draw=drawn",
            "calibration.length=0.02",
            "calibration.frame_turn=[0.0174532925, 0.0174532925, 0.0174532925]",
            "calibration.delta=0.034906585",
        ],
        ..ALL
    },
    Case { name: "tilted", title: "all disks, planes of any tilt", tilted: true, ..ALL },
    Case { name: "clamped", title: "all disks, clamps where what is below rests", sets: &STILL, ..ALL },
    Case { name: "first", title: "all disks, the first of two contacts", contact: (0, 0, 5.2), ..TWO },
    Case { name: "second", title: "all disks, the second of two contacts", contact: (1, 1, 6.8), ..TWO },
    Case {
        name: "together",
        title: "all disks, the inner of two contacts that begin together",
        contact: (0, 0, 5.2),
        sets: &["contact[1].time=5.2"],
        ..TWO
    },
    Case { name: "tip", title: "the tip alone", sets: &[TIP], after: &LATE, ..ALL },
    Case { name: "tip-play", title: "the tip alone, 0.3° of play", sets: &[TIP, PLAY], after: &LATE, ..ALL },
];

/// What was told of a contact some time after its alarm.
#[derive(Clone, Copy)]
struct Told {
    right: bool,
    /// How far the place is off, m.
    off: f64,
    /// Whether the interval along the whole backbone holds the contact.
    holds: bool,
    /// The probability of the segment that was named.
    said: f64,
}

/// What one run came to.
struct Outcome {
    segment: usize,
    /// Whether there was an alarm before the contact, or none of it.
    early: bool,
    told: Vec<Option<Told>>,
    spent: Duration,
}

fn scenario(preset: &str, sets: &[String]) -> Result<ChainScenario, String> {
    let preset = find_chain(preset).ok_or("no such preset")?;
    preset.chain(sets).map_err(|error| error.to_string())
}

fn outcome(seed: u64, case: &Case) -> Result<Outcome, String> {
    let mut normal = Normal::new(seed, Source::Calibration);
    let mut drawn = || 0.015 + 0.005 * normal.symmetric();
    let mut all: Vec<String> = case.sets.iter().map(|set| (*set).to_owned()).collect();
    let (contact, place, begins) = case.contact;
    if case.preset == ALL.preset && case.name != "clamped" {
        all.push(format!("contact[1].segment={}", seed % 3 + 1));
    }
    let mut scenario = scenario(case.preset, &all)?.with_seed(seed);
    scenario.contacts.iter_mut().for_each(|contact| contact.at = drawn());
    let (segment, at) = (scenario.contacts[contact].segment, scenario.contacts[contact].at);
    let tilt = FRAC_PI_2 * normal.symmetric();
    if let (true, Stands::From { time, .. }) = (case.tilted, scenario.contacts[0].stands) {
        scenario.contacts[0].stands = Stands::From { time, tilt };
    }
    let plan = ChainPlan::new(&scenario).map_err(|error| error.to_string())?;
    let run = ChainRun::new(plan);
    let begun = Instant::now();
    let found = run.judged.contacts(ChainMethod::Of(Method::Cusum), case.after);
    let spent = begun.elapsed();
    let alarm = found.get(place).filter(|found| found.alarm >= begins);
    let early = alarm.is_none();
    let truth = at + scenario.segments[..segment].iter().map(|of| of.alone.scenario().robot.length).sum::<f64>();
    let told = case.after.iter().map(|after| {
        let estimate = alarm?.estimates.iter().find(|estimate| estimate.after == *after)?;
        Some(Told {
            right: estimate.segment == segment,
            off: estimate.place.mean - at,
            holds: estimate.along.low <= truth && truth <= estimate.along.high,
            said: estimate.probabilities[estimate.segment],
        })
    });
    Ok(Outcome { segment, early, told: told.collect(), spent })
}

fn percent(part: usize, whole: usize) -> f64 {
    100.0 * part as f64 / whole as f64
}

fn show(case: &Case, runs: u64) -> Result<(), String> {
    let outcomes: Vec<Outcome> =
        (1..=runs).into_par_iter().map(|seed| outcome(seed, case)).collect::<Result<_, _>>()?;
    let heard: Vec<&Outcome> = outcomes.iter().filter(|outcome| !outcome.early).collect();
    let each: f64 =
        heard.iter().map(|outcome| outcome.spent.as_secs_f64()).sum::<f64>() / (case.after.len() * heard.len()) as f64;
    println!(
        "{}: {runs} runs, {} with an alarm before the contact or none; {:.0} ms an estimate",
        case.title,
        outcomes.len() - heard.len(),
        1e3 * each
    );
    for (k, after) in case.after.iter().enumerate() {
        let told: Vec<(usize, Told)> =
            heard.iter().filter_map(|outcome| Some((outcome.segment, outcome.told[k]?))).collect();
        let count = |of: fn(&Told) -> bool| told.iter().filter(|(_, told)| of(told)).count();
        let said = told.iter().map(|(_, told)| told.said).sum::<f64>() / told.len() as f64;
        println!(
            "  +{after:.2} s: {} told, segment right {:.1} % (said {:.1} %), 95 % intervals hold {:.1} %",
            told.len(),
            percent(count(|told| told.right), told.len()),
            100.0 * said,
            percent(count(|told| told.holds), told.len()),
        );
        for segment in 0..3 {
            let own: Vec<&Told> =
                told.iter().filter(|(of, told)| *of == segment && told.right).map(|(_, told)| told).collect();
            if own.is_empty() {
                continue;
            }
            let rms = (own.iter().map(|told| told.off * told.off).sum::<f64>() / own.len() as f64).sqrt();
            let held = percent(own.iter().filter(|told| told.holds).count(), own.len());
            println!("    segment {}: {:.3} mm RMS, {held:.0} % held, of {}", segment + 1, rms * 1e3, own.len());
        }
        for pair in GROUPS.windows(2) {
            let of: Vec<&Told> =
                told.iter().map(|(_, told)| told).filter(|told| (pair[0]..pair[1]).contains(&told.said)).collect();
            if of.is_empty() || of.len() == told.len() {
                continue;
            }
            let said = of.iter().map(|told| told.said).sum::<f64>() / of.len() as f64;
            let right = percent(of.iter().filter(|told| told.right).count(), of.len());
            println!("    said {:.1} %: right {right:.1} %, of {}", 100.0 * said, of.len());
        }
    }
    Ok(())
}

/// False alarms of robots that touch nothing.
fn free(runs: u64, title: &str, sets: &[&str]) -> Result<(), String> {
    let alarms = (1..=runs).into_par_iter().map(|seed| {
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        let scenario = scenario(ALL.preset, &sets)?.without_contacts().with_seed(seed);
        let run = ChainRun::new(ChainPlan::new(&scenario).map_err(|error| error.to_string())?);
        Ok::<_, String>(run.judged.events.iter().any(|event| event.detector == ChainMethod::Of(Method::Cusum)))
    });
    let alarms: Vec<bool> = alarms.collect::<Result<_, _>>()?;
    println!("free, {title}: {} of {runs} runs with a false alarm", alarms.iter().filter(|alarm| **alarm).count());
    Ok(())
}

fn main() -> Result<(), String> {
    let runs: u64 = match std::env::args().nth(1) {
        None => 30,
        Some(count) => count.parse().map_err(|error| format!("how many runs: {error}"))?,
    };
    let asked = std::env::args().nth(2);
    let wanted = |name: &str| asked.as_ref().is_none_or(|asked| asked == name);
    for case in CASES.iter().filter(|case| wanted(case.name)) {
        show(case, runs)?;
    }
    if wanted("free") {
        free(runs, "all disks", &[])?;
        free(runs, "the tip alone", &[TIP])?;
        free(runs, "the tip alone, 0.3° of play", &[TIP, PLAY])?;
    }
    Ok(())
}
