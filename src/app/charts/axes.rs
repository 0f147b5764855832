//! Two axes with their grid, ticks and names.

use crate::app::charts::notation::job;
use crate::app::charts::plots::{Axis, Steps, Tick};
use crate::app::theme::Theme;
use egui::{Align2, FontId, Painter, Pos2, Rect, Stroke, pos2, vec2};

/// Sizes of text.
const TICK: f32 = 11.0;
/// Size of an axis name, points.
pub const NAME: f32 = 12.5;
/// Room for ticks and name.
const LEFT: f32 = 50.0;
const BOTTOM: f32 = 38.0;
const TOP: f32 = 20.0;

/// An axis to draw.
pub struct Side<'a> {
    /// Its name with the unit.
    pub name: &'a str,
    /// Which steps are round.
    pub steps: Steps,
}

/// Where data is, and how its values lie.
#[derive(Debug, Clone, Copy)]
pub struct Chart {
    /// The data.
    pub data: Rect,
    /// Horizontal, in the unit shown.
    pub x: Axis,
    /// Vertical.
    pub y: Axis,
}

impl Chart {
    /// Divides `rect`. With equal scales the ranges grow until a unit is as long in both directions.
    pub fn new(rect: Rect, x: [f64; 2], y: [f64; 2], equal: bool) -> Self {
        let data = Rect::from_min_max(rect.min + vec2(LEFT, TOP), rect.max - vec2(10.0, BOTTOM));
        let data = Rect::from_min_size(data.min, data.size().max(vec2(40.0, 40.0)));
        let (mut x, mut y) = (x, y);
        if equal {
            let per_point = |range: [f64; 2], points: f32| (range[1] - range[0]) / f64::from(points);
            let scale = per_point(x, data.width()).max(per_point(y, data.height()));
            for (range, points) in [(&mut x, data.width()), (&mut y, data.height())] {
                let (middle, half) = (f64::midpoint(range[0], range[1]), 0.5 * scale * f64::from(points));
                *range = [middle - half, middle + half];
            }
        }
        Self { data, x: Axis::new(x, [data.left(), data.right()]), y: Axis::new(y, [data.bottom(), data.top()]) }
    }

    /// Where a point lies.
    pub fn at(&self, [x, y]: [f64; 2]) -> Pos2 {
        pos2(self.x.at(x), self.y.at(y))
    }

    /// Paints grid, ticks and names.
    pub fn frame(&self, painter: &Painter, theme: &Theme, x: &Side<'_>, y: &Side<'_>) {
        let ticks = [self.x.ticks(64.0, x.steps), self.y.ticks(38.0, y.steps)];
        self.frame_with(painter, theme, [x.name, y.name], ticks);
    }

    /// The same with ticks that are given.
    pub fn frame_with(&self, painter: &Painter, theme: &Theme, names: [&str; 2], [x, y]: [Vec<Tick>; 2]) {
        let data = self.data;
        let font = FontId::proportional(TICK);
        let grid = Stroke::new(1.0, theme.faint.gamma_multiply(0.7));
        for tick in x {
            let at = painter.round_to_pixel_center(self.x.at(tick.value));
            painter.vline(at, data.y_range(), grid);
            painter.text(pos2(at, data.bottom() + 4.0), Align2::CENTER_TOP, tick.text, font.clone(), theme.dim);
        }
        for tick in y {
            let at = painter.round_to_pixel_center(self.y.at(tick.value));
            painter.hline(data.x_range(), at, grid);
            painter.text(pos2(data.left() - 6.0, at), Align2::RIGHT_CENTER, tick.text, font.clone(), theme.dim);
        }
        painter.rect_stroke(data, 0.0, Stroke::new(1.0, theme.dim), egui::StrokeKind::Middle);
        let name = painter.layout_job(job(names[0], NAME, theme.ink));
        let left = (data.center().x - 0.5 * name.size().x).max(data.left());
        painter.galley(pos2(left, data.bottom() + 20.0), name, theme.ink);
        let name = painter.layout_job(job(names[1], NAME, theme.ink));
        painter.galley(pos2(data.left() - LEFT + 4.0, data.top() - TOP), name, theme.ink);
    }
}

/// Ends that hold all finite values, with a margin.
pub fn range_of(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = values
        .filter(|value| value.is_finite())
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    if low > high {
        return [0.0, 1.0];
    }
    let margin = if high > low { 0.04 * (high - low) } else { 0.5 * high.abs().max(1.0) };
    // What does not go below zero needs no room there.
    [if low == 0.0 { 0.0 } else { low - margin }, high + margin]
}
