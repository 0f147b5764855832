//! Strips and labels of the bending plane.

use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Color32, Galley, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, vec2};
use std::sync::Arc;

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

/// Paints a convex four-cornered piece of a band without soft edges, which would show between it and the next.
pub fn shaded(painter: &Painter, corners: [Pos2; 4], color: Color32) {
    let mut mesh = Mesh::default();
    mesh.vertices.extend(corners.map(|pos| Vertex { pos, uv: WHITE_UV, color }));
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    painter.add(mesh);
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
    symbol::galley(painter, rect.center() - 0.5 * galley.size(), galley, theme.ink);
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

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
