//! How a chain bends, reading by reading, and where it meets planes.

use crate::model::chain::pressed::Pressed;
use crate::model::chain::{Bends, Contact, Rod, bends, configuration, free};
use crate::model::{Configuration, Mat3, Pose, Vec3};
use libm::sincos;
use serde::{Deserialize, Serialize};

/// A contact begins where something is told to move by more than this (rad) from one reading to the next.
const STILL: f64 = 1e-6;
/// Readings to either side over which angles are smoothed by a parabola.
const SMOOTHED: usize = 8;

/// A contact that is known: its segment, its place on it (m), its plane's tilt about the tangent from the bending plane (rad), and the reading
/// at which it was met.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownContact {
    pub segment: usize,
    pub at: f64,
    pub tilt: f64,
    pub began: f64,
}

/// What a segment does, reading by reading.
#[derive(Debug, Clone)]
pub(super) struct Bending {
    /// How far it bends, rad.
    pub bends: Vec<f64>,
    /// Its bending-plane angle δ, rad.
    pub deltas: Vec<f64>,
    /// The bend that it is told, rad.
    pub commanded: Vec<f64>,
}

/// What a chain does, reading by reading.
#[derive(Debug)]
pub(super) struct Course {
    rods: Vec<Rod>,
    segments: Vec<Bending>,
    largest: Vec<Bends>,
    pub last: usize,
}

impl Course {
    /// Of every segment from the base; all have as many readings, at least one.
    pub fn new(rods: Vec<Rod>, segments: Vec<Bending>) -> Option<Self> {
        let last = segments.iter().map(|of| of.bends.len()).min()?.checked_sub(1)?;
        let most = |of: &Bending| of.bends.iter().map(|bend| bend.abs()).fold(0.0, f64::max);
        let largest = segments.iter().map(|of| Bends::new(0.0, most(of))).collect();
        Some(Self { rods, segments, largest, last })
    }

    /// Length of a segment, m.
    pub fn length(&self, segment: usize) -> f64 {
        self.rods[segment].length
    }

    /// The readings between two at which something is told to move.
    pub fn moving(&self, [first, latest]: [usize; 2]) -> Vec<usize> {
        let moves = |k: &usize| self.segments.iter().any(|of| of.moves(*k));
        (first..self.last.min(latest + 1)).filter(moves).collect()
    }

    /// Whether all segments below one rest from a reading on.
    pub fn rests_below(&self, segment: usize, from: usize) -> bool {
        self.segments[..segment].iter().all(|of| !(from..self.last).any(|k| of.moves(k)))
    }

    /// The configuration of a segment at an instant (in readings).
    pub fn configuration(&self, segment: usize, at: f64) -> Configuration {
        let before = (at.max(0.0) as usize).min(self.last);
        let (after, share) = ((before + 1).min(self.last), (at - before as f64).clamp(0.0, 1.0));
        let mean = |all: &[f64]| all[before] + share * (all[after] - all[before]);
        let of = &self.segments[segment];
        Configuration::new(mean(&of.bends), mean(&of.deltas))
    }

    /// The bends of all segments at an instant (in readings).
    pub fn at(&self, at: f64) -> Vec<Bends> {
        (0..self.rods.len()).map(|segment| bends(self.configuration(segment, at))).collect()
    }

    /// The point that may meet a plane at an instant (in readings), with the contacts that hold before: at a share of its segment.
    pub fn point(&self, known: &[Contact], segment: usize, place: f64, began: f64) -> Option<Pose> {
        let bends = self.at(began);
        let relative = if known.is_empty() {
            bends.iter().zip(&self.rods).map(|(bends, rod)| free::pose(rod.length, configuration(bends))).collect()
        } else {
            Pressed::new(&self.rods, known, &self.largest, known.len()).next(&bends)?
        };
        let base = relative[..segment].iter().fold(nothing(), joined);
        let own = self.configuration(segment, began);
        Some(joined(base, &free::pose(place * self.rods[segment].length, own.with_bend(place * own.bend()))))
    }

    /// The plane that a point meets at an instant: along the tangent there, tilted about it (rad) from the bending plane.
    pub fn plane(&self, point: &Pose, segment: usize, place: f64, tilt: f64, began: f64) -> Contact {
        let (sin, cos) = sincos(tilt - self.configuration(segment, began).delta());
        let normal = point.rotation * Vec3::new(cos, sin, 0.0);
        Contact { segment, at: place * self.rods[segment].length, normal, offset: normal.dot(&point.position) }
    }

    /// The planes of contacts that are known, the earlier ones first.
    pub fn planes(&self, known: &[KnownContact]) -> Option<Vec<Contact>> {
        let mut planes = Vec::new();
        for contact in known {
            let place = contact.at / self.rods[contact.segment].length;
            let point = self.point(&planes, contact.segment, place, contact.began)?;
            planes.push(self.plane(&point, contact.segment, place, contact.tilt, contact.began));
        }
        Some(planes)
    }

    /// The end disks, each in the frame of the one below it, at some instants; the first `pushing` contacts may be left. Where no equilibrium is
    /// found, what the one before was off the free chain is taken along.
    pub fn followed(&self, contacts: &[Contact], instants: &[f64], pushing: usize) -> Vec<Vec<Pose>> {
        let mut pressed = Pressed::new(&self.rods, contacts, &self.largest, pushing);
        let mut last: Option<[Vec<Pose>; 2]> = None;
        let at = |at: &f64| {
            let free = self.free(*at);
            let held = pressed.next(&self.at(*at)).unwrap_or_else(|| match &last {
                Some(last) => {
                    free.iter().zip(last[0].iter().zip(&last[1])).map(|(now, off)| carried(now, off)).collect()
                }
                None => free.clone(),
            });
            last = Some([held.clone(), free]);
            held
        };
        instants.iter().map(at).collect()
    }

    /// How soft the chain is at an instant (in readings) along the normal of the last of some contacts, in any unit.
    pub fn softness(&self, contacts: &[Contact], at: f64) -> Option<f64> {
        Pressed::new(&self.rods, contacts, &self.largest, contacts.len()).softness(&self.at(at))
    }

    /// The end disks, each in the frame of the one below it, where nothing touches, at an instant.
    pub fn free(&self, at: f64) -> Vec<Pose> {
        let bent = self.at(at);
        bent.iter().zip(&self.rods).map(|(bends, rod)| free::pose(rod.length, configuration(bends))).collect()
    }

    /// The same with a clamp at a share of a segment since an instant: what is below it stays, and so does the rest of the segments below.
    pub fn clamped(&self, segment: usize, place: f64, began: f64, at: f64) -> Vec<Pose> {
        let mut disks = self.free(at);
        let length = self.rods[segment].length;
        let (met, now) = (bends(self.configuration(segment, began)), bends(self.configuration(segment, at)));
        let held = free::pose(place * length, configuration(&(met * place)));
        let above = free::pose((1.0 - place) * length, configuration(&(now - met * place)));
        disks[segment] = joined(held, &above);
        disks
    }

    /// The end disks, each in the frame of the one below it, at some instants that rise, with contacts that are known: each from its beginning on,
    /// the earlier ones first. `None` where one of them cannot be.
    pub fn held(&self, known: &[KnownContact], instants: &[f64]) -> Option<Vec<Vec<Pose>>> {
        let planes = self.planes(known)?;
        let begun = |at: f64| known.iter().take_while(|contact| contact.began < at).count();
        let with = |same: &[f64]| match begun(same[0]) {
            0 => same.iter().map(|at| self.free(*at)).collect(),
            count => self.followed(&planes[..count], same, count),
        };
        Some(instants.chunk_by(|one, next| begun(*one) == begun(*next)).flat_map(with).collect())
    }

    /// What was read, less what contacts that are known change in it: a tracker would have read so without them. `poses` holds the readings of
    /// every segment.
    pub fn without(&self, known: &[KnownContact], poses: &[&[Pose]]) -> Option<Vec<Vec<Pose>>> {
        let mut corrected: Vec<Vec<Pose>> = poses.iter().map(|poses| poses[..=self.last].to_vec()).collect();
        let since = known.first().map_or(f64::INFINITY, |contact| contact.began);
        let first = (since.max(0.0) as usize + 1).min(self.last);
        let instants: Vec<f64> = (first..=self.last).map(|k| k as f64).collect();
        for (k, with) in self.held(known, &instants)?.iter().enumerate() {
            let free = self.free(instants[k]);
            for (tracker, poses) in corrected.iter_mut().enumerate() {
                let pose = &mut poses[first + k];
                pose.position -= with[tracker].position - free[tracker].position;
                pose.rotation = free[tracker].rotation * with[tracker].rotation.tr_mul(&pose.rotation);
            }
        }
        Some(corrected)
    }
}

impl Bending {
    fn moves(&self, k: usize) -> bool {
        let changes = |all: &[f64]| (all[k + 1] - all[k]).abs() > STILL;
        changes(&self.commanded) || changes(&self.deltas)
    }
}

/// A disk that is off the free one as another is.
fn carried(free: &Pose, (held, before): (&Pose, &Pose)) -> Pose {
    Pose {
        position: free.position + held.position - before.position,
        rotation: held.rotation * before.rotation.tr_mul(&free.rotation),
    }
}

fn nothing() -> Pose {
    Pose { position: Vec3::zeros(), rotation: Mat3::identity() }
}

/// A pose in the frame of another, in that one's own.
pub(super) fn joined(base: Pose, end: &Pose) -> Pose {
    Pose { position: base.position + base.rotation * end.position, rotation: base.rotation * end.rotation }
}

/// The last of some disks, each in the frame of the one below it, in that of the first.
pub(super) fn last(disks: &[Pose]) -> Pose {
    disks.iter().fold(nothing(), joined)
}

/// Angles smoothed over some readings.
pub(super) fn smoothed(all: &[f64]) -> Vec<f64> {
    (0..all.len()).map(|at| smooth(at, all)).collect()
}

/// The parabola through what is beside a value, at the value.
fn smooth(at: usize, all: &[f64]) -> f64 {
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
