//! The interface without a browser: widgets found by their names, moved, and looked at.

mod pictures;
mod stages;
mod support;
mod tuning;
mod ui;
mod views;
