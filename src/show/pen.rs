//! How signs are drawn: what marks a place at an instant stands before the robot and shines through what is before it.

use super::band::Step;
use crate::scene::palette::Palette;
use crate::scene::{Color, Label, Line, Marker, Pose, Scene, Shape};
use glam::{Vec2, Vec3};

/// Draws signs of one instant.
#[derive(Clone, Copy)]
pub struct Pen<'a> {
    /// Colours.
    pub palette: &'a Palette,
    /// How far signs stand before the place they mark, m: out of the robot.
    pub lift: f32,
    /// Length of the segment that they are of, m.
    pub length: f32,
}

impl Pen<'_> {
    /// A sign of this instant.
    pub fn sign(&self, at: Vec3, shape: Shape, size: f32, color: Color) -> Marker {
        Marker::new(at, shape, size, color).outlined(self.palette.halo, 1.75).through(0.9).lifted(self.lift)
    }

    /// A screw axis through a point, so far to both sides.
    pub fn axis(&self, scene: &mut Scene, at: Vec3, along: Vec3, color: Color) {
        let path = vec![at - along, at + along];
        scene.lines.push(Line::new(path, 2.0, color).dashed(0.075 * self.length, 0.72).through(0.6));
    }

    /// The way from the model's centrode to the sensor's.
    pub fn deviation(&self, scene: &mut Scene, [model, sensor]: [Vec3; 2], color: Color) {
        for (width, color) in [(6.0, self.palette.halo.alpha(0.9)), (3.0, color)] {
            scene.lines.push(Line::new(vec![model, sensor], width, color).through(0.85).lifted(self.lift));
        }
    }

    /// How long it is (m), in words.
    pub fn distance(&self, scene: &mut Scene, [model, sensor]: [Vec3; 2], deviation: f64, color: Color) {
        scene.labels.push(Label {
            anchor: 0.5 * (model + sensor),
            offset: Vec2::new(16.0, 14.0),
            text: format!("{:.1} mm", deviation * 1e3),
            color,
        });
    }

    /// Where a contact is placed on the backbone, whose poses `pose` gives by arc length (m).
    pub fn band(&self, scene: &mut Scene, steps: &[Step], pose: impl Fn(f64) -> Pose) {
        let color = self.palette.constrained;
        for step in steps {
            let ends = [step.at - step.half, step.at + step.half].map(|s| pose(s).position);
            let width = 7.0 + 9.0 * step.strength;
            let line = Line::new(ends.to_vec(), width, color.alpha(step.opacity));
            scene.lines.push(line.through(0.9).lifted(self.lift));
        }
    }

    /// The ends of an interval on the backbone, so that a narrow one is seen; `aside` is a way across the backbone.
    pub fn ends(&self, scene: &mut Scene, ends: [Vec3; 2], aside: Vec3) {
        let across = aside.normalize_or_zero() * 0.055 * self.length;
        for end in ends {
            let line = Line::new(vec![end - across, end + across], 2.0, self.palette.constrained);
            scene.lines.push(line.through(0.9).lifted(self.lift));
        }
    }
}
