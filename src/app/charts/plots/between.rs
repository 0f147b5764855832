//! The times A and B: a band in each plot, how much its value changes between them, and Shift and drag, which sets both.

use crate::app::charts::notation::{job, note};
use crate::app::charts::plots::View;
use crate::app::charts::plots::frame::{Frame, SMALL};
use crate::app::command::{Command, Mark};
use centrode_core::study::course::between::between;
use egui::{Align2, FontId, Painter, Response, Stroke, Ui, pos2};

/// A shorter drag is a click, which takes both marks away, points.
const CLICK: f32 = 3.0;

impl View<'_> {
    /// Sets A and B while Shift is held; returns whether the pointer does that now.
    pub fn measure(&mut self, ui: &Ui, response: &Response) -> bool {
        let (shift, down) = ui.input(|input| (input.modifiers.shift, input.pointer.primary_down()));
        let at = response.interact_pointer_pos().map(|pos| (pos.x, self.frame.time.value(pos.x)));
        let pressed = response.is_pointer_button_down_on() && shift && self.state.measured.is_none();
        if pressed && let Some((x, _)) = at {
            self.state.measured = Some((self.which, x));
        }
        let Some((_, from)) = self.state.measured.filter(|(which, _)| *which == self.which) else { return false };
        match at.filter(|(x, _)| (x - from).abs() > CLICK) {
            Some((_, time)) => {
                self.out.push(Command::Mark(Mark::A, Some(self.frame.time.value(from))));
                self.out.push(Command::Mark(Mark::B, Some(time)));
            }
            None if response.clicked() => {
                [Mark::A, Mark::B].into_iter().for_each(|mark| self.out.push(Command::Mark(mark, None)));
            }
            None => {}
        }
        if !down {
            self.state.measured = None;
        }
        true
    }

    /// Where a mark stands, points.
    fn mark_at(&self, painter: &Painter, time: f64) -> f32 {
        let [start, end] = self.frame.time.range();
        painter.round_to_pixel_center(self.frame.time.at(time.clamp(start, end)))
    }

    /// Paints both marks, and a band between them.
    pub fn between(&self, painter: &Painter) {
        let Frame { data, theme, .. } = &self.frame;
        let (marks, place) = (self.marks, |time| self.mark_at(painter, time));
        if let [Some(a), Some(b)] = marks {
            let band = data.with_min_x(place(a.min(b))).with_max_x(place(a.max(b)));
            painter.rect_filled(band, 0.0, theme.accent.gamma_multiply(0.10));
        }
        for (at, name) in marks.into_iter().zip(["A", "B"]) {
            let Some(at) = at else { continue };
            let x = place(at);
            painter.vline(x, data.y_range(), Stroke::new(1.2, theme.accent));
            let left = x + 12.0 > data.right();
            let (align, dx) = if left { (Align2::RIGHT_BOTTOM, -3.0) } else { (Align2::LEFT_BOTTOM, 3.0) };
            let font = FontId::proportional(SMALL + 1.0);
            painter.text(pos2(x + dx, data.bottom() - 8.0), align, name, font, theme.accent);
        }
    }

    /// Says by how much the plot's value, which has this symbol, changes between both marks.
    pub fn change(&self, painter: &Painter, symbol: &str) {
        let (data, theme) = (self.frame.data, &self.frame.theme);
        let [Some(a), Some(b)] = self.marks else { return };
        let readings = between(self.run, [a, b]);
        let Some(reading) = readings.iter().find(|reading| reading.symbol == symbol) else { return };
        let mut lines = vec![job(&format!("Δ {}", reading.told()), SMALL + 1.0, theme.ink)];
        if self.which == 0 {
            let [a, b] = [a, b].map(|at| self.run.sample_at(at).time);
            lines.insert(0, job(&format!("Δt {:.3} s", b - a), SMALL + 1.0, theme.ink));
        }
        note(painter, theme, pos2(self.mark_at(painter, a.max(b)), data.bottom() - 22.0), data, lines);
    }
}
