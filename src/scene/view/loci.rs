//! The signs: centrode loci, screw axes and the estimated contact.
//!
//! A centrode lies within the robot, so all of them shine through it; those of this instant stand before it.

use super::scene_vector;
use crate::experiment::plant::Plant;
use crate::experiment::{Run, Sample};
use crate::model::{Constrained, Rate, Vec3 as ModelVec3};
use crate::scene::palette::Palette;
use crate::scene::{Color, Label, Line, Marker, Scene, Shape};
use glam::{Vec2, Vec3};

/// Steps of the motion from which a locus is taken.
const STEPS: usize = 80;
/// Least distance of two marks of a locus, in lengths of the segment.
const SPACING: f32 = 0.055;
/// The same for the sensor's dots.
const GRAIN: f32 = 0.013;
/// The sensor's dots are looked for this often, s.
const TICK: f64 = 0.015;
/// A dot has faded to its least after this, s.
const FADE: f64 = 2.5;
/// A centrode farther from the base than this many lengths is off the picture.
const FAR: f64 = 1.6;
/// The sensor's is also off when it is this many lengths away from the model's.
const STRAY: f64 = 1.0;

/// One instant of a run, and how its signs look.
pub struct Signs<'a> {
    /// The run.
    pub run: &'a Run,
    /// Its robot.
    pub plant: &'a Plant<'a>,
    /// Colours.
    pub palette: &'a Palette,
    /// The instant, s.
    pub time: f64,
    /// How far signs stand before the place they mark, m: out of the robot.
    pub lift: f32,
}

impl Signs<'_> {
    fn length(&self) -> f32 {
        self.run.plan.segment().length as f32
    }

    /// Times (s) between which θL takes equal steps over the whole motion, in order.
    fn even_times(&self) -> Vec<f64> {
        let motion = &self.run.plan.scenario().motion;
        let travel = motion.theta_end - motion.theta_start;
        let mut times = Vec::with_capacity(STEPS + 1);
        for sample in self.run.samples.iter().filter(|sample| sample.time >= motion.start) {
            let done = if travel == 0.0 { 1.0 } else { (sample.theta_l - motion.theta_start) / travel };
            if done >= times.len() as f64 / STEPS as f64 {
                times.push(sample.time);
                if times.len() > STEPS {
                    break;
                }
            }
        }
        times
    }

    fn visible(&self, centrode: &ModelVec3) -> Option<Vec3> {
        (centrode.norm() < FAR * self.run.plan.segment().length).then(|| scene_vector(centrode))
    }

    /// The model's centrode c_m.
    fn model(&self, time: f64) -> Option<Vec3> {
        self.visible(&self.run.sample_at(time).judgement.model_centrode)
    }

    /// The constrained model's centrode c_c, while the beam holds.
    fn constrained(&self, time: f64) -> Option<Vec3> {
        let contact = self.run.plan.contact()?;
        let (configuration, _) = self.plant.command(time);
        let held = self.plant.in_contact(&configuration);
        let length = self.run.plan.segment().length;
        let centrode = held.then(|| {
            Constrained::new(length, contact.arc_length, contact.bend, configuration).centrode(Rate::BENDING)
        })?;
        self.visible(&centrode?)
    }

    /// The sensor's centrode c_s, where it moves fast enough to be judged and within the picture.
    fn sensed(&self, sample: &Sample) -> Option<Vec3> {
        let judgement = &sample.judgement;
        let far = judgement.deviation > STRAY * self.run.plan.segment().length;
        let judged = judgement.speed > self.run.plan.scenario().detection.min_speed;
        self.visible(&judgement.sensor_centrode).filter(|_| judged && !far)
    }

    fn armed(&self, time: f64) -> bool {
        time >= self.run.plan.scenario().detection.armed_from
    }

    /// Loci of the fixed centrode: model (triangles), constrained (rings), sensor up to now (dots).
    pub fn loci(&self, scene: &mut Scene) {
        let palette = self.palette;
        let times = self.even_times();
        let model: Vec<Vec3> = times.iter().filter_map(|&t| self.model(t)).collect();
        let constrained: Vec<Vec3> = times.iter().filter_map(|&t| self.constrained(t)).collect();
        self.dots(scene);
        for (path, shape, size, color) in
            [(model, Shape::Triangle, 9.5, palette.model), (constrained, Shape::Ring, 10.0, palette.constrained)]
        {
            let marks = spaced(&path, SPACING * self.length());
            let mark = |at| Marker::new(at, shape, size, color).outlined(palette.halo, 1.25).through(0.85);
            scene.markers.extend(marks.into_iter().map(mark));
            scene.lines.push(Line::new(path, 1.5, color.alpha(0.7)).through(0.6));
        }
    }

    /// The sensor's dots: one for each small place, in which the latest visit counts.
    fn dots(&self, scene: &mut Scene) {
        let (step, least) = (TICK, GRAIN * self.length());
        let step = 1.max((step * self.run.plan.scenario().loop_rate) as usize);
        let mut dots: Vec<(Vec3, f64)> = Vec::new();
        let past = self.run.samples.iter().step_by(step).take_while(|sample| sample.time <= self.time);
        for sample in past.filter(|sample| self.armed(sample.time)) {
            let Some(at) = self.sensed(sample) else { continue };
            match dots.iter_mut().find(|(dot, _)| dot.distance(at) < least) {
                Some((_, latest)) => *latest = sample.time,
                None => dots.push((at, sample.time)),
            }
        }
        scene.markers.extend(dots.into_iter().map(|(at, latest)| {
            let fresh = (1.0 - (self.time - latest) / FADE).max(0.0) as f32;
            let dot = Marker::new(at, Shape::Dot, 7.5, self.palette.sensor).outlined(self.palette.halo, 0.75);
            dot.faded(0.4 + 0.6 * fresh).through(0.85)
        }));
    }

    /// The screw axes of model and sensor now, all three centrodes, and the deviation between model and sensor.
    pub fn axes(&self, scene: &mut Scene) {
        let palette = self.palette;
        let half = 0.62 * self.length();
        let sample = self.run.sample_at(self.time);
        if let Some(held) = self.constrained(self.time) {
            scene.markers.push(self.sign(held, Shape::Ring, 15.0, palette.constrained));
        }
        let Some(model) = self.model(self.time) else { return };
        let (s, c) = self.plant.command(self.time).0.sin_cos_delta();
        self.axis(scene, model, Vec3::new(s as f32, c as f32, 0.0) * half, palette.model);
        let triangle = self.sign(model, Shape::Triangle, 15.0, palette.model);
        let Some(sensor) = self.sensed(sample) else {
            scene.markers.push(triangle);
            return;
        };
        let (deviation, armed) = (sample.judgement.deviation, self.armed(sample.time));
        let strength = if armed { 1.0 } else { 0.45 };
        let along = scene_vector(&sample.motion.twist.angular).normalize_or_zero() * half;
        self.axis(scene, sensor, along, palette.sensor.alpha(strength));
        if armed {
            let over = self.run.plan.scenario().detection.xi2.value().is_some_and(|xi2| deviation > xi2);
            let color = if over { palette.detection } else { palette.ink };
            for (width, color) in [(6.0, palette.halo.alpha(0.9)), (3.0, color)] {
                scene.lines.push(Line::new(vec![model, sensor], width, color).through(0.85).lifted(self.lift));
            }
            scene.labels.push(Label {
                anchor: 0.5 * (model + sensor),
                offset: Vec2::new(16.0, 14.0),
                text: format!("{:.1} mm", deviation * 1e3),
                color,
            });
        }
        scene.markers.push(triangle);
        scene.markers.push(self.sign(sensor, Shape::Dot, 18.0, palette.sensor).faded(strength));
    }

    /// A sign of this instant.
    fn sign(&self, at: Vec3, shape: Shape, size: f32, color: Color) -> Marker {
        Marker::new(at, shape, size, color).outlined(self.palette.halo, 1.75).through(0.9).lifted(self.lift)
    }

    fn axis(&self, scene: &mut Scene, at: Vec3, along: Vec3, color: Color) {
        let path = vec![at - along, at + along];
        scene.lines.push(Line::new(path, 2.0, color).dashed(0.075 * self.length(), 0.72).through(0.6));
    }

    /// The place on the backbone that the estimate names, `location` m from the base, with its label off the robot.
    pub fn estimate(&self, scene: &mut Scene, pulse: f32, [at, off]: [Vec3; 2], location: f64) {
        let color = self.palette.detection;
        scene.lines.push(Line::new(vec![at, off], 1.5, color).through(0.9).lifted(self.lift));
        scene.markers.push(self.sign(at, Shape::Diamond, 14.0, color).pulsing(pulse));
        scene.labels.push(Label {
            anchor: off,
            offset: Vec2::new(-2.0, -2.0),
            text: format!("estimate {:.1} mm", location * 1e3),
            color,
        });
    }
}

/// The points that are at least `least` m from the one kept before: a locus that hardly moves is not a blot.
fn spaced(path: &[Vec3], least: f32) -> Vec<Vec3> {
    let mut kept: Vec<Vec3> = Vec::new();
    for &at in path {
        if kept.last().is_none_or(|last| last.distance(at) >= least) {
            kept.push(at);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_keep_their_distance() {
        let path: Vec<Vec3> = (0..100).map(|i| Vec3::X * 0.1 * i as f32).collect();
        let kept = spaced(&path, 1.0);
        assert!((9..=11).contains(&kept.len()) && kept[0] == path[0]);
        assert!(kept.windows(2).all(|w| w[0].distance(w[1]) >= 1.0));
    }
}
