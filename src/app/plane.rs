//! Stand-in for the bending plane until it is merged: the backbone, drawn flat.

use egui::{Sense, Stroke, Ui, vec2};

use super::command::Command;
use super::theme::Theme;
use crate::experiment::Run;
use crate::experiment::plant::Plant;

/// Shows the bending plane.
pub fn plane(ui: &mut Ui, run: &Run, cursor: f64, _out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let (rect, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let plant = Plant::new(&run.plan);
    let shape = plant.shape(plant.command(cursor).0);
    let length = run.plan.segment().length;
    let delta = run.plan.scenario().motion.delta;
    let scale = rect.height() / length as f32 * 0.8;
    let base = rect.center_bottom() - vec2(rect.width() * 0.25, 10.0);
    let points = (0..=48).map(|i| {
        let p = shape.pose(length * f64::from(i) / 48.0).position;
        let along = p.x * delta.cos() - p.y * delta.sin();
        base + vec2(along as f32, -p.z as f32) * scale
    });
    ui.painter_at(rect).line(points.collect(), Stroke::new(4.0, theme.robot));
}
