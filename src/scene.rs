//! What the 3D view shows, as plain data: no GPU, no egui, no robot.
//!
//! A [`Scene`] is a list of things to draw. Whoever builds it knows what a robot is; whoever draws it does not.
//! Lengths are metres, angles radians, in the base frame {B}: origin at the centre of the base disk, z along the
//! straight backbone, x through backbone 1. Widths and sizes that must not change with the zoom are in points
//! (a point is one pixel at scale 1). Colours are sRGB with straight alpha, see [`Color`].
//!
//! # Filling a scene
//!
//! 1. Sample the shape: [`arc::frames`] takes any `Fn(s) -> Pose`, as the model's shapes give it.
//! 2. Turn frames into bodies: [`arc::offset`] gives the centreline of a backbone that runs at a fixed point of the
//!    moving disk frame ([`arc::pitch_point`]), which becomes a [`Tube`]; each disk is a [`Disk`] at the frame of its
//!    arc length, with one hole per backbone.
//! 3. Annotate: [`Line`]s (screw axis, ghost outline, loci), [`Marker`]s (one shape per meaning), [`Label`]s.
//! 4. Set the [`Ground`], and take every colour from a [`palette::Palette`].
//!
//! Things that belong to an assumption rather than to the robot use [`Finish::Ghost`]: they cast no shadow and
//! fade toward their middle. [`crate::show::view`] does all of this for a run at one instant.
//!
//! The renderer takes geometry from a scene only when the version number handed over with it changes.

pub mod arc;
pub mod camera;
pub mod color;
pub mod colormap;
pub mod palette;
mod primitives;
mod studio;

pub use camera::{Camera, Ray};
pub use color::Color;
pub use primitives::{
    Block, Cap, Dash, Disk, Finish, Ground, Hole, Label, Line, Mark, Marker, Pose, Scene, Shape, Solid, Tube,
};
pub use studio::Studio;
