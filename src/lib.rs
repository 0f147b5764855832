//! Centrode: see and tune contact detection on a continuum robot.

#[cfg(feature = "app")]
pub mod app;
#[cfg(all(feature = "app", target_arch = "wasm32"))]
mod web;
