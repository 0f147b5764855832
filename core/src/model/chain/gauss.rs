//! Gauss nodes on a piece of the backbone, and the integral from the piece's start to each of them.

use crate::model::Vec3;
use crate::model::contact::ritz::{gauss, integrals, recurrence};

/// Nodes ξ in [−1, 1]; integrals are over the piece's share in [0, 1].
#[derive(Debug, Clone)]
pub(super) struct Gauss {
    /// How many terms of curvature the nodes are meant for.
    pub modes: usize,
    /// They add up to 1.
    pub weights: Vec<f64>,
    /// Legendre polynomials at each node, the first `modes` + 1.
    pub legendre: Vec<Vec<f64>>,
    /// Row q holds the weights of the integral from the start to node q, exact for what a polynomial through all nodes can hold.
    pub until: Vec<Vec<f64>>,
}

/// More nodes than modes: products of the rotation with the highest term are integrated as well.
const SPARE: usize = 4;

impl Gauss {
    /// For curvature with the Legendre terms 0 to `modes`.
    pub fn new(modes: usize) -> Self {
        let count = modes + 1 + SPARE;
        let (nodes, weights) = gauss(count);
        let rows = |xi: &f64| {
            let mut p = vec![0.0; count + 1];
            recurrence(*xi, &mut p);
            p
        };
        let legendre: Vec<Vec<f64>> = nodes.iter().map(rows).collect();
        let mut gauss = Self { modes, weights, legendre, until: Vec::new() };
        gauss.until = nodes.iter().map(|xi| gauss.until_point(*xi)).collect();
        gauss
    }

    /// The weights of the integral from the start to any ξ.
    pub fn until_point(&self, xi: f64) -> Vec<f64> {
        let mut p = vec![0.0; self.count() + 1];
        recurrence(xi, &mut p);
        let integrals = integrals(xi, &p);
        let row = self.legendre.iter().zip(&self.weights).map(|(at, weight)| {
            let terms = at.iter().zip(&integrals).enumerate();
            weight * terms.map(|(j, (p, whole))| (2.0 * j as f64 + 1.0) * p * whole).sum::<f64>()
        });
        row.collect()
    }

    /// Factors of the Legendre polynomials up to `terms` of what has these values at the nodes.
    pub fn series(&self, values: &[Vec3], terms: usize) -> Vec<Vec3> {
        let factor = |j: usize| {
            let each = values.iter().zip(&self.legendre).zip(&self.weights);
            each.fold(Vec3::zeros(), |sum, ((value, p), weight)| sum + value * (p[j] * weight)) * (2.0 * j as f64 + 1.0)
        };
        (0..=terms).map(factor).collect()
    }

    pub fn count(&self) -> usize {
        self.weights.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_to_each_node_are_exact_for_polynomials() {
        let gauss_ = Gauss::new(8);
        let share: Vec<f64> = gauss_.legendre.iter().map(|p| 0.5 * (p[1] + 1.0)).collect();
        for power in 0..gauss_.count() as u32 {
            let values: Vec<f64> = share.iter().map(|t| (0..power).fold(1.0, |x, _| x * t)).collect();
            for (row, t) in gauss_.until.iter().zip(&share) {
                let ours: f64 = row.iter().zip(&values).map(|(w, v)| w * v).sum();
                let exact = (0..=power).fold(1.0, |x, _| x * t) / f64::from(power + 1);
                assert!((ours - exact).abs() < 2e-15, "power {power}: {ours} {exact}");
            }
        }
    }
}
