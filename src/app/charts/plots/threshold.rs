//! A threshold as a line: dragged, typed, switched off.

use crate::app::charts::notation::{job, number};
use crate::app::charts::plots::View;
use crate::app::charts::plots::axis::{Axis, rounded};
use crate::app::charts::plots::frame::TEXT;
use crate::app::widgets::finger;
use crate::app::widgets::symbol;
use centrode_core::scenario::Threshold;
use centrode_core::study::course::Measure;
use egui::{
    Align, Color32, CursorIcon, DragValue, FontId, Layout, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, UiBuilder,
};
use egui::{WidgetInfo, pos2, vec2};

/// Half the height in which the line can be grabbed, points; a finger needs more than a mouse.
const GRAB: f32 = 8.0;
const GRAB_TOUCH: f32 = 22.0;
/// Height of the label at the line's end.
const LABEL: f32 = 24.0;
/// Width of the switch in it.
const SWITCH: f32 = 24.0;
/// From one label to the next, where a plot has several thresholds, points.
const BESIDE: f32 = 104.0;

/// One threshold of one plot.
pub struct Line {
    /// How it and its values are shown.
    pub measure: Measure,
    /// What it is now, SI.
    pub threshold: Threshold,
    /// What it is when switched on again, SI.
    pub otherwise: f64,
    /// Colour of what it judges.
    pub color: Color32,
    /// Whether it judges; one that does not is dashed.
    pub judges: bool,
    /// Its place among the thresholds of the plot, whose labels stand side by side.
    pub place: usize,
}

/// What a person did with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// The new threshold, SI.
    pub changed: Option<Threshold>,
    /// Whether it is being moved, so that the plot should stay as it is.
    pub moving: bool,
}

impl View<'_> {
    /// Shows a threshold and takes what is done with it.
    pub fn threshold(&mut self, ui: &mut Ui, line: &Line) -> Outcome {
        let (data, values) = (self.frame.data, self.frame.values);
        let on = line.threshold.value().is_some();
        let scale = line.measure.scale;
        let shown = line.threshold.value().unwrap_or(line.otherwise) * scale;
        let y = values.at(shown).max(data.top());
        let id = ui.scope_id().with(line.measure.threshold);

        let fingers = finger::is_welcome(ui) || ui.input(|input| input.any_touches());
        let reach = if fingers { GRAB_TOUCH } else { GRAB };
        let zone = Rect::from_x_y_ranges(data.x_range(), y - reach..=y + reach).intersect(data.expand(2.0));
        let sense = if on { Sense::DRAG } else { Sense::hover() };
        let response = ui.interact(zone, id, sense);
        if on {
            finger::claim(ui, zone);
        }
        let held = response.dragged();
        if on && (response.hovered() || held) {
            ui.set_cursor_icon(CursorIcon::ResizeVertical);
        }
        let mut outcome = Outcome { changed: None, moving: held };
        if let Some(pos) = response.interact_pointer_pos() {
            if response.drag_started() {
                self.state.grip = y - pos.y;
            }
            if held {
                let to = rounded(values.value(pos.y + self.state.grip), values.per_point());
                if to != shown {
                    outcome.changed = Some(Threshold::On(to / scale));
                }
            }
        }

        let painter = ui.painter_at(data.expand(1.0));
        let color = if on { line.color } else { line.color.gamma_multiply(0.45) };
        let width = if held || (on && response.hovered()) { 2.6 } else { 1.6 };
        let y = painter.round_to_pixel_center(y);
        let ends = [pos2(data.left(), y), pos2(data.right(), y)];
        match (on, line.judges) {
            (true, true) => drop(painter.hline(data.x_range(), y, self.frame.theme.line(width, color))),
            (true, false) => {
                painter.extend(Shape::dashed_line(&ends, self.frame.theme.line(width - 0.5, color), 6.0, 4.0))
            }
            (false, _) => painter.extend(Shape::dashed_line(&ends, self.frame.theme.line(1.0, color), 2.0, 5.0)),
        }
        let half = 0.5 * LABEL;
        let middle = y.clamp(data.top() + half + 1.0, (data.bottom() - half - 5.0).max(data.top() + half + 1.0));
        let left = data.left() + 4.0 + line.place as f32 * BESIDE;
        self.label(ui, pos2(left, middle - half), &values, line, &mut outcome);
        outcome
    }

    /// The label at the line's end: a switch, the symbol, the value to type or drag.
    fn label(&mut self, ui: &mut Ui, at: Pos2, values: &Axis, line: &Line, outcome: &mut Outcome) {
        let theme = self.frame.theme;
        let on = line.threshold.value().is_some();
        let Measure { threshold, scale, unit, decimals, .. } = line.measure;
        let name = threshold.replace('_', "");
        let mut shown = line.threshold.value().unwrap_or(line.otherwise) * scale;
        let ink = if on { theme.ink } else { theme.dim };
        let name_drawn = ui.painter().layout_job(job(threshold, TEXT, ink));
        let widest = format!("{} {unit}", number(shown.max(10.0), decimals));
        let widest = ui.painter().layout_job(job(&widest, TEXT, ink)).size().x;
        let rect = Rect::from_min_size(at, vec2(SWITCH + name_drawn.size().x + widest + 16.0, LABEL));
        let edge = if on { line.color } else { theme.faint };
        ui.painter().rect(rect, 6.0, theme.panel, Stroke::new(1.0, edge), StrokeKind::Inside);
        // Nothing behind the label can be grabbed through it.
        let id = ui.scope_id().with((threshold, "label"));
        ui.interact(finger::around(ui, rect), id, Sense::CLICK | Sense::DRAG);

        let switch = Rect::from_min_size(rect.min, vec2(SWITCH, rect.height()));
        // For a finger it reaches beyond the label.
        let hit = finger::around(ui, switch);
        let hit = hit.translate(vec2(switch.right() - hit.right(), 0.0));
        let response = ui.interact(hit, id.with("switch"), Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
        let switch_name = format!("{name} on plot, on or off");
        response.widget_info(|| WidgetInfo::selected(egui::Role::CheckBox, ui.is_enabled(), on, &switch_name));
        if response.clicked() {
            let back = Threshold::On(line.threshold.value().unwrap_or(line.otherwise));
            outcome.changed = Some(if on { Threshold::OFF } else { back });
        }
        let response =
            response.on_hover_text(if on { "Switch this threshold off" } else { "Switch this threshold on" });
        let center = switch.center();
        let strong = response.hovered() || response.has_focus();
        ui.painter().circle_stroke(center, 5.5, Stroke::new(if strong { 2.2 } else { 1.5 }, line.color));
        if on {
            ui.painter().circle_filled(center, 3.0, line.color);
        }

        let at = pos2(switch.right() - 1.0, rect.center().y - 0.5 * name_drawn.size().y);
        let field = Rect::from_min_max(pos2(at.x + name_drawn.size().x + 2.0, rect.top()), rect.max).shrink(2.0);
        symbol::galley(ui.painter(), at, name_drawn, theme.ink);

        let hit = finger::around(ui, field).with_min_x(field.left()).with_max_x(field.right());
        let builder = UiBuilder::new().max_rect(hit).layout(Layout::right_to_left(Align::Center)).id_salt(id);
        let mut inner = ui.new_child(builder);
        let style = inner.style_mut();
        style.text_styles.insert(style.drag_value_text_style.clone(), FontId::proportional(TEXT));
        let style = &mut style.visuals;
        style.override_text_color = Some(ink);
        for widget in [&mut style.widgets.inactive, &mut style.widgets.hovered, &mut style.widgets.active] {
            widget.expansion = 0.0;
            widget.bg_stroke = Stroke::NONE;
        }
        style.widgets.inactive.weak_bg_fill = Color32::TRANSPARENT;
        inner.spacing_mut().button_padding = vec2(3.0, 1.0);
        inner.spacing_mut().interact_size = vec2(finger::at_least(ui, 40.0), hit.height());
        let before = shown;
        let value = DragValue::new(&mut shown)
            .range(0.0..=f64::MAX)
            .speed(0.5 * values.per_point())
            .max_decimals(decimals + 1)
            .min_decimals(decimals)
            .update_while_editing(false)
            .suffix(if unit.is_empty() { String::new() } else { format!(" {unit}") });
        let response = inner.add(value).accessible_name(format!("{name} on plot"));
        outcome.moving |= response.dragged();
        if shown != before && shown.is_finite() {
            outcome.changed = Some(Threshold::On(shown / scale));
        }
    }
}
