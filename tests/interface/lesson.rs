//! The tour, headless: every step taken by hand and noticed, left, resumed and linked to.

use crate::support::{DESK, LOW, PHONE, Page, TABLET, app, click, finish, fits, page_of, slide, slider};
use centrode::app::lesson::At;
use centrode::app::lesson::tour::{STEPS, TOUR};
use centrode::app::link::Effect;
use centrode::app::{App, Host};
use centrode_core::scenario::Threshold;
use egui::accesskit::Role;
use egui::{Key, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// A page that is opened with this fragment.
fn linked(size: Vec2, fragment: &'static str) -> Page {
    let ui = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        let host = || Host { fragment: fragment.into(), ..Host::default() };
        app.get_or_insert_with(|| App::new(ui.ctx(), None, host())).ui(ui);
    };
    let builder = Harness::builder().with_size(size).with_step_dt(0.1).with_theme(egui::Theme::Dark);
    let mut page = builder.with_context_setup(centrode::app::theme::install).build_ui_state(ui, None);
    page.run_steps(3);
    page
}

fn step(page: &Page) -> Option<usize> {
    match app(page).state().lesson {
        Some(At::Tour(step)) => Some(step),
        _ => None,
    }
}

fn done(page: &Page, step: usize) -> bool {
    app(page).lesson().is_done(step)
}

/// Picks an item of the menu of lessons.
pub fn learn(page: &mut Page, item: &str) {
    click(page, "Learn");
    page.get_by_role_and_label(Role::MenuItem, item).click();
    page.run_steps(3);
}

fn fragment(page: &mut Page) -> String {
    let effects = page.state_mut().as_mut().expect("built").take_effects().into_iter();
    let mut told = effects.filter_map(|effect| match effect {
        Effect::Address { fragment, .. } => Some(fragment),
        _ => None,
    });
    told.next_back().unwrap_or_default()
}

/// Does what a step asks for, as a person would.
pub fn do_it(page: &mut Page, step: usize) {
    match step {
        0 => {
            // Towards the ring: the arrow at B turns down.
            let arrow = slider(page, "Direction of arrow B").rect().center();
            page.drag_at(arrow);
            page.run_steps(2);
            page.hover_at(arrow + vec2(-6.0, 30.0));
            page.run_steps(2);
            page.drop_at(arrow + vec2(-6.0, 30.0));
            page.run_steps(2);
            assert!(app(page).lesson().plate().angle(1) < 0.0, "dragging turns it");
            slider(page, "Direction of arrow B").focus();
            page.run_steps(2);
            for _ in 0..60 {
                if done(page, 0) {
                    break;
                }
                let low = app(page).lesson().plate().angle(1).to_degrees() < -20.0;
                page.key_press(if low { Key::ArrowRight } else { Key::ArrowLeft });
                page.run_steps(2);
            }
        }
        1 => {
            click(page, "Play");
            page.run_steps(30);
            click(page, "Pause");
        }
        2 => {
            for _ in 0..3 {
                page.key_press_modifiers(egui::Modifiers::SHIFT, Key::ArrowRight);
                page.run_steps(2);
            }
        }
        3 => {
            let time = app(page).run().detection().expect("one").time;
            slide(page, "Time", time);
        }
        4 => {
            for xi2 in [4.0, 2.5] {
                slide(page, "ξ2 (centrode)", xi2);
                assert!(!done(page, 4), "{xi2} mm is above what a free motion shows");
            }
            slide(page, "ξ2 (centrode)", 1.1);
        }
        5 => {
            slide(page, "Filter length N", 400.0);
            assert!(!done(page, 5));
            slide(page, "Filter length N", 200.0);
        }
        6 => {
            // Where the card is low it is scrolled.
            page.get_by_label("follows shape").click_accesskit();
            page.run_steps(2);
        }
        7 => slide(page, "Contact disk", 3.0),
        8 => {
            slide(page, "Frame z", 0.5);
            assert!(!done(page, 8));
            slide(page, "Frame z", 3.0);
        }
        9 => {
            slide(page, "Time", 6.2);
            finish(page);
        }
        10 => {
            slide(page, "Time", 5.2);
            assert!(!done(page, 10), "nothing has alarmed yet");
            slide(page, "Time", 6.0);
            finish(page);
        }
        11 => slide(page, "Time", 8.0),
        _ => {
            slide(page, "Time", 5.0);
            assert!(!done(page, 12));
            slide(page, "Time", 10.0);
        }
    }
    page.run_steps(2);
}

#[test]
fn every_step_begins_undone_and_is_noticed_when_it_is_done() {
    for size in [DESK, PHONE, LOW, TABLET] {
        let mut page = page_of(size);
        learn(&mut page, "Tour");
        for (k, of) in TOUR.iter().enumerate() {
            assert_eq!(step(&page), Some(k));
            page.get_by_label(&format!("Step {} of {STEPS}: {}", k + 1, of.title));
            page.run_steps(3);
            finish(&mut page);
            assert!(!done(&page, k), "{size}: {}", of.title);
            page.get_by_label(&format!("To do: {}", of.task));
            // Plots that do not fit above each other are scrolled.
            if size == DESK {
                fits(&page, size, of.title);
            }
            do_it(&mut page, k);
            assert!(done(&page, k), "{size}: {}", of.title);
            page.get_by_label(&format!("Done. {}", of.noticed));
            page.check_accessibility();
            click(&mut page, if k + 1 < STEPS { "Next" } else { "Finish" });
            page.run_steps(2);
        }
        assert_eq!((step(&page), app(&page).lesson().resume()), (None, 0));
    }
}

#[test]
fn a_step_can_be_passed_without_doing_it() {
    let mut page = page_of(DESK);
    learn(&mut page, "Tour");
    for k in 1..STEPS {
        click(&mut page, "Next");
        assert_eq!(step(&page), Some(k));
    }
    click(&mut page, "Back");
    assert_eq!(step(&page), Some(STEPS - 2));
    assert!((0..STEPS).all(|k| !done(&page, k)));
}

#[test]
fn leaving_gives_back_what_was_set() {
    let mut page = page_of(DESK);
    slide(&mut page, "Seed", 9.0);
    slide(&mut page, "ξ2 (centrode)", 4.0);
    slide(&mut page, "Time", 6.5);
    click(&mut page, "Map");
    let before = app(&page).state().clone();
    learn(&mut page, "Tour");
    assert_eq!(app(&page).state().preset, "free");
    for _ in 0..4 {
        click(&mut page, "Next");
    }
    slide(&mut page, "ξ2 (centrode)", 1.0);
    click(&mut page, "Theme: system");
    click(&mut page, "Leave tour");
    let theme = app(&page).state().theme;
    assert_eq!(app(&page).state(), &centrode::app::state::State { theme, ..before });
    assert_eq!(app(&page).run().plan.scenario(), &app(&page).state().scenario);
    learn(&mut page, "Resume step 5");
    assert_eq!((step(&page), done(&page, 4)), (Some(4), true));
    click(&mut page, "Keep this");
    assert_eq!((step(&page), app(&page).state().preset.as_str()), (None, "bench"));
    assert_eq!(app(&page).state().scenario.seed, 1, "kept as the step had it");
}

#[test]
fn a_step_is_linked_to_and_what_was_set_stands_in_the_same_link() {
    let mut page = linked(DESK, "tour=5");
    assert_eq!(step(&page), Some(4));
    assert_eq!(fragment(&mut page), "", "the address says it already");
    slide(&mut page, "ξ2 (centrode)", 3.0);
    assert_eq!(fragment(&mut page), "", "what is tried in a step is not told");
    click(&mut page, "Next");
    assert!(fragment(&mut page).ends_with("&tour=6"));
    click(&mut page, "Leave tour");
    assert_eq!(fragment(&mut page), "preset=bench");

    let mut page = linked(DESK, "preset=disk-3&seed=7&detection.xi2=off&t=6.27&tour=2");
    assert_eq!((step(&page), app(&page).state().preset.as_str()), (Some(1), "free"));
    page.state_mut().as_mut().expect("built").go("preset=disk-3&seed=7&detection.xi2=off&t=6.27&tour=9");
    page.run_steps(3);
    assert_eq!(step(&page), Some(8));
    click(&mut page, "Leave tour");
    let state = app(&page).state();
    assert_eq!((state.preset.as_str(), state.scenario.seed, state.time), ("disk-3", 7, 6.27));
    assert_eq!(state.scenario.detection.xi2, Threshold::OFF);
    page.state_mut().as_mut().expect("built").go("tour=3");
    page.run_steps(3);
    page.state_mut().as_mut().expect("built").go("preset=bench&seed=3");
    page.run_steps(3);
    assert_eq!((step(&page), app(&page).state().scenario.seed), (None, 3), "back out of the tour");
}

#[test]
fn a_link_to_a_step_that_does_not_exist_says_which_there_are() {
    for fragment in ["tour=0", "tour=14", "tour=two", "tour=-1"] {
        let page = linked(DESK, fragment);
        assert_eq!(step(&page), None);
        let notice = app(&page).notice().expect("a notice");
        assert!(
            notice.details.contains("tour") && notice.details.contains(&format!("a whole number from 1 to {STEPS}")),
            "{notice:?}"
        );
    }
}

#[test]
fn the_arrows_of_the_plate_obey_keys_and_assistive_technology() {
    let mut page = linked(DESK, "tour=1");
    let angle = |page: &Page, which| app(page).lesson().plate().angle(which).to_degrees();
    slider(&page, "Direction of arrow A").set_value_accesskit(60.0);
    page.run_steps(2);
    assert!((angle(&page, 0) - 60.0).abs() < 1e-9);
    slider(&page, "Direction of arrow A").focus();
    page.run_steps(2);
    page.key_press(Key::ArrowUp);
    page.run_steps(2);
    assert!((angle(&page, 0) - 62.0).abs() < 1e-9);
    page.get_by_role_and_label(Role::Button, "Point A").focus();
    page.run_steps(2);
    let before = app(&page).lesson().plate().point(0);
    page.key_press(Key::ArrowRight);
    page.run_steps(2);
    assert!(app(&page).lesson().plate().point(0).x > before.x);
    slider(&page, "Direction of arrow B").set_value_accesskit(62.0);
    page.run_steps(2);
    assert!(page.query_by_label_contains("Parallel arrows").is_some());
}

/// A page that shows a log.
fn with_log() -> Page {
    let mut page = page_of(DESK);
    let log = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/logs/clean.csv");
    let bytes = std::fs::read(log).expect("an example");
    page.state_mut().as_mut().expect("built").opened("clean.csv", Ok(bytes));
    page.run_steps(2);
    for _ in 0..1000 {
        if app(&page).run().is_recorded() {
            break;
        }
        page.step();
    }
    assert!(app(&page).run().is_recorded());
    page
}

#[test]
fn a_log_is_set_aside_and_comes_back() {
    let mut page = with_log();
    let shown = app(&page).run().fingerprint();
    learn(&mut page, "Tour");
    click(&mut page, "Next");
    assert!(!app(&page).run().is_recorded());
    click(&mut page, "Leave tour");
    assert!(app(&page).run().is_recorded());
    assert_eq!(app(&page).run().fingerprint(), shown);
}

#[test]
fn a_log_comes_back_to_what_a_lesson_has_set() {
    let mut page = with_log();
    learn(&mut page, "Tour");
    for _ in 1..5 {
        click(&mut page, "Next");
    }
    slide(&mut page, "ξ2 (centrode)", 3.0);
    assert!(!app(&page).run().is_recorded());
    click(&mut page, "Keep this");
    assert_eq!(step(&page), None);
    assert!(app(&page).run().is_recorded(), "the log is gone");
    assert_eq!(app(&page).run().judged.settings.thresholds.xi2, Threshold::On(0.003));
}

#[test]
fn another_view_can_be_looked_at_in_every_step() {
    for size in [DESK, PHONE, LOW, TABLET] {
        for fragment in ["tour=1", "tour=5", "tour=8"] {
            let mut page = linked(size, fragment);
            for view in ["Map", "Paper", "Tuning", "Robot"] {
                page.get_by_role_and_label(Role::Tab, view).click();
                page.run_steps(3);
                assert!(page.query_by_label_contains(&format!("of {STEPS}: ")).is_some(), "{size}: {view}");
                page.check_accessibility();
            }
        }
    }
}
