//! Symbols in texts: named under the pointer or the keyboard's focus, and one click from their place in the theory. A finger cannot point
//! before it taps: its tap names a symbol, and the note that says so leads on.
//!
//! A text that may hold symbols is painted by [`galley`], [`upright`] or [`label`], which note where they stand; at the end of a pass
//! [`links`] makes a link of each place. What is on a button is the button's: its symbols are named, and no links.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::epaint::TextShape;
use egui::text::{CCursor, LayoutJob};
use egui::text_selection::LabelSelectionState;
use egui::{Color32, CursorIcon, Galley, Id, Label, LayerId, Painter, Popup, PopupKind, Pos2, Rect, Response, Role};
use egui::{Sense, Stroke, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use crate::app::command::Command;
use crate::app::controls::row::TARGET;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::finger;
use crate::app::widgets::text::rich;
use centrode_core::symbols::{Symbol, spans, within};

/// So much around a symbol is it, too, points.
const AROUND: egui::Vec2 = vec2(1.5, 2.0);
/// Size of what a finger goes on by from a note, points.
const NOTE: egui::Vec2 = vec2(180.0, TARGET);

/// A symbol where it stands.
#[derive(Clone, Copy)]
struct Spot {
    symbol: &'static Symbol,
    layer: LayerId,
    clip: Rect,
    rect: Rect,
}

/// What was noted in this pass.
#[derive(Clone, Default)]
struct Noted(Vec<Spot>);

/// Paints a text and notes its symbols.
pub fn galley(painter: &Painter, at: Pos2, galley: Arc<Galley>, ink: Color32) {
    note(painter, &galley, |rect| rect.translate(at.to_vec2()));
    painter.galley(at, galley, ink);
}

/// The same for a text that reads upward from its upper left corner.
pub fn upright(painter: &Painter, at: Pos2, galley: Arc<Galley>, ink: Color32) {
    note(painter, &galley, |rect| {
        Rect::from_min_max(at + vec2(rect.top(), -rect.right()), at + vec2(rect.bottom(), -rect.left()))
    });
    painter.add(TextShape::new(at, galley, ink).with_angle(-std::f32::consts::FRAC_PI_2));
}

/// Shows a text in lines, which can be selected or not, and notes its symbols.
pub fn label(ui: &mut Ui, text: LayoutJob, selectable: bool) -> Response {
    let (at, text, response) = Label::new(text).wrap().selectable(selectable).layout_in_ui(ui);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, ui.is_enabled(), text.text()));
    if ui.is_rect_visible(response.rect) {
        let ink = ui.visuals().text_color();
        if selectable {
            note(ui.painter(), &text, |rect| rect.translate(at.to_vec2()));
            LabelSelectionState::label_text_selection(ui, &response, at, text, ink, Stroke::NONE);
        } else {
            galley(ui.painter(), at, text, ink);
        }
    }
    response
}

/// Notes the symbols of a text; `place` says where a part of it lies on the screen.
fn note(painter: &Painter, galley: &Galley, place: impl Fn(Rect) -> Rect) {
    if !painter.is_visible() {
        return;
    }
    let (clip, layer) = (painter.clip_rect(), painter.layer_id());
    let spots = spans(galley.text()).into_iter().map(|(at, symbol)| {
        let end = |at: usize, prefer_next_row| galley.pos_from_cursor(CCursor { index: at.into(), prefer_next_row });
        let (from, to) = (end(at.start, true), end(at.end, false));
        // A symbol at the end of a line ends there, even where the next line is what follows.
        let right = if to.top() > from.top() { galley.rect.right() } else { to.left() };
        let rect = Rect::from_min_max(from.left_top(), pos2(right, from.bottom()));
        Spot { symbol, layer, clip, rect: place(rect).expand2(AROUND) }
    });
    let seen: Vec<Spot> = spots.filter(|spot| clip.contains(spot.rect.center())).collect();
    if !seen.is_empty() {
        painter.ctx().data_mut(|data| data.get_temp_mut_or_default::<Noted>(Id::NULL).0.extend(seen));
    }
}

/// The place of a symbol that a finger has tapped: it stays named until something else is tapped or dragged.
#[derive(Clone, Copy, Default)]
struct Tapped(Option<Id>);

/// Makes links of all symbols that were noted in this pass. The first place of each takes the keyboard; the pointer finds them all.
pub fn links(ui: &mut Ui, out: &mut Vec<Command>) {
    let tapped = ui.data(|data| data.get_temp::<Tapped>(Id::NULL).unwrap_or_default());
    let elsewhere = ui.input(|input| input.pointer.any_click() || input.pointer.is_decidedly_dragging());
    let mut next = Tapped::default();
    let noted = ui.data_mut(|data| std::mem::take(&mut data.get_temp_mut_or_default::<Noted>(Id::NULL).0));
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    for spot in noted {
        // What a window covers is not there for now.
        if !ui.memory(|memory| memory.allows_interaction(spot.layer)) {
            continue;
        }
        let place = places.entry(spot.symbol.id).or_default();
        let id = Id::unique(("symbol", spot.symbol.id, *place));
        let mut child = ui.new_child(UiBuilder::new().layer_id(spot.layer).max_rect(spot.rect));
        child.set_clip_rect(spot.clip);
        let was_tapped = tapped.0 == Some(id);
        let is_tapped = link(&child, &spot, (id, *place == 0, was_tapped), out);
        if is_tapped || was_tapped && !elsewhere {
            next = Tapped(Some(id));
        }
        *place += 1;
    }
    ui.data_mut(|data| data.insert_temp(Id::NULL, next));
}

/// Makes a link of a symbol where it stands, the `first` place for the keyboard, too; returns whether a finger has tapped it now and not
/// before, and is to be told what it is.
fn link(ui: &Ui, spot: &Spot, (id, first, was_tapped): (Id, bool, bool), out: &mut Vec<Command>) -> bool {
    let Spot { symbol, rect, .. } = *spot;
    let sense = if first { Sense::click() } else { Sense::CLICK };
    let response = ui.interact(rect, id, sense).on_hover_cursor(CursorIcon::PointingHand);
    if first {
        response
            .widget_info(|| WidgetInfo::labeled(Role::Link, ui.is_enabled(), format!("Theory: {}", spoken(symbol))));
    }
    if response.hovered() {
        let y = ui.painter().round_to_pixel_center(rect.bottom() - AROUND.y);
        ui.painter().hline(rect.x_range(), y, Stroke::new(1.0, Theme::of(ui).dim));
    }
    let asks = response.clicked() && finger::is_down(ui) && !was_tapped;
    if response.clicked() && !asks {
        out.push(Command::Theory(Some(symbol)));
    }
    if asks || was_tapped {
        let note = Popup::from_response(&response).kind(PopupKind::Tooltip).show(|ui| led_on(ui, symbol));
        if note.is_some_and(|note| note.inner) {
            out.push(Command::Theory(Some(symbol)));
        }
        return asks;
    }
    let how = if response.has_focus() { "Enter" } else { "Click" };
    let names = |ui: &mut Ui| {
        named(ui, symbol);
        ui.weak(format!("{how}: its place in the theory"));
    };
    if response.has_focus() {
        response.show_tooltip_ui(names);
    } else {
        response.on_hover_ui(names);
    }
    false
}

/// Names a symbol to a finger; returns whether that goes on from there.
fn led_on(ui: &mut Ui, symbol: &Symbol) -> bool {
    named(ui, symbol);
    let (bar, _) = ui.allocate_exact_size(NOTE, Sense::hover());
    button(ui, bar, "Its place in the theory", &Theme::of(ui))
}

/// Names the symbols of what is written on a button under the pointer.
pub fn names(response: Response, written: &str) {
    let symbols = within(written);
    if !symbols.is_empty() {
        response.on_hover_ui(|ui| symbols.into_iter().for_each(|symbol| named(ui, symbol)));
    }
}

fn named(ui: &mut Ui, symbol: &Symbol) {
    ui.label(rich(&symbol.line(), 13.0, Theme::of(ui).ink));
}

/// A symbol's name as it is heard.
fn spoken(symbol: &Symbol) -> String {
    format!("{}, {}", symbol.text.replace('_', ""), symbol.name.replace('_', ""))
}
