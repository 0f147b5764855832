//! With a tracker on the last end disk alone: the calibration of a whole chain, from one pose.
//!
//! Six readings against two bends of every segment leave nothing over: what is known of a contact rests on how slowly the errors of the
//! calibration change. So the bends of a reading are not free, as they are where every end disk is tracked; they may **wander**, and while a
//! segment begins to move its play may be taken up. How much they wander is found from the readings before a contact.

pub(super) mod filter;
pub(super) mod linear;
pub(super) mod watch;

use crate::detect::calibration::ensemble::Listens;
use crate::detect::calibration::filter::Signature;
use crate::detect::calibration::marginal::BELIEVED;
use crate::detect::calibration::sheet::Sums;
use crate::detect::calibration::{ACROSS, Belief, DRIFT, LATE, Noise, OFFSET, SCALE, STATES, STRETCH, Six};
use crate::model::{Mat3, Pose};
use filter::{Designer, Filter, Responses, Stage};
use linear::{FRAME, LATENCY, Linear, Moment, OWN, Own};
use nalgebra::DVector;

/// How far bends wander in a second, as shares of the freedom of the bend (`prior.free_bend`); the first where nothing else is known.
pub(super) const WANDERS: [f64; 4] = [0.0, 1.0 / 128.0, 1.0 / 32.0, 1.0 / 8.0];

/// What is believed of a chain and its tracker.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Model {
    /// Nominal lengths of the segments, m.
    pub lengths: Vec<f64>,
    /// Of each segment. What is said of the tracker's frame, latency and drift is that of the first.
    pub beliefs: Vec<Belief>,
    /// Noise of the tracker.
    pub noise: Noise,
}

impl Model {
    /// How many errors there are.
    pub fn states(&self) -> usize {
        FRAME + OWN * self.lengths.len() + 3
    }

    /// Where the drift of the tracker begins among them.
    pub fn drift(&self) -> usize {
        FRAME + OWN * self.lengths.len()
    }

    /// Prior standard deviations of all errors, in their own units; of what wanders, its unit.
    pub fn deviations(&self) -> DVector<f64> {
        let mut all = DVector::zeros(self.states());
        let Some(shared) = self.beliefs.first() else { return all };
        all.rows_mut(0, 6).copy_from_slice(&shared.deviations[..6]);
        all[LATENCY] = shared.deviations[LATE];
        for (segment, belief) in self.beliefs.iter().enumerate() {
            for (own, place) in
                [(Own::Stretch, STRETCH), (Own::Scale, SCALE), (Own::Offset, OFFSET), (Own::Across, ACROSS)]
            {
                all[own.of(segment)] = belief.deviations[place];
            }
            all[Own::Play.of(segment)] = belief.free_bend;
        }
        let drift = self.drift();
        all.rows_mut(drift, 3).copy_from_slice(&shared.deviations[DRIFT..]);
        all
    }

    /// Whether an error stays what it is.
    pub fn stays(&self, state: usize) -> bool {
        let plays = state >= FRAME && (state - FRAME) % OWN == Own::Play as usize;
        state < self.drift() && !plays
    }
}

/// Readings by a model that is linear about some errors of the calibration.
#[derive(Debug)]
pub(super) struct Heard {
    stages: Vec<Stage>,
    innovations: Vec<Six>,
    squares: Vec<f64>,
    /// The errors before a contact, in their own units, and their standard deviations.
    pub errors: DVector<f64>,
    pub deviations: DVector<f64>,
}

/// Steps of Gauss and Newton, at most, and what is small enough to be the last.
const STEPS: usize = 4;
const SETTLED: f64 = 1e-3;

impl Heard {
    /// Of readings of which those up to `until` say what the calibration is, where bends wander like this. `None` where it is beyond what was
    /// thought possible.
    pub fn new(model: &Model, wander: f64, moments: &[Moment], readings: &[Pose], until: usize) -> Option<Self> {
        let prior = model.deviations();
        let mut states = DVector::zeros(model.states());
        let mut deviations = prior.clone();
        for _ in 0..STEPS {
            let about = model.lasting(&states.component_mul(&prior));
            let mut last = (Filter::new(model), Designer::new(model, wander));
            for (moment, reading) in moments.iter().zip(readings).take(until + 1) {
                step(model, &mut last, moment, reading, &about);
            }
            let (filter, designer) = last;
            let step = (&filter.states - &states).amax();
            states = filter.states;
            deviations = designer.deviations().component_mul(&prior);
            if !step.is_finite() {
                return None;
            }
            if step < SETTLED {
                break;
            }
        }
        if (0..model.states()).any(|state| model.stays(state) && states[state].abs() > BELIEVED) {
            return None;
        }
        let errors = states.component_mul(&prior);
        let about = model.lasting(&errors);
        let mut last = (Filter::new(model), Designer::new(model, wander));
        let heard =
            moments.iter().zip(readings).map(|(moment, reading)| step(model, &mut last, moment, reading, &about));
        let (stages, innovations): (Vec<Stage>, Vec<Six>) = heard.unzip();
        let squares = innovations.iter().map(Six::norm_squared).collect();
        Some(Self { stages, innovations, squares, errors, deviations })
    }
}

impl Heard {
    /// Errors of a segment before a contact, as those of a segment alone, and their standard deviations.
    pub fn calibration(&self, segment: usize) -> [[f64; STATES]; 2] {
        [&self.errors, &self.deviations].map(|all| {
            let mut own = [0.0; STATES];
            own[..6].copy_from_slice(&all.as_slice()[..6]);
            let each = [(STRETCH, Own::Stretch), (SCALE, Own::Scale), (OFFSET, Own::Offset), (ACROSS, Own::Across)];
            each.into_iter().for_each(|(place, error)| own[place] = all[error.of(segment)]);
            own[LATE] = all[LATENCY];
            own
        })
    }
}

impl Model {
    /// Errors of which those that wander or drift are taken for none.
    fn lasting(&self, errors: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(errors.len(), |state, _| if self.stays(state) { errors[state] } else { 0.0 })
    }
}

/// One reading, by a model that is linear about some errors.
fn step(
    model: &Model,
    (filter, designer): &mut (Filter, Designer),
    moment: &Moment,
    reading: &Pose,
    about: &DVector<f64>,
) -> (Stage, Six) {
    let linear = Linear::at(model, moment, about);
    let stage = designer.next(moment, &linear);
    let residual = linear.residual(reading) + &linear.by_error * about;
    let innovation = filter.step(&stage, &residual);
    (stage, innovation)
}

impl Listens for Heard {
    fn hear<const N: usize>(&self, began: f64, _: usize, signature: impl Fn(usize, usize) -> Signature<N>) -> Sums<N> {
        let mut sums = Sums::default();
        let mut responses = Responses::<N>::new(self.errors.len());
        for (k, (stage, innovation)) in self.stages.iter().zip(&self.innovations).enumerate().skip(began as usize + 1) {
            sums.add(&responses.step(stage, &signature(0, k)), innovation);
        }
        sums.whole()
    }

    fn squares(&self) -> &[f64] {
        &self.squares
    }
}

/// The order in which the residual of a pose stands, along the axes of {B}.
fn six(position: &crate::model::Vec3, rotation: &crate::model::Vec3) -> Six {
    Six::new(rotation.y, position.x, position.z, position.y, rotation.x, rotation.z)
}

/// How a reading differs from an expected pose, along the axes of {B}.
fn residual(expected: &Pose, reading: &Pose) -> Six {
    crate::detect::calibration::course::residual(expected, &Mat3::identity(), reading)
}
