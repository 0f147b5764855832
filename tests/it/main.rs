//! Integration tests: one binary, one module per subject.

#[cfg(feature = "cli")]
mod cli;
mod experiment;
mod forces;
mod golden;
#[cfg(feature = "gui-tests")]
mod gpu;
mod map;
mod misprints;
mod properties;
#[cfg(feature = "gui-tests")]
mod render;
mod reproducible;
#[cfg(feature = "gui-tests")]
mod shaders;
mod support;
