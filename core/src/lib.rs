//! The core of Centrode: a continuum robot, what sensors see of it, and how a contact is detected from that.
//!
//! Pure: no files, no clock, no threads, no global random numbers; the same inputs give the same bits on every machine.
//!
//! SI units and radians inside; millimetres and degrees exist only where a person reads or types.
//! Base frame {B}: origin at the base disk's centre, `z` along the straight backbone, `x` through backbone 1.
//!
//! The programs in `examples/` simulate and judge, judge a log, and tune a threshold.
//!
//! Read [`model`], then [`scenario`], [`plant`], [`sensors`], [`detect`], then [`study`]. The table in `README.md` says which
//! function holds which equation of the paper. Where the printed equations are wrong, `docs/MODEL.md` says how, and
//! `tests/it/misprints.rs` shows it.

pub mod chart;
pub mod detect;
pub mod fingerprints;
pub mod model;
pub mod noise;
pub mod plant;
pub mod record;
pub mod run;
pub mod scenario;
pub mod sensors;
pub mod study;
pub mod symbols;

/// The README's example is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
