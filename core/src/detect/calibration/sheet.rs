//! What is heard of planes that began at one instant, at every place and with every tilt at once.
//!
//! A plane's tilt is the angle of its normal about the backbone's tangent, from the bending plane. A signature is a polynomial in the place and a
//! trigonometric one in the tilt, of which a half turn changes nothing: so what was heard is gathered once, and then known for all. A plane's force
//! goes with how soft the chain is along its normal; what is left without that has hardly more than one wave over half a turn.

use super::Six;
use super::filter::Signature;
use super::likelihood::{Began, Grid, Row};
use super::signature::PLACES;
use libm::{cos, sin};
use nalgebra::{SMatrix, SVector};
use std::cell::OnceCell;
use std::f64::consts::PI;

/// Tilts at which signatures are made.
pub const TILTS: usize = 7;
/// Signatures at all tilts and places: those of the first tilt first.
pub const WIDE: usize = TILTS * PLACES;

/// Tilts of a coarse look, and how often its step is halved in the search for the likeliest.
const LOOK: usize = 12;
const HALVED: u32 = 9;

/// The tilts, rad: evenly over half a turn from the first on.
#[must_use]
pub fn tilts(first: f64) -> [f64; TILTS] {
    std::array::from_fn(|i| first + PI * i as f64 / TILTS as f64)
}

/// What each of the tilts counts in the signature of a plane at another one (rad).
fn tilted(first: f64, tilt: f64) -> [f64; TILTS] {
    tilts(first).map(|at| {
        let off = tilt - at;
        let (many, one) = (sin(TILTS as f64 * off), sin(off));
        // At a node, and a half turn from it.
        if one.abs() < 1e-9 { 1.0 } else { many / (TILTS as f64 * one) }
    })
}

/// How soft the chain is at each place along a normal of any tilt: its mean, and factors of the cosine and the sine of twice the tilt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Softness {
    /// The first of the tilts, rad.
    first: f64,
    by_place: [[f64; 3]; PLACES],
}

impl Softness {
    /// From that at all places and tilts, in any unit; `first` is the first of the tilts, rad.
    #[must_use]
    pub fn of(first: f64, all: &[[f64; TILTS]; PLACES]) -> Self {
        let by_place = all.map(|by_tilt| {
            let sum =
                |of: fn(f64) -> f64| by_tilt.iter().zip(tilts(first)).map(|(soft, tilt)| soft * of(tilt)).sum::<f64>();
            let count = TILTS as f64;
            [sum(|_| 1.0) / count, 2.0 * sum(|tilt| cos(2.0 * tilt)) / count, 2.0 * sum(|tilt| sin(2.0 * tilt)) / count]
        });
        Self { first, by_place }
    }

    /// The same everywhere.
    #[must_use]
    pub fn even() -> Self {
        Self { first: 0.0, by_place: [[1.0, 0.0, 0.0]; PLACES] }
    }

    fn at(&self, place: usize, tilt: f64) -> f64 {
        let [mean, cosine, sine] = self.by_place[place];
        let soft = mean + cosine * cos(2.0 * tilt) + sine * sin(2.0 * tilt);
        // A chain is nowhere rigid.
        soft.max(1e-3 * mean)
    }

    /// What each of the tilts counts at another one (rad) in the signature at each place.
    #[must_use]
    pub fn tilted(&self, tilt: f64) -> [[f64; PLACES]; TILTS] {
        let (weights, nodes) = (tilted(self.first, tilt), tilts(self.first));
        std::array::from_fn(|i| {
            std::array::from_fn(|place| weights[i] * self.at(place, nodes[i]) / self.at(place, tilt))
        })
    }
}

/// Sums over readings of what was heard of `N` signatures.
#[derive(Debug, Clone)]
pub struct Sums<const N: usize> {
    /// Signatures times innovations.
    pub linear: SVector<f64, N>,
    /// Signatures times each other.
    pub square: SMatrix<f64, N, N>,
}

impl<const N: usize> Default for Sums<N> {
    fn default() -> Self {
        Self { linear: SVector::zeros(), square: SMatrix::zeros() }
    }
}

impl<const N: usize> Sums<N> {
    /// Adds an innovation, and what the signatures add to it.
    pub fn add(&mut self, seen: &Signature<N>, innovation: &Six) {
        self.linear.gemv_tr(1.0, seen, innovation, 1.0);
        // Half of it: the other is the same.
        for (i, column) in seen.column_iter().enumerate() {
            let column: Six = column.into_owned();
            for (j, other) in seen.column_iter().enumerate().take(i + 1) {
                self.square[(j, i)] += column.dot(&other);
            }
        }
    }

    /// The same once everything was added.
    #[must_use]
    pub fn whole(mut self) -> Self {
        for i in 0..N {
            for j in 0..i {
                self.square[(i, j)] = self.square[(j, i)];
            }
        }
        self
    }
}

impl<const N: usize> Sums<N> {
    /// As if everything heard told so many times less than it seems to.
    #[must_use]
    pub fn doubted(mut self, times: f64) -> Self {
        if times > 1.0 {
            self.linear /= times;
            self.square /= times;
        }
        self
    }
}

impl Sums<PLACES> {
    /// As contacts that began at an instant (in readings).
    #[must_use]
    pub fn row(&self, began: f64) -> Row {
        let square = std::array::from_fn(|i| std::array::from_fn(|j| self.square[(i, j)]));
        Row::heard(began, std::array::from_fn(|i| self.linear[i]), square)
    }
}

/// Planes that began at one instant.
#[derive(Debug, Clone)]
pub struct Sheet {
    began: f64,
    heard: Sums<WIDE>,
    softness: Softness,
    likeliest: OnceCell<(f64, Row, f64)>,
}

impl Sheet {
    /// Of what was heard of planes that began at an instant (in readings).
    #[must_use]
    pub fn new(began: f64, heard: Sums<WIDE>, softness: Softness) -> Self {
        Self { began, heard, softness, likeliest: OnceCell::new() }
    }

    /// Those of one tilt (rad).
    #[must_use]
    pub fn at(&self, tilt: f64) -> Row {
        let weights = self.softness.tilted(tilt);
        let (mut linear, mut square) = ([0.0; PLACES], [[0.0; PLACES]; PLACES]);
        for (a, by) in weights.iter().enumerate() {
            for (i, linear) in linear.iter_mut().enumerate() {
                *linear += by[i] * self.heard.linear[a * PLACES + i];
            }
            for (b, and) in weights.iter().enumerate() {
                for (i, row) in square.iter_mut().enumerate() {
                    for (j, square) in row.iter_mut().enumerate() {
                        *square += by[i] * and[j] * self.heard.square[(a * PLACES + i, b * PLACES + j)];
                    }
                }
            }
        }
        Row::heard(self.began, linear, square)
    }

    /// The likeliest tilt (rad), planes of that, and their largest ratio near a grid, which is the same each time: the largest of some tilts,
    /// and then beside it. A beginning must not be judged by a tilt that is not its own.
    #[must_use]
    pub fn likeliest(&self, grid: &Grid) -> &(f64, Row, f64) {
        self.likeliest.get_or_init(|| self.search(grid))
    }

    fn search(&self, grid: &Grid) -> (f64, Row, f64) {
        let of = |tilt: f64| {
            let row = self.at(tilt);
            let most = row.most(grid);
            (tilt, row, most)
        };
        let looks = (1..LOOK).map(|i| of(PI * i as f64 / LOOK as f64));
        let mut best = looks.fold(of(0.0), |best, other| if other.2 > best.2 { other } else { best });
        let mut step = PI / LOOK as f64;
        for _ in 0..HALVED {
            step *= 0.5;
            for beside in [of(best.0 - step), of(best.0 + step)] {
                if beside.2 > best.2 {
                    best = beside;
                }
            }
        }
        best
    }
}

impl Began for Sheet {
    fn began(&self) -> f64 {
        self.began
    }

    fn ratios(&self, grid: &Grid) -> Vec<f64> {
        self.likeliest(grid).1.ratios(grid)
    }

    fn largest(&self, grid: &Grid) -> f64 {
        self.likeliest(grid).2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_tilts_reproduce_what_turns_twice_and_four_times() {
        for tilt in [0.0, 0.3, 1.2, PI / 5.0, PI, -0.7] {
            let weights = tilted(0.2, tilt);
            for (name, of) in [("1", 0.0), ("cos 2α", 2.0), ("cos 4α", 4.0)] {
                let between: f64 = tilts(0.2).iter().zip(weights).map(|(at, by)| cos(of * at) * by).sum();
                assert!((between - cos(of * tilt)).abs() < 1e-12, "{name} at {tilt}: {between}");
            }
            let between: f64 = tilts(0.2).iter().zip(weights).map(|(at, by)| sin(2.0 * at) * by).sum();
            assert!((between - sin(2.0 * tilt)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_tilt_is_heard_as_if_it_had_been_tried_alone() {
        let signature = Signature::<WIDE>::from_fn(|i, j| sin(1.0 + (7 * i + j) as f64));
        let innovation = Six::from_fn(|i, _| cos(i as f64));
        let mut sums = Sums::default();
        sums.add(&signature, &innovation);
        let (sheet, weights) = (Sheet::new(3.0, sums.whole(), Softness::even()), tilted(0.0, 0.4));
        let alone = Signature::<PLACES>::from_fn(|i, j| {
            weights.iter().enumerate().map(|(a, by)| by * signature[(i, a * PLACES + j)]).sum()
        });
        let mut sums = Sums::default();
        sums.add(&alone, &innovation);
        let grid = Grid::coarse(super::super::likelihood::Base::Moves);
        for (ours, exact) in sheet.at(0.4).along(&grid).zip(sums.whole().row(3.0).along(&grid)) {
            assert!((ours - exact).abs() < 1e-9 * exact.abs().max(1.0), "{ours} {exact}");
        }
    }
}
