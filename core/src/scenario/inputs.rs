//! What a person sets: one struct, written as TOML, in SI units and radians.
//!
//! Every default is the paper's, or is marked *illustrative* where the paper gives none.

mod calibration;
mod choice;
mod contact;
mod detection;
mod estimation;
mod prior;

pub use calibration::{Calibration, Draw};
pub use choice::{Choice, Listed};
pub use contact::{Contact, ContactKind, Place, Start};
pub use detection::{Arming, Detectors, Method, Off, Threshold, Thresholds, Xi1Rule};
pub use estimation::{Estimation, EstimationKind, Estimator, Kind};
pub use prior::{Auto, Estimated, Prior};

use crate::model::Segment;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// A whole experiment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// Rate of the control loop, in which readings are taken, filtered and judged, Hz.
    pub loop_rate: f64,
    /// Seed of all noise (illustrative).
    pub seed: u64,
    /// The segment.
    pub robot: Robot,
    /// The commanded motion.
    pub motion: Motion,
    /// What the backbone meets.
    pub contact: Contact,
    /// The tracker on the end disk.
    pub tracker: Tracker,
    /// The load cells on the secondary backbones.
    pub load_cells: LoadCells,
    /// The wrench on the end disk.
    pub load: Load,
    /// How the true robot differs from its model.
    pub calibration: Calibration,
    /// The moving average over the tracker's readings.
    pub filter: Filter,
    /// Thresholds and arming.
    pub detection: Thresholds,
    /// How a contact is placed.
    pub estimation: Estimation,
    /// What a calibration filter takes for granted.
    pub prior: Prior,
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            loop_rate: 1000.0,
            seed: 1,
            robot: Robot::default(),
            motion: Motion::default(),
            contact: Contact::default(),
            tracker: Tracker::default(),
            load_cells: LoadCells::default(),
            load: Load::default(),
            calibration: Calibration::default(),
            filter: Filter::default(),
            detection: Thresholds::default(),
            estimation: Estimation::default(),
            prior: Prior::default(),
        }
    }
}

/// The segment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Robot {
    /// Length L of the primary backbone, m.
    pub length: f64,
    /// Radius r of the pitch circle, m (illustrative).
    pub pitch_radius: f64,
    /// Arc lengths of the spacer disks, from the base up, m.
    pub disks: Vec<f64>,
    /// The primary backbone (dimensions illustrative).
    pub primary: Tube,
    /// Each of the three secondary backbones (dimensions illustrative).
    pub secondary: Tube,
}

impl Default for Robot {
    fn default() -> Self {
        Self {
            length: 0.030,
            pitch_radius: 0.003,
            disks: vec![0.0075, 0.015, 0.0225],
            primary: Tube::default(),
            secondary: Tube::default(),
        }
    }
}

impl Robot {
    /// The model's segment.
    #[must_use]
    pub fn segment(&self) -> Segment {
        Segment {
            length: self.length,
            pitch_radius: self.pitch_radius,
            ep_ip: self.primary.bending_stiffness(),
            es_is: self.secondary.bending_stiffness(),
        }
    }
}

/// A superelastic tube.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tube {
    /// Outer diameter, m (illustrative).
    pub outer_diameter: f64,
    /// Inner diameter, m; 0 is a wire (illustrative).
    pub inner_diameter: f64,
    /// Young's modulus, Pa (illustrative: austenitic NiTi).
    pub youngs_modulus: f64,
}

impl Default for Tube {
    fn default() -> Self {
        Self { outer_diameter: 0.889e-3, inner_diameter: 0.762e-3, youngs_modulus: 58.0e9 }
    }
}

impl Tube {
    /// E·I, N·m².
    #[must_use]
    pub fn bending_stiffness(&self) -> f64 {
        let fourth = |d: f64| (d * d) * (d * d);
        self.youngs_modulus * PI / 64.0 * (fourth(self.outer_diameter) - fourth(self.inner_diameter))
    }
}

/// A fifth-order rest-to-rest motion of θL in a fixed bending plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Motion {
    /// θL before the motion, rad; π/2 is straight.
    pub theta_start: f64,
    /// θL after it, rad.
    pub theta_end: f64,
    /// Bending-plane angle δ, rad (illustrative).
    pub delta: f64,
    /// When the motion starts, s.
    pub start: f64,
    /// When it is finished, s.
    pub finish: f64,
    /// When the run ends, s (illustrative).
    pub end: f64,
}

impl Default for Motion {
    fn default() -> Self {
        Self { theta_start: FRAC_PI_2, theta_end: 0.0, delta: 0.0, start: 3.0, finish: 8.0, end: 10.0 }
    }
}

/// The tracker: position and Euler angles of a marker on the end disk, refreshed slower than the loop reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tracker {
    /// Refresh rate, Hz; the loop holds the last reading.
    pub rate: f64,
    /// Standard deviation of white noise on each coordinate of a reading, m (default none: illustrative).
    pub position_noise: f64,
    /// Standard deviation of the white noise that turns the marker about each axis of {B}, rad (default none: illustrative).
    pub orientation_noise: f64,
    /// Coordinates are rounded to multiples of this, m; 0 does not round (default 0: illustrative).
    pub position_resolution: f64,
    /// Angles are rounded to multiples of this, rad; 0 does not round (default 0: illustrative).
    pub orientation_resolution: f64,
    /// Age of a reading when it arrives, s (illustrative).
    pub latency: f64,
    /// How the marker is mounted: R̃_g (illustrative).
    pub mounting: Mounting,
}

impl Default for Tracker {
    fn default() -> Self {
        Self {
            rate: 100.0,
            position_noise: 0.0,
            orientation_noise: 0.0,
            position_resolution: 0.0,
            orientation_resolution: 0.0,
            latency: 0.0,
            mounting: Mounting::BendingAxis,
        }
    }
}

/// The constant rotation R̃_g between the marker and the end disk's frame {G}.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mounting {
    /// The marker's x axis lies along the bending axis: bending is pure roll, far from the Euler singularity.
    BendingAxis,
    /// The marker's frame is {G}: azimuth–elevation–roll is singular at 90° of bend toward x.
    Aligned,
}

/// The load cells on the three secondary backbones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LoadCells {
    /// Relative error ε_τ: τ_lc,i = τ_i/(1 − ε_i). The paper estimates 10 %.
    pub epsilon_tau: f64,
    /// What ε_τ says about the three ε_i (the paper has them in common).
    pub errors: CellErrors,
    /// Standard deviation of white noise on each reading, N (default none: illustrative).
    pub noise: f64,
    /// Force added to all three backbones alike, N (default none: illustrative).
    pub preload: f64,
}

impl Default for LoadCells {
    fn default() -> Self {
        Self { epsilon_tau: 0.10, errors: CellErrors::Common, noise: 0.0, preload: 0.0 }
    }
}

/// How the relative errors of the three load cells are related.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CellErrors {
    /// All three are ε_τ (Eq. 13): the residual stays within Eq. 16.
    Common,
    /// Each is drawn from the seed, evenly between −ε_τ and ε_τ: the residual grows with the preload.
    Independent,
}

/// A wrench on the end disk (Eq. 11) that ramps up in proportion to time and stays; it does not move the robot,
/// whose joints hold their positions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Load {
    /// Force at the end disk's centre once it is whole, in {B}, N (default none: illustrative).
    pub force: [f64; 3],
    /// Moment once it is whole, in {B}, N·m (default none: illustrative).
    pub moment: [f64; 3],
    /// When it begins to grow, s (illustrative).
    pub start: f64,
    /// When it is whole, s (illustrative).
    pub finish: f64,
}

impl Default for Load {
    fn default() -> Self {
        Self { force: [0.0; 3], moment: [0.0; 3], start: 8.5, finish: 9.5 }
    }
}

/// The moving average over the tracker's readings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Filter {
    /// N, in loop samples; 1 does not filter.
    pub length: u64,
    /// What is averaged.
    pub averaging: Averaging,
}

impl Default for Filter {
    fn default() -> Self {
        Self { length: 500, averaging: Averaging::Readings }
    }
}

/// How orientations are averaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Averaging {
    /// The three Euler angles, one by one, as in the paper.
    Readings,
    /// The rotations themselves, on SO(3) (the normalised mean quaternion): no singular orientation.
    Rotations,
}
