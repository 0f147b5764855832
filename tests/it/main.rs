//! Integration tests: one binary, one module per subject.

mod experiment;
mod golden;
mod misprints;
mod properties;
mod reproducible;
mod support;
