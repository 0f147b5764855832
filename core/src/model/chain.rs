//! Segments in series, in space, against any number of frictionless planes (docs/CHAIN.md).
//!
//! Each segment is one elastic [`Rod`]: inextensible, straight when nothing acts on it, with a bending stiffness and a
//! stiffness in torsion. The joints fix the integral of its curvature, two [`Bends`] for each segment; how the curvature is
//! spread along the segment, and how the segment twists, is up to the elastic energy and the contacts.
//!
//! Reading order: [`mod@free`] (nothing touches: arcs in series), [`joints`] (concentric backbones), [`elastic`] (against planes),
//! and what that is made of: `gauss` (nodes), `modes` (what the curvature is a sum of), `shape` (from curvature to rotations and
//! positions), `variation` (derivatives of a point's position), `newton` (equilibrium), `stability`.
//!
//! SI units; frame {B} at the base disk. The force of a plane on the robot is −F n with F ≥ 0.

pub mod elastic;
pub mod free;
mod gauss;
pub mod joints;
mod lightly;
mod modes;
mod newton;
pub mod path;
pub mod pressed;
mod profile;
mod search;
mod shape;
mod stability;
mod variation;

use super::{Configuration, Vec3};
use libm::{atan2, hypot};
use nalgebra::Vector2;

pub use elastic::{Settled, Unsettled, Way, settle};
pub use free::{Disk, free};

/// The integrals of a segment's curvature about x and y of its own frame, rad: U = φ (sin δ, cos δ).
///
/// Unlike δ, they are smooth at the straight segment: ∂U/∂θL = −(sin δ, cos δ), ∂U/∂δ = φ (cos δ, −sin δ).
pub type Bends = Vector2<f64>;

/// The integrals of curvature of a configuration.
#[must_use]
pub fn bends(configuration: Configuration) -> Bends {
    let (sin, cos) = configuration.sin_cos_delta();
    Bends::new(sin, cos) * configuration.bend()
}

/// The configuration with these integrals of curvature; its bend is never negative, and δ is 0 for the straight segment.
#[must_use]
pub fn configuration(bends: &Bends) -> Configuration {
    let straight = bends.x == 0.0 && bends.y == 0.0;
    Configuration::new(hypot(bends.x, bends.y), if straight { 0.0 } else { atan2(bends.x, bends.y) })
}

/// How a segment resists torsion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Torsion {
    /// It does not twist.
    Rigid,
    /// Its stiffness in torsion over that in bending, GJ/EI; above 0.
    Ratio(f64),
}

/// A segment, all of its backbones taken as one elastic rod.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rod {
    /// Length, m.
    pub length: f64,
    /// Bending stiffness EI, N·m².
    pub bending_stiffness: f64,
    /// Stiffness in torsion.
    pub torsion: Torsion,
}

/// Bending stiffness EI of each segment, N·m², of concentric backbones.
///
/// The secondary backbones of distal segments run inside those of proximal ones: EI_i = E_P I_P,i + 3 Σ_{k ≥ i} E_S I_S,k.
/// `tubes` holds (E_P I_P, E_S I_S) of each segment from the base, N·m².
#[must_use]
pub fn stiffnesses(tubes: &[(f64, f64)]) -> Vec<f64> {
    let mut inside = 0.0;
    let mut all: Vec<_> = tubes
        .iter()
        .rev()
        .map(|(primary, secondary)| {
            inside += 3.0 * secondary;
            primary + inside
        })
        .collect();
    all.reverse();
    all
}

/// A frictionless plane against one point of the backbone: n·p ≤ offset holds, with a force −F n on the robot where it is met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The segment, from 0.
    pub segment: usize,
    /// Arc length of the point from that segment's base, m; above 0, the segment's length is its end disk.
    pub at: f64,
    /// Unit normal n in {B}, away from the robot's side of the plane.
    pub normal: Vec3,
    /// Distance of the plane from the origin of {B} along n, m.
    pub offset: f64,
}
