//! How the bending plane's things look, and where its labels go.

use crate::app::notation::job;
use crate::app::theme::Theme;
use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Color32, Galley, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, pos2, vec2};
use std::sync::Arc;

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
        Form::Ghost => {
            let line = [at - vec2(8.0, 0.0), at + vec2(8.0, 0.0)];
            painter.extend(Shape::dashed_line(&line, Stroke::new(1.6, color), 4.0, 3.0));
        }
    }
}

/// Paints a strip between two lines of points.
pub fn strip(painter: &Painter, sides: [&[Pos2]; 2], color: Color32) {
    let mut mesh = Mesh::default();
    for (k, (&a, &b)) in sides[0].iter().zip(sides[1]).enumerate() {
        let k = 2 * k as u32;
        mesh.vertices.extend([a, b].map(|pos| Vertex { pos, uv: WHITE_UV, color }));
        if k > 0 {
            mesh.add_triangle(k - 2, k - 1, k);
            mesh.add_triangle(k - 1, k, k + 1);
        }
    }
    painter.add(mesh);
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

/// Height of a row of the legend.
const ROW: f32 = 17.0;

/// Paints the legend in rows from `top_left`; gives its height.
pub fn legend(painter: &Painter, theme: &Theme, top_left: Pos2, width: f32, entries: &[Entry]) -> f32 {
    let galleys: Vec<_> = entries.iter().map(|entry| painter.layout_job(job(entry.text, 11.0, theme.dim))).collect();
    let widths: Vec<f32> = galleys.iter().map(|galley| 22.0 + galley.size().x + 12.0).collect();
    let places = rows(&widths, width);
    let mut height = 0.0;
    for ((entry, galley), (x, row)) in entries.iter().zip(galleys).zip(places) {
        let y = top_left.y + (row as f32 + 0.5) * ROW;
        let x = top_left.x + x;
        mark(painter, pos2(x + 9.0, y), entry.form, 1.0, entry.color, theme);
        painter.galley(pos2(x + 22.0, y - 0.5 * galley.size().y), galley, theme.dim);
        height = (row + 1) as f32 * ROW;
    }
    height
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

/// Puts a label of `size` beside `at`: where it covers fewest of the points in the way, within `bounds`.
#[must_use]
pub fn place(at: Pos2, size: Vec2, bounds: Rect, in_the_way: &[Pos2]) -> Rect {
    let mut best = Rect::from_center_size(at, size);
    let mut least = usize::MAX;
    for gap in [12.0, 26.0, 44.0] {
        for direction in [
            vec2(1.0, 0.0),
            vec2(-1.0, 0.0),
            vec2(0.0, -1.0),
            vec2(0.0, 1.0),
            vec2(0.8, -0.8),
            vec2(-0.8, 0.8),
            vec2(0.8, 0.8),
            vec2(-0.8, -0.8),
        ] {
            let center = at + direction * (0.5 * size + Vec2::splat(gap));
            let rect = Rect::from_center_size(center, size);
            if !bounds.contains_rect(rect) {
                continue;
            }
            let room = rect.expand(3.0);
            let covered = in_the_way.iter().filter(|point| room.contains(**point)).count();
            if covered < least {
                (best, least) = (rect, covered);
            }
        }
        if least == 0 {
            break;
        }
    }
    let inside = bounds.shrink2(0.5 * size.min(bounds.size()));
    if least == usize::MAX { Rect::from_center_size(inside.clamp(at), size) } else { best }
}

/// Paints a label on a ground of its own.
pub fn label(painter: &Painter, rect: Rect, galley: Arc<Galley>, edge: Color32, theme: &Theme) {
    painter.rect(rect, 4.0, theme.panel.gamma_multiply(0.92), Stroke::new(1.0, edge), StrokeKind::Inside);
    painter.galley(rect.center() - 0.5 * galley.size(), galley, theme.ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legend_rows_keep_to_the_width() {
        let places = rows(&[60.0, 60.0, 60.0, 200.0], 130.0);
        assert_eq!(places, [(0.0, 0), (60.0, 0), (0.0, 1), (0.0, 2)]);
    }

    #[test]
    fn a_label_avoids_what_is_drawn_and_stays_inside() {
        let bounds = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 200.0));
        let at = pos2(100.0, 100.0);
        let wall: Vec<Pos2> = (0..40).map(|k| pos2(110.0 + k as f32, 100.0)).collect();
        let rect = place(at, vec2(50.0, 16.0), bounds, &wall);
        assert!(wall.iter().all(|point| !rect.contains(*point)));
        for corner in [pos2(0.0, 0.0), pos2(200.0, 0.0), pos2(199.0, 199.0)] {
            assert!(bounds.contains_rect(place(corner, vec2(50.0, 16.0), bounds, &[])));
        }
    }
}
