//! A chain against planes that hold it, step by step: at the price of a few small systems, and right to some micrometres.

use super::free::pose;
use super::lightly::{lightly, softness};
use super::modes::{Layout, Units};
use super::newton::{Held, Unknowns, nearby};
use super::shape::Shape;
use super::{Bends, Contact, Rod, configuration};
use crate::model::{Mat3, Pose, Vec3};
use nalgebra::DVector;

/// The highest Legendre terms: the end disk is right to a micrometre of the paper's segment.
const TERMS: usize = 5;

/// A chain with planes that hold points of its backbone, whichever way they are pressed.
#[derive(Debug)]
pub struct Pressed {
    rods: Vec<Rod>,
    layout: Layout,
    held: Vec<Held>,
    start: Unknowns,
    /// The first so many of them are let go once they pull.
    pushing: usize,
}

impl Pressed {
    /// Nothing presses yet. `largest` holds the largest bends there will be (rad). At least one contact; the first `pushing` of them are let go for
    /// good once they would have to pull.
    #[must_use]
    pub fn new(rods: &[Rod], contacts: &[Contact], largest: &[Bends], pushing: usize) -> Self {
        let layout = Layout::new(rods, largest, contacts, TERMS);
        let length = Units::of(rods).length;
        let held = contacts.iter().zip(&layout.contacts).map(|(contact, piece)| Held {
            piece: *piece,
            normal: contact.normal,
            offset: contact.offset / length,
        });
        let held: Vec<Held> = held.collect();
        let start = Unknowns { x: DVector::zeros(layout.unknowns), forces: DVector::zeros(held.len()) };
        Self { rods: rods.to_vec(), layout, held, start, pushing }
    }

    /// The end disk of every segment, each in the frame of the one below it, at the next step of the way. `None` where no equilibrium is found.
    pub fn next(&mut self, bends: &[Bends]) -> Option<Vec<Pose>> {
        let (mut at, mut shape) = self.solve(bends)?;
        while let Some(place) = (0..self.pushing).find(|&place| at.forces[place] < 0.0) {
            self.held.remove(place);
            self.pushing -= 1;
            self.start = Unknowns { x: at.x, forces: at.forces.remove_row(place) };
            (at, shape) = self.solve(bends)?;
        }
        let mut below = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
        let length = Units::of(&self.rods).length;
        let mut disks = Vec::with_capacity(self.rods.len());
        for (segment, (rod, own)) in self.rods.iter().zip(bends).enumerate() {
            if segment >= self.layout.segments() {
                disks.push(pose(rod.length, configuration(own)));
                continue;
            }
            let mut end = shape.ends[self.layout.last_piece(segment)];
            if let Some(rest) = self.layout.rest
                && segment + 1 == self.layout.segments()
            {
                let bent = Bends::from_fn(|i, _| own[i] * rest.share + at.x[rest.modes[i]] * rest.bend);
                let above = pose(rest.length, configuration(&bent));
                end = Pose {
                    position: end.position + end.rotation * above.position,
                    rotation: end.rotation * above.rotation,
                };
            }
            let back = below.rotation.transpose();
            disks.push(Pose {
                position: back * (end.position - below.position) * length,
                rotation: back * end.rotation,
            });
            below = end;
        }
        self.start = at;
        Some(disks)
    }

    /// How far the last contact's point gives way along its normal while the others hold, per unit of force: in proportion, whatever the
    /// normal. `None` where it does not.
    #[must_use]
    pub fn softness(&self, bends: &[Bends]) -> Option<f64> {
        softness(&self.layout, &self.flat(bends), &self.held)
    }

    fn flat(&self, bends: &[Bends]) -> Vec<f64> {
        bends[..self.layout.segments()].iter().flat_map(|bends| [bends.x, bends.y]).collect()
    }

    fn solve(&self, bends: &[Bends]) -> Option<(Unknowns, Shape)> {
        let flat = self.flat(bends);
        lightly(&self.layout, &flat, &self.held, &self.start).or_else(|| {
            let near = nearby(&self.layout, &flat, &self.held, self.start.clone())?;
            Some((near.at, near.shape))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::chain::{Torsion, settle};

    #[test]
    fn it_is_where_the_chain_settles() {
        let rods = [3.0, 2.0, 1.0].map(|share| Rod {
            length: 0.03,
            bending_stiffness: 0.001 * share,
            torsion: Torsion::Ratio(5.0),
        });
        let normal = Vec3::new(0.9, 0.3, -0.1).normalize();
        let steps =
            [0.3, 0.35, 0.4].map(|bend| vec![Bends::new(0.1, bend), Bends::new(-0.1, bend), Bends::new(0.0, bend)]);
        for segment in 0..3 {
            let at = 0.012;
            let lengths = [0.03; 3];
            let start: Vec<_> = steps[0].iter().map(configuration).collect();
            let point = crate::model::chain::free::point(&lengths, &start, segment, at).position;
            let contact = Contact { segment, at, normal, offset: normal.dot(&point) - 1e-5 };
            let mut pressed = Pressed::new(&rods, &[contact], &steps[2], 0);
            for bends in &steps {
                let ours = pressed.next(bends).expect("an equilibrium");
                let bent: Vec<_> = bends.iter().map(configuration).collect();
                let settled = settle(&rods, &bent, &[contact]).expect("stable");
                assert_eq!(settled.active, [0], "segment {segment}");
                let mut at = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
                for (ours, theirs) in ours.iter().zip(&settled.disks) {
                    at = Pose {
                        position: at.position + at.rotation * ours.position,
                        rotation: at.rotation * ours.rotation,
                    };
                    assert!((at.position - theirs.pose.position).norm() < 2e-6, "segment {segment}");
                    assert!((at.rotation - theirs.pose.rotation).amax() < 2e-4, "segment {segment}");
                }
            }
        }
    }
}
