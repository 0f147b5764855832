//! What the page and its worker tell one another: neither may stop at what it does not understand.

use centrode_core::scenario::chain::ChainDraft;
use centrode_core::scenario::preset::{CHAINS, find};
use centrode_core::scenario::{Plan, Scenario};
use centrode_core::study::chain::placing::{self, Placing};
use centrode_core::study::compare::{self, Compare};
use centrode_core::study::remote::{Answer, Found, Remote, Request, Work};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Spec, Study};
use std::sync::LazyLock;

/// Longer runs than these (samples) are left, for they only take time.
const MOST: usize = 400;

/// A request where it looks like one, else an answer.
pub fn messages(bytes: &[u8]) {
    match std::str::from_utf8(bytes) {
        Ok(text) if text.trim_start().starts_with('{') => request(text),
        _ => answer(bytes),
    }
}

fn request(text: &str) {
    let Ok(Request { id, work }) = serde_json::from_str(text) else { return };
    let long = |scenario: &Scenario| Plan::new(scenario).is_ok_and(|plan| plan.samples() > MOST);
    let too_much = match &work {
        Work::Thresholds { spec, .. } => spec.cells.len() > 8 || long(&spec.scenario),
        Work::Detectors { spec, .. } => long(&spec.scenario),
        Work::Contacts(spec) => {
            let scenario = ChainDraft::from_bytes(spec.scenario.as_bytes()).and_then(|draft| draft.scenario());
            scenario.is_ok_and(|scenario| long(scenario.common()))
        }
    };
    if too_much {
        return;
    }
    let Ok(mut remote) = Remote::new(text) else { return };
    (0..2).all(|_| remote.step());
    let bytes = remote.answer().expect("an answer can be written");
    assert_eq!(Answer::from_bytes(&bytes).expect("and read").id, id);
}

/// A short run, of which studies are made.
static SHORT: LazyLock<Scenario> = LazyLock::new(|| {
    let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("it is shipped");
    scenario.loop_rate = 20.0;
    scenario.filter.length = 10;
    scenario
});

/// What a page asks before it hears the answer.
static STUDY: LazyLock<Study> = LazyLock::new(|| Study::new(Spec::of(SHORT.clone(), 4)).expect("possible"));
static COMPARE: LazyLock<Compare> = LazyLock::new(|| {
    let detector = SHORT.detection.detectors.iter().next().expect("one judges");
    let spec = compare::Spec { scenario: SHORT.clone(), repeats: 4, rate: 0.1, detector, after: vec![0.5] };
    Compare::new(spec).expect("possible")
});

static PLACING: LazyLock<Placing> = LazyLock::new(|| {
    let slow = ["loop_rate=20", "filter.length=10"];
    let draft = ChainDraft::of(&CHAINS[0]).overridden(slow).expect("possible");
    let spec = placing::Spec { scenario: draft.to_toml(), time: 0.0 };
    Placing::new(&spec.run().expect("possible"))
});

fn answer(bytes: &[u8]) {
    match Answer::from_bytes(bytes) {
        Ok(Answer { found: Found::Thresholds(tallies), .. }) => {
            let mut study = STUDY.clone();
            for (batch, tally) in tallies {
                study.set(batch as usize, tally);
            }
            for rule in Rule::ALL {
                assert_eq!(study.curve(0, *rule).len(), study.levels(0, *rule).len());
            }
            let _ = study.contact_time(0);
        }
        Ok(Answer { found: Found::Detectors(made), .. }) => {
            let mut compare = COMPARE.clone();
            let wanted = made.len() as u64;
            let fit = made.into_iter().filter(|made| compare.add(made.clone())).count() as u64;
            assert!(compare.repeats() <= fit && fit <= wanted);
        }
        Ok(Answer { found: Found::Contacts(parts), .. }) => {
            let mut placing = PLACING.clone();
            let fit = parts.into_iter().filter(|part| placing.add(part.clone())).count() as u64;
            assert!(placing.progress().done <= fit);
        }
        Err(_) => {}
    }
}
