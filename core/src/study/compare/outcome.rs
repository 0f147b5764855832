//! What one repeat comes to: a run without contact and one with, and the places of its contact.

use crate::detect::Method;
use crate::detect::estimates::Estimated;
use crate::run::{Run, Unfinished};
use crate::scenario::{Estimator, Plan};
use crate::study::exact::{self, Exact};
use crate::study::seed::repeat_seed;
use crate::study::tuning::watch::NEVER;
use serde::{Deserialize, Serialize};

/// Entries of a run that are judged in one part, with the bank of the likelihood ratio and without: natively some 10 ms.
const STRETCH: [usize; 2] = [1000, 20_000];

/// Where the largest value so far of a detector rose, in one run: at which sample, and to what.
type Climb = Vec<(u32, Exact)>;

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

impl Task {
    fn stretch(&self) -> usize {
        STRETCH[usize::from(!self.methods.contains(&Method::Glr))]
    }
}

/// One place, and the truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Placed {
    pub estimator: Estimator,
    /// Which of the times after the alarm.
    pub after: usize,
    /// Time since the contact began, s.
    #[serde(with = "exact")]
    pub since: f64,
    /// Estimate less truth, m.
    #[serde(with = "exact")]
    pub error: f64,
    pub covers: bool,
    #[serde(with = "exact")]
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
        self.free[place].last().map(|(_, value)| value.0)
    }

    /// The samples at which a detector first exceeds a threshold, without contact and with.
    pub(super) fn firsts(&self, place: usize, threshold: f64) -> [u32; 2] {
        [&self.free, &self.held].map(|climbs| {
            let climb = &climbs[place];
            climb.get(climb.partition_point(|(_, value)| value.0 <= threshold)).map_or(NEVER, |(sample, _)| *sample)
        })
    }
}

/// A repeat being made: each run is recorded, then judged a stretch at a time; of the one with contact places follow, a time after the
/// alarm at a time.
#[derive(Debug, Clone)]
pub(super) struct Making {
    repeat: u64,
    outcome: Outcome,
    next: Next,
}

/// What a repeat has to make next.
#[derive(Debug, Clone)]
enum Next {
    Record(Which),
    Judge(Which, Box<Unfinished>),
    Place(Box<Run>, usize),
    Nothing,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Which {
    Free,
    Held,
}

impl Making {
    pub(super) fn new(repeat: u64) -> Self {
        Self { repeat, outcome: Outcome::default(), next: Next::Record(Which::Free) }
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
        self.next = match std::mem::replace(&mut self.next, Next::Nothing) {
            Next::Record(which) => {
                let plan = if which == Which::Held { &task.plan } else { &task.free };
                let seed = repeat_seed(task.plan.scenario().seed, 2 * self.repeat + u64::from(which == Which::Held));
                Next::Judge(which, Box::new(Unfinished::new(plan.with_seed(seed))))
            }
            Next::Judge(which, mut run) => match (run.judge(task.stretch()), which) {
                (false, _) => Next::Judge(which, run),
                (true, Which::Free) => {
                    self.free(task, &run.finish());
                    Next::Record(Which::Held)
                }
                (true, Which::Held) => self.held(task, run.finish()),
            },
            Next::Place(run, place) => {
                self.outcome.placed.extend(placed(task, &run, place));
                if place + 1 < task.after.len() { Next::Place(run, place + 1) } else { Next::Nothing }
            }
            Next::Nothing => Next::Nothing,
        };
        matches!(self.next, Next::Nothing)
    }

    /// Takes in the run without contact.
    fn free(&mut self, task: &Task, run: &Run) {
        self.outcome.white = run.judged.whiteness().map(|test| !test.fails());
        self.outcome.free = climbs(task, run);
    }

    /// Takes in the one with contact, and says what follows.
    fn held(&mut self, task: &Task, run: Run) -> Next {
        self.outcome.held = climbs(task, &run);
        let began = run.contact_time();
        self.outcome.contact =
            began.map(|time| run.recording.entries.partition_point(|entry| entry.time < time) as u32);
        let found = run.judged.first(task.detector).zip(began);
        let is_placed = found.is_some_and(|(event, contact)| event.raised >= contact) && !task.after.is_empty();
        if is_placed { Next::Place(Box::new(run), 0) } else { Next::Nothing }
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
                climb.push((k as u32, Exact(value)));
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
