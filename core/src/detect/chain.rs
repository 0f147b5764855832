//! Contacts on segments in series: every end disk is judged by its motion relative to the one below it.
//!
//! Segments beyond the last contact keep their relative pose and twist exactly, those below deflect as well, often more: so **the
//! most distal segment that deviates carries the most distal contact**. That segment alone, seen from the end disk below it, is one segment on
//! a base that stays: the detectors and estimators of one segment hold for it as they are. With a tracker on the last end disk
//! alone, nothing is known of the segments by themselves: its motion is compared with that of the whole chain, whose calibration one filter
//! estimates.

mod contacts;
mod course;
mod elsewhere;
mod heard;
mod hypotheses;
mod relative;
mod tip;
mod whole;

use super::evidence::Judgement;
use super::filter::FilteredMotion;
use super::judge::{Judged, Settings, judge};
use super::latch::{Latch, Turn};
use super::statistic::Method;
use crate::model::chain::Torsion;
use crate::record::Recording;
use crate::record::chain::ChainRecording;
use crate::scenario::chain::{Smd, Tracked};
use crate::scenario::{ChainScenario, Threshold};

use whole::watch::Watch;

pub use contacts::{Along, ChainContactFound, ChainEstimate};
pub use relative::relative;

/// A detector of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChainMethod {
    /// One that judges a segment by itself.
    Of(Method),
    /// Screw motion deviation: distance and angle between the instantaneous screw axes of the end disk, as the tracker shows it and
    /// as the model has it, sampled, delayed and averaged alike.
    Smd,
}

impl ChainMethod {
    /// Its key in files and on the command line.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Of(method) => method.key(),
            Self::Smd => "smd",
        }
    }
}

/// What the segments of a chain are judged with.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainSettings {
    /// Of each segment alone.
    pub segments: Vec<Settings>,
    /// How each resists torsion.
    pub torsions: Vec<Torsion>,
    /// Which detectors judge besides the screw motion deviation.
    pub methods: Vec<Method>,
    /// Thresholds of the screw motion deviation; none where it does not judge.
    pub smd: Option<Smd>,
    /// Which end disks carry trackers.
    pub tracked: Tracked,
}

impl ChainSettings {
    /// The detectors that judge. With a tracker on the last end disk alone those do not that rest on the motion of a segment by itself.
    pub fn detectors(&self) -> impl Iterator<Item = ChainMethod> + '_ {
        let can = |method: &&Method| self.tracked == Tracked::All || **method == Method::Cusum;
        let methods = self.methods.iter().filter(can).map(|method| ChainMethod::Of(*method));
        methods.chain(self.smd.map(|_| ChainMethod::Smd))
    }

    /// Those of an experiment. Thresholds of likelihood ratios are raised by the logarithm of the number of segments, each of which can raise a false
    /// alarm.
    #[must_use]
    pub fn of(scenario: &ChainScenario) -> Self {
        let mut segments: Vec<Settings> =
            scenario.segments.iter().map(|segment| Settings::of(&segment.alone)).collect();
        let methods = segments.first().map_or_else(Vec::new, |first| first.thresholds.detectors.iter().collect());
        // The false alarms that a threshold is meant for are those of the whole robot.
        let more = libm::log(segments.len() as f64);
        for settings in &mut segments {
            for method in [Method::Cusum, Method::Glr] {
                let threshold = settings.thresholds.of_mut(method);
                *threshold = threshold.value().map_or(*threshold, |value| Threshold::On(value + more));
            }
        }
        if scenario.smd.is_some() {
            // The distance between the screw axes is that of their points nearest to the disk below: the centrodes.
            segments.iter_mut().for_each(|settings| settings.thresholds.detectors.set(Method::FcdConsistent, true));
        }
        let torsions = scenario.segments.iter().map(|segment| segment.torsion).collect();
        Self { segments, torsions, methods, smd: scenario.smd, tracked: scenario.tracked }
    }
}

/// An event of one detector on one end disk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainEvent {
    /// The segment whose end disk it is, from 0.
    pub segment: usize,
    /// The detector.
    pub detector: ChainMethod,
    /// When it was raised, s.
    pub raised: f64,
    /// When it was cleared, s; none while it stands at the end.
    pub cleared: Option<f64>,
    /// The value that raised it, SI: of the screw motion deviation the distance, m.
    pub value: f64,
    /// The threshold then, likewise.
    pub threshold: f64,
    /// Of the screw motion deviation: the angle between the axes, rad.
    pub angle: Option<f64>,
}

/// What is concluded from a recording of several segments.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainJudged {
    /// With what it was judged.
    pub settings: ChainSettings,
    /// What each segment showed in the frame of the end disk below it; empty with a tracker on the last end disk alone.
    pub relative: Vec<Recording>,
    /// What is concluded from each of these.
    pub segments: Vec<Judged>,
    /// With a tracker on the last end disk alone: what the calibration filter of the whole chain made of its readings.
    whole: Option<Watch>,
    /// Likewise: what is made of every instant.
    tip: Vec<tip::Seen>,
    /// The last instant of the recording, s.
    end: f64,
    /// Events of all detectors on all end disks, in the order in which they were raised.
    pub events: Vec<ChainEvent>,
}

/// Judges a recording. It does not look at the truth.
#[must_use]
pub fn judge_chain(recording: &ChainRecording, settings: &ChainSettings) -> ChainJudged {
    let relative: Vec<Recording> = match settings.tracked {
        Tracked::All => (0..recording.segments()).filter_map(|k| relative(recording, settings, k)).collect(),
        Tracked::Tip => Vec::new(),
    };
    let segments: Vec<Judged> =
        relative.iter().zip(&settings.segments).map(|(recording, settings)| judge(recording, settings)).collect();
    let mut events: Vec<ChainEvent> = Vec::new();
    for (segment, judged) in segments.iter().enumerate() {
        events.extend(of_methods(segment, judged, &settings.methods));
        if let Some(smd) = &settings.smd {
            let each = judged.evidence.iter().map(|evidence| evidence.judgement);
            let judgements = recording.times.iter().copied().zip(each);
            events.extend(screw_events(segment, judgements, &settings.segments[segment], smd));
        }
    }
    let watches = settings.tracked == Tracked::Tip && settings.methods.contains(&Method::Cusum);
    let whole = watches.then(|| Watch::new(recording, settings)).flatten();
    let mut tip = Vec::new();
    if settings.tracked == Tracked::Tip {
        tip = tip::seen(recording, settings, whole.as_ref());
        events = tip::events(&tip, recording, settings);
    }
    events.sort_by(|a, b| a.raised.total_cmp(&b.raised));
    let end = recording.times.last().copied().unwrap_or(0.0);
    ChainJudged { settings: settings.clone(), relative, segments, whole, tip, end, events }
}

impl ChainJudged {
    /// What is made of a segment's end disk at a sample; none of one that carries no tracker.
    #[must_use]
    pub fn judgement(&self, segment: usize, sample: usize) -> Option<Judgement> {
        if self.settings.tracked == Tracked::Tip {
            let of_last = self.tip.get(sample).filter(|_| segment + 1 == self.settings.segments.len());
            return of_last.map(|seen| seen.judgement);
        }
        Some(self.segments.get(segment)?.evidence.get(sample)?.judgement)
    }

    /// How the last end disk moves in {B} at a sample, by the model and by the tracker, filtered alike: with a tracker on it alone, where the
    /// screw motion deviation judges. Undefined until the filter is full.
    #[must_use]
    pub fn tip_motions(&self, sample: usize) -> Option<[FilteredMotion; 2]> {
        self.settings.smd.and(self.tip.get(sample)).map(|seen| seen.motions)
    }
}

/// The events of detectors that judge a segment by itself.
fn of_methods<'a>(segment: usize, judged: &'a Judged, methods: &'a [Method]) -> impl Iterator<Item = ChainEvent> + 'a {
    judged.events.iter().filter(|event| methods.contains(&event.detector)).map(move |event| ChainEvent {
        segment,
        detector: ChainMethod::Of(event.detector),
        raised: event.raised,
        cleared: event.cleared,
        value: event.value,
        threshold: event.threshold,
        angle: None,
    })
}

/// The events of the screw motion deviation: raised where either of its values is above its threshold, cleared once both are low. It waits for
/// `detection.armed_from`, as the paper's detectors do: at low speed noise turns the axis about.
fn screw_events(
    segment: usize,
    judgements: impl Iterator<Item = (f64, Judgement)>,
    settings: &Settings,
    smd: &Smd,
) -> Vec<ChainEvent> {
    let thresholds = &settings.thresholds;
    let (mut latch, mut events): (Latch, Vec<ChainEvent>) = (Latch::default(), Vec::new());
    for (time, judgement) in judgements {
        let statistic = Method::FcdConsistent.statistic(&judgement, time, thresholds);
        let angle = judgement.turned;
        let waits = time < thresholds.armed_from;
        let (Some(far), false) = (statistic.above(smd.distance), angle.is_nan() || waits) else {
            latch.unknown();
            continue;
        };
        let near = statistic.above(thresholds.release * smd.distance) == Some(false);
        let low = near && angle <= thresholds.release * smd.angle;
        match latch.look(time, far || angle > smd.angle, low, thresholds.hold).1 {
            Some(Turn::Raised) => events.push(ChainEvent {
                segment,
                detector: ChainMethod::Smd,
                raised: time,
                cleared: None,
                value: statistic.value,
                threshold: smd.distance,
                angle: Some(angle),
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
