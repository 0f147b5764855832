//! The parts of the page.

pub mod chip;
pub mod readout;
pub mod tabs;
pub mod title;
pub mod transport;
pub mod views;
