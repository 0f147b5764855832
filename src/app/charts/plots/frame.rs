//! What lies over every plot: a title with read-outs, the playback position, and the values under the pointer.

use crate::app::charts::notation::{job, note};
use crate::app::charts::paint::{Place, dashed};
use crate::app::charts::plots::axis::Axis;
use crate::app::charts::plots::{Touch, View};
use crate::app::command::Command;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::symbol;
use centrode_core::chart::Style;
use centrode_core::run::Sample;
use egui::text::LayoutJob;
use egui::{Color32, CursorIcon, Painter, PointerButton, Pos2, Rect, Sense, Shape, Stroke, Ui};
use egui::{pos2, vec2};

/// Size of titles and read-outs.
pub const TEXT: f32 = 12.5;
/// Size of tick labels.
pub const SMALL: f32 = 10.5;
const TITLE: f32 = 22.0;
/// Room at the left of the data.
pub const GUTTER: f32 = 38.0;
/// Room at the right of the data.
pub const RIGHT: f32 = 8.0;

/// Where a plot is, and its axes.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// All of it.
    pub outer: Rect,
    /// Where the data is.
    pub data: Rect,
    /// Time, s.
    pub time: Axis,
    /// Values as they are shown.
    pub values: Axis,
    /// The colours.
    pub theme: Theme,
    /// Room that a button takes at the right of the title, points.
    pub tool: f32,
}

/// A value at the playback position, and the line it belongs to.
pub struct ReadOut {
    /// Short name, as [`job`] writes it; empty when the title says it.
    pub name: &'static str,
    /// The value as text.
    pub value: String,
    /// The line's colour.
    pub color: Color32,
    /// The line's style.
    pub style: Style,
}

impl Frame {
    /// The place of the chart in that of the plot.
    pub fn below_title(outer: Rect) -> Rect {
        outer.with_min_y(outer.top() + TITLE)
    }

    /// The frame of a chart that was laid out; its values are multiplied by `scale` to be shown.
    pub fn new(outer: Rect, place: &Place, scale: f64, theme: Theme) -> Self {
        let data = place.data();
        let [time, values] = place.ranges();
        let time = Axis::new(time, [data.left(), data.right()]);
        let values = Axis::new(values.map(|end| end * scale), [data.bottom(), data.top()]);
        Self { outer, data, time, values, theme, tool: 0.0 }
    }

    /// Title on the left, read-outs on the right; what does not fit gives way, least important first.
    pub fn title(&self, painter: &Painter, long: &str, short: &str, readouts: &[ReadOut]) {
        let galley = |text: &str, color| painter.layout_job(job(text, TEXT, color));
        let swatch = if readouts.len() > 1 { 20.0 } else { 0.0 };
        let parts: Vec<_> = readouts
            .iter()
            .map(|readout| {
                let name = galley(readout.name, self.theme.dim);
                let value = galley(&readout.value, self.theme.ink);
                // Room for four digits: a value that changes does not push its neighbours about.
                let width = value.size().x.max(30.0);
                (readout, swatch + name.size().x + 5.0 + width, name, value)
            })
            .collect();
        let room = self.outer.width() - 4.0 - self.tool;
        let gap = 14.0;
        let needed = |count: usize| parts.iter().take(count).map(|part| part.1 + gap).sum::<f32>();
        let long = galley(long, self.theme.ink);
        let (title, count) = if long.size().x + needed(parts.len()) <= room {
            (long, parts.len())
        } else {
            let short = galley(short, self.theme.ink);
            let fits = |count: &usize| short.size().x + needed(*count) <= room;
            let count = (0..=parts.len()).rev().find(fits).unwrap_or(0);
            (short, count)
        };
        let top = self.outer.top();
        symbol::galley(painter, pos2(self.outer.left() + 2.0, top + 1.0), title, self.theme.ink);
        let mut right = self.outer.right() - RIGHT - self.tool;
        for (readout, width, name, value) in parts.into_iter().take(count).rev() {
            let left = right - width;
            painter.galley(pos2(right - value.size().x, top + 1.0), value, self.theme.ink);
            if swatch > 0.0 {
                let y = top + 9.0;
                stroke_line(
                    painter,
                    vec![pos2(left, y), pos2(left + 14.0, y)],
                    (readout.color, self.theme.weight),
                    readout.style,
                );
            }
            symbol::galley(painter, pos2(left + swatch, top + 1.0), name, self.theme.dim);
            right = left - gap;
        }
    }

    /// Text for a time.
    pub fn clock(time: f64) -> String {
        format!("{time:.3} s")
    }
}

/// Draws a line in a style.
fn stroke_line(painter: &Painter, line: Vec<Pos2>, (color, weight): (Color32, f32), style: Style) {
    match style {
        style if style.dash().is_some() => {
            let dash = style.dash().unwrap_or_default().map(|length| 8.0 * length as f32);
            painter.extend(dashed(&line, Stroke::new(weight, color), dash));
        }
        Style::Thin => drop(painter.line(line, Stroke::new(1.1 * weight, color))),
        _ => drop(painter.line(line, Stroke::new(1.6 * weight, color))),
    }
}

/// What a pointer over a plot asks for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pointed {
    /// The time under it, s.
    pub hover: Option<f64>,
    /// Where playback is to stand, s.
    pub seek: Option<f64>,
}

impl Frame {
    /// Senses a pointer that may scrub, as `response` of the data's place says; a finger that moves up or down scrolls instead.
    pub fn point(&self, ui: &Ui, response: &egui::Response, touch: &mut Touch) -> Pointed {
        let time = |pos: Pos2| self.time.value(pos.x);
        let mut pointed = Pointed::default();
        if let Some(pos) = response.hover_pos().filter(|_| !response.dragged()) {
            pointed.hover = Some(time(pos));
            ui.set_cursor_icon(CursorIcon::Crosshair);
        }
        let touching = ui.input(|input| input.any_touches());
        if response.drag_started() {
            *touch = if touching { Touch::Undecided } else { Touch::Scrubs };
        }
        if touching && response.dragged() && *touch == Touch::Undecided {
            let moved = response.total_drag_delta().unwrap_or_default();
            if moved.length() > 4.0 {
                *touch = if moved.y.abs() > moved.x.abs() { Touch::Scrolls } else { Touch::Scrubs };
            }
        }
        if response.dragged() && *touch == Touch::Scrolls {
            ui.scroll_with_delta(vec2(0.0, response.drag_delta().y));
            finger::pass(ui);
            return pointed;
        }
        let pressed = !touching && response.is_pointer_button_down_on();
        let scrubbed = response.dragged_by(PointerButton::Primary) && *touch == Touch::Scrubs;
        if pressed || scrubbed || response.clicked() {
            pointed.seek = response.interact_pointer_pos().map(time);
        }
        pointed
    }

    /// The place in which a pointer scrubs, with a name.
    pub fn sense(&self, ui: &Ui, which: usize, label: &str) -> egui::Response {
        let response = ui.interact(self.data, ui.scope_id().with(("plot", which)), Sense::CLICK | Sense::DRAG);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Figure, ui.is_enabled(), label));
        response
    }

    /// The playback position (s), with a dot on each line that has a value there.
    pub fn cursor(&self, painter: &Painter, cursor: f64, dots: &[(f64, Color32)]) {
        let Self { data, theme, values, .. } = self;
        let x = painter.round_to_pixel_center(self.time.at(cursor));
        painter.vline(x, data.top()..=data.bottom() + 3.0, theme.line(1.5, theme.ink));
        let cap = [pos2(x - 4.5, data.top() - 5.0), pos2(x + 4.5, data.top() - 5.0), pos2(x, data.top() + 1.0)];
        painter.add(Shape::convex_polygon(cap.to_vec(), theme.ink, Stroke::NONE));
        for &(value, color) in dots {
            if value.is_finite() && values.holds(value) {
                let at = pos2(x, values.at(value));
                painter.circle(at, 3.5, color, Stroke::new(1.5, theme.panel));
            }
        }
    }

    /// A thin line at a time (s) under the pointer, with what there is to say of it.
    pub fn hover(&self, painter: &Painter, time: f64, lines: impl IntoIterator<Item = LayoutJob>) {
        let (data, theme) = (self.data, &self.theme);
        let x = painter.round_to_pixel_center(self.time.at(time));
        painter.vline(x, data.y_range(), theme.line(1.0, theme.dim.gamma_multiply(0.8)));
        let mut text = vec![job(&Self::clock(time), SMALL + 1.0, theme.dim)];
        text.extend(lines);
        note(painter, theme, pos2(x, data.top() + 4.0), data, text);
    }
}

impl View<'_> {
    /// Lets the pointer scrub; call before what lies on top.
    pub fn scrub(&mut self, ui: &mut Ui, label: &str) {
        let response = self.frame.sense(ui, self.which, label);
        if self.measure(ui, &response) {
            return;
        }
        let Pointed { hover, seek } = self.frame.point(ui, &response, &mut self.state.touch);
        self.state.hover = hover.or(self.state.hover);
        self.out.extend(seek.filter(|to| *to != self.cursor).map(Command::Seek));
    }

    /// The playback position, with a dot on each line that has a value there.
    pub fn cursor(&self, painter: &Painter, dots: &[(f64, Color32)]) {
        self.frame.cursor(painter, self.cursor, dots);
    }

    /// A thin line at the time under the pointer, in every plot, with this plot's values there.
    pub fn hover(&self, painter: &Painter, lines: impl Fn(&Sample) -> Vec<LayoutJob>) {
        let Some(time) = self.hovered.filter(|_| self.run.len() > 1) else { return };
        let sample = self.run.sample_at(time);
        self.frame.hover(painter, sample.time, lines(&sample));
    }
}
