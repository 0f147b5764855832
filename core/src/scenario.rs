//! What a person sets, and what it comes to.
//!
//! Reading order: [`inputs`] (the values, as written in TOML), [`keys`] (the table of them: what each means and may be),
//! [`text`] (reading them), [`overrides`] (one setting in place of another), [`refusal`] (what is wrong where), [`plan`] (the
//! same, validated and resolved: what follows cannot fail), [`motion`] (the commanded bend), [`true_robot`] (what it truly
//! comes to), [`preset`], [`link`] (a scenario in the address of a page), [`chain`]
//! (one configuration of several segments).

pub mod chain;
pub mod inputs;
pub mod keys;
pub mod link;
pub mod motion;
pub mod overrides;
pub mod plan;
pub mod preset;
pub mod refusal;
pub mod text;
pub mod true_robot;

pub use chain::{ChainError, ChainPlan, ChainScenario, ChainSetup};
pub use inputs::*;
pub use overrides::Override;
pub use plan::Plan;
pub use refusal::{Refused, ScenarioError};
pub use true_robot::TrueRobot;
