//! Equilibrium with some contacts held, by Newton's method.

use super::modes::Layout;
use super::shape::{Shape, shape};
use super::variation::{Push, Variation};
use crate::model::Vec3;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// It takes 4 to 6 from a near shape, 5 to 14 from a free one.
const STEPS: usize = 40;
/// After a step below this what is left is rounding: the next system is that of the shape itself, and gives its derivatives.
const SMALL: f64 = 1e-9;

/// A contact in the units of the layout.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held {
    pub piece: usize,
    pub normal: Vec3,
    pub offset: f64,
}

/// x and the forces of the contacts held.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unknowns {
    pub x: DVector<f64>,
    pub forces: DVector<f64>,
}

/// A shape in equilibrium with the contacts held, stable or not.
#[derive(Debug, Clone)]
pub(super) struct Equilibrium {
    pub at: Unknowns,
    pub shape: Shape,
    /// Derivatives of x and of the forces by the U of every segment that has pieces, two columns for each.
    pub by_bends: DMatrix<f64>,
    /// Second derivatives of energy and contacts by x.
    pub hessian: DMatrix<f64>,
    /// First derivatives of n·p of each contact held, by x and by U.
    pub gradients: DMatrix<f64>,
}

/// The same for a start that is near, without derivatives by U.
#[derive(Debug, Clone)]
pub(super) struct Near {
    pub at: Unknowns,
    pub shape: Shape,
    /// As of [`Equilibrium`], a small step before.
    pub hessian: DMatrix<f64>,
    pub gradients: DMatrix<f64>,
}

/// One linearisation.
struct System {
    gradients: DMatrix<f64>,
    second: DMatrix<f64>,
    residual: DVector<f64>,
    lu: LU<f64, Dyn, Dyn>,
}

/// From a start; `bends` holds the U of every segment with pieces. `None` where Newton's method finds nothing.
pub(super) fn equilibrium(layout: &Layout, bends: &[f64], held: &[Held], start: Unknowns) -> Option<Equilibrium> {
    let (unknowns, mut at, mut last) = (layout.unknowns, start, false);
    for _ in 0..STEPS {
        let system = System::new(layout, bends, held, &at)?;
        let step = system.lu.solve(&-&system.residual)?;
        let largest = step.rows(0, unknowns).amax();
        if !largest.is_finite() {
            return None;
        }
        at.x += step.rows(0, unknowns);
        at.forces += step.rows(unknowns, held.len());
        if last {
            return system.finish(layout, bends, at);
        }
        last = largest < SMALL;
    }
    None
}

/// A step below this is rounding.
const SETTLED: f64 = 1e-12;
/// Systems are solved so often, each with so many steps at most, as long as each is this much smaller than that before.
const CHORDS: (usize, usize, f64) = (12, 8, 0.2);

/// From a start that is near: steps with the system of a shape before cost a fraction of one with its own.
pub(super) fn nearby(layout: &Layout, bends: &[f64], held: &[Held], start: Unknowns) -> Option<Near> {
    let (systems, chords, shrinks) = CHORDS;
    let mut at = start;
    for _ in 0..systems {
        let system = System::new(layout, bends, held, &at)?;
        let (mut residual, mut last) = (system.residual.clone(), f64::INFINITY);
        for _ in 0..chords {
            let step = system.lu.solve(&-residual)?;
            let size = step.rows(0, layout.unknowns).amax();
            if !size.is_finite() {
                return None;
            }
            at.x += step.rows(0, layout.unknowns);
            at.forces += step.rows(layout.unknowns, held.len());
            let shape = shape(layout, &factors(&at.x, bends))?;
            if size < SETTLED {
                let gradients = system.gradients.columns(0, layout.unknowns).into_owned();
                return Some(Near { at, shape, hessian: system.hessian(layout.unknowns), gradients });
            }
            if size > shrinks * last {
                break;
            }
            last = size;
            let variation = Variation::new(layout, &shape);
            residual = residual_of(held, &at, &gradients(layout, &variation, held), &shape);
        }
    }
    None
}

/// First derivatives of n·p of each contact held, by all terms.
fn gradients(layout: &Layout, variation: &Variation, held: &[Held]) -> DMatrix<f64> {
    let along = |c: usize, i| variation.motion(i, held[c].piece).linear.dot(&held[c].normal);
    DMatrix::from_fn(held.len(), layout.modes.len(), along)
}

/// What is left of balance and of contact.
fn residual_of(held: &[Held], at: &Unknowns, gradients: &DMatrix<f64>, shape: &Shape) -> DVector<f64> {
    let unknowns = at.x.len();
    let mut residual = DVector::zeros(unknowns + held.len());
    let by_x = gradients.columns(0, unknowns);
    residual.rows_mut(0, unknowns).copy_from(&(&at.x + by_x.transpose() * &at.forces));
    for (c, held) in held.iter().enumerate() {
        residual[unknowns + c] = held.normal.dot(&shape.ends[held.piece].position) - held.offset;
    }
    residual
}

impl System {
    fn hessian(&self, unknowns: usize) -> DMatrix<f64> {
        let mut hessian = self.second.columns(0, unknowns).into_owned();
        (0..unknowns).for_each(|i| hessian[(i, i)] += 1.0);
        hessian
    }

    fn new(layout: &Layout, bends: &[f64], held: &[Held], at: &Unknowns) -> Option<Self> {
        let unknowns = layout.unknowns;
        let shape = shape(layout, &factors(&at.x, bends))?;
        let variation = Variation::new(layout, &shape);
        let gradients = gradients(layout, &variation, held);
        let push = |(held, force): (&Held, &f64)| Push { piece: held.piece, normal: held.normal, force: *force };
        let pushes: Vec<Push> = held.iter().zip(at.forces.iter()).map(push).collect();
        let second = variation.second(&pushes);
        let by_x = gradients.columns(0, unknowns);
        let mut matrix = DMatrix::zeros(unknowns + held.len(), unknowns + held.len());
        matrix.view_mut((0, 0), (unknowns, unknowns)).copy_from(&second.columns(0, unknowns));
        (0..unknowns).for_each(|i| matrix[(i, i)] += 1.0);
        matrix.view_mut((unknowns, 0), (held.len(), unknowns)).copy_from(&by_x);
        matrix.view_mut((0, unknowns), (unknowns, held.len())).copy_from(&by_x.transpose());
        let residual = residual_of(held, at, &gradients, &shape);
        Some(Self { gradients, second, residual, lu: matrix.lu() })
    }

    /// With the last, tiny step made, what the system says of the shape holds to rounding.
    fn finish(self, layout: &Layout, bends: &[f64], at: Unknowns) -> Option<Equilibrium> {
        let (unknowns, columns) = (layout.unknowns, bends.len());
        let mut right = DMatrix::zeros(unknowns + at.forces.len(), columns);
        right.rows_mut(0, unknowns).copy_from(&-self.second.columns(unknowns, columns));
        right.rows_mut(unknowns, at.forces.len()).copy_from(&-self.gradients.columns(unknowns, columns));
        let by_bends = self.lu.solve(&right)?;
        let hessian = self.hessian(unknowns);
        let shape = shape(layout, &factors(&at.x, bends))?;
        Some(Equilibrium { at, shape, by_bends, hessian, gradients: self.gradients })
    }
}

pub(super) fn factors(x: &DVector<f64>, bends: &[f64]) -> Vec<f64> {
    x.iter().chain(bends).copied().collect()
}
