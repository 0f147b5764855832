//! What planes on a segment change in the motion of every end disk.
//!
//! The joints fix how far each segment bends, whatever touches it: that angle is measured, smoothed over some readings, and drives the
//! model of the whole chain against a plane. Its shapes are exact; they are solved at a few places, beginnings and times after them, and
//! interpolated in between.

use crate::detect::calibration::course::{Moment, residual};
use crate::detect::calibration::filter::Signature;
use crate::detect::calibration::jointly;
use crate::detect::calibration::marginal::History;
use crate::detect::calibration::signature::{PLACES, places};
use crate::model::chain::pressed::Pressed;
use crate::model::chain::{Bends, Contact, Rod, bends, configuration, free};
use crate::model::{Configuration, Mat3, Pose, Vec3};
use libm::cos;
use std::f64::consts::PI;

/// Beginnings, and times after each, at which shapes are solved.
const BEGINNINGS: usize = 5;
const TIMES: usize = 6;
/// Readings to either side over which angles are smoothed by a parabola.
const SMOOTHED: usize = 8;
/// A contact begins where something is told to move by more than this (rad) from one reading to the next.
const STILL: f64 = 1e-6;

/// A contact that is known: its segment, its place on it (m), and the reading at which it was met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KnownContact {
    pub segment: usize,
    pub at: f64,
    pub began: f64,
}

/// How far every segment bends, reading by reading, and how it is told to.
#[derive(Debug)]
pub(super) struct Course {
    rods: Vec<Rod>,
    bends: Vec<Vec<f64>>,
    deltas: Vec<Vec<f64>>,
    commanded: Vec<Vec<f64>>,
    pub last: usize,
}

/// What contacts on one segment change.
#[derive(Debug)]
pub(super) struct Hypotheses {
    segment: usize,
    /// Beginnings in readings, and the last reading.
    began: [f64; BEGINNINGS],
    last: f64,
    /// By tracker, then by beginning, then by time.
    signatures: Vec<Vec<[Signature<PLACES>; TIMES]>>,
}

/// Shares of the time from a beginning to the last reading: with the beginning, Chebyshev points of Radau's kind.
fn times() -> [f64; TIMES] {
    std::array::from_fn(|i| 0.5 * (1.0 - cos(PI * (2 * i + 2) as f64 / (2 * TIMES + 1) as f64)))
}

/// Lagrange's polynomials of these nodes at a point; with one more at 0, which counts for nothing, where there is one.
fn weights<const N: usize>(nodes: &[f64; N], at: f64, zero: bool) -> [f64; N] {
    std::array::from_fn(|i| {
        let others = nodes.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| *other);
        others.chain(zero.then_some(0.0)).map(|other| (at - other) / (nodes[i] - other)).product()
    })
}

impl jointly::Hypotheses for Hypotheses {
    fn seen_by(&self) -> usize {
        self.segment + 1
    }

    fn signature(&self, tracker: usize, began: f64, reading: usize) -> Signature<PLACES> {
        let share = (reading as f64 - began) / (self.last - began);
        let mut sum = Signature::zeros();
        if share <= 0.0 {
            return sum;
        }
        let by_time = weights(&times(), share, true);
        for (signatures, by) in self.signatures[tracker].iter().zip(weights(&self.began, began, false)) {
            for (signature, weight) in signatures.iter().zip(by_time) {
                sum += signature * (by * weight);
            }
        }
        sum
    }
}

impl Course {
    /// Of the readings of every segment.
    pub fn new(rods: &[Rod], histories: &[History]) -> Option<Self> {
        let last = histories.iter().map(|history| history.readings.len()).min()?.checked_sub(1)?;
        let of = |value: fn(&Moment) -> f64| {
            let each = histories.iter().map(|history| history.moments[..=last].iter().map(value).collect());
            each.collect::<Vec<Vec<f64>>>()
        };
        let measured = |history: &History| {
            let angle = |(moment, pose): (&Moment, &Pose)| moment.command.bend + moment.residual(pose)[0];
            let raw: Vec<f64> = history.moments.iter().zip(history.readings).take(last + 1).map(angle).collect();
            (0..raw.len()).map(|k| smoothed(k, &raw)).collect()
        };
        let bends = histories.iter().map(measured).collect();
        let (deltas, commanded) = (of(|moment| moment.command.delta), of(|moment| moment.command.bend));
        Some(Self { rods: rods.to_vec(), bends, deltas, commanded, last })
    }

    /// The readings between two at which something is told to move.
    pub fn moving(&self, [first, latest]: [usize; 2]) -> Vec<usize> {
        let changes = |all: &[Vec<f64>], k: usize| all.iter().any(|of| (of[k + 1] - of[k]).abs() > STILL);
        let moves = |k: &usize| changes(&self.commanded, *k) || changes(&self.deltas, *k);
        (first..self.last.min(latest + 1)).filter(moves).collect()
    }

    fn configuration(&self, segment: usize, at: f64) -> Configuration {
        let before = (at.max(0.0) as usize).min(self.last);
        let (after, share) = ((before + 1).min(self.last), (at - before as f64).clamp(0.0, 1.0));
        let mean = |all: &[f64]| all[before] + share * (all[after] - all[before]);
        Configuration::new(mean(&self.bends[segment]), mean(&self.deltas[segment]))
    }

    fn at(&self, at: f64) -> Vec<Bends> {
        (0..self.rods.len()).map(|segment| bends(self.configuration(segment, at))).collect()
    }

    fn largest(&self) -> Vec<Bends> {
        let most = |all: &Vec<f64>| all.iter().map(|bend| bend.abs()).fold(0.0, f64::max);
        self.bends.iter().map(|all| Bends::new(0.0, most(all))).collect()
    }

    /// The plane that a contact meets at an instant: where its point is then, and along the tangent there, with the contacts that hold before.
    fn plane(&self, known: &[Contact], segment: usize, place: f64, began: f64) -> Option<Contact> {
        let bends = self.at(began);
        let relative = if known.is_empty() {
            bends.iter().zip(&self.rods).map(|(bends, rod)| free::pose(rod.length, configuration(bends))).collect()
        } else {
            Pressed::new(&self.rods, known, &self.largest(), known.len()).next(&bends)?
        };
        let nothing = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
        let base = relative[..segment].iter().fold(nothing, joined);
        let own = self.configuration(segment, began);
        let point = joined(base, &free::pose(place * self.rods[segment].length, own.with_bend(place * own.bend())));
        let (sin, cos) = own.sin_cos_delta();
        let normal = point.rotation * Vec3::new(cos, -sin, 0.0);
        Some(Contact { segment, at: place * self.rods[segment].length, normal, offset: normal.dot(&point.position) })
    }

    /// The planes of contacts that are known, the earlier ones first.
    pub fn planes(&self, known: &[KnownContact]) -> Option<Vec<Contact>> {
        let mut planes = Vec::new();
        for contact in known {
            let place = contact.at / self.rods[contact.segment].length;
            planes.push(self.plane(&planes, contact.segment, place, contact.began)?);
        }
        Some(planes)
    }

    /// What contacts on a segment that began between two readings change, besides those that are known.
    pub fn hypotheses(&self, segment: usize, [first, latest]: [usize; 2], known: &[Contact]) -> Option<Hypotheses> {
        let last = self.last as f64;
        let latest = (latest as f64).min(last - 1.0);
        let (middle, half) = (0.5 * (first as f64 + latest), (0.5 * (latest - first as f64)).max(0.5));
        let began = std::array::from_fn(|j| middle - half * cos(PI * (j as f64 + 0.5) / BEGINNINGS as f64));
        let none: [Signature<PLACES>; TIMES] = [Signature::zeros(); TIMES];
        let mut signatures = vec![vec![none; BEGINNINGS]; segment + 1];
        let largest = self.largest();
        for (row, &began) in began.iter().enumerate() {
            let instants = times().map(|share| began + share * (last - began));
            let without = self.course(known, &largest, &instants, known.len())?;
            for (column, place) in places().into_iter().enumerate() {
                let mut contacts = known.to_vec();
                contacts.push(self.plane(known, segment, place, began)?);
                let with = self.course(&contacts, &largest, &instants, known.len())?;
                for (time, (with, without)) in with.iter().zip(&without).enumerate() {
                    for (tracker, signatures) in signatures.iter_mut().enumerate() {
                        let axes = axes(self.configuration(tracker, instants[time]));
                        let off = residual(&without[tracker], &axes, &with[tracker]);
                        signatures[row][time].set_column(column, &off);
                    }
                }
            }
        }
        Some(Hypotheses { segment, began, last, signatures })
    }

    /// What was read, less what contacts that are known change in it since the first of them was met (in readings): a tracker would have read so
    /// without them. `poses` holds the readings of every segment.
    pub fn without(&self, known: &[Contact], since: f64, poses: &[&[Pose]]) -> Option<Vec<Vec<Pose>>> {
        let mut corrected: Vec<Vec<Pose>> = poses.iter().map(|poses| poses[..=self.last].to_vec()).collect();
        let first = (since.max(0.0) as usize + 1).min(self.last);
        let instants: Vec<f64> = (first..=self.last).map(|k| k as f64).collect();
        let largest = self.largest();
        let with = self.course(known, &largest, &instants, known.len())?;
        let free = self.course(&[], &largest, &instants, 0)?;
        for (k, (with, free)) in with.iter().zip(&free).enumerate() {
            for (tracker, poses) in corrected.iter_mut().enumerate() {
                let pose = &mut poses[first + k];
                pose.position -= with[tracker].position - free[tracker].position;
                pose.rotation = free[tracker].rotation * with[tracker].rotation.tr_mul(&pose.rotation);
            }
        }
        Some(corrected)
    }

    /// The end disks, each in the frame of the one below it, at some instants; the first `pushing` contacts may be left.
    fn course(
        &self,
        contacts: &[Contact],
        largest: &[Bends],
        instants: &[f64],
        pushing: usize,
    ) -> Option<Vec<Vec<Pose>>> {
        if contacts.is_empty() {
            let free = |at: &f64| {
                let bent = self.at(*at);
                bent.iter().zip(&self.rods).map(|(bends, rod)| free::pose(rod.length, configuration(bends))).collect()
            };
            return Some(instants.iter().map(free).collect());
        }
        let mut pressed = Pressed::new(&self.rods, contacts, largest, pushing);
        instants.iter().map(|at| pressed.next(&self.at(*at))).collect()
    }
}

fn joined(base: Pose, end: &Pose) -> Pose {
    Pose { position: base.position + base.rotation * end.position, rotation: base.rotation * end.rotation }
}

/// Axes of the bending plane, in the frame of the segment's base.
fn axes(configuration: Configuration) -> Mat3 {
    let (sin, cos) = configuration.sin_cos_delta();
    Mat3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0)
}

/// The parabola through what is beside a value, at the value.
fn smoothed(at: usize, all: &[f64]) -> f64 {
    let window = at.saturating_sub(SMOOTHED)..(at + SMOOTHED + 1).min(all.len());
    let (mut normal, mut right) = (Mat3::zeros(), Vec3::zeros());
    for j in window {
        let x = (j as f64 - at as f64) / SMOOTHED as f64;
        let row = Vec3::new(1.0, x, x * x);
        normal += row * row.transpose();
        right += row * (all[j] - all[at]);
    }
    all[at] + normal.cholesky().map_or(0.0, |factor| factor.solve(&right).x)
}
