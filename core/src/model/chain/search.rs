//! Which contacts press, and the stable shape that goes with them.

use super::elastic::{TOUCH, Unsettled, Way};
use super::modes::{Layout, Units};
use super::newton::{Equilibrium, Held, Unknowns, equilibrium, factors};
use super::shape::shape;
use super::stability::margin;
use super::{Bends, Contact, Rod, bends};
use crate::model::{Configuration, Vec3};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeSet;

/// Highest Legendre terms, tried in turn.
pub(super) const TERMS: [usize; 5] = [8, 12, 18, 26, 36];
/// The highest term may bend a piece by so much, rad: far less moves by what is left out.
const TAIL: f64 = 1e-10;
/// One more step of terms may change the stability margin by so much.
const MARGIN: f64 = 1e-10;
/// A margin this small is none: rounding may have made it.
pub(super) const LEAST_MARGIN: f64 = 1e-9;
/// The first and longest step of a way, and the shortest, as shares of it.
const STEPS: (f64, f64) = (0.25, 1e-3);
/// A step in which the shape goes off further than this from where it was bound for, over its own size, may have left its
/// branch.
const STRAY: f64 = 0.1;

/// A stable shape.
#[derive(Debug)]
pub(super) struct Found {
    pub layout: Layout,
    pub active: Vec<usize>,
    pub equilibrium: Equilibrium,
    pub margin: f64,
}

/// One layout with its planes, in its units.
struct Search<'a> {
    layout: &'a Layout,
    bends: &'a [f64],
    planes: &'a [Held],
}

/// A shape against the planes that press, none pulls and none is passed.
struct Pressed {
    active: Vec<usize>,
    equilibrium: Equilibrium,
    margin: f64,
}

/// What is commanded, and where the planes are, on the way to what is asked for.
struct Stage {
    bends: Vec<f64>,
    offsets: Vec<f64>,
}

/// Where a search starts from.
#[derive(Clone)]
struct Start {
    active: Vec<usize>,
    at: Unknowns,
}

/// The shape, with as many terms as it needs.
pub(super) fn search(rods: &[Rod], configurations: &[Configuration], contacts: &[Contact]) -> Result<Found, Unsettled> {
    let each: Vec<Bends> = configurations.iter().map(|at| bends(*at)).collect();
    let length = Units::of(rods).length;
    let mut before: Option<Found> = None;
    let mut why = None;
    for terms in TERMS {
        let layout = Layout::new(rods, &each, contacts, terms);
        let flat: Vec<f64> = each[..layout.segments()].iter().flat_map(|bends| [bends.x, bends.y]).collect();
        let plane = |(contact, piece): (&Contact, &usize)| Held {
            piece: *piece,
            normal: contact.normal,
            offset: contact.offset / length,
        };
        let planes: Vec<Held> = contacts.iter().zip(&layout.contacts).map(plane).collect();
        let search = Search { layout: &layout, bends: &flat, planes: &planes };
        let start = before.as_ref().map(|found| Start {
            active: found.active.clone(),
            at: Unknowns {
                x: layout.carried(&found.layout, &found.equilibrium.at.x),
                forces: found.equilibrium.at.forces.clone(),
            },
        });
        match search.settle(start) {
            Ok(Pressed { active, equilibrium, margin }) => {
                let settled = before.as_ref().is_some_and(|before| (before.margin - margin).abs() < MARGIN);
                let enough = settled && layout.tail(&equilibrium.at.x) < TAIL;
                let found = Found { layout, active, equilibrium, margin };
                if enough {
                    return Ok(found);
                }
                before = Some(found);
            }
            // More terms change nothing in what is far from settled.
            Err(error) if before.is_none() && terms > TERMS[0] => return Err(error),
            Err(error) => (before, why) = (None, Some(error)),
        }
    }
    before.ok_or(why.unwrap_or(Unsettled { way: Way::Bending, reached: 0.0, margin: None }))
}

impl Search<'_> {
    /// Follows the chain as it bends in proportion from straight. Where that leads nowhere, Newton's method may find a stable
    /// shape from the free one, or by pressing the planes in step by step.
    fn settle(&self, start: Option<Start>) -> Result<Pressed, Unsettled> {
        let end = self.stage(Way::Pressing, 1.0);
        let stable = |pressed: &Pressed| pressed.margin > LEAST_MARGIN;
        if let Some(pressed) = start.and_then(|start| self.press(&end, start)).filter(stable) {
            return Ok(pressed);
        }
        let way = if self.clears_straight() { Way::Bending } else { Way::Pressing };
        let reached = match self.follow(way, STRAY) {
            Ok(pressed) => return Ok(pressed),
            Err(reached) => reached,
        };
        let pressed = self.press(&end, self.free());
        let margin = pressed.as_ref().map(|pressed| pressed.margin);
        // Off its branch the chain snaps to another: any stable one is an answer.
        let other = || self.follow(Way::Pressing, f64::INFINITY).ok();
        pressed.filter(stable).or_else(other).ok_or(Unsettled { way, reached, margin })
    }

    /// The free shape: x = 0.
    fn free(&self) -> Start {
        let at = Unknowns { x: DVector::zeros(self.layout.unknowns), forces: DVector::zeros(0) };
        Start { active: Vec::new(), at }
    }

    /// Positions of the planes' points on a chain that nothing touches.
    fn free_points(&self, bends: &[f64]) -> Option<Vec<Vec3>> {
        let free = shape(self.layout, &factors(&self.free().at.x, bends))?;
        Some(self.planes.iter().map(|plane| free.ends[plane.piece].position).collect())
    }

    /// Whether the straight chain passes no plane.
    fn clears_straight(&self) -> bool {
        let points = self.free_points(&vec![0.0; self.bends.len()]).unwrap_or_default();
        self.planes.iter().zip(points).all(|(plane, point)| plane.normal.dot(&point) <= plane.offset + TOUCH)
    }

    /// What is commanded, and where the planes are, a share of the way along.
    fn stage(&self, way: Way, share: f64) -> Stage {
        let offsets: Vec<f64> = self.planes.iter().map(|plane| plane.offset).collect();
        match way {
            Way::Bending => Stage { bends: self.bends.iter().map(|bend| bend * share).collect(), offsets },
            Way::Pressing if share == 1.0 => Stage { bends: self.bends.to_vec(), offsets },
            Way::Pressing => {
                let points = self.free_points(self.bends).unwrap_or_default();
                let each = self.planes.iter().zip(points).map(|(plane, point)| {
                    let touching = plane.normal.dot(&point).max(plane.offset);
                    touching + share * (plane.offset - touching)
                });
                Stage { bends: self.bends.to_vec(), offsets: each.collect() }
            }
        }
    }

    /// Goes a way in steps short enough to stay on the branch; how far it came, where that ends before the way does.
    fn follow(&self, way: Way, stray: f64) -> Result<Pressed, f64> {
        let (mut reached, mut step, mut start) = (0.0, STEPS.0, self.free());
        let mut by_bends = None;
        loop {
            let next = f64::min(reached + step, 1.0);
            let stage = self.stage(way, next);
            let bound = self.predicted(&start, by_bends.as_ref(), way, next - reached);
            let near = |pressed: &Pressed| {
                let x = &pressed.equilibrium.at.x;
                (x - &bound.at.x).norm() < stray * (1.0 + x.norm())
            };
            match self.press(&stage, bound.clone()).filter(|pressed| pressed.margin > LEAST_MARGIN && near(pressed)) {
                Some(pressed) if next == 1.0 => return Ok(pressed),
                Some(pressed) => {
                    by_bends = Some(pressed.equilibrium.by_bends);
                    start = Start { active: pressed.active, at: pressed.equilibrium.at };
                    (reached, step) = (next, STEPS.0.min(1.5 * step));
                }
                None if step < STEPS.1 => return Err(reached),
                None => step *= 0.5,
            }
        }
    }

    /// Where a step along a way leads to first order.
    fn predicted(&self, start: &Start, by_bends: Option<&DMatrix<f64>>, way: Way, step: f64) -> Start {
        let Start { active, mut at } = start.clone();
        if let (Some(by), Way::Bending) = (by_bends, way) {
            let change = by * DVector::from_column_slice(self.bends) * step;
            at.x += change.rows(0, self.layout.unknowns);
            at.forces += change.rows(self.layout.unknowns, active.len());
        }
        Start { active, at }
    }

    /// Lets go of the plane that pulls most, else takes on the one that is passed most, until neither is left.
    fn press(&self, stage: &Stage, start: Start) -> Option<Pressed> {
        let Start { mut active, mut at } = start;
        let mut tried = BTreeSet::new();
        while tried.insert(active.clone()) {
            let held: Vec<Held> =
                active.iter().map(|&place| Held { offset: stage.offsets[place], ..self.planes[place] }).collect();
            let found = equilibrium(self.layout, &stage.bends, &held, at)?;
            let pull = lowest(found.at.forces.iter().copied()).filter(|(_, force)| *force < 0.0);
            let passed = lowest(self.planes.iter().enumerate().map(|(place, plane)| {
                let end = found.shape.ends[plane.piece].position;
                if active.contains(&place) { 0.0 } else { stage.offsets[place] - plane.normal.dot(&end) }
            }));
            match (pull, passed) {
                (Some((row, _)), _) => {
                    active.remove(row);
                    at = Unknowns { forces: found.at.forces.clone().remove_row(row), ..found.at };
                }
                (None, Some((place, gap))) if gap < -TOUCH => {
                    let row = active.partition_point(|&other| other < place);
                    active.insert(row, place);
                    at = Unknowns { forces: found.at.forces.clone().insert_row(row, 0.0), ..found.at };
                }
                _ => {
                    return Some(Pressed {
                        margin: margin(&found.hessian, &found.gradients),
                        active,
                        equilibrium: found,
                    });
                }
            }
        }
        None
    }
}

/// The lowest of several numbers, and where it stands.
fn lowest(numbers: impl Iterator<Item = f64>) -> Option<(usize, f64)> {
    numbers.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
}
