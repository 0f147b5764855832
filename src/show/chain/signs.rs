//! Signs at the end disks: their names, their instantaneous screw axes, and where contacts are placed.

use super::Instant;
use crate::scene::{Color, Label, Line, Pose, Scene, Shape, arc};
use crate::show::pen::Pen;
use crate::show::{band, scene_vector};
use centrode_core::detect::chain::ChainEstimate;
use centrode_core::detect::evidence::Evidence;
use centrode_core::detect::judge::Judged;
use centrode_core::detect::{Method, Standing};
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

/// The screw axes of every end disk in the frame of the one below it, as the model and the tracker have them.
pub fn axes(scene: &mut Scene, run: &ChainRun, instant: &Instant<'_>, chosen: usize) {
    let place = instant.place;
    let Some(&time) = run.recording.times.get(place) else { return };
    for (segment, judged) in run.judged.segments.iter().enumerate() {
        let Some(evidence) = judged.evidence.get(place) else { continue };
        let [theta_l, delta] = run.recording.told[segment][place].rates;
        let is_chosen = segment == chosen;
        let screws = Screws { instant, segment, is_chosen, judged, evidence };
        screws.draw(scene, time, Rate { theta_l, delta });
    }
}

/// The screw axes of one end disk.
struct Screws<'a> {
    instant: &'a Instant<'a>,
    segment: usize,
    is_chosen: bool,
    judged: &'a Judged,
    evidence: &'a Evidence,
}

impl Screws<'_> {
    fn base(&self) -> Pose {
        self.instant.bent.pose(self.segment, 0.0)
    }

    fn point(&self, centrode: &Vector) -> Option<Vec3> {
        let length = f64::from(self.instant.sizes[self.segment].length);
        (centrode.norm() < FAR[0] * length).then(|| self.base().point(scene_vector(centrode)))
    }

    fn along(&self, angular: &Vector) -> Vec3 {
        let half = AXIS[usize::from(!self.is_chosen)] * self.instant.sizes[self.segment].length;
        self.base().rotation * scene_vector(angular).normalize_or_zero() * half
    }

    fn draw(&self, scene: &mut Scene, time: f64, rate: Rate) {
        let (pen, palette) = (self.instant.pen(self.segment), self.instant.palette);
        let size = if self.is_chosen { 1.0 } else { SMALL };
        let judgement = &self.evidence.judgement;
        let Some(model) = self.point(&judgement.model_centrode) else { return };
        pen.axis(scene, model, self.along(&self.turning(rate)), palette.model);
        let thresholds = &self.judged.settings.thresholds;
        let standing = Method::Fcd.statistic(judgement, time, thresholds).standing;
        let length = f64::from(self.instant.sizes[self.segment].length);
        let seen = standing != Standing::Silent && judgement.deviation <= FAR[1] * length;
        let sensor = self.point(&judgement.sensor_centrode).filter(|_| seen);
        if let Some(sensor) = sensor {
            let armed = standing == Standing::Counts;
            let strength = if armed { 1.0 } else { 0.45 };
            let along = self.along(&self.evidence.motion.twist.angular);
            pen.axis(scene, sensor, along, palette.sensor.alpha(strength));
            if armed {
                let over = thresholds.xi2.value().is_some_and(|xi2| judgement.deviation > xi2);
                let color = if over { palette.detection } else { palette.ink };
                // Of the others their axes are enough.
                if self.is_chosen {
                    pen.deviation(scene, [model, sensor], color);
                    pen.distance(scene, [model, sensor], judgement.deviation, color);
                }
            }
            scene.markers.push(pen.sign(sensor, Shape::Dot, 18.0 * size, palette.sensor).faded(strength));
        }
        scene.markers.push(pen.sign(model, Shape::Triangle, 15.0 * size, palette.model));
    }

    /// ω of the model in the frame of the disk below, up to its size; at rest that of bending.
    fn turning(&self, rate: Rate) -> Vector {
        let rate = if rate == Rate::default() { Rate::BENDING } else { rate };
        let length = f64::from(self.instant.sizes[self.segment].length);
        Arc { length, configuration: self.instant.told[self.segment] }.jacobian(length).twist(rate).angular
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
