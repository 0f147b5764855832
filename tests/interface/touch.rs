//! The page in a hand: the sheet, targets for fingers, and whom a finger belongs to.

use crate::detectors::{LINK, go};
use crate::lesson::learn;
use crate::logs::{bytes, drop_log};
use crate::stages::show;
use crate::support::{LOW, PHONE, Page, app, build, click, finish, page_of, paused, slide, slider};
use centrode::app::layout::sheet::Stop;
use centrode::app::lesson::challenge::CHALLENGES;
use centrode::app::stages::stage::Stage;
use centrode::app::state::Tab;
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2, TouchDeviceId, TouchId, TouchPhase, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::wgpu::{create_render_state, default_wgpu_setup};
use egui_wgpu::RendererOptions;
use std::collections::BTreeSet;

const SMALL: Vec2 = vec2(360.0, 640.0);
/// What a finger hits, points; what rounding takes is not missed.
const TARGET: f32 = 43.9;
const SHEET: &str = "Height of the sheet";

/// A finger that comes down, moves or is lifted.
fn finger(page: &mut Page, at: Pos2, phase: TouchPhase) {
    page.event(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(0), phase, pos: at, force: None });
    page.event(Event::PointerMoved(at));
    if phase != TouchPhase::Move {
        page.event(Event::PointerButton {
            pos: at,
            button: egui::PointerButton::Primary,
            pressed: phase == TouchPhase::Start,
            modifiers: Modifiers::NONE,
        });
    }
    page.step();
}

/// A finger that goes from one place to another, slowly enough not to fling.
fn swipe(page: &mut Page, from: Pos2, to: Pos2) {
    finger(page, from, TouchPhase::Start);
    for i in 1..=12 {
        finger(page, from.lerp(to, i as f32 / 12.0), TouchPhase::Move);
    }
    // It rests before it is lifted.
    for _ in 0..4 {
        finger(page, to, TouchPhase::Move);
    }
    finger(page, to, TouchPhase::End);
    page.run_steps(3);
}

fn stop(page: &Page) -> Stop {
    app(page).state().stop
}

/// The upper edge of the sheet is somewhere at the handle.
fn top(page: &Page) -> f32 {
    slider(page, SHEET).rect().center().y
}

/// What is smaller than a finger hits, with its size.
fn too_small(page: &Page) -> Vec<String> {
    let mut small = Vec::new();
    for node in page.root().children_recursive() {
        let told = node.accesskit_node();
        let target = matches!(
            told.role(),
            Role::Button
                | Role::CheckBox
                | Role::ComboBox
                | Role::ListBoxOption
                | Role::MenuItem
                | Role::RadioButton
                | Role::Slider
                | Role::SpinButton
                | Role::Switch
                | Role::Tab
                | Role::TextInput
        );
        if !target {
            continue;
        }
        let rect = node.rect();
        if rect.width().min(rect.height()) < TARGET {
            let name = told.label().unwrap_or_default();
            small.push(format!("{:?} {name}: {:.0} × {:.0}", told.role(), rect.width(), rect.height()));
        }
    }
    small
}

#[track_caller]
fn hits(page: &Page, what: &str, all: &mut Vec<String>) {
    all.extend(too_small(page).into_iter().map(|small| format!("{what}: {small}")));
}

/// Left out are links (roles `Link`): a symbol in a line of text is as high as the line, and the same is in the help.
#[test]
fn a_finger_hits_everything_in_every_view() {
    let mut small = Vec::new();
    for size in [SMALL, PHONE, LOW] {
        let mut page = page_of(size);
        let at = |what: &str| format!("{}×{} {what}", size.x, size.y);
        for tab in ["Plots", "Bending plane", "Result"] {
            click(&mut page, tab);
            hits(&page, &at(tab), &mut small);
        }
        for stage in Stage::ALL {
            page.state_mut().as_mut().expect("built").go(&format!("preset=bench&view={}", stage.key()));
            page.run_steps(4);
            assert_eq!(app(&page).state().stage, stage);
            // What is found brings buttons of its own.
            if size == SMALL && stage.key() != "detectors" {
                finish(&mut page);
            }
            hits(&page, &at(stage.name()), &mut small);
        }
        if size == SMALL {
            go(&mut page, &LINK.replace("repeats=74", "repeats=20"));
            finish(&mut page);
            hits(&page, &at("compared"), &mut small);
        }
        show(&mut page, "Robot");
        click(&mut page, "Controls");
        for group in centrode::app::controls::table::GROUPS {
            if app(&page).state().folded.contains(group.name) {
                page.get_by_role_and_label(Role::Button, group.name).click();
                page.run_steps(2);
            }
        }
        hits(&page, &at("controls"), &mut small);
        click(&mut page, "Controls");
        for button in ["Preset", "Share", "Learn", "Help"] {
            click(&mut page, button);
            page.run_steps(2);
            hits(&page, &at(button), &mut small);
            page.key_press(Key::Escape);
            page.run_steps(3);
        }
        page.key_press(Key::Questionmark);
        page.run_steps(3);
        hits(&page, &at("keys"), &mut small);
        page.key_press(Key::Escape);
        page.run_steps(3);
        for step in 1..=10 {
            page.state_mut().as_mut().expect("built").go(&format!("tour={step}"));
            page.run_steps(3);
            hits(&page, &at(&format!("step {step}")), &mut small);
        }
        page.state_mut().as_mut().expect("built").go("preset=bench&contact.disk=9");
        page.run_steps(3);
        hits(&page, &at("notice"), &mut small);
    }
    assert!(small.is_empty(), "{}: {small:#?}", small.len());
}

/// Every challenge, with its hint and its answer.
#[test]
fn a_finger_hits_everything_of_the_challenges() {
    let mut small = Vec::new();
    for size in [SMALL, PHONE, LOW] {
        let mut page = page_of(size);
        let at = |what: &str| format!("{}×{} {what}", size.x, size.y);
        learn(&mut page, "Challenges");
        hits(&page, &at("challenges"), &mut small);
        for of in &CHALLENGES {
            for (k, button) in [of.title, "Hint", "Worked answer"].into_iter().enumerate() {
                // It may have to be scrolled to.
                page.get_by_role_and_label(Role::Button, button).click_accesskit();
                page.run_steps(3);
                hits(&page, &at(&format!("{}, {k} unfolded", of.key)), &mut small);
            }
            assert!(page.query_by_role_and_label(Role::Button, "Show me").is_some());
            click(&mut page, "All");
        }
    }
    assert!(small.is_empty(), "{}: {small:#?}", small.len());
}

/// The menus by which cards are saved: of the 3D view, and of all that has one on any stage or tab.
#[test]
fn a_finger_hits_everything_in_the_menus_that_save() {
    let mut small = Vec::new();
    for size in [SMALL, PHONE, LOW] {
        let gpu = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
        let mut page = paused(build(Harness::builder().with_size(size), Some(gpu)));
        let mut seen = BTreeSet::new();
        let mut menus = |page: &mut Page| {
            let saves = |label: String| label.starts_with("Save ").then_some(label);
            let buttons = page.query_all_by_role(Role::Button);
            let found: Vec<_> = buttons.filter_map(|node| saves(node.accesskit_node().label()?)).collect();
            for name in found.into_iter().filter(|name| seen.insert(name.clone())) {
                page.get_by_role_and_label(Role::Button, &name).click_accesskit();
                page.run_steps(3);
                assert!(page.query_all_by_role(Role::MenuItem).count() > 0, "{name} opens no menu");
                hits(page, &format!("{}×{} {name}", size.x, size.y), &mut small);
                page.key_press(Key::Escape);
                page.run_steps(3);
            }
        };
        for tab in ["Plots", "Bending plane", "Result"] {
            click(&mut page, tab);
            menus(&mut page);
        }
        for stage in Stage::ALL {
            page.state_mut().as_mut().expect("built").go(&format!("preset=bench&view={}", stage.key()));
            page.run_steps(4);
            menus(&mut page);
        }
        for name in ["Save 3D view", "Save plots", "Save figure 4", "Save map", "Save Table II"] {
            assert!(seen.contains(name), "{name} is not among {seen:?}");
        }
    }
    assert!(small.is_empty(), "{}: {small:#?}", small.len());
}

/// The banner of a log, the report, and the form of each kind of file.
#[test]
fn a_finger_hits_everything_of_a_log() {
    let mut small = Vec::new();
    for size in [SMALL, PHONE, LOW] {
        let mut page = page_of(size);
        page.state_mut().as_mut().expect("built").go("preset=bench");
        page.run_steps(2);
        for name in ["clean.csv", "ros.mcap", "ndi.csv"] {
            drop_log(&mut page, name, bytes(name));
            let at = |what: &str| format!("{}×{} {name}, {what}", size.x, size.y);
            if app(&page).log_form().is_none() {
                hits(&page, &at("banner"), &mut small);
                click(&mut page, "Report");
                page.run_steps(3);
                hits(&page, &at("report"), &mut small);
                click(&mut page, "Go on");
                click(&mut page, "Columns");
                page.run_steps(4);
            }
            hits(&page, &at("form"), &mut small);
            page.get_by_role_and_label(Role::ComboBox, "Format").click_accesskit();
            page.run_steps(6);
            assert!(page.query_by_label("guess").is_some(), "{}", at("no formats"));
            hits(&page, &at("formats"), &mut small);
            page.key_press(Key::Escape);
            page.run_steps(3);
            if app(&page).log_form().is_some() {
                click(&mut page, "Cancel");
                page.run_steps(3);
            }
        }
    }
    assert!(small.is_empty(), "{}: {small:#?}", small.len());
}

#[test]
fn the_sheet_has_three_stops_and_keeps_what_it_holds() {
    for size in [SMALL, PHONE, LOW] {
        let mut page = page_of(size);
        assert!(page.query_by_role_and_label(Role::Slider, "Contact disk").is_none());
        assert_eq!(stop(&page), Stop::Half);
        click(&mut page, "Controls");
        slide(&mut page, "Contact disk", 3.0);
        let value = page.get_by_role_and_label(Role::TextInput, "Contact disk value").value();
        assert_eq!(value.as_deref(), Some("3"));
        // By a screen reader, by keys and by taps.
        slide(&mut page, SHEET, 2.0);
        assert_eq!(stop(&page), Stop::Full);
        assert!(page.query_by_label("3D view").is_none(), "at {size}");
        slider(&page, SHEET).focus();
        page.run_steps(2);
        page.key_press(Key::ArrowDown);
        page.run_steps(2);
        assert_eq!(stop(&page), Stop::Half);
        page.key_press(Key::Home);
        page.run_steps(2);
        assert_eq!(stop(&page), Stop::Peek);
        for wanted in [Stop::Half, Stop::Full, Stop::Peek] {
            slider(&page, SHEET).click();
            page.run_steps(2);
            assert_eq!(stop(&page), wanted, "at {size}");
        }
        // What is asked for is shown, even where little of the sheet was.
        click(&mut page, "Controls");
        assert_eq!((stop(&page), app(&page).state().sheet), (Stop::Half, true));
        click(&mut page, "Controls");
        for tab in ["Plots", "Bending plane", "Result"] {
            click(&mut page, tab);
        }
        assert!(page.query_by_label_contains("was noticed").is_some());
        assert!(page.query_by_label("Pause").or(page.query_by_label("Play")).is_some());
    }
}

#[test]
fn a_finger_draws_the_sheet_out() {
    let mut page = page_of(PHONE);
    for (way, wanted) in [(150.0, Stop::Peek), (-170.0, Stop::Half), (-300.0, Stop::Full), (-60.0, Stop::Full)] {
        let at = slider(&page, SHEET).rect().center() + vec2(0.0, 10.0);
        swipe(&mut page, at, at + vec2(0.0, way));
        assert_eq!(stop(&page), wanted, "by {way}");
    }
    // By its head, over a tab, which is not chosen by that.
    let tab = page.get_by_label("Plots").rect().center();
    swipe(&mut page, tab, tab + vec2(0.0, 280.0));
    assert_eq!((stop(&page), app(&page).state().tab), (Stop::Half, Tab::Result));
    let mut page = page_of(LOW);
    for (way, wanted) in [(-300.0, Stop::Full), (420.0, Stop::Half), (120.0, Stop::Peek)] {
        let at = slider(&page, SHEET).rect().center();
        swipe(&mut page, at, at + vec2(way, 0.0));
        assert_eq!(stop(&page), wanted, "by {way}");
    }
}

#[test]
fn past_its_end_what_scrolls_hands_over_to_the_sheet() {
    let mut page = page_of(PHONE);
    click(&mut page, "Controls");
    // A finger on empty space between the rows.
    let at = slider(&page, "Contact disk").rect().left_top() + vec2(4.0, -30.0);
    let before = slider(&page, "Contact disk").rect().top();
    swipe(&mut page, at, at - vec2(0.0, 100.0));
    let scrolled = before - slider(&page, "Contact disk").rect().top();
    assert!(scrolled > 60.0 && stop(&page) == Stop::Half, "it scrolls by {scrolled}");
    let edge = top(&page);
    finger(&mut page, at, TouchPhase::Start);
    for i in 1..=20 {
        finger(&mut page, at + vec2(0.0, 16.0 * i as f32), TouchPhase::Move);
    }
    let drawn = top(&page) - edge;
    // All that is left when it has scrolled back, less what a finger takes to be a drag.
    assert!((drawn - (320.0 - scrolled)).abs() < 30.0, "by {drawn} after {scrolled}");
    for _ in 0..4 {
        finger(&mut page, at + vec2(0.0, 320.0), TouchPhase::Move);
    }
    finger(&mut page, at + vec2(0.0, 320.0), TouchPhase::End);
    page.run_steps(3);
    assert_eq!(stop(&page), Stop::Peek);
}

#[test]
fn a_finger_that_scrolls_the_controls_changes_none() {
    let mut page = page_of(vec2(390.0, 844.0));
    click(&mut page, "Controls");
    page.run_steps(3);
    let before = app(&page).state().scenario.clone();
    let start = slider(&page, "Contact time").rect().center() + vec2(60.0, 0.0);
    let finger = |page: &mut Page, at: egui::Pos2, phase: TouchPhase| {
        page.event(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(0), phase, pos: at, force: None });
        if phase == TouchPhase::Move {
            page.event(Event::PointerMoved(at));
        } else {
            let pressed = phase == TouchPhase::Start;
            page.event(Event::PointerMoved(at));
            page.event(Event::PointerButton {
                pos: at,
                button: egui::PointerButton::Primary,
                pressed,
                modifiers: Modifiers::NONE,
            });
        }
        page.step();
    };
    finger(&mut page, start, TouchPhase::Start);
    for i in 1..=6 {
        finger(&mut page, start - vec2(0.0, 10.0 * i as f32), TouchPhase::Move);
    }
    finger(&mut page, start - vec2(0.0, 60.0), TouchPhase::End);
    page.run_steps(2);
    assert_eq!(app(&page).state().scenario, before);
    let start = slider(&page, "Contact time").rect().center();
    finger(&mut page, start, TouchPhase::Start);
    for i in 1..=6 {
        finger(&mut page, start + vec2(10.0 * i as f32, 0.0), TouchPhase::Move);
    }
    finger(&mut page, start + vec2(60.0, 0.0), TouchPhase::End);
    assert_ne!(app(&page).state().scenario, before);
}

/// Where every widget is.
fn places(page: &Page) -> Vec<String> {
    let nodes = page.root().children_recursive();
    nodes.map(|node| format!("{:?} {:?}", node.accesskit_node().label(), node.accesskit_node().raw_bounds())).collect()
}

#[test]
fn who_wants_less_motion_sees_nothing_move_by_itself() {
    let mut page = page_of(PHONE);
    let time = app(&page).state().time;
    let wait = |page: &mut Page, what: &str| {
        // A window knows its size after a few frames.
        page.run_steps(4);
        let before = places(page);
        page.run_steps(12);
        assert!(before == places(page), "{what} moves");
    };
    slide(&mut page, SHEET, 2.0);
    wait(&mut page, "the sheet");
    // The group is folded, and unfolded again.
    for button in ["Controls", "Contact", "Contact", "ξ2 (centrode) on", "Help"] {
        page.get_by_label(button).click();
        wait(&mut page, button);
    }
    page.key_press(Key::Escape);
    page.run_steps(3);
    slide(&mut page, SHEET, 1.0);
    let at = slider(&page, "Contact time").rect().left_top() + vec2(4.0, -20.0);
    // A finger that flings.
    finger(&mut page, at, TouchPhase::Start);
    for i in 1..=4 {
        finger(&mut page, at - vec2(0.0, 30.0 * i as f32), TouchPhase::Move);
    }
    finger(&mut page, at - vec2(0.0, 120.0), TouchPhase::End);
    wait(&mut page, "what a finger let go");
    page.state_mut().as_mut().expect("built").go("preset=disk-3");
    wait(&mut page, "a link");
    assert!(!app(&page).state().playing && app(&page).state().time != time + 1.0);
    page.state_mut().as_mut().expect("built").go("tour=2");
    wait(&mut page, "the tour");
}
