//! Charts: the live plots, the bending plane, and what all of them share.

pub mod legend;
pub mod notation;
pub mod paint;
pub mod plane;
pub mod plots;
