//! Real elements for screen readers and keyboards (`web/elements.js`): egui's widgets go out as a list, and what is done with the
//! elements comes back as if it had been done with the widgets.

use super::{TEST, repaint, widgets, with_hooks};
use crate::app::mirror::{Mirror, id};
use egui::accesskit::{Action, ActionData, ActionRequest, TreeId, TreeUpdate};
use egui::{Event, Key, Modifiers};
use std::cell::{Cell, RefCell};
use std::time::Duration;
use wasm_bindgen::prelude::*;

/// Values that change with every frame go out so often, s; everything else goes out at once.
const APART: f64 = 0.2;

thread_local! {
    static EVENTS: RefCell<Vec<Event>> = const { RefCell::new(Vec::new()) };
    /// Whether an element has the keyboard, so that the canvas has not.
    static FOCUSED: Cell<bool> = const { Cell::new(false) };
}

fn push(event: Event) {
    EVENTS.with_borrow_mut(|events| events.push(event));
    repaint();
}

/// Does something with a widget: `click`, `focus`, `show` (scrolls to it), `number` or `text` (gives it a value). What there is
/// no widget or no number for is left.
#[wasm_bindgen]
pub fn mirror_act(element: &str, what: &str, value: &str) {
    let (action, data) = match (what, value.trim().parse()) {
        ("click", _) => (Action::Click, None),
        ("focus", _) => (Action::Focus, None),
        ("show", _) => (Action::ScrollIntoView, None),
        ("number", Ok(number)) => (Action::SetValue, Some(ActionData::NumericValue(number))),
        ("text", _) => (Action::SetValue, Some(ActionData::Value(value.into()))),
        _ => return,
    };
    if let Some(target_node) = id(element) {
        push(Event::AccessKitActionRequest(ActionRequest { action, target_tree: TreeId::ROOT, target_node, data }));
    }
}

/// Presses a key, named as in JavaScript, for whatever has the focus.
#[wasm_bindgen]
pub fn mirror_key(name: &str, shift: bool) {
    let Some(key) = Key::from_name(name) else { return };
    let modifiers = if shift { Modifiers::SHIFT } else { Modifiers::NONE };
    for pressed in [true, false] {
        push(Event::Key { key, physical_key: None, pressed, repeat: false, modifiers });
    }
}

/// Whether an element has the keyboard from now on.
#[wasm_bindgen]
pub fn mirror_focused(focused: bool) {
    FOCUSED.set(focused);
    repaint();
}

/// Takes egui's tree, which eframe drops, and gives what came of it.
#[derive(Default)]
pub struct Plugin {
    /// What went out last, and when, s.
    sent: Option<(String, f64)>,
    /// The widgets and the focus of it.
    shape: (usize, u64),
    /// The page has asked for something, and is to hear what is so even if that is what it was.
    asked: bool,
    /// Shift is down until the next frame.
    shifted: bool,
}

impl egui::Plugin for Plugin {
    fn debug_name(&self) -> &'static str {
        "mirror"
    }

    fn input_hook(&mut self, _ctx: &egui::Context, input: &mut egui::RawInput) {
        let events = EVENTS.take();
        self.asked |= !events.is_empty();
        if std::mem::take(&mut self.shifted) {
            input.events.push(Event::ModifiersChanged(Modifiers::NONE));
        }
        let shift = |event: &Event| matches!(event, Event::Key { modifiers, .. } if modifiers.shift);
        if events.iter().any(shift) {
            self.shifted = true;
            input.events.push(Event::ModifiersChanged(Modifiers::SHIFT));
            repaint();
        }
        input.events.extend(events);
        input.focused |= FOCUSED.get();
    }

    fn output_hook(&mut self, ctx: &egui::Context, output: &mut egui::FullOutput) {
        let Some(update) = output.platform_output.accesskit_update.take() else { return };
        self.send(ctx, &update);
        if TEST.get() {
            widgets::keep(update, f64::from(ctx.pixels_per_point()));
        }
    }
}

impl Plugin {
    fn send(&mut self, ctx: &egui::Context, update: &TreeUpdate) {
        let now = ctx.input(|input| input.time);
        let shape = (update.nodes.len(), update.focus.0);
        if let (Some((_, at)), false) = (&self.sent, self.asked || shape != self.shape) {
            let left = APART - (now - at);
            if left > 0.0 {
                ctx.request_repaint_after(Duration::from_secs_f64(left));
                return;
            }
        }
        self.shape = shape;
        let json = serde_json::to_string(&Mirror::of(update)).unwrap_or_default();
        let known = self.sent.as_ref().is_some_and(|(sent, _)| *sent == json);
        if !known || self.asked {
            with_hooks(|hooks| hooks.mirror(&json));
        }
        self.asked = false;
        self.sent = Some((json, now));
    }
}
