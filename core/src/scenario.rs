//! What a person sets, and what it comes to.
//!
//! Reading order: [`inputs`] (the values, as written in TOML), [`text`] (reading them and saying what is wrong where), [`plan`] (the
//! same, validated and resolved: what follows cannot fail), [`motion`] (the commanded bend), [`preset`].

pub mod inputs;
pub mod motion;
pub mod plan;
pub mod preset;
pub mod text;

pub use inputs::*;
pub use plan::{Plan, ScenarioError};
