//! Signs at the end disks: their names, their instantaneous screw axes, and where contacts are placed.

use super::Instant;
use crate::scene::{Color, Label, Line, Pose, Scene, Shape, arc};
use crate::show::pen::Pen;
use crate::show::{band, scene_vector};
use centrode_core::detect::chain::ChainEstimate;
use centrode_core::detect::evidence::Evidence;
use centrode_core::detect::judge::Judged;
use centrode_core::detect::{Method, Standing};
use centrode_core::model::centrode::centrode;
use centrode_core::model::chain::path::What;
use centrode_core::model::{Arc, Rate, Vec3 as Vector};
use centrode_core::study::chain::ChainRun;
use glam::{Vec2, Vec3};

/// Half a screw axis, as part of the segment's length: of the chosen segment's disk, and of others.
const AXIS: [f32; 2] = [0.62, 0.36];
/// Size of the others' signs, as part of the chosen one's.
const SMALL: f32 = 0.7;
/// A centrode farther from the end disk below than this many lengths is off the picture; so is the sensor's if it is that far from
/// the model's by the second.
const FAR: [f64; 2] = [1.6, 1.0];

impl Instant<'_> {
    fn pen(&self, segment: usize) -> Pen<'_> {
        let sizes = &self.sizes[segment];
        Pen { palette: self.palette, lift: 1.5 * sizes.disk, length: sizes.length }
    }

    /// ω of a segment's model in the frame of the disk below it, up to its size; at rest that of bending.
    fn turning(&self, segment: usize, rate: Rate) -> Vector {
        let rate = if rate == Rate::default() { Rate::BENDING } else { rate };
        let length = f64::from(self.sizes[segment].length);
        Arc { length, configuration: self.told[segment] }.jacobian(length).twist(rate).angular
    }

    /// Across the backbone of a segment at an arc length (m), from where it bends to, so many radii of a disk.
    fn aside(&self, segment: usize, at: f64, radii: f32) -> Vec3 {
        let (sin, cos) = self.told[segment].sin_cos_delta();
        let off = Vec3::new(-cos as f32, sin as f32, 0.0) * (radii * self.sizes[segment].disk);
        self.on(segment, at).rotation * off
    }
}

/// What each segment is called, beside its end disk, and rings around the disks of the chosen one.
pub fn names(scene: &mut Scene, instant: &Instant<'_>, chosen: usize) {
    let segments = instant.sizes.len();
    if segments == 1 {
        return;
    }
    for (segment, sizes) in instant.sizes.iter().enumerate() {
        let color = if segment == chosen { instant.palette.choice } else { instant.palette.ink_dim };
        let end = instant.bent.pose(segment, 1.0);
        scene.labels.push(Label {
            anchor: end.position + instant.aside(segment, f64::from(sizes.length), 1.5),
            offset: Vec2::new(-2.0, -2.0),
            text: format!("segment {}", segment + 1),
            color,
        });
        if segment == chosen {
            for disk in [instant.bent.pose(segment, 0.0), end] {
                scene.lines.push(Line::new(arc::circle(disk, 1.04 * sizes.disk, 64), 2.0, color).through(0.35));
            }
        }
    }
}

/// The screw axes of every end disk in the frame of the one below it, as the model and the tracker have them; with a tracker on the last
/// alone, those of that disk in {B}.
pub fn axes(scene: &mut Scene, run: &ChainRun, instant: &Instant<'_>, chosen: usize) {
    let place = instant.place;
    let Some(&time) = run.recording.times.get(place) else { return };
    for (segment, judged) in run.judged.segments.iter().enumerate() {
        let Some(evidence) = judged.evidence.get(place) else { continue };
        let [theta_l, delta] = run.recording.told[segment][place].rates;
        let model = instant.turning(segment, Rate { theta_l, delta });
        Screws::of(instant, segment, segment == chosen).draw(scene, model, judged, evidence, time);
    }
    let last = instant.sizes.len() - 1;
    if let (Some(motions), Some(judgement)) = (run.judged.tip_motions(place), run.judged.judgement(last, place)) {
        let settings = &run.judged.settings;
        let standing = Method::FcdConsistent.statistic(&judgement, time, &settings.segments[last].thresholds).standing;
        let [model, sensor] = motions.map(|motion| {
            let point = centrode(&motion.position, &motion.twist)?;
            Some(Axis { point, angular: motion.twist.angular })
        });
        let over = settings.smd.is_some_and(|smd| judgement.consistent > smd.distance || judgement.turned > smd.angle);
        let seen = Seen { standing, deviation: judgement.consistent, over };
        if let (Some(model), Some(sensor)) = (model, sensor) {
            Screws::of_whole(instant).axes(scene, &model, &sensor, seen);
        }
    }
}

/// An instantaneous screw axis: its point nearest to the base that it is seen from (m), and ω.
struct Axis {
    point: Vector,
    angular: Vector,
}

/// How the axes of model and tracker stand to each other.
#[derive(Clone, Copy)]
struct Seen {
    standing: Standing,
    /// m.
    deviation: f64,
    over: bool,
}

/// Where the screw axes of one end disk are drawn, and how large.
struct Screws<'a> {
    pen: Pen<'a>,
    base: Pose,
    /// m.
    length: f64,
    half: f32,
    size: f32,
    told: bool,
}

impl<'a> Screws<'a> {
    fn of(instant: &'a Instant<'_>, segment: usize, is_chosen: bool) -> Self {
        let length = instant.sizes[segment].length;
        Self {
            pen: instant.pen(segment),
            base: instant.bent.pose(segment, 0.0),
            length: f64::from(length),
            half: AXIS[usize::from(!is_chosen)] * length,
            size: if is_chosen { 1.0 } else { SMALL },
            // Of the others their axes are enough.
            told: is_chosen,
        }
    }

    /// Of the last end disk in {B}.
    fn of_whole(instant: &'a Instant<'_>) -> Self {
        let length = instant.sizes.iter().map(|sizes| f64::from(sizes.length)).sum();
        Self { base: instant.bent.pose(0, 0.0), length, ..Self::of(instant, instant.sizes.len() - 1, true) }
    }

    fn point(&self, axis: &Axis) -> Option<Vec3> {
        (axis.point.norm() < FAR[0] * self.length).then(|| self.base.point(scene_vector(&axis.point)))
    }

    fn along(&self, axis: &Axis) -> Vec3 {
        self.base.rotation * scene_vector(&axis.angular).normalize_or_zero() * self.half
    }

    fn draw(&self, scene: &mut Scene, turning: Vector, judged: &Judged, evidence: &Evidence, time: f64) {
        let judgement = &evidence.judgement;
        let thresholds = &judged.settings.thresholds;
        let seen = Seen {
            standing: Method::Fcd.statistic(judgement, time, thresholds).standing,
            deviation: judgement.deviation,
            over: thresholds.xi2.value().is_some_and(|xi2| judgement.deviation > xi2),
        };
        let model = Axis { point: judgement.model_centrode, angular: turning };
        let sensor = Axis { point: judgement.sensor_centrode, angular: evidence.motion.twist.angular };
        self.axes(scene, &model, &sensor, seen);
    }

    fn axes(&self, scene: &mut Scene, model: &Axis, sensor: &Axis, seen: Seen) {
        let (pen, palette) = (&self.pen, self.pen.palette);
        let Some(at) = self.point(model) else { return };
        pen.axis(scene, at, self.along(model), palette.model);
        let near = seen.standing != Standing::Silent && seen.deviation <= FAR[1] * self.length;
        if let Some(read) = self.point(sensor).filter(|_| near) {
            let armed = seen.standing == Standing::Counts;
            let strength = if armed { 1.0 } else { 0.45 };
            pen.axis(scene, read, self.along(sensor), palette.sensor.alpha(strength));
            if armed && self.told {
                let color = if seen.over { palette.detection } else { palette.ink };
                pen.deviation(scene, [at, read], color);
                pen.distance(scene, [at, read], seen.deviation, color);
            }
            scene.markers.push(pen.sign(read, Shape::Dot, 18.0 * self.size, palette.sensor).faded(strength));
        }
        scene.markers.push(pen.sign(at, Shape::Triangle, 15.0 * self.size, palette.model));
    }
}

/// Where contacts are placed along the whole backbone, as far as that is known; the latest alarm has a ring around it.
pub fn placed(scene: &mut Scene, run: &ChainRun, instant: &Instant<'_>, placed: &[&ChainEstimate], pulse: f32) {
    let alarm = |estimate: &ChainEstimate| estimate.time - estimate.after;
    let latest = placed.iter().map(|estimate| alarm(estimate)).fold(f64::NEG_INFINITY, f64::max);
    for estimate in placed {
        let pulse = if alarm(estimate) == latest { pulse } else { 0.0 };
        let most = estimate.posterior.iter().map(|posterior| band::most(posterior)).fold(0.0, f64::max);
        let mut base = 0.0;
        for (segment, posterior) in estimate.posterior.iter().enumerate() {
            let interval = [estimate.along.low - base, estimate.along.high - base];
            let steps = band::steps_of(posterior, most, interval);
            instant.pen(segment).band(scene, &steps, |s| instant.on(segment, s));
            base += run.plan.scenario().segments[segment].alone.segment().length;
        }
        place(scene, instant, estimate, pulse);
    }
}

/// The likeliest segment with the place there, and the ends of its interval.
fn place(scene: &mut Scene, instant: &Instant<'_>, estimate: &ChainEstimate, pulse: f32) {
    let (segment, place) = (estimate.segment, &estimate.place);
    let (pen, palette) = (instant.pen(segment), instant.palette);
    let aside = instant.aside(segment, place.mean, 1.9);
    pen.ends(scene, [place.low, place.high].map(|s| instant.on(segment, s).position), aside);
    // The sign stands beside the backbone, where it does not hide the band.
    let at = instant.on(segment, place.mean).position;
    let off = at + aside;
    scene.lines.push(Line::new(vec![at, off], 1.5, palette.detection).through(0.9).lifted(pen.lift));
    scene.markers.push(pen.sign(off, Shape::Diamond, 14.0, palette.detection).pulsing(pulse));
    let offset = Vec2::new(-8.0, -8.0);
    scene.labels.push(Label { anchor: off, offset, text: words(estimate), color: palette.detection });
}

/// An estimate in words.
fn words(estimate: &ChainEstimate) -> String {
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    if estimate.nothing > 0.5 {
        return format!("nothing touches: {}", percent(estimate.nothing));
    }
    let place = band::between(&estimate.place);
    match estimate.probabilities[..] {
        [_] => place,
        _ => {
            format!("segment {}: {place}, {}", estimate.segment + 1, percent(estimate.probabilities[estimate.segment]))
        }
    }
}

/// That the chain gave way, where the run ends for it.
pub fn end(scene: &mut Scene, run: &ChainRun, instant: &Instant<'_>, time: f64) {
    let last = run.recording.times.last().copied().unwrap_or(0.0);
    let text = run.plan.path().happened().iter().find_map(|event| match event.what {
        What::Buckled => Some("buckled"),
        What::Lost => Some("gives way"),
        What::Met(_) | What::Opened(_) => None,
    });
    let (Some(text), true) = (text, time >= last) else { return };
    let segment = instant.sizes.len() - 1;
    let anchor = instant.bent.pose(segment, 1.0).point(Vec3::Z * (1.5 * instant.sizes[segment].disk));
    let color: Color = instant.palette.detection;
    scene.labels.push(Label { anchor, offset: Vec2::new(8.0, 8.0), text: text.into(), color });
}
