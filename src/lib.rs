//! Centrode: see and tune contact detection on a continuum robot.
#[cfg(feature = "app")]
pub mod app;
#[cfg(feature = "cli")]
pub mod cli;
pub mod experiment;
pub mod model;
#[cfg(feature = "app")]
pub mod render;
pub mod scene;
#[cfg(all(feature = "app", target_arch = "wasm32"))]
mod web;
