//! A beam in space, carried by a post behind the robot, and the force by which it pushes.

use super::load;
use super::obstacle::{Obstacle, Piece, Push};
use super::robot::Proportions;
use crate::scene::palette::Palette;
use crate::scene::{Block, Finish, Marker, Pose, Scene, Shape, Solid};
use centrode_core::model::contact::Planar;
use glam::{Quat, Vec3};

/// Length of the largest force's arrow, as part of the segment's.
pub const LARGEST: f32 = 0.4;
/// Ends of the bar along its axis, toward the viewer and away, and where its post stands, in radii of a disk.
const BAR: [f32; 2] = [-0.75, 3.0];
const POST: f32 = 2.6;
/// Opacity once the segment has got away from it.
const FAINT: f32 = 0.3;
/// Half the width of what is fixed to the bar, in radii of a disk.
pub const FITTING: f32 = 0.6;
/// The post stands at least so far beyond that, in radii of a disk.
const BEYOND: f32 = 1.0;

/// A beam in space.
pub struct Beam<'a> {
    /// Its cross-section.
    pub obstacle: &'a Obstacle,
    /// Sizes of the robot.
    pub sizes: &'a Proportions,
    /// The plane of that cross-section: x and z as there, y along the beam.
    pub section: Pose,
    /// On which side along y its post stands, away from the viewer: +1 or −1.
    pub away: f32,
    /// How far what is fixed to it reaches along y: toward the viewer and away, m.
    pub reach: [f32; 2],
    /// Whether it is drawn as faint as something that is in nobody's way: the segment has got away from it, or it stands there only later.
    pub faint: bool,
}

impl Beam<'_> {
    /// A point of the cross-section's plane (m), and from there `away` m along the beam, from the viewer.
    fn point(&self, at: Planar, away: f32) -> Vec3 {
        self.section.point(Vec3::new(at.x as f32, self.away * away, at.y as f32))
    }

    /// x across the backbone as it was met, y along the beam, z along the backbone.
    fn frame(&self) -> Quat {
        self.section.rotation * Quat::from_rotation_y(self.obstacle.slope as f32)
    }

    /// Its bodies, and a mark where it touches the robot now, if it does.
    pub fn draw(&self, scene: &mut Scene, palette: &Palette, touching: Option<Vec3>) {
        let (disk, floor, usual) = (self.sizes.disk, self.sizes.floor, self.sizes.beam);
        let block = |position, rotation, solid| Block {
            pose: Pose::new(position, rotation),
            solid,
            bevel: 0.2 * usual,
            color: if self.faint { palette.stone.alpha(FAINT) } else { palette.stone },
            finish: Finish::Matte,
        };
        let across = self.frame() * Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
        let (center, rod) = (self.obstacle.bar.0, self.obstacle.bar.1 as f32);
        // What is fixed to the bar hides its front end.
        let bare = self.obstacle.fittings.is_empty();
        let front = if bare { BAR[0] * disk } else { 0.8 * self.reach[0] };
        let post = if bare { POST * disk } else { (POST * disk).max(self.reach[1] + BEYOND * disk) };
        let back = post + (BAR[1] - POST) * disk;
        for piece in self.obstacle.pieces() {
            scene.blocks.push(match piece {
                Piece::Round { center, radius } => {
                    let solid = Solid::Cylinder { radius: radius as f32, half_length: 0.5 * (back - front) };
                    block(self.point(center, 0.5 * (front + back)), across, solid)
                }
                Piece::Bar { center, half } => {
                    let [near, far] = self.reach;
                    let half = Vec3::new(half[0] as f32, 0.5 * (far - near), half[1] as f32);
                    block(self.point(center, 0.5 * (near + far)), self.frame(), Solid::Box { half })
                }
            });
        }
        let top = self.point(center, post);
        // A rod thicker than the post ends it.
        let above = if rod > usual { 0.0 } else { 1.5 * usual };
        let half_height = 0.5 * (top.z + above - floor).max(0.0);
        let on_floor = |height: f32| Vec3::new(top.x, top.y, floor + height);
        let standing =
            |radius, half_length| block(on_floor(half_length), Quat::IDENTITY, Solid::Cylinder { radius, half_length });
        scene.blocks.extend([standing(0.95 * usual, half_height), standing(2.1 * usual, 0.2 * usual)]);
        if let Some(ground) = &mut scene.ground {
            ground.contacts.push([top.x, top.y, 3.0 * usual, 0.4]);
        }
        if let Some(at) = touching {
            scene.markers.push(Marker::new(at, Shape::Ring, 15.0, palette.ink).faded(0.7).through(0.7).lifted(disk));
        }
    }

    /// Where it touches the robot while it holds it: where it pushes, or for a clamp where the rim was met.
    pub fn touching(&self, push: Option<&Push>, surface: f64) -> Vec3 {
        let met = self.frame() * Vec3::X * (self.obstacle.side * surface) as f32;
        push.map_or_else(|| self.point(self.obstacle.touches, 0.0) + met, |push| self.point(push.at, 0.0))
    }

    /// The force as an arrow that ends where it acts on the robot, with its size.
    pub fn force(&self, scene: &mut Scene, palette: &Palette, push: &Push, length: f32) {
        let whole = LARGEST * length;
        let end = self.point(push.at, 0.0);
        let start = self.point(push.at - push.along * (f64::from(whole) * push.share), 0.0);
        load::force(scene, palette, [start, end], (whole, 1.5 * self.sizes.disk), push.words());
    }
}
