//! The robot's bodies: backbones and disks, and the ghosts of shapes that it does not have.

use crate::scene::palette::Palette;
use crate::scene::{Block, Cap, Color, Disk, Finish, Hole, Line, Mark, Pose, Scene, Solid, Tube, arc};
use centrode_core::run::Run;
use centrode_core::scenario::Robot;
use glam::{Quat, Vec2, Vec3};
use std::f32::consts::TAU;

/// Frames along a backbone: enough that no corner shows.
const FRAMES: usize = 48;

/// Sizes in m that the scenario leaves open, in proportion to those it gives.
#[derive(Debug, Clone)]
pub struct Proportions {
    /// Length of the segment.
    pub length: f32,
    /// Radius of the pitch circle.
    pub pitch: f32,
    /// Outer radius of a spacer disk.
    pub disk: f32,
    /// Radius of the beam.
    pub beam: f32,
    /// Outer radius of the primary backbone.
    pub primary: f32,
    /// Outer radius of each secondary backbone.
    pub secondary: f32,
    spacers: Vec<f32>,
    /// Height of the floor.
    pub floor: f32,
}

impl Proportions {
    /// Of the robot of a run.
    pub fn of(run: &Run) -> Self {
        Self::of_robot(&run.plan.scenario().robot, run.segment().length)
    }

    /// Of a robot whose backbone is truly this long, m.
    pub fn of_robot(robot: &Robot, length: f64) -> Self {
        let pitch = robot.pitch_radius as f32;
        let (primary, secondary) =
            (robot.primary.outer_diameter as f32 / 2.0, robot.secondary.outer_diameter as f32 / 2.0);
        let disk = pitch + (2.6 * secondary).max(0.3 * pitch);
        // On a backbone that is shorter than its model, disks may come to lie at its end.
        let spacers = robot.disks.iter().map(|&s| s.min(length) as f32).collect();
        Self { length: length as f32, pitch, disk, beam: 0.5 * pitch, primary, secondary, spacers, floor: -0.62 * disk }
    }

    /// Points around the base and around the end disk at `tip`: what a picture must hold of the robot in a shape.
    pub fn outline(&self, tip: &Pose) -> impl Iterator<Item = Vec3> {
        let foot = Pose::new(Vec3::Z * self.floor, Quat::IDENTITY);
        let end = Pose::new(tip.point(Vec3::Z * 0.3 * self.disk), tip.rotation);
        arc::circle(foot, 1.57 * self.disk, 12).into_iter().chain(arc::circle(end, self.disk, 12))
    }

    /// Whether a disk or the end disk stands at arc length `s` (m).
    pub fn at_disk(&self, s: f64) -> bool {
        self.spacers.iter().chain([&self.length]).any(|&disk| (disk - s as f32).abs() < 1e-6)
    }

    /// How far the robot's side is from its primary backbone at arc length `s` (m): a disk's rim, or a backbone.
    pub fn surface(&self, s: f64) -> f32 {
        if self.at_disk(s) { self.disk } else { self.pitch + self.secondary }
    }

    /// How far a disk's rim stands out from the backbones at arc length `s` (m); 0 between disks.
    pub fn rim(&self, s: f64) -> f32 {
        self.surface(s) - self.pitch - self.secondary
    }

    /// Radius of the thinnest bodies: the backbones.
    pub fn thin(&self) -> f32 {
        self.secondary
    }

    /// Thickness of a spacer disk.
    pub fn thickness(&self) -> f32 {
        0.17 * self.disk
    }

    /// How far backbones stand out beyond the end disk.
    pub fn standing_out(&self) -> f32 {
        1.6 * self.thickness()
    }

    /// The hole of the primary backbone, and those of secondary ones: angle on the pitch circle (rad) and radius (m) of each.
    pub fn holes(&self, secondary: impl IntoIterator<Item = (f32, f32)>) -> Vec<Hole> {
        let hole = |center, radius: f32| Hole { center, radius: 1.35 * radius };
        let on_pitch = secondary.into_iter().map(|(angle, radius)| hole(Vec2::from_angle(angle) * self.pitch, radius));
        std::iter::once(hole(Vec2::ZERO, self.primary)).chain(on_pitch).collect()
    }
}

/// Angles at which a segment's secondary backbones stand on the pitch circle if its first is at `offset`, rad.
pub fn around(offset: f32) -> [f32; 3] {
    [0.0, 1.0, 2.0].map(|i| offset + TAU * i / 3.0)
}

/// Base, disks, and the four backbones along `shape`.
pub fn robot(scene: &mut Scene, palette: &Palette, sizes: &Proportions, shape: impl Fn(f32) -> Pose) {
    let frames = arc::frames(Pose::IDENTITY, sizes.length, FRAMES, &shape);
    let frames = arc::extended(&frames, 0.0, sizes.standing_out());
    scene.tubes.push(backbone(&frames, Vec2::ZERO, sizes.primary, palette.steel_primary));
    for angle in around(0.0) {
        scene.tubes.push(backbone(&frames, Vec2::from_angle(angle) * sizes.pitch, sizes.secondary, palette.steel));
    }
    let holes = sizes.holes(around(0.0).map(|angle| (angle, sizes.secondary)));
    disks(scene, palette, sizes, &holes, &shape);
    base(scene, palette, sizes, &holes, shape(0.0));
}

/// A backbone that stands at a fixed point of these frames.
pub fn backbone(frames: &[Pose], at: Vec2, radius: f32, color: Color) -> Tube {
    Tube { path: arc::offset(frames, at), radius, color, finish: Finish::Metal, cap: Cap::Flat }
}

fn disk(palette: &Palette, pose: Pose, [radius, thickness]: [f32; 2], holes: &[Hole], alpha: f32) -> Disk {
    // The mark points along x of each disk, to backbone 1.
    let mark = Some(Mark { angle: 0.0, color: palette.mark });
    let color = palette.disk.alpha(alpha);
    Disk { pose, radius, thickness, holes: holes.to_vec(), mark, color, finish: Finish::Satin }
}

/// The spacer disks and the end disk of a segment.
pub fn disks(scene: &mut Scene, palette: &Palette, sizes: &Proportions, holes: &[Hole], shape: impl Fn(f32) -> Pose) {
    let thickness = sizes.thickness();
    let spacers = sizes.spacers.iter().map(|&s| disk(palette, shape(s), [sizes.disk, thickness], holes, 0.72));
    scene.disks.extend(spacers);
    scene.disks.push(disk(palette, shape(sizes.length), [sizes.disk, 1.7 * thickness], holes, 0.9));
}

/// The base disk and what it stands on.
pub fn base(scene: &mut Scene, palette: &Palette, sizes: &Proportions, holes: &[Hole], mut pose: Pose) {
    pose.position.z -= 0.1 * sizes.disk;
    scene.disks.push(disk(palette, pose, [1.24 * sizes.disk, 2.2 * sizes.thickness()], holes, 1.0));
    scene.blocks.push(Block {
        pose: Pose::new(Vec3::new(0.0, 0.0, -0.45 * sizes.disk), Quat::IDENTITY),
        solid: Solid::Cylinder { radius: 1.57 * sizes.disk, half_length: 0.17 * sizes.disk },
        bevel: 0.07 * sizes.disk,
        color: palette.disk.mix(Color::BLACK, 0.35),
        finish: Finish::Matte,
    });
}

/// A shape that the robot would have, as a ghost of this colour; its first secondary backbone stands at `offset` rad.
pub fn ghost(scene: &mut Scene, color: Color, sizes: &Proportions, offset: f32, shape: impl Fn(f32) -> Pose) {
    let frames = arc::frames(Pose::IDENTITY, sizes.length, FRAMES, &shape);
    for angle in around(offset) {
        scene.tubes.push(Tube {
            path: arc::offset(&frames, Vec2::from_angle(angle) * sizes.pitch),
            radius: sizes.secondary,
            color: color.alpha(0.45),
            finish: Finish::Ghost,
            cap: Cap::None,
        });
    }
    let line = |path, width| Line::new(path, width, color.alpha(0.85)).through(0.2);
    let center = line(arc::offset(&frames, Vec2::ZERO), 1.75);
    scene.lines.push(center.dashed(0.053 * sizes.length, 0.6));
    for &s in sizes.spacers.iter().chain([&sizes.length]) {
        scene.lines.push(line(arc::circle(shape(s), sizes.disk, 64), 1.25));
    }
}
