//! What the trackers of segments in series heard, each through its own calibration filter, and how their noise goes together.
//!
//! A tracker's noise is in what its own segment shows and, with the other sign, in what the next one does. So what a segment above a contact
//! shows, which the contact does not change, tells of the noise in what those below it show.

use super::course::Model;
use super::filter::{Signature, SpatialResponses};
use super::linear;
use super::marginal::{About, BELIEVED, Calibrated, History, about_errors, calibrate, nominal};
use super::sheet::Sums;
use super::{DRIFT, STATES, Six};
use crate::model::product::add_product;
use crate::model::{Mat3, Pose};
use libm::sqrt;
use nalgebra::{Const, DMatrix, DVector, Dyn, OMatrix, SMatrix};

type Square6 = SMatrix<f64, 6, 6>;

/// Directions in which what is known of a contact that holds already may be wrong.
pub const LOOSE: usize = 3;

/// Something that hears contacts.
pub trait Listens {
    /// What is heard of contacts that began at an instant (in readings): `signature` is what they change in a reading after it, of each of the
    /// first `seeing` trackers.
    fn hear<const N: usize>(
        &self,
        began: f64,
        seeing: usize,
        signature: impl Fn(usize, usize) -> Signature<N>,
    ) -> Sums<N>;

    /// The square of every reading's innovations: so many as there are of them, on average, where nothing touches.
    fn squares(&self) -> &[f64];
}

/// Readings before a contact of which the innovations are compared with those after it.
const CALM: usize = 200;
/// Of so many standard deviations chance is thought capable.
const CHANCE: f64 = 3.0;

/// How many times less than it seems to, what was heard after a reading says of a contact, where one contact leaves some of it unexplained:
/// `best` is the largest logarithm of the likelihood ratio. What is unexplained is thought to be the same from reading to reading, so that it
/// does not average out.
#[must_use]
pub fn doubt(squares: &[f64], from: usize, best: f64) -> f64 {
    let from = from.min(squares.len());
    let (calm, after) = (&squares[from.saturating_sub(CALM)..from], &squares[from..]);
    if calm.is_empty() || after.is_empty() {
        return 1.0;
    }
    let mean = calm.iter().sum::<f64>() / calm.len() as f64;
    let count = after.len() as f64;
    let left = (after.iter().sum::<f64>() - 2.0 * best) / (count * mean);
    let chance = CHANCE * sqrt(2.0 / mean * (1.0 / count + 1.0 / calm.len() as f64));
    1.0 + (left - 1.0 - chance).max(0.0) * count
}

/// One tracker.
#[derive(Debug)]
pub struct Tracker {
    about: About,
    /// Errors of its segment's calibration before the contact, in their own units, and their standard deviations.
    pub calibration: [[f64; STATES]; 2],
}

/// How what one tracker hears of a reading goes with what the one below it hears: both whitened, L and B of the joint covariance, whose
/// Cholesky factor has L on its diagonal and B below it.
#[derive(Debug, Clone)]
struct Joint {
    /// L⁻¹.
    own: Square6,
    /// B.
    below: Square6,
}

/// All of them, from the base.
#[derive(Debug)]
pub struct Ensemble {
    trackers: Vec<Tracker>,
    /// By reading, then by tracker above the first.
    joints: Vec<Vec<Joint>>,
    squares: Vec<f64>,
    /// What may be wrong, of all of them together.
    loose: Loose,
}

/// What is not known beforehand of what else the readings hold: some directions, each with a standard deviation of 1.
#[derive(Debug, Default)]
struct Loose {
    /// What each of them adds to what the trackers hear, whitened: by direction, then by reading from the first, then by tracker.
    seen: Vec<Vec<Vec<Signature<LOOSE>>>>,
    /// What the readings say of them: their covariance, and their mean.
    covariance: DMatrix<f64>,
    mean: DVector<f64>,
    /// Logarithm of the likelihood ratio of that mean.
    evidence: f64,
}

impl Tracker {
    /// Of readings of which those up to `until` say what the calibration is: then `corrected`, where these are others. `None` where the
    /// calibration is beyond what was thought possible.
    #[must_use]
    pub fn new(history: &History, until: usize) -> Option<Self> {
        let (_, states) = nominal(history);
        let Calibrated { states, deviations } = calibrate(history, until, &states)?;
        if states.iter().take(DRIFT).any(|state| state.abs() > BELIEVED) {
            return None;
        }
        let own = |values| linear::errors(values, &history.model.belief.deviations);
        let about = about_errors(history, own(&states), history.readings.len());
        Some(Self { about, calibration: [own(&states), own(&deviations)] })
    }

    /// The same with other readings.
    #[must_use]
    pub fn reread(&self, history: &History) -> Self {
        let about = about_errors(history, self.calibration[0], history.readings.len());
        Self { about, calibration: self.calibration }
    }

    /// The bend that it measures at each reading, rad.
    #[must_use]
    pub fn bends(&self) -> &[f64] {
        &self.about.bends
    }
}

impl Ensemble {
    /// `models` are those of the trackers, `poses` the readings of each, and `axes` the axes along which its residuals are taken at a reading.
    #[must_use]
    pub fn new(
        trackers: Vec<Tracker>,
        models: &[&Model],
        poses: &[&[Pose]],
        axes: impl Fn(usize, usize) -> Mat3,
    ) -> Self {
        let shared = shared(models);
        let count = trackers.iter().map(|tracker| tracker.about.stages.len()).min().unwrap_or(0);
        let at = |k: usize| {
            let mut joints: Vec<Joint> = Vec::new();
            for above in 1..trackers.len() {
                let [one, other] = [above - 1, above].map(|tracker| &trackers[tracker].about.stages[k]);
                let turn = axes(above - 1, k).tr_mul(&poses[above - 1][k].rotation) * axes(above, k);
                let both = models[above - 1].noise.colour * models[above].noise.colour;
                let cross = one.whitener * crossed(&turn, shared, both) * other.whitener.transpose();
                joints.push(Joint::above(joints.last(), &cross.transpose()));
            }
            joints
        };
        let joints = (0..count).map(at).collect();
        let mut all = Self { trackers, joints, squares: Vec::new(), loose: Loose::default() };
        all.squares = (0..count).map(|k| all.square(k)).collect();
        all
    }

    /// Lets the readings hold, besides what they are heard for, some share of what began at an instant (in readings) and changes them like this.
    pub fn loosen(&mut self, began: f64, signature: impl Fn(usize, usize) -> Signature<LOOSE>) {
        let seeing = self.trackers.len();
        let mut seen = vec![vec![Signature::zeros(); seeing]; self.joints.len()];
        self.go_through(began, seeing, signature, |place, k, of, _| seen[k][place] = *of);
        self.loose.seen.push(seen);
        let all = &self.loose.seen;
        let count = all.len() * LOOSE;
        let (mut information, mut linear) = (DMatrix::identity(count, count), DVector::zeros(count));
        let none = |_: usize, _: usize| Signature::zeros();
        self.go_through(0.0, 0, none, |place, k, _: &Signature<LOOSE>, innovation| {
            for (a, one) in all.iter().enumerate() {
                let mut own = linear.rows_mut(a * LOOSE, LOOSE);
                own += one[k][place].tr_mul(innovation);
                for (b, other) in all.iter().enumerate() {
                    let mut block = information.view_mut((a * LOOSE, b * LOOSE), (LOOSE, LOOSE));
                    block += one[k][place].tr_mul(&other[k][place]);
                }
            }
        });
        match information.cholesky() {
            Some(factor) => {
                self.loose.mean = factor.solve(&linear);
                self.loose.evidence = 0.5 * self.loose.mean.dot(&linear);
                self.loose.covariance = factor.inverse();
            }
            // Of a sum of squares and the identity there always is one, unless they are no numbers.
            None => self.loose = Loose::default(),
        }
    }

    /// What is heard, whitened, of every reading after an instant, tracker by tracker: what each signature adds, and the innovation.
    fn go_through<const N: usize>(
        &self,
        began: f64,
        seeing: usize,
        signature: impl Fn(usize, usize) -> Signature<N>,
        mut each: impl FnMut(usize, usize, &Signature<N>, &Six),
    ) {
        let mut responses = vec![SpatialResponses::<N>::default(); seeing];
        for (k, joints) in self.joints.iter().enumerate().skip(began as usize + 1) {
            let mut below: Option<(Signature<N>, Six)> = None;
            for (place, Tracker { about, .. }) in self.trackers.iter().enumerate() {
                let mut seen = match responses.get_mut(place) {
                    Some(responses) => responses.step(&about.stages[k], &signature(place, k)),
                    None => Signature::zeros(),
                };
                let mut innovation = about.innovations[k];
                if let Some((seen_below, innovation_below)) = &below {
                    let joint = &joints[place - 1];
                    seen = joint.own * (seen - joint.below * seen_below);
                    innovation = joint.own * (innovation - joint.below * innovation_below);
                }
                each(place, k, &seen, &innovation);
                below = Some((seen, innovation));
            }
        }
    }

    fn square(&self, k: usize) -> f64 {
        let (mut below, mut sum): (Option<Six>, f64) = (None, 0.0);
        for (place, tracker) in self.trackers.iter().enumerate() {
            let own = tracker.about.innovations[k];
            let innovation = match below {
                None => own,
                Some(below) => self.joints[k][place - 1].own * (own - self.joints[k][place - 1].below * below),
            };
            sum += innovation.norm_squared();
            below = Some(innovation);
        }
        sum
    }

    /// Logarithm of the likelihood ratio of what else the readings hold, where nothing that they are heard for is in them.
    #[must_use]
    pub fn else_evidence(&self) -> f64 {
        self.loose.evidence
    }

    /// One of the trackers.
    #[must_use]
    pub fn tracker(&self, place: usize) -> &Tracker {
        &self.trackers[place]
    }
}

impl Listens for Ensemble {
    fn hear<const N: usize>(
        &self,
        began: f64,
        seeing: usize,
        signature: impl Fn(usize, usize) -> Signature<N>,
    ) -> Sums<N> {
        let mut sums = Sums::default();
        let mut with_loose = OMatrix::<f64, Const<N>, Dyn>::zeros(self.loose.mean.len());
        self.go_through(began, seeing, signature, |place, k, seen, innovation| {
            sums.add(seen, innovation);
            for (of, known) in self.loose.seen.iter().enumerate() {
                let cross = seen.tr_mul(&known[k][place]);
                let mut columns = with_loose.columns_mut(of * LOOSE, LOOSE);
                columns += cross;
            }
        });
        let mut sums = sums.whole();
        if !self.loose.seen.is_empty() {
            // What is not known is integrated out: what signatures have in common with it tells of neither.
            sums.linear -= &with_loose * &self.loose.mean;
            let mut spread = OMatrix::<f64, Const<N>, Dyn>::zeros(with_loose.ncols());
            add_product(&mut spread, 1.0, &with_loose, &self.loose.covariance);
            add_product(&mut sums.square, -1.0, &spread, &with_loose.transpose());
        }
        sums
    }

    fn squares(&self) -> &[f64] {
        &self.squares
    }
}

impl Joint {
    /// Above another, with which it goes together like this.
    fn above(other: Option<&Self>, cross: &Square6) -> Self {
        let below = cross * other.map_or_else(Square6::identity, |other| other.own.transpose());
        let left = Square6::identity() - below * below.transpose();
        // Noise that is thought to be more alike than it can be is taken for independent.
        let own = left.cholesky().and_then(|factor| factor.l().try_inverse());
        own.map_or_else(|| Self { own: Square6::identity(), below: Square6::zeros() }, |own| Self { own, below })
    }
}

/// Variance of one tracker's noise, m² and rad²: what the first segment shows has that of one, what others do that of two.
fn shared(models: &[&Model]) -> [f64; 2] {
    let of = |sigma: fn(&Model) -> f64| {
        let each =
            models.iter().enumerate().map(|(k, model)| sigma(model) * sigma(model) / if k == 0 { 1.0 } else { 2.0 });
        each.fold(f64::INFINITY, f64::min)
    };
    [of(|model| model.noise.position), of(|model| model.noise.orientation)]
}

/// Covariance of two neighbours' residuals by the noise of the tracker between them. `turn` is from the axes of the upper to those of the lower.
fn crossed(turn: &Mat3, [place, angle]: [f64; 2], colour: f64) -> Square6 {
    // As residuals are ordered: which of the two vectors, and which of its components.
    let order = [(1, 1), (0, 0), (0, 2), (0, 1), (1, 0), (1, 2)];
    Square6::from_fn(|i, j| {
        let ((of, row), (and, column)) = (order[i], order[j]);
        let variance = [place, angle][of] * (1.0 - colour);
        if of == and { -variance * turn[(row, column)] } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_one_contact_does_not_explain_counts_as_often_as_it_was_read() {
        let (calm, loud) = (vec![15.0; 200], vec![45.0; 50]);
        let all: Vec<f64> = calm.iter().chain(&loud).copied().collect();
        assert_eq!(doubt(&all, 200, 0.5 * 50.0 * 30.0), 1.0, "all of it is explained");
        let half = doubt(&all, 200, 0.25 * 50.0 * 30.0);
        assert!((30.0..50.0).contains(&half), "as much again as the noise, less chance: {half}");
        assert_eq!(doubt(&all, 0, 0.0), 1.0, "nothing to compare with");
    }

    #[test]
    fn segments_above_tell_of_the_noise_below() {
        // Two trackers of equal noise: what the second shows has that of both, and half of its variance is the first one's.
        let cross = Square6::identity() * -std::f64::consts::FRAC_1_SQRT_2;
        let joint = Joint::above(None, &cross);
        let known = joint.own * (Square6::identity() - joint.below * cross.transpose()) * joint.own.transpose();
        assert!((known - Square6::identity()).amax() < 1e-12);
    }
}
