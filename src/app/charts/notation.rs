//! Symbols, subscripts and small notes, painted.

use crate::app::theme::Theme;
use centrode_core::chart::font::LOW;
pub use centrode_core::chart::notation::number;
use centrode_core::chart::notation::runs;
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, FontFamily, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, pos2, vec2};

/// Text in which `_x` is a subscript.
#[must_use]
pub fn job(text: &str, size: f32, color: Color32) -> LayoutJob {
    job_in(text, &FontFamily::Proportional, size, color)
}

/// The same in a weight.
#[must_use]
pub fn job_in(text: &str, family: &FontFamily, size: f32, color: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    for run in runs(text) {
        let (size, valign) = if run.low { (LOW as f32 * size, Align::BOTTOM) } else { (size, Align::Center) };
        let font_id = FontId::new(size, family.clone());
        job.append(&run.text, 0.0, TextFormat { font_id, color, valign, ..Default::default() });
    }
    job
}

/// Where a box of `size` goes beside `anchor` so that it stays within `bounds`: right of it, else left; above it, else below.
#[must_use]
pub fn beside(anchor: Pos2, size: Vec2, bounds: Rect) -> Rect {
    let gap = 10.0;
    let right = anchor.x + gap;
    let x = if right + size.x <= bounds.right() { right } else { anchor.x - gap - size.x };
    let above = anchor.y - gap - size.y;
    let y = if above >= bounds.top() { above } else { anchor.y + gap };
    let x = x.clamp(bounds.left(), (bounds.right() - size.x).max(bounds.left()));
    let y = y.clamp(bounds.top(), (bounds.bottom() - size.y).max(bounds.top()));
    Rect::from_min_size(pos2(x, y), size)
}

/// Paints a small note of a few lines beside `anchor`, within `bounds`.
pub fn note(painter: &Painter, theme: &Theme, anchor: Pos2, bounds: Rect, lines: Vec<LayoutJob>) {
    let galleys: Vec<_> = lines.into_iter().map(|line| painter.layout_job(line)).collect();
    let width = galleys.iter().map(|galley| galley.size().x).fold(0.0, f32::max);
    let height: f32 = galleys.iter().map(|galley| galley.size().y).sum();
    let pad = vec2(7.0, 4.0);
    let rect = beside(anchor, vec2(width, height) + 2.0 * pad, bounds);
    painter.rect(rect, 4.0, theme.panel, Stroke::new(1.0, theme.faint), StrokeKind::Inside);
    let mut at = rect.min + pad;
    for galley in galleys {
        let down = galley.size().y;
        painter.galley(at, galley, theme.ink);
        at.y += down;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subscripts_get_their_own_sections() {
        let job = job("‖c_m − c_s‖ (mm)", 12.0, Color32::WHITE);
        assert_eq!(job.text, "‖cm − cs‖ (mm)");
        let sizes: Vec<f32> = job.sections.iter().map(|section| section.format.font_id.size).collect();
        assert_eq!(sizes, [12.0, 9.12, 12.0, 9.12, 12.0]);
    }

    #[test]
    fn notes_stay_inside() {
        let bounds = Rect::from_min_size(Pos2::ZERO, vec2(100.0, 60.0));
        for anchor in [pos2(0.0, 0.0), pos2(99.0, 1.0), pos2(50.0, 59.0), pos2(99.0, 59.0)] {
            assert!(bounds.contains_rect(beside(anchor, vec2(60.0, 20.0), bounds)));
        }
    }
}
