//! What contacts on a segment change in what the trackers read.
//!
//! The joints fix how far each segment bends, whatever touches it: that drives the model of the whole chain against a plane. Its shapes are
//! exact; they are solved at a few places, tilts, beginnings and times after them, and interpolated in between. A clamp is an arc upon an arc.

use super::course::{Course, last};
use crate::detect::calibration::Six;
use crate::detect::calibration::course::residual;
use crate::detect::calibration::filter::Signature;
use crate::detect::calibration::jointly;
use crate::detect::calibration::sheet::{Softness, TILTS, WIDE, tilts};
use crate::detect::calibration::signature::{PLACES, places};
use crate::model::chain::Contact;
use crate::model::{Configuration, Mat3, Pose};
use libm::cos;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Beginnings, and times after each, at which shapes are solved.
const BEGINNINGS: usize = 4;
pub(super) const TIMES: usize = 6;

/// What the trackers see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Seen {
    /// Every end disk, in the frame of the one below it.
    Each,
    /// The last end disk alone, along these axes in {B}.
    Last(Mat3),
}

/// What contacts on one segment change.
#[derive(Debug)]
pub(super) struct Hypotheses<'a> {
    course: &'a Course,
    segment: usize,
    seen: Seen,
    /// Beginnings in readings.
    began: [f64; BEGINNINGS],
    /// By tracker, then by beginning, then by time.
    planes: Vec<Vec<[Signature<WIDE>; TIMES]>>,
    may_clamp: bool,
    softness: Softness,
}

/// Contacts that began at the same instant.
#[derive(Debug)]
pub(super) struct Met<'a> {
    of: &'a Hypotheses<'a>,
    began: f64,
    /// By tracker, then by time.
    planes: Vec<[Signature<WIDE>; TIMES]>,
}

static AT: LazyLock<[f64; TIMES]> =
    LazyLock::new(|| std::array::from_fn(|i| 0.5 * (1.0 - cos(PI * (2 * i + 2) as f64 / (2 * TIMES + 1) as f64))));

/// Shares of the time from a beginning to the last reading: with the beginning, Chebyshev points of Radau's kind.
pub(super) fn times() -> [f64; TIMES] {
    *AT
}

/// What is known at these times between an instant and the last reading, at a reading: nothing before the instant.
pub(super) fn interpolated<const N: usize>(
    all: &[Signature<N>; TIMES],
    [began, last]: [f64; 2],
    reading: usize,
) -> Signature<N> {
    let share = (reading as f64 - began) / (last - began);
    let mut signature = Signature::<N>::zeros();
    if share > 0.0 {
        for (at, by) in all.iter().zip(weights(&times(), share, true)) {
            signature.zip_apply(at, |sum, at| *sum += at * by);
        }
    }
    signature
}

/// Lagrange's polynomials of these nodes at a point; with one more at 0, which counts for nothing, where there is one.
fn weights<const N: usize>(nodes: &[f64; N], at: f64, zero: bool) -> [f64; N] {
    std::array::from_fn(|i| {
        let others = nodes.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| *other);
        others.chain(zero.then_some(0.0)).map(|other| (at - other) / (nodes[i] - other)).product()
    })
}

impl<'a> Hypotheses<'a> {
    /// Of contacts on a segment that began between two readings, besides those that are known; `first_tilt` (rad) is the first of the tilts at
    /// which shapes are solved.
    pub fn new(
        course: &'a Course,
        seen: Seen,
        segment: usize,
        [first, latest]: [usize; 2],
        known: &[Contact],
        first_tilt: f64,
    ) -> Option<Self> {
        let end = course.last as f64;
        let last_began = (latest as f64).min(end - 1.0);
        let (middle, half) = (0.5 * (first as f64 + last_began), (0.5 * (last_began - first as f64)).max(0.5));
        let began = std::array::from_fn(|j| middle - half * cos(PI * (j as f64 + 0.5) / BEGINNINGS as f64));
        let trackers = if seen == Seen::Each { segment + 1 } else { 1 };
        let none: [Signature<WIDE>; TIMES] = [Signature::zeros(); TIMES];
        let may_clamp = course.rests_below(segment, first);
        let planes = vec![vec![none; BEGINNINGS]; trackers];
        let mut of = Self { course, segment, seen, began, planes, may_clamp, softness: Softness::even() };
        let mut soft = [[1.0; TILTS]; PLACES];
        for (row, &began) in began.iter().enumerate() {
            let instants = times().map(|share| began + share * (end - began));
            let without: Vec<Vec<Pose>> = if known.is_empty() {
                instants.iter().map(|at| course.free(*at)).collect()
            } else {
                course.followed(known, &instants, known.len())
            };
            for (column, place) in places().into_iter().enumerate() {
                let point = course.point(known, segment, place, began)?;
                for (turned, tilt) in tilts(first_tilt).into_iter().enumerate() {
                    let mut contacts = known.to_vec();
                    contacts.push(course.plane(&point, segment, place, tilt, began));
                    let with = course.followed(&contacts, &instants, known.len());
                    if row == 0 {
                        soft[column][turned] = course.softness(&contacts, 0.5 * (began + end))?;
                    }
                    for (time, (with, without)) in with.iter().zip(&without).enumerate() {
                        for tracker in 0..trackers {
                            let off = of.off(tracker, instants[time], without, with);
                            of.planes[tracker][row][time].set_column(turned * PLACES + column, &off);
                        }
                    }
                }
            }
        }
        of.softness = Softness::of(first_tilt, &soft);
        Some(of)
    }

    fn off(&self, tracker: usize, at: f64, without: &[Pose], with: &[Pose]) -> Six {
        self.seen.off(self.course, tracker, at, [without, with])
    }
}

impl Seen {
    /// How a tracker's reading of some end disks differs from that of others.
    pub fn off(&self, course: &Course, tracker: usize, at: f64, [without, with]: [&[Pose]; 2]) -> Six {
        match self {
            Self::Each => {
                let axes = axes(course.configuration(tracker, at));
                residual(&without[tracker], &axes, &with[tracker])
            }
            Self::Last(axes) => residual(&last(without), axes, &last(with)),
        }
    }
}

impl<'a> jointly::Hypotheses for &'a Hypotheses<'a> {
    type Met = Met<'a>;

    fn seen_by(&self) -> usize {
        self.planes.len()
    }

    fn met(&self, began: f64) -> Met<'a> {
        let by = weights(&self.began, began, false);
        let at = |all: &Vec<[Signature<WIDE>; TIMES]>| {
            std::array::from_fn(|time| {
                all.iter().zip(by).fold(Signature::zeros(), |sum, (signatures, by)| sum + signatures[time] * by)
            })
        };
        Met { of: self, began, planes: self.planes.iter().map(at).collect() }
    }

    fn softness(&self) -> Softness {
        self.softness
    }

    fn may_clamp(&self) -> bool {
        self.may_clamp
    }
}

impl jointly::Met for Met<'_> {
    fn planes(&self, tracker: usize, reading: usize) -> Signature<WIDE> {
        interpolated(&self.planes[tracker], [self.began, self.of.course.last as f64], reading)
    }

    fn clamps(&self, tracker: usize, reading: usize) -> Signature<PLACES> {
        let Hypotheses { course, segment, seen, .. } = *self.of;
        let at = reading as f64;
        let mut signature = Signature::zeros();
        if at <= self.began || (seen == Seen::Each && tracker != segment) {
            return signature;
        }
        let free = course.free(at);
        for (column, place) in places().into_iter().enumerate() {
            let clamped = course.clamped(segment, place, self.began, at);
            signature.set_column(column, &self.of.off(tracker, at, &free, &clamped));
        }
        signature
    }
}

/// Axes of the bending plane, in the frame of the segment's base.
pub(super) fn axes(configuration: Configuration) -> Mat3 {
    let (sin, cos) = configuration.sin_cos_delta();
    Mat3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::course::Bending;
    use super::*;
    use crate::detect::calibration::jointly::{Hypotheses as _, Met as _};
    use crate::detect::calibration::signature::free_weights;
    use crate::model::chain::{Rod, Torsion};

    /// Three segments that bend at once, as in the preset `three-segments`: 75 readings.
    fn course() -> Course {
        let rods = [3.0, 2.0, 1.0].map(|share| Rod {
            length: 0.03,
            bending_stiffness: 0.001 * share,
            torsion: Torsion::Ratio(5.0),
        });
        let bending = |(bend, rate, delta, turn): (f64, f64, f64, f64)| {
            let along = |from: f64, rate: f64| (0..75).map(|k| from + rate * f64::from(k) * 0.01).collect::<Vec<_>>();
            Bending { bends: along(bend, rate), deltas: along(delta, turn), commanded: along(bend, rate) }
        };
        let told = [(0.4, 0.19, 0.3, 0.0), (0.47, 0.22, 0.5, 0.25), (0.6, 0.28, -0.5, 0.0)];
        Course::new(rods.into(), told.map(bending).into()).expect("readings")
    }

    #[test]
    fn between_the_nodes_it_is_what_is_solved() {
        let course = course();
        // Strong contacts far out have more waves over the tilt than others: they are solved at the tilt that they seem to have.
        for (segment, first) in [(0, 0.0), (1, 0.0), (2, 0.0), (2, 0.35), (2, -0.7)] {
            let hypotheses = Hypotheses::new(&course, Seen::Each, segment, [0, 25], &[], first).expect("solved");
            let of = &hypotheses;
            for (began, reading, place, tilt) in
                [(3.3, 74, 0.5, 0.0), (18.0, 60, 0.41, 0.35), (11.0, 30, 0.63, 1.2), (24.0, 74, 0.55, -0.7)]
            {
                if segment == 2 && tilt != first {
                    continue;
                }
                let point = course.point(&[], segment, place, began).expect("free");
                let plane = course.plane(&point, segment, place, tilt, began);
                let at = f64::from(reading);
                let with = course.followed(&[plane], &[at], 0);
                let exact = of.off(segment, at, &course.free(at), &with[0]);
                let signature = of.met(began).planes(segment, reading as usize);
                let (tilted, along) = (hypotheses.softness.tilted(tilt), free_weights(place));
                let ours = (0..TILTS).fold(Six::zeros(), |sum, a| {
                    (0..PLACES).fold(sum, |sum, i| sum + signature.column(a * PLACES + i) * (tilted[a][i] * along[i]))
                });
                let off = (ours - exact).fixed_rows::<3>(1).norm();
                assert!(off < 3e-6, "segment {segment}, {began}, {tilt}: {off} of {exact}");
            }
        }
    }
}
