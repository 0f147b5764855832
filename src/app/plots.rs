//! Stand-in for the live plots until theirs is merged: the deviation over time, with threshold and cursor.

use egui::{Rect, Sense, Stroke, Ui, pos2, remap};

use super::command::Command;
use super::theme::Theme;
use crate::experiment::Run;

/// What the plots remember.
#[derive(Debug, Default)]
pub struct PlotState {}

/// Shows the plots.
pub fn plots(ui: &mut Ui, run: &Run, cursor: f64, _state: &mut PlotState, _out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let (rect, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let end = run.plan.scenario().motion.end;
    let x = |time: f64| remap(time as f32, 0.0..=end as f32, rect.x_range());
    let y = |value: f64| remap(value as f32, 0.0..=0.02, rect.y_range().flipped());
    let painter = ui.painter_at(rect);
    let mut line = Vec::new();
    for sample in run.samples.iter().step_by(10) {
        if sample.judgement.deviation.is_nan() {
            painter.line(std::mem::take(&mut line), Stroke::new(1.5, theme.sensor));
        } else {
            line.push(pos2(x(sample.time), y(sample.judgement.deviation)));
        }
    }
    painter.line(line, Stroke::new(1.5, theme.sensor));
    if let Some(xi2) = run.plan.scenario().detection.xi2.value() {
        painter.hline(rect.x_range(), y(xi2), Stroke::new(1.0, theme.detection));
    }
    painter.vline(x(cursor), Rect::y_range(&rect), Stroke::new(1.0, theme.dim));
}
