//! What was read on all end disks, or on the last alone, and what it says of contacts.

use super::course::{Bending, Course, KnownContact, smoothed};
use super::elsewhere::Elsewhere;
use super::hypotheses::{Hypotheses, Seen, axes};
use super::whole;
use super::whole::linear::Own;
use super::whole::watch::{Watch, frame_turn};
use crate::detect::calibration::course::{Moment, Planner};
use crate::detect::calibration::ensemble::{Ensemble, Listens, Tracker, doubt};
use crate::detect::calibration::jointly::{self, Kept, Placed, Question};
use crate::detect::calibration::marginal::{CLEAR, History};
use crate::detect::calibration::watched::Watched;
use crate::detect::calibration::{ACROSS, Command, STATES, STRETCH};
use crate::model::Pose;
use crate::model::chain::{Contact, Rod};
use std::borrow::Cow;

/// What was read up to some time.
pub(super) enum Heard<'a> {
    /// On all end disks.
    Each(Each<'a>),
    /// On the last alone.
    Last(Last<'a>),
}

/// What was read on the last end disk alone.
pub(super) struct Last<'a> {
    watch: &'a Watch,
    rods: Vec<Rod>,
    last: usize,
}

/// What was read on all end disks.
pub(super) struct Each<'a> {
    watched: Vec<Cow<'a, Watched>>,
    moments: Vec<Vec<Moment>>,
    rods: Vec<Rod>,
    last: usize,
}

/// How contacts are heard.
enum Ears {
    Each(Ensemble),
    Last(whole::Heard),
}

/// The same, by a model with the errors of the calibration that it told of before contacts, and without those that are known.
pub(super) struct Listening {
    ears: Ears,
    seen: Seen,
    calibrations: Vec<[[f64; STATES]; 2]>,
    course: Course,
    planes: Vec<Contact>,
    commands: Vec<Vec<Command>>,
}

/// What is asked for contacts on one segment.
pub(super) struct Asked<'a> {
    listening: &'a Listening,
    segment: usize,
    beginnings: Vec<usize>,
    hypotheses: Hypotheses<'a>,
    kept: Kept,
}

impl Heard<'_> {
    /// How many segments there are.
    pub fn segments(&self) -> usize {
        match self {
            Self::Each(each) => each.watched.len(),
            Self::Last(last) => last.rods.len(),
        }
    }

    /// The last reading.
    pub fn last(&self) -> usize {
        match self {
            Self::Each(each) => each.last,
            Self::Last(last) => last.last,
        }
    }

    /// The last reading of a segment's end disk that had arrived at a time (s).
    pub fn at(&self, segment: usize, time: f64) -> Option<usize> {
        match self {
            Self::Each(each) => each.watched.get(segment)?.at(time),
            Self::Last(last) => last.watch.at(time),
        }
    }

    /// When a reading of a segment's end disk had arrived, s.
    pub fn arrived(&self, segment: usize, reading: usize) -> Option<f64> {
        match self {
            Self::Each(each) => each.watched.get(segment)?.readings.arrived.get(reading).copied(),
            Self::Last(last) => last.watch.arrived.get(reading).copied(),
        }
    }

    /// The first reading at which a contact can have begun of which an alarm of a segment's end disk at a reading tells.
    pub fn earliest(&self, segment: usize, alarm: usize) -> Option<usize> {
        match self {
            Self::Each(each) => each.watched.get(segment)?.earliest(alarm),
            Self::Last(last) => last.watch.earliest(alarm),
        }
    }

    /// The reading, and the share of the way to the next, at a time (s).
    pub fn reading(&self, time: f64) -> f64 {
        match self {
            Self::Each(each) => reading(each.watched[0].readings.commands[..=each.last].iter().map(|of| of.time), time),
            Self::Last(last) => reading(last.watch.moments[..=last.last].iter().map(|of| of.time), time),
        }
    }

    /// By what is known before a reading, and of contacts that hold already. What is suspected since then is only kept out of the bends: it
    /// changes what is measured of them.
    pub fn listen(&self, known: &[KnownContact], first: usize, suspected: Option<KnownContact>) -> Option<Listening> {
        match self {
            Self::Each(each) => each.listen(known, first, suspected),
            Self::Last(last) => last.listen(first),
        }
    }
}

impl<'a> Last<'a> {
    /// Up to a time (s); `rods` are the nominal ones.
    pub fn new(watch: &'a Watch, rods: Vec<Rod>, time: f64) -> Option<Self> {
        Some(Self { watch, rods, last: watch.at(time)? })
    }

    fn listen(&self, first: usize) -> Option<Listening> {
        let Self { watch, rods, last } = self;
        let (moments, poses) = (&watch.moments[..=*last], &watch.poses[..=*last]);
        let clear = first.saturating_sub(CLEAR);
        let heard = whole::Heard::new(&watch.model, watch.wander(clear), moments, poses, clear)?;
        let rod = |(segment, rod): (usize, &Rod)| Rod {
            length: rod.length * (1.0 + heard.errors[Own::Stretch.of(segment)]),
            ..*rod
        };
        let bending = |segment: usize| {
            let of: Vec<_> = moments.iter().map(|moment| moment.configuration(segment, &heard.errors)).collect();
            Bending {
                bends: of.iter().map(|of| of.bend()).collect(),
                deltas: of.iter().map(|of| of.delta()).collect(),
                commanded: moments.iter().map(|moment| moment.commands[segment].bend).collect(),
            }
        };
        let course = Course::new(rods.iter().enumerate().map(rod).collect(), (0..rods.len()).map(bending).collect())?;
        let commands = (0..rods.len()).map(|segment| moments.iter().map(|moment| moment.commands[segment]).collect());
        let seen = Seen::Last(frame_turn(&heard.errors).transpose());
        let calibrations = (0..rods.len()).map(|segment| heard.calibration(segment)).collect();
        Some(Listening {
            seen,
            calibrations,
            course,
            planes: Vec::new(),
            commands: commands.collect(),
            ears: Ears::Last(heard),
        })
    }
}

impl<'a> Each<'a> {
    /// Up to a time (s); `rods` are the nominal ones.
    pub fn new(watched: &[&'a Watched], rods: Vec<Rod>, time: f64) -> Option<Self> {
        watched.iter().map(|watched| watched.at(time)).collect::<Option<Vec<_>>>()?;
        let watched = together(watched);
        let last = watched.iter().map(|watched| watched.at(time)).collect::<Option<Vec<_>>>()?.into_iter().min()?;
        let moments = watched
            .iter()
            .map(|watched| Some(Planner::all(&watched.model, watched.readings.commands.get(..=last)?, false)));
        let moments = moments.collect::<Option<_>>()?;
        Some(Self { watched, moments, rods, last })
    }

    fn listen(&self, known: &[KnownContact], first: usize, suspected: Option<KnownContact>) -> Option<Listening> {
        let clear = known.iter().map(|contact| contact.began.max(0.0) as usize).fold(first, usize::min);
        let read: Vec<&[Pose]> = self.watched.iter().map(|watched| &watched.readings.poses[..=self.last]).collect();
        let mut trackers = self.trackers(&read, clear)?;
        let mut course = self.course(&trackers, &trackers)?;
        let mut corrected = None;
        if !known.is_empty() {
            let poses = course.without(known, &read)?;
            // What is read between the contacts tells more of the calibration.
            trackers = self.trackers(&slices(&poses), first)?;
            course = self.course(&trackers, &trackers)?;
            corrected = Some(poses);
        }
        if let Some(suspected) = suspected {
            let all: Vec<KnownContact> = known.iter().copied().chain([suspected]).collect();
            let poses = course.without(&all, &read)?;
            let poses = slices(&poses);
            let histories = self.histories(&poses);
            let bent: Vec<Tracker> = trackers.iter().zip(&histories).map(|(of, history)| of.reread(history)).collect();
            course = self.course(&trackers, &bent)?;
        }
        let planes = course.planes(known)?;
        let poses = corrected.as_ref().map_or(read, |poses| slices(poses));
        let calibrations = trackers.iter().map(|tracker| tracker.calibration).collect();
        let models: Vec<_> = self.watched.iter().map(|watched| &watched.model).collect();
        let at = |tracker: usize, k: usize| axes(course.configuration(tracker, k as f64));
        let mut ensemble = Ensemble::new(trackers, &models, &poses, at);
        for elsewhere in Elsewhere::all(&course, known)? {
            ensemble.loosen(elsewhere.began, |tracker, k| elsewhere.at(tracker, k));
        }
        let commands = self.moments.iter().map(|of| of.iter().map(|moment| moment.command).collect()).collect();
        Some(Listening { ears: Ears::Each(ensemble), seen: Seen::Each, calibrations, course, planes, commands })
    }

    /// Calibrated by what was read before a reading.
    fn trackers(&self, poses: &[&[Pose]], before: usize) -> Option<Vec<Tracker>> {
        self.histories(poses).iter().map(|history| Tracker::new(history, before.saturating_sub(CLEAR))).collect()
    }

    fn histories<'p>(&'p self, poses: &[&'p [Pose]]) -> Vec<History<'p>> {
        let each = self.watched.iter().zip(&self.moments).zip(poses);
        each.map(|((watched, moments), readings)| History { model: &watched.model, moments, readings }).collect()
    }

    /// The chain as calibrated, driven by the bends that are measured; `bent` measures them.
    fn course(&self, trackers: &[Tracker], bent: &[Tracker]) -> Option<Course> {
        let rods = self.rods.iter().zip(trackers);
        let rods =
            rods.map(|(rod, tracker)| Rod { length: rod.length * (1.0 + tracker.calibration[0][STRETCH]), ..*rod });
        let bending = |((tracker, bent), moments): ((&Tracker, &Tracker), &Vec<Moment>)| Bending {
            bends: smoothed(bent.bends()),
            deltas: moments.iter().map(|moment| moment.command.delta + tracker.calibration[0][ACROSS]).collect(),
            commanded: moments.iter().map(|moment| moment.command.bend).collect(),
        };
        Course::new(rods.collect(), trackers.iter().zip(bent).zip(&self.moments).map(bending).collect())
    }
}

impl Listening {
    /// How many times less than it seems to, what was heard since a reading says of a contact, of which `best` is the largest logarithm of the
    /// likelihood ratio.
    pub fn doubt(&self, since: usize, best: f64) -> f64 {
        match &self.ears {
            Ears::Each(ensemble) => doubt(ensemble.squares(), since, best + ensemble.else_evidence()),
            Ears::Last(heard) => doubt(heard.squares(), since, best),
        }
    }

    /// To be asked for contacts on one segment that began between two readings. The model is exact for planes of one tilt (rad), and otherwise
    /// interpolated.
    pub fn to(&self, segment: usize, between: [usize; 2], tilt: f64) -> Option<Asked<'_>> {
        let hypotheses = Hypotheses::new(&self.course, self.seen, segment, between, &self.planes, tilt)?;
        Some(Asked {
            listening: self,
            segment,
            beginnings: self.course.moving(between),
            hypotheses,
            kept: Kept::default(),
        })
    }
}

impl Asked<'_> {
    /// What all readings say of them, each `doubt` times less than it seems to; `rival` is the largest logarithm of the likelihood ratio on another
    /// segment.
    pub fn told(&self, parts: u32, doubt: f64, rival: f64) -> Option<Placed> {
        let Self { listening, segment, beginnings, hypotheses, kept } = self;
        let question = Question {
            beginnings,
            parts,
            doubt,
            rival,
            segment: *segment,
            length: listening.course.length(*segment),
            commands: &listening.commands[*segment],
            calibration: listening.calibrations[*segment],
        };
        match &listening.ears {
            Ears::Each(ensemble) => jointly::estimate(ensemble, &hypotheses, kept, &question),
            Ears::Last(heard) => jointly::estimate(heard, &hypotheses, kept, &question),
        }
    }
}

/// What was read of all end disks at once: a reading has one number for all of them. A gap in one tracker's is one of all.
fn together<'a>(watched: &[&'a Watched]) -> Vec<Cow<'a, Watched>> {
    let Some((first, others)) = watched.split_first() else { return Vec::new() };
    let arrived = &first.readings.arrived;
    if others.iter().all(|other| other.readings.arrived == *arrived) {
        return watched.iter().map(|watched| Cow::Borrowed(*watched)).collect();
    }
    let of_all = |time: &&f64| {
        let has = |other: &&Watched| other.readings.arrived.binary_search_by(|at| at.total_cmp(time)).is_ok();
        others.iter().all(has)
    };
    let times: Vec<f64> = arrived.iter().filter(of_all).copied().collect();
    watched.iter().map(|watched| Cow::Owned(watched.of(&times))).collect()
}

fn slices(poses: &[Vec<Pose>]) -> Vec<&[Pose]> {
    poses.iter().map(Vec::as_slice).collect()
}

/// The reading, and the share of the way to the next, at a time (s), of those taken at these.
fn reading(taken: impl Iterator<Item = f64>, time: f64) -> f64 {
    let taken: Vec<f64> = taken.collect();
    let after = taken.partition_point(|at| *at <= time).min(taken.len() - 1);
    let before = after.saturating_sub(1);
    let span = taken[after] - taken[before];
    let share = if span > 0.0 { (time - taken[before]) / span } else { 0.0 };
    before as f64 + share.clamp(0.0, 1.0)
}
