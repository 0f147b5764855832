//! A run of several segments as a small picture: the backbone late in its motion, seen across its first bending plane, and what touches it.

use crate::app::theme::Theme;
use centrode_core::model::Vec3;
use centrode_core::scenario::{ChainPlan, ChainScenario};
use egui::{Painter, Pos2, Rect, Shape, Stroke, pos2};

/// What is painted of a run, in the plane of the picture, m.
#[derive(Debug, Clone, PartialEq)]
pub struct Thumb {
    /// Points along each segment.
    segments: Vec<Vec<[f64; 2]>>,
    /// Where something presses.
    contacts: Vec<[f64; 2]>,
}

/// Points along a segment.
const POINTS: usize = 10;

impl Thumb {
    /// Of an experiment; none where it has no shape.
    #[must_use]
    pub fn new(scenario: &ChainScenario) -> Option<Self> {
        let plan = ChainPlan::new(scenario).ok()?;
        let end = plan.path().end();
        let finish = scenario.segments.iter().map(|segment| segment.motion().finish).fold(0.0, f64::max).min(end);
        let delta = plan.command(0, finish).0.delta();
        let (sin, cos) = delta.sin_cos();
        let flat = |point: &Vec3| [cos * point.x - sin * point.y, point.z];
        let backbone = plan.path().backbone(finish, &plan.bends(finish), POINTS);
        let pressing = plan.path().at(finish, &plan.bends(finish)).active;
        let contacts = pressing.into_iter().filter_map(|place| {
            let contact = &scenario.contacts[place];
            let length = scenario.segments[contact.segment].alone.scenario().robot.length;
            let along = backbone.get(contact.segment)?;
            let at = (contact.at / length * (along.len() - 1) as f64).round() as usize;
            along.get(at).map(|pose| flat(&pose.position))
        });
        let contacts = contacts.collect();
        let segments = backbone.iter().map(|along| along.iter().map(|pose| flat(&pose.position)).collect()).collect();
        Some(Self { segments, contacts })
    }

    /// Paints it in a rectangle.
    pub fn paint(&self, painter: &Painter, rect: Rect, theme: &Theme) {
        let painter = painter.with_clip_rect(rect.intersect(painter.clip_rect()));
        let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for point in self.segments.iter().flatten() {
            for i in 0..2 {
                ends[0][i] = ends[0][i].min(point[i]);
                ends[1][i] = ends[1][i].max(point[i]);
            }
        }
        let room = rect.shrink(9.0);
        let [wide, tall] = [0, 1].map(|i| (ends[1][i] - ends[0][i]).max(1e-3));
        let scale = (f64::from(room.width()) / wide).min(f64::from(room.height()) / tall);
        let middle = [0, 1].map(|i| 0.5 * (ends[0][i] + ends[1][i]));
        let at = |point: &[f64; 2]| -> Pos2 {
            let center = room.center();
            let [x, y] = [0, 1].map(|i| ((point[i] - middle[i]) * scale) as f32);
            pos2(center.x + x, center.y - y)
        };
        for (k, along) in self.segments.iter().enumerate() {
            let width = 5.0 - 1.3 * (k as f32).min(2.0);
            let points: Vec<Pos2> = along.iter().map(at).collect();
            let end = points.last().copied();
            painter.add(Shape::line(points, Stroke::new(width, theme.robot)));
            if let Some(end) = end {
                painter.circle_filled(end, 0.5 * width + 1.2, theme.robot);
            }
        }
        for contact in &self.contacts {
            painter.circle(at(contact), 4.0, theme.obstacle, Stroke::new(1.0, theme.panel));
        }
    }
}
