//! A figure of the paper, as it is made here.

use crate::app::charts::axes::{Chart, Side, range_of};
use crate::app::charts::legend::{self, Form};
use crate::app::charts::notation::{self, job, number};
use crate::app::charts::plots::Steps;
use crate::app::stages::Inputs;
use crate::app::theme::Theme;
use crate::app::widgets::text::rich;
use crate::scene::colormap::member;
use centrode_core::study::figure::{Axis, Figure, Mark, Role, Style};
use egui::{Color32, Label, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

/// From this width on the legend stands beside the data.
const BESIDE: f32 = 640.0;
/// Width of the legend there.
const LEGEND: f32 = 190.0;
/// Marks stand at least this far apart.
const CROWDED: f32 = 10.0;
/// The pointer reads a point this near.
const REACH: f32 = 28.0;

/// Shows a figure with its legend, its caption, and the command that writes it to a file.
pub fn figure(ui: &mut Ui, rect: Rect, figure: &Figure, inputs: &Inputs<'_>) {
    let theme = Theme::of(ui);
    let title = ui.painter().layout_job(strong(&figure.title, 15.0, theme.ink, rect.width()));
    let height = title.size().y;
    ui.painter().galley(rect.min, title, theme.ink);

    // The words below take what they need; the chart has the rest.
    let foot = words(ui, rect, figure, inputs, &theme);
    let mut chart = Rect::from_min_max(pos2(rect.left(), rect.top() + height + 8.0), pos2(rect.right(), foot - 8.0));
    let entries = entries(figure, &theme);
    if rect.width() > BESIDE {
        let at = pos2(chart.right() - LEGEND + 12.0, chart.top() + 22.0);
        beside(ui, at, &entries, &theme);
        chart.max.x -= LEGEND;
    } else {
        chart.min.y += above(ui, chart, &entries, &theme) + 4.0;
    }
    curves(ui, chart, figure, &theme);
}

fn strong(text: &str, size: f32, color: Color32, width: f32) -> egui::text::LayoutJob {
    let mut job = egui::text::LayoutJob::simple(text.into(), crate::app::fonts::strong(size), color, width);
    job.wrap.max_width = width;
    job
}

/// Caption and command, at the foot; returns where they begin.
fn words(ui: &mut Ui, rect: Rect, figure: &Figure, inputs: &Inputs<'_>, theme: &Theme) -> f32 {
    let mut caption = rich(&figure.caption, 11.5, theme.dim);
    caption.wrap.max_width = rect.width();
    let command = command(inputs);
    let mut line = job(&command, 11.5, theme.ink);
    line.wrap.max_width = rect.width();
    let heights = [&caption, &line].map(|job| ui.painter().layout_job(job.clone()).size().y);
    let top = rect.bottom() - heights.iter().sum::<f32>() - 6.0;
    let place = Rect::from_min_max(pos2(rect.left(), top), rect.max);
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(place).id_salt("caption"));
    inner.spacing_mut().item_spacing.y = 4.0;
    inner.add(Label::new(caption).wrap().selectable(true));
    inner.add(Label::new(line).wrap().selectable(true));
    top
}

/// The command that writes this figure to a file.
fn command(inputs: &Inputs<'_>) -> String {
    let digit = inputs.stage.figure().map_or(0, |number| number.digit());
    let changed = inputs.source.is_some_and(|source| source.changed);
    let scenario = if changed { " my.toml" } else { "" };
    let file = format!("centrode figure {digit}{scenario} --out figure-{digit}.svg");
    if changed { format!("{file}   (my.toml: this scenario)") } else { file }
}

struct Entry {
    form: Look,
    color: Color32,
    text: String,
}

#[derive(Clone, Copy, PartialEq)]
enum Look {
    Series(Style),
    Vertical,
    Span,
}

fn entries(figure: &Figure, theme: &Theme) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    let series = figure.series.iter().map(|s| (Look::Series(s.style), color(s.role, theme), s.name.as_str()));
    let verticals = figure.verticals.iter().map(|v| (Look::Vertical, mark_color(v.mark, theme), v.name));
    let spans = figure.spans.iter().map(|s| (Look::Span, theme.dim.gamma_multiply(0.3), s.name));
    for (form, color, text) in series.chain(verticals).chain(spans) {
        let known = entries.iter().any(|e| e.text == text && e.color == color && e.form == form);
        if !known && !text.is_empty() {
            entries.push(Entry { form, color, text: text.into() });
        }
    }
    entries
}

fn beside(ui: &Ui, at: Pos2, entries: &[Entry], theme: &Theme) {
    let mut y = at.y;
    for entry in entries {
        let mut text = rich(&entry.text, 12.0, theme.ink);
        text.wrap.max_width = LEGEND - 46.0;
        let galley = ui.painter().layout_job(text);
        swatch(ui.painter(), pos2(at.x + 12.0, y + 8.0), entry, theme);
        let height = galley.size().y;
        ui.painter().galley(pos2(at.x + 32.0, y), galley, theme.ink);
        y += height + 5.0;
    }
}

/// Entries in rows; returns the height they take.
fn above(ui: &Ui, rect: Rect, entries: &[Entry], theme: &Theme) -> f32 {
    let mut at = rect.min;
    for entry in entries {
        let galley = ui.painter().layout_job(rich(&entry.text, 11.5, theme.ink));
        let width = galley.size().x + 40.0;
        if at.x + width > rect.right() && at.x > rect.left() {
            at = pos2(rect.left(), at.y + 17.0);
        }
        swatch(ui.painter(), at + vec2(10.0, 8.0), entry, theme);
        ui.painter().galley(at + vec2(26.0, 0.0), galley, theme.ink);
        at.x += width;
    }
    at.y - rect.top() + 17.0
}

fn swatch(painter: &Painter, at: Pos2, entry: &Entry, theme: &Theme) {
    let line = [at - vec2(10.0, 0.0), at + vec2(10.0, 0.0)];
    match entry.form {
        Look::Series(Style::Line) => drop(painter.line_segment(line, Stroke::new(2.0, entry.color))),
        Look::Series(Style::Dashed) | Look::Vertical => {
            painter.extend(Shape::dashed_line(&line, Stroke::new(1.6, entry.color), 4.5, 3.0));
        }
        Look::Series(Style::Triangles) => legend::mark(painter, at, Form::Triangle, 1.0, entry.color, theme),
        Look::Series(Style::Circles) => legend::mark(painter, at, Form::Circle, 1.0, entry.color, theme),
        Look::Span => drop(painter.rect_filled(Rect::from_center_size(at, vec2(20.0, 11.0)), 2.0, entry.color)),
    }
}

fn color(role: Role, theme: &Theme) -> Color32 {
    match role {
        Role::Model => theme.model,
        Role::Constrained => theme.constrained,
        Role::Sensor => theme.sensor,
        Role::Force => theme.force,
        Role::Bound => theme.ink,
        Role::Robot => theme.robot,
        Role::Member(share) => {
            let [r, g, b, _] = member(share, theme.dark).to_bytes();
            Color32::from_rgb(r, g, b)
        }
    }
}

fn mark_color(mark: Mark, theme: &Theme) -> Color32 {
    match mark {
        Mark::Detection => theme.detection,
        Mark::Contact => theme.obstacle,
    }
}

fn named(axis: &Axis) -> String {
    if axis.unit == "1" { axis.name.into() } else { format!("{} ({})", axis.name, axis.unit) }
}

fn curves(ui: &mut Ui, rect: Rect, figure: &Figure, theme: &Theme) {
    let side = |axis: &Axis, which: usize| {
        let shown = || figure.series.iter().flat_map(|s| &s.points).map(|point| point[which] * axis.scale);
        axis.range.map_or_else(|| range_of(shown()), |range| range.map(|end| end * axis.scale))
    };
    let (x, y) = (side(&figure.x, 0), side(&figure.y, 1));
    let chart = Chart::new(rect, x, y, figure.equal_scales);
    let (name_x, name_y) = (named(&figure.x), named(&figure.y));
    let steps = |axis: &Axis| if axis.unit == "°" { Steps::Degrees } else { Steps::Decimal };
    let painter = ui.painter().clone();
    let sides = [(&name_x, &figure.x), (&name_y, &figure.y)].map(|(name, axis)| Side { name, steps: steps(axis) });
    let inside = painter.with_clip_rect(chart.data.expand(1.0).intersect(painter.clip_rect()));
    for span in &figure.spans {
        let ends = span.ends.map(|end| chart.x.at(end * figure.x.scale));
        let shade = Rect::from_x_y_ranges(ends[0].min(ends[1])..=ends[0].max(ends[1]), chart.data.y_range());
        inside.rect_filled(shade, 0.0, theme.dim.gamma_multiply(0.13));
    }
    chart.frame(&painter, theme, &sides[0], &sides[1]);
    for series in &figure.series {
        let color = color(series.role, theme);
        let place = |point: &[f64; 2]| chart.at([point[0] * figure.x.scale, point[1] * figure.y.scale]);
        for stretch in series.points.split(|point| point.iter().any(|v| !v.is_finite())).filter(|s| !s.is_empty()) {
            let line: Vec<Pos2> = stretch.iter().map(place).collect();
            match series.style {
                Style::Line => drop(inside.line(line, Stroke::new(1.6, color))),
                Style::Dashed => inside.extend(Shape::dashed_line(&line, Stroke::new(1.5, color), 6.0, 4.0)),
                Style::Triangles | Style::Circles => {
                    let form = if series.style == Style::Circles { Form::Circle } else { Form::Triangle };
                    // Marks on top of each other say less than marks apart.
                    let mut last: Option<Pos2> = None;
                    for at in line.into_iter().filter(|at| chart.data.contains(*at)) {
                        if last.is_none_or(|last| last.distance(at) > CROWDED) {
                            legend::mark(&inside, at, form, 1.0, color, theme);
                            last = Some(at);
                        }
                    }
                }
            }
        }
    }
    for vertical in &figure.verticals {
        let at = inside.round_to_pixel_center(chart.x.at(vertical.x * figure.x.scale));
        let line = [pos2(at, chart.data.top()), pos2(at, chart.data.bottom())];
        inside.extend(Shape::dashed_line(&line, Stroke::new(1.4, mark_color(vertical.mark, theme)), 5.0, 3.5));
    }
    let response = ui.interact(chart.data, ui.make_persistent_id("figure"), Sense::hover());
    let label = format!("{}. {}", figure.title, figure.caption);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Figure, true, &label));
    if let Some(pointer) = response.hover_pos() {
        read(&painter, &chart, figure, pointer, theme);
    }
}

/// Reads the nearest point under the pointer.
fn read(painter: &Painter, chart: &Chart, figure: &Figure, pointer: Pos2, theme: &Theme) {
    let points = figure.series.iter().flat_map(|series| series.points.iter().map(move |point| (series, point)));
    let shown = |point: &[f64; 2]| [point[0] * figure.x.scale, point[1] * figure.y.scale];
    let near = points
        .filter(|(_, point)| point.iter().all(|v| v.is_finite()))
        .map(|(series, point)| (chart.at(shown(point)).distance(pointer), series, point))
        .filter(|(distance, ..)| *distance < REACH)
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, series, point)) = near else { return };
    let [x, y] = shown(point);
    let at = chart.at([x, y]);
    painter.circle(at, 4.0, color(series.role, theme), Stroke::new(1.5, theme.panel));
    let line =
        |axis: &Axis, value: f64| job(&format!("{} {} {}", axis.name, number(value, 2), axis.unit), 11.5, theme.ink);
    let lines = vec![job(&series.name, 11.5, theme.dim), line(&figure.x, x), line(&figure.y, y)];
    notation::note(painter, theme, at, chart.data, lines);
}
