//! Every estimate behind Table II against the true place: the paper's, and the simulated ones.

use crate::app::charts::notation::number;
use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::text::{paint, width};
use centrode_core::study::table2::{Disk, Outcome, Row, Table2, paper_rows};
use egui::{Align2, Color32, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Least height of the picture, points.
pub const LEAST: f32 = 190.0;
/// Height beyond which the lanes get no wider, points.
const MOST: f32 = 420.0;
/// Room for the names of the disks, points.
const NAMES: f32 = 50.0;
const SMALL: f32 = 11.0;
/// The pointer reads a mark this near, points.
const REACH: f32 = 9.0;

/// One estimate on the picture.
struct Dot {
    at: Pos2,
    paper: bool,
    words: String,
}

/// The horizontal axis, mm.
struct Axis {
    ends: [f64; 2],
    data: Rect,
}

impl Axis {
    fn new(values: impl Iterator<Item = f64>, data: Rect) -> Self {
        let [low, high] = values
            .filter(|value| value.is_finite())
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        let [low, high] = if low <= high { [low, high] } else { [0.0, 1.0] };
        let margin = 0.06 * (high - low).max(1e-3);
        Self { ends: [low - margin, high + margin], data }
    }

    fn at(&self, value: f64) -> f32 {
        let share = (value - self.ends[0]) / (self.ends[1] - self.ends[0]);
        egui::lerp(self.data.x_range(), share as f32)
    }

    /// Round values inside the axis, some 60 points apart.
    fn ticks(&self) -> Vec<f64> {
        let span = self.ends[1] - self.ends[0];
        let wanted = span * 60.0 / f64::from(self.data.width().max(60.0));
        let power = 10f64.powf(wanted.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|k| k * power).find(|step| *step >= wanted).unwrap_or(span);
        let (first, last) = ((self.ends[0] / step).ceil() as i64, (self.ends[1] / step).floor() as i64);
        (first..=last).map(|k| k as f64 * step).collect()
    }
}

/// Shows all estimates in lanes, a disk each.
pub fn estimates(ui: &mut Ui, rect: Rect, shown: &Table2, rows: &[Row]) {
    let theme = Theme::of(ui);
    let rect = rect.with_max_y(rect.bottom().min(rect.top() + MOST));
    let painter = ui.painter().clone();
    let head = heading(ui, rect, &theme);
    let data = Rect::from_min_max(pos2(rect.left() + NAMES, head + 4.0), rect.max - vec2(8.0, 32.0));
    let paper = paper_rows();
    let found = |rows: &[Row]| -> Vec<Row> {
        rows.iter().filter(|row| row.outcome == Outcome::Found && row.location.is_finite()).copied().collect()
    };
    let (paper, simulated) = (found(&paper), found(rows));
    let all = paper.iter().chain(&simulated).map(|row| row.location * 1e3);
    let axis = Axis::new(all.chain(shown.simulated.iter().map(|disk| disk.arc_length * 1e3)), data);
    for value in axis.ticks() {
        let x = painter.round_to_pixel_center(axis.at(value));
        painter.vline(x, data.y_range(), Stroke::new(1.0, theme.faint));
        let at = pos2(x, data.bottom() + 3.0);
        paint(ui, at, Align2::CENTER_TOP, &number(value, 0), fonts::regular(SMALL), theme.dim);
    }
    let at = pos2(data.center().x, rect.bottom());
    paint(ui, at, Align2::CENTER_BOTTOM, "distance from the base (mm)", fonts::regular(SMALL), theme.dim);

    let lane = data.height() / 3.0;
    let mut dots = Vec::new();
    for (k, disk) in shown.simulated.iter().enumerate() {
        let place = Rect::from_min_size(data.min + vec2(0.0, lane * k as f32), vec2(data.width(), lane));
        if k > 0 {
            painter.hline(rect.left()..=data.right(), place.top(), Stroke::new(1.0, theme.faint));
        }
        let name = format!("Disk {}", disk.disk);
        let at = pos2(rect.left() + 2.0, place.center().y);
        paint(ui, at, Align2::LEFT_CENTER, &name, fonts::regular(12.5), theme.ink);
        let x = painter.round_to_pixel_center(axis.at(disk.arc_length * 1e3));
        painter.vline(x, place.shrink(3.0).y_range(), Stroke::new(3.0, theme.obstacle));
        for (paper, rows) in [(true, &paper), (false, &simulated)] {
            for (repeat, row) in rows.iter().filter(|row| row.disk == disk.disk).enumerate() {
                // Equal ones would hide each other: they stand a little apart.
                let lift = ((repeat * 3) % 5) as f32 / 4.0 - 0.5;
                let y = place.top() + lane * (if paper { 0.3 } else { 0.7 } + 0.22 * lift);
                let mm = number(row.location * 1e3, 1);
                let who = if paper { "paper" } else { "simulated" };
                let words = format!("{name}, {who}, run {}: {mm} mm", repeat + 1);
                dots.push(Dot { at: pos2(axis.at(row.location * 1e3), y), paper, words });
            }
        }
    }
    for dot in &dots {
        mark(&painter, dot.at, dot.paper, &theme);
    }
    let response = ui.interact(data, ui.make_persistent_id("estimates"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, described(shown, dots.len())));
    read(&painter, response, &dots, &theme);
}

/// Names the nearest mark under the pointer.
fn read(painter: &Painter, response: Response, dots: &[Dot], theme: &Theme) {
    let Some(pointer) = response.hover_pos() else { return };
    let near = dots.iter().map(|dot| (dot.at.distance(pointer), dot)).filter(|(away, _)| *away < REACH);
    if let Some((_, dot)) = near.min_by(|a, b| a.0.total_cmp(&b.0)) {
        painter.circle_stroke(dot.at, 7.0, Stroke::new(1.5, theme.ink));
        response.on_hover_text_at_pointer(&dot.words);
    }
}

/// Title, and what the marks mean: beside it, or below where it is narrow. Returns where that ends.
fn heading(ui: &Ui, rect: Rect, theme: &Theme) -> f32 {
    let title = "Each estimate against the truth";
    let title = paint(ui, rect.min, Align2::LEFT_TOP, title, fonts::strong(13.5), theme.ink);
    let entries = [(Some(true), "paper"), (Some(false), "simulated"), (None, "true place of the disk")];
    let wide = |text: &str| width(ui, text, fonts::regular(12.0)) + 36.0;
    let all: f32 = entries.iter().map(|(_, text)| wide(text)).sum();
    let beside = title.right() + 24.0 + all < rect.right();
    let mut at =
        if beside { pos2(rect.right() - all, title.center().y) } else { pos2(rect.left(), title.bottom() + 11.0) };
    let bottom = at.y + 10.0;
    for (kind, text) in entries {
        let sign = at + vec2(10.0, 0.0);
        match kind {
            Some(paper) => mark(ui.painter(), sign, paper, theme),
            None => drop(ui.painter().vline(sign.x, sign.y - 7.0..=sign.y + 7.0, Stroke::new(3.0, theme.obstacle))),
        }
        paint(ui, at + vec2(22.0, 0.0), Align2::LEFT_CENTER, text, fonts::regular(12.0), theme.dim);
        at.x += wide(text);
    }
    bottom
}

/// An estimate: the paper's as an open diamond, a simulated one as a dot.
fn mark(painter: &Painter, at: Pos2, paper: bool, theme: &Theme) {
    if paper {
        let points = [vec2(0.0, -5.0), vec2(5.0, 0.0), vec2(0.0, 5.0), vec2(-5.0, 0.0)].map(|d| at + d);
        painter.add(Shape::convex_polygon(points.to_vec(), theme.panel, Stroke::new(1.6, theme.detection)));
    } else {
        let edge = Stroke::new(0.8, Color32::from_rgba_unmultiplied(0, 0, 0, if theme.dark { 90 } else { 30 }));
        painter.circle(at, 3.0, theme.detection.gamma_multiply(0.75), edge);
    }
}

/// The picture in words.
fn described(shown: &Table2, marks: usize) -> String {
    let mean = |disk: &Disk| number(disk.location.mean * 1e3, 1);
    let disks = shown.paper.iter().zip(&shown.simulated).map(|(paper, simulated)| {
        let truth = number(simulated.arc_length * 1e3, 1);
        format!("disk {} at {truth} mm: paper {}, simulated {}", simulated.disk, mean(paper), mean(simulated))
    });
    let disks: Vec<String> = disks.collect();
    format!("Estimated places of contact, {marks} marks; means in mm: {}", disks.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let data = Rect::from_min_size(pos2(10.0, 0.0), vec2(600.0, 100.0));
        let axis = Axis::new([7.5, 22.5, f64::NAN].into_iter(), data);
        assert_eq!(axis.ticks(), [8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0]);
        assert!(axis.at(7.5) > 10.0 && axis.at(22.5) < 610.0);
    }

    #[test]
    fn nothing_to_show_is_shown_as_an_empty_axis() {
        let data = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 100.0));
        let axis = Axis::new(std::iter::empty(), data);
        assert!(axis.ticks().iter().all(|tick| axis.at(*tick).is_finite()));
    }
}
