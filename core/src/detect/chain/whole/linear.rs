//! The last end disk of a free chain at one instant, linear in the errors of the calibration of all segments.

use super::{Model, residual, six};
use crate::detect::calibration::{Command, Six};
use crate::model::chain::{Bends, free};
use crate::model::orientation::from_vector;
use crate::model::{Configuration, Pose, Vec3};
use nalgebra::{DVector, Dyn, OMatrix, U6};

/// A residual by each error.
pub type Wide = OMatrix<f64, U6, Dyn>;

/// Errors of the tracker's frame (translation, rotation) and its latency, and then so many of each segment.
pub const FRAME: usize = 7;
pub const LATENCY: usize = 6;
pub const OWN: usize = 5;

/// An error of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Own {
    /// Relative, of its length.
    Stretch,
    /// Relative, of its bend.
    Scale,
    /// Of its bend, rad.
    Offset,
    /// Of its bending-plane angle δ, rad.
    Across,
    /// Of its bend, rad, and not always the same.
    Play,
}

impl Own {
    /// Its place among all errors.
    pub fn of(self, segment: usize) -> usize {
        FRAME + OWN * segment + self as usize
    }
}

/// What all segments were told when the tracker took a reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// When, s.
    pub time: f64,
    /// Of each segment.
    pub commands: Vec<Command>,
    /// δ̇ of each segment, rad/s.
    pub turning: Vec<f64>,
    /// What is added to the variance of each segment's play since the reading before, where it may be taken up, in units of its square.
    pub taken_up: Vec<f64>,
}

/// The pose that a model expects, and what each error changes in it, along the axes of {B}.
#[derive(Debug, Clone)]
pub struct Linear {
    pub pose: Pose,
    pub by_error: Wide,
}

impl Moment {
    /// The configuration of a segment that has these errors.
    pub fn configuration(&self, segment: usize, errors: &DVector<f64>) -> Configuration {
        let (command, own) = (&self.commands[segment], |own: Own| errors[own.of(segment)]);
        let told = command.bend - errors[LATENCY] * command.rate;
        let bend = (1.0 + own(Own::Scale)) * told + own(Own::Offset) + own(Own::Play);
        Configuration::new(bend, command.delta + own(Own::Across) - errors[LATENCY] * self.turning[segment])
    }
}

impl Linear {
    /// A chain with these errors, in their own units.
    pub fn at(model: &Model, moment: &Moment, errors: &DVector<f64>) -> Self {
        let segments = model.lengths.len();
        let configurations: Vec<_> = (0..segments).map(|segment| moment.configuration(segment, errors)).collect();
        let lengths: Vec<f64> =
            (0..segments).map(|segment| model.lengths[segment] * (1.0 + errors[Own::Stretch.of(segment)])).collect();
        let turn = from_vector(&Vec3::new(errors[3], errors[4], errors[5]));
        let disks = free::free(&lengths, &configurations);
        let mut by_error = Wide::zeros(model.states());
        let Some(tip) = disks.last() else {
            return Self { pose: Pose { position: Vec3::zeros(), rotation: turn }, by_error };
        };
        let arm = turn * tip.pose.position;
        for axis in 0..3 {
            let along = Vec3::ith(axis, 1.0);
            by_error.set_column(axis, &six(&along, &Vec3::zeros()));
            by_error.set_column(model.drift() + axis, &six(&along, &Vec3::zeros()));
            by_error.set_column(3 + axis, &six(&along.cross(&arm), &along));
        }
        let mut late = Six::zeros();
        for (segment, configuration) in configurations.iter().enumerate() {
            let command = &moment.commands[segment];
            let (sin, cos) = configuration.sin_cos_delta();
            let by = |bends: Bends| {
                let twist = tip.by_bends[segment][0] * bends.x + tip.by_bends[segment][1] * bends.y;
                six(&(turn * twist.linear), &(turn * twist.angular))
            };
            let (bending, turning) = (by(Bends::new(sin, cos)), by(Bends::new(cos, -sin) * configuration.bend()));
            let base = segment.checked_sub(1).map_or_else(Vec3::zeros, |below| disks[below].pose.position);
            let stretched = (disks[segment].pose.position - base) / (lengths[segment] / model.lengths[segment]);
            let mut set = |own: Own, column: Six| by_error.set_column(own.of(segment), &column);
            let scale = 1.0 + errors[Own::Scale.of(segment)];
            set(Own::Stretch, six(&(turn * stretched), &Vec3::zeros()));
            set(Own::Scale, bending * (command.bend - errors[LATENCY] * command.rate));
            set(Own::Offset, bending);
            set(Own::Across, turning);
            set(Own::Play, bending);
            late -= bending * (scale * command.rate) + turning * moment.turning[segment];
        }
        by_error.set_column(LATENCY, &late);
        let translation = Vec3::new(errors[0], errors[1], errors[2]);
        let pose = Pose { position: arm + translation, rotation: turn * tip.pose.rotation };
        Self { pose, by_error }
    }

    /// How a reading differs from what is expected.
    pub fn residual(&self, reading: &Pose) -> Six {
        residual(&self.pose, reading)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::calibration::{Belief, Noise};

    #[test]
    fn columns_are_derivatives() {
        let noise = Noise { position: 1e-4, orientation: 1e-4, colour: 0.0 };
        let model = Model { lengths: vec![0.03, 0.02], beliefs: vec![Belief::default(); 2], noise };
        let command = |bend, rate, delta| Command { time: 0.0, bend, rate, delta };
        let commands = vec![command(0.8, 0.6, 0.4), command(-0.5, 0.3, 1.1)];
        let moment = Moment { time: 0.0, commands, turning: vec![0.2, -0.4], taken_up: vec![0.0; 2] };
        let start = DVector::from_fn(model.states(), |i, _| {
            if (3..6).contains(&i) || i >= model.drift() { 0.0 } else { 0.004 * (i as f64 - 8.0) / 8.0 }
        });
        let linear = Linear::at(&model, &moment, &start);
        for i in 0..model.drift() {
            let step = 1e-6;
            let mut moved = start.clone();
            moved[i] += step;
            let by = linear.residual(&Linear::at(&model, &moment, &moved).pose) / step;
            assert!((by - linear.by_error.column(i)).amax() < 3e-6, "{i}: {by} {}", linear.by_error.column(i));
        }
    }
}
