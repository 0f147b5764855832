//! Centrode: see and tune contact detection on a continuum robot.
//!
//! The numbers come from [`centrode_core`]; here they are shown. [`scene`] is what the 3D view holds, as plain data; [`show`] makes
//! it from a run at an instant. With the feature `app`, `render` draws a scene with wgpu and `app` is the interface; with `cli`,
//! `cli` is the headless command.

#[cfg(feature = "app")]
pub mod app;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "app")]
pub mod render;
pub mod scene;
pub mod show;
#[cfg(all(feature = "app", target_arch = "wasm32"))]
mod web;
