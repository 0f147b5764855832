//! Symbols are named where they stand, and lead to their place in the theory.

use crate::support::{DESK, Page, app, page_of, texts};
use centrode::app::link::Effect;
use centrode_core::symbols::{SYMBOLS, find};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};

/// The pages that were opened since this was last asked.
fn opened(page: &mut Page) -> Vec<String> {
    let app = page.state_mut().as_mut().expect("built");
    let effects = app.take_effects().into_iter();
    effects.filter_map(|effect| if let Effect::Open(page) = effect { Some(page) } else { None }).collect()
}

/// The labels of all links into the theory.
fn links(page: &Page) -> Vec<String> {
    texts(page, "Theory: ")
}

#[test]
fn symbols_of_controls_and_plots_are_links() {
    let page = page_of(DESK);
    let links = links(&page);
    for id in ["delta", "epsilon-tau", "n", "xi2", "xi1", "k", "deviation", "theta", "theta-l"] {
        let symbol = find(id).expect("a symbol");
        let name = symbol.name.replace('_', "");
        assert!(links.iter().any(|link| link.contains(&name)), "{id}: {links:#?}");
    }
}

#[test]
fn a_click_on_a_symbol_opens_its_place() {
    let mut page = page_of(DESK);
    let symbol = find("xi2").expect("a symbol");
    opened(&mut page);
    page.get_by_role_and_label(Role::Link, &format!("Theory: ξ2, {}", symbol.name)).click();
    page.run_steps(2);
    assert_eq!(opened(&mut page), ["theory.html#sym-xi2"]);
    assert!(opened(&mut page).is_empty());
}

#[test]
fn a_symbol_is_named_under_the_pointer_and_the_focus() {
    let symbol = find("epsilon-tau").expect("a symbol");
    let label = format!("Theory: ετ, {}", symbol.name);
    let named = |page: &Page| {
        let named = page.query_all_by_label_contains(symbol.name);
        named.filter(|node| node.accesskit_node().role() == Role::Label).count()
    };
    let mut page = page_of(DESK);
    assert_eq!(named(&page), 0);
    page.get_by_role_and_label(Role::Link, &label).hover();
    page.run_steps(12);
    assert!(named(&page) > 0, "not named under the pointer");
    let mut page = page_of(DESK);
    page.get_by_role_and_label(Role::Link, &label).focus();
    page.run_steps(3);
    assert!(named(&page) > 0, "not named under the focus");
    opened(&mut page);
    page.key_press(Key::Enter);
    page.run_steps(2);
    assert_eq!(opened(&mut page), ["theory.html#sym-epsilon-tau"]);
}

#[test]
fn the_help_opens_the_theory_and_the_licences() {
    let mut page = page_of(DESK);
    page.get_by_label("Help").click();
    page.run_steps(3);
    opened(&mut page);
    page.get_by_label("Open the theory").click();
    page.run_steps(2);
    assert_eq!(opened(&mut page), ["theory.html"]);
    page.get_by_label("Licences of what this page is made of").scroll_to_me();
    page.run_steps(6);
    page.get_by_label("Licences of what this page is made of").click();
    page.run_steps(2);
    assert_eq!(opened(&mut page), ["licences.html"]);
    assert!(!app(&page).is_working());
}

#[test]
fn every_symbol_can_be_written_in_the_page_s_font() {
    for symbol in SYMBOLS {
        let line: String = symbol.line().replace('_', "");
        let missing: Vec<char> = line.chars().filter(|c| *c != ' ' && !centrode_core::chart::font::has(*c)).collect();
        assert!(missing.is_empty(), "{}: {missing:?}", symbol.id);
    }
}
