//! What one repeat comes to: a run without contact and one with, and the places of its contact.

use crate::detect::Method;
use crate::detect::estimates::Estimated;
use crate::run::Run;
use crate::scenario::{Estimator, Plan};
use crate::study::seed::repeat_seed;
use crate::study::tuning::watch::NEVER;
use serde::{Deserialize, Serialize};

/// Where the largest value so far of a detector rose, in one run: at which sample, and to what.
type Climb = Vec<(u32, f64)>;

/// What every repeat makes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Task {
    /// With contact.
    pub plan: Plan,
    /// Without.
    pub free: Plan,
    /// The detectors that are compared.
    pub methods: Vec<Method>,
    /// Whose alarms are placed.
    pub detector: Method,
    /// So long after the alarm, s; nothing where nothing is placed.
    pub after: Vec<f64>,
}

/// One place, and the truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Placed {
    pub estimator: Estimator,
    /// Which of the times after the alarm.
    pub after: usize,
    /// Time since the contact began, s.
    pub since: f64,
    /// Estimate less truth, m.
    pub error: f64,
    pub covers: bool,
    pub width: f64,
}

/// What one repeat came to: a run without contact and one with.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    free: Vec<Climb>,
    held: Vec<Climb>,
    /// Truth: the sample at which the contact began.
    contact: Option<u32>,
    pub(super) placed: Vec<Placed>,
    /// Whether innovations of the run without contact are white.
    pub(super) white: Option<bool>,
}

impl Outcome {
    /// Whether it has what a task asks for.
    pub(super) fn is_of(&self, task: &Task) -> bool {
        let all = task.methods.len();
        let places = self.placed.iter().all(|placed| placed.after < task.after.len());
        self.free.len() == all && self.held.len() == all && places
    }

    /// The sample at which the contact began.
    pub(super) fn contact(&self) -> Option<u32> {
        self.contact
    }

    /// The largest value of a detector without contact; none where no value counts.
    pub(super) fn peak(&self, place: usize) -> Option<f64> {
        self.free[place].last().map(|(_, value)| *value)
    }

    /// The samples at which a detector first exceeds a threshold, without contact and with.
    pub(super) fn firsts(&self, place: usize, threshold: f64) -> [u32; 2] {
        [&self.free, &self.held].map(|climbs| {
            let climb = &climbs[place];
            climb.get(climb.partition_point(|(_, value)| *value <= threshold)).map_or(NEVER, |(sample, _)| *sample)
        })
    }
}

/// A repeat being made, a run or a time after the alarm at a time.
#[derive(Debug, Clone)]
pub(super) struct Making {
    repeat: u64,
    outcome: Outcome,
    /// The run with contact, and which place comes next.
    held: Option<(Box<Run>, usize)>,
}

impl Making {
    pub(super) fn new(repeat: u64) -> Self {
        Self { repeat, outcome: Outcome::default(), held: None }
    }

    pub(super) fn repeat(&self) -> u64 {
        self.repeat
    }

    /// What it came to, once it is whole.
    pub(super) fn outcome(self) -> Outcome {
        self.outcome
    }

    /// Makes the next part; returns whether it is whole.
    pub(super) fn step(&mut self, task: &Task) -> bool {
        let seed = |which: u64| repeat_seed(task.plan.scenario().seed, 2 * self.repeat + which);
        if self.outcome.free.is_empty() {
            let free = Run::new(task.free.with_seed(seed(0)));
            self.outcome.white = free.judged.whiteness().map(|test| !test.fails());
            self.outcome.free = climbs(task, &free);
            return false;
        }
        if let Some((run, next)) = &mut self.held {
            let placed = placed(task, run, *next);
            self.outcome.placed.extend(placed);
            *next += 1;
            return *next >= task.after.len();
        }
        let held = Run::new(task.plan.with_seed(seed(1)));
        self.outcome.held = climbs(task, &held);
        self.outcome.contact =
            held.contact_time().map(|time| held.recording.entries.partition_point(|entry| entry.time < time) as u32);
        let found = held.judged.first(task.detector).zip(held.contact_time());
        let is_placed = found.is_some_and(|(event, contact)| event.raised >= contact) && !task.after.is_empty();
        self.held = is_placed.then(|| (Box::new(held), 0));
        !is_placed
    }
}

fn climbs(task: &Task, run: &Run) -> Vec<Climb> {
    let thresholds = &task.plan.scenario().detection;
    let climb = |method: &Method| {
        let mut climb: Climb = Vec::new();
        let mut most = f64::NEG_INFINITY;
        for (k, (entry, evidence)) in run.recording.entries.iter().zip(&run.judged.evidence).enumerate() {
            let unit = method.unit(thresholds, evidence.judgement.shape_bound);
            let value = method.statistic(&evidence.judgement, entry.time, thresholds).counted();
            if let Some(value) = value.map(|value| value / unit)
                && value > most
            {
                most = value;
                climb.push((k as u32, value));
            }
        }
        climb
    };
    task.methods.iter().map(climb).collect()
}

/// The estimates at one time after the alarm.
fn placed(task: &Task, run: &Run, which: usize) -> Vec<Placed> {
    let truth = run.plan.contact().map(|contact| contact.arc_length);
    let (Some(truth), Some(contact), Some(&after)) = (truth, run.contact_time(), task.after.get(which)) else {
        return Vec::new();
    };
    let estimates = run.judged.estimates(&run.recording, task.detector, &[after]);
    let placed = |estimate: &Estimated| {
        let location = &estimate.location;
        Placed {
            estimator: estimate.estimator,
            after: which,
            since: estimate.time - contact,
            error: location.mean - truth,
            covers: (location.low..=location.high).contains(&truth),
            width: location.high - location.low,
        }
    };
    estimates.iter().map(placed).collect()
}
