//! The challenges, headless: each begins unmet, and its worked answer meets it.

use crate::lesson::{do_it, learn};
use crate::support::{DESK, PHONE, Page, app, click, finish, page_of, slide};
use centrode::app::lesson::At;
use centrode::app::lesson::challenge::CHALLENGES;
use centrode::app::lesson::challenge::check::Verdict;
use centrode::app::link::Effect;
use centrode::app::{App, Host};
use centrode_core::scenario::link;
use egui::Vec2;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// A page with what was kept of an earlier visit.
fn kept(size: Vec2, progress: Option<&'static str>) -> Page {
    let ui = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        let host = || Host { prefers_reduced_motion: true, progress: progress.map(Into::into), ..Host::default() };
        app.get_or_insert_with(|| App::new(ui.ctx(), None, host())).ui(ui);
    };
    let builder = Harness::builder().with_size(size).with_step_dt(0.1).with_theme(egui::Theme::Dark);
    let mut page = builder.with_context_setup(centrode::app::theme::install).build_ui_state(ui, None);
    page.run_steps(2);
    page
}

fn verdict(page: &mut Page) -> Verdict {
    finish(page);
    app(page).lesson().verdict().expect("a challenge is open")
}

fn press(page: &mut Page, label: &str) {
    // It may have to be scrolled to.
    page.get_by_role_and_label(Role::Button, label).click_accesskit();
    page.run_steps(3);
}

/// What was to be kept since this was last asked.
fn told(page: &mut Page) -> Vec<String> {
    let effects = page.state_mut().as_mut().expect("built").take_effects().into_iter();
    let kept = effects.filter_map(|effect| match effect {
        Effect::Keep(text) => Some(text),
        _ => None,
    });
    kept.collect()
}

#[test]
fn every_challenge_begins_unmet_and_its_worked_answer_meets_it() {
    for size in [DESK, PHONE] {
        let mut page = page_of(size);
        let before = app(&page).state().clone();
        learn(&mut page, "Challenges");
        for of in &CHALLENGES {
            press(&mut page, of.title);
            let Verdict::Measured(met, said) = verdict(&mut page) else { panic!("{}: nothing measured", of.key) };
            assert!(!met && !app(&page).lesson().is_met(of.key), "{}: {said}", of.key);
            assert!(page.query_by_label_contains(of.hint).is_none());
            press(&mut page, "Hint");
            assert!(page.query_by_label_contains(of.hint).is_some());
            press(&mut page, "Worked answer");
            press(&mut page, "Show me");
            assert_eq!(app(&page).notes().len(), 0, "{:?}", app(&page).notes());
            let Verdict::Measured(met, said) = verdict(&mut page) else { panic!("{}: nothing measured", of.key) };
            assert!(met && app(&page).lesson().is_met(of.key), "{}: {said}", of.key);
            assert!(page.query_by_label_contains("Met. ").is_some());
            page.check_accessibility();
            press(&mut page, "All");
        }
        assert!(page.query_by_label_contains("Progress is not kept here").is_some());
        press(&mut page, "Leave challenges");
        assert_eq!(app(&page).state(), &before);
    }
}

#[test]
fn what_is_to_stay_is_named_and_the_seed_is_free() {
    let mut page = page_of(DESK);
    learn(&mut page, "Challenges");
    press(&mut page, "Find disk 1");
    let before = verdict(&mut page);
    click(&mut page, "Sensors");
    slide(&mut page, "Seed", 7.0);
    assert_eq!(verdict(&mut page), before, "all the same seeds are tried");
    slide(&mut page, "Position noise", 0.0);
    assert_eq!(verdict(&mut page), Verdict::Forbidden("tracker.position_noise"));
    assert!(page.query_by_label_contains("Position noise is to stay as it was").is_some());
    click(&mut page, "Reset Position noise");
    assert_eq!(verdict(&mut page), before);
}

#[test]
fn progress_is_handed_out_and_comes_back() {
    let mut page = kept(DESK, Some(""));
    assert_eq!(told(&mut page), Vec::<String>::new());
    learn(&mut page, "Tour");
    click(&mut page, "Next");
    click(&mut page, "Next");
    assert_eq!(told(&mut page).last().expect("kept"), r#"{"tour":3,"met":[]}"#);
    click(&mut page, "Leave tour");
    learn(&mut page, "Challenges");
    assert!(page.query_by_label_contains("Progress is not kept here").is_none());
    press(&mut page, "A clamp that looks like a touch");
    press(&mut page, "Worked answer");
    press(&mut page, "Show me");
    finish(&mut page);
    assert_eq!(told(&mut page), [r#"{"tour":3,"met":["clamp"]}"#]);

    let mut page = kept(PHONE, Some(r#"{"tour":3,"met":["clamp"]}"#));
    assert!(app(&page).lesson().is_met("clamp"));
    learn(&mut page, "Resume step 3");
    assert_eq!(told(&mut page), Vec::<String>::new(), "nothing new");
    // The browser has become full.
    page.state_mut().as_mut().expect("built").progress_not_kept();
    click(&mut page, "Next");
    assert_eq!(told(&mut page), Vec::<String>::new());
    for garbled in ["{", "\u{1f600}", "[]", r#"{"tour":1e9}"#] {
        let page = kept(DESK, Some(garbled));
        assert!(app(&page).lesson().is_kept() && app(&page).notice().is_none(), "{garbled}");
    }
}

#[test]
fn a_challenge_is_linked_to_as_a_step_of_the_tour_is() {
    let address = |page: &mut Page| {
        let effects = page.state_mut().as_mut().expect("built").take_effects().into_iter();
        let mut told = effects.filter_map(|effect| match effect {
            Effect::Address { fragment, .. } => Some(fragment),
            _ => None,
        });
        told.next_back()
    };
    let at = |page: &Page| app(page).state().lesson;
    assert_eq!(CHALLENGES.each_ref().map(|of| of.key), *link::page::CHALLENGES);
    let mut page = page_of(DESK);
    address(&mut page);
    learn(&mut page, "Challenges");
    for (which, of) in CHALLENGES.iter().enumerate() {
        press(&mut page, of.title);
        let told = address(&mut page).expect("told");
        assert!(told.ends_with(&format!("&challenge={}", of.key)), "{told}");
        press(&mut page, "All");
        assert!(!address(&mut page).expect("told").contains("challenge"));
        page.state_mut().as_mut().expect("built").go(&told);
        page.run_steps(3);
        assert_eq!((at(&page), address(&mut page)), (Some(At::Challenge(which)), None), "{told}");
        press(&mut page, "All");
    }
    page.state_mut().as_mut().expect("built").go("preset=disk-3&seed=7&challenge=clamp");
    page.run_steps(3);
    press(&mut page, "All");
    press(&mut page, "Leave challenges");
    assert_eq!((at(&page), app(&page).state().scenario.seed), (None, 7), "what the link holds besides");
    page.state_mut().as_mut().expect("built").go("challenge=bogus");
    page.run_steps(3);
    assert_eq!(at(&page), None);
    let notice = app(&page).notice().expect("a notice");
    assert!(notice.details.contains("challenge") && notice.details.contains("disk-1"), "{notice:?}");
}

#[test]
fn steps_that_are_done_stay_done() {
    let mut page = kept(DESK, Some(r#"{"tour":2,"met":[],"done":[2]}"#));
    assert!(app(&page).lesson().is_done(1) && !app(&page).lesson().is_done(0));
    learn(&mut page, "Tour from the start");
    assert_eq!(told(&mut page), [r#"{"tour":1,"met":[],"done":[2]}"#]);
    do_it(&mut page, 0);
    assert_eq!(told(&mut page).last().expect("kept"), r#"{"tour":1,"met":[],"done":[1,2]}"#);
    // Where nothing can be kept it stays done as long as the page is open.
    page.state_mut().as_mut().expect("built").progress_not_kept();
    click(&mut page, "Next");
    assert_eq!(told(&mut page), Vec::<String>::new());
    assert!(app(&page).lesson().is_done(0) && !app(&page).lesson().is_kept());
}
