//! The rotation that best turns some vectors into others (Horn's quaternion).

use crate::model::Mat3;
use crate::record::log::rotation::from_quaternion;
use libm::{hypot, sqrt};

/// Turns of Jacobi's method; a symmetric 4 × 4 matrix needs about five.
const SWEEPS: usize = 30;

/// The rotation R for which tr(Rᵀ B) is largest, B = Σ P pᵀ over pairs of vectors p and what R should make of them; and how
/// well it is determined: 0 when another one is as good, about 1 when all three axes count alike.
#[must_use]
pub fn best(b: &Mat3) -> (Mat3, f64) {
    let s = |i: usize, j: usize| b[(j, i)];
    let trace = s(0, 0) + s(1, 1) + s(2, 2);
    let (x, y, z) = (s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0));
    let mut n = [
        [trace, x, y, z],
        [x, 2.0 * s(0, 0) - trace, s(0, 1) + s(1, 0), s(2, 0) + s(0, 2)],
        [y, s(0, 1) + s(1, 0), 2.0 * s(1, 1) - trace, s(1, 2) + s(2, 1)],
        [z, s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), 2.0 * s(2, 2) - trace],
    ];
    let mut vectors = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    for _ in 0..SWEEPS {
        for p in 0..4 {
            for q in p + 1..4 {
                turn(&mut n, &mut vectors, p, q);
            }
        }
    }
    let mut order = [0, 1, 2, 3];
    order.sort_by(|a, b| n[*b][*b].total_cmp(&n[*a][*a]));
    let [first, second, ..] = order;
    let size = b.norm();
    let gap = if size > 0.0 { (n[first][first] - n[second][second]) / size } else { 0.0 };
    (from_quaternion(&vectors.map(|row| row[first])), gap)
}

/// One of Jacobi's rotations: makes the element (p, q) zero. The eigenvectors are columns.
fn turn(n: &mut [[f64; 4]; 4], vectors: &mut [[f64; 4]; 4], p: usize, q: usize) {
    if n[p][q] == 0.0 {
        return;
    }
    let theta = (n[q][q] - n[p][p]) / (2.0 * n[p][q]);
    let t = if theta < 0.0 { -1.0 } else { 1.0 } / (theta.abs() + hypot(theta, 1.0));
    let c = 1.0 / sqrt(1.0 + t * t);
    let s = c * t;
    for row in n.iter_mut().chain(vectors) {
        (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
    }
    let (left, right) = (n[p], n[q]);
    for (k, (a, b)) in left.into_iter().zip(right).enumerate() {
        (n[p][k], n[q][k]) = (c * a - s * b, s * a + c * b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Vec3;
    use crate::model::orientation::from_euler;

    #[test]
    fn vectors_tell_the_rotation_unless_they_lie_on_a_line() {
        let rotation = from_euler(&[0.4, -1.2, 2.5]);
        let pairs = |vectors: &[Vec3]| vectors.iter().map(|v| (rotation * v) * v.transpose()).sum::<Mat3>();
        let (found, gap) = best(&pairs(&[Vec3::new(1.0, 0.2, 0.0), Vec3::new(0.3, 1.0, 0.1)]));
        assert!((found - rotation).norm() < 1e-12 && gap > 0.1, "{found} {gap}");
        let (_, gap) = best(&pairs(&[Vec3::new(1.0, 0.2, 0.0), Vec3::new(-2.0, -0.4, 0.0)]));
        assert!(gap.abs() < 1e-12, "{gap}");
        assert_eq!(best(&Mat3::zeros()).1, 0.0);
    }
}
