//! What is measured of the robot: truth in, readings out.

pub mod cells;
pub mod tracker;
