//! Equilibrium with some contacts held, to some micrometres, at the price of a few shapes: no second derivatives are made.
//!
//! Stiffness is the identity in the factors x (see [`modes`](super::modes)), so that a shape in balance is x = −GᵀF with the gradients G of
//! the contacts at that shape. Each step takes those of the shape before. What it leaves shrinks by how much the forces soften the chain, about
//! one less its stability margin.

use super::modes::Layout;
use super::newton::{Held, Unknowns, factors};
use super::shape::{Shape, shape};
use crate::model::Vec3;
use nalgebra::{DMatrix, DVector};

/// A change of the factors below this is none: a tenth of a micrometre on the paper's robot.
const SETTLED: f64 = 3e-6;
/// A chain that is so soft that it takes more is left to Newton's method.
const STEPS: usize = 12;

/// From a start that is near. `None` where it does not settle.
pub(super) fn lightly(layout: &Layout, bends: &[f64], held: &[Held], start: &Unknowns) -> Option<(Unknowns, Shape)> {
    let mut x = start.x.clone();
    for _ in 0..STEPS {
        let shape = shape(layout, &factors(&x, bends))?;
        let gradients = gradients(layout, &shape, held);
        let gap = |(row, held): (usize, &Held)| {
            let passed = held.normal.dot(&shape.ends[held.piece].position) - held.offset;
            passed - (gradients.row(row) * &x)[0]
        };
        let right = DVector::from_iterator(held.len(), held.iter().enumerate().map(gap));
        let forces = (&gradients * gradients.transpose()).cholesky()?.solve(&right);
        let next = -gradients.tr_mul(&forces);
        let step = (&next - &x).amax();
        x = next;
        if !step.is_finite() {
            return None;
        }
        if step < SETTLED {
            return Some((Unknowns { x, forces }, shape));
        }
    }
    None
}

/// How far the last contact's point gives way along its normal, per unit of force, in the units of the layout, while the others hold: of a
/// chain that no contact bends.
pub(super) fn softness(layout: &Layout, bends: &[f64], held: &[Held]) -> Option<f64> {
    let x = DVector::zeros(layout.unknowns);
    let gradients = gradients(layout, &shape(layout, &factors(&x, bends))?, held);
    let stiffness = (&gradients * gradients.transpose()).try_inverse()?;
    Some(1.0 / stiffness[(held.len() - 1, held.len() - 1)])
}

/// First derivatives of n·p of each contact held, by the factors x.
fn gradients(layout: &Layout, shape: &Shape, held: &[Held]) -> DMatrix<f64> {
    let count = layout.gauss.count();
    let mut all = DMatrix::zeros(held.len(), layout.unknowns);
    for (row, held) in held.iter().enumerate() {
        let end = shape.ends[held.piece].position;
        let turning = |node: usize| {
            let share = layout.gauss.weights[node % count] * layout.pieces[node / count].length;
            shape.rotations[node].tr_mul(&(end - shape.positions[node]).cross(&held.normal)) * share
        };
        let below: Vec<Vec3> = (0..(held.piece + 1) * count).map(turning).collect();
        for (mode, by) in layout.modes[..layout.unknowns].iter().zip(all.row_mut(row).iter_mut()) {
            let nodes = below.iter().skip(mode.pieces.start * count);
            *by = nodes.zip(&mode.values).map(|(turning, value)| turning[mode.axis] * value).sum();
        }
    }
    all
}
