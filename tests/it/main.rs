//! Integration tests: one binary, one module per subject.

#[cfg(feature = "cli")]
mod cli;
mod experiment;
mod golden;
#[cfg(feature = "app")]
mod gpu;
mod misprints;
mod properties;
#[cfg(feature = "app")]
mod render;
mod reproducible;
#[cfg(feature = "app")]
mod shaders;
mod support;
