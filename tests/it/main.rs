//! Integration tests: one binary, one module per subject.

#[cfg(feature = "cli")]
mod cli;
mod experiment;
mod golden;
mod misprints;
mod properties;
mod reproducible;
mod support;
