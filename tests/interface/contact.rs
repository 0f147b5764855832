//! The kind of contact: chosen, seen, and held against a clamp.

use crate::support::{DESK, LOW, PHONE, Page, TABLET, app, click, fits, page_of, slide, slider, texts};
use centrode_core::plant::Shape;
use centrode_core::scenario::ContactKind;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};

fn kind(page: &Page) -> ContactKind {
    app(page).state().scenario.contact.kind
}

fn is_there(page: &Page, role: Role, label: &str) -> bool {
    page.query_by_role_and_label(role, label).is_some()
}

#[test]
fn the_kind_can_be_chosen_and_changes_the_run() {
    let mut page = page_of(DESK);
    let clamped = app(&page).run().fingerprint();
    assert_eq!(kind(&page), ContactKind::Clamp);
    let mut seen = vec![clamped];
    for (label, chosen) in [("Plane", ContactKind::Plane), ("Cylinder", ContactKind::Cylinder)] {
        click(&mut page, label);
        assert_eq!(kind(&page), chosen);
        let run = app(&page).run();
        assert!(matches!(run.truth(run.place(7.0)).expect("simulated").shape, Shape::Touched(_)), "{label}");
        assert!(!seen.contains(&run.fingerprint()), "{label}");
        seen.push(run.fingerprint());
    }
    click(&mut page, "Reset Beam");
    assert_eq!((kind(&page), app(&page).run().fingerprint()), (ContactKind::Clamp, clamped));
}

#[test]
fn only_a_cylinder_has_a_rounding() {
    let mut page = page_of(DESK);
    for (label, has) in [("Clamp", false), ("Plane", false), ("Cylinder", true)] {
        click(&mut page, label);
        assert_eq!(is_there(&page, Role::Slider, "Rounding"), has, "{label}");
    }
    let thin = app(&page).run().fingerprint();
    slide(&mut page, "Rounding", 6.0);
    assert_eq!(app(&page).state().scenario.contact.rounding, 0.006);
    assert_ne!(app(&page).run().fingerprint(), thin);
    assert!(slider(&page, "Rounding").rect().top() > page.get_by_label("Cylinder").rect().top(), "below what it needs");
    click(&mut page, "Clamp");
    click(&mut page, "Cylinder");
    assert_eq!(slider(&page, "Rounding").accesskit_node().numeric_value(), Some(6.0), "it is remembered");
}

#[test]
fn a_place_that_a_plane_cannot_touch_is_refused_in_words() {
    let mut page = page_of(DESK);
    click(&mut page, "Plane");
    page.get_by_role_and_label(Role::TextInput, "Contact disk value").click();
    page.run_steps(2);
    page.event(egui::Event::Text("30 mm".into()));
    page.run_steps(2);
    page.key_press(egui::Key::Enter);
    page.run_steps(2);
    assert!(!texts(&page, "between the base and the end disk").is_empty());
}

#[test]
fn every_kind_fits_on_every_screen() {
    for size in [DESK, TABLET, PHONE, LOW] {
        for label in ["Clamp", "Plane", "Cylinder"] {
            let mut page = page_of(size);
            if page.query_by_label(label).is_none() {
                click(&mut page, "Controls");
            }
            click(&mut page, label);
            fits(&page, size, label);
        }
    }
}
