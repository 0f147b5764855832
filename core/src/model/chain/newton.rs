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

impl System {
    fn new(layout: &Layout, bends: &[f64], held: &[Held], at: &Unknowns) -> Option<Self> {
        let unknowns = layout.unknowns;
        let shape = shape(layout, &factors(&at.x, bends))?;
        let variation = Variation::new(layout, &shape);
        let modes = layout.modes.len();
        let gradients =
            DMatrix::from_fn(held.len(), modes, |c, i| variation.motion(i, held[c].piece).linear.dot(&held[c].normal));
        let push = |(held, force): (&Held, &f64)| Push { piece: held.piece, normal: held.normal, force: *force };
        let pushes: Vec<Push> = held.iter().zip(at.forces.iter()).map(push).collect();
        let second = variation.second(&pushes);
        let by_x = gradients.columns(0, unknowns);
        let mut matrix = DMatrix::zeros(unknowns + held.len(), unknowns + held.len());
        matrix.view_mut((0, 0), (unknowns, unknowns)).copy_from(&second.columns(0, unknowns));
        (0..unknowns).for_each(|i| matrix[(i, i)] += 1.0);
        matrix.view_mut((unknowns, 0), (held.len(), unknowns)).copy_from(&by_x);
        matrix.view_mut((0, unknowns), (unknowns, held.len())).copy_from(&by_x.transpose());
        let mut residual = DVector::zeros(unknowns + held.len());
        residual.rows_mut(0, unknowns).copy_from(&(&at.x + by_x.transpose() * &at.forces));
        for (c, held) in held.iter().enumerate() {
            residual[unknowns + c] = held.normal.dot(&shape.ends[held.piece].position) - held.offset;
        }
        Some(Self { gradients, second, residual, lu: matrix.lu() })
    }

    /// With the last, tiny step made, what the system says of the shape holds to rounding.
    fn finish(self, layout: &Layout, bends: &[f64], at: Unknowns) -> Option<Equilibrium> {
        let (unknowns, columns) = (layout.unknowns, bends.len());
        let mut right = DMatrix::zeros(unknowns + at.forces.len(), columns);
        right.rows_mut(0, unknowns).copy_from(&-self.second.columns(unknowns, columns));
        right.rows_mut(unknowns, at.forces.len()).copy_from(&-self.gradients.columns(unknowns, columns));
        let by_bends = self.lu.solve(&right)?;
        let mut hessian = self.second.columns(0, unknowns).into_owned();
        (0..unknowns).for_each(|i| hessian[(i, i)] += 1.0);
        let shape = shape(layout, &factors(&at.x, bends))?;
        Some(Equilibrium { at, shape, by_bends, hessian, gradients: self.gradients })
    }
}

pub(super) fn factors(x: &DVector<f64>, bends: &[f64]) -> Vec<f64> {
    x.iter().chain(bends).copied().collect()
}
