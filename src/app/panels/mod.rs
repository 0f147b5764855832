//! The parts of the page.

pub mod chip;
pub mod controls;
pub mod help;
pub mod readout;
pub mod row;
pub mod tabs;
pub mod title;
pub mod transport;
