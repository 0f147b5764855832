//! Curvature as a sum of Legendre polynomials, and the integrals of the tangent that follow.

use super::Planar;
use libm::{cos, sincos};
use std::f64::consts::PI;

/// Terms of the curvature below the contact. With [`NODES`], the tip is exact to 1e-15 L for bends to 90° and to 2e-10 L
/// for 180°.
pub const MODES: usize = 16;
/// Gauss nodes.
pub const NODES: usize = 18;

/// Legendre polynomials P_0 … at ξ.
#[must_use]
pub fn legendre(xi: f64) -> [f64; MODES] {
    let mut all = [0.0; MODES];
    recurrence(xi, &mut all);
    all
}

/// Fills in P_0 … at ξ, as many as there is room for.
pub(in crate::model) fn recurrence(xi: f64, all: &mut [f64]) {
    let (mut before, mut last) = (0.0, 1.0);
    for (j, p) in all.iter_mut().enumerate() {
        *p = last;
        let j = j as f64;
        (before, last) = (last, ((2.0 * j + 1.0) * xi * last - j * before) / (j + 1.0));
    }
}

/// The slope at ξ in [−1, 1] that each term of the curvature makes: half the integral of P_j from −1 to ξ.
fn slopes(xi: f64) -> [f64; MODES] {
    let mut p = [0.0; MODES + 1];
    recurrence(xi, &mut p);
    std::array::from_fn(|j| integral(xi, &p, j))
}

/// Half the integral of P_j from −1 to ξ, of the polynomials at ξ up to P_{j+1}.
fn integral(xi: f64, p: &[f64], j: usize) -> f64 {
    match j {
        0 => 0.5 * (xi + 1.0),
        j => (p[j + 1] - p[j - 1]) / (2.0 * (2.0 * j as f64 + 1.0)),
    }
}

/// The same of every polynomial but the last one given.
pub(in crate::model) fn integrals(xi: f64, p: &[f64]) -> Vec<f64> {
    (0..p.len() - 1).map(|j| integral(xi, p, j)).collect()
}

/// So many Gauss nodes on [−1, 1], and their weights, which add up to 1.
pub(in crate::model) fn gauss(count: usize) -> (Vec<f64>, Vec<f64>) {
    let n = count as f64;
    let mut p = vec![0.0; count + 1];
    let node = |k: usize| {
        // Newton from the usual start, which is so near that each finds its own root.
        let mut xi = -cos(PI * (k as f64 + 0.75) / (n + 0.5));
        let mut slope = 1.0;
        for _ in 0..8 {
            recurrence(xi, &mut p);
            slope = n * (xi * p[count] - p[count - 1]) / (xi * xi - 1.0);
            xi -= p[count] / slope;
        }
        (xi, 1.0 / ((1.0 - xi * xi) * slope * slope))
    };
    (0..count).map(node).unzip()
}

/// Gauss nodes on the part below the contact, and the slopes there.
#[derive(Debug, Clone, PartialEq)]
pub struct Basis {
    nodes: [f64; NODES],
    /// Their weights; they add up to 1.
    pub(super) weights: [f64; NODES],
    /// Slope at each node by each coefficient.
    pub(super) slopes: [[f64; MODES]; NODES],
}

impl Default for Basis {
    fn default() -> Self {
        Self::new()
    }
}

impl Basis {
    /// Finds nodes and weights.
    #[must_use]
    pub fn new() -> Self {
        let (all, weight) = gauss(NODES);
        let (mut nodes, mut weights) = ([0.0; NODES], [0.0; NODES]);
        nodes.copy_from_slice(&all);
        weights.copy_from_slice(&weight);
        Self { nodes, weights, slopes: nodes.map(slopes) }
    }

    /// Slope at each node, rad.
    pub(super) fn angles(&self, coefficients: &[f64; MODES]) -> [f64; NODES] {
        self.slopes.map(|row| dot(&row, coefficients))
    }

    /// Mean of the tangent over the first `share` (in (0, 1]) of the part below the contact, and the slope at its end (rad).
    pub(super) fn below(&self, coefficients: &[f64; MODES], share: f64) -> (Planar, f64) {
        let xi = |node: f64| (node + 1.0) * share - 1.0;
        let mut mean = Planar::zeros();
        for (node, weight) in self.nodes.iter().zip(&self.weights) {
            let (sin, cos) = sincos(dot(&slopes(xi(*node)), coefficients));
            mean += Planar::new(sin, cos) * *weight;
        }
        let slope = if share == 1.0 { coefficients[0] } else { dot(&slopes(xi(1.0)), coefficients) };
        (mean, slope)
    }

    /// Mean of the tangent over the whole part below the contact, and its derivative.
    pub(super) fn whole(&self, coefficients: &[f64; MODES], derivative: &[f64; MODES]) -> (Planar, Planar) {
        let (mut mean, mut by) = (Planar::zeros(), Planar::zeros());
        for (row, weight) in self.slopes.iter().zip(&self.weights) {
            let (sin, cos) = sincos(dot(row, coefficients));
            mean += Planar::new(sin, cos) * *weight;
            by += Planar::new(cos, -sin) * (*weight * dot(row, derivative));
        }
        (mean, by)
    }
}

pub(super) fn dot(a: &[f64; MODES], b: &[f64; MODES]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_integrates_what_it_should_exactly() {
        let basis = Basis::new();
        let mut powers = [1.0; NODES];
        for power in 0..2 * NODES as u32 {
            let sum: f64 = powers.iter().zip(&basis.weights).map(|(x, w)| w * x).sum();
            let exact = if power % 2 == 0 { 1.0 / f64::from(power + 1) } else { 0.0 };
            assert!((sum - exact).abs() < 1e-15, "power {power}: {sum} {exact}");
            powers.iter_mut().zip(&basis.nodes).for_each(|(x, node)| *x *= node);
        }
    }

    #[test]
    fn slopes_are_integrals_of_the_curvature() {
        for xi in [-0.9, -0.3, 0.0, 0.4, 0.95] {
            let (h, p) = (1e-5, legendre(xi));
            let (a, b) = (slopes(xi - h), slopes(xi + h));
            for j in 0..MODES {
                assert!(((b[j] - a[j]) / (2.0 * h) - 0.5 * p[j]).abs() < 1e-7, "P_{j} at {xi}");
            }
        }
        assert_eq!(slopes(-1.0).map(|slope| slope.abs() < 1e-16), [true; MODES]);
    }
}
