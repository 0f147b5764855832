//! The robot of several segments: thinner backbones toward the tip, those of distal segments beside or inside those of proximal ones.

use super::Instant;
use super::bent::Bent;
use crate::scene::{Color, Hole, Pose, Scene, arc};
use crate::show::robot::{around, backbone, base, disks};
use glam::Vec2;

/// How much brighter the primary backbone is than the secondary ones.
const PRIMARY: f32 = 0.45;

/// Base, disks and backbones.
pub fn robot(scene: &mut Scene, instant: &Instant<'_>) {
    for segment in 0..instant.sizes.len() {
        let (sizes, color) = (&instant.sizes[segment], steel(instant, segment));
        let own = arc::extended(instant.bent.frames(segment), 0.0, sizes.standing_out());
        scene.tubes.push(backbone(&own, Vec2::ZERO, sizes.primary, color.mix(Color::WHITE, PRIMARY)));
        // From the base on, through all segments below.
        let whole: Vec<Pose> = (0..=segment).flat_map(|below| instant.bent.frames(below).iter().copied()).collect();
        let whole = arc::extended(&whole, 0.0, sizes.standing_out());
        let tube = |angle| backbone(&whole, Vec2::from_angle(angle) * sizes.pitch, sizes.secondary, color);
        scene.tubes.extend(around(instant.offsets[segment]).map(tube));
        disks(scene, instant.palette, sizes, &holes(instant, segment), |s| {
            instant.bent.pose(segment, s / sizes.length)
        });
    }
    base(scene, instant.palette, &instant.sizes[0], &holes(instant, 0), Pose::IDENTITY);
}

/// The model that nothing touches, as a ghost.
pub fn ghost(scene: &mut Scene, instant: &Instant<'_>, free: &Bent) {
    for (segment, sizes) in instant.sizes.iter().enumerate() {
        let shape = |s| free.pose(segment, s / sizes.length);
        crate::show::robot::ghost(scene, instant.palette.model, sizes, instant.offsets[segment], shape);
    }
}

/// The colour of a segment's secondary backbones; one segment alone is as it always is.
fn steel(instant: &Instant<'_>, segment: usize) -> Color {
    let steels = &instant.palette.steels;
    if instant.sizes.len() == 1 { instant.palette.steel } else { steels[segment % steels.len()] }
}

/// Holes in the disks of a segment for its own backbones and those of all above.
fn holes(instant: &Instant<'_>, segment: usize) -> Vec<Hole> {
    let above = segment..instant.sizes.len();
    let secondary = above.flat_map(|k| around(instant.offsets[k]).map(|angle| (angle, instant.sizes[k].secondary)));
    instant.sizes[segment].holes(secondary)
}
