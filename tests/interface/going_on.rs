//! The page for slow hands, and the page that goes on elsewhere after its graphics were lost.

use crate::support::{DESK, Page, app, click, page_of, slide, slider};
use centrode::app::{App, Host};
use egui::{Event, Modifiers, PointerButton};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

#[test]
fn a_press_of_two_seconds_is_a_click() {
    let mut page = page_of(DESK);
    let pos = page.get_by_label("Play").rect().center();
    let button =
        |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    page.event(Event::PointerMoved(pos));
    page.event(button(true));
    page.run_steps(20);
    assert!(page.query_by_label("Pause").is_none(), "nothing before it is let go");
    page.event(button(false));
    page.run_steps(2);
    assert!(page.query_by_label("Pause").is_some());
}

#[test]
fn it_goes_on_in_another_context_as_it_was() {
    let mut page = page_of(DESK);
    slide(&mut page, "Contact disk", 3.0);
    click(&mut page, "To start");
    let memory = page.ctx.memory(Clone::clone);
    let report = app(&page).report();
    let mut kept = page.state_mut().take().map(|app| (app, memory));
    let go_on = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        if let Some((mut old, memory)) = kept.take() {
            ui.ctx().memory_mut(|fresh| *fresh = memory);
            old.go_on_in(ui.ctx(), None);
            *app = Some(old);
        }
        app.get_or_insert_with(|| App::new(ui.ctx(), None, Host::default())).ui(ui);
    };
    let setup = centrode::app::theme::install;
    let builder = Harness::builder().with_size(DESK).with_step_dt(0.1).with_context_setup(setup);
    let mut other: Page = builder.build_ui_state(go_on, None);
    other.run_steps(2);
    assert_eq!(app(&other).report(), report);
    // And it is worked on as before.
    slide(&mut other, "Contact disk", 1.0);
    assert_eq!(slider(&other, "Contact disk").accesskit_node().numeric_value(), Some(1.0));
    assert_ne!(app(&other).report(), report);
}
