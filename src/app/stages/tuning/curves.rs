//! Two curves over all thresholds, each with its band: contacts found, and delay, against false alarms.
//!
//! Shares lie on an arcsine scale: both ends, where thresholds are chosen, are spread, and intervals from equally many
//! runs are about equally wide everywhere.

use crate::app::charts::axes::Chart;
use crate::app::charts::notation::{self, job, number};
use crate::app::charts::plots::{Steps, Tick};
use crate::app::command::Command;
use crate::app::stages::tuner::LATE;
use crate::app::stages::tuning::words::{digits, percent};
use crate::app::stages::tuning::{Named, REACH, View, color, taken, title};
use crate::app::theme::Theme;
use centrode_core::chart::ticks::{percents, spread};
use centrode_core::study::tuning::Point;
use centrode_core::study::tuning::recommend::Verdict;
use centrode_core::study::tuning::watch::Method;
use egui::{Color32, CursorIcon, Mesh, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Which value stands on the vertical axis: the value itself, and the ends of its interval, as shown.
struct Kind {
    title: &'static str,
    name: &'static str,
    /// Whether it is a share.
    share: bool,
    range: [f64; 2],
    value: fn(&Point) -> Option<[f64; 3]>,
}

fn detected(point: &Point) -> Option<[f64; 3]> {
    let rate = point.detection?.detected;
    (rate.of > 0).then_some([rate.low, rate.rate, rate.high].map(spread))
}

fn delay_of(point: &Point) -> Option<[f64; 3]> {
    let seen = point.detection?;
    let open = |value: f64| if value.is_nan() { LATE * 1.05 } else { value };
    (!seen.median.is_nan()).then_some([open(seen.median_low), seen.median, open(seen.median_high)])
}

/// Ticks of an axis of shares, at least `spacing` points apart.
fn shares(length: f32, spacing: f32) -> Vec<Tick> {
    let tick = |percent: u8| Tick { value: spread(f64::from(percent) / 100.0), text: percent.to_string() };
    percents(f64::from(spacing / length)).into_iter().map(tick).collect()
}

/// Contacts found against false alarms: the operating characteristic.
pub fn operating(ui: &mut Ui, rect: Rect, view: &View<'_>, out: &mut Vec<Command>) {
    let title = "Contacts found against false alarms";
    let kind = Kind { title, name: "Found in time (%)", share: true, range: [-0.04, 1.04], value: detected };
    curve(ui, rect, &kind, view, out);
}

/// Median delay against false alarms.
pub fn delay(ui: &mut Ui, rect: Rect, view: &View<'_>, out: &mut Vec<Command>) {
    let title = "Delay against false alarms";
    let kind = Kind { title, name: "Median delay (s)", share: false, range: [0.0, LATE * 1.04], value: delay_of };
    curve(ui, rect, &kind, view, out);
}

fn curve(ui: &mut Ui, rect: Rect, kind: &Kind, view: &View<'_>, out: &mut Vec<Command>) {
    let theme = &view.theme;
    title(ui, rect, kind.title, theme);
    let place = Rect::from_min_max(rect.min + vec2(0.0, 20.0), rect.max);
    let chart = Chart::new(place, [-0.04, 1.04], kind.range, false);
    let painter = ui.painter().clone();
    let size = chart.data.size();
    let rows = if kind.share { shares(size.y, 15.0) } else { chart.y.ticks(28.0, Steps::Decimal) };
    chart.frame_with(&painter, theme, ["Free runs that alarm (%)", kind.name], [shares(size.x, 26.0), rows]);
    let inside = painter.with_clip_rect(chart.data.expand(8.0).intersect(painter.clip_rect()));
    let wish = chart.x.at(spread(view.tuning.wish));
    let line = [pos2(wish, chart.data.top()), pos2(wish, chart.data.bottom())];
    inside.extend(Shape::dashed_line(&line, Stroke::new(1.0, theme.accent), 4.0, 4.0));
    legend(ui, rect, view);

    let chosen = view.tuning.method;
    let others = Method::ALL.into_iter().filter(|method| *method != chosen);
    for method in others.chain([chosen]) {
        let strength = if method == chosen { 1.0 } else { 0.45 };
        one(
            &inside,
            &chart,
            kind,
            &view.derived.curves[method as usize],
            color(method, theme),
            strength,
            method == Method::And,
        );
    }
    let at = |point: &Point| {
        (kind.value)(point).map(|[_, value, _]| chart.at([spread(point.false_alarms.rate.rate), value]))
    };
    if let Verdict::Take { cell, level, .. } = &view.derived.verdict
        && let Some(at) = at(&view.study.point(*cell, chosen, *level))
    {
        inside.circle_stroke(at, 7.0, Stroke::new(2.0, theme.accent));
    }
    if let Some(at) = view.own().and_then(at) {
        inside.circle(at, 5.0, color(chosen, theme), Stroke::new(1.5, theme.panel));
    }
    touch(ui, &chart, kind, view, &at, out);
}

/// What the colours mean, at the right of the title.
fn legend(ui: &Ui, rect: Rect, view: &View<'_>) {
    let mut right = rect.right() - 10.0;
    for method in Method::ALL.into_iter().rev() {
        let name = Named::of(method, view.study).name;
        let ink = if method == view.tuning.method { view.theme.ink } else { view.theme.dim };
        let galley = ui.painter().layout_job(job(name, 11.0, ink));
        let wide = galley.size().x;
        if rect.width() < 470.0 && method != view.tuning.method {
            continue;
        }
        ui.painter().galley(pos2(right - wide, rect.top() + 1.0), galley, ink);
        let y = rect.top() + 8.0;
        let line = [pos2(right - wide - 18.0, y), pos2(right - wide - 5.0, y)];
        let stroke = Stroke::new(2.0, color(method, &view.theme));
        if method == Method::And {
            ui.painter().extend(Shape::dashed_line(&line, stroke, 4.0, 3.0));
        } else {
            ui.painter().line_segment(line, stroke);
        }
        right -= wide + 28.0;
    }
}

/// A curve through all thresholds, over the band between the ends of both intervals.
fn one(painter: &Painter, chart: &Chart, kind: &Kind, points: &[Point], color: Color32, strength: f32, dashed: bool) {
    let mut mesh = Mesh::default();
    let mut line: Vec<Pos2> = Vec::new();
    let mut lines: Vec<Vec<Pos2>> = Vec::new();
    let mut last: Option<u32> = None;
    for point in points {
        let Some([low, value, high]) = (kind.value)(point) else {
            lines.push(std::mem::take(&mut line));
            last = None;
            continue;
        };
        let alarms = point.false_alarms.rate;
        // More alarms go with more found and with less delay: the corners of both intervals that are farthest from the curve.
        let [few, many] = [alarms.low, alarms.high].map(spread);
        let [below, above] = if kind.share { [[many, low], [few, high]] } else { [[few, low], [many, high]] };
        let at = chart.at([spread(alarms.rate), value]);
        if line.last() == Some(&at) && last.is_some() {
            continue;
        }
        line.push(at);
        let next = mesh.vertices.len() as u32;
        for end in [below, above] {
            mesh.colored_vertex(chart.at(end), color.gamma_multiply(0.16 * strength));
        }
        if let Some(last) = last {
            mesh.add_triangle(last, last + 1, next);
            mesh.add_triangle(last + 1, next, next + 1);
        }
        last = Some(next);
    }
    lines.push(line);
    painter.add(Shape::mesh(mesh));
    let stroke = Stroke::new(1.0 + strength, color.gamma_multiply(0.35 + 0.65 * strength));
    for line in lines.into_iter().filter(|line| line.len() > 1) {
        if dashed {
            painter.extend(Shape::dashed_line(&line, stroke, 5.0, 3.0));
        } else {
            painter.line(line, stroke);
        }
    }
}

/// A click or a drag takes the nearest threshold; without a button the pointer reads it.
fn touch(
    ui: &mut Ui,
    chart: &Chart,
    kind: &Kind,
    view: &View<'_>,
    at: &impl Fn(&Point) -> Option<Pos2>,
    out: &mut Vec<Command>,
) {
    let response = ui.interact(chart.data, ui.make_persistent_id(kind.title), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::Crosshair);
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, kind.title));
    let nearest = |pointer: Pos2| {
        let levels = view.curve().iter().enumerate().filter_map(|(level, point)| Some((level, at(point)?)));
        let distance = |at: &Pos2| at.distance(pointer);
        levels.min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)))
    };
    let own = view.own().and_then(at);
    if let Some(pointer) = taken(ui, &response, |finger| own.is_some_and(|own| own.distance(finger) < REACH)) {
        if let Some((level, _)) = nearest(pointer) {
            view.take(level, None, out);
        }
        return;
    }
    let hover = response.hover_pos().filter(|_| !response.dragged());
    let Some((level, place)) = hover.and_then(nearest) else { return };
    let painter = ui.painter();
    painter.circle_stroke(place, 4.5, Stroke::new(1.5, view.theme.ink));
    notation::note(painter, &view.theme, place, chart.data, note(view, &view.curve()[level], &view.theme));
}

/// A threshold and what it comes to.
pub fn note(view: &View<'_>, point: &Point, theme: &Theme) -> Vec<egui::text::LayoutJob> {
    let named = Named::of(view.tuning.method, view.study);
    let alarms = point.false_alarms.rate;
    let mut lines = vec![
        job(&format!("{} = {} {}", named.symbol, digits(&named, point.threshold), named.unit), 11.5, theme.ink),
        job(&format!("alarms {} of {}", alarms.count, alarms.of), 11.5, theme.dim),
    ];
    if let Some(seen) = point.detection {
        lines.push(job(&format!("found {} of {}", seen.detected.count, seen.detected.of), 11.5, theme.dim));
        if !seen.median.is_nan() {
            lines.push(job(&format!("after {} s", number(seen.median, 3)), 11.5, theme.dim));
        } else if seen.detected.of > 0 {
            lines.push(job(&format!("{} % in time", percent(seen.detected.rate)), 11.5, theme.dim));
        }
    }
    lines
}
