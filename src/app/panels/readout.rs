//! What the run came to: a sentence, and figures in a table.

use egui::{Align2, Sense, Ui, vec2};

use crate::app::fonts;
use crate::app::memo::placed::Placed;
use crate::app::memo::recorded::Recorded;
use crate::app::panels::sheet;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use crate::app::widgets::text;
use crate::app::words::story::{self, Figure};
use crate::app::words::{log, placed as placing};
use centrode_core::run::Run;

/// Below this height there is less space around the words, points.
const LOW: f32 = 290.0;
/// The least height of a row, points.
const LEAST: f32 = 14.5;

/// What is read out.
pub struct Told {
    /// What the run came to.
    pub words: String,
    /// More to know, each with whether it is a warning.
    pub more: Vec<(String, bool)>,
    /// In figures.
    pub figures: Vec<Figure>,
}

impl Told {
    /// Of a run of one segment, simulated or of a log, with what the calibration filter's alarm says at a time (s).
    #[must_use]
    pub fn of(run: &Run, recorded: Option<&Recorded>, (placed, time): (&Placed, f64)) -> Self {
        let (words, figures) = match recorded {
            Some(recorded) => (log::words(run, recorded), log::figures(run)),
            None => (story::words(run), story::figures(run)),
        };
        let said = placing::sentence(run, placed, time).map(|said| (said, false));
        let more = said.into_iter().chain(placing::warning(placed).map(|said| (said, true)));
        Self { words, more: more.collect(), figures }
    }
}

/// Shows the readout of a run.
pub fn readout(ui: &mut Ui, told: &Told) {
    let theme = Theme::of(ui);
    let Told { words, more, figures } = told;
    let low = ui.max_rect().height() < LOW;
    let edge = if low { 5 } else { 12 };
    sheet::scrolled(ui, |ui| {
        egui::Frame::new().inner_margin(egui::Margin::symmetric(16, edge)).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            symbol::label(ui, text::rich(words, 13.5, theme.ink), false);
            for (said, warns) in more {
                ui.add_space(if low { 4.0 } else { 5.0 });
                let ink = if *warns { theme.alarm } else { theme.ink };
                symbol::label(ui, text::rich(said, 12.5, ink), false);
            }
            ui.add_space(if low { 4.0 } else { 8.0 });
            let wide = ui.available_width() > 430.0;
            let columns = if wide { 2 } else { 1 };
            let rows = figures.len().div_ceil(columns);
            let width = (ui.available_width() - if wide { 40.0 } else { 0.0 }) / columns as f32;
            let height = ((ui.available_height() - 14.0) / rows as f32).clamp(LEAST, 26.0);
            let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), height * rows as f32), Sense::hover());
            for (i, figure) in figures.iter().enumerate() {
                let (column, row) = ((i / rows) as f32, (i % rows) as f32);
                let min = rect.min + vec2(column * (width + 40.0), row * height);
                line(ui, egui::Rect::from_min_size(min, vec2(width, height)), figure, &theme);
            }
        });
    });
}

/// A figure: its name at the left, number and unit in columns at the right.
fn line(ui: &mut Ui, rect: egui::Rect, figure: &Figure, theme: &Theme) {
    let ink = match figure.name {
        "Detected" | "Estimate" if figure.value != "–" => theme.alarm,
        _ if figure.value == "–" => theme.dim,
        _ => theme.ink,
    };
    text::paint_rich(ui, rect.left_center(), Align2::LEFT_CENTER, figure.name, 13.0, theme.dim);
    let unit = rect.right_center() - vec2(24.0, 0.0);
    text::paint(ui, unit, Align2::LEFT_CENTER, figure.unit, fonts::regular(12.5), theme.dim);
    text::paint(ui, unit - vec2(5.0, 0.0), Align2::RIGHT_CENTER, &figure.value, fonts::strong(13.5), ink);
    // The painted line is one word to assistive technology.
    let response = ui.interact(rect, ui.make_persistent_id(("figure", figure.name)), Sense::hover());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Label, true, format!("{}: {} {}", figure.name, figure.value, figure.unit))
    });
}
