//! Plates with holes.

use glam::{Quat, Vec2, Vec3};

use super::{Mesh, Paint, Sink, angle, block, polygon::triangulate, rounded_rim};
use crate::scene::{Block, Disk, Finish, Hole, Pose, Solid};

/// Corners of the outline and of a hole.
const SIDES: u32 = 72;
const HOLE_SIDES: u32 = 24;

/// The face of a plate: its corners and triangles depend on the plan alone, which does not change while a robot moves.
struct Plate {
    radius: f32,
    asked: Vec<Hole>,
    holes: Vec<Hole>,
    corners: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
    used: bool,
}

/// Faces already triangulated. Those that the last scene did not need are forgotten.
#[derive(Default)]
pub(in crate::render) struct Plates(Vec<Plate>);

impl Plates {
    /// Forgets what has not been used since the last call.
    pub(in crate::render) fn sweep(&mut self) {
        self.0.retain_mut(|p| std::mem::take(&mut p.used));
    }

    fn get(&mut self, radius: f32, holes: &[Hole]) -> &Plate {
        let known = self.0.iter().position(|p| p.radius == radius && p.asked == holes);
        let index = known.unwrap_or_else(|| {
            self.0.push(Plate::new(radius, holes));
            self.0.len() - 1
        });
        let plate = &mut self.0[index];
        plate.used = true;
        plate
    }
}

impl Plate {
    fn new(radius: f32, asked: &[Hole]) -> Self {
        let holes = apart(radius, asked);
        let ring = |center: Vec2, radius: f32, count: u32, turn: f32| -> Vec<Vec2> {
            (0..count).map(|i| center + Vec2::from_angle(turn * angle(i, count)) * radius).collect()
        };
        let outer = ring(Vec2::ZERO, radius, SIDES, 1.0);
        let inner: Vec<_> = holes.iter().map(|h| ring(h.center, h.radius, HOLE_SIDES, -1.0)).collect();
        Self {
            radius,
            asked: asked.to_vec(),
            triangles: triangulate(&outer, &inner),
            corners: outer.into_iter().chain(inner.into_iter().flatten()).collect(),
            holes,
            used: false,
        }
    }
}

/// The holes that lie inside the disk and apart from those before them.
fn apart(radius: f32, asked: &[Hole]) -> Vec<Hole> {
    let mut kept: Vec<Hole> = Vec::new();
    for &hole in asked {
        let sound = hole.radius > 0.0 && hole.center.length() + hole.radius < 0.98 * radius;
        let free = kept.iter().all(|k| k.center.distance(hole.center) > 1.02 * (k.radius + hole.radius));
        if sound && free {
            kept.push(hole);
        }
    }
    kept
}

/// Adds a disk without its mark.
pub(in crate::render) fn disk(mesh: &mut Mesh, plates: &mut Plates, disk: &Disk) {
    if !sound(disk) {
        return;
    }
    let half = 0.5 * disk.thickness;
    let bevel = (0.22 * disk.thickness).min(0.1 * disk.radius);
    let face = disk.radius - bevel;
    let mut sink = Sink::new(mesh, disk.pose, Paint::new(disk.color, disk.finish));
    let plate = plates.get(face, &disk.holes);

    // The walls of the holes first: in a translucent disk the faces then lie over them.
    for hole in &plate.holes {
        let mut last = None;
        for z in [-half, half] {
            let row = sink.next();
            for i in 0..=HOLE_SIDES {
                // The same directions as the face's corners, so that no crack opens.
                let out = Vec2::from_angle(-angle(i, HOLE_SIDES));
                sink.vertex((hole.center + out * hole.radius).extend(z), (-out).extend(0.0));
            }
            if let Some(last) = last {
                sink.band(last, row, HOLE_SIDES);
            }
            last = Some(row);
        }
    }
    sink.lathe(&rounded_rim(disk.radius, half, bevel), SIDES);
    for up in [1.0, -1.0] {
        let start = sink.next();
        for corner in &plate.corners {
            sink.vertex(corner.extend(up * half), Vec3::Z * up);
        }
        for &[a, b, c] in &plate.triangles {
            let [a, b, c] = if up > 0.0 { [a, b, c] } else { [a, c, b] };
            sink.triangle([start + a, start + b, start + c]);
        }
    }
}

/// The mark of a disk as a block of its own: it keeps clear of the holes and stands out a little on all sides.
pub(in crate::render) fn mark(disk: &Disk) -> Option<Block> {
    let mark = disk.mark?;
    if !sound(disk) || !mark.angle.is_finite() {
        return None;
    }
    let radius = disk.radius;
    let half_width = 0.085 * radius;
    let toward = Vec2::from_angle(mark.angle);
    let clear = apart(radius, &disk.holes)
        .iter()
        .filter(|h| h.center.perp_dot(toward).abs() < h.radius + half_width)
        .filter(|h| h.center.dot(toward) > 0.0)
        .map(|h| h.center.dot(toward) + h.radius + 0.03 * radius)
        .fold(0.62 * radius, f32::max)
        .min(0.93 * radius);
    let end = 1.025 * radius;
    let half = Vec3::new(0.5 * (end - clear), half_width, 0.5 * disk.thickness + 0.012 * radius);
    let turned = Pose::new((toward * (0.5 * (clear + end))).extend(0.0), Quat::from_rotation_z(mark.angle));
    Some(Block {
        pose: disk.pose.then(&turned),
        solid: Solid::Box { half },
        bevel: 0.012 * radius,
        color: mark.color,
        finish: Finish::Matte,
    })
}

/// Adds a disk's mark, if it has one.
pub(in crate::render) fn add_mark(mesh: &mut Mesh, disk: &Disk) {
    if let Some(mark) = mark(disk) {
        block(mesh, &mark);
    }
}

fn sound(disk: &Disk) -> bool {
    let sizes = disk.radius > 0.0 && disk.thickness > 0.0;
    sizes
        && (disk.radius + disk.thickness).is_finite()
        && disk.pose.position.is_finite()
        && disk.pose.rotation.is_finite()
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::scene::{Color, Mark, arc};

    fn plate(holes: Vec<Hole>) -> Disk {
        Disk {
            pose: Pose::new(Vec3::new(0.01, 0.0, 0.02), Quat::from_rotation_y(0.5)),
            radius: 0.0042,
            thickness: 0.0008,
            holes,
            mark: Some(Mark { angle: 0.3, color: Color::BLACK }),
            color: Color::WHITE,
            finish: Finish::Satin,
        }
    }

    fn four() -> Vec<Hole> {
        std::iter::once(Vec2::ZERO)
            .chain((0..3).map(|i| arc::pitch_point(0.003, i, 3)))
            .map(|center| Hole { center, radius: 0.0006 })
            .collect()
    }

    #[test]
    fn a_plate_with_holes_is_closed() {
        for holes in [vec![], four()] {
            let mut mesh = Mesh::default();
            disk(&mut mesh, &mut Plates::default(), &plate(holes));
            check::closed_and_outward(&mesh, 5e-8);
        }
    }

    #[test]
    fn holes_that_cannot_be_are_left_out() {
        let mut holes = four();
        holes.extend([
            holes[1],
            Hole { center: Vec2::X * 0.004, radius: 0.0006 },
            Hole { center: Vec2::NAN, radius: 0.1 },
        ]);
        assert_eq!(apart(0.0042, &holes), four());
    }

    #[test]
    fn faces_are_reused_and_forgotten() {
        let mut plates = Plates::default();
        let mut mesh = Mesh::default();
        for _ in 0..3 {
            disk(&mut mesh, &mut plates, &plate(four()));
            plates.sweep();
            assert_eq!(plates.0.len(), 1);
        }
        plates.sweep();
        assert!(plates.0.is_empty());
    }

    #[test]
    fn the_mark_keeps_clear_of_the_holes() {
        let mut disk = plate(four());
        disk.pose = Pose::IDENTITY;
        disk.mark = Some(Mark { angle: 0.0, color: Color::BLACK });
        let block = mark(&disk).unwrap();
        let Solid::Box { half } = block.solid else { panic!("a box") };
        assert!(block.pose.position.x - half.x > 0.0036);
        assert!(block.pose.position.x + half.x > disk.radius);
    }
}
