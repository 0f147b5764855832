//! The state in a word and a colour. It pulses once when it becomes “Detected”.

use egui::{Align2, Id, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, vec2};

use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::text;
use crate::app::words::placed::percent;
use crate::app::words::story::Phase;

/// How long the pulse takes, s.
const PULSE: f64 = 0.7;

/// What the chip showed last, and since when.
#[derive(Debug, Clone, Copy, Default)]
pub struct Chip {
    phase: Option<Phase>,
    since: f64,
}

impl Chip {
    /// Shows the chip with its top left corner at a place; beside the state the probability that a contact has begun, where that is known.
    pub fn show(&mut self, ui: &mut Ui, at: Pos2, (phase, contact): (Phase, Option<f64>), still: bool) {
        let theme = Theme::of(ui);
        let now = ui.input(|input| input.time);
        if self.phase != Some(phase) {
            // The first frame shows a state, it does not enter one.
            self.since = if self.phase.is_some() { now } else { f64::NEG_INFINITY };
            self.phase = Some(phase);
        }
        let color = match phase {
            Phase::Free | Phase::Quiet => theme.dim,
            Phase::Contact => theme.obstacle,
            Phase::Detected | Phase::FalseAlarm => theme.alarm,
        };
        let font = fonts::strong(13.5);
        let word = text::width(ui, phase.words(), font.clone());
        let said = contact.map(|contact| format!("P(contact) {}", percent(contact)));
        let small = fonts::regular(12.0);
        // Room for the widest: a value that changes does not move the edge.
        let beside = if said.is_some() { 12.0 + text::width(ui, "P(contact) > 99 %", small.clone()) } else { 0.0 };
        let rect = Rect::from_min_size(at, vec2(word + 42.0 + beside, 30.0));

        let age = ((now - self.since) / PULSE) as f32;
        if phase == Phase::Detected && !still && age < 1.0 {
            let fade = (1.0 - age).powi(2);
            let ring = rect.expand(14.0 * (1.0 - (1.0 - age).powi(3)));
            ui.painter().rect_stroke(
                ring,
                ring.height() / 2.0,
                Stroke::new(3.0, color.gamma_multiply(fade)),
                egui::StrokeKind::Middle,
            );
            ui.ctx().request_repaint();
        }
        let filled = phase == Phase::Detected;
        let ground = if filled { color } else { theme.panel.gamma_multiply(0.92) };
        // A false alarm is an outline: it has a detection's colour and none of its substance.
        let edge = match phase {
            Phase::Detected => Stroke::new(1.0, color),
            Phase::FalseAlarm => Stroke::new(2.0, color),
            Phase::Free | Phase::Contact | Phase::Quiet => Stroke::new(1.0, theme.faint),
        };
        ui.painter().rect(rect, 15.0, ground, edge, egui::StrokeKind::Inside);
        let ink = if !filled {
            theme.ink
        } else if theme.dark {
            theme.surface
        } else {
            theme.panel
        };
        let dot = rect.left_center() + vec2(16.0, 0.0);
        let diamond = || [vec2(0.0, -6.0), vec2(6.0, 0.0), vec2(0.0, 6.0), vec2(-6.0, 0.0)].map(|v| dot + v).to_vec();
        match phase {
            Phase::Free | Phase::Quiet => ui.painter().circle_stroke(dot, 4.5, Stroke::new(2.0, color)),
            Phase::Contact => ui.painter().circle_filled(dot, 5.0, color),
            Phase::Detected => ui.painter().add(egui::Shape::convex_polygon(diamond(), ink, Stroke::NONE)),
            Phase::FalseAlarm => ui.painter().add(egui::Shape::closed_line(diamond(), Stroke::new(1.8, color))),
        };
        text::paint(ui, rect.left_center() + vec2(28.0, 0.0), Align2::LEFT_CENTER, phase.words(), font, ink);
        if let Some(said) = &said {
            text::paint(ui, rect.left_center() + vec2(40.0 + word, 0.0), Align2::LEFT_CENTER, said, small, ink);
        }
        let response = ui.interact(rect, Id::unique("state chip"), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Status, true, format!("State: {}", phase.words())));
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_live(egui::accesskit::Live::Polite);
            if let Some(said) = said {
                node.set_description(said);
            }
        });
    }
}
