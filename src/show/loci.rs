//! The signs: centrode loci, screw axes and the estimated contact.
//!
//! A centrode lies within the robot, so all of them shine through it; those of this instant stand before it.

use super::pen::Pen;
use super::track::{self, Spot, Trace};
use super::{band, scene_vector};
use crate::scene::{Label, Line, Marker, Pose, Scene, Shape};
use centrode_core::detect::calibration::marginal::Estimate;
use centrode_core::detect::{Method, Standing};
use centrode_core::record::Truth;
use centrode_core::run::Run;
use glam::{Vec2, Vec3};

/// A dot has faded to its least after this, s.
const FADE: f64 = 2.5;

/// One instant of a run, and how its signs look.
pub struct Signs<'a> {
    /// The run.
    pub run: &'a Run,
    /// Its loci.
    pub trace: &'a Trace,
    /// The truth at the instant, where it is known.
    pub truth: Option<&'a Truth>,
    /// The instant, s.
    pub time: f64,
    /// What they are drawn with.
    pub pen: Pen<'a>,
}

impl Signs<'_> {
    /// Loci of the fixed centrode: model (triangles), constrained (rings), sensor up to now (dots).
    pub fn loci(&self, scene: &mut Scene) {
        let palette = self.pen.palette;
        let Trace { model, constrained, .. } = self.trace;
        self.dots(scene);
        for (locus, shape, size, color) in
            [(model, Shape::Triangle, 9.5, palette.model), (constrained, Shape::Ring, 10.0, palette.constrained)]
        {
            let mark = |spot: &Spot| {
                Marker::new(scene_vector(&spot.at), shape, size, color).outlined(palette.halo, 1.25).through(0.85)
            };
            scene.markers.extend(locus.marks.iter().map(mark));
            let path = locus.path.iter().map(|spot| scene_vector(&spot.at)).collect();
            scene.lines.push(Line::new(path, 1.5, color.alpha(0.7)).through(0.6));
        }
    }

    /// The sensor's dots: one for each small place, in which the latest visit counts.
    fn dots(&self, scene: &mut Scene) {
        scene.markers.extend(self.trace.dots(self.time).map(|Spot { at, latest, .. }| {
            let fresh = (1.0 - (self.time - latest) / FADE).max(0.0) as f32;
            let palette = self.pen.palette;
            let dot = Marker::new(scene_vector(&at), Shape::Dot, 7.5, palette.sensor).outlined(palette.halo, 0.75);
            dot.faded(0.4 + 0.6 * fresh).through(0.85)
        }));
    }

    /// The screw axes of model and sensor now, all three centrodes, and the deviation between model and sensor.
    pub fn axes(&self, scene: &mut Scene) {
        let (pen, palette) = (&self.pen, self.pen.palette);
        let half = 0.62 * pen.length;
        let sample = self.run.sample_at(self.time);
        if let Some(held) = track::constrained(self.run, self.truth).as_ref().map(scene_vector) {
            scene.markers.push(pen.sign(held, Shape::Ring, 15.0, palette.constrained));
        }
        let Some(model) = track::model(self.run, &sample).as_ref().map(scene_vector) else { return };
        let (s, c) = self.run.commanded(self.run.place(self.time)).sin_cos_delta();
        pen.axis(scene, model, Vec3::new(s as f32, c as f32, 0.0) * half, palette.model);
        let triangle = pen.sign(model, Shape::Triangle, 15.0, palette.model);
        let Some(sensor) = track::sensed(self.run, &sample).as_ref().map(scene_vector) else {
            scene.markers.push(triangle);
            return;
        };
        let (deviation, armed) = (sample.judgement.deviation, track::standing(self.run, &sample) == Standing::Counts);
        let strength = if armed { 1.0 } else { 0.45 };
        let along = scene_vector(&sample.motion.twist.angular).normalize_or_zero() * half;
        pen.axis(scene, sensor, along, palette.sensor.alpha(strength));
        if armed {
            let settings = &self.run.plan.scenario().detection;
            let over = settings.judges(Method::Fcd) && settings.xi2.value().is_some_and(|xi2| deviation > xi2);
            let color = if over { palette.detection } else { palette.ink };
            pen.deviation(scene, [model, sensor], color);
            pen.distance(scene, [model, sensor], deviation, color);
        }
        scene.markers.push(triangle);
        scene.markers.push(pen.sign(sensor, Shape::Dot, 18.0, palette.sensor).faded(strength));
    }

    /// The place on the backbone that the estimate names, `location` m from the base, with its label off the robot.
    pub fn estimate(&self, scene: &mut Scene, pulse: f32, [at, off]: [Vec3; 2], location: f64) {
        let color = self.pen.palette.detection;
        scene.lines.push(Line::new(vec![at, off], 1.5, color).through(0.9).lifted(self.pen.lift));
        scene.markers.push(self.pen.sign(at, Shape::Diamond, 14.0, color).pulsing(pulse));
        scene.labels.push(Label {
            anchor: off,
            offset: Vec2::new(-2.0, -2.0),
            text: format!("estimate {:.1} mm", location * 1e3),
            color,
        });
    }

    /// Where the calibration filter places the contact on the backbone, whose poses `pose` gives by arc length (m); the label stands
    /// `aside` (m) from the likeliest place.
    pub fn band(&self, scene: &mut Scene, placed: &Estimate, pose: impl Fn(f64) -> Pose, aside: Vec3) {
        self.pen.band(scene, &band::steps(placed), &pose);
        self.pen.ends(scene, [placed.place.low, placed.place.high].map(|s| pose(s).position), aside);
        let at = pose(placed.place.mode);
        scene.labels.push(Label {
            anchor: at.point(-aside),
            offset: Vec2::new(2.0, 2.0),
            text: band::interval(placed),
            color: self.pen.palette.ink,
        });
    }
}
