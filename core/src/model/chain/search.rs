//! Which contacts press, and the stable shape that goes with them.

use super::elastic::{TOUCH, Unsettled};
use super::modes::{Layout, Units};
use super::newton::{Equilibrium, Held, Unknowns, equilibrium};
use super::stability::margin;
use super::{Bends, Contact, Rod, bends};
use crate::model::Configuration;
use nalgebra::DVector;
use std::collections::BTreeSet;

/// Highest Legendre terms, tried in turn.
const TERMS: [usize; 5] = [8, 12, 18, 26, 36];
/// The highest term may bend a piece by so much, rad: far less moves by what is left out.
const TAIL: f64 = 1e-10;
/// A margin this small is none: rounding may have made it.
const LEAST_MARGIN: f64 = 1e-9;
/// The first step by which planes are pressed in, and the least, as shares of the way.
const STEPS: (f64, f64) = (0.25, 1e-3);

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
    let mut why = Unsettled::Lost { reached: 0.0 };
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
                let enough = layout.tail(&equilibrium.at.x) < TAIL;
                let found = Found { layout, active, equilibrium, margin };
                if enough {
                    return Ok(found);
                }
                before = Some(found);
            }
            // More terms change nothing in what is far from settled.
            Err(error) if before.is_none() && terms > TERMS[0] => return Err(error),
            Err(error) => (before, why) = (None, error),
        }
    }
    before.ok_or(why)
}

impl Search<'_> {
    fn settle(&self, start: Option<Start>) -> Result<Pressed, Unsettled> {
        let mut unstable = None;
        for start in start.into_iter().chain([self.free()]) {
            match self.press(&self.offsets(1.0), start) {
                Some(pressed) if pressed.margin > LEAST_MARGIN => return Ok(pressed),
                Some(pressed) => unstable = Some(Unsettled::Unstable { margin: pressed.margin }),
                None => {}
            }
        }
        self.follow().map_err(|lost| unstable.unwrap_or(lost))
    }

    /// The free shape: x = 0.
    fn free(&self) -> Start {
        let at = Unknowns { x: DVector::zeros(self.layout.unknowns), forces: DVector::zeros(0) };
        Start { active: Vec::new(), at }
    }

    /// Offsets with the planes pressed in by a share of the way from where each just touches the free shape.
    fn offsets(&self, share: f64) -> Vec<f64> {
        let exact = || self.planes.iter().map(|plane| plane.offset).collect();
        if share == 1.0 {
            return exact();
        }
        let factors = super::newton::factors(&self.free().at.x, self.bends);
        let Some(free) = super::shape::shape(self.layout, &factors) else { return exact() };
        let offset = |plane: &Held| {
            let touching = plane.normal.dot(&free.ends[plane.piece].position).max(plane.offset);
            touching + share * (plane.offset - touching)
        };
        self.planes.iter().map(offset).collect()
    }

    /// Presses the planes in step by step.
    fn follow(&self) -> Result<Pressed, Unsettled> {
        let (mut reached, mut step, mut start) = (0.0, STEPS.0, self.free());
        loop {
            let next = f64::min(reached + step, 1.0);
            match self.press(&self.offsets(next), start.clone()).filter(|pressed| pressed.margin > LEAST_MARGIN) {
                Some(pressed) if next == 1.0 => return Ok(pressed),
                Some(pressed) => {
                    start = Start { active: pressed.active, at: pressed.equilibrium.at };
                    (reached, step) = (next, 1.5 * step);
                }
                None if step < STEPS.1 => return Err(Unsettled::Lost { reached }),
                None => step *= 0.5,
            }
        }
    }

    /// Lets go of the plane that pulls most, else takes on the one that is passed most, until neither is left.
    fn press(&self, offsets: &[f64], start: Start) -> Option<Pressed> {
        let Start { mut active, mut at } = start;
        let mut tried = BTreeSet::new();
        while tried.insert(active.clone()) {
            let held: Vec<Held> =
                active.iter().map(|&place| Held { offset: offsets[place], ..self.planes[place] }).collect();
            let found = equilibrium(self.layout, self.bends, &held, at)?;
            let pull = lowest(found.at.forces.iter().copied()).filter(|(_, force)| *force < 0.0);
            let passed = lowest(self.planes.iter().enumerate().map(|(place, plane)| {
                let held = active.contains(&place);
                if held { 0.0 } else { offsets[place] - plane.normal.dot(&found.shape.ends[plane.piece].position) }
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
                _ => return Some(Pressed { margin: margin(&found), active, equilibrium: found }),
            }
        }
        None
    }
}

/// The lowest of several numbers, and where it stands.
fn lowest(numbers: impl Iterator<Item = f64>) -> Option<(usize, f64)> {
    numbers.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
}
