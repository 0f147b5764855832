//! Integration tests: one binary, one module per subject.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "tests read files, run programs and wait for them"
)]

mod bounds;
mod calibration;
mod calibration_filter;
mod chain;
#[cfg(feature = "cli")]
mod chain_command;
#[cfg(feature = "cli")]
mod chain_log_refusals;
#[cfg(feature = "cli")]
mod chain_logs;
mod chain_properties;
mod chain_run;
#[cfg(feature = "cli")]
mod cli;
mod compare;
mod compare_command;
mod contact_force;
mod detectors;
#[cfg(feature = "cli")]
mod documented;
mod edges;
#[cfg(feature = "cli")]
mod example_logs;
mod examples;
mod experiment;
#[cfg(feature = "cli")]
mod figure;
#[cfg(all(feature = "cli", unix))]
mod files;
mod fingerprints;
mod forces;
mod fuzz;
mod golden;
#[cfg(feature = "gui-tests")]
mod gpu;
mod grey;
#[cfg(feature = "cli")]
mod icons;
mod keys;
mod link;
#[cfg(feature = "cli")]
mod link_command;
#[cfg(feature = "cli")]
mod log_formats;
#[cfg(feature = "cli")]
mod logs;
#[cfg(feature = "cli")]
mod mangled;
mod map;
#[cfg(feature = "cli")]
mod map_command;
mod misprints;
mod monitor;
mod paper;
mod properties;
mod released;
#[cfg(feature = "gui-tests")]
mod render;
mod reproducible;
mod shares;
#[cfg(all(feature = "cli", unix))]
mod shares_command;
#[cfg(feature = "cli")]
mod study_command;
mod support;
mod table2;
mod touch;
mod tuning;
