//! Work that takes longer than a frame: figures, Table II and the map, a few pieces a frame.

use crate::app::stages::stage::Stage;
use centrode_core::chart::Chart;
use centrode_core::scenario::{Contact, ContactKind, Place, Scenario, ScenarioError};
use centrode_core::study::figure::FigureJob;
use centrode_core::study::map::{ContactMap, MapJob};
use centrode_core::study::table2::{Row, Table2, Table2Job};
use centrode_core::study::{Job, Progress};

/// Repeats of each disk in the simulated Table II.
pub const REPEATS: usize = 20;
/// Bends and places of the map.
pub const CELLS: (usize, usize) = (120, 90);
/// Rows of the map, each a fifth of a millisecond natively, that are done in a frame; one where shapes have to be solved for.
const ROWS: usize = 9;

/// What has been found.
#[derive(Debug, Clone, PartialEq)]
pub enum Found {
    /// A figure.
    Figure(Chart),
    /// The tables, and the experiments behind the simulated ones: of the scenario's kind of contact, and of the other.
    Table(Box<Table2>, [Vec<Row>; 2]),
    /// The map.
    Map(ContactMap),
}

#[derive(Debug)]
enum Work {
    Figure(FigureJob),
    Table(Box<Table2Job>),
    Map(Box<MapJob>),
}

impl Work {
    fn new(stage: Stage, scenario: &Scenario) -> Option<Result<Self, ScenarioError>> {
        let job = match (stage, stage.figure()) {
            (_, Some(number)) => FigureJob::new(number, scenario).map(Work::Figure),
            (Stage::Table2, _) => Table2Job::new(scenario, REPEATS).map(|job| Work::Table(Box::new(job))),
            (Stage::Map, _) => MapJob::new(scenario, CELLS.0, CELLS.1).map(|job| Work::Map(Box::new(job))),
            _ => return None,
        };
        Some(job)
    }

    fn job(&mut self) -> &mut dyn Job {
        match self {
            Self::Figure(job) => job,
            Self::Table(job) => &mut **job,
            Self::Map(job) => &mut **job,
        }
    }

    fn progress(&self) -> Progress {
        match self {
            Self::Figure(job) => job.progress(),
            Self::Table(job) => job.progress(),
            Self::Map(job) => job.progress(),
        }
    }

    fn found(&self) -> Found {
        match self {
            Self::Figure(job) => Found::Figure(job.chart()),
            Self::Table(job) => {
                Found::Table(Box::new(job.table()), [job.rows(), job.other_rows()].map(<[Row]>::to_vec))
            }
            Self::Map(job) => Found::Map(job.map().clone()),
        }
    }
}

/// The work for what is on the stage.
#[derive(Debug, Default)]
pub struct Studies {
    inputs: Option<(Stage, Scenario)>,
    work: Option<Work>,
    found: Option<Found>,
    /// Counts what has been found, so that pictures of it can be kept.
    version: u64,
    refused: Option<ScenarioError>,
}

impl Studies {
    /// Starts anew when the stage or what its work depends on has changed.
    pub fn update(&mut self, stage: Stage, scenario: &Scenario) {
        let mut scenario = scenario.clone();
        if matches!(stage, Stage::Table2 | Stage::Map) {
            // They put in places and times of their own.
            scenario.contact = Contact { place: Place::Nowhere, start: Contact::default().start, ..scenario.contact };
        }
        if self.inputs.as_ref().is_some_and(|(was, inputs)| *was == stage && *inputs == scenario) {
            return;
        }
        if self.inputs.as_ref().is_none_or(|(was, _)| *was != stage) {
            self.found = None;
        }
        (self.work, self.refused) = match Work::new(stage, &scenario) {
            Some(Ok(work)) => (Some(work), None),
            Some(Err(refused)) => (None, Some(refused)),
            None => (None, None),
        };
        self.inputs = Some((stage, scenario));
    }

    /// Does a few pieces; returns whether any are left.
    pub fn work(&mut self) -> bool {
        let Some(work) = &mut self.work else { return false };
        let pieces = match (&work, &self.inputs) {
            (Work::Map(_), Some((_, scenario))) if scenario.contact.kind == ContactKind::Clamp => ROWS,
            _ => 1,
        };
        let job = work.job();
        for _ in 0..pieces {
            job.step();
        }
        let complete = job.progress().is_complete();
        // A result that is complete stays until the next one is, so that moving a slider does not flicker; the table
        // fills in at once, for its numbers are means already.
        if complete || self.found.is_none() || matches!(work, Work::Table(_)) {
            self.found = Some(work.found());
            self.version += 1;
        }
        if complete {
            self.work = None;
        }
        !complete
    }

    /// What has been found, and a number that changes with it.
    #[must_use]
    pub fn found(&self) -> Option<(&Found, u64)> {
        self.found.as_ref().map(|found| (found, self.version))
    }

    /// How far the work is; none when nothing is being done.
    pub fn progress(&self) -> Option<Progress> {
        self.work.as_ref().map(Work::progress)
    }

    /// Why there is nothing to show.
    #[must_use]
    pub fn refused(&self) -> Option<&ScenarioError> {
        self.refused.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finish(studies: &mut Studies) -> usize {
        let mut frames = 1;
        while studies.work() {
            frames += 1;
        }
        frames
    }

    #[test]
    fn work_is_done_in_pieces_and_again_when_its_inputs_change() {
        let mut studies = Studies::default();
        let mut scenario = Scenario::default();
        for stage in Stage::ALL {
            studies.update(stage, &scenario);
            let frames = finish(&mut studies);
            // Both of the tuning view have studies of their own.
            let none = matches!(stage, Stage::Robot | Stage::Chain | Stage::Tuning | Stage::Detectors);
            assert_eq!(studies.found().is_some(), !none, "{stage:?}");
            assert!(none || stage == Stage::Figure3 || frames > 1, "{stage:?}: {frames} frames");
            assert_eq!(studies.progress(), None);
        }
        studies.update(Stage::Map, &scenario);
        finish(&mut studies);
        let before = studies.found().map(|(_, version)| version);
        scenario.contact.place = Place::Nowhere;
        studies.update(Stage::Map, &scenario);
        assert!(!studies.work(), "the map does not depend on the contact");
        scenario.filter.length = 100;
        studies.update(Stage::Map, &scenario);
        finish(&mut studies);
        assert_ne!(studies.found().map(|(_, version)| version), before);
    }

    #[test]
    fn what_cannot_be_made_says_why() {
        let mut studies = Studies::default();
        let mut scenario = Scenario::default();
        scenario.robot.disks = vec![0.01];
        scenario.contact.place = Place::disk(1);
        studies.update(Stage::Table2, &scenario);
        assert!(!studies.work());
        let why = studies.refused().map(ToString::to_string).unwrap_or_default();
        assert!(why.contains("robot.disks"), "{why}");
    }
}
