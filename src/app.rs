//! The interface.
//!
//! [`state::State`] is all that a person sets. [`memo::Memo`] turns its scenario into a run when that changes. Panels
//! and views read both and emit [`command::Command`]s; `apply` carries them out, and nothing else changes state.
//!
//! Time comes from egui's input alone, so that a test's pictures do not move.

mod apply;
pub mod chain;
pub mod charts;
pub mod command;
pub mod controls;
pub mod embed;
pub mod fonts;
pub mod helper;
mod keys;
pub mod layout;
pub mod lesson;
pub mod link;
pub mod log;
pub mod memo;
pub mod message;
pub mod mirror;
mod page;
pub mod panels;
mod report;
pub mod saving;
pub mod stages;
pub mod state;
pub mod theme;
pub mod widgets;
pub mod words;

use std::collections::BTreeMap;

use egui::Ui;

use centrode_core::run::Run;
use centrode_core::scenario::Scenario;
use chain::Chain;
use charts::plots::PlotState;
use command::Command;
use embed::Embed;
use helper::Helper;
use helper::lent::Lent;
use lesson::Lesson;
use lesson::captions::{self, Captions};
use link::Sharing;
use log::Logs;
use memo::Memo;
use message::Listener;
use panels::chip::Chip;
use panels::cover::Cover;
use panels::gallery::Gallery;
use stages::StageState;
use stages::comparer::Comparer;
use stages::source::Source;
use stages::stage::Stage;
use stages::studies::Studies;
use stages::tuner::Tuner;
use stages::viewport::ViewState;
use state::State;

/// The longest step of playback, s: after a pause of the whole page the cursor does not leap.
const LONGEST_STEP: f64 = 0.25;
/// The longest press that is a click, s. Slow hands, and a page that is slow to draw, take longer than egui's 0.8 s.
const LONGEST_CLICK: f64 = 3.0;
/// What is lower than this in a sheet that is hardly drawn out is not shown, points.
const SEEN: f32 = 24.0;

/// What the surroundings tell and lend.
#[derive(Debug, Default)]
pub struct Host {
    /// Whether the person asked for less motion.
    pub prefers_reduced_motion: bool,
    /// Who makes studies outside the interface; without, they are made between frames.
    pub helper: Option<Box<dyn Helper>>,
    /// Who reads logs outside the interface; without, they are read between frames.
    pub log_helper: Option<Box<dyn Helper>>,
    /// The page's address, without its fragment; empty where it has none.
    pub address: String,
    /// The fragment of the address, without `#`: a link.
    pub fragment: String,
    /// What of the page is shown; none for all of it.
    pub embed: Option<Embed>,
    /// Whether a host page listens, see [`message`].
    pub hosted: bool,
    /// How far the person had come in the lessons, as [`link::Effect::Keep`] said; none where that cannot be kept.
    pub progress: Option<String>,
}

/// The whole page.
pub struct App {
    state: State,
    base: Scenario,
    memo: Memo,
    chain: Chain,
    pictures: chain::Pictures,
    notes: BTreeMap<&'static str, String>,
    chip: Chip,
    plots: PlotState,
    view: ViewState,
    studies: Studies,
    tuner: Tuner,
    comparer: Comparer,
    stages: StageState,
    source: Option<Source>,
    sharing: Sharing,
    embed: Option<Embed>,
    listener: Option<Listener>,
    logs: Logs,
    lesson: Lesson,
    captions: Captions,
    gallery: Gallery,
    cover: Cover,
    prefers_reduced_motion: bool,
}

impl App {
    /// A page that opens playing, unless its link says where to stand. Without a render state there is no 3D view.
    #[must_use]
    pub fn new(ctx: &egui::Context, render_state: Option<&egui_wgpu::RenderState>, host: Host) -> Self {
        let state = State::default();
        dress(ctx, &state, host.prefers_reduced_motion);
        let untouched = host.fragment.is_empty() && host.embed.is_none() && !host.hosted;
        let [helper, other, third] = Lent::shares(host.helper);
        let mut app = Self {
            base: state::shipped(state.preset()),
            memo: Memo::new(&state.scenario),
            chain: Chain::new(third),
            pictures: chain::Pictures::default(),
            sharing: Sharing::new(host.address, &state),
            state,
            notes: BTreeMap::new(),
            chip: Chip::default(),
            plots: PlotState::new(host.embed.is_some()),
            studies: Studies::default(),
            tuner: Tuner::new(helper),
            comparer: Comparer::new(other),
            stages: StageState::default(),
            source: None,
            logs: Logs::new(host.log_helper),
            lesson: Lesson::new(host.progress),
            captions: Captions::new(untouched),
            gallery: Gallery::default(),
            cover: Cover::default(),
            view: ViewState::new(render_state, host.prefers_reduced_motion),
            prefers_reduced_motion: host.prefers_reduced_motion,
            embed: host.embed,
            listener: host.hosted.then(Listener::default),
        };
        // Nothing moves in the tuning that playback would show, and what moves by itself is not welcome to all.
        app.state.playing = host.embed != Some(Embed::Tuning) && !host.prefers_reduced_motion;
        app.go(&host.fragment);
        app
    }

    /// Goes on as it is in another context, with another render state: those before are gone, and what they held with them.
    pub fn go_on_in(&mut self, ctx: &egui::Context, render_state: Option<&egui_wgpu::RenderState>) {
        dress(ctx, &self.state, self.prefers_reduced_motion);
        if let Some(name) = self.view.draw_with(render_state) {
            self.not_saved(&name, "The graphics were lost before it was drawn.");
        }
    }

    /// What is set.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The run shown.
    #[must_use]
    pub fn run(&self) -> &Run {
        self.memo.run()
    }

    /// What was refused last, by key of the control.
    #[must_use]
    pub fn notes(&self) -> &BTreeMap<&'static str, String> {
        &self.notes
    }

    /// The study behind the tuning view.
    #[must_use]
    pub fn tuner(&self) -> &Tuner {
        &self.tuner
    }

    /// The comparison behind the view of detectors.
    #[must_use]
    pub fn comparer(&self) -> &Comparer {
        &self.comparer
    }

    /// Whether work for what is on the stage is left to do.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.studies.progress().is_some()
            || self.tuner.progress().is_some()
            || self.comparer.progress().is_some()
            || self.gallery.is_working()
            || self.lesson.is_measuring(self.state.lesson)
            || self.state.stage == Stage::Robot && self.memo.placed().is_working()
            || self.state.stage == Stage::Chain && self.chain.is_working()
    }

    /// The whole page.
    pub fn ui(&mut self, ui: &mut Ui) {
        let mut out = Vec::new();
        // A pass that is done again has had its keys and its time already.
        if ui.ctx().current_pass_index() == 0 {
            // Before the keys are taken.
            self.captions.go_on(self.state.playing, captions::touched(ui));
            keys::read(ui, self.end(), self.state.stage, self.holder(ui), &mut out);
            out.extend(self.lesson.due.take().map(Command::Lesson));
            self.advance(ui);
            self.apply(ui.ctx(), &mut out);
            if self.work_log() {
                ui.ctx().request_repaint();
            }
        }
        self.update();
        self.study(ui);
        self.place(ui);
        self.page(ui, &mut out);
        self.apply(ui.ctx(), &mut out);
        if self.update() {
            // Views were drawn before the controls were read: draw this frame again, with the new run.
            ui.ctx().request_discard("the scenario has changed");
        }
        self.observe();
        self.keep_progress();
        self.tell(ui);
        self.take_picture(ui.ctx());
        self.tell_host();
        if self.state.playing {
            ui.ctx().request_repaint();
        }
    }

    /// A few pieces of the work for what is on the stage.
    fn study(&mut self, ui: &Ui) {
        let (stage, live) = (self.state.stage, self.memo.plan().scenario());
        Source::update(&mut self.source, stage, (&self.state.preset, &self.base), live);
        self.studies.update(stage, self.source.as_ref().map_or(live, |source| &source.scenario));
        if ui.ctx().current_pass_index() == 0 && self.studies.work() {
            ui.ctx().request_repaint();
        }
        let scenario = self.memo.plan().scenario();
        // A pointer or a key that is down may be moving a threshold.
        let moving = ui.input(|input| input.pointer.any_down() || !input.keys_down.is_empty());
        let on = |stage: Stage| (self.state.stage == stage).then_some(scenario);
        // Whoever is not looked at ends what a helper does for it, before the other asks.
        self.tuner.update(on(Stage::Tuning), self.state.tuning.repeats, moving);
        self.comparer.update(on(Stage::Detectors), &self.state.tuning, moving);
        let frame = ui.input(|input| input.stable_dt);
        if ui.ctx().current_pass_index() == 0 && self.challenge(moving) {
            ui.ctx().request_repaint();
        }
        if ui.ctx().current_pass_index() == 0 && (self.tuner.work(frame) | self.comparer.work()) {
            ui.ctx().request_repaint();
        }
    }

    /// Brings the runs up to date with what is set. Returns whether that had changed.
    fn update(&mut self) -> bool {
        let chained = self.chain.update(&self.state.chain, self.state.stage == Stage::Chain);
        self.memo.update(&self.state.scenario) | chained
    }

    /// One more estimate of where a contact is, for the robot's views.
    fn place(&mut self, ui: &Ui) {
        if ui.ctx().current_pass_index() != 0 {
            return;
        }
        let time = self.cursor();
        // What is being moved is made anew in every frame: estimates wait for the pointer.
        let moving = ui.input(|input| input.pointer.any_down());
        let more = match self.state.stage {
            Stage::Robot => self.memo.place(time),
            Stage::Chain if !moving => self.chain.memo.as_mut().is_some_and(|memo| memo.work(time)),
            _ => false,
        };
        if more {
            ui.ctx().request_repaint();
        }
    }

    /// The run of several segments, while that is what is looked at.
    fn chained(&self) -> Option<&chain::memo::Memo> {
        self.chain.memo.as_ref().filter(|_| self.state.stage == Stage::Chain)
    }

    fn end(&self) -> f64 {
        self.chained().map_or_else(|| memo::end(self.memo.run()), chain::memo::Memo::end)
    }

    /// Where playback opens and loops to, s.
    fn lead_in(&self) -> f64 {
        self.chained().map_or_else(|| self.memo.lead_in(), chain::memo::Memo::lead_in)
    }

    /// The cursor, inside the run.
    fn cursor(&self) -> f64 {
        self.state.time.clamp(0.0, self.end())
    }

    fn advance(&mut self, ui: &Ui) {
        if !self.state.playing {
            return;
        }
        let step = ui.input(|input| f64::from(input.stable_dt)).min(LONGEST_STEP) * self.state.speed;
        let (from, end) = (self.cursor(), self.end());
        let time = from + step;
        self.pass(from, time.min(end));
        if time < end {
            self.state.time = time;
        } else if self.state.looping {
            self.captions.end();
            self.state.time = self.lead_in();
        } else {
            self.state.time = end;
            self.state.playing = false;
        }
    }
}

/// Gives a context the page's looks and manners.
fn dress(ctx: &egui::Context, state: &State, still: bool) {
    theme::install(ctx);
    if still {
        theme::hold_still(ctx);
    }
    ctx.set_theme(state.theme.preference());
    ctx.options_mut(|options| options.input_options.max_click_duration = LONGEST_CLICK);
}

#[cfg(test)]
mod tests;
