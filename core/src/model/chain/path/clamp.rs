//! What a clamp leaves of a chain: all above it is a chain of its own, on a base that stays.

use super::{Course, Happened, Instant, Path, Plane, What};
use crate::model::chain::profile::Profile;
use crate::model::chain::{Bends, Rod, Unsettled};
use crate::model::{Pose, Vec3};

/// A clamp that holds.
#[derive(Debug, Clone)]
pub(super) struct Clamp {
    pub time: f64,
    /// Its own place in the list, and its place on the backbone.
    contact: usize,
    segment: usize,
    at: f64,
    rods: Vec<Rod>,
    /// The shape as it began to hold.
    frozen: Profile,
    disks: Vec<Pose>,
    forces: Vec<f64>,
    active: Vec<usize>,
    base: Pose,
    /// What the part below it on its own segment keeps of the bends.
    kept: Bends,
    above: Path,
    /// The places in the list of what is above.
    listed: Vec<usize>,
}

/// What there is as a clamp begins to hold.
pub(super) struct Holding<'a> {
    pub time: f64,
    pub contact: usize,
    pub rods: &'a [Rod],
    pub course: &'a dyn Course,
    pub knots: &'a [f64],
    pub planes: &'a [Plane],
    pub shape: Profile,
    pub instant: Instant,
}

impl Holding<'_> {
    /// Follows what is above.
    pub fn follow(self) -> Result<Clamp, Unsettled> {
        let Plane { segment, at, .. } = self.planes[self.contact];
        let base = self.shape.pose(self.rods, segment, at);
        let kept = self.shape.bends_below(self.rods, segment, at);
        let mut rods = self.rods[segment..].to_vec();
        rods[0].length -= at;
        let (listed, planes): (Vec<usize>, Vec<Plane>) = self
            .planes
            .iter()
            .enumerate()
            .filter(|(place, _)| *place != self.contact)
            .filter_map(|(place, plane)| Some((place, plane.above(&base, segment, at)?)))
            .unzip();
        let course = |time: f64| above(&self.course.bends(time), segment, kept);
        let mut knots: Vec<f64> = self.knots.iter().copied().filter(|knot| *knot > self.time).collect();
        knots.insert(0, self.time);
        let above = Path::new(&rods, &course, &knots, &planes)?;
        let Instant { disks, active, mut forces, .. } = self.instant;
        forces[self.contact] = f64::NAN;
        let frozen = self.shape;
        let (time, contact) = (self.time, self.contact);
        let rods = self.rods.to_vec();
        Ok(Clamp { time, contact, segment, at, rods, frozen, disks, forces, active, base, kept, above, listed })
    }
}

/// The bends of what is above.
fn above(bends: &[Bends], segment: usize, kept: Bends) -> Vec<Bends> {
    let mut rest = bends[segment..].to_vec();
    rest[0] -= kept;
    rest
}

impl Clamp {
    fn in_base(&self, pose: &Pose) -> Pose {
        let Pose { position, rotation } = self.base;
        Pose { position: position + rotation * pose.position, rotation: rotation * pose.rotation }
    }

    pub fn at(&self, time: f64, bends: &[Bends]) -> Instant {
        let inner = self.above.at(time, &above(bends, self.segment, self.kept));
        let below = self.disks[..self.segment].iter().copied();
        let disks = below.chain(inner.disks.iter().map(|pose| self.in_base(pose))).collect();
        let mut forces = self.forces.clone();
        let mut active: Vec<usize> = self.active.iter().copied().filter(|place| !self.listed.contains(place)).collect();
        active.push(self.contact);
        active.extend(inner.active.iter().map(|&place| self.listed[place]));
        active.sort_unstable();
        for (&place, force) in self.listed.iter().zip(&inner.forces) {
            forces[place] = *force;
        }
        Instant { disks, active, forces, margin: inner.margin }
    }

    pub fn pose(&self, time: f64, bends: &[Bends], segment: usize, at: f64) -> Pose {
        if segment < self.segment || (segment == self.segment && at <= self.at) {
            return self.frozen.pose(&self.rods, segment, at);
        }
        let at = if segment == self.segment { at - self.at } else { at };
        let bends = above(bends, self.segment, self.kept);
        self.in_base(&self.above.pose(time, &bends, segment - self.segment, at))
    }

    pub fn backbone(&self, time: f64, bends: &[Bends], parts: usize) -> Vec<Vec<Pose>> {
        let step = |segment: usize, k: usize| self.rods[segment].length * k as f64 / parts as f64;
        let segments = 0..self.rods.len();
        segments
            .map(|segment| (0..=parts).map(|k| self.pose(time, bends, segment, step(segment, k))).collect())
            .collect()
    }

    /// What happens above it, by the whole list.
    pub fn happened(&self) -> impl Iterator<Item = Happened> {
        self.above.happened().iter().map(|event| Happened {
            time: event.time,
            what: match event.what {
                What::Met(place) => What::Met(self.listed[place]),
                What::Opened(place) => What::Opened(self.listed[place]),
                end => end,
            },
        })
    }

    /// The planes above it, by the whole list, in {B}.
    pub fn planes(&self) -> impl Iterator<Item = (usize, (Vec3, f64))> {
        self.listed.iter().enumerate().filter_map(|(place, &listed)| {
            let (normal, offset) = self.above.plane(place)?;
            let normal = self.base.rotation * normal;
            Some((listed, (normal, offset + normal.dot(&self.base.position))))
        })
    }

    pub fn end(&self) -> f64 {
        self.above.end()
    }
}
