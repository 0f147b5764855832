//! A scene turned into what the GPU draws: one mesh and two lists of instances.

use std::ops::Range;

use glam::Vec3;

use super::{
    mesh::{self, Mesh, Plates},
    overlay::{self, Piece, Sign},
    uniforms::Ball,
};
use crate::scene::{Finish, Scene};

/// A translucent body: drawn by itself, the farthest first.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub indices: Range<u32>,
    pub center: Vec3,
}

/// CPU side of a view's geometry; reused from frame to frame.
#[derive(Default)]
pub(super) struct Batch {
    pub mesh: Mesh,
    /// The indices of opaque bodies come first.
    pub opaque: u32,
    /// Then those of translucent bodies that cast a shadow, up to here.
    pub casting: u32,
    /// Every translucent body, ghosts too.
    pub parts: Vec<Part>,
    pub pieces: Vec<Piece>,
    pub signs: Vec<Sign>,
    /// Around everything that casts a shadow.
    pub casters: Option<Ball>,
    plates: Plates,
}

/// In the order in which they lie in the mesh.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Layer {
    Opaque,
    Translucent,
    Ghost,
}

fn layer(alpha: f32, finish: Finish) -> Layer {
    match finish {
        Finish::Ghost => Layer::Ghost,
        _ if alpha < 0.999 => Layer::Translucent,
        _ => Layer::Opaque,
    }
}

impl Batch {
    /// Replaces the content.
    pub(super) fn fill(&mut self, scene: &Scene) {
        self.mesh.clear();
        self.parts.clear();
        self.pieces.clear();
        self.signs.clear();

        self.add(scene, Layer::Opaque);
        self.opaque = self.mesh.indices.len() as u32;
        self.add(scene, Layer::Translucent);
        self.casting = self.mesh.indices.len() as u32;
        self.casters = ball(&self.mesh);
        self.add(scene, Layer::Ghost);
        self.plates.sweep();

        for line in &scene.lines {
            overlay::line(&mut self.pieces, line);
        }
        for marker in &scene.markers {
            overlay::marker(&mut self.signs, marker);
        }
    }

    fn add(&mut self, scene: &Scene, wanted: Layer) {
        let Self { mesh, parts, plates, .. } = self;
        let mut body = |mesh: &mut Mesh, draw: &mut dyn FnMut(&mut Mesh)| {
            let (vertices, indices) = (mesh.vertices.len(), mesh.indices.len() as u32);
            draw(mesh);
            let new = &mesh.vertices[vertices..];
            if wanted != Layer::Opaque && !new.is_empty() {
                let sum: Vec3 = new.iter().map(|v| Vec3::from(v.position)).sum();
                parts.push(Part { indices: indices..mesh.indices.len() as u32, center: sum / new.len() as f32 });
            }
        };
        for tube in &scene.tubes {
            if layer(tube.color.a, tube.finish) == wanted {
                body(mesh, &mut |mesh| mesh::tube(mesh, tube));
            }
        }
        for disk in &scene.disks {
            if layer(disk.color.a, disk.finish) == wanted {
                body(mesh, &mut |mesh| mesh::disk(mesh, plates, disk));
            }
            if let Some(mark) = disk.mark
                && layer(mark.color.a, Finish::Matte) == wanted
            {
                body(mesh, &mut |mesh| mesh::add_mark(mesh, disk));
            }
        }
        for block in &scene.blocks {
            if layer(block.color.a, block.finish) == wanted {
                body(mesh, &mut |mesh| mesh::block(mesh, block));
            }
        }
    }

    /// Sorts the translucent bodies for a viewer at `eye`.
    pub(super) fn sort(&mut self, eye: Vec3) {
        self.parts.sort_by(|a, b| {
            let away = |p: &Part| p.center.distance_squared(eye);
            away(b).total_cmp(&away(a))
        });
    }
}

/// A ball around all vertices, with a little room.
fn ball(mesh: &Mesh) -> Option<Ball> {
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    for v in &mesh.vertices {
        let p = Vec3::from(v.position);
        low = low.min(p);
        high = high.max(p);
    }
    let radius = 0.515 * (high - low).length();
    (radius > 0.0 && radius.is_finite()).then(|| Ball { center: 0.5 * (low + high), radius })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Block, Color, Disk, Line, Marker, Pose, Shape, Solid, Tube};
    use glam::{Quat, Vec2};

    /// Some of everything: an opaque tube, two translucent plates, a box, a ghost, a line and a marker.
    fn some() -> Scene {
        let up = |z: f32| Pose::new(Vec3::Z * z, Quat::IDENTITY);
        let tube = |finish, x: f32| Tube {
            path: vec![Vec3::X * x, Vec3::new(x, 0.0, 0.03)],
            radius: 0.0005,
            color: Color::WHITE.alpha(if finish == Finish::Ghost { 0.5 } else { 1.0 }),
            finish,
            cap: Default::default(),
        };
        let disk = |z| Disk {
            pose: up(z),
            radius: 0.004,
            thickness: 0.001,
            holes: vec![crate::scene::Hole { center: Vec2::ZERO, radius: 0.001 }],
            mark: None,
            color: Color::WHITE.alpha(0.7),
            finish: Finish::Satin,
        };
        Scene {
            tubes: vec![tube(Finish::Ghost, 0.01), tube(Finish::Metal, 0.0)],
            disks: vec![disk(0.01), disk(0.03)],
            blocks: vec![Block {
                pose: up(0.0),
                solid: Solid::Box { half: Vec3::splat(0.002) },
                bevel: 0.0,
                color: Color::BLACK,
                finish: Finish::Matte,
            }],
            lines: vec![Line::new(vec![Vec3::ZERO, Vec3::X], 1.0, Color::WHITE)],
            markers: vec![Marker::new(Vec3::ZERO, Shape::Dot, 5.0, Color::WHITE)],
            ..Scene::default()
        }
    }

    #[test]
    fn layers_lie_in_order_and_refilling_changes_nothing() {
        let scene = some();
        let mut batch = Batch::default();
        batch.fill(&scene);
        let first = (batch.mesh.indices.clone(), batch.pieces.len(), batch.signs.len());
        assert!(0 < batch.opaque && batch.opaque < batch.casting);
        assert!(batch.casting < batch.mesh.indices.len() as u32);
        assert_eq!(batch.parts.first().unwrap().indices.start, batch.opaque);
        assert!(batch.parts.windows(2).all(|w| w[0].indices.end == w[1].indices.start));
        batch.fill(&scene);
        assert_eq!(first, (batch.mesh.indices.clone(), batch.pieces.len(), batch.signs.len()));
        let casters = batch.casters.unwrap();
        assert!(casters.radius > 0.01 && casters.radius < 0.05);
    }

    #[test]
    fn the_farthest_is_drawn_first() {
        let mut batch = Batch::default();
        batch.fill(&some());
        let eye = Vec3::new(0.05, -0.1, 0.04);
        batch.sort(eye);
        assert!(batch.parts.windows(2).all(|w| { w[0].center.distance(eye) >= w[1].center.distance(eye) }));
    }

    #[test]
    fn nothing_is_drawn_of_nothing() {
        let mut batch = Batch::default();
        batch.fill(&Scene::default());
        assert!(batch.mesh.indices.is_empty() && batch.casters.is_none());
    }
}
