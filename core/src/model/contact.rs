//! An elastic segment that touches something, in its bending plane.
//!
//! The paper freezes the part of the backbone below a contact (Eqs. 20–23, [`Constrained`](super::Constrained)). That is exact for
//! a beam that *clamps* the backbone: it holds position and slope by a couple. A beam that only *touches* it holds the position
//! along its normal, and the part below goes on changing shape while the segment bends on. This module has the exact
//! shape of an inextensible elastic backbone of given total bend φ against a frictionless [`plane`] that holds one of its points,
//! or against a round [`cylinder`] along which it slides.
//!
//! Curvature below the contact is a sum of Legendre polynomials ([`ritz`]) whose coefficients minimise the elastic energy under
//! the constraint; above the contact it is constant. [`branch`] follows the solution over φ from first contact on, to where
//! the segment snaps off the beam, and evaluates it at the price of a polynomial.
//!
//! Lengths are in units of the segment's L and forces in EI/L² throughout; x points toward the bend, z along the straight
//! backbone, the tangent is `(sin α, cos α)` and its normal `(cos α, −sin α)`.

pub mod branch;
pub mod cylinder;
pub mod plane;
pub mod ritz;
pub mod touched;

use super::special::Angle;
use nalgebra::Vector2;
use ritz::{Basis, MODES};

/// A point or direction in the bending plane: x toward the bend, z along the straight backbone.
pub type Planar = Vector2<f64>;

/// Where and how the segment was when it met what it touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    /// Arc length of the point that touched first, in units of L; in (0, 1).
    pub place: f64,
    /// Bend φ_c of the whole segment then, rad.
    pub bend: f64,
    /// +1 where the segment bends on toward a larger φ, −1 toward a smaller one: the side on which the obstacle is.
    pub side: f64,
}

impl Meeting {
    /// Slope α of the backbone at the contact then, rad.
    #[must_use]
    pub fn slope(&self) -> f64 {
        self.bend * self.place
    }
}

/// The unknowns of one configuration, or their derivatives by φ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unknowns {
    /// Legendre coefficients of the curvature below the contact, times the contact's arc length; the first is the slope
    /// α at the contact, rad.
    pub coefficients: [f64; MODES],
    /// Arc length of the contact, in units of L.
    pub place: f64,
    /// The contact force times the square of the contact's arc length, over EI; positive toward −n.
    pub multiplier: f64,
}

/// The segment against what it touches, at one bend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touching {
    /// Total bend φ, rad.
    pub bend: f64,
    /// The solution.
    pub at: Unknowns,
    /// Its derivative by φ.
    pub by_bend: Unknowns,
    /// Slope of the force's line: it acts along −n of this angle, rad.
    pub force_slope: f64,
}

impl Touching {
    /// Slope α of the backbone at the contact, rad.
    #[must_use]
    pub fn slope(&self) -> f64 {
        self.at.coefficients[0]
    }

    /// Size of the contact force in EI/L², negative where the obstacle is on the other side.
    #[must_use]
    pub fn force(&self) -> f64 {
        self.at.multiplier / (self.at.place * self.at.place)
    }

    /// Bend of the part above the contact, rad.
    #[must_use]
    pub fn upper_bend(&self) -> f64 {
        self.bend - self.slope()
    }

    /// Curvature above the contact, in 1/L.
    #[must_use]
    pub fn curvature_above(&self) -> f64 {
        self.upper_bend() / (1.0 - self.at.place)
    }

    /// Curvature at arc length `s` (in units of L), in 1/L.
    #[must_use]
    pub fn curvature(&self, s: f64) -> f64 {
        if s >= self.at.place {
            return self.curvature_above();
        }
        let legendre = ritz::legendre(2.0 * s / self.at.place - 1.0);
        self.at.coefficients.iter().zip(legendre).map(|(b, p)| b * p).sum::<f64>() / self.at.place
    }

    /// Curvature at the base, in 1/L: that above less what the force bends away, which loses no digits at the end of the series.
    #[must_use]
    pub fn curvature_base(&self, basis: &Basis) -> f64 {
        let angles = basis.angles(&self.at.coefficients);
        let along =
            angles.iter().zip(&basis.weights).map(|(angle, weight)| weight * libm::cos(angle - self.force_slope));
        self.curvature_above() - self.at.multiplier / self.at.place * along.sum::<f64>()
    }

    /// Elastic energy, in EI/L.
    #[must_use]
    pub fn energy(&self) -> f64 {
        let below: f64 = self.at.coefficients.iter().zip(0_u8..).map(|(b, j)| b * b / (2.0 * f64::from(j) + 1.0)).sum();
        let upper = self.upper_bend();
        0.5 * (below / self.at.place + upper * upper / (1.0 - self.at.place))
    }

    /// Position (in units of L) and slope (rad) at arc length `s` (in units of L, in [0, 1]).
    #[must_use]
    pub fn point(&self, basis: &Basis, s: f64) -> (Planar, f64) {
        let place = self.at.place;
        if s <= place {
            let share = if s == place { 1.0 } else { s / place };
            let (mean, slope) = basis.below(&self.at.coefficients, share);
            return (mean * s, slope);
        }
        let (mean, slope) = basis.below(&self.at.coefficients, 1.0);
        let (length, bend) = (s - place, self.upper_bend() * ((s - place) / (1.0 - place)));
        (mean * place + arc(slope, bend, length), slope + bend)
    }

    /// Position of the end disk, in units of L, and its derivative by φ.
    #[must_use]
    pub fn tip(&self, basis: &Basis) -> (Planar, Planar) {
        let Unknowns { coefficients, place, .. } = &self.at;
        let (mean, mean_by_bend) = basis.whole(coefficients, &self.by_bend.coefficients);
        let (slope, upper, length) = (self.slope(), self.upper_bend(), 1.0 - place);
        let (slope_by, place_by) = (self.by_bend.coefficients[0], self.by_bend.place);
        let angle = Angle::new(upper);
        // The chord of the upper arc over its length, in the frame of its start, and the derivative by its bend.
        let chord = Planar::new(upper * angle.versinc(), angle.sinc());
        let chord_by = Planar::new(angle.versine_ratio_slope(), -angle.sinc_drop());
        let turned = |v: Planar| turn(slope, v);
        let across = |v: Planar| Planar::new(v.y, -v.x);
        let tip = mean * *place + turned(chord) * length;
        let by = mean * place_by + mean_by_bend * *place - turned(chord) * place_by
            + (turned(chord_by) * (1.0 - slope_by) + across(turned(chord)) * slope_by) * length;
        (tip, by)
    }

    /// The constrained centrode c_c of the end disk for a motion in the bending plane (Eq. 23), in units of L.
    #[must_use]
    pub fn centrode(&self, basis: &Basis) -> Planar {
        let (tip, by) = self.tip(basis);
        // The disk turns from z toward x by 1 rad per rad of bend, so a point at (x, z) from c_c moves by (z, −x).
        tip + Planar::new(by.y, -by.x)
    }
}

/// What a direction becomes when the tangent turns by `slope` (rad), from z toward x.
fn turn(slope: f64, v: Planar) -> Planar {
    let (sin, cos) = libm::sincos(slope);
    Planar::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin)
}

/// The chord of a circular arc of a bend and a length that starts at a slope.
fn arc(slope: f64, bend: f64, length: f64) -> Planar {
    let angle = Angle::new(bend);
    turn(slope, Planar::new(bend * angle.versinc(), angle.sinc()) * length)
}

/// Where the end of a free segment is at a bend (rad), in units of L.
#[must_use]
pub fn free_tip(bend: f64) -> Planar {
    arc(0.0, bend, 1.0)
}

/// The same with a clamp at `place` (in units of L) that has held the backbone since the bend `met` (rad): the paper's Eqs. 20, 21.
#[must_use]
pub fn clamped_tip(place: f64, met: f64, bend: f64) -> Planar {
    let below = met * place;
    arc(0.0, below, place) + arc(below, bend - below, 1.0 - place)
}

#[cfg(test)]
mod tests;
