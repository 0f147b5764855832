//! Symbols are named where they stand, and lead to their place in the theory.

use crate::support::{DESK, Page, app, page_of, texts};
use centrode::app::link::Effect;
use centrode_core::symbols::{SYMBOLS, find};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::Node;
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

/// Where the links of a symbol are on the page, and what the pointer finds there.
fn link<'a>(page: &'a Page, id: &str) -> Node<'a> {
    let symbol = find(id).expect("a symbol");
    let name = symbol.name.replace('_', "");
    page.get_by(move |node| {
        let label = node.label().unwrap_or_default();
        node.role() == Role::Link && label.starts_with("Theory: ") && label.ends_with(&format!(", {name}"))
    })
}

/// What is named in a tooltip now.
fn named(page: &Page) -> Vec<String> {
    let is_name = |text: &String| SYMBOLS.iter().any(|symbol| *text == symbol.line().replace('_', ""));
    let labels = page.query_all_by_role(Role::Label);
    labels.filter_map(|node| node.accesskit_node().value().or(node.accesskit_node().label())).filter(is_name).collect()
}

/// Points at a place until something is named.
fn point(page: &mut Page, at: Pos2) -> Vec<String> {
    page.event(Event::PointerMoved(at));
    page.run_steps(12);
    named(page)
}

#[test]
fn each_symbol_is_one_stop_for_the_keyboard_wherever_it_stands() {
    for (stage, wanted) in [
        ("Robot", &["c-m", "c-s", "c-c", "deviation", "theta", "theta-l", "xi1", "xi2", "k", "n", "epsilon-tau"][..]),
        ("Map", &["s-c", "epsilon-c", "theta", "epsilon-tau"]),
        ("Tuning", &["xi2", "n"]),
    ] {
        let mut page = page_of(DESK);
        page.get_by_role_and_label(Role::Tab, stage).click();
        page.run_steps(4);
        let links = links(&page);
        for (k, link) in links.iter().enumerate() {
            assert!(!links[..k].contains(link), "{stage}: {link} twice");
        }
        for id in wanted {
            let name = find(id).expect("a symbol").name.replace('_', "");
            assert!(links.iter().any(|link| link.ends_with(&name)), "{stage} {id}: {links:#?}");
        }
    }
}

#[test]
fn a_label_with_several_symbols_has_each_by_itself() {
    let mut page = page_of(DESK);
    let places = ["k", "epsilon-c", "theta-l"].map(|id| (id, link(&page, id).rect()));
    let [(_, k), (_, bound), _] = places;
    assert!(k.center().y == bound.center().y && k.right() < bound.left(), "one line: {k} {bound}");
    for (id, rect) in places {
        assert_eq!(point(&mut page, rect.center()), [find(id).expect("a symbol").line().replace('_', "")]);
    }
    opened(&mut page);
    link(&page, "epsilon-c").click();
    page.run_steps(2);
    assert_eq!(opened(&mut page), ["theory.html#sym-epsilon-c"]);
}

#[test]
fn the_symbols_of_legends_axes_and_thresholds_are_found_by_the_pointer() {
    let mut page = page_of(DESK);
    // On a threshold's handle the symbol is beside the switch.
    for (switch, id) in [("ξ2 on plot, on or off", "xi2"), ("ξ1 on plot, on or off", "xi1")] {
        let at = page.get_by_label(switch).rect().right_center() + egui::vec2(4.0, 0.0);
        assert_eq!(point(&mut page, at), [find(id).expect("a symbol").line().replace('_', "")], "{id}");
        opened(&mut page);
        press(&mut page, at);
        assert_eq!(opened(&mut page), [format!("theory.html#sym-{id}")]);
    }
    let legend = link(&page, "c-m").rect();
    assert_eq!(point(&mut page, legend.center()).len(), 1);
}

/// Presses and lets go at a place.
fn press(page: &mut Page, pos: Pos2) {
    page.event(Event::PointerMoved(pos));
    for pressed in [true, false] {
        let modifiers = Modifiers::NONE;
        page.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
    }
    page.run_steps(2);
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
