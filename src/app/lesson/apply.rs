//! Going through the lessons: the page is put where they begin, looked at, and put back.

use super::card;
use super::challenge::check::Verdict;
use super::challenge::{self, CHALLENGES};
use super::tour::{Focus, STEPS, TOUR};
use super::{At, Kept, Wish};
use crate::app::App;
use crate::app::command::Command;
use crate::app::controls::control::Group;
use crate::app::controls::table::GROUPS;
use crate::app::layout::Layout;
use crate::app::link::Effect;
use crate::app::stages::stage::Stage;
use crate::app::state::{self, State};
use centrode_core::detect::Method;

/// What is on the page, for what tells that a step is done.
pub struct Seen<'a> {
    /// What is set.
    pub state: &'a State,
    /// The run shown.
    pub run: &'a centrode_core::run::Run,
    /// The run of several segments, while that is shown.
    pub chain: Option<&'a crate::app::chain::memo::Memo>,
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
            Wish::Challenges => self.enter(ctx, At::Challenges),
            Wish::Challenge(which) => self.enter(ctx, At::Challenge(which.min(CHALLENGES.len() - 1))),
            Wish::UnfoldHint => self.lesson.unfolded.0 ^= true,
            Wish::UnfoldAnswer => self.lesson.unfolded.1 ^= true,
            Wish::ShowAnswer => {
                if let Some(At::Challenge(which)) = self.state.lesson {
                    self.apply(ctx, &mut (CHALLENGES[which].show)());
                }
            }
            Wish::Leave => {
                // Who leaves at the end has seen it.
                if self.state.lesson == Some(At::Tour(STEPS - 1)) {
                    self.lesson.progress.tour = 1;
                }
                self.leave_lesson();
            }
            Wish::Keep => {
                self.state.lesson = None;
                // What was set gives way; a log is no setting.
                if let Some(log) = self.lesson.kept.take().and_then(|kept| kept.log) {
                    self.memo.update(&self.state.scenario);
                    self.memo.put_back(log);
                }
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
        self.lesson.unfolded = (false, false);
        let (begin, controls) = match at {
            At::Tour(step) => {
                self.lesson.progress.tour = step + 1;
                (TOUR[step].begin, TOUR[step].controls)
            }
            At::Challenge(which) => (CHALLENGES[which].begin, CHALLENGES[which].controls),
            At::Challenges => return,
        };
        let mut commands: Vec<Command> = begin();
        commands.extend(self.unfold(controls));
        self.apply(ctx, &mut commands);
        if let At::Challenge(which) = at {
            self.lesson.check.begin(which, &self.state.scenario);
        }
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

    /// Makes a run of the open challenge, unless something is being `moved`. Returns whether more are to be made.
    pub(in crate::app) fn challenge(&mut self, moved: bool) -> bool {
        let Some(At::Challenge(_)) = self.state.lesson else { return false };
        self.lesson.check.update(self.memo.plan().scenario());
        if moved { self.lesson.check.is_working() } else { self.lesson.check.work() }
    }

    /// The surroundings could not keep how far the person has come.
    pub fn progress_not_kept(&mut self) {
        self.lesson.kept_as = None;
    }

    /// Hands out how far the person has come, where it is kept and has changed.
    pub(in crate::app) fn keep_progress(&mut self) {
        if let Some(kept) = &mut self.lesson.kept_as {
            let now = self.lesson.progress.text();
            if *kept != now {
                kept.clone_from(&now);
                self.sharing.hand_out(Effect::Keep(now));
            }
        }
    }

    /// Notices what has been done.
    pub(in crate::app) fn observe(&mut self) {
        let step = match self.state.lesson {
            Some(At::Tour(step)) => step,
            Some(At::Challenge(which)) => {
                if let Some(Verdict::Measured(true, _)) = self.lesson.verdict() {
                    self.lesson.progress.met.insert(CHALLENGES[which].key.into());
                }
                return;
            }
            _ => return,
        };
        let run = self.memo.run();
        let time = self.cursor();
        let detection = run.detection().map(|detection| detection.time);
        let began = *self.lesson.began.get_or_insert(detection);
        let placed = self.memo.placed().at(time).is_some_and(|shown| shown.estimate().is_some());
        let chain = self.chained();
        let seen = Seen { state: &self.state, run, chain, time, began, plate: &self.lesson.plate, placed };
        if (TOUR[step].done)(&seen) {
            self.lesson.progress.done.insert(step + 1);
        }
    }
}

impl App {
    /// Makes room for the card where a lesson is open.
    pub(in crate::app) fn lay_out(&self, ui: &egui::Ui, layout: Layout) -> Layout {
        let Some(at) = self.state.lesson.filter(|_| self.embed.is_none()) else { return layout };
        let inputs = card::Inputs {
            state: &self.state,
            base: &self.base,
            notes: &self.notes,
            lesson: &self.lesson,
            panel: layout.controls.is_some(),
            touch: layout.sheet,
        };
        let width = layout.lesson_width();
        let (need, focus) = match at {
            At::Tour(step) => (card::height(ui, width, &inputs), TOUR[step].focus),
            At::Challenge(which) => (challenge::card::height(ui, width, &inputs), CHALLENGES[which].focus),
            At::Challenges => (challenge::card::height(ui, width, &inputs), Focus::Robot),
        };
        // Whoever looks at something else sees that.
        let elsewhere = focus == Focus::Plate && self.state.stage != Stage::Robot;
        layout.with_lesson(need, if elsewhere { Focus::Robot } else { focus })
    }
}
