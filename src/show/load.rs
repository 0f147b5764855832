//! The wrench on the end disk: an arrow for the force, words for both.

use super::scene_vector;
use crate::scene::palette::Palette;
use crate::scene::{Label, Line, Pose, Scene};
use centrode_core::model::Wrench;
use centrode_core::run::Run;
use glam::{Vec2, Vec3};

/// Length of the whole force's arrow, as part of the segment's.
const WHOLE: f32 = 0.55;

/// Adds the wrench that acts on the end disk at `tip`; nothing while there is none.
pub fn load(scene: &mut Scene, palette: &Palette, run: &Run, wrench: &Wrench, tip: &Pose) {
    if *wrench == Wrench::ZERO {
        return;
    }
    let length = WHOLE * run.plan.segment().length as f32;
    let whole = scene_vector(&run.plan.scenario().load.force.into()).length();
    let force = if whole > 0.0 { scene_vector(&wrench.force) / whole } else { Vec3::ZERO };
    let (end, start) = (tip.position, tip.position - force * length);
    let (force, moment) = (wrench.force.norm(), wrench.moment.norm() * 1e3);
    let words = [(force, format!("{force:.2} N")), (moment, format!("{moment:.1} mN·m"))];
    let text: Vec<_> = words.into_iter().filter(|(size, _)| *size > 0.0).map(|(_, words)| words).collect();
    self::force(scene, palette, [start, end], (length, 0.1 * length), text.join(", "));
}

/// A force as an arrow with words at its start, see [`arrow`].
pub fn force(scene: &mut Scene, palette: &Palette, path: [Vec3; 2], whole_and_lift: (f32, f32), text: String) {
    arrow(scene, palette, path, whole_and_lift);
    scene.labels.push(Label { anchor: path[0], offset: Vec2::new(10.0, -14.0), text, color: palette.force });
}

/// A force from `start` to where it acts. `whole` is the length of the longest such arrow, m, and `lift` how far it stands before
/// what is there, m.
fn arrow(scene: &mut Scene, palette: &Palette, [start, end]: [Vec3; 2], (whole, lift): (f32, f32)) {
    let Some(along) = (end - start).try_normalize() else { return };
    let head = (0.35 * whole).min(start.distance(end)) * 0.6;
    let mut line = |path| scene.lines.push(Line::new(path, 3.5, palette.force).through(0.6).lifted(lift));
    line(vec![start, end]);
    for side in [along.any_orthonormal_vector(), -along.any_orthonormal_vector()] {
        line(vec![end, end - along * head + side * 0.5 * head]);
    }
}
