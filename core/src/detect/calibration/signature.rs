//! Signatures at the places that are tried, at the price of a few multiplications.

use crate::model::contact::branch::{Branch, Surface};
use crate::model::contact::{Meeting, Planar, free_tip};
use libm::{cos, sincos};
use std::f64::consts::PI;

/// Places that are tried, the first of which is the base: a contact there changes nothing.
pub const PLACES: usize = 32;
/// From one place to the next, in units of L: the last is nearer to the end disk than half a spacing.
pub const SPACING: f64 = 0.98 / (PLACES - 1) as f64;

/// The places, in units of L.
#[must_use]
pub fn places() -> [f64; PLACES] {
    std::array::from_fn(|i| i as f64 * SPACING)
}

/// Bends of first contact between which shapes of a touching beam are interpolated.
const NODES: usize = 4;

/// Signatures of one kind of contact, m.
#[derive(Debug, Clone)]
pub struct Shapes {
    /// Length of the segment, m.
    length: f64,
    touching: Option<Touching>,
}

#[derive(Debug, Clone)]
struct Touching {
    /// Bends of first contact, rad: Chebyshev points.
    met: [f64; NODES],
    /// By place but the base, then by bend of first contact.
    branches: Vec<[Branch; NODES]>,
}

impl Shapes {
    /// Clamps on a segment `length` m long.
    #[must_use]
    pub fn clamps(length: f64) -> Self {
        Self { length, touching: None }
    }

    /// Planes that are met at one of `bends` (rad), on the side `side` of them.
    #[must_use]
    pub fn planes(length: f64, bends: &[f64], side: f64) -> Self {
        let range = bends.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
        let [middle, half] = [0.5 * (range[0] + range[1]), 0.5 * (range[1] - range[0]).max(1e-3)];
        let met = std::array::from_fn(|i| middle + half * cos(PI * (i as f64 + 0.5) / NODES as f64));
        // As far beyond the last as the first is before it: signatures go by the bend since contact.
        let branch = |place: f64, met: f64| {
            Branch::sketched(Meeting { place, bend: met, side }, Surface::Plane, met + side * 2.0 * half)
        };
        let branches = places()[1..].iter().map(|&place| met.map(|met| branch(place, met))).collect();
        Self { length, touching: Some(Touching { met, branches }) }
    }

    /// Contacts at every place that are met at the bend `met` (rad).
    #[must_use]
    pub fn met(&self, met: f64) -> Met<'_> {
        let how = match &self.touching {
            None => How::Clamps(Box::new(places().map(|place| Below::new(place, met)))),
            Some(touching) => How::Planes(touching, std::array::from_fn(|i| touching.weight(i, met))),
        };
        Met { length: self.length, met, how }
    }
}

impl Touching {
    /// Weight of a node in what is interpolated (Lagrange).
    fn weight(&self, i: usize, met: f64) -> f64 {
        let node = self.met[i];
        (0..NODES).filter(|j| *j != i).map(|j| (met - self.met[j]) / (node - self.met[j])).product()
    }
}

/// The part of a clamped segment that keeps its shape.
#[derive(Debug, Clone, Copy)]
struct Below {
    /// In units of L, and rad.
    place: f64,
    bend: f64,
    end: Planar,
    slope: (f64, f64),
}

impl Below {
    fn new(place: f64, met: f64) -> Self {
        let bend = met * place;
        Self { place, bend, end: free_tip(bend) * place, slope: sincos(bend) }
    }

    /// Where the end disk is when the whole bends by `bend` (rad), in units of L.
    fn tip(&self, bend: f64) -> Planar {
        let above = free_tip(bend - self.bend) * (1.0 - self.place);
        let (sin, cos) = self.slope;
        self.end + Planar::new(above.x * cos + above.y * sin, above.y * cos - above.x * sin)
    }
}

/// Contacts at every place that were met at the same bend.
#[derive(Debug, Clone)]
pub struct Met<'a> {
    length: f64,
    met: f64,
    how: How<'a>,
}

#[derive(Debug, Clone)]
enum How<'a> {
    Clamps(Box<[Below; PLACES]>),
    Planes(&'a Touching, [f64; NODES]),
}

impl Met<'_> {
    /// The bend at which they were met, rad.
    #[must_use]
    pub fn bend(&self) -> f64 {
        self.met
    }

    /// What each changes in the position of the end disk at the bend `bend` (rad): in the bending plane, m.
    #[must_use]
    pub fn off(&self, bend: f64) -> [[f64; 2]; PLACES] {
        let offs: [Planar; PLACES] = match &self.how {
            How::Clamps(below) => {
                let free = free_tip(bend);
                std::array::from_fn(|i| below[i].tip(bend) - free)
            }
            How::Planes(touching, weights) => {
                let since = bend - self.met;
                let free = touching.met.map(|node| free_tip(node + since));
                std::array::from_fn(|place| {
                    let mut off = Planar::zeros();
                    let Some(branches) = place.checked_sub(1).map(|above| &touching.branches[above]) else {
                        return off;
                    };
                    for i in 0..NODES {
                        let tip = branches[i].tip(touching.met[i] + since).position;
                        off += (tip - free[i]) * weights[i];
                    }
                    off
                })
            }
        };
        offs.map(|off| [off.x * self.length, off.y * self.length])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::contact::clamped_tip;

    #[test]
    fn clamps_are_those_of_the_model_and_planes_those_of_their_branches() {
        let (length, met, bend) = (0.03, 0.9, 1.15);
        let clamps = Shapes::clamps(length).met(met).off(bend);
        let planes = Shapes::planes(length, &[0.8, 1.3], 1.0).met(met).off(bend);
        for (i, place) in places().into_iter().enumerate() {
            let clamp = (clamped_tip(place, met, bend) - free_tip(bend)) * length;
            assert!((clamp - Planar::from(clamps[i])).norm() < 1e-16);
            if i == 0 {
                assert_eq!((clamps[0], planes[0]), ([0.0; 2], [0.0; 2]));
                continue;
            }
            let exact = Branch::new(Meeting { place, bend: met, side: 1.0 }, Surface::Plane, 1.3);
            let plane = (exact.tip(bend).position - free_tip(bend)) * length;
            assert!((plane - Planar::from(planes[i])).norm() < 1e-6, "{place}: {plane} {:?}", planes[i]);
        }
    }
}
