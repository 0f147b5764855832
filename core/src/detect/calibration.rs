//! A detector that believes no calibration: a Kalman filter estimates the errors of the robot's model from the readings, and a contact is
//! what these errors cannot explain.
//!
//! Reading k differs from the pose that the nominal model expects at the command by r_k = J_k η + Δ_k + n_k: errors η of the
//! calibration ([`linear`]), the contact's own [`signature`] Δ_k, and noise. The [`filter`] turns residuals into innovations ν_k, white and
//! of unit covariance as long as nothing touches; its gains do not depend on the readings, so a [`course`] of commands has them once
//! for all repeats. A signature sent through the same filter is what a contact adds to the innovations. On that rest
//! [`cusum`] and [`glr`], which notice a contact, [`marginal`], which places it, and the [`bound`]s on both.
//!
//! Vectors of six have the order of [`linear::Linear`]: first the angle in the bending plane, which carries the freedom of the bend, then the
//! position, then what is out of the plane. States are in units of their prior standard deviations.

pub mod bound;
pub mod course;
pub mod cusum;
pub mod ensemble;
pub mod filter;
pub mod glr;
pub mod jointly;
pub mod likelihood;
pub mod linear;
pub mod marginal;
pub mod monitor;
pub mod noise;
pub mod release;
pub mod sheet;
pub mod signature;
pub mod watched;

use nalgebra::{SMatrix, SVector};

/// Errors of the calibration: translation (3) and rotation (3) of the tracker's frame, relative error of L, scale and offset of the
/// bend, offset of δ, latency, and the drift of the tracker (3).
pub const STATES: usize = 14;
/// The relative error of L among them.
pub const STRETCH: usize = 6;
/// The relative error of the bend.
pub const SCALE: usize = 7;
/// The offset of the bend.
pub const OFFSET: usize = 8;
/// The offset of δ.
pub const ACROSS: usize = 9;
/// The latency.
pub const LATE: usize = 10;
/// Where the drift begins among them.
pub const DRIFT: usize = 11;

/// A residual or innovation.
pub type Six = SVector<f64, 6>;
/// Errors, in units of their prior standard deviations.
pub type States = SVector<f64, STATES>;
/// Residuals by errors.
pub type Columns = SMatrix<f64, 6, STATES>;

/// What is believed of a robot before its first reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Belief {
    /// Prior standard deviation of each error: m, rad, 1, 1, rad, rad, s, m. One of 0 is taken for known.
    pub deviations: [f64; STATES],
    /// Standard deviation q (rad) of each reading's own bend: play and actuation cannot alarm.
    pub free_bend: f64,
    /// Correlation time of the drift, s.
    pub drift_time: f64,
}

impl Default for Belief {
    /// 1 mm, 1°, 2 %, 2 %, 1°, 2°, 10 ms; q = 2°; no drift.
    fn default() -> Self {
        let degree = std::f64::consts::PI / 180.0;
        let (mm, turn) = (1e-3, degree);
        Self {
            deviations: [mm, mm, mm, turn, turn, turn, 0.02, 0.02, degree, 2.0 * degree, 0.010, 0.0, 0.0, 0.0],
            free_bend: 2.0 * degree,
            drift_time: 1.0,
        }
    }
}

/// Noise of the tracker's readings.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Noise {
    /// Standard deviation on each coordinate, m.
    pub position: f64,
    /// Standard deviation of the rotation about each axis, rad.
    pub orientation: f64,
    /// Correlation ρ of successive readings, in [0, 1): noise of first order.
    pub colour: f64,
}

/// What the robot was told when the tracker took a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// When the reading was taken, s.
    pub time: f64,
    /// Commanded bend φ then, rad.
    pub bend: f64,
    /// Its rate, rad/s.
    pub rate: f64,
    /// Bending-plane angle δ, rad.
    pub delta: f64,
}
