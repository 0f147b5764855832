//! Studies in shares: the whole has the bits of a study made at once, and whatever does not belong to it is refused by name.

use centrode_core::detect::Method;
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Detectors, Scenario};
use centrode_core::study::Job;
use centrode_core::study::compare::{self, Compare, Piece, with};
use centrode_core::study::remote::Found;
use centrode_core::study::share::{Asked, Merge, MergeError, Part, Share, Whole};
use centrode_core::study::tuning::recommend::Wish;
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Spec, Study};
use proptest::prelude::*;
use std::sync::LazyLock;

const WISH: Wish = Wish { rule: Rule::Or, false_alarm_rate: 0.1 };

fn scenario(sets: &[&str]) -> Scenario {
    let mut draft = find("bench").and_then(|preset| preset.draft()).expect("bench");
    // A loop as fast as the tracker, which makes many runs cheap.
    ["loop_rate=100", "filter.length=50"].iter().chain(sets).for_each(|set| draft.set(set).expect(set));
    draft.finish().expect("valid")
}

fn spec(repeats: usize) -> Spec {
    let cells = [30, 50, 70].map(|length| vec![format!("filter.length={length}").parse().expect("a key")]);
    Spec { cells: cells.into(), ..Spec::of(scenario(&[]), repeats) }
}

fn share(number: u32, of: u32) -> Share {
    Share::new(number, of).expect("a share")
}

fn thresholds(spec: &Spec, wish: Wish, share: Share) -> Part {
    let mut study = Study::new(spec.clone()).expect("possible");
    for piece in share.range(study.progress().of) {
        let piece = study.piece(piece);
        let firsts = study.run(piece);
        study.add(piece.0, &firsts);
    }
    Part::of_thresholds(&study, wish, share)
}

fn comparison(repeats: usize, rate: f64) -> Compare {
    let scenario = with(&scenario(&["estimation.plants=[\"clamp\"]"]), &[Method::FcdVelocity, Method::Cusum]);
    let spec = compare::Spec { scenario, repeats, rate, detector: Method::Cusum, after: vec![0.1] };
    Compare::new(spec).expect("possible")
}

fn detectors(mut compare: Compare, share: Share) -> Part {
    for repeat in share.range(compare.progress().of) {
        let made = compare.make(Piece(repeat));
        assert!(compare.add(made));
    }
    Part::of_detectors(&compare, Detectors::of(&[Method::Fcd]), share)
}

fn merged(parts: &[&Part]) -> Result<Whole, MergeError> {
    let mut merge = Merge::default();
    for (k, part) in parts.iter().enumerate() {
        merge.add(&format!("file-{k}"), part.to_text().expect("JSON").as_bytes())?;
    }
    merge.finish()
}

fn refused(parts: &[&Part]) -> String {
    merged(parts).expect_err("refused").to_string()
}

#[test]
fn shares_in_any_order_and_some_twice_are_the_study_made_at_once() {
    // More shares than runs of a batch, so that some batches are in none of a share's runs, and some shares have none.
    for of in [1, 3, 7, 40] {
        let spec = spec(5);
        let parts: Vec<Part> = (1..=of).map(|number| thresholds(&spec, WISH, share(number, of))).collect();
        let mut order: Vec<&Part> = parts.iter().rev().chain(&parts[..parts.len() / 2]).collect();
        order.rotate_left(parts.len() / 3);
        let Ok(Whole::Thresholds(study, wish)) = merged(&order) else { panic!("of thresholds") };
        let mut whole = Study::new(spec).expect("possible");
        whole.finish();
        assert_eq!((*study, wish), (whole, WISH));
    }
}

#[test]
fn compared_detectors_keep_the_bits_of_their_numbers() {
    let parts: Vec<Part> = (1..=3).map(|number| detectors(comparison(7, 0.2), share(number, 3))).collect();
    let Ok(Whole::Detectors(compare, judging)) = merged(&[&parts[2], &parts[0], &parts[2], &parts[1]]) else {
        panic!("of detectors")
    };
    let mut whole = comparison(7, 0.2);
    whole.finish();
    let made = |compare: &Compare| format!("{:?}", compare.made(0..7).collect::<Vec<_>>());
    assert_eq!(made(&compare), made(&whole));
    assert_eq!(format!("{:?}", compare.comparison()), format!("{:?}", whole.comparison()));
    assert_eq!(judging, Detectors::of(&[Method::Fcd]));
}

#[test]
fn what_is_missing_is_named() {
    let spec = spec(4);
    let one = thresholds(&spec, WISH, share(2, 20));
    let said = refused(&[&one]);
    assert!(said.starts_with("shares 1/20, 3/20, 4/20") && said.ends_with("and 9 more are missing"), "{said}");
    let two: Vec<Part> = [1, 3].map(|number| thresholds(&spec, WISH, share(number, 3))).into();
    assert_eq!(refused(&[&two[1], &two[0]]), "share 2/3 is missing");
    assert_eq!(merged(&[]).err(), Some(MergeError::Nothing));
}

#[test]
fn a_share_of_another_study_is_refused_by_what_differs() {
    let first = thresholds(&spec(4), WISH, share(1, 3));
    let two = share(2, 3);
    let other_scenario = Spec { scenario: scenario(&["tracker.position_noise=1e-4"]), ..spec(4) };
    let late = Spec { late: 0.5, ..spec(4) };
    let cells = Spec { cells: vec![Vec::new()], ..spec(4) };
    let own = Spec { own: false, ..spec(4) };
    let quieter = Wish { false_alarm_rate: 0.05, ..WISH };
    let rule = Wish { rule: Rule::Fcd, ..WISH };
    for (part, what) in [
        (thresholds(&other_scenario, WISH, two), "tracker.position_noise = 0.0001, not 0.00005"),
        (thresholds(&spec(5), WISH, two), "--repeats 5, not 4"),
        (thresholds(&late, WISH, two), "--late 0.5, not 1"),
        (thresholds(&cells, WISH, two), "cells "),
        (thresholds(&own, WISH, two), "other thresholds"),
        (thresholds(&spec(4), rule, two), "--method fcd, not or"),
        (thresholds(&spec(4), quieter, two), "--false-alarms 0.05, not 0.1"),
        (thresholds(&spec(4), WISH, share(2, 4)), "one of 4 shares, not of 3"),
        (detectors(comparison(4, 0.2), two), "one of detectors, not of thresholds"),
    ] {
        let said = refused(&[&first, &part]);
        assert!(said.starts_with("file-1 is a share of another study than file-0: "), "{said}");
        assert!(said.contains(what), "{what}: {said}");
    }
    let first = detectors(comparison(3, 0.2), share(1, 3));
    let said = refused(&[&first, &detectors(comparison(3, 0.3), two)]);
    assert!(said.ends_with("--rate 0.3, not 0.2"), "{said}");
}

#[test]
fn other_programs_other_counts_and_other_runs_are_refused() {
    let [one, two] = [1, 2].map(|number| thresholds(&spec(4), WISH, share(number, 2)));
    let other = Part { probe: two.probe ^ 1, program: "0.0.9".into(), ..two.clone() };
    assert!(
        refused(&[&one, &other]).starts_with("file-1 was made by a program that computes otherwise (centrode 0.0.9)")
    );
    let counted = |change: fn(&mut Vec<(u32, centrode_core::study::tuning::tally::Tally)>)| {
        let mut part = two.clone();
        let Found::Thresholds(tallies) = &mut part.found else { panic!("of thresholds") };
        change(tallies);
        part
    };
    // As whoever writes the checksum anew could say it.
    let early = counted(|tallies| tallies[0].1.counts[0][0].early += 1);
    assert!(refused(&[&one, &two, &early]).ends_with("both share 2/2, but differ; one of them is wrong"));
    for wrong in [
        counted(|tallies| tallies[0].1.counts[0][0].early = u64::MAX),
        counted(|tallies| tallies[0].1.counts[0][0].late = u64::MAX),
        counted(|tallies| tallies[0].1.counts[0][0].early_samples = u64::MAX),
        counted(|tallies| tallies[0].1.counts[0][0].found = vec![(7, 1), (7, 1)]),
        counted(|tallies| tallies[0].1.counts[0][0].found = vec![(u32::MAX, 1)]),
        counted(|tallies| tallies[0].1.counts[0].truncate(3)),
        counted(|tallies| tallies[0].1.counts.clear()),
        counted(|tallies| tallies[0].1.runs += 1),
        counted(|tallies| tallies[0].0 = 99),
        counted(|tallies| tallies.truncate(1)),
        counted(|tallies| tallies.push(tallies[0].clone())),
        Part { found: Found::Detectors(Vec::new()), ..two.clone() },
    ] {
        let said = refused(&[&wrong]);
        assert!(said.starts_with("file-0 is damaged: these are not the runs of share "), "{said}");
    }
    let repeats = |part: &Part| match &part.found {
        Found::Detectors(made) => made.clone(),
        _ => panic!("of detectors"),
    };
    let made = detectors(comparison(4, 0.2), share(2, 2));
    for wrong in [repeats(&made)[1..].to_vec(), vec![repeats(&made)[0].clone(); 2]] {
        let said = refused(&[&Part { found: Found::Detectors(wrong), ..made.clone() }]);
        assert!(said.contains("not the runs of share 2/2"), "{said}");
    }
}

#[test]
fn an_impossible_study_is_refused_by_its_value() {
    let mut part = thresholds(&spec(4), WISH, share(1, 1));
    let Asked::Thresholds { spec, .. } = &mut part.study else { panic!("of thresholds") };
    spec.scenario.robot.length = -1.0;
    let said = refused(&[&part]);
    assert!(said.starts_with("file-0: ") && said.contains("robot.length"), "{said}");
}

/// A share as its file.
static FILE: LazyLock<String> = LazyLock::new(|| {
    let part = thresholds(&Spec { cells: vec![Vec::new()], ..spec(2) }, WISH, share(1, 1));
    part.to_text().expect("JSON")
});

fn read(text: &str) -> Result<Part, MergeError> {
    Part::read("x", text.as_bytes())
}

#[test]
fn files_are_told_apart() {
    let indented = FILE.replace(",", ",\n ").replace(":{", " : {");
    assert_eq!(read(&indented), read(&FILE));
    assert!(read(&FILE).is_ok());
    for text in ["", "{}", "[]", "null", "{\"format\":\"geojson\",\"version\":1}", "\u{0}"] {
        assert_eq!(read(text).err(), Some(MergeError::NoShare { name: "x".into() }), "{text}");
    }
    let newer = FILE.replacen("\"version\":1", "\"version\":2", 1);
    assert_eq!(read(&newer).err(), Some(MergeError::Format { name: "x".into(), version: 2 }));
}

proptest! {
    /// Whatever is changed in a file is noticed, but for spaces.
    #[test]
    fn a_changed_or_cut_file_is_refused(at in 0.0..1.0, byte in any::<u8>(), cut in any::<bool>()) {
        let mut bytes = FILE.clone().into_bytes();
        let at = (at * (bytes.len() - 1) as f64) as usize;
        if cut {
            bytes.truncate(at);
        } else {
            bytes[at] = byte;
        }
        match Part::read("x", &bytes) {
            Err(error) => {
                let said = error.to_string();
                prop_assert!(said.starts_with("x ") && !said.contains('\n'), "{}", said);
            }
            Ok(part) => prop_assert_eq!(part, read(&FILE).expect("sound")),
        }
    }
}
