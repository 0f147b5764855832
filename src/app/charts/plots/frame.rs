//! What every plot has: a title with read-outs, a grid, the time axis, and what happened when.

use crate::app::charts::notation::{job, note};
use crate::app::charts::plots::axis::{Axis, Steps};
use crate::app::charts::plots::{Touch, View, end};
use crate::app::command::Command;
use crate::app::theme::Theme;
use centrode_core::chart::decimate::{Column, columns, spans};
use centrode_core::run::{Run, Sample};
use egui::text::LayoutJob;
use egui::{Align2, Color32, CursorIcon, FontId, Painter, PointerButton, Pos2, Rect, Sense, Shape, Stroke, Ui};
use egui::{pos2, vec2};

/// Size of titles and read-outs.
pub const TEXT: f32 = 12.5;
/// Size of tick labels.
pub const SMALL: f32 = 10.5;
const TITLE: f32 = 22.0;
const GUTTER: f32 = 38.0;
const RIGHT: f32 = 8.0;
const TIME_LABELS: f32 = 18.0;

/// Where a plot is, and its axes.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// All of it.
    pub outer: Rect,
    /// Where the data is.
    pub data: Rect,
    /// Time, s.
    pub time: Axis,
    /// The colours.
    pub theme: Theme,
    labelled: bool,
    pixel: f32,
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

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// The quantity itself.
    Strong,
    /// What it is compared with.
    Thin,
    /// An alternative.
    Dashed,
}

impl Frame {
    /// Divides `outer`; `labelled` leaves room for the time axis.
    pub fn new(outer: Rect, run: &Run, labelled: bool, theme: Theme, pixels_per_point: f32) -> Self {
        let bottom = outer.bottom() - if labelled { TIME_LABELS } else { 5.0 };
        let data =
            Rect::from_min_max(pos2(outer.left() + GUTTER, outer.top() + TITLE), pos2(outer.right() - RIGHT, bottom));
        let time = Axis::new([0.0, end(run)], [data.left(), data.right()]);
        Self { outer, data, time, theme, labelled, pixel: 1.0 / pixels_per_point }
    }

    /// An axis of values over the plot's height.
    pub fn values(&self, range: [f64; 2]) -> Axis {
        Axis::new(range, [self.data.bottom(), self.data.top()])
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
        let room = self.outer.width() - 4.0;
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
        painter.galley(pos2(self.outer.left() + 2.0, top + 1.0), title, self.theme.ink);
        let mut right = self.outer.right() - RIGHT;
        for (readout, width, name, value) in parts.into_iter().take(count).rev() {
            let left = right - width;
            painter.galley(pos2(right - value.size().x, top + 1.0), value, self.theme.ink);
            if swatch > 0.0 {
                let y = top + 9.0;
                stroke_line(painter, vec![pos2(left, y), pos2(left + 14.0, y)], readout.color, readout.style);
            }
            painter.galley(pos2(left + swatch, top + 1.0), name, self.theme.dim);
            right = left - gap;
        }
    }

    /// Few lines, small numbers.
    pub fn grid(&self, painter: &Painter, values: &Axis, steps: Steps) {
        let (data, theme) = (self.data, &self.theme);
        painter.rect_filled(data, 2.0, theme.panel);
        let font = FontId::proportional(SMALL);
        for tick in values.ticks(30.0, steps) {
            let y = painter.round_to_pixel_center(values.at(tick.value));
            painter.hline(data.x_range(), y, Stroke::new(1.0, theme.faint));
            painter.text(pos2(data.left() - 5.0, y), Align2::RIGHT_CENTER, tick.text, font.clone(), theme.dim);
        }
        let ticks = self.time.ticks(46.0, Steps::Decimal);
        let last = ticks.last().map_or(0.0, |tick| tick.value);
        for tick in ticks {
            let x = painter.round_to_pixel_center(self.time.at(tick.value));
            painter.vline(x, data.y_range(), Stroke::new(1.0, theme.faint.gamma_multiply(0.6)));
            if self.labelled {
                painter.vline(x, data.bottom()..=data.bottom() + 3.0, Stroke::new(1.0, theme.dim));
                let text = if tick.value == last { format!("{} s", tick.text) } else { tick.text };
                let align = if x > data.right() - 12.0 { Align2::RIGHT_TOP } else { Align2::CENTER_TOP };
                let x = if align == Align2::RIGHT_TOP { data.right() + 4.0 } else { x };
                painter.text(pos2(x, data.bottom() + 4.0), align, text, font.clone(), theme.dim);
            }
        }
        painter.hline(data.x_range(), painter.round_to_pixel_center(data.bottom()), Stroke::new(1.0, theme.dim));
    }

    /// Draws a channel; gives its columns.
    pub fn curve(
        &self,
        painter: &Painter,
        run: &Run,
        values: &Axis,
        value: impl Fn(&Sample) -> f64,
        color: Color32,
        style: Style,
    ) -> Vec<Vec<Column>> {
        let samples = run.samples().map(|sample| (sample.time, value(&sample)));
        let stretches = columns(samples, self.time.scale(), self.pixel.into());
        let painter = painter.with_clip_rect(self.data.intersect(painter.clip_rect()));
        for stretch in &stretches {
            let line: Vec<Pos2> = stretch
                .iter()
                .flat_map(|column| {
                    // Less than a pixel of spread is one point: fewer to draw, and smoother.
                    let (low, high) = (values.at(column.low), values.at(column.high));
                    let x = column.x as f32;
                    let flat = (low - high).abs() < self.pixel;
                    let middle = pos2(x, 0.5 * (low + high));
                    let ends = column.values().map(move |value| pos2(x, values.at(value)));
                    std::iter::once(middle).filter(move |_| flat).chain(ends.filter(move |_| !flat))
                })
                .collect();
            if let [point] = line[..] {
                painter.circle_filled(point, 1.2, color);
            } else {
                stroke_line(&painter, line, color, style);
            }
        }
        stretches
    }

    /// Says along the top edge where a curve leaves the plot.
    pub fn off_scale(&self, painter: &Painter, values: &Axis, stretches: &[Vec<Column>], color: Color32) {
        let top = values.range()[1];
        let y = self.data.top();
        for (from, to) in spans(stretches, |column| column.high > top) {
            let (from, to) = (from as f32, to as f32);
            let bar = Rect::from_min_max(pos2(from - 0.5, y), pos2(to + 0.5, y + 3.0)).intersect(self.data);
            painter.rect_filled(bar, 0.0, color.gamma_multiply(0.45));
            if to - from > 8.0 {
                let x = 0.5 * (from + to);
                let arrow = vec![pos2(x - 4.0, y + 9.0), pos2(x, y + 4.0), pos2(x + 4.0, y + 9.0)];
                painter.add(Shape::convex_polygon(arrow, color, Stroke::NONE));
            }
        }
    }

    /// Text for a time.
    pub fn clock(time: f64) -> String {
        format!("{time:.3} s")
    }
}

/// Draws a line in a style.
pub fn stroke_line(painter: &Painter, line: Vec<Pos2>, color: Color32, style: Style) {
    match style {
        Style::Strong => {
            painter.line(line, Stroke::new(1.6, color));
        }
        Style::Thin => {
            painter.line(line, Stroke::new(1.1, color));
        }
        Style::Dashed => painter.extend(Shape::dashed_line(&line, Stroke::new(1.0, color), 4.0, 3.0)),
    }
}

impl View<'_> {
    /// Lets the pointer scrub; call before what lies on top.
    pub fn scrub(&mut self, ui: &mut Ui, label: &str) {
        let sense = Sense::CLICK | Sense::DRAG;
        let response = ui.interact(self.frame.data, ui.scope_id().with(("plot", self.which)), sense);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Figure, ui.is_enabled(), label));
        let time = |pos: Pos2| self.frame.time.value(pos.x);
        if let Some(pos) = response.hover_pos().filter(|_| !response.dragged()) {
            self.state.hover = Some(time(pos));
            ui.set_cursor_icon(CursorIcon::Crosshair);
        }
        let touching = ui.input(|input| input.any_touches());
        if response.drag_started() {
            self.state.touch = if touching { Touch::Undecided } else { Touch::Scrubs };
        }
        if touching && response.dragged() && self.state.touch == Touch::Undecided {
            let moved = response.total_drag_delta().unwrap_or_default();
            if moved.length() > 4.0 {
                self.state.touch = if moved.y.abs() > moved.x.abs() { Touch::Scrolls } else { Touch::Scrubs };
            }
        }
        if response.dragged() && self.state.touch == Touch::Scrolls {
            ui.scroll_with_delta(vec2(0.0, response.drag_delta().y));
            return;
        }
        let pressed = !touching && response.is_pointer_button_down_on();
        let scrubbed = response.dragged_by(PointerButton::Primary) && self.state.touch == Touch::Scrubs;
        if (pressed || scrubbed || response.clicked())
            && let Some(pos) = response.interact_pointer_pos()
        {
            let to = time(pos);
            if to != self.cursor {
                self.out.push(Command::Seek(to));
            }
        }
    }

    /// The playback position, with a dot on each line that has a value there.
    pub fn cursor(&self, painter: &Painter, values: &Axis, dots: &[(f64, Color32)]) {
        let (data, theme) = (self.frame.data, &self.frame.theme);
        let x = painter.round_to_pixel_center(self.frame.time.at(self.cursor));
        painter.vline(x, data.top()..=data.bottom() + 3.0, Stroke::new(1.5, theme.ink));
        let cap = [pos2(x - 4.5, data.top() - 5.0), pos2(x + 4.5, data.top() - 5.0), pos2(x, data.top() + 1.0)];
        painter.add(Shape::convex_polygon(cap.to_vec(), theme.ink, Stroke::NONE));
        for &(value, color) in dots {
            if value.is_finite() && values.holds(value) {
                let at = pos2(x, values.at(value));
                painter.circle(at, 3.5, color, Stroke::new(1.5, theme.panel));
            }
        }
    }

    /// A thin line at the time under the pointer, in every plot, with this plot's values there.
    pub fn hover(&self, painter: &Painter, lines: impl Fn(&Sample) -> Vec<LayoutJob>) {
        let Some(time) = self.hovered.filter(|_| self.run.len() > 1) else { return };
        let (data, theme) = (self.frame.data, &self.frame.theme);
        let sample = self.run.sample_at(time);
        let x = painter.round_to_pixel_center(self.frame.time.at(sample.time));
        painter.vline(x, data.y_range(), Stroke::new(1.0, theme.dim.gamma_multiply(0.8)));
        let mut text = vec![job(&Frame::clock(sample.time), SMALL + 1.0, theme.dim)];
        text.extend(lines(&sample));
        note(painter, theme, pos2(x, data.top() + 4.0), data, text);
    }
}
