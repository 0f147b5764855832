//! From the curvature at nodes to the rotation and position there.
//!
//! R′ = R \[u\]×, p′ = R e₃. On each piece R = R₀ e^\[Ω\]×, with Ω′ = v + ½ Ω × v + c(|Ω|) Ω × (Ω × v).

use super::modes::Layout;
use crate::model::orientation::from_vector;
use crate::model::special::Angle;
use crate::model::{Mat3, Pose, Vec3};

/// It takes two or three in a bending plane, where Ω and v are parallel, and a dozen for a strong twist.
const SWEEPS: usize = 80;
/// A change of Ω (rad) that is rounding.
const ROUNDING: f64 = 4e-16;

/// The backbone below the last contact; lengths in units of the whole chain's.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    /// At the nodes of every piece in turn.
    pub rotations: Vec<Mat3>,
    pub positions: Vec<Vec3>,
    /// The end of every piece.
    pub ends: Vec<Pose>,
}

/// The shape of these factors: x, then the U of every segment that has pieces. `None` where a piece turns too far.
pub(super) fn shape(layout: &Layout, factors: &[f64]) -> Option<Shape> {
    let count = layout.gauss.count();
    let curvatures = curvatures(layout, factors);
    let mut base = Pose { position: Vec3::zeros(), rotation: Mat3::identity() };
    let mut shape = Shape {
        rotations: Vec::with_capacity(curvatures.len()),
        positions: Vec::with_capacity(curvatures.len()),
        ends: Vec::with_capacity(layout.pieces.len()),
    };
    for (piece, curvatures) in layout.pieces.iter().zip(curvatures.chunks_exact(count)) {
        let steps: Vec<Vec3> = curvatures.iter().map(|u| u * piece.length).collect();
        let (vectors, end) = rotation_vectors(&layout.gauss, &steps)?;
        let rotations: Vec<Mat3> = vectors.iter().map(|vector| base.rotation * from_vector(vector)).collect();
        let tangents: Vec<Vec3> = rotations.iter().map(|rotation| rotation.column(2) * piece.length).collect();
        let positions = layout.gauss.until.iter().map(|row| base.position + sum(row, &tangents));
        shape.positions.extend(positions);
        base = Pose {
            position: base.position + sum(&layout.gauss.weights, &tangents),
            rotation: base.rotation * from_vector(&end),
        };
        shape.rotations.extend(rotations);
        shape.ends.push(base);
    }
    Some(shape)
}

/// The end of a piece of this length whose curvature at the nodes is given. `None` where it turns too far.
pub(super) fn advance(gauss: &super::gauss::Gauss, base: &Pose, length: f64, curvatures: &[Vec3]) -> Option<Pose> {
    let steps: Vec<Vec3> = curvatures.iter().map(|u| u * length).collect();
    let (vectors, end) = rotation_vectors(gauss, &steps)?;
    let tangents: Vec<Vec3> =
        vectors.iter().map(|vector| (base.rotation * from_vector(vector)).column(2) * length).collect();
    Some(Pose { position: base.position + sum(&gauss.weights, &tangents), rotation: base.rotation * from_vector(&end) })
}

/// Curvature at each node, in the frame of its cross section.
pub(super) fn curvatures(layout: &Layout, factors: &[f64]) -> Vec<Vec3> {
    let count = layout.gauss.count();
    let mut all = vec![Vec3::zeros(); count * layout.pieces.len()];
    for (mode, factor) in layout.modes.iter().zip(factors) {
        let nodes = all[mode.pieces.start * count..mode.pieces.end * count].iter_mut();
        nodes.zip(&mode.values).for_each(|(u, value)| u[mode.axis] += factor * value);
    }
    all
}

/// Ω at each node and at the end, of the curvature times the piece's length.
fn rotation_vectors(gauss: &super::gauss::Gauss, steps: &[Vec3]) -> Option<(Vec<Vec3>, Vec3)> {
    let mut slopes = steps.to_vec();
    let mut vectors = vec![Vec3::zeros(); steps.len()];
    for _ in 0..SWEEPS {
        let mut change = 0.0f64;
        for (vector, row) in vectors.iter_mut().zip(&gauss.until) {
            let next = sum(row, &slopes);
            change = change.max((next - *vector).amax());
            *vector = next;
        }
        for ((slope, vector), v) in slopes.iter_mut().zip(&vectors).zip(steps) {
            let across = vector.cross(v);
            *slope = v + across * 0.5 + vector.cross(&across) * twice(vector.norm());
        }
        if change.is_nan() {
            return None;
        }
        let size = vectors.iter().map(Vec3::amax).fold(1.0, f64::max);
        if change <= ROUNDING * size {
            let end = sum(&gauss.weights, &slopes);
            return Some((vectors, end));
        }
    }
    None
}

/// c(x) = (1 − (x/2) cot(x/2))/x², the factor of the double product; 1/12 at zero.
fn twice(x: f64) -> f64 {
    let half = Angle::new(0.5 * x);
    if x == 0.0 { 1.0 / 12.0 } else { half.sinc_drop() / (4.0 * half.sine()) }
}

pub(super) fn sum(weights: &[f64], values: &[Vec3]) -> Vec3 {
    weights.iter().zip(values).fold(Vec3::zeros(), |sum, (weight, value)| sum + value * *weight)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factor_of_the_double_product_is_exact() {
        // (1 − (x/2) cot(x/2))/x² with 30 digits.
        for (x, exact) in [
            (0.0, 0.083_333_333_333_333_33),
            (1e-9, 0.083_333_333_333_333_33),
            (1e-3, 0.083_333_334_722_222_26),
            (0.5, 0.083_682_635_354_059_89),
            (1.0, 0.084_756_139_143_774_04),
            (3.0, 0.099_291_970_394_002_37),
            (6.0, 0.612_382_157_063_988_9),
        ] {
            assert!((twice(x) - exact).abs() < 1e-15 * exact.max(0.1) * 4.0, "{x}: {} {exact}", twice(x));
        }
    }

    #[test]
    fn the_exponential_is_a_rotation_about_its_vector() {
        let vector = Vec3::new(0.3, -1.2, 0.7);
        let rotation = from_vector(&vector);
        assert!((rotation * rotation.transpose() - Mat3::identity()).amax() < 4e-16);
        assert!((rotation * vector - vector).amax() < 4e-16);
        assert!((rotation.trace() - 1.0 - 2.0 * libm::cos(vector.norm())).abs() < 1e-15);
    }
}
