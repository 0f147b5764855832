//! Triangulation of a polygon with holes, by ear clipping.

use glam::Vec2;

/// Triangles, counter-clockwise, over the corners of `outer` followed by those of each hole in turn.
///
/// `outer` runs counter-clockwise, holes clockwise; holes lie inside and apart from each other.
pub(super) fn triangulate(outer: &[Vec2], holes: &[Vec<Vec2>]) -> Vec<[u32; 3]> {
    let mut points = outer.to_vec();
    let mut ring: Vec<u32> = (0..outer.len() as u32).collect();
    let mut starts: Vec<(u32, u32)> = Vec::new();
    for hole in holes {
        starts.push((points.len() as u32, hole.len() as u32));
        points.extend(hole);
    }
    let rightmost = |&(start, len): &(u32, u32)| {
        (start..start + len).max_by(|&a, &b| points[a as usize].x.total_cmp(&points[b as usize].x)).unwrap_or(start)
    };
    // From right to left, so that each bridge goes to the outline or to a hole already joined.
    let mut order: Vec<(u32, u32, u32)> = starts.iter().map(|s| (s.0, s.1, rightmost(s))).collect();
    order.sort_by(|a, b| points[b.2 as usize].x.total_cmp(&points[a.2 as usize].x));
    for (start, len, tip) in order {
        if let Some(at) = bridge(&points, &ring, points[tip as usize]) {
            let around = (0..=len).map(|k| start + (tip - start + k) % len);
            let back = ring[at];
            ring.splice(at + 1..at + 1, around.chain([back]));
        }
    }
    clip(&points, ring)
}

fn cross(a: Vec2, b: Vec2, c: Vec2) -> f32 {
    (b - a).perp_dot(c - a)
}

fn inside(p: Vec2, a: Vec2, b: Vec2, c: Vec2) -> bool {
    cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0
}

/// The position in `ring` of a corner that is seen from `tip`, looking right.
fn bridge(points: &[Vec2], ring: &[u32], tip: Vec2) -> Option<usize> {
    let at = |i: usize| points[ring[i % ring.len()] as usize];
    // The nearest edge that the ray meets.
    let mut best: Option<(f32, usize)> = None;
    for i in 0..ring.len() {
        let (a, b) = (at(i), at(i + 1));
        if a.y == b.y || tip.y < a.y.min(b.y) || tip.y > a.y.max(b.y) {
            continue;
        }
        let x = a.x + (b.x - a.x) * (tip.y - a.y) / (b.y - a.y);
        if x >= tip.x && best.is_none_or(|(nearest, _)| x < nearest) {
            best = Some((x, if a.x > b.x { i } else { (i + 1) % ring.len() }));
        }
    }
    let (x, mut chosen) = best?;
    // A corner inside the triangle tip, hit, candidate would block the way: take the one nearest in angle.
    let hit = Vec2::new(x, tip.y);
    let mut candidate = at(chosen);
    let flat = |p: Vec2| (p.y - tip.y).abs() / (p.x - tip.x).max(1e-12);
    for i in 0..ring.len() {
        let p = at(i);
        if p == candidate || p.x <= tip.x {
            continue;
        }
        let blocks = inside(p, tip, hit, candidate) || inside(p, tip, candidate, hit);
        if blocks && flat(p) < flat(candidate) {
            (chosen, candidate) = (i, p);
        }
    }
    Some(chosen)
}

fn clip(points: &[Vec2], mut ring: Vec<u32>) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(ring.len());
    let mut i = 0;
    let mut idle = 0;
    while ring.len() > 3 && idle <= ring.len() {
        let n = ring.len();
        i %= n;
        let [p, q, r] = [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]];
        let [a, b, c] = [p, q, r].map(|k| points[k as usize]);
        let ear = cross(a, b, c) > 0.0
            && ring.iter().all(|&k| {
                let s = points[k as usize];
                s == a || s == b || s == c || !inside(s, a, b, c)
            });
        if ear {
            triangles.push([p, q, r]);
            ring.remove(i);
            idle = 0;
            // Skipping a corner keeps the triangles from all fanning out of one.
            i += 1;
        } else {
            idle += 1;
            i += 1;
        }
    }
    if let [p, q, r] = ring[..] {
        triangles.push([p, q, r]);
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn circle(center: Vec2, radius: f32, count: usize, turn: f32) -> Vec<Vec2> {
        (0..count).map(|i| center + Vec2::from_angle(turn * TAU * i as f32 / count as f32) * radius).collect()
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
