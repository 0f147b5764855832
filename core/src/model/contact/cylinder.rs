//! A round beam against the backbone's round envelope, along which it slides without friction.

use super::plane::{Solved, first};
use super::ritz::{Basis, MODES};
use super::{Meeting, Planar, Touching, Unknowns};
use libm::sincos;
use nalgebra::{SMatrix, SVector};

const SMALL: f64 = 1e-9;
const STEPS: usize = 40;
/// Coefficients, place, multiplier.
const SIZE: usize = MODES + 2;
const PLACE: usize = MODES;
const MULTIPLIER: usize = MODES + 1;

type Square = SMatrix<f64, SIZE, SIZE>;
type Column = SVector<f64, SIZE>;

/// The shape at a bend φ (rad) against a beam whose centre keeps the distance `rounding` (radius of the beam and of the
/// envelope, in units of L) from the backbone, from a near shape or, without, from that of first contact. `None` where
/// Newton's method finds none.
#[must_use]
pub fn solve(basis: &Basis, meeting: &Meeting, rounding: f64, bend: f64, from: Option<&Unknowns>) -> Option<Solved> {
    let start = Unknowns { coefficients: first(meeting.slope()), place: meeting.place, multiplier: 0.0 };
    let reach = rounding * meeting.side;
    let centre = centre(basis, reach, &start);
    let mut at = from.copied().unwrap_or(start);
    let mut last = false;
    for _ in 0..STEPS {
        let (matrix, residual) = system(basis, reach, &centre, bend, &at);
        let step = matrix.lu().solve(&-residual)?;
        let largest = step.amax();
        // A step out of the backbone is cut: the place stays within it.
        let share = match at.place + step[PLACE] {
            place if place >= 1.0 => 0.5 * (1.0 - at.place) / step[PLACE],
            place if place <= 0.0 => -0.5 * at.place / step[PLACE],
            _ => 1.0,
        };
        if !largest.is_finite() {
            return None;
        }
        at.coefficients.iter_mut().zip(step.iter()).for_each(|(b, step)| *b += share * step);
        at.place += share * step[PLACE];
        at.multiplier += share * step[MULTIPLIER];
        if last {
            let lu = system(basis, reach, &centre, bend, &at).0.lu();
            let mut right = Column::zeros();
            right[0] = at.place / (1.0 - at.place);
            let by = lu.solve(&right)?;
            let mut coefficients = [0.0; MODES];
            coefficients.copy_from_slice(&by.as_slice()[..MODES]);
            let by_bend = Unknowns { coefficients, place: by[PLACE], multiplier: by[MULTIPLIER] };
            let touching = Touching { bend, at, by_bend, force_slope: at.coefficients[0] };
            return Some(Solved { touching, stable: lu.determinant() > 0.0 });
        }
        last = largest < SMALL && share == 1.0;
    }
    None
}

/// Where the beam's centre is when it touches a shape: p(σ) + ρ n(α(σ)).
fn centre(basis: &Basis, reach: f64, at: &Unknowns) -> Planar {
    let (mean, slope) = basis.below(&at.coefficients, 1.0);
    let (sin, cos) = sincos(slope);
    mean * at.place + Planar::new(cos, -sin) * reach
}

/// Equilibrium of the backbone and the two constraints, with their Jacobian.
fn system(basis: &Basis, reach: f64, held: &Planar, bend: f64, at: &Unknowns) -> (Square, Column) {
    let Unknowns { coefficients, place, multiplier } = at;
    let slope = coefficients[0];
    let (mut matrix, mut residual) = (Square::zeros(), Column::zeros());
    let mut mean = Planar::zeros();
    for (row, (angle, weight)) in basis.slopes.iter().zip(basis.angles(coefficients).iter().zip(&basis.weights)) {
        // The force acts along the normal of the backbone where it touches, so the slopes count from there.
        let (sin, cos) = sincos(angle - slope);
        let (sine, cosine) = sincos(*angle);
        mean += Planar::new(sine, cosine) * *weight;
        for j in 0..MODES {
            residual[j] += multiplier * weight * cos * row[j];
            matrix[(j, MULTIPLIER)] += weight * cos * row[j];
            matrix[(PLACE, j)] += place * weight * cosine * row[j];
            matrix[(MULTIPLIER, j)] -= place * weight * sine * row[j];
            for k in 0..MODES {
                matrix[(j, k)] -= multiplier * weight * sin * row[j] * row[k];
            }
            matrix[(j, 0)] += multiplier * weight * sin * row[j];
        }
    }
    let eta = place / (1.0 - place);
    for j in 0..MODES {
        let stiffness = 1.0 / (2.0 * j as f64 + 1.0);
        matrix[(j, j)] += stiffness;
        residual[j] += stiffness * coefficients[j];
    }
    matrix[(0, 0)] += eta;
    residual[0] -= eta * (bend - slope);
    matrix[(0, PLACE)] = -(bend - slope) / ((1.0 - place) * (1.0 - place));
    let (sin, cos) = sincos(slope);
    residual[PLACE] = place * mean.x + reach * cos - held.x;
    residual[MULTIPLIER] = place * mean.y - reach * sin - held.y;
    matrix[(PLACE, 0)] -= reach * sin;
    matrix[(MULTIPLIER, 0)] -= reach * cos;
    matrix[(PLACE, PLACE)] = mean.x;
    matrix[(MULTIPLIER, PLACE)] = mean.y;
    (matrix, residual)
}
