//! Any possible experiment from end to end: what is defined is a number, and what ought to change nothing changes nothing.

use super::bytes::Bytes;
use super::relations;
use centrode_core::run::{CHANNELS, EXTRA, Run};
use centrode_core::scenario::chain::{ChainDraft, ChainPlan};
use centrode_core::scenario::keys::{Allowed, KEYS, Key, Value};
use centrode_core::scenario::preset::CHAINS;
use centrode_core::scenario::{ContactKind, Plan, Scenario};
use centrode_core::study::chain::ChainRun;
use std::sync::LazyLock;

/// Longer runs (samples) are run at a lower rate.
const MOST: f64 = 60.0;
/// Channels without which nothing is: all that comes before what detectors make of it.
const MEASURED: usize = 19;

/// One segment. Of the first byte, two bits say with what a run is compared, and the third that it is looked at by itself instead.
pub fn run(bytes: &[u8]) {
    let Some((&way, rest)) = bytes.split_first() else { return };
    let mut scenario = shortened(chosen(&mut Bytes(rest)));
    scenario.contact.kind = affordable(scenario.contact.kind, rest);
    match way & 4 {
        0 => relations::hold(&scenario, way),
        _ => defined(&scenario),
    }
}

/// To follow a beam that slides takes as long as many other runs, around a cylinder more. All bytes say where it is done, not one that
/// inputs could keep: what is rare is sought.
fn affordable(kind: ContactKind, bytes: &[u8]) -> ContactKind {
    let sum = bytes.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
    match kind {
        ContactKind::Cylinder if sum.is_multiple_of(64) => kind,
        ContactKind::Plane | ContactKind::Cylinder if sum.is_multiple_of(8) => ContactKind::Plane,
        _ => ContactKind::Clamp,
    }
}

/// Panics when something of a run is no number that is defined, or an event is none.
fn defined(scenario: &Scenario) {
    let Ok(plan) = Plan::new(scenario) else { return };
    let run = Run::new(plan);
    for sample in run.samples() {
        for (place, channel) in CHANNELS.iter().enumerate() {
            let value = (channel.value)(&sample);
            let fits = if place < MEASURED { value.is_finite() } else { !value.is_infinite() };
            assert!(fits, "{} is {value} at {} s", channel.name, sample.time);
        }
        for (_, channel) in EXTRA {
            assert!(!(channel.value)(&sample).is_infinite(), "{} at {} s", channel.name, sample.time);
        }
        assert!(sample.judgement.deviation.is_nan() || sample.judgement.deviation >= 0.0);
    }
    let end = run.sample(run.len() - 1).time;
    for event in run.events() {
        assert!((0.0..=end).contains(&event.raised) && event.value > event.threshold, "{event:?}");
        assert!(event.cleared.is_none_or(|cleared| event.raised <= cleared && cleared <= end), "{event:?}");
        if let Some(found) = event.detection {
            assert!((0.0..=scenario.robot.length).contains(&found.location) && !found.distance.is_nan(), "{found:?}");
        }
    }
}

/// The experiments that are shipped, with few samples.
static SLOW: LazyLock<Vec<ChainDraft>> = LazyLock::new(|| {
    let slow = |preset| ChainDraft::of(preset).overridden(["loop_rate=10", "filter.length=10"]);
    CHAINS.iter().map(|preset| slow(preset).expect("possible")).collect()
});

/// Several segments: one of the experiments that are shipped, with some values changed.
pub fn chain(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    // One input in eight places contacts, which takes as long as all else.
    let placed = bytes.below(8) == 7;
    let mut draft = SLOW[bytes.below(CHAINS.len())].clone();
    for _ in 0..bytes.below(6) {
        let line = changed(&mut bytes);
        if let Ok(other) = draft.overridden([line.as_str()]) {
            draft = other;
        }
    }
    let Ok(scenario) = draft.scenario() else { return };
    let Ok(plan) = ChainPlan::new(&scenario) else { return };
    let run = ChainRun::new(plan);
    if placed {
        let found = run.judged.teller().map_or_else(Vec::new, |teller| run.judged.contacts(teller, &[0.5]));
        for estimate in found.iter().flat_map(|found| &found.estimates) {
            let (place, along) = (&estimate.place, &estimate.along);
            assert!(place.mean.is_finite() && along.low <= along.mean && along.mean <= along.high, "{estimate:?}");
            let all: f64 = estimate.nothing + estimate.probabilities.iter().sum::<f64>();
            assert!((all - 1.0).abs() < 1e-9 && estimate.segment < scenario.segments.len(), "{estimate:?}");
        }
    }
    for event in &run.judged.events {
        assert!(event.raised.is_finite() && event.segment < scenario.segments.len(), "{event:?}");
    }
}

/// A value for one of the numbers of a chain.
fn changed(bytes: &mut Bytes) -> String {
    const NUMBERS: [(&str, f64, f64); 12] = [
        ("motion.theta_end", -0.5, 3.0),
        ("motion.delta_end", -3.2, 3.2),
        ("motion.delta_start", -3.2, 3.2),
        ("motion.start", 0.0, 3.0),
        ("motion.finish", 3.0, 10.0),
        ("length", 0.01, 0.08),
        ("pitch_radius", 0.001, 0.005),
        ("torsion", 0.5, 1.5),
        ("at", 0.0, 0.05),
        ("time", 0.0, 10.0),
        ("bend", -1.5, 1.5),
        ("tilt", -1.5, 1.5),
    ];
    let (list, number) = (["segment", "contact"][bytes.below(2)], 1 + bytes.below(3));
    let (key, low, high) = NUMBERS[bytes.below(NUMBERS.len())];
    format!("{list}[{number}].{key}={}", low + (high - low) * bytes.share())
}

/// The default scenario with some keys set, mostly to what is usual.
fn chosen(bytes: &mut Bytes) -> Scenario {
    let mut scenario = Scenario::default();
    while !bytes.is_empty() {
        let key = &KEYS[bytes.below(KEYS.len())];
        let mut tried = scenario.clone();
        if key.set(&mut tried, value(key, &scenario, bytes)).is_ok() && key.check(&tried).is_ok() {
            scenario = tried;
        }
    }
    scenario
}

/// The same with few enough samples.
fn shortened(mut scenario: Scenario) -> Scenario {
    scenario.loop_rate = scenario.loop_rate.min(MOST / scenario.motion.end);
    let samples = (scenario.motion.end * scenario.loop_rate) as usize;
    scenario.filter.length = scenario.filter.length.min(samples.max(1) as u64);
    scenario
}

/// Something that the key may hold, mostly.
fn value(key: &Key, scenario: &Scenario, bytes: &mut Bytes) -> Value {
    match key.allowed {
        Allowed::Words(words) => Value::Word(words[bytes.below(words.len())]),
        Allowed::Some(words) => {
            let held = bytes.byte();
            let few = words.iter().enumerate().filter(|(place, _)| held >> (place % 8) & 1 == 1);
            Value::Words(few.map(|(_, word)| *word).collect())
        }
        Allowed::Threshold if bytes.below(4) == 0 => Value::Off("off"),
        Allowed::Estimated(_) if bytes.below(2) == 0 => Value::Off("auto"),
        Allowed::Whole(..) | Allowed::Disk(_) | Allowed::FilterLength(_) => Value::Whole(bytes.byte().into()),
        Allowed::Vector(_) => Value::List((0..3).map(|_| number(key, scenario, bytes)).collect()),
        Allowed::Disks => {
            let count = 1 + bytes.below(6);
            let step = scenario.robot.length / count as f64;
            Value::List((1..=count).map(|disk| disk as f64 * step).collect())
        }
        _ => Value::Number(number(key, scenario, bytes)),
    }
}

fn number(key: &Key, scenario: &Scenario, bytes: &mut Bytes) -> f64 {
    if bytes.below(16) == 15 {
        return bytes.any();
    }
    let (low, high) = key.usual(scenario);
    low + (high - low) * bytes.share()
}
