//! A notice over the page: what was not taken as it was given, and what was done instead.

use egui::{Color32, Id, Modal, Rect, RichText, ScrollArea, Ui, pos2, vec2};

use crate::app::command::Command;
use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::finger;
use crate::app::widgets::text;

/// What it says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Notice {
    /// What has happened, in a few words.
    pub title: String,
    /// What that means, in a sentence or two.
    pub text: String,
    /// Each thing that was not taken.
    pub rows: Vec<Row>,
    /// All of it as plain text, to be copied.
    pub details: String,
}

/// One thing that was not taken.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// As it was written.
    pub written: String,
    /// Why it was not taken, and what is allowed.
    pub why: String,
    /// What was used instead; empty for nothing.
    pub used: String,
}

/// A sentence; with indices below the line, unless it names a key that has `_` in it.
fn said(ui: &mut Ui, sentence: &str, ink: Color32) {
    if sentence.contains('_') {
        ui.label(RichText::new(sentence).size(13.5).color(ink));
    } else {
        ui.label(text::rich(sentence, 13.5, ink));
    }
}

/// Shows a notice over the page.
pub fn notice(ui: &mut Ui, notice: &Notice, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let screen = ui.ctx().content_rect();
    let modal = Modal::new(Id::unique("notice")).backdrop_color(egui::Color32::from_black_alpha(110));
    let frame = egui::Frame::popup(ui.style()).inner_margin(20).corner_radius(12);
    let shown = modal.frame(frame).show(ui.ctx(), |ui| {
        let width = (screen.width() - 72.0).min(560.0);
        ui.set_width(width);
        let dim = theme.ink.lerp_to_gamma(theme.dim, 0.4);
        ui.label(RichText::new(&notice.title).font(fonts::strong(18.0)).color(theme.ink));
        ui.add_space(4.0);
        said(ui, &notice.text, dim);
        // As high as it may be at once: it would grow frame by frame, and its buttons would move away from the pointer.
        let height = (screen.height() - 230.0).max(80.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.set_width(width - 8.0);
            for Row { written, why, used } in &notice.rows {
                ui.add_space(8.0);
                ui.label(RichText::new(written).font(fonts::strong(13.5)).color(theme.ink));
                said(ui, why, dim);
                if !used.is_empty() {
                    said(ui, used, theme.ink);
                }
            }
        });
        ui.add_space(12.0);
        let (bar, _) = ui.allocate_exact_size(vec2(width, finger::at_least(ui, 32.0)), egui::Sense::hover());
        let [wide, narrow] = ["Copy details", "Go on"].map(|word| text::width(ui, word, fonts::strong(12.5)) + 28.0);
        let go_on = Rect::from_min_max(pos2(bar.right() - narrow, bar.top()), bar.max);
        let copy =
            Rect::from_min_max(pos2(go_on.left() - 8.0 - wide, bar.top()), pos2(go_on.left() - 8.0, bar.bottom()));
        if button(ui, copy, "Copy details", &theme) {
            out.push(Command::CopyNotice);
        }
        button(ui, go_on, "Go on", &theme)
    });
    if shown.inner || shown.should_close() {
        out.push(Command::CloseNotice);
    }
}
