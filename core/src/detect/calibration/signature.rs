//! Signatures at the places that are tried, at the price of a few multiplications.

use crate::model::contact::branch::{Branch, Surface};
use crate::model::contact::{Meeting, Planar, free_tip};
use libm::{cos, sincos};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Places at which signatures are made. Between them they are a polynomial through these and zero at the base, where a contact changes
/// nothing: better than a micrometre of the paper's segment.
pub const PLACES: usize = 8;

static AT: LazyLock<[f64; PLACES]> =
    LazyLock::new(|| std::array::from_fn(|i| 0.5 * (1.0 - cos(PI * (2 * i + 2) as f64 / (2 * PLACES + 1) as f64))));

/// The places, in units of L: with the base, Chebyshev points of Radau's kind.
#[must_use]
pub fn places() -> [f64; PLACES] {
    *AT
}

/// What each of the places counts in the signature of a contact at another one (in units of L): Lagrange's polynomials, with the base.
#[must_use]
pub fn weights(place: f64) -> [f64; PLACES] {
    let places = places();
    std::array::from_fn(|i| {
        let others = places.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| *other);
        others.chain([0.0]).map(|other| (place - other) / (places[i] - other)).product()
    })
}

/// The same where a contact at the base changes as much as any.
#[must_use]
pub fn free_weights(place: f64) -> [f64; PLACES] {
    let places = places();
    std::array::from_fn(|i| {
        let others = places.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| *other);
        others.map(|other| (place - other) / (places[i] - other)).product()
    })
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
    /// By place, then by bend of first contact.
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
        let branches = places().iter().map(|&place| met.map(|met| branch(place, met))).collect();
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

    /// What each changes in the position of the end disk at the bend `bend` (rad): in the bending plane, toward the bend and along the
    /// straight backbone, m.
    #[must_use]
    pub fn off(&self, bend: f64) -> [[f64; PLACES]; 2] {
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
                    for i in 0..NODES {
                        let tip = touching.branches[place][i].tip(touching.met[i] + since).position;
                        off += (tip - free[i]) * weights[i];
                    }
                    off
                })
            }
        };
        [offs.map(|off| off.x * self.length), offs.map(|off| off.y * self.length)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::contact::clamped_tip;

    /// The largest distance (m) of what is interpolated from the model, at any place but the last thirtieth of the segment.
    fn most_off(offs: &[[f64; PLACES]; 2], exact: impl Fn(f64) -> Planar) -> f64 {
        let off = |place: f64| {
            let weights = weights(place);
            let between = offs.map(|axis| axis.iter().zip(weights).map(|(at, weight)| at * weight).sum::<f64>());
            (exact(place) - Planar::from(between)).norm()
        };
        (1..=290).map(|i| off(f64::from(i) / 300.0)).fold(0.0, f64::max)
    }

    #[test]
    fn clamps_are_those_of_the_model_and_planes_those_of_their_branches() {
        let (length, met, bend) = (0.03, 0.9, 1.15);
        let clamps = Shapes::clamps(length).met(met).off(bend);
        let planes = Shapes::planes(length, &[0.8, 1.3], 1.0).met(met).off(bend);
        let clamp = |place: f64| (clamped_tip(place, met, bend) - free_tip(bend)) * length;
        let plane = |place: f64| {
            let exact = Branch::new(Meeting { place, bend: met, side: 1.0 }, Surface::Plane, 1.3);
            (exact.tip(bend).position - free_tip(bend)) * length
        };
        for (i, place) in places().into_iter().enumerate() {
            assert!((clamp(place) - Planar::new(clamps[0][i], clamps[1][i])).norm() < 1e-16);
            assert!((plane(place) - Planar::new(planes[0][i], planes[1][i])).norm() < 1e-6, "{place}");
        }
        assert!(most_off(&clamps, clamp) < 1e-9);
        assert!(most_off(&planes, plane) < 1e-6);
    }
}
