//! What happened when: arming, events, the detection.

use std::sync::Arc;

use crate::app::charts::notation::{job, note, number};
use crate::app::charts::plots::View;
use crate::app::charts::plots::axis::rounded;
use crate::app::charts::plots::frame::{Frame, SMALL, TEXT};
use crate::app::command::Command;
use crate::app::widgets::finger;
use centrode_core::detect::{Event, Method};
use centrode_core::study::course::{Measure, measure};
use egui::{Align2, Color32, CursorIcon, FontId, Galley, Painter, Rect, Sense, Stroke, Ui, pos2, vec2};

/// Half the width in which the arming edge can be grabbed, points.
const GRAB: f32 = 7.0;
/// A mark can be pointed at from this far, points.
const REACH: f32 = 9.0;

impl View<'_> {
    /// Where alarms begin to be raised, points.
    fn armed_at(&self) -> f32 {
        let [start, end] = self.frame.time.range();
        self.frame.time.at(self.run.plan.scenario().detection.armed_from.clamp(start, end))
    }

    /// Lets the edge between unarmed and armed be moved.
    pub fn arming(&mut self, ui: &mut Ui, painter: &Painter) {
        let (data, theme) = (self.frame.data, self.frame.theme);
        let armed_from = self.run.plan.scenario().detection.armed_from;
        let x = self.armed_at();
        let zone = Rect::from_x_y_ranges(x - GRAB..=x + GRAB, data.y_range()).intersect(data.expand(GRAB));
        let id = ui.scope_id().with(("armed", self.which));
        finger::claim(ui, zone);
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
        painter.vline(x, data.y_range(), theme.line(if strong { 2.0 } else { 1.0 }, color));
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

    /// When the detection is, in words beside its line; where the plot says when arming is, not over that.
    pub fn detection_label(&self, painter: &Painter, says: bool) {
        let Some(detection) = &self.run.detection() else { return };
        let (data, theme) = (self.frame.data, &self.frame.theme);
        let x = self.frame.time.at(detection.time);
        let text = format!("detected {}", Frame::clock(detection.time));
        let galley = painter.layout_no_wrap(text, FontId::proportional(SMALL + 0.5), theme.alarm);
        let right = x + 6.0 + galley.size().x <= data.right() + 4.0;
        let at = if right { x + 6.0 } else { x - 8.0 - galley.size().x };
        let armed = self.armed_label(painter, theme.dim).1.expand2(vec2(3.0, 1.0));
        let rect = Rect::from_min_size(pos2(at, data.top() + 11.0), galley.size());
        let rect = if says { above(rect, armed) } else { rect };
        painter.rect_filled(rect.expand2(vec2(3.0, 1.0)), 3.0, theme.panel.gamma_multiply(0.9));
        painter.galley(rect.min, galley, theme.alarm);
    }

    /// Says which event of a detector is under the pointer, and whether any is.
    pub fn event(&self, ui: &Ui, painter: &Painter, method: Method) -> bool {
        let theme = &self.frame.theme;
        let Some(pointer) = ui.input(|input| input.pointer.hover_pos()).filter(|pos| self.frame.data.contains(*pos))
        else {
            return false;
        };
        let own = self.run.judged.events.iter().filter(|event| event.detector == method);
        let marks = own.flat_map(|event| {
            let places = [Some(event.raised), event.cleared];
            places.into_iter().flatten().map(move |time| (event, self.place.at([time, event.threshold])))
        });
        let near = marks.map(|(event, at)| (pointer.distance(at), event, at)).filter(|(away, ..)| *away < REACH);
        let Some((_, event, at)) = near.min_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
        let lines = told(event).into_iter().enumerate();
        let lines = lines.map(|(k, line)| job(&line, TEXT - 1.0, if k == 0 { theme.ink } else { theme.dim }));
        note(painter, theme, at, self.frame.data, lines.collect());
        true
    }
}

/// An event in words: which detector raised it when, over which threshold, and when it was cleared.
fn told(event: &Event) -> [String; 3] {
    let Measure { detector, symbol, threshold, scale, unit, decimals, .. } = measure(event.detector);
    let shown = |value: f64| format!("{} {unit}", number(value * scale, decimals)).trim_end().to_owned();
    let cleared =
        event.cleared.map_or("not cleared by the end".into(), |at| format!("cleared at {}", Frame::clock(at)));
    [
        format!("{detector}: alarm raised at {}", Frame::clock(event.raised)),
        format!("{symbol} {} exceeds {threshold} {}", shown(event.value), shown(event.threshold)),
        cleared,
    ]
}

/// A label where it is wanted, or above another that it would cover: below, a threshold may be in the way.
fn above(label: Rect, other: Rect) -> Rect {
    if label.expand2(vec2(3.0, 1.0)).intersects(other) {
        label.translate(vec2(0.0, other.top() - 1.0 - label.bottom()))
    } else {
        label
    }
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
    fn an_event_says_who_raised_it_when_and_when_it_was_cleared() {
        let run = preset::find("bench").and_then(preset::Preset::scenario).map(|s| simulate(&s)).expect("preset");
        let run = run.expect("run");
        let said: Vec<String> = run.judged.events.iter().map(|event| told(event).join("; ")).collect();
        let first = run.detection().expect("detected").time;
        let alarm = format!("Centrode: alarm raised at {first:.3} s; ‖c_m − c_s‖ ");
        assert!(
            said.iter().any(|said| said.starts_with(&alarm) && said.contains(" mm exceeds ξ_2 7.00 mm; ")),
            "{said:?}"
        );
        assert!(said.iter().any(|said| said.starts_with("Joint forces: ") && said.ends_with("not cleared by the end")));
    }
}
