//! A recording and settings in, everything concluded out.

use super::alarm::{Alarms, Crossing, Detection, Event};
use super::calibration::monitor::{Monitor, Readings, Watching};
use super::calibration::noise::{self, Whiteness};
use super::calibration::watched::Watched;
use super::calibration::{Belief, Command, Noise};
use super::estimates::{Estimated, Known, Placing, estimate, estimates};
use super::evidence::{Evidence, Observer};
use super::nominal::{Clock, Nominal};
use super::statistic::Method;
use crate::model::configuration::bend_from_theta_l;
use crate::model::{Assumed, Assumption, Configuration, Segment};
use crate::record::{Entry, Recorder, Recording};
use crate::scenario::motion::command;
use crate::scenario::{ContactKind, Estimation, EstimationKind, Estimator, Filter, Plan, Prior, Scenario, Thresholds};

/// What a recording is judged with.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// The model of the robot.
    pub segment: Segment,
    /// Assumed relative error ε_τ of the load cells.
    pub epsilon_tau: f64,
    /// Rate of the loop that stored the recording, Hz.
    pub loop_rate: f64,
    /// The moving average over the tracker's readings.
    pub filter: Filter,
    /// When the tracker reads, and how its marker is mounted.
    pub clock: Clock,
    /// Whether commands are what the robot was told: against ones that come from the readings the calibration filter cannot watch.
    pub commanded: bool,
    /// With what the calibration filter watches.
    pub watching: Watching,
    /// The detectors that judge, their thresholds, and when they are looked at.
    pub thresholds: Thresholds,
    /// What Eq. 24 takes the contact to be.
    pub assumption: Assumption,
    /// With what contacts are placed after an alarm.
    pub placing: Placing,
}

impl Settings {
    /// Those of a plan.
    #[must_use]
    pub fn of(plan: &Plan) -> Self {
        let scenario = plan.scenario();
        Self {
            segment: *plan.segment(),
            epsilon_tau: scenario.load_cells.epsilon_tau,
            loop_rate: scenario.loop_rate,
            filter: scenario.filter.clone(),
            clock: Clock::of(plan),
            commanded: true,
            watching: watching(scenario),
            thresholds: scenario.detection.clone(),
            assumption: assumption(plan),
            placing: placing(&scenario.estimation),
        }
    }

    /// The same for a recording, which knows where its commands come from.
    #[must_use]
    pub fn on(&self, recording: &Recording) -> Self {
        Self { commanded: recording.commanded, ..self.clone() }
    }

    /// How long it takes until the average holds nothing from before, s.
    #[must_use]
    pub fn filter_span(&self) -> f64 {
        self.filter.length as f64 / self.loop_rate
    }

    /// Whether a detector judges that rests on the calibration filter, on commands with which that can work.
    #[must_use]
    pub fn watches(&self) -> bool {
        let judges = |method| self.thresholds.detectors.has(method);
        self.commanded && [Method::Cusum, Method::Glr].into_iter().any(judges)
    }

    fn has_bank(&self) -> bool {
        self.thresholds.detectors.has(Method::Glr)
    }

    /// The calibration filter before the first of some entries; none where no detector that judges rests on it.
    #[must_use]
    pub fn monitor(&self, entries: &[Entry]) -> Option<Monitor> {
        self.watches().then(|| {
            let readings = Readings::of(&self.segment, &self.clock, entries);
            let model = self.watching.model(self.segment.length, &readings);
            Monitor::new(&self.clock, &model, self.has_bank(), readings.commands.into_iter())
        })
    }

    /// The same for the experiment of a plan, before it is simulated: it is looked at until the robot moves.
    #[must_use]
    pub fn monitor_of(&self, plan: &Plan) -> Option<Monitor> {
        self.monitor_before(plan, Recorder::new(plan).map(|(entry, _)| entry))
    }

    /// The same with the entries that it will have, of which those are looked at in which the robot stands still.
    #[must_use]
    pub fn monitor_before(&self, plan: &Plan, entries: impl IntoIterator<Item = Entry>) -> Option<Monitor> {
        self.watches().then(|| {
            let mut nominal = Nominal::new(&self.segment, &self.clock);
            let mut still = Readings::default();
            for entry in entries {
                if let Some(expected) = nominal.take(&entry) {
                    still.take(&expected, &entry, &self.clock.tip_from_marker);
                    if noise::still(&still.commands) < still.commands.len() {
                        break;
                    }
                }
            }
            let model = self.watching.model(self.segment.length, &still);
            Monitor::new(&self.clock, &model, self.has_bank(), self.commands(plan))
        })
    }

    /// What a robot is told at each of the tracker's readings by a plan, until it rests: as [`Readings::of`] has it of the recording.
    pub fn commands(&self, plan: &Plan) -> impl Iterator<Item = Command> {
        self.readings(plan).map(|(_, command)| command)
    }

    /// The same, each with the time at which its reading arrives, s.
    pub fn readings(&self, plan: &Plan) -> impl Iterator<Item = (f64, Command)> {
        let mut nominal = Nominal::new(&self.segment, &self.clock);
        let motion = plan.scenario().motion.clone();
        let plane = Configuration::new(0.0, motion.delta);
        let Clock { rate, latency, .. } = self.clock;
        let rest = plan.scenario().motion.finish + latency + 1.0 / rate + 1.0 / self.loop_rate;
        let times = (0..plan.samples()).map(|k| plan.time(k)).take_while(move |time| *time <= rest);
        times.filter_map(move |time| {
            let (theta_l, theta_l_rate) = command(&motion, time);
            let configuration = plane.with_bend(bend_from_theta_l(theta_l));
            nominal.commanded_at(time, configuration, theta_l_rate).map(|expected| (time, expected.command()))
        })
    }

    /// Whether the same is computed at each instant by these settings as by others: they differ at most in thresholds, and in which of
    /// those detectors judge that cost nothing.
    #[must_use]
    pub fn see_as(&self, other: &Self) -> bool {
        let computed = |settings: &Self| {
            let mut detectors = settings.thresholds.detectors;
            [Method::Fcd, Method::Jfd, Method::FcdVelocity].into_iter().for_each(|free| detectors.set(free, false));
            detectors
        };
        // Every field by name, so that one to come is thought of.
        let Self {
            segment,
            epsilon_tau,
            loop_rate,
            filter,
            clock,
            commanded,
            watching,
            thresholds: _,
            assumption: _,
            placing: _,
        } = self;
        (segment, epsilon_tau, loop_rate) == (&other.segment, &other.epsilon_tau, &other.loop_rate)
            && (filter, clock, computed(self)) == (&other.filter, &other.clock, computed(other))
            && (commanded, watching) == (&other.commanded, &other.watching)
    }
}

/// With what the calibration filter of a scenario watches.
fn watching(scenario: &Scenario) -> Watching {
    let tracker = &scenario.tracker;
    Watching {
        belief: belief(&scenario.prior),
        noise: [&scenario.prior.position_noise, &scenario.prior.orientation_noise, &scenario.prior.colour]
            .map(|estimated| estimated.value()),
        declared: Noise { position: tracker.position_noise, orientation: tracker.orientation_noise, colour: 0.0 },
        least: noise::floor(tracker.position_resolution, tracker.orientation_resolution),
    }
}

/// What a scenario believes of a robot's calibration.
fn belief(prior: &Prior) -> Belief {
    let Prior { translation, rotation, length, bend_scale, bend_offset, delta, latency, .. } = *prior;
    let (t, r, d) = (translation, rotation, prior.drift);
    Belief {
        deviations: [t, t, t, r, r, r, length, bend_scale, bend_offset, delta, latency, d, d, d],
        free_bend: prior.free_bend,
        drift_time: prior.drift_time,
    }
}

/// With what contacts are placed, by a scenario.
fn placing(estimation: &Estimation) -> Placing {
    let Estimation { kind: _, estimators, plants, beginnings } = *estimation;
    Placing { estimators, plants, beginnings: u32::try_from(beginnings).unwrap_or(1) }
}

/// What Eq. 24 takes a contact to be, by a plan.
fn assumption(plan: &Plan) -> Assumption {
    let scenario = plan.scenario();
    match scenario.estimation.kind {
        EstimationKind::Clamp => Assumption { kind: Assumed::Clamp, met: None },
        EstimationKind::Plane => Assumption { kind: Assumed::Plane, met: None },
        EstimationKind::AsSimulated => {
            let kind = if scenario.contact.kind == ContactKind::Clamp { Assumed::Clamp } else { Assumed::Plane };
            Assumption { kind, met: plan.contact().map(|contact| contact.bend) }
        }
    }
}

/// What is concluded from a recording.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Judged {
    /// With what it was judged.
    pub settings: Settings,
    /// What is known at each entry, before any threshold.
    pub evidence: Vec<Evidence>,
    /// What the calibration filter has heard, where a detector that judges rests on it.
    pub watched: Option<Watched>,
    /// Threshold crossings, in order.
    pub crossings: Vec<Crossing>,
    /// Events of the detectors that judge, in the order in which they were raised.
    pub events: Vec<Event>,
}

/// Judges a recording. It does not look at the truth.
///
/// ```
/// use centrode_core::detect::judge::{Settings, judge};
/// use centrode_core::record::Recording;
/// use centrode_core::scenario::{Plan, Scenario};
///
/// let plan = Plan::new(&Scenario::default())?;
/// let judged = judge(&Recording::simulated(&plan), &Settings::of(&plan));
/// assert!((judged.detection().expect("contact on disk 2").time - 6.28).abs() < 0.005);
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[must_use]
pub fn judge(recording: &Recording, settings: &Settings) -> Judged {
    Judging::new(recording, settings).finish(recording)
}

/// A recording being judged, some entries at a time.
#[derive(Debug, Clone)]
pub struct Judging {
    settings: Settings,
    observer: Observer,
    evidence: Vec<Evidence>,
}

impl Judging {
    /// Before its first entry.
    #[must_use]
    pub fn new(recording: &Recording, settings: &Settings) -> Self {
        let settings = settings.on(recording);
        let observer = Observer::new(&settings, settings.monitor(&recording.entries));
        Self { settings, observer, evidence: Vec::with_capacity(recording.entries.len()) }
    }

    /// Looks at so many of the next entries of the same recording, or all that are left; returns whether it has seen all.
    pub fn look(&mut self, recording: &Recording, entries: usize) -> bool {
        let next = recording.entries.iter().skip(self.evidence.len()).take(entries);
        self.evidence.extend(next.map(|entry| self.observer.observe(entry)));
        self.evidence.len() >= recording.entries.len()
    }

    /// What is concluded, once it has seen the rest.
    #[must_use]
    pub fn finish(mut self, recording: &Recording) -> Judged {
        self.look(recording, usize::MAX);
        let Self { settings, observer, evidence } = self;
        let watched = observer.watched();
        let judged =
            Judged { settings: settings.clone(), evidence, watched, crossings: Vec::new(), events: Vec::new() };
        judged.again(recording, settings)
    }
}

impl Judged {
    /// The same evidence, of `recording`, with settings that [see the same](Settings::see_as): nothing is filtered again.
    #[must_use]
    pub fn again(mut self, recording: &Recording, settings: Settings) -> Self {
        self.settings = settings.on(recording);
        let mut alarms = Alarms::new(&self.settings);
        for (entry, evidence) in recording.entries.iter().zip(&self.evidence) {
            alarms.look(entry.time, &entry.configuration, &evidence.judgement);
        }
        (self.crossings, self.events) = alarms.finish();
        self
    }

    /// The first event of the centrode, with the place that Eq. 24 gives it.
    #[must_use]
    pub fn detection(&self) -> Option<Detection> {
        Detection::first(&self.events)
    }

    /// Where the contact is that the first alarm of a detector told of, at these times after it (s).
    #[must_use]
    pub fn estimates(&self, recording: &Recording, detector: Method, after: &[f64]) -> Vec<Estimated> {
        self.first(detector).map_or_else(Vec::new, |event| self.estimates_of(recording, event, after))
    }

    /// Where the contact is that an event tells of, at these times after its alarm (s).
    #[must_use]
    pub fn estimates_of(&self, recording: &Recording, event: &Event, after: &[f64]) -> Vec<Estimated> {
        estimates(&self.known(recording), event, after)
    }

    /// What one estimator says so long after an alarm (s). `None` where there are no entries so late, or it cannot tell.
    #[must_use]
    pub fn estimate(&self, recording: &Recording, alarm: f64, after: f64, estimator: Estimator) -> Option<Estimated> {
        estimate(&self.known(recording), alarm, after, estimator)
    }

    fn known<'a>(&'a self, recording: &'a Recording) -> Known<'a> {
        Known {
            entries: &recording.entries,
            evidence: &self.evidence,
            watched: self.watched.as_ref(),
            settings: &self.settings,
        }
    }

    /// Whether the tracker's noise is taken for what the scenario says, because it is not known and there were too few readings at rest to
    /// measure it.
    #[must_use]
    pub fn noise_unmeasured(&self) -> bool {
        let known = self.settings.watching.noise.iter().all(Option::is_some);
        self.watched.as_ref().is_some_and(|watched| !known && noise::still(&watched.readings.commands) < noise::STILL)
    }

    /// Whether the calibration filter's innovations are white, up to where a contact can have begun; none where it did not watch, or too
    /// briefly.
    #[must_use]
    pub fn whiteness(&self) -> Option<Whiteness> {
        self.watched.as_ref()?.whiteness()
    }

    /// The events of a detector that tell of a contact each: one that is raised while a contact of before may still hold tells of that,
    /// and is left out. Of a detector without the calibration filter nobody knows; each counts.
    #[must_use]
    pub fn contacts(&self, detector: Method) -> Vec<&Event> {
        let mut kept: Vec<&Event> = Vec::new();
        for event in self.events.iter().filter(|event| event.detector == detector) {
            let clear = |before: &&Event| {
                let watched = self.watched.as_ref()?;
                let [from, to] = [before.raised, event.raised].map(|time| watched.at(time));
                Some(watched.clear_by(to?)? > from?)
            };
            if kept.last().is_none_or(|before| clear(before) != Some(false)) {
                kept.push(event);
            }
        }
        kept
    }

    /// The first event of a detector.
    #[must_use]
    pub fn first(&self, detector: Method) -> Option<&Event> {
        self.events.iter().find(|event| event.detector == detector)
    }
}
