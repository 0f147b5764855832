//! The tuning view, headless: what it says, what a drag does, and how it looks.

use crate::support::{DESK, LOW, PHONE, Page, TABLET, app, finish, fits, slide, texts};
use centrode::app::stages::stage::Stage;
use centrode_core::scenario::Threshold;
use centrode_core::study::tuning::watch::Rule;
use egui::accesskit::Role;
use egui::{Event, TouchDeviceId, TouchId, TouchPhase, Vec2, vec2};
use egui_kittest::kittest::Queryable;

/// A page that has just begun to tune.
fn page_of(size: Vec2) -> Page {
    let mut page = crate::support::page_of(size);
    tune(&mut page);
    page
}

/// Goes to the tuning view.
pub fn tune(page: &mut Page) {
    page.get_by_role_and_label(Role::Tab, "Tuning").click();
    page.run_steps(2);
    assert_eq!(app(page).state().stage, Stage::Tuning);
}

fn said(page: &Page, part: &str) -> String {
    texts(page, part).join(" | ")
}

fn xi2(page: &Page) -> Option<f64> {
    app(page).state().scenario.detection.xi2.value()
}

fn xi1(page: &Page) -> Option<f64> {
    app(page).state().scenario.detection.xi1.value()
}

#[test]
fn it_says_what_the_thresholds_achieve_and_which_to_take() {
    let mut page = page_of(DESK);
    assert_eq!(app(&page).state().stage, Stage::Tuning);
    finish(&mut page);
    let now = said(&page, "runs without contact gave");
    assert!(now.contains("of 100 runs without contact") && now.contains("Contact on disk 2 is detected"), "{now}");
    assert!(!said(&page, "Soonest with at most 5").is_empty());
    assert!(said(&page, "centrode study").contains("--preset bench --repeats 100 --sweep filter.length=50,100"));
    page.get_by_role_and_label(Role::Button, "Take it").click();
    page.run_steps(2);
    finish(&mut page);
    let scenario = &app(&page).state().scenario;
    assert_ne!((scenario.filter.length, scenario.detection.xi2), (500, Threshold::On(0.007)));
    assert!(said(&page, "centrode study").contains("study my.toml"));
    // What was advised is set now, and the live run uses it.
    let threshold = scenario.detection.xi2.value().expect("on") * 1e3;
    let now = said(&page, "Now, ");
    assert!(
        now.contains(&format!("= {threshold:.1}\u{a0}mm, N = {}", scenario.filter.length)),
        "{now} for {threshold}"
    );
    assert_eq!(app(&page).run().plan.scenario(), scenario);
}

#[test]
fn a_drag_on_each_picture_moves_the_threshold() {
    let mut page = page_of(DESK);
    finish(&mut page);
    let figures = [
        "Contacts found against false alarms",
        "Delay against false alarms",
        "Delay by place of contact",
        "Median delay by filter length and threshold",
    ];
    for (k, figure) in figures.into_iter().enumerate() {
        let rect = page.get_by_role_and_label(Role::Figure, figure).rect();
        let before = xi2(&page);
        let (from, to) = (rect.lerp_inside(vec2(0.7, 0.3)), rect.lerp_inside(vec2(0.25 + 0.1 * k as f32, 0.8)));
        page.drag_at(from);
        page.run_steps(1);
        page.hover_at(to);
        page.run_steps(1);
        page.drop_at(to);
        page.run_steps(2);
        assert_ne!(xi2(&page), before, "{figure}");
        finish(&mut page);
    }
}

#[test]
fn a_finger_drags_the_dot_and_scrolls_from_anywhere_else() {
    let mut page = page_of(PHONE);
    finish(&mut page);
    let finger = |page: &mut Page, at: egui::Pos2, phase: TouchPhase| {
        page.event(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(0), phase, pos: at, force: None });
        page.event(Event::PointerMoved(at));
        if phase != TouchPhase::Move {
            let (button, pressed) = (egui::PointerButton::Primary, phase == TouchPhase::Start);
            page.event(Event::PointerButton { pos: at, button, pressed, modifiers: egui::Modifiers::NONE });
        }
        page.step();
    };
    let chart = |page: &Page| page.get_by_role_and_label(Role::Figure, "Delay against false alarms").rect();
    // To where it can be seen; the first finger is not known for one before it comes down.
    for _ in 0..2 {
        let words = egui::pos2(120.0, 440.0);
        finger(&mut page, words, TouchPhase::Start);
        (1..=10).for_each(|k| finger(&mut page, words - vec2(0.0, 20.0 * k as f32), TouchPhase::Move));
        (0..4).for_each(|_| finger(&mut page, words - vec2(0.0, 200.0), TouchPhase::Move));
        finger(&mut page, words - vec2(0.0, 200.0), TouchPhase::End);
        page.run_steps(3);
    }
    let (before, place) = (xi2(&page), chart(&page));
    let start = place.lerp_inside(vec2(0.8, 0.9));
    finger(&mut page, start, TouchPhase::Start);
    (1..=8).for_each(|k| finger(&mut page, start - vec2(0.0, 10.0 * k as f32), TouchPhase::Move));
    finger(&mut page, start - vec2(0.0, 80.0), TouchPhase::End);
    page.run_steps(3);
    assert_eq!(xi2(&page), before);
    assert!(chart(&page).top() < place.top() - 30.0, "it did not scroll: {:?} from {place:?}", chart(&page));
    // The dot of 7 mm: about 16 % of the runs alarm, and the delay is about 0.47 s.
    let place = chart(&page);
    let dot = place.lerp_inside(vec2(0.04 / 1.08 + 0.262 / 1.08, 1.0 - 0.469 / 1.04));
    finger(&mut page, dot, TouchPhase::Start);
    (1..=8).for_each(|k| finger(&mut page, dot + vec2(12.0 * k as f32, 0.0), TouchPhase::Move));
    finger(&mut page, dot + vec2(96.0, 0.0), TouchPhase::End);
    page.run_steps(3);
    assert!(xi2(&page) < before, "{:?} from {before:?}", xi2(&page));
}

#[test]
fn methods_wishes_and_runs_can_be_chosen_and_the_study_stopped() {
    let mut page = page_of(DESK);
    page.run_steps(3);
    page.get_by_role_and_label(Role::Button, "Stop").click();
    page.run_steps(3);
    let held = app(&page).report();
    page.run_steps(5);
    assert_eq!(app(&page).report(), held);
    page.get_by_role_and_label(Role::Button, "Go on").click();
    finish(&mut page);
    let length = app(&page).state().scenario.filter.length;
    page.get_by_role_and_label(Role::RadioButton, "Forces").click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::Button, "Take it").click();
    page.run_steps(2);
    let scenario = app(&page).state().scenario.clone();
    assert_eq!(scenario.filter.length, length, "joint forces are not filtered");
    assert_ne!(scenario.detection.xi1, Threshold::On(0.03));
    for (option, part) in [
        ("Forces", "mN·m"),
        ("Both", "runs without contact gave"),
        ("Either", "runs without contact gave"),
        ("1 %", "at least 381 runs"),
    ] {
        page.get_by_role_and_label(Role::RadioButton, option).click();
        page.run_steps(2);
        assert!(!said(&page, part).is_empty(), "{option}: {part}");
    }
    assert_eq!(app(&page).state().tuning.rule, Rule::Or);
}

#[test]
fn it_fits_in_every_size() {
    let mut page = page_of(DESK);
    page.run_steps(6);
    for done in [false, true] {
        for size in [PHONE, LOW, TABLET, DESK] {
            page.set_size(size);
            page.run_steps(3);
            assert_ne!(app(&page).is_working(), done);
            fits(&page, size, "the study");
            let pictures = page.query_all_by_role(Role::Figure).count();
            assert!(pictures >= 2, "{size}: {pictures} pictures");
            assert_eq!(said(&page, "So far: ").is_empty(), done, "{size}");
            assert!(!done || !said(&page, "Soonest with at most 5").is_empty(), "{size}");
        }
        finish(&mut page);
    }
}

#[test]
fn without_a_contact_there_is_nothing_to_advise() {
    let mut page = page_of(DESK);
    slide(&mut page, "Contact disk", 0.0);
    finish(&mut page);
    assert!(!said(&page, "There is no contact to detect").is_empty());
    assert!(!said(&page, "Set a contact to get a recommendation").is_empty());
    assert!(page.query_by_role_and_label(Role::Button, "Take it").is_none());
}

#[test]
fn a_drag_of_xi1_begins_no_study_and_what_does_not_look_at_it_is_kept() {
    let mut page = page_of(DESK);
    finish(&mut page);
    page.get_by_role_and_label(Role::RadioButton, "Either").click();
    page.run_steps(2);
    assert!(said(&page, "Now, ").contains("ξ1 = 30.0"), "{}", said(&page, "Now, "));
    let begun = |page: &Page| app(page).tuner().begun();
    let (before, first) = (begun(&page), xi1(&page));
    let rail = crate::support::slider(&page, "ξ1 (joint force)").rect();
    page.drag_at(rail.lerp_inside(vec2(0.3, 0.5)));
    for k in 0..40 {
        page.hover_at(rail.lerp_inside(vec2(0.3 + 0.01 * k as f32, 0.5)));
        page.run_steps(1);
        assert_eq!((begun(&page), app(&page).is_working()), (before, false), "position {k}");
    }
    let dragged = xi1(&page).expect("on");
    assert_ne!(Some(dragged), first);
    let now = said(&page, "Now, ");
    assert!(now.contains(&format!("ξ1 = {:.1}", dragged * 1e3)) && now.contains("counted with ξ1 = 30.0"), "{now}");
    page.drop_at(rail.lerp_inside(vec2(0.69, 0.5)));
    page.run_steps(1);
    assert_eq!(begun(&page), before + 1, "let go, what looks at it is counted anew");
    // What looks at it stands as it was until enough of the new is known.
    let now = said(&page, "Now, ");
    assert!(now.contains("of 100 runs") && now.contains("counted with"), "{now}");
    for option in ["Centrode", "Forces"] {
        page.get_by_role_and_label(Role::RadioButton, option).click();
        page.run_steps(2);
        let now = said(&page, "Now, ");
        assert!(now.contains("of 100 runs") && !now.contains("counted with"), "{option}: {now}");
    }
    assert!(app(&page).is_working(), "the others are still being counted");
    page.get_by_role_and_label(Role::RadioButton, "Either").click();
    page.run_steps(2);
    finish(&mut page);
    let now = said(&page, "Now, ");
    assert!(!now.contains("counted with") && now.contains("of 100 runs"), "{now}");
    assert_eq!(begun(&page), before + 1);
}
