//! Symbols, subscripts and small notes, painted.

use crate::app::theme::Theme;
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, FontFamily, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, pos2, vec2};

/// Text in which `_x` is a subscript and `‖` comes from a font that has it.
#[must_use]
pub fn job(text: &str, size: f32, color: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    append(&mut job, text, size, color);
    job
}

/// Adds text to a job, as [`job`] writes it.
pub fn append(job: &mut LayoutJob, text: &str, size: f32, color: Color32) {
    let format =
        |family, size, valign| TextFormat { font_id: FontId::new(size, family), color, valign, ..Default::default() };
    let body = |plain: &mut String, job: &mut LayoutJob| {
        if !plain.is_empty() {
            job.append(plain, 0.0, format(FontFamily::Proportional, size, Align::Center));
            plain.clear();
        }
    };
    let mut plain = String::new();
    let mut characters = text.chars();
    while let Some(character) = characters.next() {
        let (piece, format) = match character {
            '_' => match characters.next() {
                Some(low) => (low, format(FontFamily::Proportional, 0.76 * size, Align::BOTTOM)),
                None => break,
            },
            '‖' => ('‖', format(FontFamily::Monospace, size, Align::Center)),
            _ => {
                plain.push(character);
                continue;
            }
        };
        body(&mut plain, job);
        job.append(piece.encode_utf8(&mut [0; 4]), 0.0, format);
    }
    body(&mut plain, job);
}

/// A number with a true minus sign; `–` where it is not defined.
#[must_use]
pub fn number(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(size) if size.bytes().all(|b| b == b'0' || b == b'.') => size.into(),
        Some(size) => format!("−{size}"),
        None => text,
    }
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
    fn subscripts_and_norms_get_their_own_sections() {
        let job = job("‖c_m − c_s‖ (mm)", 12.0, Color32::WHITE);
        assert_eq!(job.text, "‖cm − cs‖ (mm)");
        let sizes: Vec<f32> = job.sections.iter().map(|section| section.format.font_id.size).collect();
        assert!(
            sizes.iter().any(|&size| size < 10.0) && sizes.iter().filter(|&&size| size == 12.0).count() >= 4,
            "{sizes:?}"
        );
    }

    #[test]
    fn numbers_have_a_minus_and_no_negative_zero() {
        assert_eq!(number(-1.25, 1), "−1.2");
        assert_eq!(number(-0.001, 2), "0.00");
        assert_eq!(number(7.0, 2), "7.00");
        assert_eq!(number(f64::NAN, 2), "–");
        assert_eq!(number(f64::INFINITY, 2), "–");
    }

    #[test]
    fn notes_stay_inside() {
        let bounds = Rect::from_min_size(Pos2::ZERO, vec2(100.0, 60.0));
        for anchor in [pos2(0.0, 0.0), pos2(99.0, 1.0), pos2(50.0, 59.0), pos2(99.0, 59.0)] {
            assert!(bounds.contains_rect(beside(anchor, vec2(60.0, 20.0), bounds)));
        }
    }
}
