//! Whether a challenge is met: some runs with other seeds, one a frame, judged as the page's own.

use super::{CHALLENGES, Challenge, Runs};
use centrode_core::detect::Method;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::{ContactKind, Place, Scenario};

/// Until when a clamp is held against a touch, s.
const UNTIL: f64 = 7.5;

/// What one run came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// When the contact began, s.
    pub contact: Option<f64>,
    /// Its detectors' first events.
    first: Vec<(Method, f64)>,
    /// How far the estimate at the alarm is from the contact, m.
    pub off: Option<f64>,
    /// Root mean square of how its deviation differs from a touch's, m.
    pub unlike: Option<f64>,
}

impl Outcome {
    fn of(run: &Run) -> Self {
        let mut first: Vec<(Method, f64)> = Vec::new();
        for event in run.events() {
            if first.iter().all(|(method, _)| *method != event.detector) {
                first.push((event.detector, event.raised));
            }
        }
        let place = run.plan.contact().map(|contact| contact.arc_length);
        let off = run.detection().zip(place).map(|(detection, place)| (detection.location - place).abs());
        Self { contact: run.contact_time(), first, off, unlike: None }
    }

    /// When a detector first raised an event, s.
    #[must_use]
    pub fn first(&self, method: Method) -> Option<f64> {
        self.first.iter().find(|(of, _)| *of == method).map(|(_, raised)| *raised)
    }

    /// How long after the contact that was, s; negative before it.
    #[must_use]
    pub fn delay(&self, method: Method) -> Option<f64> {
        Some(self.first(method)? - self.contact?)
    }
}

/// What some runs came to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tally {
    /// As it is set.
    pub set: Vec<Outcome>,
    /// Without contact.
    pub other: Vec<Outcome>,
}

impl Tally {
    fn len(&self) -> usize {
        self.set.len() + self.other.len()
    }

    /// Makes the next run of a challenge; none that is impossible.
    fn add(&mut self, of: &Challenge, scenario: &Scenario) {
        let other = of.runs == Runs::Both && self.other.len() < self.set.len();
        let outcomes = if other { &mut self.other } else { &mut self.set };
        let mut scenario = Scenario { seed: outcomes.len() as u64 + 1, ..scenario.clone() };
        if other {
            scenario.contact.place = Place::Nowhere;
        }
        // What the page shows was checked; without contact it is possible, too.
        let Ok(run) = simulate(&scenario) else { return outcomes.push(nothing()) };
        let unlike = (of.runs == Runs::Touched).then(|| unlike(&run, &scenario)).flatten();
        outcomes.push(Outcome { unlike, ..Outcome::of(&run) });
    }
}

fn nothing() -> Outcome {
    Outcome { contact: None, first: Vec::new(), off: None, unlike: None }
}

/// Root mean square of the difference between the deviations of a clamp and of a flat beam that touches disk 2 from the same time on, m.
fn unlike(run: &Run, scenario: &Scenario) -> Option<f64> {
    if scenario.contact.kind != ContactKind::Clamp {
        return None;
    }
    let mut touch = scenario.clone();
    touch.contact = touched()?;
    let touch = simulate(&touch).ok()?;
    let from = touch.contact_time()?.min(run.contact_time()?);
    let within = |time: f64| (from..=UNTIL).contains(&time);
    let differences = run.samples().zip(touch.samples()).filter(|(sample, _)| within(sample.time));
    let squares: Vec<f64> = differences
        .map(|(clamp, touch)| (clamp.judgement.deviation - touch.judgement.deviation).powi(2))
        .filter(|square| square.is_finite())
        .collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// The touch that a clamp is to look like.
fn touched() -> Option<centrode_core::scenario::Contact> {
    Some(centrode_core::scenario::preset::find("touch-2").ok()?.scenario().ok()?.contact)
}

/// Judges what is set on the page, a run at a time.
#[derive(Debug, Default)]
pub struct Check {
    /// Which challenge, and what it began with.
    begun: Option<(usize, Scenario)>,
    scenario: Scenario,
    start: Tally,
    now: Tally,
}

/// What is known of a challenge.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// So many of so many runs are made.
    Measuring(usize, usize),
    /// Something was changed that is to stay: its path.
    Forbidden(&'static str),
    /// Whether the goal is met, and what was measured.
    Measured(bool, String),
}

impl Check {
    /// Begins a challenge at a scenario.
    pub fn begin(&mut self, which: usize, scenario: &Scenario) {
        *self = Self { begun: Some((which, scenario.clone())), scenario: scenario.clone(), ..Self::default() };
    }

    /// Takes what is set now.
    pub fn update(&mut self, scenario: &Scenario) {
        // Other seeds are tried anyway.
        let scenario = Scenario { seed: 1, ..scenario.clone() };
        if scenario != self.scenario {
            self.scenario = scenario;
            self.now = Tally::default();
        }
    }

    fn open(&self) -> Option<(&'static Challenge, &Scenario)> {
        let (which, start) = self.begun.as_ref()?;
        Some((CHALLENGES.get(*which)?, start))
    }

    /// Makes one run. Returns whether more are to be made.
    pub fn work(&mut self) -> bool {
        let Some((of, start)) = self.open().map(|(of, start)| (of, start.clone())) else { return false };
        if of.forbidden(&start, &self.scenario).is_some() {
            return false;
        }
        if self.start.len() < runs(of) {
            self.start.add(of, &start);
        } else if self.now.len() < runs(of) {
            let now = self.scenario.clone();
            self.now.add(of, &now);
        }
        self.is_working()
    }

    /// Whether runs are to be made.
    #[must_use]
    pub fn is_working(&self) -> bool {
        matches!(self.verdict(), Some(Verdict::Measuring(..)))
    }

    /// What is known; none while no challenge is open.
    #[must_use]
    pub fn verdict(&self) -> Option<Verdict> {
        let (of, start) = self.open()?;
        if let Some(path) = of.forbidden(start, &self.scenario) {
            return Some(Verdict::Forbidden(path));
        }
        let (made, all) = (self.start.len() + self.now.len(), 2 * runs(of));
        if made < all {
            return Some(Verdict::Measuring(made, all));
        }
        let (met, said) = (of.judge)(&self.now, &self.start);
        Some(Verdict::Measured(met, said))
    }
}

/// How many runs a challenge is judged by.
fn runs(of: &Challenge) -> usize {
    of.seeds as usize * if of.runs == Runs::Both { 2 } else { 1 }
}
