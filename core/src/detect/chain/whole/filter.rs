//! The Kalman filter of the calibration of a whole chain: the same as that of a segment, with as many errors as the chain has.

use super::Model;
use super::linear::{Linear, Moment, Own, Wide};
use crate::detect::calibration::Six;
use crate::detect::calibration::filter::Signature;
use crate::model::product::add_product;
use libm::{exp, log, sqrt};
use nalgebra::{Const, DMatrix, DVector, Dyn, OMatrix, SMatrix, U6};

/// One reading's worth of filter.
#[derive(Debug, Clone)]
pub struct Stage {
    /// L⁻¹, where L Lᵀ is the covariance of what is left of the residual.
    pub whitener: SMatrix<f64, 6, 6>,
    /// L⁻¹ H.
    pub seen: Wide,
    /// What an innovation adds to the errors.
    pub gain: OMatrix<f64, Dyn, U6>,
    /// What is left of the last reading's drift, and where that begins among the errors.
    kept: (f64, usize),
    /// ρ.
    pub colour: f64,
}

/// Readings that are so many times further apart than others do not follow one another.
const GAP: f64 = 1.5;
/// Bends wander by their measure in this time, s.
const WHILE: f64 = 1.0;

/// Makes stages, one reading after the other.
#[derive(Debug, Clone)]
pub struct Designer {
    model: Model,
    wander: f64,
    deviations: DVector<f64>,
    covariance: DMatrix<f64>,
    last: Option<(f64, Wide)>,
    interval: f64,
}

impl Designer {
    /// Before the first reading. Bends wander by `wander` of their freedom in a second.
    pub fn new(model: &Model, wander: f64) -> Self {
        let mut covariance = DMatrix::identity(model.states(), model.states());
        for segment in 0..model.lengths.len() {
            // What it is before the first reading, the offset of the bend says.
            covariance[(Own::Play.of(segment), Own::Play.of(segment))] = 0.0;
        }
        let (deviations, interval) = (model.deviations(), f64::INFINITY);
        Self { model: model.clone(), wander, deviations, covariance, last: None, interval }
    }

    /// The stage of the next reading.
    pub fn next(&mut self, moment: &Moment, linear: &Linear) -> Stage {
        let Self { model, wander, deviations, covariance, last, interval } = self;
        let noise = model.noise;
        let mut scaled = linear.by_error.clone();
        for (mut column, deviation) in scaled.column_iter_mut().zip(deviations.iter()) {
            column *= *deviation;
        }
        let since = last.as_ref().map(|(before, _)| moment.time - before);
        *interval = since.unwrap_or(f64::INFINITY).min(*interval);
        let (colour, white) = match since {
            Some(since) if since < GAP * *interval => (noise.colour, 1.0 - noise.colour * noise.colour),
            _ => (0.0, 1.0),
        };
        let mut columns = scaled.clone();
        if let Some((_, before)) = last
            && colour > 0.0
        {
            columns -= &*before * colour;
        }
        for segment in 0..model.lengths.len() {
            let play = Own::Play.of(segment);
            covariance[(play, play)] += moment.taken_up[segment] + *wander * *wander * since.unwrap_or(0.0) / WHILE;
        }
        let drift = model.drift();
        let kept = match (since, model.beliefs.first()) {
            (Some(since), Some(belief)) if deviations.rows(drift, 3).amax() > 0.0 => exp(-since / belief.drift_time),
            _ => 1.0,
        };
        if kept < 1.0 {
            for i in drift..drift + 3 {
                covariance.row_mut(i).scale_mut(kept);
                covariance.column_mut(i).scale_mut(kept);
                covariance[(i, i)] += 1.0 - kept * kept;
            }
        }
        let (place, turn) = (white * noise.position * noise.position, white * noise.orientation * noise.orientation);
        let mut across = OMatrix::<f64, Dyn, U6>::zeros(covariance.nrows());
        add_product(&mut across, 1.0, covariance, &columns.transpose());
        let mut spread = SMatrix::<f64, 6, 6>::zeros();
        add_product(&mut spread, 1.0, &columns, &across);
        for (i, variance) in [turn, place, place, place, turn, turn].into_iter().enumerate() {
            spread[(i, i)] += variance;
        }
        let lower = spread.cholesky().map_or_else(SMatrix::<f64, 6, 6>::identity, |cholesky| cholesky.unpack());
        let mut whitener = SMatrix::<f64, 6, 6>::identity();
        // A lower triangle with a positive diagonal has an inverse.
        let _ = lower.solve_lower_triangular_mut(&mut whitener);
        let mut seen = Wide::zeros(columns.ncols());
        add_product(&mut seen, 1.0, &whitener, &columns);
        let mut gain = OMatrix::<f64, Dyn, U6>::zeros(covariance.nrows());
        add_product(&mut gain, 1.0, &across, &whitener.transpose());
        add_product(covariance, -1.0, &gain, &gain.transpose());
        *last = Some((moment.time, scaled));
        Stage { whitener, seen, gain, kept: (kept, drift), colour }
    }

    /// Standard deviations of the errors after the last reading, in units of their prior ones.
    pub fn deviations(&self) -> DVector<f64> {
        self.covariance.diagonal().map(|variance| sqrt(variance.max(0.0)))
    }
}

impl Stage {
    /// Logarithm of the probability density of an innovation's reading, but for a constant.
    pub fn likelihood(&self, innovation: &Six) -> f64 {
        self.whitener.diagonal().iter().map(|scale| log(*scale)).sum::<f64>() - 0.5 * innovation.norm_squared()
    }
}

/// What the filter knows.
#[derive(Debug, Clone)]
pub struct Filter {
    /// The errors, in units of their prior standard deviations.
    pub states: DVector<f64>,
    last: Six,
}

impl Filter {
    /// Nothing.
    pub fn new(model: &Model) -> Self {
        Self { states: DVector::zeros(model.states()), last: Six::zeros() }
    }

    /// Takes the next residual and returns its innovation.
    pub fn step(&mut self, stage: &Stage, residual: &Six) -> Six {
        let fresh = residual - self.last * stage.colour;
        self.last = *residual;
        let (kept, drift) = stage.kept;
        if kept < 1.0 {
            self.states.rows_mut(drift, 3).scale_mut(kept);
        }
        let innovation: Six = stage.whitener * fresh - &stage.seen * &self.states;
        self.states += &stage.gain * innovation;
        innovation
    }
}

/// Signatures on their way through the filter.
#[derive(Debug, Clone)]
pub struct Responses<const N: usize> {
    states: OMatrix<f64, Dyn, Const<N>>,
    last: Signature<N>,
}

impl<const N: usize> Responses<N> {
    /// Before the first of them, of so many errors.
    pub fn new(states: usize) -> Self {
        Self { states: OMatrix::<f64, Dyn, Const<N>>::zeros(states), last: Signature::zeros() }
    }

    /// What a signature adds to the innovation of a reading.
    pub fn step(&mut self, stage: &Stage, off: &Signature<N>) -> Signature<N> {
        let fresh = off - self.last * stage.colour;
        self.last = *off;
        let (kept, drift) = stage.kept;
        if kept < 1.0 {
            self.states.rows_mut(drift, 3).scale_mut(kept);
        }
        let mut seen = stage.whitener * fresh;
        add_product(&mut seen, -1.0, &stage.seen, &self.states);
        add_product(&mut self.states, 1.0, &stage.gain, &seen);
        seen
    }
}
