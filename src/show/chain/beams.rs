//! What the backbone meets, and the forces by which it is pushed.

use super::{Instant, Proportions};
use crate::scene::{Pose, Scene};
use crate::show::beam::{self, Beam};
use crate::show::obstacle::{Met, Obstacle, Piece};
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
const POST: f32 = 3.0;
/// A plate reaches so far beyond the points at which it is touched, in radii of a disk.
const EDGE: f32 = 0.35;
/// Instants from when it stands to the end at which it is looked up where it is touched.
const LOOKS: usize = 8;
/// What is nearer to a plane touches it, m: beyond the rounding of a scene.
const TOUCHING: f32 = 1e-5;

/// Something that the backbone meets, where it stands.
struct Standing {
    /// Since when, s.
    since: f64,
    /// The instant at which it is met, s.
    met: f64,
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
        let mut obstacle = obstacle(sizes, surface, rim, standing.is_clamp);
        let section = section(&standing);
        let away = away(&section, backward, sizes);
        let mut reach = [-1.0, 1.0].map(|end| end * beam::FITTING * sizes.disk);
        if let [Piece::Bar { center, half }] = &mut obstacle.fittings[..] {
            // The backbone slides along the plane, which has no end.
            let [low, high] = touched(run, (contact.segment, at), &standing, &section);
            let edge = EDGE * sizes.disk;
            let along = [low.z - edge, high.z + edge].map(f64::from);
            let ends = [along[0].min(-half[1]), along[1].max(half[1])];
            (center.y, half[1]) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            let across = if away > 0.0 { [low.y, high.y] } else { [-high.y, -low.y] };
            reach = [reach[0].min(across[0] - edge), reach[1].max(across[1] + edge)];
        }
        let faint = instant.time < standing.since;
        let beam = Beam { obstacle: &obstacle, sizes, section, away, reach, faint };
        let touches = instant.on(contact.segment, at).position + standing.normal * surface;
        let presses = instant.pressing().contains(&place);
        beam.draw(scene, instant.palette, presses.then_some(touches));
        let force = instant.truth.as_ref().map_or(0.0, |truth| truth.forces[place]);
        if presses && force > 0.0 {
            let start = touches + standing.normal * (whole * (force / largest) as f32);
            let text = format!("{force:.2} N");
            load::force(scene, instant.palette, [start, touches], (whole, 1.5 * sizes.disk), text);
        }
    }
}

/// Between which points of its own plane something is touched until the run ends, m.
fn touched(run: &ChainRun, (segment, at): (usize, f64), standing: &Standing, section: &Pose) -> [Vec3; 2] {
    let (plan, path, back) = (&run.plan, run.plan.path(), section.rotation.inverse());
    let times = (0..=LOOKS).map(|k| standing.met + (path.end() - standing.met) * k as f64 / LOOKS as f64);
    let place = |time: f64| {
        let point = scene_vector(&path.pose(time, &plan.bends(time), segment, at).position);
        back * (point - section.position)
    };
    let pressed = times.map(place).filter(|point| point.x > -TOUCHING);
    pressed.fold([Vec3::ZERO; 2], |[low, high], point| [low.min(point), high.max(point)])
}

/// The largest force of the run, N.
fn largest(run: &ChainRun) -> f64 {
    let forces = run.recording.truth.iter().flatten().flat_map(|truth| &truth.forces);
    forces.copied().fold(f64::MIN_POSITIVE, f64::max)
}

/// Where something stands; none of what never came to stand before the run's end.
fn standing(run: &ChainRun, instant: &Instant<'_>, place: usize, contact: &ChainContact) -> Option<Standing> {
    let (plan, path) = (&run.plan, run.plan.path());
    let met = match contact.stands {
        Stands::From { time, .. } | Stands::Clamped { time } => Some(time).filter(|time| *time <= path.end())?,
        // It always stands, and is drawn where it is met.
        Stands::Always { .. } => {
            let met = path.happened().iter().find(|event| event.what == What::Met(place));
            met.map_or(path.end(), |event| event.time)
        }
    };
    let at = contact.at.min(f64::from(instant.sizes[contact.segment].length));
    let mut pose = scene_pose(&path.pose(met, &plan.bends(met), contact.segment, at));
    let Some((normal, offset)) = path.plane(place) else {
        // A clamp: from where the segment bends to.
        let (sin, cos) = plan.command(contact.segment, met).0.sin_cos_delta();
        let normal = pose.rotation * scene_vector(&Vector::new(cos, -sin, 0.0));
        return Some(Standing { since: met, met, pose, normal, is_clamp: true });
    };
    let normal = scene_vector(&normal);
    pose.position += normal * (offset as f32 - normal.dot(pose.position));
    let since = if matches!(contact.stands, Stands::Always { .. }) { 0.0 } else { met };
    Some(Standing { since, met, pose, normal, is_clamp: false })
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
    let end = section.position + along * (side * POST * sizes.disk);
    if end.z < sizes.floor { -side } else { side }
}
