//! The study with a helper in the same memory, and without.

use super::*;
use crate::app::helper::near::Near;
use centrode_core::scenario::preset::find;

fn bench() -> Scenario {
    find("bench").and_then(|preset| preset.scenario()).expect("bench")
}

fn finish(tuner: &mut Tuner) -> usize {
    (1..2000)
        .find(|_| {
            tuner.work(0.0);
            tuner.progress().is_none()
        })
        .expect("an end")
}

#[test]
fn a_helper_gives_what_the_frames_give() {
    let (mut alone, mut helped) = (Tuner::new(None), Tuner::new(Some(Box::<Near>::default())));
    for tuner in [&mut alone, &mut helped] {
        tuner.update(Some(&bench()), 4, false);
        assert!(finish(tuner) > 3);
    }
    assert_eq!(alone.shown(Rule::Fcd).map(|(study, ..)| study), helped.shown(Rule::Fcd).map(|(study, ..)| study));
    assert_eq!(alone.own(Rule::Fcd), helped.own(Rule::Fcd));
}

#[test]
fn a_helper_that_fails_is_replaced_by_the_frames() {
    let near = Near::default();
    let mut tuner = Tuner::new(Some(Box::new(near.clone())));
    tuner.update(Some(&bench()), 3, false);
    tuner.work(0.0);
    near.0.borrow_mut().broken = true;
    finish(&mut tuner);
    assert!(!tuner.has_helper());
    assert_eq!(tuner.trouble(), Some("it is gone"));
}

#[test]
fn an_answer_that_cannot_be_read_ends_the_helper_and_not_the_study() {
    let near = Near::default();
    let mut tuner = Tuner::new(Some(Box::new(near.clone())));
    tuner.update(Some(&bench()), 3, false);
    tuner.work(0.0);
    near.0.borrow_mut().babbles = true;
    assert!(tuner.work(0.0), "the next frame goes on with it");
    assert!(tuner.trouble().is_some_and(|why| why.contains("cannot be read")), "{:?}", tuner.trouble());
    assert!(near.0.borrow().remote.is_none(), "the helper was told to stop");
    finish(&mut tuner);
    assert_eq!((tuner.has_helper(), tuner.left()), (false, None));
}

#[test]
fn a_helper_that_fails_has_one_other_take_its_place() {
    let near = Near::default();
    let mut tuner = Tuner::new(Some(Box::new(near.clone())));
    tuner.update(Some(&bench()), 3, false);
    near.0.borrow_mut().others = 1;
    tuner.work(0.0);
    let asked = near.0.borrow().asked;
    near.0.borrow_mut().babbles = true;
    assert!(tuner.work(0.0), "the next frame asks the other");
    tuner.work(0.0);
    assert_eq!((tuner.has_helper(), tuner.trouble(), near.0.borrow().asked), (true, None, asked + 1));
    near.0.borrow_mut().babbles = true;
    tuner.work(0.0);
    assert!(!tuner.has_helper() && tuner.trouble().is_some());
    finish(&mut tuner);
    let mut alone = Tuner::new(None);
    alone.update(Some(&bench()), 3, false);
    finish(&mut alone);
    // As text: without a false alarm their mean time is NaN.
    assert_eq!(format!("{:?}", alone.own(Rule::Fcd)), format!("{:?}", tuner.own(Rule::Fcd)));
}

#[test]
fn a_dragged_threshold_keeps_every_run() {
    let near = Near::default();
    let mut tuner = Tuner::new(Some(Box::new(near.clone())));
    let mut scenario = bench();
    tuner.update(Some(&scenario), 3, false);
    finish(&mut tuner);
    let asked = near.0.borrow().asked;
    for k in 0..50 {
        let xi2 = 0.004_03 + 0.000_113 * f64::from(k);
        scenario.detection.xi2 = Threshold::On(xi2);
        tuner.update(Some(&scenario), 3, false);
        assert_eq!((tuner.left(), near.0.borrow().asked), (None, asked), "{xi2} m");
        assert_eq!(tuner.setting(Rule::Fcd), Some(xi2));
        let counted = tuner.own(Rule::Fcd).expect("a point").threshold;
        assert!((counted - xi2).abs() <= 0.000_05 + 1e-9, "{counted} m for {xi2} m");
    }
}

#[test]
fn a_threshold_costs_no_run_and_a_filter_length_few() {
    let near = Near::default();
    let mut tuner = Tuner::new(Some(Box::new(near.clone())));
    let mut scenario = bench();
    tuner.update(Some(&scenario), 3, false);
    finish(&mut tuner);
    let asked = near.0.borrow().asked;
    scenario.detection.xi2 = Threshold::On(0.0043);
    tuner.update(Some(&scenario), 3, false);
    assert_eq!((tuner.left(), near.0.borrow().asked), (None, asked));
    assert_eq!(tuner.own(Rule::Fcd).map(|point| point.threshold), Some(0.0043));
    scenario.filter.length = 300;
    tuner.update(Some(&scenario), 3, false);
    // The other disks at that length.
    assert_eq!(tuner.left().map(|left| left.of - left.done), Some(2 * 3));
    scenario.detection.xi2 = Threshold::On(0.0);
    tuner.update(Some(&scenario), 3, false);
    finish(&mut tuner);
    assert_eq!(tuner.own(Rule::Fcd).map(|point| point.false_alarms.rate.rate), Some(1.0));
    scenario.detection.xi2 = Threshold::OFF;
    tuner.update(Some(&scenario), 3, false);
    finish(&mut tuner);
    assert!(tuner.own(Rule::Fcd).is_none() && tuner.own(Rule::Jfd).is_some());
    // Nobody looks: nothing is made; and again it goes on.
    tuner.update(None, 3, false);
    assert_eq!((tuner.work(0.0), tuner.progress()), (false, None));
    tuner.update(Some(&scenario), 3, false);
    finish(&mut tuner);
    // More repeats go on from those there are.
    tuner.hold(true);
    scenario.tracker.position_noise *= 2.0;
    tuner.update(Some(&scenario), 3, false);
    assert!(!tuner.is_held(), "what is new is made");
    finish(&mut tuner);
}

#[test]
fn what_is_shown_stays_until_the_next_can_be_shown() {
    let mut tuner = Tuner::new(None);
    let mut scenario = bench();
    scenario.motion.end = 8.0;
    tuner.update(Some(&scenario), 25, false);
    finish(&mut tuner);
    let point = tuner.own(Rule::Fcd);
    scenario.tracker.position_noise *= 3.0;
    tuner.update(Some(&scenario), 25, false);
    tuner.work(0.0);
    scenario.tracker.position_noise *= 1.5;
    tuner.update(Some(&scenario), 25, false);
    tuner.work(0.0);
    assert_eq!(tuner.own(Rule::Fcd), point);
    finish(&mut tuner);
    assert_ne!(tuner.own(Rule::Fcd), point);
}

#[test]
fn xi1_on_its_way_begins_nothing_and_let_go_leaves_what_does_not_look_at_it() {
    let near = Near::default();
    let mut tuner = Tuner::new(Some(Box::new(near.clone())));
    let mut scenario = bench();
    tuner.update(Some(&scenario), 25, false);
    finish(&mut tuner);
    // As text, in which what is not defined equals itself.
    let own = |tuner: &Tuner, rule| format!("{:?}", tuner.own(rule));
    let known = Rule::ALL.iter().map(|&rule| own(&tuner, rule)).collect::<Vec<_>>();
    let asked = near.0.borrow().asked;
    for k in 1..30 {
        scenario.detection.xi1 = Threshold::On(0.03 + 0.000_37 * f64::from(k));
        tuner.update(Some(&scenario), 25, true);
        tuner.work(0.0);
        assert_eq!((tuner.begun(), tuner.left(), near.0.borrow().asked), (1, None, asked));
        assert_eq!(tuner.setting(Rule::Jfd), scenario.detection.xi1.value());
        let (counted, set) = (tuner.own(Rule::Jfd).expect("on").threshold, tuner.setting(Rule::Jfd).expect("on"));
        assert!((counted - set).abs() <= 0.000_5 + 1e-9, "{counted} N·m for {set} N·m");
        assert_eq!(tuner.counted_with(Rule::Or).map(|counted| counted.xi1), Some(bench().detection.xi1));
    }
    tuner.update(Some(&scenario), 25, false);
    tuner.work(0.0);
    assert_eq!((tuner.begun(), near.0.borrow().asked), (2, asked + 1));
    // The centrode's counts are there at once; either and both are those of before while the new ones are few.
    assert_eq!(own(&tuner, Rule::Fcd), known[0]);
    assert_eq!([own(&tuner, Rule::Or), own(&tuner, Rule::And)], known[2..]);
    finish(&mut tuner);
    assert_eq!(own(&tuner, Rule::Fcd), known[0]);
    assert_eq!(tuner.counted_with(Rule::Or).map(|counted| counted.xi1), Some(scenario.detection.xi1));
    // Anything else on its way begins anew at once, as before.
    scenario.tracker.position_noise *= 2.0;
    tuner.update(Some(&scenario), 25, true);
    assert_eq!(tuner.begun(), 3);
}
