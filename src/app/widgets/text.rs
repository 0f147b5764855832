//! Text painted where it is wanted.

use egui::{Align2, Color32, FontId, Pos2, Rect, Ui};

/// Paints a line of text; returns where it is.
pub fn paint(ui: &Ui, at: Pos2, align: Align2, text: &str, font: FontId, color: Color32) -> Rect {
    ui.painter().text(at, align, text, font, color)
}

/// Width of a line of text, points.
pub fn width(ui: &Ui, text: &str, font: FontId) -> f32 {
    ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER).size().x
}
