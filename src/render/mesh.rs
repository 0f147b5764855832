//! Triangles for the bodies of a scene, made on the CPU.

mod block;
mod disk;
mod polygon;
mod tube;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::scene::{Color, Finish, Pose};

pub(super) use block::block;
pub(super) use disk::{Plates, add_mark, disk};
pub(super) use tube::tube;

/// A corner as `solid.wgsl` takes it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Vertex {
    pub position: [f32; 3],
    pub normal: [f32; 3],
    /// sRGB, straight alpha.
    pub color: [u8; 4],
    /// Metal, roughness, ghost, unused.
    pub material: [u8; 4],
}

const _: () = assert!(size_of::<Vertex>() == 32);

impl Vertex {
    pub(super) const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4],
    };
}

/// Triangles, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
}

impl Mesh {
    pub(super) fn clear(&mut self) {
        self.vertices.clear();
        self.indices.clear();
    }
}

/// Colour and material of a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paint {
    color: [u8; 4],
    material: [u8; 4],
}

impl Paint {
    pub(super) fn new(color: Color, finish: Finish) -> Self {
        let material = match finish {
            Finish::Matte => [0, 200, 0, 0],
            Finish::Satin => [0, 96, 0, 0],
            Finish::Metal => [255, 60, 0, 0],
            Finish::Ghost => [0, 255, 255, 0],
        };
        Self { color: color.to_bytes(), material }
    }
}

/// Adds triangles of one body, given in its own frame, to a mesh.
pub(super) struct Sink<'a> {
    mesh: &'a mut Mesh,
    pose: Pose,
    paint: Paint,
}

impl<'a> Sink<'a> {
    pub(super) fn new(mesh: &'a mut Mesh, pose: Pose, paint: Paint) -> Self {
        Self { mesh, pose, paint }
    }

    /// The index of the next vertex.
    fn next(&self) -> u32 {
        self.mesh.vertices.len() as u32
    }

    fn vertex(&mut self, position: Vec3, normal: Vec3) -> u32 {
        let index = self.next();
        self.mesh.vertices.push(Vertex {
            position: self.pose.point(position).to_array(),
            normal: (self.pose.rotation * normal).to_array(),
            color: self.paint.color,
            material: self.paint.material,
        });
        index
    }

    fn triangle(&mut self, corners: [u32; 3]) {
        self.mesh.indices.extend(corners);
    }

    /// Joins two rows of `count + 1` vertices, the last of which lies on the first: `upper` is left of the way along `lower`.
    fn band(&mut self, lower: u32, upper: u32, count: u32) {
        for i in 0..count {
            let (a, b) = (lower + i, lower + i + 1);
            let (c, d) = (upper + i, upper + i + 1);
            self.mesh.indices.extend([a, b, d, a, d, c]);
        }
    }

    /// A surface around z through `profile`, whose points are (radius, z) and normal (outward, up), ordered upward when
    /// the outside is away from the axis.
    fn lathe(&mut self, profile: &[[f32; 4]], sides: u32) {
        let mut last = None;
        for &[radius, z, out, up] in profile {
            let row = self.next();
            for i in 0..=sides {
                let (sin, cos) = angle(i, sides).sin_cos();
                self.vertex(Vec3::new(radius * cos, radius * sin, z), Vec3::new(out * cos, out * sin, up));
            }
            if let Some(last) = last {
                self.band(last, row, sides);
            }
            last = Some(row);
        }
    }
}

/// Direction `i` of `sides`; the last is exactly the first.
fn angle(i: u32, sides: u32) -> f32 {
    std::f32::consts::TAU * (i % sides) as f32 / sides as f32
}

/// The profile of a plate's rim with rounded edges, from bottom to top.
fn rounded_rim(radius: f32, half: f32, bevel: f32) -> Vec<[f32; 4]> {
    const STEPS: u32 = 4;
    let corner = |z: f32, from: f32| {
        (0..=STEPS).map(move |i| {
            let a = from + std::f32::consts::FRAC_PI_2 * i as f32 / STEPS as f32;
            let (sin, cos) = a.sin_cos();
            [radius - bevel + bevel * cos, z + bevel * sin, cos, sin]
        })
    };
    corner(-half + bevel, -std::f32::consts::FRAC_PI_2).chain(corner(half - bevel, 0.0)).collect()
}

#[cfg(test)]
pub(super) mod check {
    use super::*;

    /// Panics unless every edge is used once in each direction (after welding equal corners) and normals point the
    /// way the triangles face.
    pub fn closed_and_outward(mesh: &Mesh, grain: f32) {
        use std::collections::HashMap;
        let key = |i: u32| mesh.vertices[i as usize].position.map(|v| (v / grain).round() as i64);
        let mut edges: HashMap<_, i32> = HashMap::new();
        let mut backward = 0;
        for t in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| Vec3::from(mesh.vertices[i as usize].position));
            let face = (b - a).cross(c - a);
            let normal: Vec3 = t.iter().map(|&i| Vec3::from(mesh.vertices[i as usize].normal)).sum();
            if face.length() > 1e-13 && face.dot(normal) <= 0.0 {
                backward += 1;
            }
            let keys = [key(t[0]), key(t[1]), key(t[2])];
            for (p, q) in [(0, 1), (1, 2), (2, 0)] {
                if keys[p] != keys[q] {
                    *edges.entry((keys[p], keys[q])).or_default() += 1;
                    *edges.entry((keys[q], keys[p])).or_default() -= 1;
                }
            }
        }
        assert_eq!(backward, 0, "triangles that face inward");
        let open = edges.values().filter(|v| **v != 0).count();
        assert_eq!(open, 0, "open edges");
    }
}
