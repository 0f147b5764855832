//! Triangulation of a polygon with holes.

use earcut::Earcut;
use glam::Vec2;

/// Triangles, counter-clockwise, over the corners of `outer` followed by those of each hole in turn.
///
/// Holes lie inside `outer` and apart from each other; which way the rings run does not matter.
pub(super) fn triangulate(outer: &[Vec2], holes: &[Vec<Vec2>]) -> Vec<[u32; 3]> {
    let mut corners: Vec<[f32; 2]> = outer.iter().map(Vec2::to_array).collect();
    let mut starts = Vec::with_capacity(holes.len());
    for hole in holes {
        starts.push(corners.len() as u32);
        corners.extend(hole.iter().map(Vec2::to_array));
    }
    let mut indices = Vec::new();
    Earcut::new().earcut_slice(&corners, &starts, &mut indices);
    indices.as_chunks().0.to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn circle(center: Vec2, radius: f32, count: usize, turn: f32) -> Vec<Vec2> {
        (0..count).map(|i| center + Vec2::from_angle(turn * TAU * i as f32 / count as f32) * radius).collect()
    }

    fn cross(a: Vec2, b: Vec2, c: Vec2) -> f32 {
        (b - a).perp_dot(c - a)
    }

    fn area(ring: &[Vec2]) -> f32 {
        (0..ring.len()).map(|i| 0.5 * ring[i].perp_dot(ring[(i + 1) % ring.len()])).sum()
    }

    #[test]
    fn the_area_is_right_and_no_triangle_is_turned() {
        for count in 0..6 {
            let outer = circle(Vec2::ZERO, 4.2, 72, 1.0);
            let mut holes = vec![circle(Vec2::ZERO, 0.6, 24, -1.0)];
            for i in 0..count {
                let at = Vec2::from_angle(TAU * i as f32 / count as f32) * 3.0;
                holes.push(circle(at, 0.6, 24, -1.0));
            }
            let points: Vec<Vec2> = outer.iter().chain(holes.iter().flatten()).copied().collect();
            let expected = area(&outer) + holes.iter().map(|h| area(h)).sum::<f32>();
            let mut sum = 0.0;
            for [a, b, c] in triangulate(&outer, &holes) {
                let doubled = cross(points[a as usize], points[b as usize], points[c as usize]);
                assert!(doubled >= 0.0);
                sum += 0.5 * doubled;
            }
            assert!((sum - expected).abs() < 1e-3, "{count}: {sum} {expected}");
        }
    }

    #[test]
    fn a_plain_polygon_needs_no_bridge() {
        assert_eq!(triangulate(&circle(Vec2::ZERO, 1.0, 5, 1.0), &[]).len(), 3);
        assert!(triangulate(&[], &[]).is_empty());
    }
}
