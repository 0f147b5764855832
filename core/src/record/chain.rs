//! Recordings of several segments: a tracker on every end disk, or on the last alone.

use crate::model::Configuration;
use crate::model::chain::path::Instant;
use crate::scenario::ChainPlan;
use crate::scenario::chain::Tracked;
use crate::sensors::tracker::{Reading, SimulatedTracker};

/// What a segment is told at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    /// The commanded configuration.
    pub configuration: Configuration,
    /// Its θ̇L and δ̇, rad/s.
    pub rates: [f64; 2],
}

/// An experiment with several segments as it was stored.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainRecording {
    /// The instants, s, in order.
    pub times: Vec<f64>,
    /// What every segment was told at each instant.
    pub told: Vec<Vec<Told>>,
    /// Readings of the trackers on the end disks, in {B}, as held, one list for each segment; none of a disk without a tracker.
    pub readings: Vec<Option<Vec<Reading>>>,
    /// The truth at each instant; none when a rig made the recording.
    pub truth: Option<Vec<Instant>>,
}

impl ChainRecording {
    /// The experiment of a plan, simulated.
    #[must_use]
    pub fn simulated(plan: &ChainPlan) -> Self {
        let scenario = plan.scenario();
        let segments = scenario.segments.len();
        let shared = &scenario.segments[0].alone;
        let mut trackers: Vec<Option<SimulatedTracker>> = (0..segments)
            .map(|place| {
                let carries = scenario.tracked == Tracked::All || place + 1 == segments;
                carries.then(|| SimulatedTracker::one_of(shared, &scenario.segments[place].alone))
            })
            .collect();
        let times: Vec<f64> = (0..plan.samples()).map(|k| plan.time(k)).collect();
        let mut told = vec![Vec::with_capacity(times.len()); segments];
        let mut readings: Vec<Option<Vec<Reading>>> =
            trackers.iter().map(|tracker| tracker.as_ref().map(|_| Vec::with_capacity(times.len()))).collect();
        let mut truth = Vec::with_capacity(times.len());
        for &time in &times {
            for (place, told) in told.iter_mut().enumerate() {
                let (configuration, rates) = plan.command(place, time);
                told.push(Told { configuration, rates });
            }
            for (place, (tracker, readings)) in trackers.iter_mut().zip(&mut readings).enumerate() {
                if let (Some(tracker), Some(readings)) = (tracker, readings) {
                    readings.push(tracker.read(time, |taken| plan.path().at(taken, &plan.bends(taken)).disks[place]));
                }
            }
            truth.push(plan.path().at(time, &plan.bends(time)));
        }
        Self { times, told, readings, truth: Some(truth) }
    }

    /// Number of segments.
    #[must_use]
    pub fn segments(&self) -> usize {
        self.told.len()
    }
}
