//! The page, headless: every control found by its name, moved or typed into, and the run looked at.

use crate::support::{Page, app, build, click, page_of, slide, slider};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

fn page() -> Page {
    page_of(vec2(1440.0, 900.0))
}

/// Clicks into a field, types over what is there, and presses Enter.
fn type_into(page: &mut Page, label: &str, text: &str) {
    let name = format!("{label} value");
    page.get_by_role_and_label(Role::TextInput, &name).click();
    page.run_steps(2);
    if text.is_empty() {
        page.key_press(Key::Delete);
    } else {
        page.event(Event::Text(text.into()));
    }
    page.run_steps(2);
    page.key_press(Key::Enter);
    page.run_steps(2);
}

fn field(page: &Page, label: &str) -> String {
    page.get_by_role_and_label(Role::TextInput, &format!("{label} value")).value().unwrap_or_default()
}

fn detection_time(page: &Page) -> Option<f64> {
    app(page).run().detection().map(|detection| detection.time)
}

fn report(page: &Page) -> serde_json::Value {
    serde_json::from_str(&app(page).report()).expect("JSON")
}

#[test]
fn it_opens_playing_on_a_contact_that_is_detected() {
    let mut page = build(Harness::builder().with_size(vec2(1440.0, 900.0)), None);
    assert!(!app(&page).state().playing, "nothing moves by itself for who wants less motion");
    click(&mut page, "Play");
    let before = app(&page).state().time;
    page.run_steps(5);
    assert!(app(&page).state().playing && app(&page).state().time > before + 0.4);
    assert!(page.query_by_label("State: Free").is_some());
    page.run_steps(40);
    assert!(page.query_by_label("State: Detected").is_some(), "{}", report(&page));
    let report = report(&page);
    assert_eq!(report["state"], "detected");
    assert!(
        report["summary"].as_str().is_some_and(|said| said.starts_with("Contact on disk 2 at 5.801 s was noticed at "))
    );
    page.run_steps(60);
    assert!(app(&page).state().playing, "it loops");
}

#[test]
fn every_named_slider_is_there_and_moves_the_scenario() {
    let mut page = page();
    for (label, value) in [
        ("Contact disk", 3.0),
        ("Load cell error ε_τ", 20.0),
        ("Filter length N", 200.0),
        ("Contact time", 5.5),
        ("ξ1 (joint force)", 50.0),
        ("ξ2 (centrode)", 8.0),
        ("Armed from", 4.0),
        ("Position noise", 0.02),
        ("Orientation noise", 0.02),
        ("Bending direction δ", 45.0),
        ("Seed", 7.0),
    ] {
        let before = (app(&page).state().scenario.clone(), app(&page).run().fingerprint());
        slide(&mut page, label, value);
        assert_ne!(app(&page).state().scenario, before.0, "{label}");
        // A bound and a threshold change no channel, or only their own.
        assert!(app(&page).run().plan.scenario() == &app(&page).state().scenario, "{label}");
        assert_eq!(slider(&page, label).accesskit_node().numeric_value(), Some(value), "{label}");
    }
    let mut by_hand = centrode_core::scenario::preset::PRESETS[0].scenario().expect("preset");
    by_hand.contact.place = centrode_core::scenario::Place::disk(3);
    click(&mut page, "Reset all");
    slide(&mut page, "Contact disk", 3.0);
    let expected = centrode_core::run::simulate(&by_hand).expect("run");
    assert_eq!(app(&page).run().fingerprint(), expected.fingerprint());
    assert_eq!(report(&page)["detection_time"].as_f64(), expected.detection().map(|detection| detection.time));
}

#[test]
fn no_contact_clears_the_detection() {
    let mut page = page();
    assert!(detection_time(&page).is_some());
    type_into(&mut page, "Contact disk", "none");
    assert_eq!(app(&page).run().contact_time(), None);
    assert!(field(&page, "Contact disk") == "none");
    slide(&mut page, "Contact disk", 2.0);
    assert!((detection_time(&page).expect("detected") - 6.279).abs() < 0.1);
}

#[test]
fn a_slider_can_be_dragged() {
    let mut page = page();
    let rect = slider(&page, "Contact disk").rect();
    page.drag_at(rect.left_center() + vec2(8.0, 0.0));
    page.run_steps(2);
    // The run is new in the very frame in which the pointer came.
    assert_eq!(app(&page).run().contact_time(), None);
    page.hover_at(rect.right_center() - vec2(8.0, 0.0));
    page.run_steps(2);
    page.drop_at(rect.right_center() - vec2(8.0, 0.0));
    page.run_steps(2);
    assert_eq!(field(&page, "Contact disk"), "3");
}

#[test]
fn an_arc_length_can_be_typed_for_the_contact() {
    let mut page = page();
    type_into(&mut page, "Contact disk", "18 mm");
    assert_eq!(app(&page).run().plan.contact().map(|contact| contact.arc_length), Some(0.018));
    assert_eq!(field(&page, "Contact disk"), "18.0");
}

#[test]
fn a_bend_typed_for_the_contact_is_named_so() {
    let mut page = page();
    type_into(&mut page, "Contact time", "45°");
    assert_eq!(field(&page, "Contact bend"), "45.0");
    assert!(page.query_by_role_and_label(Role::Slider, "Contact time").is_none());
    slide(&mut page, "Contact bend", 5.6);
    assert_eq!(field(&page, "Contact time"), "5.60");
}

#[test]
fn a_short_filter_is_restless() {
    let mut page = page();
    type_into(&mut page, "Filter length N", "1");
    assert_eq!(app(&page).state().scenario.filter.length, 1);
    assert!(
        detection_time(&page).unwrap_or_else(|| panic!("no alarm: {:?}", app(&page).run().crossings())) < 5.1,
        "noise alone raises it"
    );
    assert!(report(&page)["summary"].as_str().is_some_and(|said| said.starts_with("False alarm")));
    slide(&mut page, "Time", 9.0);
    assert_eq!(report(&page)["state"], "false alarm");
    assert!(page.query_by_label("State: False alarm").is_some());
}

#[test]
fn nonsense_keeps_the_value_and_says_so() {
    let mut page = page_of(vec2(1440.0, 1900.0));
    let before = app(&page).state().scenario.clone();
    for (label, text, said) in [
        ("Contact time", "soon", "is not a number"),
        ("Contact time", "-1", "Contact time −1.00 s: a finite number, 0 s or more"),
        ("Filter length N", "0", "Filter length N 0: a whole number from 1"),
        ("Filter length N", "2.5", "whole number"),
        ("Filter length N", "99999999", "Filter length N 99999999: "),
        ("Contact disk", "4", "Contact disk 4: a disk from 1 to 3"),
        ("Position noise", "1 kg", "mm is expected"),
        ("Seed", "-3", "whole number"),
        ("Armed from", "nan", "is not a"),
        ("Load cell error ε_τ", "100", "Load cell error ε_τ 100.0 %: from 0 % to below 100 %"),
        ("Seed", "", "is not a number"),
    ] {
        type_into(&mut page, label, text);
        assert_eq!(app(&page).state().scenario, before, "{label}: {text}");
        assert!(page.query_all_by_label_contains(said).count() > 0, "{label}: {text}: {:?}", app(&page).notes());
    }
    type_into(&mut page, "Contact time", "5.6 s");
    assert!(!app(&page).notes().contains_key("contact.time"));
    click(&mut page, "Reset all");
    assert!(app(&page).notes().is_empty());
}

#[test]
fn what_is_out_of_the_sliders_range_can_be_typed() {
    let mut page = page();
    type_into(&mut page, "Filter length N", "5000");
    assert_eq!(app(&page).state().scenario.filter.length, 5000);
    type_into(&mut page, "Position noise", "2,5 mm");
    assert_eq!(app(&page).state().scenario.tracker.position_noise, 0.0025);
}

#[test]
fn escape_takes_back_what_is_typed() {
    let mut page = page();
    page.get_by_role_and_label(Role::TextInput, "Seed value").click();
    page.run_steps(2);
    page.event(Event::Text("55".into()));
    page.run_steps(2);
    page.key_press(Key::Escape);
    page.run_steps(2);
    assert_eq!((app(&page).state().scenario.seed, field(&page, "Seed")), (1, "1".into()));
}

#[test]
fn each_control_and_all_of_them_can_be_reset() {
    let mut page = page();
    let preset = app(&page).state().scenario.clone();
    assert!(page.query_by_label("Reset Seed").is_none());
    slide(&mut page, "Seed", 9.0);
    slide(&mut page, "Contact time", 5.0);
    click(&mut page, "Reset Seed");
    assert_eq!(app(&page).state().scenario.seed, 1);
    assert_ne!(app(&page).state().scenario, preset);
    click(&mut page, "Reset all");
    assert_eq!(app(&page).state().scenario, preset);
}

#[test]
fn a_threshold_off_raises_no_alarm_and_comes_back() {
    let mut page = page();
    slide(&mut page, "ξ2 (centrode)", 6.0);
    click(&mut page, "ξ2 (centrode) on");
    assert_eq!(detection_time(&page), None);
    assert_eq!(field(&page, "ξ2 (centrode)"), "off");
    click(&mut page, "ξ2 (centrode) on");
    assert_eq!(app(&page).state().scenario.detection.xi2.value(), Some(0.006));
    click(&mut page, "ξ1 (joint force) on");
    assert!(page.query_by_label_contains("ξ1 is off").is_some());
    slide(&mut page, "ξ1 (joint force)", 40.0);
    assert_eq!(app(&page).state().scenario.detection.xi1.value(), Some(0.04), "a touch switches it on");
}

#[test]
fn keys_play_step_and_jump() {
    let mut page = page();
    let time = |page: &Page| app(page).state().time;
    page.key_press(Key::Space);
    page.step();
    assert!(app(&page).state().playing);
    page.key_press(Key::Space);
    page.run_steps(2);
    assert!(!app(&page).state().playing);
    page.key_press(Key::Home);
    page.step();
    assert_eq!(time(&page), 0.0);
    page.key_press(Key::ArrowRight);
    page.step();
    assert_eq!(time(&page), 0.01);
    page.key_press_modifiers(Modifiers::SHIFT, Key::ArrowRight);
    page.step();
    assert_eq!(time(&page), 0.11);
    page.key_press(Key::ArrowLeft);
    page.step();
    assert_eq!(time(&page), 0.1);
    page.key_press(Key::End);
    page.step();
    assert_eq!(time(&page), 10.0);
    page.key_press(Key::Space);
    page.run_steps(2);
    assert!(app(&page).state().playing && time(&page) < 4.0, "at the end, play starts again");
}

#[test]
fn keys_belong_to_the_field_that_is_typed_in() {
    let mut page = page();
    page.get_by_role_and_label(Role::TextInput, "Seed value").click();
    page.run_steps(2);
    let before = app(&page).state().clone();
    for key in [Key::Space, Key::ArrowLeft, Key::Home] {
        page.key_press(key);
        page.run_steps(2);
    }
    assert_eq!((app(&page).state().playing, app(&page).state().time), (before.playing, before.time));
}

#[test]
fn the_transport_does_what_it_says() {
    let mut page = page();
    slide(&mut page, "Time", 6.0);
    assert_eq!(report(&page)["state"], "in contact");
    click(&mut page, "Step forward");
    assert_eq!(app(&page).state().time, 6.01);
    click(&mut page, "Step back");
    assert_eq!(app(&page).state().time, 6.0);
    click(&mut page, "To start");
    assert_eq!((app(&page).state().time, report(&page)["state"].as_str()), (0.0, Some("free")));
    slide(&mut page, "Speed", 4.0);
    assert_eq!(app(&page).state().speed, 4.0);
    click(&mut page, "Loop");
    slide(&mut page, "Time", 9.9);
    click(&mut page, "Play");
    page.run_steps(3);
    assert_eq!(
        (app(&page).state().playing, app(&page).state().time),
        (false, 10.0),
        "without loop it stops at the end"
    );
}

#[test]
fn presets_theme_groups_and_help() {
    let mut page = page_of(vec2(1440.0, 1900.0));
    click(&mut page, "Preset");
    click(&mut page, "Disk 3");
    assert_eq!(app(&page).state().preset, "disk-3");
    assert!((detection_time(&page).expect("detected") - 5.61).abs() < 0.1);
    assert!(page.query_by_role_and_label(Role::Slider, "Length L").is_none());
    page.get_by_role_and_label(Role::Button, "Robot").click();
    page.run_steps(2);
    assert!(page.query_by_role_and_label(Role::Slider, "Length L").is_some());
    type_into(&mut page, "Length L", "20 mm");
    assert!(page.query_by_label_contains("robot.disks[2]").is_some(), "{:?}", app(&page).notes());
    page.get_by_role_and_label(Role::Button, "Robot").click();
    page.run_steps(2);
    click(&mut page, "Tracker");
    click(&mut page, "aligned");
    assert_eq!(app(&page).state().scenario.tracker.mounting, centrode_core::scenario::Mounting::Aligned);
    click(&mut page, "Theme: system");
    assert!(page.query_by_label("Theme: dark").is_some());
    click(&mut page, "Help");
    page.run_steps(2);
    assert!(page.query_by_label_contains("What the fixed centrode is").is_some(), "{:?}", app(&page).state().help);
    page.key_press(Key::Escape);
    page.run_steps(3);
    assert!(!app(&page).state().help);
}

#[test]
fn every_input_has_a_name_and_nothing_leaves_the_page() {
    for size in [vec2(390.0, 844.0), vec2(844.0, 390.0), vec2(768.0, 1024.0), vec2(1440.0, 900.0), vec2(1920.0, 1080.0)]
    {
        let page = page_of(size);
        page.check_accessibility();
        let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, size).expand(0.5);
        for node in page.root().children_recursive() {
            let role = node.accesskit_node().role();
            if matches!(role, Role::Button | Role::Slider | Role::TextInput | Role::CheckBox | Role::RadioButton) {
                let rect = node.rect();
                // Controls further down are scrolled to.
                assert!(rect.left() >= screen.left() && rect.right() <= screen.right(), "{size}: {node:?}");
            }
        }
    }
}
