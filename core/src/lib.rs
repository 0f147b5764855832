//! The core of Centrode: a continuum robot, what sensors see of it, and how a contact is detected from that.
//!
//! Pure: no files, no clock, no threads, no global random numbers; the same inputs give the same bits on every machine.
//!
//! SI units and radians inside; millimetres and degrees exist only where a person reads or types.
//! Base frame {B}: origin at the base disk's centre, `z` along the straight backbone, `x` through backbone 1.
//!
//! | quantity | equation | function |
//! | --- | --- | --- |
//! | joint values, their Jacobian and inverse | 2 | [`model::joints`] |
//! | pose p(s), R(s) | 3, 4 | [`model::Arc::pose`] |
//! | Jacobian J_xψ(s), twist | 7–9 | [`model::Arc::jacobian`], [`model::Jacobian::twist`] |
//! | energy and gradient | 10 | [`model::Segment::energy`], [`model::Segment::energy_gradient`] |
//! | joint forces | 11 | [`model::Segment::joint_forces`] |
//! | joint force deviation Θ | 12 | [`model::Segment::residual`] |
//! | load cell error | 13–15 | [`sensors::cells`] |
//! | detectability bound ε_c | 16 | [`model::Segment::common_error_bound`], [`model::Segment::independent_error_bound`] |
//! | fixed centrode | 17, 18 | [`model::centrode::centrode`], [`model::Jacobian::centrode`] |
//! | detection by fixed centrode deviation | 19 | [`detect::Method`] |
//! | constrained segment and its centrode | 20–23 | [`model::Constrained`] |
//! | location of the contact | 24 | [`model::locate`] |
//! | Figures 3, 4, 6, 7, 8 | | [`study::figure`] |
//! | Table II | | [`study::table2`] |
//! | which contacts are detectable | 16, 19 | [`study::map`] |
//! | false alarms, delay, which threshold to take | | [`study::tuning`] |
//! | charts of all these, as data | | [`chart`] |
//!
//! Read [`model`], then [`scenario`], [`plant`], [`sensors`], [`detect`], then [`study`]. Where the printed equations are wrong, `docs/MODEL.md` says how, and
//! `tests/it/misprints.rs` shows it.

pub mod chart;
pub mod detect;
pub mod fingerprints;
pub mod model;
pub mod plant;
pub mod record;
pub mod run;
pub mod scenario;
pub mod sensors;
pub mod study;
