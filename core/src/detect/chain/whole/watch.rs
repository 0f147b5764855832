//! The readings of a tracker on the last end disk alone, as the calibration filter of the whole chain hears them.

use super::filter::{Designer, Filter};
use super::linear::{Linear, Moment};
use super::{Model, WANDERS};
use crate::detect::calibration::monitor::Readings;
use crate::detect::calibration::noise;
use crate::detect::calibration::watched::EARLIER;
use crate::detect::calibration::{Command, Six};
use crate::detect::chain::ChainSettings;
use crate::model::{Mat3, Pose, Vec3};
use crate::record::Entry;
use crate::record::chain::ChainRecording;
use libm::log;
use nalgebra::DVector;
use std::collections::VecDeque;

/// Readings, and what came of each.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::detect::chain) struct Watch {
    /// When each had arrived, s.
    pub arrived: Vec<f64>,
    /// What was told when it was taken.
    pub moments: Vec<Moment>,
    pub poses: Vec<Pose>,
    pub model: Model,
    /// The cumulative sum after each.
    pub sums: Vec<f64>,
    /// Which of [`WANDERS`] is the likeliest, of the readings long before each.
    wanders: Vec<usize>,
}

impl Watch {
    /// Of a recording. `None` where that has no readings of the last end disk.
    pub fn new(recording: &ChainRecording, settings: &ChainSettings) -> Option<Self> {
        let tips = recording.readings.last()?.as_ref()?;
        let clock = settings.segments.last()?.clock;
        let each = settings.segments.iter().enumerate().map(|(segment, settings)| {
            let entries =
                recording.told[segment].iter().zip(tips).zip(&recording.times).map(|((told, tip), time)| Entry {
                    time: *time,
                    configuration: told.configuration,
                    theta_l_rate: told.rates[0],
                    delta_rate: told.rates[1],
                    reading: *tip,
                    tau_lc: Vec3::repeat(f64::NAN),
                });
            let entries: Vec<Entry> = entries.collect();
            Readings::of(&settings.segment, &clock, &entries)
        });
        let each: Vec<Readings> = each.collect();
        let Readings { arrived, poses, .. } = each.first()?.clone();
        // A command that is not known leaves a reading out of one segment's.
        if arrived.is_empty() || each.iter().any(|other| other.arrived.len() != arrived.len()) {
            return None;
        }
        let moments =
            moments(&each, &settings.segments.iter().map(|of| of.watching.belief.free_bend).collect::<Vec<_>>());
        let lengths: Vec<f64> = settings.segments.iter().map(|settings| settings.segment.length).collect();
        let beliefs = settings.segments.iter().map(|settings| settings.watching.belief).collect();
        let declared = settings.segments[0].watching.declared;
        let mut model = Model { lengths, beliefs, noise: declared };
        model.noise = measured(&model, settings, &each, &moments);
        let mut watch = Self { arrived, moments, poses, model, sums: Vec::new(), wanders: Vec::new() };
        watch.listen();
        Some(watch)
    }

    /// The last reading that had arrived at a time (s).
    pub fn at(&self, time: f64) -> Option<usize> {
        self.arrived.partition_point(|arrived| *arrived <= time + 1e-9).checked_sub(1)
    }

    /// The first reading at which a contact can have begun of which an alarm at a reading tells.
    pub fn earliest(&self, alarm: usize) -> Option<usize> {
        let begin = self.sums.get(..=alarm)?.iter().rposition(|sum| *sum == 0.0)?;
        Some(begin.saturating_sub(EARLIER + (alarm - begin) / 4))
    }

    /// How far bends wander in a second, by the readings before one, as a share of their freedom.
    pub fn wander(&self, reading: usize) -> f64 {
        self.wanders.get(reading).map_or(WANDERS[0], |place| WANDERS[*place])
    }

    fn listen(&mut self) {
        let mut bank = Bank::new(&self.model);
        for (moment, pose) in self.moments.iter().zip(&self.poses) {
            self.sums.push(bank.step(&self.model, moment, pose));
            self.wanders.push(bank.best);
        }
    }
}

/// What a contact adds to the innovations may be anything: their variance is thought to become so many times what it is.
const LOUDER: f64 = 4.0;
/// How much bends wander is told by readings so much older than the last.
const OLDER: usize = 50;
/// A cumulative sum above this tells of a contact.
const CONTACT: f64 = 8.0;

/// Filters with each of [`WANDERS`], linear about what the best of them knows.
struct Bank {
    filters: Vec<(Filter, Designer)>,
    evidence: [f64; WANDERS.len()],
    recent: VecDeque<[f64; WANDERS.len()]>,
    best: usize,
    sum: f64,
    largest: f64,
}

impl Bank {
    fn new(model: &Model) -> Self {
        Self {
            filters: WANDERS.iter().map(|wander| (Filter::new(model), Designer::new(model, *wander))).collect(),
            evidence: [0.0; WANDERS.len()],
            recent: VecDeque::new(),
            best: 0,
            sum: 0.0,
            largest: 0.0,
        }
    }

    /// The cumulative sum after a reading: of the ratio for louder innovations.
    fn step(&mut self, model: &Model, moment: &Moment, reading: &Pose) -> f64 {
        let about: DVector<f64> = model.lasting(&self.filters[self.best].0.states.component_mul(&model.deviations()));
        let linear = Linear::at(model, moment, &about);
        let residual = linear.residual(reading) + &linear.by_error * &about;
        let mut likelihoods = [0.0; WANDERS.len()];
        let mut innovations = [Six::zeros(); WANDERS.len()];
        for (place, (filter, designer)) in self.filters.iter_mut().enumerate() {
            let stage = designer.next(moment, &linear);
            innovations[place] = filter.step(&stage, &residual);
            likelihoods[place] = stage.likelihood(&innovations[place]);
        }
        let louder = innovations[self.best].norm_squared() * (1.0 - 1.0 / LOUDER) - 6.0 * log(LOUDER);
        self.sum = (self.sum + 0.5 * louder).max(0.0);
        self.largest = self.largest.max(self.sum);
        self.recent.push_back(likelihoods);
        if self.sum == 0.0 {
            // A contact is no wandering.
            if std::mem::take(&mut self.largest) > CONTACT {
                self.recent.clear();
            }
            while self.recent.len() > OLDER {
                let Some(older) = self.recent.pop_front() else { break };
                self.evidence.iter_mut().zip(older).for_each(|(sum, one)| *sum += one);
            }
            let likelier = |a: &usize, b: &usize| self.evidence[*a].total_cmp(&self.evidence[*b]);
            // Of equals the first.
            self.best = (0..WANDERS.len()).rev().max_by(likelier).unwrap_or(0);
        }
        self.sum
    }
}

/// A change of direction shows by this much, rad: less may be an encoder's.
const BACK: f64 = 5e-4;

fn moments(each: &[Readings], free: &[f64]) -> Vec<Moment> {
    let mut plays: Vec<Play> = each.iter().zip(free).map(|(of, free)| Play::new(*free, &of.commands)).collect();
    let count = each.first().map_or(0, |of| of.commands.len());
    let turned = |commands: &[Command], k: usize| match k.checked_sub(1) {
        Some(before) if commands[k].time > commands[before].time => {
            (commands[k].delta - commands[before].delta) / (commands[k].time - commands[before].time)
        }
        _ => 0.0,
    };
    let at = |k: usize| Moment {
        time: each[0].commands[k].time,
        commands: each.iter().map(|of| of.commands[k]).collect(),
        turning: each.iter().map(|of| turned(&of.commands, k)).collect(),
        taken_up: plays.iter_mut().zip(each).map(|(play, of)| play.taken_up(of.commands[k].bend)).collect(),
    };
    (0..count).map(at).collect()
}

/// Where a segment last turned back, and how far it has bent since: its play is taken up while that is little.
struct Play {
    free: f64,
    from: f64,
    most: f64,
    side: f64,
}

impl Play {
    fn new(free: f64, commands: &[Command]) -> Self {
        Self { free, from: commands.first().map_or(0.0, |command| command.bend), most: 0.0, side: 0.0 }
    }

    /// The variance that is added, in units of the square of the bend's freedom.
    fn taken_up(&mut self, bend: f64) -> f64 {
        if self.side == 0.0 && (bend - self.from).abs() > 0.0 {
            self.side = (bend - self.from).signum();
        }
        let gone = self.side * (bend - self.from);
        if gone < self.most - BACK {
            (self.from, self.side) = (self.from + self.side * self.most, -self.side);
            self.most = 0.0;
        }
        let gone = (self.side * (bend - self.from)).max(self.most);
        let reach = 2.0 * self.free;
        let added = if reach > 0.0 { (gone.min(reach) - self.most.min(reach)) / reach } else { 0.0 };
        self.most = gone;
        added
    }
}

/// The tracker's noise: of readings that were taken before any segment moved, where there are enough of them.
fn measured(
    model: &Model,
    settings: &ChainSettings,
    each: &[Readings],
    moments: &[Moment],
) -> crate::detect::calibration::Noise {
    let still = each.iter().map(|of| noise::still(&of.commands)).min().unwrap_or(0);
    let length: f64 = model.lengths.iter().sum();
    let nominal = DVector::zeros(model.states());
    // As a straight segment would have been read.
    let straight = |(reading, moment): (&Pose, &Moment)| {
        let expected = Linear::at(model, moment, &nominal).pose;
        Pose {
            position: reading.position - expected.position + Vec3::new(0.0, 0.0, length),
            rotation: reading.rotation * expected.rotation.transpose(),
        }
    };
    let poses = each[0].poses.iter().zip(moments).take(still).map(straight).collect();
    let rests = |command: &Command| Command { time: command.time, bend: 0.0, rate: 0.0, delta: 0.0 };
    let commands = each[0].commands.iter().take(still).map(rests).collect();
    let readings = Readings { arrived: each[0].arrived[..still].to_vec(), commands, poses };
    settings.segments[0].watching.noise(length, &readings)
}

/// The turn of the tracker's frame among some errors.
pub(in crate::detect::chain) fn frame_turn(errors: &DVector<f64>) -> Mat3 {
    crate::model::orientation::from_vector(&Vec3::new(errors[3], errors[4], errors[5]))
}
