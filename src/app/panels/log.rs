//! The banner above the page while a log is read or shown.

use egui::{Align2, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::app::command::{Command, LogWish};
use crate::app::fonts;
use crate::app::theme::{GAP, Theme};
use crate::app::widgets::button::button;
use crate::app::widgets::text;

/// What the banner says.
#[derive(Debug, Clone, PartialEq)]
pub enum Banner {
    /// A log is being read: its name, and how much of it, 0 to 1.
    Reading(String, f32),
    /// A log is shown.
    Shown {
        /// Its name.
        name: String,
        /// How it is written, how long it is.
        facts: String,
        /// What it lacks; empty for nothing.
        missing: String,
        /// Whether a person can say which column is what.
        columns: bool,
    },
}

/// In one row from this width on, points.
const WIDE: f32 = 900.0;
const ROW: f32 = 38.0;
const TWO_ROWS: f32 = 66.0;

/// Height of the banner on a page so wide, points.
#[must_use]
pub fn height(width: f32) -> f32 {
    if width < WIDE { TWO_ROWS } else { ROW }
}

/// Shows the banner.
pub fn banner(ui: &mut Ui, rect: Rect, banner: &Banner, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    ui.painter().rect_filled(rect, 0.0, theme.raised);
    ui.painter().hline(rect.x_range(), rect.bottom(), egui::Stroke::new(1.0, theme.faint));
    let buttons: &[(&str, LogWish)] = match banner {
        Banner::Reading(..) => &[("Stop reading", LogWish::Cancel)],
        Banner::Shown { columns, .. } => {
            let all = &[("Close log", LogWish::Close), ("Report", LogWish::Report), ("Columns", LogWish::Form)];
            if *columns { all } else { &all[..2] }
        }
    };
    let row = rect.with_max_y(rect.top() + ROW);
    let mut right = rect.right() - GAP;
    for (word, wish) in buttons {
        let width = text::width(ui, word, fonts::strong(12.5)) + 24.0;
        let place = Rect::from_min_size(pos2(right - width, row.center().y - 14.0), vec2(width, 28.0));
        if button(ui, place, word, &theme) {
            out.push(Command::Log(wish.clone()));
        }
        right = place.left() - 8.0;
    }
    let left = rect.left() + GAP + 6.0;
    let (name, said, missing) = match banner {
        Banner::Reading(name, share) => {
            let done = (share * 100.0).floor();
            let line = Rect::from_min_max(pos2(rect.left(), rect.bottom() - 2.0), rect.max);
            ui.painter().rect_filled(line.with_max_x(rect.left() + rect.width() * share), 0.0, theme.accent);
            (name, format!("Reading … {done:.0} %"), "")
        }
        Banner::Shown { name, facts, missing, .. } => (name, facts.clone(), missing.as_str()),
    };
    let title = format!("Log {name}");
    let first = row.with_min_x(left).with_max_x(right - 6.0);
    let drawn = line(ui, first, ("title", &title), fonts::strong(13.0), theme.ink);
    let (said_at, missing_at) = if rect.height() > ROW + 1.0 {
        let second = Rect::from_min_max(pos2(left, row.bottom() - 4.0), rect.max - vec2(GAP, 6.0));
        let width = text::width(ui, &said, fonts::regular(12.5));
        (second, second.with_min_x(left + width + 14.0))
    } else {
        let from = drawn + 14.0;
        let width = text::width(ui, &said, fonts::regular(12.5));
        (first.with_min_x(from), first.with_min_x(from + width + 14.0))
    };
    line(ui, said_at, ("said", &said), fonts::regular(12.5), theme.dim);
    if !missing.is_empty() {
        line(ui, missing_at, ("missing", missing), fonts::regular(12.5), theme.ink);
    }
}

/// A text in a line that ends where it ends; gives its right edge.
fn line(ui: &Ui, rect: Rect, (part, said): (&str, &str), font: egui::FontId, ink: egui::Color32) -> f32 {
    let mut job = egui::text::LayoutJob::single_section(
        said.to_owned(),
        egui::TextFormat { font_id: font, color: ink, ..Default::default() },
    );
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width().max(0.0));
    let galley = ui.painter().layout_job(job);
    let place = Align2::LEFT_CENTER.anchor_size(rect.left_center(), galley.size());
    ui.painter().galley(place.min, galley, ink);
    let response = ui.interact(place.intersect(rect), ui.make_persistent_id(("log", part)), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, said));
    response.on_hover_text(said);
    place.right()
}
