//! Joint values of concentric backbones as commands of each segment.

use super::super::gather::Track;
use super::super::report::{Happening, Place};
use super::{Log, LogError};
use crate::model::Vec3;
use crate::model::chain::joints::configurations_from_joints;
use crate::scenario::ChainScenario;
use crate::sensors::tracker::unwrapped;

/// Joints of three segments that could be numbered either way are numbered so that those of a segment add up to nothing. Says so
/// where that is not as they were read.
pub fn settle(logs: &mut [(usize, Log)]) -> Option<String> {
    let whole = logs.len() == 3 && logs.iter().all(|(_, log)| log.joints.len() == logs[0].1.joints.len());
    if !whole {
        return None;
    }
    let rows = || (0..logs[0].1.joints.len()).map(|row| [0, 1, 2].map(|k| logs[k].1.joints.values[row]));
    let rest = |turned: bool| -> f64 {
        let sum = |q: &[[f64; 3]; 3], k: usize| (0..3).map(|m| if turned { q[m][k] } else { q[k][m] }).sum::<f64>();
        rows().map(|q| (0..3).map(|k| sum(&q, k) * sum(&q, k)).sum::<f64>()).sum()
    };
    if rest(false) <= rest(true) {
        return None;
    }
    let turned: Vec<[[f64; 3]; 3]> = rows().map(|q| [0, 1, 2].map(|k| [0, 1, 2].map(|m: usize| q[m][k]))).collect();
    for (k, (_, log)) in logs.iter_mut().enumerate() {
        log.joints.values = turned.iter().map(|q| q[k]).collect();
    }
    Some("the last number of a joint is the segment's: so the joints of each segment add up to nothing".into())
}

/// Puts commands in the place of joint values.
///
/// # Errors
/// When a segment below one with joint values has none.
pub fn resolve(logs: &mut [Log], scenario: &ChainScenario) -> Result<(), LogError> {
    let Some(last) = logs.iter().rposition(|log| !log.joints.is_empty()) else { return Ok(()) };
    if let Some(lacks) = logs[..last].iter().position(|log| log.joints.is_empty()) {
        let what = format!(
            "holds joint values of segment {} and none of segment {}, through which its backbones run",
            last + 1,
            lacks + 1
        );
        return Err(LogError::file(what));
    }
    let radii: Vec<f64> = scenario.segments.iter().map(|segment| segment.alone.segment().pitch_radius).collect();
    let offsets: Vec<f64> = scenario.segments.iter().map(|segment| segment.joint_offset).collect();
    let joints: Vec<Track<3>> = logs.iter_mut().map(|log| std::mem::take(&mut log.joints)).collect();
    for (k, log) in logs.iter_mut().enumerate().take(last + 1) {
        let own = &joints[k];
        let mut before = scenario.segments[k].motion().delta;
        let mut commands = Track { file: own.file.clone(), ..Track::default() };
        for (row, (&time, &line)) in own.times.iter().zip(&own.lines).enumerate() {
            let of = |j: usize| {
                let row =
                    if j == k { row } else { joints[j].times.partition_point(|at| *at <= time).checked_sub(1)? };
                // One pitch circle for all: joint values grow with its radius.
                joints[j].values.get(row).map(|q| Vec3::from(*q) * (radii[0] / radii[j]))
            };
            let Some(values) = (0..=k).map(of).collect::<Option<Vec<Vec3>>>() else {
                log.report.add(Happening::UndefinedCommand, Place::line(u64::from(line)), Some(time));
                continue;
            };
            let all = configurations_from_joints(radii[0], &offsets[..=k], &values);
            let Some(at) = all.last() else { continue };
            // Joint values of a straight segment say nothing of δ but by their rounding.
            before = if at.bend() < STRAIGHT { before } else { unwrapped(at.delta(), before) };
            commands.times.push(time);
            commands.lines.push(line);
            commands.values.push([at.bend(), before]);
        }
        log.commands = commands;
    }
    Ok(())
}

/// A bend below this, rad, is none.
const STRAIGHT: f64 = 1e-7;
