//! What is concluded from readings: the filter and both methods.
//!
//! The detector reads a stream of measurements and does not know where they came from.

pub mod detector;
pub mod filter;

pub use detector::{Crossing, Detection, Method};
