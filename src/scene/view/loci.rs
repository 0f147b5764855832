//! The signs: centrode loci, screw axes and the estimated contact.

use super::{ViewOptions, scene_vector};
use crate::experiment::plant::Plant;
use crate::experiment::{Run, Sample};
use crate::model::{Constrained, Rate, Vec3 as ModelVec3};
use crate::scene::palette::Palette;
use crate::scene::{Label, Line, Marker, Scene, Shape};
use glam::{Vec2, Vec3};

/// Marks along a locus.
const MARKS: usize = 18;
/// A centrode farther from the base than this many lengths is off the picture.
const FAR: f64 = 2.5;
/// The motion is in θL alone; its direction is all that a centrode needs.
const BENDING: Rate = Rate { theta_l: -1.0, delta: 0.0 };

/// Times (s) between which θL takes equal steps over the whole motion, in order.
fn even_times(run: &Run) -> Vec<f64> {
    let motion = &run.plan.scenario().motion;
    let travel = motion.theta_end - motion.theta_start;
    let mut next = 0.0;
    let mut times = Vec::with_capacity(MARKS + 1);
    for sample in run.samples.iter().filter(|sample| sample.time >= motion.start) {
        let done = if travel == 0.0 { 1.0 } else { (sample.theta_l - motion.theta_start) / travel };
        if done >= next {
            times.push(sample.time);
            next = times.len() as f64 / MARKS as f64;
            if times.len() > MARKS {
                break;
            }
        }
    }
    times
}

/// The constrained model's centrode c_c at `time`, while the beam holds.
fn constrained_centrode(run: &Run, plant: &Plant, time: f64) -> Option<ModelVec3> {
    let contact = run.plan.contact()?;
    let (configuration, _) = plant.command(time);
    let held = plant.in_contact(&configuration);
    let length = run.plan.segment().length;
    held.then(|| Constrained::new(length, contact.arc_length, contact.bend, configuration).centrode(BENDING))?
}

fn visible(run: &Run, centrode: &ModelVec3) -> Option<Vec3> {
    (centrode.norm() < FAR * run.plan.segment().length).then(|| scene_vector(centrode))
}

/// The sensor's centrode, where it is judged and within the picture.
fn sensed(run: &Run, sample: &Sample) -> Option<Vec3> {
    let judged = sample.judgement.speed > run.plan.scenario().detection.min_speed;
    visible(run, &sample.judgement.sensor_centrode).filter(|_| judged)
}

/// Loci of the fixed centrode: model (triangles), constrained (circles), sensor up to `time` (dots).
pub fn loci(scene: &mut Scene, palette: &Palette, run: &Run, time: f64) {
    let plant = Plant::new(&run.plan);
    let times = even_times(run);
    let model = times.iter().filter_map(|&t| visible(run, &run.sample_at(t).judgement.model_centrode)).collect();
    let constrained =
        times.iter().filter_map(|&t| visible(run, &constrained_centrode(run, &plant, t)?)).collect::<Vec<_>>();
    for (path, shape, color) in
        [(model, Shape::Triangle, palette.model), (constrained, Shape::Circle, palette.constrained)]
    {
        let marks = path.iter().map(|&at| Marker::new(at, shape, 8.5, color).outlined(palette.halo, 1.25));
        scene.markers.extend(marks);
        scene.lines.push(Line::new(path, 1.0, color.alpha(0.55)).through(0.2));
    }
    let step = 1.max(run.samples.len() / 220);
    let dots = run.samples.iter().step_by(step).take_while(|sample| sample.time <= time);
    scene.markers.extend(dots.filter_map(|sample| {
        Some(
            Marker::new(sensed(run, sample)?, Shape::Dot, 7.5, palette.sensor).outlined(palette.halo, 0.75).faded(0.85),
        )
    }));
}

/// The instantaneous screw axes of model and sensor at `time`, their centrodes, and the deviation between them.
pub fn axes(scene: &mut Scene, palette: &Palette, run: &Run, time: f64) {
    let sample = run.sample_at(time);
    let half = 0.55 * run.plan.segment().length as f32;
    let (s, c) = Plant::new(&run.plan).command(time).0.sin_cos_delta();
    let model_axis = Vec3::new(s as f32, c as f32, 0.0) * half;
    let model = scene_vector(&sample.judgement.model_centrode);
    if !model.is_finite() {
        return;
    }
    let axis = |at: Vec3, along: Vec3, width, color| Line::new(vec![at - along, at + along], width, color).through(0.3);
    scene.lines.push(axis(model, model_axis, 1.5, palette.model.alpha(0.8)).dashed(0.15 * half, 0.5));
    scene
        .markers
        .push(Marker::new(model, Shape::Triangle, 14.0, palette.model).outlined(palette.halo, 1.5).through(0.6));
    let Some(sensor) = sensed(run, sample) else { return };
    let along = scene_vector(&sample.motion.twist.angular).normalize_or_zero() * half;
    scene.lines.push(axis(sensor, along, 2.25, palette.sensor).dashed(0.14 * half, 0.7));
    scene.lines.push(Line::new(vec![model, sensor], 2.5, palette.ink).through(0.5));
    scene.markers.push(Marker::new(sensor, Shape::Dot, 18.0, palette.sensor).outlined(palette.halo, 1.5).through(0.6));
    if sample.judgement.deviation.is_finite() {
        scene.labels.push(Label {
            anchor: 0.5 * (model + sensor),
            offset: Vec2::new(12.0, -12.0),
            text: format!("{:.1} mm", sample.judgement.deviation * 1e3),
            color: palette.ink,
        });
    }
}

/// The place on the backbone that the estimate names, `location` m from the base.
pub fn estimate(scene: &mut Scene, options: &ViewOptions, at: Vec3, location: f64) {
    let palette = &options.palette;
    let marker = Marker::new(at, Shape::Diamond, 14.0, palette.detection).outlined(palette.halo, 1.5);
    // Lifted off the backbone, inside which it would stand.
    scene.markers.push(marker.pulsing(options.pulse).lifted(0.006).through(0.8));
    scene.labels.push(Label {
        anchor: at,
        offset: Vec2::new(-16.0, -16.0),
        text: format!("estimate {:.1} mm", location * 1e3),
        color: palette.detection,
    });
}
