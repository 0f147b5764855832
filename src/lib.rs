//! Centrode: see and tune contact detection on a continuum robot.
pub mod experiment;
pub mod model;
pub mod scene;

#[cfg(feature = "app")]
pub mod render;

#[cfg(feature = "app")]
pub mod app;
