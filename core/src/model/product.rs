//! Products of matrices that are the same to the last bit on every processor.
//!
//! nalgebra leaves products of large matrices, whose sizes are not known beforehand, to code that adds up in another order, and rounds less
//! often, where the processor can.

use nalgebra::{Dim, Matrix, Storage, StorageMut};

/// Adds `scale` times the product of two matrices.
///
/// # Panics
/// When their sizes do not go together.
pub(crate) fn add_product<R: Dim, K: Dim, C: Dim>(
    to: &mut Matrix<f64, R, C, impl StorageMut<f64, R, C>>,
    scale: f64,
    one: &Matrix<f64, R, K, impl Storage<f64, R, K>>,
    other: &Matrix<f64, K, C, impl Storage<f64, K, C>>,
) {
    for (mut to, other) in to.column_iter_mut().zip(other.column_iter()) {
        for (one, &by) in one.column_iter().zip(other.iter()) {
            to.axpy(scale * by, &one, 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    #[test]
    fn it_is_the_product() {
        let [one, other] = [(7, 9), (9, 8)]
            .map(|(rows, columns)| DMatrix::from_fn(rows, columns, |i, j| libm::sin((3 * i + 5 * j) as f64)));
        let mut product = DMatrix::zeros(7, 8);
        add_product(&mut product, 2.0, &one, &other);
        assert!((product - 2.0 * one * other).amax() < 1e-14);
    }
}
