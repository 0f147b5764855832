//! The interface: views of a run that emit commands.

pub mod command;
pub mod notation;
pub mod plane;
pub mod plots;
pub mod theme;
