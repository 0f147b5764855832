//! The parts of the page.

pub mod chip;
pub mod columns;
pub mod cover;
pub mod gallery;
pub mod log;
pub mod menu;
pub mod notice;
pub mod readout;
pub mod save;
pub mod share;
pub mod sheet;
pub mod tabs;
pub mod title;
pub mod transport;
pub mod views;
