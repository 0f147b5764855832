//! Symbols are named where they stand, and lead to their place in the theory.

use crate::support::{DESK, PHONE, Page, app, finish, page_of, texts};
use centrode::app::link::Effect;
use centrode::app::stages::stage::Stage;
use centrode_core::symbols::{SYMBOLS, find, spans};
use egui::accesskit::Role;
use egui::text::CCursor;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Shape, TouchDeviceId, TouchId, TouchPhase};
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

/// Puts a finger down at a place and lifts it, as a browser tells of it: what a mouse would do, and the touch besides.
fn tap(page: &mut Page, pos: Pos2) {
    for (phase, pressed) in [(TouchPhase::Start, true), (TouchPhase::End, false)] {
        let modifiers = Modifiers::NONE;
        page.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
        page.event(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(0), phase, pos, force: None });
        if !pressed {
            page.event(Event::PointerGone);
        }
        page.step();
    }
    page.run_steps(3);
}

#[test]
fn a_tap_names_a_symbol_and_leads_on_from_its_note() {
    const ON: &str = "Its place in the theory";
    for size in [PHONE, DESK] {
        let mut page = page_of(size);
        if size == PHONE {
            page.get_by_label("Plots").click();
            page.run_steps(3);
        }
        let symbol = find("deviation").expect("a symbol");
        let at = link(&page, "deviation").rect().center();
        let line = symbol.line().replace('_', "");
        opened(&mut page);
        tap(&mut page, at);
        assert_eq!(named(&page), std::slice::from_ref(&line), "at {size}");
        assert!(opened(&mut page).is_empty(), "a finger is told what it is first");
        let on = page.get_by_role_and_label(Role::Button, ON).rect();
        assert!(on.width().min(on.height()) >= 43.9, "{on}");
        // It stays, to be read.
        page.run_steps(40);
        assert_eq!(named(&page), std::slice::from_ref(&line));
        tap(&mut page, on.center());
        assert_eq!(opened(&mut page), ["theory.html#sym-deviation"]);
        assert!(named(&page).is_empty() && page.query_by_label(ON).is_none());
        // The symbol itself leads there as well, once it was named.
        tap(&mut page, at);
        tap(&mut page, at);
        assert_eq!(opened(&mut page), ["theory.html#sym-deviation"]);
        assert!(named(&page).is_empty());
        // A tap on something else puts the note away, a symbol or not.
        tap(&mut page, at);
        let other = link(&page, "theta").rect().center();
        tap(&mut page, other);
        assert_eq!(named(&page), [find("theta").expect("a symbol").line().replace('_', "")]);
        let help = page.get_by_label("Help").rect().center();
        tap(&mut page, help);
        assert!(page.query_by_label(ON).is_none());
        assert!(opened(&mut page).is_empty());
    }
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

/// Every symbol that is painted in sight: which it is, its middle, and the text it is in; not those that stand on a control.
fn written(page: &Page) -> Vec<(&'static str, Pos2, String)> {
    fn all(shape: &Shape, clip: Rect, found: &mut Vec<(&'static str, Pos2, String)>) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| all(shape, clip, found)),
            Shape::Text(text) if text.angle == 0.0 => {
                for (at, symbol) in spans(text.galley.text()) {
                    let end = |index: usize, prefer_next_row| {
                        let cursor = CCursor { index: index.into(), prefer_next_row };
                        text.galley.pos_from_cursor(cursor).translate(text.pos.to_vec2())
                    };
                    let (from, to) = (end(at.start, true), end(at.end, false));
                    let middle = from.union(to).center();
                    if from.top() == to.top() && clip.contains(middle) {
                        found.push((symbol.id, middle, text.galley.text().to_owned()));
                    }
                }
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    page.output().shapes.iter().for_each(|clipped| all(&clipped.shape, clipped.clip_rect, &mut found));
    let controls: Vec<Rect> =
        [Role::Button, Role::RadioButton, Role::CheckBox, Role::Switch, Role::TextInput, Role::Slider]
            .into_iter()
            .flat_map(|role| page.query_all_by_role(role).map(|node| node.rect()).collect::<Vec<_>>())
            .filter(|rect| rect.height() < 60.0)
            .collect();
    found.retain(|(_, at, _)| !controls.iter().any(|control| control.contains(*at)));
    found
}

/// A note names a symbol wherever it stands, and a click there leads on: it does nothing else.
#[test]
fn a_click_on_any_symbol_in_sight_opens_its_place_and_does_nothing_else() {
    for stage in Stage::ALL {
        let mut page = page_of(DESK);
        let link = format!("preset=bench&view={}&t=7&repeats=4&compare=fcd,jfd", stage.key());
        page.state_mut().as_mut().expect("built").go(&link);
        page.run_steps(3);
        // What is found may move what is said.
        finish(&mut page);
        let symbols = written(&page);
        assert!(symbols.len() >= 3, "{stage:?}: {symbols:?}");
        opened(&mut page);
        for (id, at, text) in symbols {
            let before = app(&page).state().clone();
            press(&mut page, at);
            assert_eq!(opened(&mut page), [format!("theory.html#sym-{id}")], "{stage:?}: {id} at {at} in {text:?}");
            assert_eq!(app(&page).state(), &before, "{stage:?}: {id} at {at} in {text:?}");
        }
    }
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
