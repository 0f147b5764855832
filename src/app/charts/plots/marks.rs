//! What happened when: arming, contact, crossings, the detection.

use std::sync::Arc;

use crate::app::charts::notation::{job, note, number};
use crate::app::charts::plots::View;
use crate::app::charts::plots::axis::{Axis, rounded};
use crate::app::charts::plots::frame::{Frame, SMALL, TEXT};
use crate::app::command::Command;
use centrode_core::detect::{Crossing, Method};
use centrode_core::run::Run;
use egui::{Align2, Color32, CursorIcon, FontId, Galley, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

/// Half the width in which the arming edge can be grabbed, points.
const GRAB: f32 = 7.0;
/// Marks nearer than this are one.
const CROWDED: f32 = 8.0;

/// How a plot shows and names the values it judges.
#[derive(Debug, Clone, Copy)]
pub struct Judged {
    /// The method.
    pub method: Method,
    /// Its abbreviation.
    pub name: &'static str,
    /// Shown value per SI value.
    pub scale: f64,
    /// Unit shown.
    pub unit: &'static str,
    /// Decimals shown.
    pub decimals: usize,
}

impl View<'_> {
    /// Where alarms begin to be raised, points.
    fn armed_at(&self) -> f32 {
        let [start, end] = self.frame.time.range();
        self.frame.time.at(self.run.plan.scenario().detection.armed_from.clamp(start, end))
    }

    /// Shades the time before arming.
    pub fn unarmed(&self, painter: &Painter) {
        let (data, theme) = (self.frame.data, self.frame.theme);
        let shade = Rect::from_min_max(data.min, pos2(self.armed_at(), data.bottom()));
        painter.rect_filled(shade, 0.0, theme.dim.gamma_multiply(if theme.dark { 0.12 } else { 0.11 }));
    }

    /// Lets the edge between unarmed and armed be moved.
    pub fn arming(&mut self, ui: &mut Ui, painter: &Painter) {
        let (data, theme) = (self.frame.data, self.frame.theme);
        let armed_from = self.run.plan.scenario().detection.armed_from;
        let x = self.armed_at();
        let zone = Rect::from_x_y_ranges(x - GRAB..=x + GRAB, data.y_range()).intersect(data.expand(GRAB));
        let id = ui.scope_id().with(("armed", self.which));
        let response = ui.interact(zone, id, Sense::DRAG).on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
        let strong = response.hovered() || response.dragged();
        if let Some(pos) = response.interact_pointer_pos() {
            if response.drag_started() {
                self.state.grip = x - pos.x;
            }
            if response.dragged() {
                let axis = &self.frame.time;
                let to = rounded(axis.value(pos.x + self.state.grip), axis.per_point());
                if to != armed_from {
                    self.out.push(Command::SetArmedFrom(to));
                }
            }
        }
        let color = if strong { theme.ink } else { theme.dim };
        let x = painter.round_to_pixel_center(x);
        painter.vline(x, data.y_range(), Stroke::new(if strong { 2.0 } else { 1.0 }, color));
        // A grip of two short lines says that it can be moved.
        let y = data.top() + 22.0;
        let grip = Rect::from_center_size(pos2(x, y), vec2(7.0, 14.0));
        painter.rect(grip, 2.0, theme.panel, Stroke::new(1.0, color), egui::StrokeKind::Inside);
        for dx in [-1.0, 1.0] {
            painter.vline(x + dx, y - 3.5..=y + 3.5, Stroke::new(1.0, color));
        }
        if self.which == 0 || strong {
            let (galley, rect) = self.armed_label(painter, color);
            painter.rect_filled(rect.expand(2.0), 3.0, theme.panel.gamma_multiply(0.85));
            painter.galley(rect.min, galley, color);
        }
    }

    /// When arming is, in words beside its edge, and where they stand.
    fn armed_label(&self, painter: &Painter, color: Color32) -> (Arc<Galley>, Rect) {
        let (data, x) = (self.frame.data, self.armed_at());
        let text = format!("armed from {} s", number(self.run.plan.scenario().detection.armed_from, 2));
        let galley = painter.layout_no_wrap(text, FontId::proportional(SMALL), color);
        let left = x - 8.0 - galley.size().x;
        let at = if left > data.left() + 2.0 { left } else { x + 8.0 };
        let rect = Rect::from_min_size(pos2(at, data.top() + 22.0 - 0.5 * galley.size().y), galley.size());
        (galley, rect)
    }

    /// The truth: a band along the axis while the beam holds the backbone.
    pub fn contact(&self, painter: &Painter, height: f32) {
        let (data, theme) = (self.frame.data, &self.frame.theme);
        for (from, to) in contacts(self.run) {
            let (left, right) = (self.frame.time.at(from), self.frame.time.at(to));
            let band = Rect::from_min_max(pos2(left, data.bottom() - 4.0), pos2(right, data.bottom()));
            painter.rect_filled(band, 0.0, theme.obstacle);
            if height > 4.0 {
                let veil = Rect::from_min_max(pos2(left, data.bottom() - height), pos2(right, data.bottom() - 4.0));
                painter.rect_filled(veil, 0.0, theme.obstacle.gamma_multiply(0.16));
            }
        }
    }

    /// The detection, as a dashed line.
    pub fn detection(&self, painter: &Painter) {
        let Some(detection) = &self.run.detection() else { return };
        let (data, theme) = (self.frame.data, &self.frame.theme);
        let x = painter.round_to_pixel_center(self.frame.time.at(detection.time));
        let line = [pos2(x, data.top()), pos2(x, data.bottom())];
        painter.extend(Shape::dashed_line(&line, Stroke::new(1.4, theme.detection), 5.0, 3.5));
    }

    /// When the detection is, in words beside its line.
    pub fn detection_label(&self, painter: &Painter) {
        let Some(detection) = &self.run.detection() else { return };
        let (data, theme) = (self.frame.data, &self.frame.theme);
        let x = self.frame.time.at(detection.time);
        let text = format!("detected {}", Frame::clock(detection.time));
        let galley = painter.layout_no_wrap(text, FontId::proportional(SMALL + 0.5), theme.detection);
        let right = x + 6.0 + galley.size().x <= data.right() + 4.0;
        let at = if right { x + 6.0 } else { x - 8.0 - galley.size().x };
        let armed = self.armed_label(painter, theme.dim).1.expand2(vec2(3.0, 1.0));
        let rect = above(Rect::from_min_size(pos2(at, data.top() + 11.0), galley.size()), armed);
        painter.rect_filled(rect.expand2(vec2(3.0, 1.0)), 3.0, theme.panel.gamma_multiply(0.9));
        painter.galley(rect.min, galley, theme.detection);
    }

    /// The crossings of a method; the one that the detection is made of stands out. Says what is under the pointer,
    /// and whether anything was.
    pub fn crossings(&self, ui: &Ui, painter: &Painter, values: &Axis, judged: Judged, color: Color32) -> bool {
        let theme = &self.frame.theme;
        let pointer = ui.input(|input| input.pointer.hover_pos()).filter(|pos| self.frame.data.contains(*pos));
        let mut near: Option<(f32, &Crossing, Pos2)> = None;
        let mut last = f32::NEG_INFINITY;
        for crossing in self.run.crossings().iter().filter(|crossing| crossing.method == judged.method) {
            let at = pos2(self.frame.time.at(crossing.time), values.at(crossing.threshold * judged.scale));
            let first = crossing.method == Method::Fcd
                && self.run.detection().is_some_and(|detection| detection.time == crossing.time);
            if at.x - last < CROWDED && !first {
                continue;
            }
            last = at.x;
            mark(painter, at, judged.method, first, if first { theme.detection } else { color }, theme.panel);
            let away = pointer.map_or(f32::INFINITY, |pos| pos.distance(at));
            if away < 9.0 && near.is_none_or(|(nearest, ..)| away < nearest) {
                near = Some((away, crossing, at));
            }
        }
        let Some((_, crossing, at)) = near else { return false };
        let value = number(crossing.value * judged.scale, judged.decimals);
        let lines = vec![
            job(&format!("{} crosses its threshold", judged.name), TEXT - 1.0, theme.ink),
            job(&format!("{}, {value} {}", Frame::clock(crossing.time), judged.unit), TEXT - 1.0, theme.dim),
        ];
        note(painter, theme, at, self.frame.data, lines);
        true
    }
}

/// A diamond for a detection, a ring for another crossing by FCD, a square for JFD.
fn mark(painter: &Painter, at: Pos2, method: Method, first: bool, color: Color32, halo: Color32) {
    let edge = Stroke::new(1.5, halo);
    if first {
        let points = [vec2(0.0, -6.0), vec2(6.0, 0.0), vec2(0.0, 6.0), vec2(-6.0, 0.0)].map(|d| at + d);
        painter.add(Shape::convex_polygon(points.to_vec(), color, edge));
    } else if method == Method::Fcd {
        painter.circle(at, 2.8, halo, Stroke::new(1.4, color));
    } else {
        let square = Rect::from_center_size(at, vec2(8.0, 8.0));
        painter.rect(square, 1.0, color, edge, egui::StrokeKind::Middle);
    }
}

/// A label where it is wanted, or above another that it would cover: below, a threshold may be in the way.
fn above(label: Rect, other: Rect) -> Rect {
    if label.expand2(vec2(3.0, 1.0)).intersects(other) {
        label.translate(vec2(0.0, other.top() - 1.0 - label.bottom()))
    } else {
        label
    }
}

/// Times during which the beam holds the backbone, s.
#[must_use]
pub fn contacts(run: &Run) -> Vec<(f64, f64)> {
    let mut spans: Vec<(f64, f64)> = Vec::new();
    let mut held = false;
    for sample in run.samples() {
        match spans.last_mut() {
            Some(span) if sample.in_contact && held => span.1 = sample.time,
            _ if sample.in_contact => spans.push((sample.time, sample.time)),
            _ => {}
        }
        held = sample.in_contact;
    }
    spans
}

/// Explains an empty plot.
pub fn empty(painter: &Painter, frame: &Frame, text: &str) {
    painter.text(frame.data.center(), Align2::CENTER_CENTER, text, FontId::proportional(TEXT), frame.theme.dim);
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset;

    fn run(name: &str) -> Run {
        simulate(&preset::find(name).and_then(preset::Preset::scenario).expect("preset")).expect("run")
    }

    #[test]
    fn labels_do_not_cover_each_other() {
        let other = Rect::from_min_size(pos2(100.0, 15.0), vec2(90.0, 14.0));
        for left in [0.0, 50.0, 150.0, 188.0, 240.0] {
            let label = Rect::from_min_size(pos2(left, 11.0), vec2(80.0, 13.0));
            let placed = above(label, other);
            assert!(!placed.intersects(other), "{placed}");
            assert_eq!(placed == label, !(15.0..=195.0).contains(&left), "{left}");
        }
    }

    #[test]
    fn contact_is_one_span_that_starts_at_the_truth() {
        let run = run("paper");
        let spans = contacts(&run);
        assert_eq!(spans.len(), 1);
        assert_eq!(Some(spans[0].0), run.contact_time());
        assert_eq!(spans[0].1, 10.0);
    }

    #[test]
    fn contact_that_opens_again_ends() {
        let spans = contacts(&run("letting-go"));
        assert_eq!(spans.len(), 1);
        assert!(spans[0].0 == 0.0 && spans[0].1 < 8.0);
        assert!(contacts(&run("free")).is_empty());
    }
}
