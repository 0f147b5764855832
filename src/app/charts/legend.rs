//! The legend of a picture: what its marks look like, and what they mean.

use std::sync::Arc;

use egui::{Color32, Galley, Painter, Pos2, Shape, Stroke, Vec2, pos2, vec2};

use crate::app::charts::notation::job;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use centrode_core::detect::Method;
use centrode_core::run::Run;

/// Form of a mark: it differs in shape as well as in colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Model without constraint.
    Triangle,
    /// Constrained model.
    Circle,
    /// Sensor.
    Dot,
    /// The estimated place of the contact.
    Diamond,
    /// The beam.
    Beam,
    /// The true backbone.
    Solid,
    /// The backbone without constraint.
    Ghost,
    /// An instantaneous screw axis.
    Axis,
    /// The force of the beam.
    Arrow,
    /// A band along the backbone.
    Band,
}

/// Paints a mark; `size` 1 is that of a locus.
pub fn mark(painter: &Painter, at: Pos2, form: Form, size: f32, color: Color32, theme: &Theme) {
    let halo = Stroke::new(if size > 1.2 { 1.6 } else { 0.8 }, theme.panel);
    match form {
        Form::Triangle => {
            let r = 4.4 * size;
            let points = vec![at + vec2(0.0, -r), at + vec2(0.87 * r, 0.6 * r), at + vec2(-0.87 * r, 0.6 * r)];
            painter.add(Shape::convex_polygon(points, color, halo));
        }
        Form::Circle => {
            painter.circle_stroke(at, 3.6 * size, Stroke::new(1.4 + 0.5 * size, color));
        }
        Form::Dot => {
            painter.circle(at, 2.5 * size, color, halo);
        }
        Form::Diamond => {
            let r = 4.6 * size;
            let points = [vec2(0.0, -r), vec2(r, 0.0), vec2(0.0, r), vec2(-r, 0.0)].map(|d| at + d);
            painter.add(Shape::convex_polygon(points.to_vec(), color, halo));
        }
        Form::Beam => {
            painter.circle_filled(at, 4.8 * size, color);
        }
        Form::Solid => {
            painter.hline(at.x - 7.0..=at.x + 7.0, at.y, Stroke::new(2.6, color));
        }
        Form::Band => {
            for (half, opacity) in [(9.0, 0.3), (4.0, 0.75)] {
                painter.hline(at.x - half..=at.x + half, at.y, Stroke::new(7.0, color.gamma_multiply(opacity)));
            }
        }
        Form::Ghost => {
            let line = [at - vec2(8.0, 0.0), at + vec2(8.0, 0.0)];
            painter.extend(Shape::dashed_line(&line, Stroke::new(1.6, color), 4.0, 3.0));
        }
        Form::Arrow => arrow(painter, [at - vec2(8.0, 0.0), at + vec2(8.0, 0.0)], Stroke::new(2.0, color)),
        Form::Axis => {
            let line = [at - vec2(8.0, 0.0), at + vec2(8.0, 0.0)];
            painter.extend(Shape::dashed_line(&line, Stroke::new(1.4, color), 7.0, 2.0));
        }
    }
}

/// Length of an arrow's head and half its width, points.
const HEAD: Vec2 = vec2(9.0, 4.5);

/// Paints an arrow; one shorter than its head is all head.
pub fn arrow(painter: &Painter, [tail, head]: [Pos2; 2], stroke: Stroke) {
    let along = (head - tail).normalized();
    let size = HEAD * ((head - tail).length() / HEAD.x).min(1.0);
    let back = head - along * size.x;
    painter.line_segment([tail, back], stroke);
    let side = along.rot90() * size.y;
    painter.add(Shape::convex_polygon(vec![head, back + side, back - side], stroke.color, Stroke::NONE));
}

/// One line of the legend.
pub struct Entry {
    /// What the mark looks like.
    pub form: Form,
    /// Its colour.
    pub color: Color32,
    /// What it means.
    pub text: &'static str,
}

/// What stands for the place that an alarm of the calibration filter's is given, where a run has such an alarm.
#[must_use]
pub fn placed(run: &Run, theme: &Theme) -> Option<Entry> {
    let thresholds = &run.judged.settings.thresholds;
    let judges = |method: &(Method, &str)| thresholds.judges(method.0);
    let names = [(Method::Cusum, "place by CUSUM"), (Method::Glr, "place by GLR")];
    let (method, text) = names.into_iter().find(judges)?;
    run.judged.first(method)?;
    Some(Entry { form: Form::Band, color: theme.constrained, text })
}

/// Height of a row of the legend.
pub const ROW: f32 = 17.0;

/// Paints the legend in rows from `top_left`; gives its height.
pub fn legend(painter: &Painter, theme: &Theme, top_left: Pos2, width: f32, entries: &[Entry]) -> f32 {
    let galleys = galleys(painter, theme, entries);
    let places = rows(&widths(&galleys), width);
    let mut height = 0.0;
    for ((entry, galley), (x, row)) in entries.iter().zip(galleys).zip(places) {
        let y = top_left.y + (row as f32 + 0.5) * ROW;
        let x = top_left.x + x;
        mark(painter, pos2(x + 9.0, y), entry.form, 1.0, entry.color, theme);
        symbol::galley(painter, pos2(x + 22.0, y - 0.5 * galley.size().y), galley, theme.dim);
        height = (row + 1) as f32 * ROW;
    }
    height
}

fn galleys(painter: &Painter, theme: &Theme, entries: &[Entry]) -> Vec<Arc<Galley>> {
    entries.iter().map(|entry| painter.layout_job(job(entry.text, 11.0, theme.dim))).collect()
}

fn widths(galleys: &[Arc<Galley>]) -> Vec<f32> {
    galleys.iter().map(|galley| 22.0 + galley.size().x + 12.0).collect()
}

/// The size that [`legend`] takes when it has `width`.
#[must_use]
pub fn size(painter: &Painter, theme: &Theme, width: f32, entries: &[Entry]) -> Vec2 {
    let widths = widths(&galleys(painter, theme, entries));
    let places = rows(&widths, width);
    let right = places.iter().zip(&widths).map(|((x, _), width)| x + width - 12.0).fold(0.0, f32::max);
    vec2(right, places.last().map_or(0.0, |(_, row)| (row + 1) as f32 * ROW))
}

/// Place of each entry: distance from the left, and row.
#[must_use]
pub fn rows(widths: &[f32], room: f32) -> Vec<(f32, usize)> {
    let (mut x, mut row) = (0.0, 0);
    widths
        .iter()
        .map(|&width| {
            if x > 0.0 && x + width - 12.0 > room {
                (x, row) = (0.0, row + 1);
            }
            let place = (x, row);
            x += width;
            place
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legend_rows_keep_to_the_width() {
        let places = rows(&[60.0, 60.0, 60.0, 200.0], 130.0);
        assert_eq!(places, [(0.0, 0), (60.0, 0), (0.0, 1), (0.0, 2)]);
    }
}
