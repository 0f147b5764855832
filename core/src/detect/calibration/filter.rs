//! The Kalman filter of the calibration: gains that depend on no reading, and the few numbers that do.

use super::linear::Linear;
use super::{Belief, Columns, DRIFT, Noise, STATES, Six, States};
use libm::exp;
use nalgebra::SMatrix;

/// Covariance of the errors, in units of their prior deviations.
pub type Square = SMatrix<f64, STATES, STATES>;

/// One reading's worth of filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// L⁻¹, where L Lᵀ is the covariance of what is left of the residual.
    pub whitener: SMatrix<f64, 6, 6>,
    /// L⁻¹ H: what the errors add to an innovation.
    pub seen: Columns,
    /// What an innovation adds to the errors.
    pub gain: SMatrix<f64, STATES, 6>,
    /// What is left of the last reading's drift.
    pub kept: f64,
    /// ρ: how much of the last residual is in this one.
    pub colour: f64,
    /// Whether the tracker is thought to drift.
    pub drifts: bool,
}

/// Readings that are so many times further apart than others do not follow one another.
const GAP: f64 = 1.5;

/// Makes stages, one reading after the other.
#[derive(Debug, Clone)]
pub struct Designer {
    belief: Belief,
    noise: Noise,
    covariance: Square,
    last: Option<(f64, Columns)>,
    /// The shortest time from one reading to the next so far, s.
    interval: f64,
}

impl Designer {
    /// Before the first reading.
    #[must_use]
    pub fn new(belief: &Belief, noise: Noise) -> Self {
        Self { belief: *belief, noise, covariance: Square::identity(), last: None, interval: f64::INFINITY }
    }

    /// Before a reading that follows no other, where so much is known of the errors.
    #[must_use]
    pub fn resumed(belief: &Belief, noise: Noise, covariance: Square) -> Self {
        Self { covariance, ..Self::new(belief, noise) }
    }

    /// The stage of the next reading, taken at `time` (s).
    #[must_use]
    pub fn next(&mut self, time: f64, linear: &Linear) -> Stage {
        let Self { belief, noise, covariance, last, interval } = self;
        let mut scaled = linear.by_error;
        for (mut column, deviation) in scaled.column_iter_mut().zip(belief.deviations) {
            column *= deviation;
        }
        let since = last.as_ref().map(|(before, _)| time - before);
        *interval = since.unwrap_or(f64::INFINITY).min(*interval);
        // Noise of first order becomes white in what is new of each residual; after a gap all of it is new.
        let (colour, white) = match since {
            Some(since) if since < GAP * *interval => (noise.colour, 1.0 - noise.colour * noise.colour),
            _ => (0.0, 1.0),
        };
        let mut columns = scaled;
        if let Some((_, before)) = last
            && colour > 0.0
        {
            columns -= *before * colour;
        }
        let kept = since.map_or(1.0, |since| kept(belief, since));
        if kept < 1.0 {
            for i in DRIFT..STATES {
                covariance.row_mut(i).scale_mut(kept);
                covariance.column_mut(i).scale_mut(kept);
                covariance[(i, i)] += 1.0 - kept * kept;
            }
        }
        let (place, turn) = (white * noise.position * noise.position, white * noise.orientation * noise.orientation);
        let free = belief.free_bend * belief.free_bend * (1.0 + colour * colour);
        let mut spread = linear.by_bend * linear.by_bend.transpose() * free;
        for (i, variance) in [turn, place, place, place, turn, turn].into_iter().enumerate() {
            spread[(i, i)] += variance;
        }
        let across: SMatrix<f64, STATES, 6> = *covariance * columns.transpose();
        spread += columns * across;
        let lower = spread.cholesky().map_or_else(SMatrix::<f64, 6, 6>::identity, |cholesky| cholesky.unpack());
        let mut whitener = SMatrix::<f64, 6, 6>::identity();
        // A lower triangle with a positive diagonal has an inverse.
        let _ = lower.solve_lower_triangular_mut(&mut whitener);
        let seen = whitener * columns;
        let gain = across * whitener.transpose();
        *covariance -= gain * gain.transpose();
        *last = Some((time, scaled));
        Stage { whitener, seen, gain, kept, colour, drifts: drifts(belief) }
    }

    /// Covariance of the errors after the last reading, in units of their prior deviations.
    #[must_use]
    pub fn covariance(&self) -> &Square {
        &self.covariance
    }
}

/// Whether the tracker is thought to drift.
pub(super) fn drifts(belief: &Belief) -> bool {
    belief.deviations[DRIFT..].iter().any(|deviation| *deviation != 0.0)
}

/// What is left of the drift after `interval` (s).
pub(super) fn kept(belief: &Belief, interval: f64) -> f64 {
    if drifts(belief) { exp(-interval / belief.drift_time) } else { 1.0 }
}

/// What the filter knows of one run, or of one signature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filter {
    /// Estimate of the errors, in units of their prior deviations.
    pub states: States,
    /// The last residual.
    last: Six,
}

impl Default for Filter {
    fn default() -> Self {
        Self { states: States::zeros(), last: Six::zeros() }
    }
}

impl Filter {
    /// Before a reading that follows no other, where the errors are estimated; of a drift nothing is.
    #[must_use]
    pub fn knowing(mut states: States) -> Self {
        states.rows_mut(DRIFT, STATES - DRIFT).fill(0.0);
        Self { states, last: Six::zeros() }
    }

    /// Takes the next residual and returns its innovation.
    #[inline]
    pub fn step(&mut self, stage: &Stage, residual: &Six) -> Six {
        let fresh = if stage.colour == 0.0 { *residual } else { residual - self.last * stage.colour };
        self.last = *residual;
        if stage.kept < 1.0 {
            self.states.rows_mut(DRIFT, STATES - DRIFT).scale_mut(stage.kept);
        }
        let innovation = stage.whitener * fresh - stage.seen * self.states;
        self.states += stage.gain * innovation;
        innovation
    }
}

/// Signatures at `N` places on their way through the filter: the same for what has no part out of the bending plane, at a third of the
/// price.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Responses<const N: usize> {
    states: [[f64; N]; STATES],
    last: [[f64; N]; 2],
}

impl<const N: usize> Default for Responses<N> {
    fn default() -> Self {
        Self { states: [[0.0; N]; STATES], last: [[0.0; N]; 2] }
    }
}

/// `to += by · from` at each place.
#[inline]
fn add<const N: usize>(to: &mut [f64; N], by: f64, from: &[f64; N]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += by * from;
    }
}

impl<const N: usize> Responses<N> {
    /// What offsets of the end disk in the bending plane (m), toward the bend and along the straight backbone, add to the innovation
    /// of a reading: to its part in the plane.
    #[inline]
    pub fn step(&mut self, stage: &Stage, off: &[[f64; N]; 2]) -> [[f64; N]; 3] {
        let mut seen = [[0.0; N]; 3];
        for (axis, (off, last)) in off.iter().zip(&mut self.last).enumerate() {
            let mut fresh = *off;
            add(&mut fresh, -stage.colour, last);
            *last = *off;
            for (row, seen) in seen.iter_mut().enumerate() {
                add(seen, stage.whitener[(row, 1 + axis)], &fresh);
            }
        }
        let states = if stage.drifts { STATES } else { DRIFT };
        if stage.kept < 1.0 {
            self.states[DRIFT..].as_flattened_mut().iter_mut().for_each(|state| *state *= stage.kept);
        }
        let (columns, gains) = (stage.seen.as_slice(), stage.gain.as_slice());
        for (state, column) in self.states[..states].iter().zip(columns.chunks_exact(6)) {
            for (seen, by) in seen.iter_mut().zip(column) {
                add(seen, -by, state);
            }
        }
        for (seen, gain) in seen.iter().zip(gains.chunks_exact(STATES)) {
            for (state, gain) in self.states[..states].iter_mut().zip(gain) {
                add(state, *gain, seen);
            }
        }
        seen
    }
}

/// What contacts at several places change in a reading: a residual in each column.
pub type Signature<const N: usize> = SMatrix<f64, 6, N>;

/// The same for signatures that may have parts out of the bending plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialResponses<const N: usize> {
    states: SMatrix<f64, STATES, N>,
    last: Signature<N>,
}

impl<const N: usize> Default for SpatialResponses<N> {
    fn default() -> Self {
        Self { states: SMatrix::zeros(), last: SMatrix::zeros() }
    }
}

impl<const N: usize> SpatialResponses<N> {
    /// What a signature adds to the innovation of a reading.
    pub fn step(&mut self, stage: &Stage, off: &Signature<N>) -> Signature<N> {
        let fresh = off - self.last * stage.colour;
        self.last = *off;
        if stage.kept < 1.0 {
            self.states.rows_mut(DRIFT, STATES - DRIFT).scale_mut(stage.kept);
        }
        let seen = stage.whitener * fresh - stage.seen * self.states;
        self.states += stage.gain * seen;
        seen
    }
}
