//! Which threshold of each detector to take, with a button that sets it and switches the detector on.

use super::words;
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::stages::Inputs;
use crate::app::theme::Theme;
use crate::app::widgets::button::named;
use crate::app::widgets::finger;
use crate::app::widgets::symbol;
use crate::app::widgets::text::rich;
use centrode_core::study::compare::Comparison;
use egui::{Label, Rect, RichText, Ui, vec2};

/// Size of the button, with the space before it.
const BUTTON: egui::Vec2 = vec2(52.0, 22.0);
const SPACE: f32 = 10.0;

/// A heading, and a line for each detector.
pub fn advice(ui: &mut Ui, comparison: &Comparison, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    ui.add(Label::new(RichText::new("Which threshold to take").font(fonts::strong(11.8)).color(theme.ink)));
    let said = format!(
        "The soonest shown to give at most {} % false alarms, by the upper end of its 95 % interval.",
        words::wished(comparison.rate)
    );
    symbol::label(ui, rich(&said, 11.5, theme.dim), false);
    for compared in &comparison.detectors {
        let method = compared.method();
        let soonest = comparison.soonest == Some(compared.detector);
        let line = words::line(compared, soonest, inputs);
        let taken = compared.taken();
        // Those of the settings before are only looked at.
        let takes = taken.filter(|_| !inputs.comparer.is_former());
        let mut text = rich(&line, 12.0, if taken.is_some() { theme.ink } else { theme.dim });
        let button = vec2(BUTTON.x, finger::at_least(ui, BUTTON.y));
        let room = if takes.is_some() { button.x + SPACE } else { 0.0 };
        text.wrap.max_width = (ui.available_width() - room).max(80.0);
        let height =
            ui.painter().layout_job(text.clone()).size().y.max(if takes.is_some() { button.y } else { 0.0 }) + 4.0;
        let (_, place) = ui.allocate_space(vec2(ui.available_width(), height));
        ui.painter().hline(place.x_range(), place.top(), egui::Stroke::new(1.0, theme.faint));
        let words = place.with_max_x(place.right() - room).with_min_y(place.top() + 3.0);
        let mut said = ui.new_child(egui::UiBuilder::new().max_rect(words).id_salt(compared.detector));
        symbol::label(&mut said, text, false);
        if let Some(point) = takes {
            let at = Rect::from_min_size(place.right_top() + vec2(-button.x, 3.0), button);
            let name = format!("Take the threshold of {}", words::short(method));
            if named(ui, at, ("Take", &name), &theme) {
                out.push(Command::TakeDetector { method, threshold: point.threshold });
            }
        }
    }
}
