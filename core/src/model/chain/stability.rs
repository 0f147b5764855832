//! Whether energy grows in every direction that the contacts allow.

use nalgebra::linalg::SymmetricTridiagonal;
use nalgebra::{DMatrix, DVector};

/// The smallest ratio of second variations, with and without the contact forces, over all changes of shape that keep the bends
/// commanded and the contacts held: 1 without a force, 0 where the shape buckles. At most 1, because there are always
/// changes of shape, with ever shorter waves, on which the forces do nothing.
///
/// The terms of the curvature are such that elastic energy alone has the identity for its second derivative.
/// `hessian` is that of energy and contacts, `gradients` has those of each contact held in its rows.
pub(super) fn margin(hessian: &DMatrix<f64>, gradients: &DMatrix<f64>) -> f64 {
    1.0 + lowest(within(hessian, gradients))
}

/// Whether the margin is above this, at a fraction of its price.
pub(super) fn is_stable(hessian: &DMatrix<f64>, gradients: &DMatrix<f64>, least: f64) -> bool {
    let mut matrix = within(hessian, gradients);
    (0..matrix.nrows()).for_each(|i| matrix[(i, i)] += 1.0 - least);
    matrix.cholesky().is_some()
}

/// The second derivatives less those of the elastic energy alone, within the changes of shape that keep the contacts.
fn within(hessian: &DMatrix<f64>, gradients: &DMatrix<f64>) -> DMatrix<f64> {
    let unknowns = hessian.nrows();
    let mut normals: Vec<DVector<f64>> = Vec::new();
    for row in gradients.row_iter() {
        let mut normal = row.columns(0, unknowns).transpose();
        let size = normal.norm();
        // Twice: what rounding leaves after the first is gone after the second.
        for _ in 0..2 {
            normals.iter().for_each(|other| normal -= other * other.dot(&normal));
        }
        if normal.norm() > 1e-12 * size {
            normals.push(normal.normalize());
        }
    }
    // Directions across a contact held get the value 0, which is no less than the answer.
    let mut matrix = hessian.clone();
    (0..unknowns).for_each(|i| matrix[(i, i)] -= 1.0);
    normals.iter().for_each(|normal| project(&mut matrix, normal));
    matrix
}

/// P M P with P = 1 − n nᵀ.
fn project(matrix: &mut DMatrix<f64>, normal: &DVector<f64>) {
    let image = &*matrix * normal;
    let within = normal.dot(&image);
    for j in 0..normal.len() {
        for i in 0..normal.len() {
            matrix[(i, j)] += normal[i] * normal[j] * within - normal[i] * image[j] - image[i] * normal[j];
        }
    }
}

/// The smallest eigenvalue of a symmetric matrix, at most 0: halving by the signs of the pivots of its tridiagonal form.
fn lowest(matrix: DMatrix<f64>) -> f64 {
    let (diagonal, beside) = match matrix.nrows() {
        0 => return 0.0,
        1 => return matrix[(0, 0)].min(0.0),
        _ => SymmetricTridiagonal::new(matrix).unpack_tridiagonal(),
    };
    let reach = |i: usize| {
        let before = if i > 0 { beside[i - 1].abs() } else { 0.0 };
        before + beside.get(i).map_or(0.0, |b| b.abs())
    };
    let bound = (0..diagonal.len()).map(|i| diagonal[i] - reach(i)).fold(0.0, f64::min);
    let below = |x: f64| {
        let mut pivot = 1.0;
        diagonal.iter().enumerate().any(|(i, d)| {
            let coupled = if i > 0 { beside[i - 1] * beside[i - 1] / pivot } else { 0.0 };
            pivot = d - x - coupled;
            if pivot == 0.0 {
                pivot = -f64::MIN_POSITIVE;
            }
            pivot < 0.0
        })
    };
    let (mut low, mut high) = (bound, 0.0);
    while high - low > 4.0 * f64::EPSILON * (1.0 + low.abs()) {
        let middle = 0.5 * (low + high);
        if below(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}
