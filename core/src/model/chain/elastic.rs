//! The shape that an elastic chain takes against planes: which of them it presses on, how hard, and whether it stays there.

use super::free::{Moving, free, moments};
use super::modes::{Layout, Units};
use super::newton::Equilibrium;
use super::search::{Found, search};
use super::variation::Variation;
use super::{Bends, Contact, Disk, Rod, bends};
use crate::model::chain::free::point;
use crate::model::{Configuration, Pose};
use thiserror::Error;

/// A chain at rest: its elastic energy is least among all shapes near it that have the bends commanded and pass no plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Settled {
    /// The end disk of every segment, from the base, with its twist while the contacts are what they are.
    pub disks: Vec<Disk>,
    /// The contacts that press, by their places in the list, rising.
    pub active: Vec<usize>,
    /// Force F of every contact, N: 0 where it does not press; that on the robot is −F n.
    pub forces: Vec<f64>,
    /// How far every contact's point is from its plane, m: 0 where it presses.
    pub gaps: Vec<f64>,
    /// Derivatives of every force by the U of every segment, N/rad.
    pub forces_by_bends: Vec<Vec<Bends>>,
    /// Moments M = ∂E*/∂U that the joint forces balance, N·m, for each segment about x and y of its own frame; E* is the least
    /// energy for the bends commanded. A segment's own backbones carry M_k − M_{k+1}.
    pub moments: Vec<Bends>,
    /// Elastic energy of this shape, J.
    pub energy: f64,
    /// The smallest second variation of the energy over that of the elastic energy alone, among all changes of shape that keep
    /// bends and contacts: above 0 and at most 1, which it is without a force. It would be 0 where the chain buckles.
    pub margin: f64,
}

/// Why there is no answer: no stable shape was found.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("no stable shape: {}", self.words())]
pub struct Unsettled {
    /// The way on which it was looked for first.
    pub way: Way,
    /// The share of the way up to which the shape is stable.
    pub reached: f64,
    /// Margin, 0 or less, of an unstable equilibrium at what is asked for, where one was found.
    pub margin: Option<f64>,
}

/// How a chain comes to where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// It bends from straight, every U in proportion.
    Bending,
    /// The planes are pressed in from where they just touch the free shape, because one is in the way of the straight chain.
    Pressing,
}

impl Unsettled {
    fn words(&self) -> String {
        let reached = 100.0 * self.reached;
        let way = match self.way {
            Way::Bending => {
                format!("bent in proportion from straight, the chain buckles at {reached:.1} % of these bends")
            }
            Way::Pressing => {
                format!(
                    "with the planes pressed into the free shape, the chain gives way at {reached:.1} % of their path"
                )
            }
        };
        match self.margin {
            Some(margin) => format!("{way}, and the equilibrium asked for is unstable (stability margin {margin:.6})"),
            None => format!("{way} or cannot follow, and no other equilibrium was found"),
        }
    }
}

/// The shape of a chain: one configuration for each rod, from the base.
///
/// It is the one that the chain comes to as it bends in proportion from straight, contacts met and opened on the way. Where that
/// way ends before (the chain buckles and snaps), any stable shape that Newton's method finds from the free one is taken.
///
/// ```
/// use centrode_core::model::chain::{Contact, Rod, Torsion, settle};
/// use centrode_core::model::{Configuration, Vec3};
///
/// let rod = Rod { length: 0.03, bending_stiffness: 0.005, torsion: Torsion::Ratio(5.0) };
/// let bent = [Configuration::new(0.6, 0.0), Configuration::new(0.4, 1.0)];
/// let plane = Contact { segment: 1, at: 0.015, normal: Vec3::new(1.0, 0.0, 0.0), offset: 0.015 };
/// let settled = settle(&[rod; 2], &bent, &[plane])?;
/// assert_eq!(settled.active, [0]);
/// assert!(settled.forces[0] > 0.0 && settled.margin > 0.0);
/// # Ok::<(), centrode_core::model::chain::Unsettled>(())
/// ```
///
/// # Errors
/// When no stable shape is found.
pub fn settle(rods: &[Rod], configurations: &[Configuration], contacts: &[Contact]) -> Result<Settled, Unsettled> {
    let segments = rods.len().min(configurations.len());
    let (rods, configurations) = (&rods[..segments], &configurations[..segments]);
    let untouched = untouched(rods, configurations, contacts);
    let touched = |gap: &f64| *gap < -TOUCH * Units::of(rods).length;
    if !untouched.gaps.iter().any(touched) {
        return Ok(untouched);
    }
    let found = search(rods, configurations, contacts)?;
    Ok(assemble(rods, configurations, contacts, &found))
}

/// A gap of less than this much of the chain's length is none.
pub(super) const TOUCH: f64 = 1e-13;

/// The free shape, whether it passes a plane or not.
fn untouched(rods: &[Rod], configurations: &[Configuration], contacts: &[Contact]) -> Settled {
    let lengths: Vec<f64> = rods.iter().map(|rod| rod.length).collect();
    let gap = |contact: &Contact| {
        contact.offset - contact.normal.dot(&point(&lengths, configurations, contact.segment, contact.at).position)
    };
    let moments = moments(rods, configurations);
    Settled {
        disks: free(&lengths, configurations),
        active: Vec::new(),
        forces: vec![0.0; contacts.len()],
        gaps: contacts.iter().map(gap).collect(),
        forces_by_bends: vec![vec![Bends::zeros(); rods.len()]; contacts.len()],
        energy: moments.iter().zip(configurations).map(|(moment, at)| 0.5 * moment.dot(&bends(*at))).sum(),
        moments,
        margin: 1.0,
    }
}

/// What was found, in SI.
fn assemble(rods: &[Rod], configurations: &[Configuration], contacts: &[Contact], found: &Found) -> Settled {
    let Found { layout, active, equilibrium, margin } = found;
    let units = Units::of(rods);
    let mut settled = untouched(rods, configurations, contacts);
    settled.margin = *margin;
    settled.active.clone_from(active);
    for (place, contact) in contacts.iter().enumerate() {
        let end = equilibrium.shape.ends[layout.contacts[place]].position * units.length;
        settled.gaps[place] = contact.offset - contact.normal.dot(&end);
    }
    let by_force = equilibrium.by_bends.rows(layout.unknowns, active.len());
    for (row, &place) in active.iter().enumerate() {
        let force = equilibrium.at.forces[row];
        (settled.forces[place], settled.gaps[place]) = (force * units.force(), 0.0);
        for segment in 0..layout.segments() {
            let axis = |axis| by_force[(row, 2 * segment + axis)] * units.force();
            settled.forces_by_bends[place][segment] = Bends::new(axis(0), axis(1));
            let column = layout.column(segment, 0);
            let pushed = |axis| equilibrium.gradients[(row, column + axis)] * force * units.moment();
            settled.moments[segment] += Bends::new(pushed(0), pushed(1));
        }
    }
    settled.energy += 0.5 * equilibrium.at.x.norm_squared() * units.moment();
    settled.disks = disks(rods, configurations, layout, equilibrium);
    settled
}

/// The end disks: those below the last contact where the shape ends its segments, those above as free arcs.
fn disks(rods: &[Rod], configurations: &[Configuration], layout: &Layout, at: &Equilibrium) -> Vec<Disk> {
    let length = Units::of(rods).length;
    let variation = Variation::new(layout, &at.shape);
    let last = layout.segments() - 1;
    let mut disks: Vec<Disk> = Vec::with_capacity(rods.len());
    let mut moving = Moving::base(rods.len());
    for segment in 0..=last {
        let piece = layout.last_piece(segment);
        let end = at.shape.ends[piece];
        moving.pose = Pose { position: end.position * length, rotation: end.rotation };
        for by in 0..=last {
            moving.by_bends[by] = [0, 1].map(|axis| {
                let column = at.by_bends.column(2 * by + axis);
                let own = variation.motion(layout.column(by, axis), piece);
                let twist = (0..layout.unknowns)
                    .map(|mode| variation.motion(mode, piece) * column[mode])
                    .fold(own, |sum, twist| sum + twist);
                crate::model::Twist { linear: twist.linear * length, angular: twist.angular }
            });
        }
        if segment == last
            && let Some(rest) = layout.rest
        {
            let moved = |mode: usize, by: usize, axis: usize| at.by_bends[(mode, 2 * by + axis)] * rest.bend;
            let bent =
                Bends::from_fn(|i, _| bends(configurations[last])[i] * rest.share + at.at.x[rest.modes[i]] * rest.bend);
            moving = moving.then(rest.length * length, &bent, |by, axis| {
                if by > last {
                    return Bends::zeros();
                }
                let commanded = if by == last { super::free::unit(axis) * rest.share } else { Bends::zeros() };
                commanded + Bends::from_fn(|i, _| moved(rest.modes[i], by, axis))
            });
        }
        disks.push(moving.clone().into());
    }
    for segment in last + 1..rods.len() {
        moving = moving.then_segment(segment, rods[segment].length, configurations[segment]);
        disks.push(moving.clone().into());
    }
    disks
}
