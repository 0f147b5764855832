//! With a tracker on the last end disk alone: its screw motion against that of the whole chain.

use super::whole::watch::Watch;
use super::{ChainEvent, ChainMethod, ChainSettings, screw_events};
use crate::detect::Method;
use crate::detect::evidence::Judgement;
use crate::detect::filter::{FilteredMotion, PoseFilter};
use crate::detect::latch::{Latch, Turn};
use crate::model::centrode::centrode;
use crate::model::chain::{bends, free};
use crate::model::orientation::to_euler;
use crate::model::{Configuration, Pose, Vec3};
use crate::record::chain::ChainRecording;
use crate::sensors::tracker::{Reading, refresh, unwrapped};

/// What is made of an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    pub judgement: Judgement,
    /// How the last end disk moves in {B}, by the model and by the tracker, filtered alike.
    pub motions: [FilteredMotion; 2],
}

impl Seen {
    const UNDEFINED: Self =
        Self { judgement: Judgement::UNDEFINED, motions: [FilteredMotion::UNDEFINED, FilteredMotion::UNDEFINED] };
}

/// What is made of every instant of a recording: the screw motion deviation of the last end disk, and the cumulative sum of the whole chain's
/// calibration filter. What other detectors see rests on the motion of a segment by itself, which nobody measures.
pub(super) fn seen(recording: &ChainRecording, settings: &ChainSettings, watch: Option<&Watch>) -> Vec<Seen> {
    let sum = |time: f64| watch.and_then(|watch| Some(watch.sums[watch.at(time)?])).unwrap_or(f64::NAN);
    let mut seen = screws(recording, settings);
    seen.resize(recording.times.len(), Seen::UNDEFINED);
    for (seen, &time) in seen.iter_mut().zip(&recording.times) {
        seen.judgement.cusum = sum(time);
    }
    seen
}

/// The screw motion deviation; empty where it does not judge.
fn screws(recording: &ChainRecording, settings: &ChainSettings) -> Vec<Seen> {
    let (Some(_), Some(own)) = (&settings.smd, settings.segments.last()) else { return Vec::new() };
    let Some(readings) = recording.readings.last().and_then(Option::as_ref) else { return Vec::new() };
    let mut filters = [0, 1].map(|_| PoseFilter::new(&own.filter, own.loop_rate));
    let mut model = Model { recording, settings, held: None };
    let mut whole = 0;
    let seen = recording.times.iter().zip(readings).enumerate().map(|(k, (&time, reading))| {
        if reading.position.x.is_nan() {
            filters = [0, 1].map(|_| PoseFilter::new(&own.filter, own.loop_rate));
            whole = 0;
            return Seen::UNDEFINED;
        }
        whole = own.filter.length.min(whole + 1);
        let expected = model.reading(k, time);
        let [sensor, ours] = [filters[0].push(reading), filters[1].push(&expected)];
        if whole < own.filter.length {
            return Seen::UNDEFINED;
        }
        Seen { judgement: judgement(&sensor, &ours), motions: [ours, sensor] }
    });
    seen.collect()
}

/// The events of both.
pub(super) fn events(seen: &[Seen], recording: &ChainRecording, settings: &ChainSettings) -> Vec<ChainEvent> {
    let Some(own) = settings.segments.last() else { return Vec::new() };
    let each = || recording.times.iter().copied().zip(seen.iter().map(|seen| seen.judgement));
    let screws = settings.smd.map(|smd| screw_events(recording.segments() - 1, each(), own, &smd));
    let mut events = screws.unwrap_or_default();
    events.extend(alarms(each(), recording, settings));
    events
}

/// The events of the cumulative sum over the innovations of the whole chain's calibration filter.
fn alarms(
    judgements: impl Iterator<Item = (f64, Judgement)>,
    recording: &ChainRecording,
    settings: &ChainSettings,
) -> Vec<ChainEvent> {
    let mut events: Vec<ChainEvent> = Vec::new();
    let Some(thresholds) = settings.segments.last().map(|own| &own.thresholds) else { return events };
    let Some(threshold) = thresholds.of(Method::Cusum).value() else { return events };
    let mut latch = Latch::default();
    for (time, Judgement { cusum: value, .. }) in judgements.filter(|(_, judgement)| !judgement.cusum.is_nan()) {
        let low = value <= thresholds.release * threshold;
        match latch.look(time, value > threshold, low, thresholds.hold).1 {
            Some(Turn::Raised) => events.push(ChainEvent {
                segment: recording.segments() - 1,
                detector: ChainMethod::Of(Method::Cusum),
                raised: time,
                cleared: None,
                value,
                threshold,
                angle: None,
            }),
            Some(Turn::Cleared) => {
                if let Some(last) = events.last_mut() {
                    last.cleared = Some(time);
                }
            }
            None => {}
        }
    }
    events
}

fn judgement(sensor: &FilteredMotion, model: &FilteredMotion) -> Judgement {
    let at = |motion: &FilteredMotion| centrode(&motion.position, &motion.twist);
    let consistent = match (at(sensor), at(model)) {
        (Some(sensor), Some(model)) => (sensor - model).norm(),
        _ => f64::NAN,
    };
    let turned = crate::detect::evidence::angle_between(&model.twist.angular, &sensor.twist.angular);
    Judgement { speed: sensor.twist.angular.norm(), consistent, turned, ..Judgement::UNDEFINED }
}

/// What the tracker would read if the chain stood as commanded.
struct Model<'a> {
    recording: &'a ChainRecording,
    settings: &'a ChainSettings,
    /// The refresh of the last reading, and the reading.
    held: Option<(f64, Reading)>,
}

impl Model<'_> {
    fn reading(&mut self, k: usize, time: f64) -> Reading {
        let clock = &self.settings.segments[self.settings.segments.len() - 1].clock;
        let refresh = refresh(clock.rate, time);
        if let Some((at, reading)) = self.held
            && at == refresh
        {
            return reading;
        }
        let taken = ((refresh / clock.rate).min(time) - clock.latency).max(0.0);
        let tip = self.tip(k, taken);
        let mut angles = to_euler(&(tip.rotation * clock.tip_from_marker));
        if let Some((_, before)) = &self.held {
            angles = [0, 1, 2].map(|k| unwrapped(angles[k], before.angles[k]));
        }
        let reading = Reading { position: tip.position, angles };
        self.held = Some((refresh, reading));
        reading
    }

    /// The last end disk as commanded at a time (s) not after entry `k`.
    fn tip(&self, k: usize, time: f64) -> Pose {
        let times = &self.recording.times[..=k];
        let after = times.partition_point(|at| *at <= time).min(k);
        let before = after.saturating_sub(1);
        let span = times[after] - times[before];
        let share = if span > 0.0 { ((time - times[before]) / span).clamp(0.0, 1.0) } else { 0.0 };
        let mut at = Pose { position: Vec3::zeros(), rotation: crate::model::Mat3::identity() };
        for (segment, told) in self.recording.told.iter().enumerate() {
            let [from, to] = [before, after].map(|k| bends(told[k].configuration));
            let configuration: Configuration = crate::model::chain::configuration(&(from + (to - from) * share));
            let length = self.settings.segments[segment].segment.length;
            let end = free::pose(length, configuration);
            at = Pose { position: at.position + at.rotation * end.position, rotation: at.rotation * end.rotation };
        }
        at
    }
}
