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

/// The same in lines that are so many times as high as its letters are large. An index has a lower line, so that it stays below the others.
#[must_use]
pub fn rich_lines(text: &str, size: f32, color: Color32, times: f32) -> LayoutJob {
    let mut job = rich(text, size, color);
    job.sections.iter_mut().for_each(|section| {
        section.format.line_height = Some(times * section.format.font_id.size);
    });
    job
}

/// Paints such a text on one line, with its symbols as links; returns where it is.
pub fn paint_rich(ui: &Ui, at: Pos2, align: Align2, text: &str, size: f32, color: Color32) -> Rect {
    let galley = ui.painter().layout_job(rich(text, size, color));
    let rect = align.anchor_size(at, galley.size());
    symbol::galley(ui.painter(), rect.min, galley, color);
    rect
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::theme;
    use egui::{Pos2, RawInput, Rect, vec2};

    /// How far the letters of the index lie below the others, points.
    fn drop(job: impl Fn() -> LayoutJob) -> f32 {
        let ctx = egui::Context::default();
        theme::install(&ctx);
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(400.0, 400.0));
        let input = RawInput { screen_rect: Some(screen), ..RawInput::default() };
        let mut low = f32::NAN;
        let mut output = ctx.run_ui(input, |ui| {
            let galley = ui.painter().layout_job(job());
            let baseline = |letter| {
                let glyph = galley.rows[0].glyphs.iter().find(|glyph| glyph.chr == letter).expect("it is there");
                glyph.pos.y
            };
            low = baseline('2') - baseline('ξ');
        });
        // Nothing is painted.
        output.textures_delta.clear();
        low
    }

    #[test]
    fn an_index_stays_below_the_line_in_high_lines() {
        let plain = drop(|| rich("ξ2 is low", 13.5, Color32::WHITE));
        let high = drop(|| rich_lines("ξ2 is low", 13.5, Color32::WHITE, 1.45));
        assert!(plain > 0.5 && high > 0.5 && (high - plain).abs() < 1.5, "{plain} and {high}");
    }
}
