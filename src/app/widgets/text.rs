//! Text painted where it is wanted.

use egui::text::LayoutJob;
use egui::{Align2, Color32, FontId, Pos2, Rect, Ui};

use crate::app::charts::notation;
use crate::app::widgets::symbol;

/// Paints a line of text; returns where it is.
pub fn paint(ui: &Ui, at: Pos2, align: Align2, text: &str, font: FontId, color: Color32) -> Rect {
    ui.painter().text(at, align, text, font, color)
}

/// Width of a line of text, points.
pub fn width(ui: &Ui, text: &str, font: FontId) -> f32 {
    ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER).size().x
}

/// Text whose symbols have their indices below the line, and whose numbers stay with their units.
#[must_use]
pub fn rich(text: &str, size: f32, color: Color32) -> LayoutJob {
    let mut text = text.replace("ξ1", "ξ_1").replace("ξ2", "ξ_2").replace("θL", "θ_L");
    for unit in ["s", "mm", "mN", "%"] {
        for digit in '0'..='9' {
            text = text.replace(&format!("{digit} {unit}"), &format!("{digit}\u{a0}{unit}"));
        }
    }
    notation::job(&text, size, color)
}

/// Paints such a text on one line, with its symbols as links; returns where it is.
pub fn paint_rich(ui: &Ui, at: Pos2, align: Align2, text: &str, size: f32, color: Color32) -> Rect {
    let galley = ui.painter().layout_job(rich(text, size, color));
    let rect = align.anchor_size(at, galley.size());
    symbol::galley(ui.painter(), rect.min, galley, color);
    rect
}
