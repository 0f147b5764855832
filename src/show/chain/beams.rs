//! What the backbone meets, and the forces by which it is pushed.

use super::{Instant, Proportions};
use crate::scene::{Pose, Scene};
use crate::show::beam::{self, Beam};
use crate::show::obstacle::{Met, Obstacle};
use crate::show::{load, scene_pose, scene_vector};
use centrode_core::model::Vec3 as Vector;
use centrode_core::model::chain::path::What;
use centrode_core::model::contact::Planar;
use centrode_core::scenario::chain::{ChainContact, Stands};
use centrode_core::study::chain::ChainRun;
use glam::{Mat3, Quat, Vec3};
use std::f32::consts::FRAC_PI_4;

/// A bar lies across the backbone, but as level as this angle off that allows, rad.
const LEVELLED: f32 = FRAC_PI_4;
/// How far the bar's post stands from the backbone, in radii of a disk: it must be above the floor there.
const REACH: f32 = 3.0;

/// Something that the backbone meets, where it stands.
struct Standing {
    /// Since when, s.
    since: f64,
    /// The backbone as it meets it.
    pose: Pose,
    /// Away from the robot's side.
    normal: Vec3,
    is_clamp: bool,
}

/// All beams, pale before they stand, and the forces of those that press.
pub fn beams(scene: &mut Scene, run: &ChainRun, instant: &Instant<'_>, backward: Vec3) {
    let largest = largest(run);
    let total: f32 = instant.sizes.iter().map(|sizes| sizes.length).sum();
    let whole = beam::LARGEST * total / (instant.sizes.len() as f32).sqrt();
    for (place, contact) in run.plan.scenario().contacts.iter().enumerate() {
        let sizes = &instant.sizes[contact.segment];
        let at = contact.at.min(f64::from(sizes.length));
        let Some(standing) = standing(run, instant, place, contact) else { continue };
        let (surface, rim) = (sizes.surface(at), sizes.rim(at));
        let obstacle = obstacle(sizes, surface, rim, standing.is_clamp);
        let section = section(&standing);
        let away = away(&section, backward, sizes);
        let beam = Beam { obstacle: &obstacle, sizes, section, away, faint: instant.time < standing.since };
        let touches = instant.on(contact.segment, at).position + standing.normal * surface;
        let presses = instant.truth.active.contains(&place);
        beam.draw(scene, instant.palette, presses.then_some(touches));
        let force = instant.truth.forces[place];
        if presses && force > 0.0 {
            let start = touches + standing.normal * (whole * (force / largest) as f32);
            let text = format!("{force:.2} N");
            load::force(scene, instant.palette, [start, touches], (whole, 1.5 * sizes.disk), text);
        }
    }
}

/// The largest force of the run, N.
fn largest(run: &ChainRun) -> f64 {
    let forces = run.recording.truth.iter().flatten().flat_map(|truth| &truth.forces);
    forces.copied().fold(f64::MIN_POSITIVE, f64::max)
}

/// Where something stands; none of what never came to stand before the run's end.
fn standing(run: &ChainRun, instant: &Instant<'_>, place: usize, contact: &ChainContact) -> Option<Standing> {
    let (plan, path) = (&run.plan, run.plan.path());
    let since = match contact.stands {
        Stands::From { time, .. } | Stands::Clamped { time } => Some(time).filter(|time| *time <= path.end())?,
        // It always stands, and is drawn where it is met.
        Stands::Always { .. } => {
            let met = path.happened().iter().find(|event| event.what == What::Met(place));
            met.map_or(path.end(), |event| event.time)
        }
    };
    let at = contact.at.min(f64::from(instant.sizes[contact.segment].length));
    let mut pose = scene_pose(&path.pose(since, &plan.bends(since), contact.segment, at));
    let Some((normal, offset)) = path.plane(place) else {
        // A clamp: from where the segment bends to.
        let (sin, cos) = plan.command(contact.segment, since).0.sin_cos_delta();
        let normal = pose.rotation * scene_vector(&Vector::new(cos, -sin, 0.0));
        return Some(Standing { since, pose, normal, is_clamp: true });
    };
    let normal = scene_vector(&normal);
    pose.position += normal * (offset as f32 - normal.dot(pose.position));
    let since = if matches!(contact.stands, Stands::Always { .. }) { 0.0 } else { since };
    Some(Standing { since, pose, normal, is_clamp: false })
}

/// The cross-section of a beam in its own plane: its normal along x, the backbone along z as it was met.
fn obstacle(sizes: &Proportions, surface: f32, rim: f32, is_clamp: bool) -> Obstacle {
    let (surface, rim) = (f64::from(surface), f64::from(rim));
    let met = Met { touches: Planar::zeros(), slope: 0.0, side: 1.0, surface, rim };
    if is_clamp { met.jaws(sizes) } else { met.plate(sizes) }
}

/// The plane of the cross-section: the bar lies across the backbone, as level as that allows.
fn section(standing: &Standing) -> Pose {
    let normal = standing.normal;
    let tangent = standing.pose.rotation * Vec3::Z;
    let across = tangent.cross(normal).try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    let level = Vec3::Z.cross(normal).try_normalize().unwrap_or(across);
    let level = if level.dot(across) < 0.0 { -level } else { level };
    // Jaws hold a disk, whose rim they must follow.
    let along = if standing.is_clamp { across } else { across.rotate_towards(level, LEVELLED) };
    let rotation = Quat::from_mat3(&Mat3::from_cols(normal, along, normal.cross(along)));
    Pose::new(standing.pose.position, rotation)
}

/// On which side the post stands: away from the viewer, and not under the floor.
fn away(section: &Pose, backward: Vec3, sizes: &Proportions) -> f32 {
    let along = section.rotation * Vec3::Y;
    let side = if along.dot(backward) > 0.0 { -1.0 } else { 1.0 };
    let end = section.position + along * (side * REACH * sizes.disk);
    if end.z < sizes.floor { -side } else { side }
}
