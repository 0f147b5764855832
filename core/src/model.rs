//! The exact model of multi-backbone segments, one or several in series: kinematics, statics, centrodes, contact.
//!
//! Pure `f64` functions of values: nothing here can fail but the search for a chain's equilibrium, which says so; and
//! nothing divides by the bend, so every quantity is exact to rounding on the whole domain, the straight configuration
//! included.
//!
//! Reading order: [`special`] (the removable singularities), [`configuration`], [`twist`], [`arc`]
//! (pose and Jacobian anywhere along the backbone), [`joints`], [`statics`], [`centrode`],
//! [`constrained`] (the segment held at one point), [`location`] (where is that point) and [`chain`] (segments in series).
//!
//! Conventions: SI units and radians; base frame {B} at the base disk's centre, `z` along the straight
//! backbone, `x` through backbone 1. The bend is `φ = π/2 − θL`; `φ > 0` bends toward `(cos δ, −sin δ, 0)`.
//! Transcendental functions come from `libm`, so that every machine computes the same bits.

pub mod arc;
pub mod centrode;
pub mod chain;
pub mod configuration;
pub mod constrained;
pub mod contact;
pub mod joints;
pub mod location;
pub mod orientation;
pub(crate) mod product;
pub mod special;
pub mod statics;
pub mod twist;

pub use arc::{Arc, Jacobian, Pose};
pub use configuration::{Configuration, Rate};
pub use constrained::Constrained;
pub use contact::touched::Touched;
pub use location::{Assumed, Assumption, Location, locate};
pub use statics::{Covector, Segment};
pub use twist::{Twist, Wrench};

/// A vector in {B} unless said otherwise.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A rotation matrix; named `to_from_frame` where it is bound.
pub type Mat3 = nalgebra::Matrix3<f64>;
