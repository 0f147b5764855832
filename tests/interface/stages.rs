//! The paper on the page, headless: every figure, Table II and the map, chosen, drawn, and used.

use crate::support::{DESK, LOW, PHONE, Page, TABLET, app, finish, fits, page_of, slide, texts};
use centrode::app::stages::stage::Stage;
use centrode_core::scenario::{Place, Start};
use egui::accesskit::Role;
use egui::pos2;
use egui_kittest::kittest::Queryable;

/// Opens the menu of stages and picks one; then waits until its work is done.
pub fn show(page: &mut Page, name: &str) {
    page.get_by_role_and_label(Role::ComboBox, "Show").click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::ListBoxOption, name).click();
    page.run_steps(2);
    finish(page);
}

#[test]
fn each_figure_brings_its_preset_and_is_drawn_with_its_caption() {
    let mut page = page_of(DESK);
    for stage in Stage::ALL {
        let Some(number) = stage.figure() else { continue };
        show(&mut page, stage.name());
        assert_eq!(app(&page).state().preset, number.preset());
        let figures = texts(&page, number.title());
        assert!(figures.iter().any(|label| label.to_lowercase().contains("simulated")), "{stage:?}: {figures:?}");
        assert!(!texts(&page, &format!("centrode figure {}", number.digit())).is_empty(), "{stage:?}");
    }
    page.get_by_role_and_label(Role::RadioButton, "Robot").click();
    page.run_steps(2);
    assert_eq!(app(&page).state().stage, Stage::Robot);
}

#[test]
fn everything_fits_in_every_size() {
    let mut page = page_of(DESK);
    for stage in Stage::ALL.into_iter().filter(|stage| *stage != Stage::Tuning) {
        show(&mut page, stage.name());
        assert_eq!(app(&page).state().stage, stage);
        for size in [PHONE, LOW, TABLET, DESK] {
            page.set_size(size);
            page.run_steps(3);
            fits(&page, size, stage.name());
        }
    }
}

#[test]
fn a_preset_of_its_own_takes_a_figure_off_the_stage_and_leaves_the_map() {
    let mut page = page_of(DESK);
    let choose = |page: &mut Page, name: &str| {
        page.get_by_role_and_label(Role::ComboBox, "Preset").click();
        page.run_steps(2);
        page.get_by_role_and_label(Role::ListBoxOption, name).click();
        page.run_steps(2);
    };
    show(&mut page, "Figure 8");
    choose(&mut page, "Paper");
    assert_eq!(app(&page).state().stage, Stage::Robot);
    show(&mut page, "Map");
    choose(&mut page, "Bench");
    assert_eq!(app(&page).state().stage, Stage::Map);
}

#[test]
fn table_ii_stands_beside_the_simulated_one() {
    let mut page = page_of(DESK);
    show(&mut page, "Table II");
    let paper = texts(&page, "The paper's experiment, disk 2");
    assert!(
        paper.iter().any(|row| row.contains("5 / 5") && row.contains("6.281") && row.contains("16.0")),
        "{paper:?}"
    );
    let ours = texts(&page, "Simulated by Centrode, disk 2");
    assert!(ours.iter().any(|row| row.contains("20 / 20")), "{ours:?}");
}

#[test]
fn a_click_on_the_map_puts_the_contact_there() {
    let mut page = page_of(DESK);
    show(&mut page, "Map");
    let map = page.get_by_label_contains("Map of the largest ξ2").rect();
    let at = pos2(map.left() + 0.5 * map.width(), map.top() + 0.25 * map.height());
    page.drag_at(at);
    page.run_steps(1);
    page.drop_at(at);
    page.run_steps(3);
    let contact = app(&page).state().scenario.contact;
    let (Place::ArcLength(place), Start::Bend(bend)) = (contact.place, contact.start) else { panic!("{contact:?}") };
    assert!((place - 0.0225).abs() < 2e-4 && (bend - std::f64::consts::FRAC_PI_4).abs() < 0.01, "{place} {bend}");
    assert!(!app(&page).is_working(), "the map does not depend on the contact");
    assert!(!texts(&page, "Contact at 22.").is_empty() || !texts(&page, "Contact at 22,").is_empty());
    assert!(app(&page).run().detection().is_some(), "the live run follows");
}

#[test]
fn a_control_makes_the_work_again() {
    let mut page = page_of(DESK);
    show(&mut page, "Figure 8");
    let before = texts(&page, "Fixed centrode deviation").concat();
    page.get_by_role_and_label(Role::Slider, "Filter length N").set_value_accesskit(250.0);
    page.run_steps(2);
    finish(&mut page);
    let after = texts(&page, "Fixed centrode deviation").concat();
    assert!(before.contains("N = 500") && after.contains("N = 250"), "{before}\n{after}");
}

/// Panics unless `what` is on the stage, and no refusal.
fn shown(page: &Page, what: &str) {
    let refusals = texts(page, "cannot be shown");
    assert!(refusals.is_empty() && !texts(page, what).is_empty(), "{what}: {refusals:?}");
}

#[test]
fn odd_scenarios_are_shown() {
    let mut page = page_of(DESK);
    page.get_by_role_and_label(Role::Button, "Motion").click();
    page.run_steps(2);
    for (label, value) in [("Contact disk", 0.0), ("θL at the end", 90.0), ("Filter length N", 1.0), ("Run ends", 1.0)]
    {
        show(&mut page, "Map");
        slide(&mut page, label, value);
        finish(&mut page);
        shown(&page, "Map of the largest");
        show(&mut page, "Table II");
        shown(&page, "Simulated by Centrode, disk 1");
    }
    for stage in Stage::ALL {
        let Some(number) = stage.figure() else { continue };
        show(&mut page, stage.name());
        slide(&mut page, "Contact disk", 0.0);
        slide(&mut page, "θL at the end", 90.0);
        finish(&mut page);
        shown(&page, &format!("centrode figure {}", number.digit()));
        assert_eq!(app(&page).run().plan.scenario(), &app(&page).state().scenario, "{stage:?}");
    }
}
