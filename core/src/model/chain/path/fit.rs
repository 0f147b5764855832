//! Shapes over a stretch of time, from their values at Chebyshev points.

use super::Instant;
use crate::model::chain::modes::{Layout, Units};
use crate::model::chain::newton::Unknowns;
use crate::model::chain::profile::Profile;
use crate::model::chain::{Bends, Rod};
use crate::model::orientation::{from_vector, rotation_vector};
use crate::model::{Pose, Vec3};
use libm::cos;
use nalgebra::DVector;
use std::f64::consts::PI;
use std::sync::Arc;

/// Steps between Chebyshev points of a stretch.
pub(super) const STEPS: usize = 12;
/// The last terms of a series are no larger than this, in lengths of the chain, rad, and EI/L².
const TOLERANCE: [f64; 3] = [2e-10, 2e-9, 1e-7];

/// What was solved at one instant. Lengths in units of the chain's, forces likewise.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub time: f64,
    pub at: Unknowns,
    /// Of each end disk below the last contact: position and rotation vector from where the free chain would have it.
    pub from_free: Vec<(Vec3, Vec3)>,
    /// Of every contact cut into the layout, in its order: how far its point is from its plane; 0 where it is held.
    pub gaps: Vec<f64>,
}

impl Node {
    fn values(&self) -> impl Iterator<Item = (usize, f64)> {
        let disks = self.from_free.iter().flat_map(|(position, turn)| {
            position.iter().map(|x| (0, *x)).chain(turn.iter().map(|x| (1, *x))).collect::<Vec<_>>()
        });
        let gaps = self.gaps.iter().map(|gap| (0, *gap));
        disks.chain(gaps).chain(self.at.forces.iter().map(|force| (2, *force)))
    }
}

/// The shapes of a stretch.
#[derive(Debug, Clone)]
pub(super) enum Fit {
    /// Nothing presses.
    Free,
    /// Solved at points.
    Pressed(Arc<Solved>),
}

/// Shapes at Chebyshev points, or at one where nothing moves.
#[derive(Debug, Clone)]
pub(super) struct Solved {
    pub layout: Arc<Layout>,
    /// The unit of forces, N.
    pub unit: f64,
    /// The unit of lengths, m.
    pub length: f64,
    pub nodes: Vec<Node>,
    /// Stability margins at the first, the middle and the last node.
    pub margins: [f64; 3],
}

/// Chebyshev points of an interval, both ends among them.
pub(super) fn points(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..=STEPS).map(move |k| match k {
        0 => from,
        STEPS => to,
        k => from + (to - from) * 0.5 * (1.0 - cos(PI * k as f64 / STEPS as f64)),
    })
}

impl Solved {
    /// Barycentric weights of the nodes at a time.
    pub fn weights(&self, time: f64) -> Vec<f64> {
        let last = self.nodes.len() - 1;
        let mut weights = vec![0.0; self.nodes.len()];
        if let Some(exact) = self.nodes.iter().position(|node| node.time == time).or((last == 0).then_some(0)) {
            weights[exact] = 1.0;
            return weights;
        }
        let mut sum = 0.0;
        for (k, node) in self.nodes.iter().enumerate() {
            let half = if k == 0 || k == last { 0.5 } else { 1.0 };
            let sign = if k % 2 == 0 { half } else { -half };
            weights[k] = sign / (time - node.time);
            sum += weights[k];
        }
        weights.iter_mut().for_each(|weight| *weight /= sum);
        weights
    }

    fn mean<T, Z>(&self, weights: &[f64], zero: T, of: Z) -> T
    where
        T: std::ops::Add<Output = T>,
        Z: Fn(&Node, f64) -> T,
    {
        self.nodes.iter().zip(weights).fold(zero, |sum, (node, weight)| sum + of(node, *weight))
    }

    /// Factors x at a time.
    pub fn x(&self, weights: &[f64]) -> DVector<f64> {
        self.mean(weights, DVector::zeros(self.layout.unknowns), |node, weight| &node.at.x * weight)
    }

    /// The force in a row, in its unit.
    pub fn force(&self, weights: &[f64], row: usize) -> f64 {
        self.mean(weights, 0.0, |node, weight| node.at.forces[row] * weight)
    }

    /// The gap of a contact of the layout, in units of length.
    pub fn gap(&self, weights: &[f64], contact: usize) -> f64 {
        self.mean(weights, 0.0, |node, weight| node.gaps[contact] * weight)
    }

    /// About the margin: the parabola through those that are known.
    fn margin(&self, time: f64) -> f64 {
        let (first, last) = (self.nodes[0].time, self.nodes[self.nodes.len() - 1].time);
        if first == last {
            return self.margins[0];
        }
        let share = (time - first) / (last - first);
        let [a, b, c] = self.margins;
        let curved = a * (1.0 - share) * (1.0 - 2.0 * share) + b * 4.0 * share * (1.0 - share);
        (curved + c * share * (2.0 * share - 1.0)).clamp(0.0, 1.0)
    }

    /// Whether the nodes tell all in between.
    pub fn is_smooth(&self) -> bool {
        let columns: Vec<Vec<(usize, f64)>> = self.nodes.iter().map(|node| node.values().collect()).collect();
        let last = columns.len() - 1;
        if last == 0 {
            return true;
        }
        let n = last as f64;
        // The last two terms of the Chebyshev series through the nodes.
        let term = |column: usize, order: f64| {
            let sum: f64 = (0..=last)
                .map(|k| {
                    let half = if k == 0 || k == last { 0.5 } else { 1.0 };
                    half * cos(PI * order * k as f64 / n) * columns[k][column].1
                })
                .sum();
            (sum * 2.0 / n).abs()
        };
        (0..columns[0].len()).all(|column| {
            let most = TOLERANCE[columns[0][column].0];
            term(column, n) * 0.5 < most && term(column, n - 1.0) < most
        })
    }
}

impl Fit {
    /// Moves what is free to where it truly is.
    pub fn bend(&self, time: f64, active: &[usize], instant: &mut Instant) {
        let Self::Pressed(solved) = self else { return };
        let weights = solved.weights(time);
        let below = solved.nodes[0].from_free.len();
        let free_base = instant.disks[below - 1];
        for (segment, disk) in instant.disks.iter_mut().enumerate().take(below) {
            let zero = Vec3::zeros();
            let moved = solved.mean(&weights, zero, |node, weight| node.from_free[segment].0 * weight);
            let turn = solved.mean(&weights, zero, |node, weight| node.from_free[segment].1 * weight);
            disk.position += moved * solved.length;
            disk.rotation *= from_vector(&turn);
        }
        let base = instant.disks[below - 1];
        for disk in &mut instant.disks[below..] {
            *disk = carried(&free_base, disk, &base);
        }
        for (row, &contact) in active.iter().enumerate() {
            instant.forces[contact] = solved.force(&weights, row) * solved.unit;
        }
        instant.margin = solved.margin(time);
    }

    /// The curvature at a time; none of a free chain.
    pub fn profile(&self, rods: &[Rod], time: f64, bends: &[Bends]) -> Option<Profile> {
        let Self::Pressed(solved) = self else { return None };
        Some(Profile::of(&solved.layout, rods, &solved.x(&solved.weights(time)), bends))
    }
}

/// What stands in one frame as another did in another.
fn carried(from: &Pose, frame: &Pose, to: &Pose) -> Pose {
    let back = from.rotation.transpose();
    Pose {
        position: to.position + to.rotation * (back * (frame.position - from.position)),
        rotation: to.rotation * (back * frame.rotation),
    }
}

/// Where disks are from where the free chain has them.
pub(super) fn from_free(free: &[Pose], ends: impl Iterator<Item = Pose>, units: Units) -> Vec<(Vec3, Vec3)> {
    let each = free.iter().zip(ends).map(|(free, end)| {
        let turn = rotation_vector(&(free.rotation.transpose() * end.rotation));
        (end.position - free.position / units.length, turn)
    });
    each.collect()
}
