//! How hard a beam presses that only touches, by the load cells.
//!
//! Joint forces bend the part above the contact, and that part alone. With the place of the contact known, they say how much it is
//! bent (Eqs. 10, 11 of the part above); the total bend is commanded, so the rest is how much the part below is bent, and that, for a
//! plane, follows from the bend φ_c at which the contact began, as the force does. The longer the beam has pressed, the more is
//! bent above it: φ_c is found by bisection. A preload common to the cells bends nothing and need not be known.
//!
//! A clamp holds the backbone by a couple as well, and the joint forces do not say how much of them is the force's: there is no answer.

use super::estimates::Estimated;
use super::judge::{Judged, Settings};
use crate::model::contact::ritz::Basis;
use crate::model::contact::{Meeting, Unknowns, plane};
use crate::model::{Configuration, Segment, Vec3};
use crate::record::Recording;
use crate::scenario::{Estimator, Kind};
use serde::Serialize;

/// A plane is likely enough from this probability on: of a clamp's force nothing would be true.
const LIKELY: f64 = 0.95;
/// Places within the interval of the estimate at which the force is looked for.
const PLACES: usize = 9;
/// Beginnings between now and the first command from which the bisection sets out.
const BEGINNINGS: usize = 48;
/// Halvings of the interval between two of them.
const HALVINGS: usize = 40;

/// The size of a contact force, N.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Force {
    /// Time of which this is said, s.
    pub time: f64,
    /// By the load cells as they read, at the mean of the place.
    pub mean: f64,
    /// The least of all places within the estimate's interval, if all cells read too much by a share ε_τ …
    pub low: f64,
    /// … and the most, if they read too little.
    pub high: f64,
}

impl Force {
    /// At the time of an estimate of the contact's place. `None` unless the estimate weighs kinds of contact and a plane is likely, and
    /// where the load cells read nothing, or nothing that any contact there could come to.
    #[must_use]
    pub fn of(judged: &Judged, recording: &Recording, estimate: &Estimated) -> Option<Self> {
        let plane = Kind::WORDS[Kind::Plane as usize];
        if estimate.estimator != Estimator::Marginal || !estimate.kinds.get(plane).is_some_and(|p| *p >= LIKELY) {
            return None;
        }
        let entries = &recording.entries;
        let at = entries.partition_point(|entry| entry.time < estimate.time - 1e-9);
        let entry = entries.get(at)?;
        let known = |bend: &f64| bend.is_finite();
        let start = entries.iter().map(|entry| entry.configuration.bend()).find(known)?;
        let of = |place: f64| sizes(&judged.settings, (start, entry.configuration), &entry.tau_lc, place);
        let [mut low, mean, mut high] = of(estimate.location.mean)?;
        let [from, to] = [estimate.location.low, estimate.location.high];
        for k in 0..PLACES {
            let Some([least, _, most]) = of(from + (to - from) * k as f64 / (PLACES - 1) as f64) else { continue };
            (low, high) = (low.min(least), high.max(most));
        }
        // Where even that is one number, the cells read more, or less, than any contact comes to.
        (judged.settings.epsilon_tau == 0.0 || low < high).then_some(Self { time: entry.time, mean, low, high })
    }
}

/// The contact force (N) of a plane at `place` (m), in a configuration that is commanded now after the bend `start` (rad): the least
/// that the load cells' readings `tau_lc` (N) allow for, what they say, and the most, for cells that share one relative error.
///
/// No force is below zero, nor above that of a contact since the bend `start` or, where the segment would have snapped off such a
/// one, of the hardest that holds. `None` where a number is missing, nothing has moved, or the place is not on the segment.
#[must_use]
pub fn sizes(
    settings: &Settings,
    (start, configuration): (f64, Configuration),
    tau_lc: &Vec3,
    place: f64,
) -> Option<[f64; 3]> {
    let pressed = Pressed::new(&settings.segment, (start, configuration), place)?;
    let measured = -settings.segment.generalised_force(&configuration, tau_lc).theta_l;
    let share = settings.epsilon_tau;
    let of = |factor: f64| measured.is_finite().then(|| pressed.force(measured * factor));
    let ends = [of(1.0 - share)?, of(1.0 + share)?];
    Some([ends[0].min(ends[1]), of(1.0)?, ends[0].max(ends[1])])
}

/// A segment against a plane at one place and bend, for beginnings of the contact from now back.
struct Pressed {
    segment: Segment,
    configuration: Configuration,
    /// Where the plane is, in units of L.
    place: f64,
    /// +1 where the bend has grown.
    side: f64,
    basis: Basis,
    /// Each with less force than the next; at least one.
    pasts: Vec<Past>,
}

/// A contact that began at some bend.
#[derive(Clone, Copy)]
struct Past {
    /// Bend φ_c then, rad.
    met: f64,
    at: Unknowns,
    /// What the joint forces come to in the direction of the bend, N·m.
    joint: f64,
    /// The contact force, N.
    force: f64,
}

impl Pressed {
    fn new(segment: &Segment, (start, configuration): (f64, Configuration), place: f64) -> Option<Self> {
        let (bend, share) = (configuration.bend(), place / segment.length);
        let travel = start - bend;
        let known = travel.is_finite() && travel != 0.0 && configuration.delta().is_finite();
        if !(known && share > 0.0 && share < 1.0) {
            return None;
        }
        let mut pressed = Self {
            segment: *segment,
            configuration,
            place: share,
            side: -travel.signum(),
            basis: Basis::new(),
            pasts: Vec::new(),
        };
        let mut near = None;
        for k in 0..=BEGINNINGS {
            let Some(past) = pressed.past(bend + travel * k as f64 / BEGINNINGS as f64, near.as_ref()) else { break };
            near = Some(past.at);
            pressed.pasts.push(past);
        }
        (!pressed.pasts.is_empty()).then_some(pressed)
    }

    /// The contact that began at a bend (rad), found from one that began nearby. `None` where none would hold.
    fn past(&self, met: f64, near: Option<&Unknowns>) -> Option<Past> {
        let bend = self.configuration.bend();
        let meeting = Meeting { place: self.place, bend: met, side: self.side };
        let touching = if met == bend {
            plane::at_first_contact(&self.basis, &meeting)
        } else {
            plane::solve(&self.basis, &meeting, bend, near).filter(|found| found.stable)?.touching
        };
        let length = self.segment.length;
        let upper = self.segment.shortened(length * (1.0 - self.place));
        let shape = self.configuration.with_bend(touching.upper_bend());
        if upper.shortest_backbone(shape.bend()) <= 0.0 {
            return None;
        }
        let joint = -upper.energy_gradient(&shape).theta_l;
        let force = self.side * touching.force() * self.segment.bending_stiffness() / (length * length);
        (joint.is_finite() && force.is_finite()).then_some(Past { met, at: touching.at, joint, force })
    }

    /// The force (N) with which joint forces come to so much in the direction of the bend (N·m).
    fn force(&self, joint: f64) -> f64 {
        let reaches = |past: &Past| self.side * (past.joint - joint) >= 0.0;
        let Some(after) = self.pasts.iter().position(reaches) else {
            return self.pasts.last().map_or(0.0, |past| past.force);
        };
        let Some(mut less) = after.checked_sub(1).map(|before| self.pasts[before]) else { return 0.0 };
        let mut more = self.pasts[after];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (less.met + more.met);
            match self.past(middle, Some(&less.at)) {
                Some(past) if reaches(&past) => more = past,
                Some(past) => less = past,
                None => break,
            }
        }
        0.5 * (less.force + more.force)
    }
}
