//! The log likelihood ratio of contacts that began at one instant, at every place at once.
//!
//! A signature is a polynomial in the place, so that its ratio is a quadratic form of the polynomial's weights: it is gathered once, and
//! then known at every place to the last digit.

use super::Six;
use super::filter::{Responses, Stage};
use super::signature::{PLACES, Shapes, free_weights, weights};

/// Spacing of the posterior's grid, as a share of L: 0.1 mm on the paper's segment.
pub const GRID: f64 = 1.0 / 300.0;

/// So often a step is halved in the search for the largest ratio.
const HALVED: u32 = 8;

/// Places along the backbone, and the weights of each.
#[derive(Debug, Clone)]
pub struct Grid {
    places: Vec<f64>,
    weights: Vec<[f64; PLACES]>,
    spacing: f64,
    base: Base,
}

/// What a contact at the base of a segment changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// Nothing: it stays.
    Stays,
    /// As much as any: it moves.
    Moves,
}

impl Base {
    fn weights(self, place: f64) -> [f64; PLACES] {
        match self {
            Self::Stays => weights(place),
            Self::Moves => free_weights(place),
        }
    }
}

impl Grid {
    /// Those of a posterior.
    #[must_use]
    pub fn fine(base: Base) -> Self {
        Self::every(1, base)
    }

    /// Fewer of them: enough to see how large a ratio is anywhere.
    #[must_use]
    pub fn coarse(base: Base) -> Self {
        Self::every(10, base)
    }

    /// `count` of them in the middle of as many equal parts from a place to another (in units of L).
    #[must_use]
    pub fn between(&self, ends: [f64; 2], count: u32) -> Self {
        let spacing = (ends[1] - ends[0]) / f64::from(count);
        Self::of((0..count).map(|i| ends[0] + (f64::from(i) + 0.5) * spacing).collect(), spacing, self.base)
    }

    fn every(step: u32, base: Base) -> Self {
        let places = (step..).step_by(step as usize).map(|i| f64::from(i) * GRID);
        Self::of(places.take_while(|place| *place < 1.0 - 0.5 * GRID).collect(), f64::from(step) * GRID, base)
    }

    fn of(places: Vec<f64>, spacing: f64, base: Base) -> Self {
        let weights = places.iter().map(|place| base.weights(*place)).collect();
        Self { places, weights, spacing, base }
    }

    /// From one place to the next, in units of L.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The places, in units of L.
    #[must_use]
    pub fn places(&self) -> &[f64] {
        &self.places
    }
}

/// Contacts that began at one instant.
#[derive(Debug, Clone)]
pub struct Row {
    /// When, in readings.
    pub began: f64,
    /// Signatures times innovations.
    linear: [f64; PLACES],
    /// Signatures times each other.
    square: [[f64; PLACES]; PLACES],
}

impl Row {
    /// Contacts that began at a reading and some of the way to the next, while the bend changed to the side `side`. `bends` (rad) are
    /// those of the readings, of which `stage` gives the filter.
    pub fn new<'s>(
        shapes: &Shapes,
        stage: impl Fn(usize) -> &'s Stage,
        innovations: &[Six],
        bends: &[f64],
        (whole, part): (usize, f64),
        side: f64,
    ) -> Self {
        let mut row = Self::silent((whole, part));
        let next = bends.get(whole + 1).copied().unwrap_or(bends[whole]);
        let met = shapes.met(bends[whole] + part * (next - bends[whole]));
        let mut responses = Responses::default();
        for k in whole + 1..innovations.len() {
            let holds = side * (bends[k] - met.bend()) > 0.0;
            let off = if holds { met.off(bends[k]) } else { [[0.0; PLACES]; 2] };
            row.add(&responses.step(stage(k), &off), &innovations[k]);
        }
        row
    }

    /// Nothing heard of contacts that began at a reading and some of the way to the next.
    fn silent((whole, part): (usize, f64)) -> Self {
        Self { began: whole as f64 + part, linear: [0.0; PLACES], square: [[0.0; PLACES]; PLACES] }
    }

    /// As if everything heard told only this share of what it seems to.
    #[must_use]
    pub fn told(&self, share: f64) -> Self {
        let linear = self.linear.map(|value| value * share);
        Self { began: self.began, linear, square: self.square.map(|row| row.map(|value| value * share)) }
    }

    /// Contacts of which signatures times innovations, and times each other, are known. `began` is in readings.
    #[must_use]
    pub fn heard(began: f64, linear: [f64; PLACES], square: [[f64; PLACES]; PLACES]) -> Self {
        Self { began, linear, square }
    }

    #[inline]
    fn add(&mut self, seen: &[[f64; PLACES]; 3], innovation: &Six) {
        for (axis, seen) in seen.iter().enumerate() {
            for (i, one) in seen.iter().enumerate() {
                self.linear[i] += one * innovation[axis];
                for (square, other) in self.square[i].iter_mut().zip(seen) {
                    *square += one * other;
                }
            }
        }
    }

    fn at(&self, weights: &[f64; PLACES]) -> f64 {
        let dot = |a: &[f64; PLACES]| a.iter().zip(weights).map(|(a, weight)| a * weight).sum::<f64>();
        dot(&self.linear) - 0.5 * self.square.iter().zip(weights).map(|(row, weight)| weight * dot(row)).sum::<f64>()
    }

    /// The ratio (natural logarithm) at each place of a grid.
    pub fn along<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = f64> + 'a {
        grid.weights.iter().map(|weights| self.at(weights))
    }

    /// The largest ratio: the largest on a grid, and then beside it, for it may be narrower than the grid is dense.
    #[must_use]
    pub fn most(&self, grid: &Grid) -> f64 {
        let on = self.along(grid).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((at, mut most)) = on else { return f64::NEG_INFINITY };
        let (mut place, mut step) = (grid.places[at], grid.spacing);
        for _ in 0..HALVED {
            step *= 0.5;
            for beside in [place - step, place + step] {
                let here = self.at(&grid.base.weights(beside));
                if here > most && (0.0..1.0).contains(&beside) {
                    (place, most) = (beside, here);
                }
            }
        }
        most
    }
}

/// Contacts that began at one instant, whatever else is not known of them.
pub trait Began {
    /// When, in readings.
    fn began(&self) -> f64;
    /// The ratio (natural logarithm) at each place of a grid, of the likeliest of what else is not known.
    fn ratios(&self, grid: &Grid) -> Vec<f64>;
    /// The largest ratio at any place near those of a grid.
    fn largest(&self, grid: &Grid) -> f64;
}

impl Began for Row {
    fn began(&self) -> f64 {
        self.began
    }

    fn ratios(&self, grid: &Grid) -> Vec<f64> {
        self.along(grid).collect()
    }

    fn largest(&self, grid: &Grid) -> f64 {
        self.most(grid)
    }
}

/// Places that count for less than this, as a logarithm, need no fine sum.
const SLIGHT: f64 = 8.0;
/// A sum over beginnings is exact to 10⁻⁴ where the logarithm bends by no more than this from one to the next.
const SMOOTH: f64 = 2.0;

/// Into how many parts the time from one reading to the next must be divided for a sum over beginnings to be as good as an integral.
/// `None` where these rows, of one reading after the other, do not tell. `best` is the largest of their ratios.
#[must_use]
pub fn parts<R: Began>(rows: &[&R], grid: &Grid, best: f64) -> Option<u32> {
    let values: Vec<Vec<f64>> = rows.iter().map(|row| row.ratios(grid)).collect();
    let mut most = None;
    for three in values.windows(3) {
        for ((before, here), after) in three[0].iter().zip(&three[1]).zip(&three[2]) {
            if *here > best - SLIGHT {
                most = Some((2.0 * here - before - after).max(most.unwrap_or(0.0)));
            }
        }
    }
    most.map(|bend| libm::sqrt(bend / SMOOTH).ceil() as u32)
}
