//! Boxes and cylinders with rounded edges.

use glam::Vec3;

use super::{Mesh, Paint, Sink, rounded_rim};
use crate::scene::{Block, Solid};

const SIDES: u32 = 64;

/// Adds a block.
pub(in crate::render) fn block(mesh: &mut Mesh, block: &Block) {
    let pose = block.pose;
    if !(pose.position.is_finite() && pose.rotation.is_finite()) {
        return;
    }
    let mut sink = Sink::new(mesh, pose, Paint::new(block.color, block.finish));
    let bevel = if block.bevel > 0.0 { block.bevel } else { 0.0 };
    match block.solid {
        Solid::Box { half } => rounded_box(&mut sink, half.abs(), bevel),
        Solid::Cylinder { radius, half_length } => cylinder(&mut sink, radius.abs(), half_length.abs(), bevel),
    }
}

fn cylinder(sink: &mut Sink<'_>, radius: f32, half: f32, bevel: f32) {
    if !(radius > 0.0 && half > 0.0 && (radius + half).is_finite()) {
        return;
    }
    let bevel = bevel.min(0.5 * radius).min(half);
    let inner = radius - bevel;
    let mut profile = vec![[0.0, -half, 0.0, -1.0], [inner, -half, 0.0, -1.0]];
    profile.extend(rounded_rim(radius, half, bevel));
    profile.extend([[inner, half, 0.0, 1.0], [0.0, half, 0.0, 1.0]]);
    sink.lathe(&profile, SIDES);
}

/// A grid on each side, its points pulled to the rounded surface: what lies beyond the inner box by less than the
/// bevel goes onto a ball around the inner box's nearest point.
fn rounded_box(sink: &mut Sink<'_>, half: Vec3, bevel: f32) {
    if !(half.min_element() > 0.0 && half.is_finite()) {
        return;
    }
    let bevel = bevel.min(half.min_element());
    let inner = half - Vec3::splat(bevel);
    let steps = if bevel > 0.0 { 4 } else { 0 };
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    for side in 0..6 {
        let (w, sign) = (side / 2, if side % 2 == 0 { 1.0 } else { -1.0 });
        let (u, v) = ((w + 1) % 3, (w + 2) % 3);
        // Turning one direction with the sign keeps the face counter-clockwise from outside.
        let (across, up) = (axes[u] * sign, axes[v]);
        let columns = stations(inner[u], bevel, steps);
        let rows = stations(inner[v], bevel, steps);
        let start = sink.next();
        for &y in &rows {
            for &x in &columns {
                let on_cube = axes[w] * (sign * half[w]) + across * x + up * y;
                let core = on_cube.clamp(-inner, inner);
                let normal = (on_cube - core).try_normalize().unwrap_or(axes[w] * sign);
                sink.vertex(core + normal * bevel, normal);
            }
        }
        let width = columns.len() as u32;
        for row in 0..rows.len() as u32 - 1 {
            for column in 0..width - 1 {
                let a = start + row * width + column;
                sink.triangle([a, a + 1, a + width + 1]);
                sink.triangle([a, a + width + 1, a + width]);
            }
        }
    }
}

/// Grid positions along one axis: dense over both rounded edges, spaced so that the angles come out even.
fn stations(inner: f32, bevel: f32, steps: u32) -> Vec<f32> {
    let edge: Vec<f32> = (0..=steps)
        .map(|i| {
            let t = if steps == 0 { 0.0 } else { i as f32 / steps as f32 };
            inner + bevel * (t * std::f32::consts::FRAC_PI_4).tan()
        })
        .collect();
    edge.iter().rev().map(|x| -x).chain(edge.iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::scene::{Color, Finish, Pose};
    use glam::Quat;

    fn made(solid: Solid, bevel: f32) -> Mesh {
        let mut mesh = Mesh::default();
        let pose = Pose::new(Vec3::new(0.1, 0.2, 0.3), Quat::from_rotation_y(0.7));
        block(&mut mesh, &Block { pose, solid, bevel, color: Color::WHITE, finish: Finish::Matte });
        mesh
    }

    #[test]
    fn blocks_are_closed() {
        let half = Vec3::new(0.3, 0.5, 0.2);
        for bevel in [0.0, 0.05, 9.0] {
            check::closed_and_outward(&made(Solid::Box { half }, bevel), 1e-5);
            let cylinder = Solid::Cylinder { radius: 0.3, half_length: 0.4 };
            check::closed_and_outward(&made(cylinder, bevel), 1e-5);
        }
    }

    #[test]
    fn nonsense_draws_nothing() {
        for half in [Vec3::ZERO, Vec3::NAN, Vec3::splat(f32::INFINITY)] {
            assert!(made(Solid::Box { half }, 0.1).indices.is_empty());
        }
        let cylinder = Solid::Cylinder { radius: f32::NAN, half_length: 1.0 };
        assert!(made(cylinder, f32::NAN).indices.is_empty());
    }
}
