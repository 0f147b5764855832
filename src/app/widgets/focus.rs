//! What shows where the keyboard is.

use egui::{Rect, Response, Stroke, StrokeKind, Ui};

use crate::app::theme::Theme;

/// Draws a frame just inside a rectangle while a widget has the keyboard's focus.
pub fn ring(ui: &Ui, rect: Rect, response: &Response) {
    if response.has_focus() {
        let theme = Theme::of(ui);
        ui.painter().rect_stroke(rect, 6.0, Stroke::new(2.0, theme.accent), StrokeKind::Inside);
    }
}
