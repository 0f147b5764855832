//! Curvature along a chain, so that one cut of the backbone into pieces can take over from another.

use super::gauss::Gauss;
use super::modes::{Layout, Units};
use super::shape::{advance, curvatures};
use super::{Bends, Rod, Torsion};
use crate::model::contact::ritz::recurrence;
use crate::model::{Mat3, Pose, Vec3};
use nalgebra::DVector;

/// A step along the backbone is integrated as well as curvature with so many terms needs.
const STEP: usize = 10;

/// Curvature and twist of every segment, as Legendre series over its parts. Lengths in units of the whole chain's.
#[derive(Debug, Clone)]
pub(super) struct Profile {
    segments: Vec<Vec<Span>>,
}

/// A part of a segment.
#[derive(Debug, Clone)]
struct Span {
    /// Arc lengths from the segment's base.
    from: f64,
    to: f64,
    series: Vec<Vec3>,
}

impl Span {
    fn at(&self, s: f64) -> Vec3 {
        let mut p = vec![0.0; self.series.len()];
        recurrence(2.0 * (s - self.from) / (self.to - self.from) - 1.0, &mut p);
        self.series.iter().zip(p).fold(Vec3::zeros(), |sum, (factor, p)| sum + factor * p)
    }
}

impl Profile {
    /// Of a chain that nothing touches.
    pub fn free(rods: &[Rod], bends: &[Bends]) -> Self {
        let whole = Units::of(rods).length;
        let segments = rods.iter().zip(bends).map(|(rod, bends)| vec![arc(0.0, rod.length / whole, bends)]);
        Self { segments: segments.collect() }
    }

    /// Of the factors x of a layout; `bends` are those of every segment.
    pub fn of(layout: &Layout, rods: &[Rod], x: &DVector<f64>, bends: &[Bends]) -> Self {
        let mut profile = Self::free(rods, bends);
        let flat = bends[..layout.segments()].iter().flat_map(|bends| [bends.x, bends.y]);
        let factors: Vec<f64> = x.iter().copied().chain(flat).collect();
        let count = layout.gauss.count();
        let all = curvatures(layout, &factors);
        for (segment, spans) in profile.segments.iter_mut().enumerate().take(layout.segments()) {
            let pieces = layout.modes[layout.column(segment, 0)].pieces.clone();
            let mut from = 0.0;
            let span = |piece: usize| {
                let to = from + layout.pieces[piece].length;
                let series = layout.gauss.series(&all[piece * count..(piece + 1) * count], layout.gauss.modes);
                Span { from: std::mem::replace(&mut from, to), to, series }
            };
            *spans = pieces.map(span).collect();
            if segment + 1 == layout.segments()
                && let Some(rest) = layout.rest
            {
                let bent = Bends::from_fn(|i, _| bends[segment][i] * rest.share + x[rest.modes[i]] * rest.bend);
                spans.push(arc(from, from + rest.length, &bent));
            }
        }
        profile
    }

    fn at(&self, segment: usize, s: f64) -> Vec3 {
        let spans = &self.segments[segment];
        let place = spans.partition_point(|span| span.to < s).min(spans.len() - 1);
        spans[place].at(s)
    }

    /// The factors x of a layout: the work of its terms on this curvature, for they are orthonormal in the elastic energy.
    pub fn factors(&self, layout: &Layout, rods: &[Rod]) -> DVector<f64> {
        let (units, count) = (Units::of(rods), layout.gauss.count());
        let mut x = DVector::zeros(layout.unknowns);
        for (segment, rod) in rods.iter().enumerate().take(layout.segments()) {
            let bending = rod.bending_stiffness / units.stiffness;
            let twisting = if let Torsion::Ratio(ratio) = rod.torsion { bending * ratio } else { 0.0 };
            let stiffness = [bending, bending, twisting];
            let mut from = 0.0;
            for piece in layout.modes[layout.column(segment, 0)].pieces.clone() {
                let length = layout.pieces[piece].length;
                for node in 0..count {
                    let share = 0.5 * (layout.gauss.legendre[node][1] + 1.0);
                    let curvature = self.at(segment, from + share * length);
                    let weight = layout.gauss.weights[node] * length;
                    for (factor, mode) in x.iter_mut().zip(&layout.modes) {
                        if mode.pieces.contains(&piece) {
                            let value = mode.values[(piece - mode.pieces.start) * count + node];
                            *factor += weight * stiffness[mode.axis] * value * curvature[mode.axis];
                        }
                    }
                }
                from += length;
            }
            if segment + 1 == layout.segments()
                && let Some(rest) = layout.rest
            {
                let middle = self.at(segment, from + 0.5 * rest.length);
                for (axis, mode) in rest.modes.into_iter().enumerate() {
                    x[mode] += bending * rest.bend * middle[axis];
                }
            }
        }
        x
    }
}

impl Profile {
    /// The pose of a point of the backbone in {B}, m: on a segment, at an arc length (m) from that segment's base.
    pub fn pose(&self, rods: &[Rod], segment: usize, at: f64) -> Pose {
        let whole = Units::of(rods).length;
        let gauss = Gauss::new(STEP);
        let mut base = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
        for (below, rod) in rods.iter().enumerate().take(segment + 1) {
            let to = if below == segment { at } else { rod.length };
            base = self.walk(&gauss, base, below, 0.0, to / whole);
        }
        Pose { position: base.position * whole, ..base }
    }

    /// Poses along every segment in {B}, m: its base, and the ends of so many equal steps.
    pub fn backbone(&self, rods: &[Rod], parts: usize) -> Vec<Vec<Pose>> {
        let whole = Units::of(rods).length;
        let gauss = Gauss::new(STEP);
        let mut base = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
        let meters = |pose: Pose| Pose { position: pose.position * whole, ..pose };
        let walked = rods.iter().enumerate().map(|(segment, rod)| {
            let step = rod.length / whole / parts as f64;
            let mut poses = vec![meters(base)];
            poses.extend((0..parts).map(|k| {
                base = self.walk(&gauss, base, segment, step * k as f64, step * (k + 1) as f64);
                meters(base)
            }));
            poses
        });
        walked.collect()
    }

    /// The integral of curvature over a segment from its base to an arc length (m), about x and y, rad.
    pub fn bends_below(&self, rods: &[Rod], segment: usize, at: f64) -> Bends {
        let (whole, gauss) = (Units::of(rods).length, Gauss::new(STEP));
        let mut bends = Bends::zeros();
        for span in &self.segments[segment] {
            let length = span.to.min(at / whole) - span.from;
            if length > 0.0 {
                let share = |p: &[f64]| 0.5 * (p[1] + 1.0);
                for (p, weight) in gauss.legendre.iter().zip(&gauss.weights) {
                    bends += span.at(span.from + share(p) * length).xy() * (weight * length);
                }
            }
        }
        bends
    }

    /// Along a segment from one arc length to another, span by span.
    fn walk(&self, gauss: &Gauss, base: Pose, segment: usize, from: f64, to: f64) -> Pose {
        let mut at = base;
        for span in &self.segments[segment] {
            let (start, end) = (span.from.max(from), span.to.min(to));
            let length = end - start;
            if length > 0.0 {
                let shares = gauss.legendre.iter().map(|p| 0.5 * (p[1] + 1.0));
                let turns: Vec<Vec3> = shares.map(|share| span.at(start + share * length)).collect();
                at = advance(gauss, &at, length, &turns).unwrap_or(at);
            }
        }
        at
    }
}

fn arc(from: f64, to: f64, bends: &Bends) -> Span {
    let length = to - from;
    Span { from, to, series: vec![Vec3::new(bends.x / length, bends.y / length, 0.0)] }
}
