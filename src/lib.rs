//! Centrode: see and tune contact detection on a continuum robot.

pub mod scene;

#[cfg(feature = "app")]
pub mod render;
