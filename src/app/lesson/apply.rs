//! Going through the lessons: the page is put where they begin, looked at, and put back.

use super::card;
use super::tour::{STEPS, TOUR};
use super::{At, Kept, Wish};
use crate::app::App;
use crate::app::command::Command;
use crate::app::controls::control::Group;
use crate::app::controls::table::GROUPS;
use crate::app::layout::Layout;
use crate::app::state::{self, State};
use centrode_core::detect::Method;

/// What is on the page, for what tells that a step is done.
pub struct Seen<'a> {
    /// What is set.
    pub state: &'a State,
    /// The run shown.
    pub run: &'a centrode_core::run::Run,
    /// The playback position, s.
    pub time: f64,
    /// When the centrode was first found to deviate as the step began, s.
    pub began: Option<f64>,
    /// The plate of the first step.
    pub plate: &'a super::plate::Plate,
    /// Whether the views show where the calibration filter places the contact.
    pub placed: bool,
}

impl Seen<'_> {
    /// When the centrode is found to deviate, s.
    #[must_use]
    pub fn detection(&self) -> Option<f64> {
        self.run.detection().map(|detection| detection.time)
    }

    /// When a detector first raises an event after the contact, s.
    #[must_use]
    pub fn found_by(&self, method: Method) -> Option<f64> {
        let contact = self.run.contact_time()?;
        let mut events = self.run.events().iter();
        events.find(|event| event.detector == method && event.raised >= contact).map(|event| event.raised)
    }
}

impl App {
    /// What the page knows of the lessons.
    #[must_use]
    pub fn lesson(&self) -> &super::Lesson {
        &self.lesson
    }

    /// What the person has set, lessons aside, and where its playback stands, s.
    pub(in crate::app) fn own(&self) -> (&State, f64) {
        match &self.lesson.kept {
            Some(kept) => (&kept.state, kept.state.time),
            None => (&self.state, self.cursor()),
        }
    }

    /// Does what is wished of the lessons.
    pub(in crate::app) fn wish_of_lesson(&mut self, ctx: &egui::Context, wish: Wish) {
        match wish {
            Wish::Tour(step) => self.enter(ctx, At::Tour(step.min(STEPS - 1))),
            Wish::Leave => self.leave_lesson(),
            Wish::Keep => {
                self.lesson.kept = None;
                self.state.lesson = None;
            }
            Wish::Plate(moved) => self.lesson.plate.apply(moved),
        }
    }

    /// Puts the page where a lesson begins: as it opens, and changed by the lesson's commands.
    fn enter(&mut self, ctx: &egui::Context, at: At) {
        let kept = self.lesson.kept.take().unwrap_or_else(|| self.set_aside());
        self.lesson.kept = Some(kept);
        let fresh = State::default();
        self.state = State { theme: self.state.theme, lesson: Some(at), playing: false, ..fresh };
        self.base = state::shipped(self.state.preset());
        self.load(self.base.clone());
        self.lesson.began = None;
        let At::Tour(step) = at;
        self.lesson.resume = step;
        let mut commands: Vec<Command> = (TOUR[step].begin)();
        commands.extend(self.unfold(TOUR[step].controls));
        self.apply(ctx, &mut commands);
    }

    /// Folds all groups of controls but those that hold these keys, where there are some.
    fn unfold(&self, keys: &[&str]) -> Vec<Command> {
        let wanted = |group: &Group| keys.iter().any(|key| group.holds(key));
        let unlike = |group: &&Group| self.state.folded.contains(group.name) == wanted(group);
        GROUPS.iter().filter(|_| !keys.is_empty()).filter(unlike).map(|group| Command::Fold(group.name)).collect()
    }

    fn set_aside(&mut self) -> Kept {
        let log = self.memo.set_aside();
        let state = State { time: self.cursor(), help: false, sheet: false, lesson: None, ..self.state.clone() };
        Kept { state, log }
    }

    /// Goes back to what was set before the lessons.
    pub(in crate::app) fn leave_lesson(&mut self) {
        let Some(Kept { state, log }) = self.lesson.kept.take() else { return };
        self.state = State { theme: self.state.theme, ..state };
        self.base = state::shipped(self.state.preset());
        self.notes.clear();
        self.memo.update(&self.state.scenario);
        if let Some(log) = log {
            self.memo.put_back(log);
        }
    }

    /// Notices what has been done.
    pub(in crate::app) fn observe(&mut self) {
        let Some(At::Tour(step)) = self.state.lesson else { return };
        let run = self.memo.run();
        let time = self.cursor();
        let detection = run.detection().map(|detection| detection.time);
        let began = *self.lesson.began.get_or_insert(detection);
        let placed = self.memo.placed().at(time).is_some_and(|shown| shown.estimate().is_some());
        let seen = Seen { state: &self.state, run, time, began, plate: &self.lesson.plate, placed };
        let done = (TOUR[step].done)(&seen);
        self.lesson.done[step] |= done;
    }
}

impl App {
    /// Makes room for the card where a lesson is open.
    pub(in crate::app) fn lay_out(&self, ui: &egui::Ui, layout: Layout) -> Layout {
        let Some(At::Tour(step)) = self.state.lesson else { return layout };
        let inputs = card::Inputs {
            state: &self.state,
            base: &self.base,
            notes: &self.notes,
            lesson: &self.lesson,
            panel: layout.controls.is_some(),
            touch: layout.sheet,
        };
        layout.with_lesson(card::height(ui, layout.lesson_width(), &inputs), TOUR[step].focus)
    }
}
