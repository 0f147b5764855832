//! Symbols in labels: named under the pointer or the keyboard's focus, and one click from their place in the theory.

use egui::{CursorIcon, Rect, Role, Sense, Stroke, Ui, WidgetInfo};

use crate::app::command::Command;
use crate::app::theme::Theme;
use crate::app::widgets::text::rich;
use centrode_core::symbols::{Symbol, within};

/// Explains a label that was painted at `rect`: `tip` and the names of its symbols show under the pointer, and a click opens the theory
/// at the first of them. A label without symbols shows its tip alone.
pub fn explain(ui: &Ui, rect: Rect, id: impl egui::AsIdSalt, (label, tip): (&str, &str), out: &mut Vec<Command>) {
    let id = ui.make_persistent_id(id);
    let symbols = within(label);
    let Some(&first) = symbols.first() else {
        if !tip.is_empty() {
            ui.interact(rect.expand(2.0), id, Sense::hover()).on_hover_text(tip);
        }
        return;
    };
    let theme = Theme::of(ui);
    let response = ui.interact(rect.expand(2.0), id, Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::labeled(Role::Link, ui.is_enabled(), format!("Theory: {}", spoken(first))));
    if response.hovered() || response.has_focus() {
        let y = ui.painter().round_to_pixel_center(rect.bottom());
        let color = if response.has_focus() { theme.accent } else { theme.dim };
        ui.painter().hline(rect.x_range(), y, Stroke::new(1.0, color));
    }
    let names = |ui: &mut Ui| {
        if !tip.is_empty() {
            ui.label(tip);
        }
        for symbol in &symbols {
            ui.label(rich(&symbol.line(), 13.0, theme.ink));
        }
        ui.weak("Click: its place in the theory");
    };
    if response.has_focus() {
        response.show_tooltip_ui(names);
    }
    let response = if response.has_focus() { response } else { response.on_hover_ui(names) };
    if response.clicked() {
        out.push(Command::Theory(Some(first)));
    }
}

/// A symbol's name as it is heard.
fn spoken(symbol: &Symbol) -> String {
    format!("{}, {}", symbol.text.replace('_', ""), symbol.name.replace('_', ""))
}
