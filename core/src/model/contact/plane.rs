//! A frictionless plane against one point of the backbone, as against the bead of a disk.
//!
//! The plane stands along the tangent that the backbone had at first contact. The point slides on it, its slope is free; the
//! force is normal to the plane.

use super::ritz::{Basis, MODES};
use super::{Meeting, Touching, Unknowns};
use libm::sincos;
use nalgebra::{SMatrix, SVector};

/// After a step below this, rad, what is left is rounding: the next system is that of the shape itself, and gives its derivative.
const SMALL: f64 = 1e-9;
/// It takes 6 from a cold start.
const STEPS: usize = 40;

type Square = SMatrix<f64, { MODES + 1 }, { MODES + 1 }>;
type Column = SVector<f64, { MODES + 1 }>;

/// One solved configuration, with the sign of its determinant: a branch of stable shapes ends where that changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solved {
    /// The shape.
    pub touching: Touching,
    /// Whether energy grows in every direction that the contact allows.
    pub stable: bool,
}

/// The shape at a bend φ (rad), from a near one or, without, from that of first contact. `None` where Newton's method finds
/// none.
#[must_use]
pub fn solve(basis: &Basis, meeting: &Meeting, bend: f64, from: Option<&Unknowns>) -> Option<Solved> {
    let (slope, place) = (meeting.slope(), meeting.place);
    let eta = place / (1.0 - place);
    let angle = super::Angle::new(slope);
    let held = slope * angle.versinc();
    let mut at = from.copied().unwrap_or(Unknowns { coefficients: first(slope), place, multiplier: 0.0 });
    let mut last = false;
    for _ in 0..STEPS {
        let (matrix, residual) = system(basis, slope, eta, held, bend, &at);
        let lu = matrix.lu();
        let step = lu.solve(&-residual)?;
        let largest = step.amax();
        if !largest.is_finite() {
            return None;
        }
        at.coefficients.iter_mut().zip(step.iter()).for_each(|(b, step)| *b += step);
        at.multiplier += step[MODES];
        if last {
            let mut right = Column::zeros();
            right[0] = eta;
            let by = lu.solve(&right)?;
            let mut coefficients = [0.0; MODES];
            coefficients.copy_from_slice(&by.as_slice()[..MODES]);
            let by_bend = Unknowns { coefficients, place: 0.0, multiplier: by[MODES] };
            let touching = Touching { bend, at, by_bend, force_slope: slope };
            return Some(Solved { touching, stable: lu.determinant() < 0.0 });
        }
        last = largest < SMALL;
    }
    None
}

/// The shape at first contact, with its derivative in closed form: the arc is still free and presses on nothing.
#[must_use]
pub fn at_first_contact(basis: &Basis, meeting: &Meeting) -> Touching {
    let (slope, place, bend) = (meeting.slope(), meeting.place, meeting.bend);
    let eta = place / (1.0 - place);
    let mut constraint = [0.0; MODES];
    for (row, weight) in basis.slopes.iter().zip(&basis.weights) {
        let along = weight * libm::cos(slope * (row[0] - 1.0));
        constraint.iter_mut().zip(row).for_each(|(sum, by)| *sum += along * by);
    }
    // Without a force the Hessian is diagonal.
    let compliance: [f64; MODES] =
        std::array::from_fn(|j| if j == 0 { 1.0 / (1.0 + eta) } else { 2.0 * j as f64 + 1.0 });
    let yielding: f64 = constraint.iter().zip(&compliance).map(|(g, c)| g * g * c).sum();
    let multiplier = eta * compliance[0] * constraint[0] / yielding;
    let pushed = |j: usize| compliance[j] * (if j == 0 { eta } else { 0.0 } - constraint[j] * multiplier);
    let by_bend = Unknowns { coefficients: std::array::from_fn(pushed), place: 0.0, multiplier };
    let at = Unknowns { coefficients: first(slope), place, multiplier: 0.0 };
    Touching { bend, at, by_bend, force_slope: slope }
}

/// Coefficients of the free arc: constant curvature.
pub(super) fn first(slope: f64) -> [f64; MODES] {
    let mut coefficients = [0.0; MODES];
    coefficients[0] = slope;
    coefficients
}

/// The bordered Hessian, and the gradient of the Lagrangian above the constraint.
fn system(basis: &Basis, slope: f64, eta: f64, held: f64, bend: f64, at: &Unknowns) -> (Square, Column) {
    let (mut matrix, mut residual) = (Square::zeros(), Column::zeros());
    for (row, (angle, weight)) in basis.slopes.iter().zip(basis.angles(&at.coefficients).iter().zip(&basis.weights)) {
        let (sin, cos) = sincos(angle - slope);
        residual[MODES] += weight * sin;
        for j in 0..MODES {
            matrix[(MODES, j)] += weight * cos * row[j];
            for k in 0..=j {
                matrix[(j, k)] -= at.multiplier * weight * sin * row[j] * row[k];
            }
        }
    }
    residual[MODES] += held;
    for j in 0..MODES {
        let stiffness = 1.0 / (2.0 * j as f64 + 1.0);
        matrix[(j, j)] += stiffness;
        matrix[(j, MODES)] = matrix[(MODES, j)];
        residual[j] = stiffness * at.coefficients[j] + at.multiplier * matrix[(MODES, j)];
        for k in 0..j {
            matrix[(k, j)] = matrix[(j, k)];
        }
    }
    matrix[(0, 0)] += eta;
    residual[0] -= eta * (bend - at.coefficients[0]);
    (matrix, residual)
}
