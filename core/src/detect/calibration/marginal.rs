//! Where a contact is and since when, with what the readings leave open.
//!
//! The likelihood of every place and beginning, with the errors of the calibration integrated out, for each kind of contact. The model is
//! made linear at the errors estimated before the contact, and signatures follow the bend that the tracker measures: an interval
//! that leaves either out is too narrow.

use super::course::{Model, Moment, residual};
use super::filter::{Designer, Filter, Stage};
use super::likelihood::{self, Base, Began, Grid, Row};
use super::linear::{self, Linear};
use super::signature::Shapes;
use super::{Command, STATES, Six, States};
use crate::model::Pose;
use crate::scenario::Kind;
use libm::{exp, sqrt};

/// Beginnings are tried at least from so many readings before the alarm on.
pub const BEFORE: usize = 100;
/// The likeliest beginning is first looked for at every so many of them.
const STRIDE: usize = 4;
/// Beginnings whose log likelihood is this much below the best are left out.
const NEGLIGIBLE: f64 = 16.0;
/// The calibration is estimated up to so many readings before a contact.
pub const CLEAR: usize = 2;
/// Steps of Gauss and Newton; each is about the square of the one before, so that what follows one below [`SETTLED`] prior deviations
/// counts for nothing.
const STEPS: usize = 4;
const SETTLED: f64 = 1e-3;

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
    /// Logarithm of the probability of the readings with a contact, over that without: every kind, place and beginning that was thought of
    /// as likely as the others.
    pub ratio: f64,
}

/// What is asked of the readings.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// The first reading that is tried as the beginning.
    pub first: usize,
    /// The kinds of contact that are thought possible, each as likely as the others beforehand.
    pub kinds: &'a [Kind],
    /// Beginnings that are tried between one reading and the next.
    pub parts: u32,
}

/// An error of the calibration is believed up to so many of its prior standard deviations.
pub const BELIEVED: f64 = 6.0;

/// Places the contact that an alarm told of, from all readings so far. `None` where nothing moved, and where the readings before the
/// contact tell of calibration errors far beyond those that were thought possible.
#[must_use]
pub fn estimate(history: &History, question: &Question) -> Option<Estimate> {
    let (innovations, before) = nominal(history);
    let began = beginning(history, &innovations, question)?;
    let calibrated = calibrate(history, began.saturating_sub(CLEAR), &before)?;
    placed(history, began, &calibrated, question)
}

/// Innovations of all readings by the nominal model, and the errors estimated after each.
pub(super) fn nominal(history: &History) -> (Vec<Six>, Vec<States>) {
    let mut filter = Filter::default();
    let step = |(moment, reading): (&Moment, &Pose)| {
        let innovation = filter.step(&moment.stage, &moment.residual(reading));
        (innovation, filter.states)
    };
    history.moments.iter().zip(history.readings).map(step).unzip()
}

/// The reading at which a contact most likely began, for the nominal model and clamps: every so many readings, then near the best.
fn beginning(history: &History, heard: &[Six], question: &Question) -> Option<usize> {
    let History { model, moments, .. } = history;
    let last = heard.len().checked_sub(1)?;
    let bends: Vec<f64> = moments[..=last].iter().map(|moment| moment.command.bend).collect();
    let shapes = Shapes::clamps(model.length);
    let grid = Grid::coarse(Base::Stays);
    let stages = |k: usize| &moments[k].stage;
    let most = |began: usize| {
        let side = moments[began].command.rate.signum();
        Row::new(&shapes, stages, heard, &bends, (began, 0.0), side).most(&grid)
    };
    let moving: Vec<usize> = (question.first..last).filter(|&began| moments[began].command.rate != 0.0).collect();
    likeliest(&moving, most)
}

/// Of some readings the one with the largest value: every so many of them, then near the best.
pub(super) fn likeliest(moving: &[usize], most: impl Fn(usize) -> f64) -> Option<usize> {
    let best = |tried: &mut dyn Iterator<Item = usize>| {
        tried.map(|at| (at, most(moving[at]))).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at)
    };
    let near = best(&mut (0..moving.len()).step_by(STRIDE))?;
    let around = near.saturating_sub(STRIDE - 1)..(near + STRIDE).min(moving.len());
    best(&mut around.into_iter()).map(|at| moving[at])
}

/// Where the model is made linear.
pub(super) struct Calibrated {
    /// In units of their prior deviations.
    pub states: States,
    pub deviations: States,
}

/// The innovations of all readings, by the model that is linear about the errors that they tell of themselves. By the nominal one they
/// keep what is of second order in the errors, and are not white even where everything is as it is thought to be.
#[must_use]
pub fn innovations(history: &History) -> Vec<Six> {
    let History { model, moments, .. } = history;
    let (_, states) = nominal(history);
    let Some(states) = states.last() else { return Vec::new() };
    about_errors(history, linear::errors(states, &model.belief.deviations), moments.len()).innovations
}

/// Gauss and Newton on the readings up to `until`, from what the nominal model makes of them.
pub(super) fn calibrate(history: &History, until: usize, nominal: &[States]) -> Option<Calibrated> {
    let History { model, moments, readings } = history;
    let mut states = *nominal.get(until)?;
    let mut deviations = States::zeros();
    for _ in 0..STEPS {
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
#[derive(Debug)]
pub(super) struct About {
    pub stages: Vec<Stage>,
    pub innovations: Vec<Six>,
    /// The bend that the tracker measures, rad.
    pub bends: Vec<f64>,
}

impl About {
    /// Contacts that began at a reading and some of the way to the next, at any place.
    fn row(&self, shapes: &Shapes, began: (usize, f64), side: f64) -> Row {
        Row::new(shapes, |k| &self.stages[k], &self.innovations, &self.bends, began, side)
    }
}

/// The first `count` readings by the model that is linear about these errors.
pub(super) fn about_errors(history: &History, mut errors: linear::Errors, count: usize) -> About {
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

/// Contacts of one kind: what was tried, and how many of them there are to a reading and to all else that is not known.
pub(super) struct Tried {
    pub kind: Kind,
    pub rows: Vec<Row>,
    pub parts: f64,
}

fn placed(history: &History, began: usize, calibrated: &Calibrated, question: &Question) -> Option<Estimate> {
    let Question { kinds, parts, .. } = *question;
    let History { model, moments, readings } = history;
    let last = readings.len().min(moments.len()).checked_sub(1)?;
    // The model is linear about errors that were thought possible: beyond them nothing it says of a place is to be believed.
    if calibrated.states.iter().take(super::DRIFT).any(|state| state.abs() > BELIEVED) {
        return None;
    }
    let errors = linear::errors(&calibrated.states, &model.belief.deviations);
    let about = about_errors(history, errors, last + 1);
    let length = model.length * (1.0 + errors[6]);
    let first = question.first;
    let moving: Vec<usize> = (first..last).filter(|&k| moments[k].command.rate != 0.0).collect();
    let side = moments[began].command.rate.signum();
    let all = kinds.iter().map(|&kind| {
        let shapes = match kind {
            Kind::Clamp => Shapes::clamps(length),
            Kind::Plane => Shapes::planes(length, &about.bends[first..=last], side),
        };
        let row = |began: (usize, f64)| about.row(&shapes, began, side);
        let (rows, parts) = rows(row, &moving, began, parts, &Grid::coarse(Base::Stays));
        Tried { kind, rows, parts: f64::from(parts) }
    });
    let all: Vec<Tried> = all.collect();
    let deviations = linear::errors(&calibrated.deviations, &model.belief.deviations);
    let commands: Vec<Command> = moments.iter().map(|moment| moment.command).collect();
    let calibration = [errors, deviations];
    weigh(&all, &Weighed { base: Base::Stays, length, commands: &commands, beginnings: moving.len(), calibration })
}

/// The beginnings that count, and how many of them there are to a reading, at most `parts`.
pub(super) fn rows<R: Began>(
    row: impl Fn((usize, f64)) -> R,
    moving: &[usize],
    began: usize,
    parts: u32,
    grid: &Grid,
) -> (Vec<R>, u32) {
    let mut best = f64::NEG_INFINITY;
    let mut rows: Vec<(f64, R)> = Vec::new();
    // Outward from the likeliest beginning, to where nothing is left.
    let start = moving.partition_point(|&k| k < began);
    let sides: [&mut dyn Iterator<Item = &usize>; 2] = [&mut moving[start..].iter(), &mut moving[..start].iter().rev()];
    for side in sides {
        for &next in side {
            let row = row((next, 0.0));
            let most = row.largest(grid);
            best = best.max(most);
            rows.push((most, row));
            if most < best - NEGLIGIBLE {
                break;
            }
        }
    }
    rows.sort_by(|a, b| a.1.began().total_cmp(&b.1.began()));
    let all: Vec<&R> = rows.iter().map(|(_, row)| row).collect();
    let parts = likelihood::parts(&all, grid, best).map_or(parts, |enough| enough.min(parts)).max(1);
    rows.retain(|(most, _)| *most > best - NEGLIGIBLE);
    let part = |part: u32| f64::from(part) / f64::from(parts);
    let divided = rows.into_iter().flat_map(|(_, whole)| {
        let between = (1..parts).map(part).map(|part| row((whole.began() as usize, part))).collect::<Vec<_>>();
        std::iter::once(whole).chain(between)
    });
    (divided.collect(), parts)
}

/// So often the grid is made denser, at most.
const DENSER: usize = 4;
/// A posterior is drawn at no fewer places than these.
const FEWEST: u32 = 60;
/// Densities below this share of the largest count for nothing.
const FAINT: f64 = 1e-5;

/// What the rows add up to at the places of a grid.
struct Sum {
    grid: Grid,
    /// Densities, in any unit, at each place.
    density: Vec<f64>,
    /// Sum of all, and of the instants of beginning.
    total: f64,
    began: f64,
    kinds: Vec<(Kind, f64)>,
    /// The largest log likelihood ratio.
    best: f64,
}

impl Sum {
    fn of(all: &[Tried], commands: &[Command], grid: Grid) -> Option<Self> {
        let along =
            |tried: &Tried| -> Vec<Vec<f64>> { tried.rows.iter().map(|row| row.along(&grid).collect()).collect() };
        let values: Vec<Vec<Vec<f64>>> = all.iter().map(along).collect();
        let best = values.iter().flatten().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
        if !best.is_finite() {
            return None;
        }
        let mut density = vec![0.0; grid.places().len()];
        let (mut began, mut kinds) = (0.0, Vec::new());
        for (tried, values) in all.iter().zip(&values) {
            let mut weight = 0.0;
            for (row, values) in tried.rows.iter().zip(values) {
                let (whole, part) = (row.began as usize, row.began.fract());
                let after = commands.get(whole + 1).map_or(commands[whole].time, |after| after.time);
                let at = commands[whole].time + part * (after - commands[whole].time);
                for (value, density) in values.iter().zip(&mut density) {
                    let here = exp(value - best) / tried.parts;
                    *density += here;
                    weight += here;
                    began += here * at;
                }
            }
            kinds.push((tried.kind, weight));
        }
        let total: f64 = density.iter().sum();
        Some(Self { grid, density, total, began, kinds, best })
    }

    /// A denser grid where the density is so narrow that this one is too coarse for it.
    fn denser(&self) -> Option<Grid> {
        let most = self.density.iter().copied().fold(0.0, f64::max);
        let counts = |density: &f64| *density > FAINT * most;
        let grid = &self.grid;
        let [first, last] = [self.density.iter().position(counts)?, self.density.iter().rposition(counts)?];
        let (places, spacing) = (self.grid.places(), self.grid.spacing());
        let ends = [places[first] - spacing, places[last] + spacing];
        (last - first < FEWEST as usize).then(|| grid.between([ends[0].max(0.0), ends[1].min(1.0)], 2 * FEWEST))
    }
}

/// What is weighed besides the likelihood.
pub(super) struct Weighed<'a> {
    pub base: Base,
    /// Length of the segment, m.
    pub length: f64,
    pub commands: &'a [Command],
    /// How many readings were thought of as the beginning.
    pub beginnings: usize,
    pub calibration: [[f64; STATES]; 2],
}

/// Adds the rows up, as densely as their sum is narrow.
pub(super) fn weigh(all: &[Tried], weighed: &Weighed) -> Option<Estimate> {
    let Weighed { base, length, commands, beginnings, calibration } = *weighed;
    let mut sum = Sum::of(all, commands, Grid::fine(base))?;
    for _ in 0..DENSER {
        let Some(grid) = sum.denser() else { break };
        sum = Sum::of(all, commands, grid)?;
    }
    let Sum { grid, density, total, began, mut kinds, best } = sum;
    kinds.iter_mut().for_each(|(_, weight)| *weight /= total);
    let (places, spacing) = (grid.places(), grid.spacing());
    let place = Place::of(&grid, &density, length);
    let posterior =
        places.iter().zip(&density).map(|(place, here)| [place * length, here / (total * spacing * length)]);
    let ratio = best + libm::log(total * spacing / (beginnings * all.len()) as f64);
    let (began, posterior) = (began / total, posterior.collect());
    Some(Estimate { place, began, kinds, calibration, posterior, evidence: best, ratio })
}

impl Place {
    /// Of a density (in any unit) along a grid of a segment `length` m long.
    fn of(grid: &Grid, density: &[f64], length: f64) -> Self {
        let (places, spacing) = (grid.places(), grid.spacing());
        let total: f64 = density.iter().sum();
        let mean = places.iter().zip(density).map(|(place, here)| place * here).sum::<f64>() / total;
        let mode = density.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i);
        let quantile = |share: f64| {
            let mut sum = 0.0;
            for (place, here) in places.iter().zip(density) {
                if sum + here >= share * total {
                    return place + ((share * total - sum) / here - 0.5) * spacing;
                }
                sum += here;
            }
            1.0
        };
        Self {
            mean: mean * length,
            mode: places[mode] * length,
            low: quantile(0.025) * length,
            high: quantile(0.975) * length,
        }
    }
}
