//! The comparison with a helper in the same memory, and without.

use super::*;
use crate::app::helper::lent::Lent;
use crate::app::helper::near::Near;
use crate::app::stages::tuner::Tuner;
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Detectors, Threshold};
use centrode_core::study::compare::Piece;

fn bench() -> Scenario {
    let mut draft = find("bench").and_then(|preset| preset.draft()).expect("bench");
    ["loop_rate=100", "filter.length=50"].iter().for_each(|set| draft.set(set).expect(set));
    draft.finish().expect("valid")
}

fn tuning(repeats: usize) -> Tuning {
    let compare = Detectors::of(&[Method::Fcd, Method::FcdVelocity, Method::Cusum]);
    Tuning { repeats, compare, ..Tuning::default() }
}

fn finish(comparer: &mut Comparer) -> usize {
    (1..4000)
        .find(|_| {
            comparer.work();
            comparer.progress().is_none()
        })
        .expect("an end")
}

/// As text, in which what is not defined equals itself.
fn told(comparer: &Comparer) -> String {
    format!("{:?}", comparer.shown().map(|(_, comparison, _)| comparison))
}

#[test]
fn a_helper_gives_what_the_frames_and_the_command_give() {
    let (mut alone, mut helped) = (Comparer::new(None), Comparer::new(Some(Box::<Near>::default())));
    for comparer in [&mut alone, &mut helped] {
        comparer.update(Some(&bench()), &tuning(4), false);
        assert!(finish(comparer) > 4);
    }
    assert_eq!(told(&alone), told(&helped));
    let spec = alone.shown().map(|(compare, ..)| compare.spec().clone()).expect("a comparison");
    let mut command = Compare::new(spec).expect("possible");
    // Threads make pieces in any order.
    let pieces: Vec<Piece> = command.missing().collect();
    for piece in pieces.into_iter().rev() {
        let made = command.make(piece);
        assert!(command.add(made));
    }
    assert_eq!(format!("{:?}", Some(&command.comparison())), told(&alone));
}

#[test]
fn two_studies_share_a_helper_and_leave_each_others_answers() {
    let near = Near::default();
    let [first, second] = Lent::shares(Some(Box::new(near.clone())));
    let (mut tuner, mut comparer) = (Tuner::new(first), Comparer::new(second));
    tuner.update(Some(&bench()), 3, false);
    for _ in 0..3 {
        tuner.work(0.0);
    }
    // The person goes to the detectors; what the helper had made for the thresholds comes late.
    tuner.update(None, 3, false);
    comparer.update(Some(&bench()), &tuning(3), false);
    finish(&mut comparer);
    assert_eq!((comparer.trouble(), tuner.trouble()), (None, None));
    comparer.update(None, &tuning(3), false);
    tuner.update(Some(&bench()), 3, false);
    while tuner.progress().is_some() {
        tuner.work(0.0);
    }
    assert_eq!((comparer.trouble(), tuner.trouble()), (None, None));
}

#[test]
fn a_helper_that_fails_is_replaced_by_the_frames() {
    let near = Near::default();
    let mut comparer = Comparer::new(Some(Box::new(near.clone())));
    comparer.update(Some(&bench()), &tuning(2), false);
    comparer.work();
    near.0.borrow_mut().broken = true;
    finish(&mut comparer);
    assert_eq!((comparer.trouble(), comparer.left()), (Some("it is gone"), None));
}

#[test]
fn what_changes_no_run_costs_none() {
    let near = Near::default();
    let mut comparer = Comparer::new(Some(Box::new(near.clone())));
    let mut scenario = bench();
    comparer.update(Some(&scenario), &tuning(3), false);
    finish(&mut comparer);
    let asked = near.0.borrow().asked;
    // A threshold that no place depends on, and another rate.
    scenario.detection.xi2 = Threshold::On(0.0043);
    comparer.update(Some(&scenario), &Tuning { wish: 0.1, ..tuning(3) }, false);
    comparer.work();
    assert_eq!((comparer.left(), near.0.borrow().asked), (None, asked));
    let own = comparer.shown().and_then(|(_, comparison, _)| comparison.detectors[0].own.clone()).expect("on");
    assert_eq!(own.threshold, 0.0043);
    // While a slider is on its way nothing begins; let go, it does.
    scenario.filter.length = 40;
    comparer.update(Some(&scenario), &tuning(3), true);
    assert_eq!(comparer.left(), None);
    comparer.update(Some(&scenario), &tuning(3), false);
    assert!(comparer.left().is_some());
    comparer.update(Some(&scenario), &Tuning { compare: Detectors::NONE, ..tuning(3) }, false);
    assert!(comparer.refused().is_some_and(|refused| refused.to_string().contains("no detector")));
}
