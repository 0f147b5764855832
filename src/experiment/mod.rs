//! The simulated experiment: a scenario in, every channel and every detection out.
//!
//! Reading order: [`scenario`] (the inputs, as written in TOML), [`plan`] (the same, validated and resolved),
//! [`motion`], [`plant`], [`tracker`] and [`cells`] (what the world does and what is measured of it),
//! [`filter`] and [`detector`] (what is concluded), [`run`] (the whole).
//!
//! The detector reads a stream of measurements and does not know where they came from.

pub mod cells;
pub mod detector;
pub mod filter;
pub mod motion;
pub mod noise;
pub mod orientation;
pub mod plan;
pub mod plant;
pub mod preset;
pub mod run;
pub mod scenario;
pub mod text;
pub mod tracker;

pub use detector::{Crossing, Detection, Method};
pub use plan::{Plan, ScenarioError};
pub use plant::Shape;
pub use run::{CHANNELS, Channel, Run, Sample, Simulation, simulate};
pub use scenario::Scenario;
