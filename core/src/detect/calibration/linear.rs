//! The free robot at one command, linear in the errors of its calibration.

use super::{Columns, Command, DRIFT, STATES, Six, States};
use crate::model::orientation::from_vector;
use crate::model::special::Angle;
use crate::model::{Mat3, Pose, Vec3};
use libm::sincos;

/// The pose that a model expects, and what each error of the calibration changes in it.
///
/// Residuals are taken along the axes of the bending plane: the angle about the bending axis (rad), position toward the bend and
/// along the straight backbone (m), position along the bending axis (m), and the rotation about the other two axes (rad).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear {
    /// The pose expected, in {B}.
    pub pose: Pose,
    /// Axes of the bending plane in {B}, as columns: toward the bend, the bending axis, along the straight backbone.
    pub axes: Mat3,
    /// Bend of the model, rad.
    pub bend: f64,
    /// ∂residual/∂η, in units of the errors themselves.
    pub by_error: Columns,
    /// ∂residual/∂φ: m/rad and 1.
    pub by_bend: Six,
}

/// The errors that are no longer zero where a model is linearised, in their own units.
pub type Errors = [f64; STATES];

impl Linear {
    /// The nominal model of a segment `length` m long.
    #[must_use]
    pub fn nominal(length: f64, command: &Command) -> Self {
        Self::at(length, command, &[0.0; STATES])
    }

    /// The model with these errors of calibration.
    #[must_use]
    pub fn at(length: f64, command: &Command, errors: &Errors) -> Self {
        let translation = Vec3::new(errors[0], errors[1], errors[2]);
        let turn = from_vector(&Vec3::new(errors[3], errors[4], errors[5]));
        let [stretch, scale, offset, across, latency] = [errors[6], errors[7], errors[8], errors[9], errors[10]];
        // To first order in the latency: what is left out is a bend, which is free.
        let commanded = command.bend - latency * command.rate;
        let bend = (1.0 + scale) * commanded + offset;
        let (sd, cd) = sincos(command.delta + across);
        let plane = Mat3::new(cd, sd, 0.0, -sd, cd, 0.0, 0.0, 0.0, 1.0);
        let axes = turn * plane;
        let length = length * (1.0 + stretch);
        let angle = Angle::new(bend);
        let (sin, cos) = (angle.sine(), angle.cosine());
        let (x, z) = (length * bend * angle.versinc(), length * angle.sinc());
        let (dx, dz) = (length * angle.versine_ratio_slope(), -length * angle.sinc_drop());
        let within = Mat3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos);
        let arm = axes * Vec3::new(x, 0.0, z);
        let by_bend = Six::new(1.0, dx, dz, 0.0, 0.0, 0.0);
        let mut by_error = Columns::zeros();
        for axis in 0..3 {
            let along = axes.row(axis);
            let shift = [0.0, along[0], along[2], along[1], 0.0, 0.0];
            by_error.set_column(axis, &Six::from(shift));
            by_error.set_column(DRIFT + axis, &Six::from(shift));
            let moved = axes.tr_mul(&Vec3::ith(axis, 1.0).cross(&arm));
            by_error.set_column(3 + axis, &Six::new(along[1], moved.x, moved.z, moved.y, along[0], along[2]));
        }
        let shape = length / (1.0 + stretch);
        by_error.set_column(6, &(Six::new(0.0, x, z, 0.0, 0.0, 0.0) * (shape / length)));
        by_error.set_column(7, &(by_bend * commanded));
        by_error.set_column(8, &by_bend);
        by_error.set_column(9, &Six::new(0.0, 0.0, 0.0, -x, sin, cos - 1.0));
        by_error.set_column(10, &(by_bend * (-(1.0 + scale) * command.rate)));
        let pose = Pose { position: arm + translation, rotation: axes * within * plane.transpose() };
        Self { pose, axes, bend, by_error, by_bend }
    }

    /// How a reading differs from what is expected.
    #[must_use]
    pub fn residual(&self, reading: &Pose) -> Six {
        super::course::residual(&self.pose, &self.axes, reading)
    }
}

/// A vector of errors in their own units.
#[must_use]
pub fn errors(states: &States, deviations: &[f64; STATES]) -> Errors {
    std::array::from_fn(|i| states[i] * deviations[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_derivatives() {
        let command = Command { time: 0.0, bend: 0.8, rate: 0.6, delta: 0.4 };
        for start in [[0.0; STATES], std::array::from_fn(|i| if i < DRIFT { 0.003 * (i as f64 - 4.0) } else { 0.0 })] {
            let linear = Linear::at(0.03, &command, &start);
            assert!(linear.residual(&linear.pose).norm() < 1e-15);
            for i in 0..DRIFT {
                let step = 1e-6;
                let mut moved = start;
                moved[i] += step;
                let by = linear.residual(&Linear::at(0.03, &command, &moved).pose) / step;
                // At errors of a degree the columns of the rotation are those of a rotation that is small.
                let room = if start[i] == 0.0 && i != 4 { 3e-6 } else { 0.02 };
                assert!((by - linear.by_error.column(i)).amax() < room, "{i}: {by} {}", linear.by_error.column(i));
            }
        }
    }
}
