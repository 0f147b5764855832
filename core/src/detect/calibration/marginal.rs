//! Where a contact is and since when, with what the readings leave open.
//!
//! The likelihood of every place and beginning, with the errors of the calibration integrated out, for each kind of contact. The model is
//! made linear at the errors estimated before the contact, and signatures follow the bend that the tracker measures: an interval
//! that leaves either out is too narrow.

use super::course::{Model, Moment, residual};
use super::filter::{Designer, Filter, Response, Stage};
use super::linear::{self, Linear};
use super::signature::{PLACES, SPACING, Shapes};
use super::spline::Spline;
use super::{Command, STATES, Six, States};
use crate::model::Pose;
use crate::scenario::Kind;
use libm::{exp, sqrt};

/// Beginnings are tried up to so many readings before the alarm.
const BEFORE: usize = 100;
/// Beginnings whose log likelihood is this much below the best are left out.
const NEGLIGIBLE: f64 = 16.0;
/// The calibration is estimated up to so many readings before the contact.
const CLEAR: usize = 2;
/// Steps of Gauss and Newton; the last is below [`SETTLED`] prior deviations.
const STEPS: usize = 4;
const SETTLED: f64 = 1e-4;

/// What has been read so far.
#[derive(Debug, Clone, Copy)]
pub struct History<'a> {
    /// The model of the robot and its tracker.
    pub model: &'a Model,
    /// The nominal moments of all readings.
    pub moments: &'a [Moment],
    /// Readings so far: at most as many as moments.
    pub readings: &'a [Pose],
}

/// What is known of a place: arc lengths, m.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Place {
    /// Mean of the posterior.
    pub mean: f64,
    /// Its largest value.
    pub mode: f64,
    /// With a probability of 95 % it is above this …
    pub low: f64,
    /// … and below this: 2.5 % on either side.
    pub high: f64,
}

/// Where a contact is, and what else the readings say of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The place.
    pub place: Place,
    /// Mean of the time at which it began, s.
    pub began: f64,
    /// Probability of each kind that was thought of.
    pub kinds: Vec<(Kind, f64)>,
    /// Errors of the calibration before the contact, in their own units, and their standard deviations.
    pub calibration: [[f64; STATES]; 2],
    /// Arc lengths (m), and the probability density (1/m) at each.
    pub posterior: Vec<[f64; 2]>,
    /// The largest log likelihood ratio against no contact.
    pub evidence: f64,
}

/// Spacing of the posterior's grid, as a share of L: 0.1 mm on the paper's segment.
const GRID: f64 = 1.0 / 300.0;

/// What is asked of the readings.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// The reading at which the alarm was raised.
    pub alarm: usize,
    /// The kinds of contact that are thought possible, each as likely as the others beforehand.
    pub kinds: &'a [Kind],
    /// Beginnings that are tried between one reading and the next.
    pub parts: u32,
}

/// Places the contact that an alarm told of, from all readings so far. `None` where nothing moved.
#[must_use]
pub fn estimate(history: &History, question: &Question) -> Option<Estimate> {
    let began = beginning(history, question.alarm)?;
    let calibrated = calibrate(history, began.saturating_sub(CLEAR), STEPS)?;
    placed(history, began, &calibrated, question)
}

/// The reading at which a contact most likely began, for the nominal model and clamps.
fn beginning(history: &History, alarm: usize) -> Option<usize> {
    let History { model, moments, readings } = history;
    let last = readings.len().min(moments.len()).checked_sub(1)?;
    let first = alarm.saturating_sub(BEFORE);
    let mut filter = Filter::default();
    let innovations: Vec<Six> =
        (0..=last).map(|k| filter.step(&moments[k].stage, &moments[k].residual(&readings[k]))).collect();
    let bends: Vec<f64> = moments[..=last].iter().map(|moment| moment.command.bend).collect();
    let stages = |k: usize| &moments[k].stage;
    let shapes = Shapes::clamps(model.length);
    let row = |began: usize| {
        let side = moments[began].command.rate;
        (side != 0.0).then(|| {
            let row = likelihoods(&shapes, stages, &innovations, &bends, began, bends[began], side.signum());
            (began, row.into_iter().fold(f64::NEG_INFINITY, f64::max))
        })
    };
    let rows = (first..last).filter_map(row);
    rows.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(began, _)| began)
}

/// Log likelihood ratios of contacts that began after the reading `began`, at the bend `met`, at each of the places.
fn likelihoods<'s>(
    shapes: &Shapes,
    stage: impl Fn(usize) -> &'s Stage,
    innovations: &[Six],
    bends: &[f64],
    began: usize,
    met: f64,
    side: f64,
) -> [f64; PLACES] {
    let (mut responses, mut sums) = ([Response::default(); PLACES], [0.0; PLACES]);
    let met = shapes.met(met);
    for k in began + 1..innovations.len() {
        let holds = side * (bends[k] - met.bend()) > 0.0;
        let offs = if holds { met.off(bends[k]) } else { [[0.0; 2]; PLACES] };
        let (stage, innovation) = (stage(k), &innovations[k]);
        for ((response, sum), off) in responses.iter_mut().zip(&mut sums).zip(offs) {
            let seen = response.step(stage, off);
            *sum += (0..3).map(|i| seen[i] * (innovation[i] - 0.5 * seen[i])).sum::<f64>();
        }
    }
    sums
}

/// Where the model is made linear.
struct Calibrated {
    /// In units of their prior deviations.
    states: States,
    deviations: States,
}

/// The innovations of all readings, by the model that is linear about the errors that they tell of themselves. By the nominal one they
/// keep what is of second order in the errors, and are not white even where everything is as it is thought to be.
#[must_use]
pub fn innovations(history: &History) -> Vec<Six> {
    let History { model, moments, readings } = history;
    let Some(calibrated) = calibrate(history, readings.len(), 1) else { return Vec::new() };
    let errors = linear::errors(&calibrated.states, &model.belief.deviations);
    about_errors(history, errors, moments.len()).innovations
}

/// Gauss and Newton on the readings up to `until`, in so many steps at most.
fn calibrate(history: &History, until: usize, steps: usize) -> Option<Calibrated> {
    let History { model, moments, readings } = history;
    let mut states = States::zeros();
    let mut deviations = States::zeros();
    for _ in 0..steps {
        let errors = linear::errors(&states, &model.belief.deviations);
        let mut designer = Designer::new(&model.belief, model.noise);
        let mut filter = Filter::default();
        for (moment, reading) in moments.iter().zip(*readings).take(until.saturating_add(1)) {
            let linear = Linear::at(model.length, &moment.command, &errors);
            let stage = designer.next(moment.command.time, &linear);
            let off = residual(&linear.pose, &linear.axes, reading);
            filter.step(&stage, &(off + linear.by_error * States::from(errors)));
        }
        let step = (filter.states - states).amax();
        states = filter.states;
        deviations = designer.covariance().diagonal().map(|variance| sqrt(variance.max(0.0)));
        if !step.is_finite() {
            return None;
        }
        if step < SETTLED {
            break;
        }
    }
    Some(Calibrated { states, deviations })
}

/// Readings by a model that is linear about some errors of the calibration.
struct About {
    stages: Vec<Stage>,
    innovations: Vec<Six>,
    /// The bend that the tracker measures, rad.
    bends: Vec<f64>,
}

/// The first `count` readings by the model that is linear about these errors.
fn about_errors(history: &History, mut errors: linear::Errors, count: usize) -> About {
    let History { model, moments, readings } = history;
    // Drift is no constant: about zero.
    errors[super::DRIFT..].fill(0.0);
    let mut designer = Designer::new(&model.belief, model.noise);
    let mut filter = Filter::default();
    let mut all = About { stages: Vec::new(), innovations: Vec::new(), bends: Vec::new() };
    for (moment, reading) in moments.iter().zip(*readings).take(count) {
        let linear = Linear::at(model.length, &moment.command, &errors);
        let stage = designer.next(moment.command.time, &linear);
        let off = residual(&linear.pose, &linear.axes, reading);
        all.innovations.push(filter.step(&stage, &(off + linear.by_error * States::from(errors))));
        all.bends.push(linear.bend + off[0]);
        all.stages.push(stage);
    }
    all
}

/// Beginnings that were tried, and the log likelihood ratios there.
struct Row {
    /// In readings.
    began: f64,
    spline: Spline<PLACES>,
}

fn placed(history: &History, began: usize, calibrated: &Calibrated, question: &Question) -> Option<Estimate> {
    let Question { alarm, kinds, parts } = *question;
    let History { model, moments, readings } = history;
    let last = readings.len().min(moments.len()).checked_sub(1)?;
    let errors = linear::errors(&calibrated.states, &model.belief.deviations);
    let About { stages, innovations, bends } = about_errors(history, errors, last + 1);
    let length = model.length * (1.0 + errors[6]);
    let first = alarm.saturating_sub(BEFORE);
    let moving = |k: usize| moments[k].command.rate != 0.0;
    let nearest: Vec<usize> = (first..last).filter(|&k| moving(k)).collect();
    let side = moments[began].command.rate.signum();
    let mut all = Vec::new();
    for &kind in kinds {
        let shapes = match kind {
            Kind::Clamp => Shapes::clamps(length),
            Kind::Plane => {
                let range = &bends[first..=last];
                Shapes::planes(length, range, side)
            }
        };
        let row = |began: f64| {
            let (whole, part) = (began as usize, began.fract());
            let met = bends[whole] + part * (bends[whole + 1] - bends[whole]);
            let sums = likelihoods(&shapes, |k| &stages[k], &innovations, &bends, whole, met, side);
            Row { began, spline: Spline::new(SPACING, sums) }
        };
        let mut rows: Vec<Row> = Vec::new();
        let mut best = f64::NEG_INFINITY;
        // Outward from the likeliest beginning, to where nothing is left.
        let start = nearest.partition_point(|&k| k < began);
        for ahead in [true, false] {
            let mut left = if ahead { &nearest[start..] } else { &nearest[..start] };
            while let Some((&next, rest)) = if ahead { left.split_first() } else { left.split_last() } {
                left = rest;
                let row = row(next as f64);
                let most = row.spline.most();
                best = best.max(most);
                rows.push(row);
                if most < best - NEGLIGIBLE {
                    break;
                }
            }
        }
        rows.retain(|row| row.spline.most() > best - NEGLIGIBLE);
        let parts = parts.max(1);
        let between: Vec<f64> =
            rows.iter().flat_map(|row| (1..parts).map(|part| row.began + f64::from(part) / f64::from(parts))).collect();
        rows.extend(between.into_iter().map(row));
        rows.sort_by(|a, b| a.began.total_cmp(&b.began));
        all.push((kind, rows));
    }
    let deviations = linear::errors(&calibrated.deviations, &model.belief.deviations);
    let moments: Vec<Command> = moments.iter().map(|moment| moment.command).collect();
    weigh(&all, length, &moments, [errors, deviations])
}

/// Adds the grid up.
fn weigh(
    all: &[(Kind, Vec<Row>)],
    length: f64,
    commands: &[Command],
    calibration: [[f64; STATES]; 2],
) -> Option<Estimate> {
    let places: Vec<f64> = (1..).map(|i| f64::from(i) * GRID).take_while(|place| *place < 1.0 - 0.5 * GRID).collect();
    let rows = || all.iter().flat_map(|(_, rows)| rows);
    let best = rows().map(|row| row.spline.most()).fold(f64::NEG_INFINITY, f64::max);
    if !best.is_finite() {
        return None;
    }
    let mut density = vec![0.0; places.len()];
    let (mut began, mut kinds) = (0.0, Vec::new());
    for (kind, rows) in all {
        let mut weight = 0.0;
        for row in rows {
            let (whole, part) = (row.began as usize, row.began.fract());
            let after = commands.get(whole + 1).map_or(commands[whole].time, |after| after.time);
            let at = commands[whole].time + part * (after - commands[whole].time);
            for (place, density) in places.iter().zip(&mut density) {
                let here = exp(row.spline.at(*place) - best);
                *density += here;
                weight += here;
                began += here * at;
            }
        }
        kinds.push((*kind, weight));
    }
    let total: f64 = density.iter().sum();
    if total == 0.0 {
        return None;
    }
    kinds.iter_mut().for_each(|(_, weight)| *weight /= total);
    let mean = places.iter().zip(&density).map(|(place, here)| place * here).sum::<f64>() / total;
    let mode = density.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i);
    let quantile = |share: f64| {
        let mut sum = 0.0;
        for (place, here) in places.iter().zip(&density) {
            if sum + here >= share * total {
                return place + ((share * total - sum) / here - 0.5) * GRID;
            }
            sum += here;
        }
        1.0
    };
    let place = Place {
        mean: mean * length,
        mode: places[mode] * length,
        low: quantile(0.025) * length,
        high: quantile(0.975) * length,
    };
    let posterior = places.iter().zip(&density).map(|(place, here)| [place * length, here / (total * GRID * length)]);
    Some(Estimate { place, began: began / total, kinds, calibration, posterior: posterior.collect(), evidence: best })
}
