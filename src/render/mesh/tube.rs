//! Tubes.

use glam::{Quat, Vec3};

use super::{Mesh, Paint, Sink, angle};
use crate::scene::{Cap, Pose, Tube};

/// Sides around a tube.
const SIDES: u32 = 14;
/// Rings of a round end.
const RINGS: u32 = 4;

/// Adds a tube.
pub(in crate::render) fn tube(mesh: &mut Mesh, tube: &Tube) {
    let path = walkable(&tube.path);
    if path.len() < 2 || !(tube.radius > 0.0 && tube.radius.is_finite()) {
        return;
    }
    let mut sink = Sink::new(mesh, Pose::IDENTITY, Paint::new(tube.color, tube.finish));
    let rings = rings(&path);
    let mut last = None;
    for &(center, rotation) in &rings {
        let row = sink.next();
        ring(&mut sink, center, rotation, tube.radius, 0.0);
        if let Some(last) = last {
            sink.band(last, row, SIDES);
        }
        last = Some(row);
    }
    let first = rings[0];
    let back = Quat::from_rotation_x(std::f32::consts::PI);
    end(&mut sink, first.0, first.1 * back, tube);
    let last = rings[rings.len() - 1];
    end(&mut sink, last.0, last.1, tube);
}

/// The points without those that repeat or are not numbers.
fn walkable(path: &[Vec3]) -> Vec<Vec3> {
    let mut points: Vec<Vec3> = Vec::with_capacity(path.len());
    for &p in path.iter().filter(|p| p.is_finite()) {
        if points.last().is_none_or(|q| q.distance_squared(p) > 1e-14) {
            points.push(p);
        }
    }
    points
}

/// A frame at each point whose z follows the path and which does not twist about it.
fn rings(path: &[Vec3]) -> Vec<(Vec3, Quat)> {
    let direction = |i: usize| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(path.len() - 1));
        (path[after] - path[before])
            .try_normalize()
            .or_else(|| (path[after] - path[i]).try_normalize())
            .unwrap_or(Vec3::Z)
    };
    let mut along = direction(0);
    let mut rotation = Quat::from_rotation_arc(Vec3::Z, along);
    let mut rings = Vec::with_capacity(path.len());
    for (i, &p) in path.iter().enumerate() {
        let next = direction(i);
        rotation = (Quat::from_rotation_arc(along, next) * rotation).normalize();
        along = next;
        rings.push((p, rotation));
    }
    rings
}

/// One ring of vertices, `lean` being the angle of its normals out of its plane.
fn ring(sink: &mut Sink<'_>, center: Vec3, rotation: Quat, radius: f32, lean: f32) {
    let (up, out) = lean.sin_cos();
    for i in 0..=SIDES {
        let (sin, cos) = angle(i, SIDES).sin_cos();
        let outward = Vec3::new(cos, sin, 0.0);
        sink.vertex(center + rotation * (outward * radius), rotation * (outward * out + Vec3::Z * up));
    }
}

fn end(sink: &mut Sink<'_>, center: Vec3, rotation: Quat, tube: &Tube) {
    let axis = rotation * Vec3::Z;
    match tube.cap {
        Cap::None => {}
        Cap::Flat => {
            let middle = sink.vertex(center, axis);
            let row = sink.next();
            ring(sink, center, rotation, tube.radius, std::f32::consts::FRAC_PI_2);
            for i in 0..SIDES {
                sink.triangle([row + i, row + i + 1, middle]);
            }
        }
        Cap::Round => {
            let mut last = None;
            for i in 0..=RINGS {
                let lean = std::f32::consts::FRAC_PI_2 * i as f32 / RINGS as f32;
                let row = sink.next();
                let at = center + axis * (tube.radius * lean.sin());
                ring(sink, at, rotation, tube.radius * lean.cos(), lean);
                if let Some(last) = last {
                    sink.band(last, row, SIDES);
                }
                last = Some(row);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::scene::{Color, Finish};

    fn bent(cap: Cap) -> Tube {
        let path = (0..=20).map(|i| 0.075 * i as f32).map(|turned| {
            let aside = 0.02 * (1.0 - turned.cos());
            Vec3::new(aside, 0.3 * aside, 0.02 * turned.sin())
        });
        Tube { path: path.collect(), radius: 0.0004, color: Color::WHITE, finish: Finish::Metal, cap }
    }

    #[test]
    fn a_capped_tube_is_closed() {
        for cap in [Cap::Flat, Cap::Round] {
            let mut mesh = Mesh::default();
            tube(&mut mesh, &bent(cap));
            check::closed_and_outward(&mesh, 2e-8);
        }
    }

    #[test]
    fn odd_paths_draw_what_can_be_drawn() {
        let mut odd = bent(Cap::Flat);
        odd.path.insert(3, Vec3::NAN);
        odd.path.insert(7, odd.path[6]);
        let mut mesh = Mesh::default();
        tube(&mut mesh, &odd);
        assert!(mesh.vertices.iter().all(|v| v.position.iter().chain(&v.normal).all(|x| x.is_finite())));
        assert!(!mesh.indices.is_empty());

        // A path that turns back on itself must not give NaN.
        odd.path = vec![Vec3::ZERO, Vec3::Z, Vec3::ZERO];
        tube(&mut mesh, &odd);
        assert!(mesh.vertices.iter().all(|v| v.normal.iter().all(|x| x.is_finite())));

        let mut mesh = Mesh::default();
        for path in [vec![], vec![Vec3::ONE], vec![Vec3::ONE; 5]] {
            tube(&mut mesh, &Tube { path, ..bent(Cap::Round) });
        }
        tube(&mut mesh, &Tube { radius: f32::NAN, ..bent(Cap::Flat) });
        assert!(mesh.vertices.is_empty());
    }
}
