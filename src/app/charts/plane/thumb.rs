//! A run as a small picture: the robot where its beam is found, the beam, and the centrodes on their way there.

use super::flat::Flat;
use super::track::{Outline, Robot, Track};
use crate::app::theme::Theme;
use crate::show::track::Trace;
use centrode_core::run::Run;
use egui::{Painter, Pos2, Rect, Shape, Stroke, pos2};

/// What is painted of a run, in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Thumb {
    robot: Robot,
    ghost: Vec<Flat>,
    beam: Vec<Outline>,
    /// Model, constrained and sensed centrodes.
    marks: [Vec<Flat>; 3],
    /// The estimate on the backbone.
    estimate: Option<Flat>,
    bounds: [Flat; 2],
}

/// The instant that says most: shortly after the detection, or late in the motion.
fn instant(run: &Run) -> f64 {
    let motion = &run.plan.scenario().motion;
    let late = motion.start + 0.7 * (motion.finish - motion.start);
    run.detection().map_or(late, |detection| detection.time + 0.1).min(motion.end)
}

impl Thumb {
    /// Of a run.
    #[must_use]
    pub fn new(run: &Run) -> Self {
        let trace = Trace::new(run);
        let track = Track::new(run, &trace);
        let time = instant(run);
        let shape = track.truth(time);
        let loci = track.loci(time);
        let until = |marks: &[super::flat::Mark]| {
            marks.iter().filter(|mark| mark.time <= time).map(|mark| mark.at).filter(|at| at[0].is_finite()).collect()
        };
        let robot = track.robot(&shape);
        let beam = track.beam();
        let ends = robot.disks.iter().flatten().chain(&robot.backbone).copied();
        let corners = beam.first().into_iter().flat_map(Outline::corners);
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for at in ends.chain(corners) {
            for i in 0..2 {
                bounds[0][i] = bounds[0][i].min(at[i]);
                bounds[1][i] = bounds[1][i].max(at[i]);
            }
        }
        let estimate = run.detection().filter(|detection| detection.time <= time);
        Self {
            ghost: track.ghost(time).unwrap_or_default(),
            marks: [until(&loci.model), until(&loci.constrained), until(&loci.sensor)],
            estimate: estimate.map(|detection| track.place(&shape, detection.location)),
            robot,
            beam,
            bounds,
        }
    }

    /// Paints it in a rectangle.
    pub fn paint(&self, painter: &Painter, rect: Rect, theme: &Theme) {
        let painter = painter.with_clip_rect(rect.intersect(painter.clip_rect()));
        let [[left, low], [right, high]] = self.bounds;
        let room = rect.shrink(5.0);
        let (wide, tall) = ((right - left).max(1e-3), (high - low).max(1e-3));
        let scale = (f64::from(room.width()) / wide).min(f64::from(room.height()) / tall);
        let middle = [0.5 * (left + right), 0.5 * (low + high)];
        let at = |[x, z]: Flat| -> Pos2 {
            let c = room.center();
            pos2(c.x + ((x - middle[0]) * scale) as f32, c.y - ((z - middle[1]) * scale) as f32)
        };
        let line = |points: &[Flat], stroke| {
            painter.add(Shape::line(points.iter().copied().map(at).collect(), stroke));
        };
        for piece in &self.beam {
            match piece {
                Outline::Round(center, radius) => {
                    painter.circle_filled(at(*center), (radius * scale) as f32, theme.obstacle);
                }
                Outline::Bar(corners) => {
                    let corners = corners.map(at).to_vec();
                    painter.add(Shape::convex_polygon(corners, theme.obstacle, Stroke::NONE));
                }
            }
        }
        line(&self.ghost, Stroke::new(1.0, theme.model.gamma_multiply(0.8)));
        self.robot.sides.iter().for_each(|side| line(side, Stroke::new(1.0, theme.robot.gamma_multiply(0.6))));
        line(&self.robot.backbone, Stroke::new(2.2, theme.robot));
        self.robot.disks.iter().for_each(|disk| line(disk, Stroke::new(1.8, theme.robot)));
        for (marks, color) in self.marks.iter().zip([theme.model, theme.constrained, theme.sensor]) {
            for mark in marks {
                painter.circle_filled(at(*mark), 1.5, color);
            }
        }
        if let Some(place) = self.estimate.map(at) {
            let corners =
                [(0.0, -4.0), (4.0, 0.0), (0.0, 4.0), (-4.0, 0.0)].map(|(x, y)| pos2(place.x + x, place.y + y));
            painter.add(Shape::convex_polygon(corners.to_vec(), theme.detection, Stroke::new(1.0, theme.panel)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset::PRESETS;

    #[test]
    fn every_preset_has_a_picture_of_its_own() {
        let thumbs: Vec<Thumb> = PRESETS
            .iter()
            .map(|preset| Thumb::new(&simulate(&preset.scenario().expect("valid")).expect("a run")))
            .collect();
        for (k, (thumb, preset)) in thumbs.iter().zip(PRESETS).enumerate() {
            assert!(thumb.bounds.iter().flatten().all(|x| x.is_finite()), "{}", preset.name);
            assert_eq!(
                thumb.beam.is_empty(),
                preset.scenario().is_ok_and(|s| s.contact.place == centrode_core::scenario::Place::Nowhere),
                "{}",
                preset.name
            );
            assert!(!thumbs[..k].contains(thumb), "{}", preset.name);
        }
    }
}
