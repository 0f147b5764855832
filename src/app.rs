//! The interface.
//!
//! [`state::State`] is all that a person sets. [`memo::Memo`] turns its scenario into a run when that changes. Panels
//! and views read both and emit [`command::Command`]s; `App::apply` carries them out, and nothing else changes state.
//!
//! Time comes from egui's input alone, so that a test's pictures do not move.

pub mod charts;
pub mod command;
pub mod controls;
pub mod fonts;
mod keys;
pub mod layout;
pub mod memo;
pub mod panels;
pub mod stages;
pub mod state;
pub mod theme;
pub mod widgets;
pub mod words;

use std::collections::BTreeMap;

use egui::{Rect, Ui, vec2};

use centrode_core::detect::Method;
use centrode_core::run::Run;
use centrode_core::scenario::Scenario;
use centrode_core::scenario::keys::find;
use centrode_core::scenario::preset::Preset;
use centrode_core::scenario::{Contact, Place, Start, Xi1Rule};
use centrode_core::study::tuning::watch::Rule;
use charts::plane;
use charts::plots::{self, PlotState};
use command::Command;
use controls::Inputs;
use controls::control::Control;
use layout::Layout;
use memo::Memo;
use panels::chip::Chip;
use stages::StageState;
use stages::source::Source;
use stages::stage::{Section, Stage};
use stages::studies::Studies;
use stages::tuner::{Helper, Tuner};
use stages::viewport::{self, ViewState};
use state::{State, Tab};
use words::refusal;
use words::story::{self, Phase};

/// The longest step of playback, s: after a pause of the whole page the cursor does not leap.
const LONGEST_STEP: f64 = 0.25;

/// What the surroundings tell and lend.
#[derive(Debug, Default)]
pub struct Host {
    /// Whether the person asked for less motion.
    pub prefers_reduced_motion: bool,
    /// Who makes studies outside the interface; without, they are made between frames.
    pub helper: Option<Box<dyn Helper>>,
}

/// The whole page.
pub struct App {
    state: State,
    base: Scenario,
    memo: Memo,
    notes: BTreeMap<&'static str, String>,
    chip: Chip,
    plots: PlotState,
    view: ViewState,
    studies: Studies,
    tuner: Tuner,
    stages: StageState,
    source: Option<Source>,
    prefers_reduced_motion: bool,
}

impl App {
    /// A page that opens playing. Without a render state there is no 3D view.
    #[must_use]
    pub fn new(ctx: &egui::Context, render_state: Option<&egui_wgpu::RenderState>, host: Host) -> Self {
        theme::install(ctx);
        let state = State::default();
        ctx.set_theme(state.theme.preference());
        Self {
            base: state::shipped(state.preset()),
            memo: Memo::new(&state.scenario),
            state,
            notes: BTreeMap::new(),
            chip: Chip::default(),
            plots: PlotState::default(),
            studies: Studies::default(),
            tuner: Tuner::new(host.helper),
            stages: StageState::default(),
            source: None,
            view: ViewState::new(render_state, host.prefers_reduced_motion),
            prefers_reduced_motion: host.prefers_reduced_motion,
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

    /// Whether work for what is on the stage is left to do.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.studies.progress().is_some() || self.tuner.progress().is_some()
    }

    /// The page in a line of JSON: state at the cursor, cursor (s), detection of the run (s, m), playing, and a sentence.
    #[must_use]
    pub fn report(&self) -> String {
        let (run, time) = (self.memo.run(), self.cursor());
        serde_json::json!({
            "state": Phase::at(run, time).words().to_lowercase(),
            "time": time,
            "detection_time": run.detection().map(|detection| detection.time),
            "location": run.detection().map(|detection| detection.location),
            "playing": self.state.playing,
            "summary": story::sentence(run),
            "tuning": (self.state.stage == Stage::Tuning).then(|| self.tuner.report(self.state.tuning.rule)).flatten(),
        })
        .to_string()
    }

    /// The whole page.
    pub fn ui(&mut self, ui: &mut Ui) {
        let mut out = Vec::new();
        // A pass that is done again has had its keys and its time already.
        if ui.ctx().current_pass_index() == 0 {
            keys::read(ui, self.end(), self.state.help, &mut out);
            self.advance(ui);
            self.apply(ui.ctx(), &mut out);
        }
        self.memo.update(&self.state.scenario);
        self.study(ui);
        self.page(ui, &mut out);
        self.apply(ui.ctx(), &mut out);
        if self.memo.update(&self.state.scenario) {
            // Views were drawn before the controls were read: draw this frame again, with the new run.
            ui.ctx().request_discard("the scenario has changed");
        }
        if self.state.playing {
            ui.ctx().request_repaint();
        }
    }

    /// A few pieces of the work for what is on the stage.
    fn study(&mut self, ui: &Ui) {
        let (stage, live) = (self.state.stage, self.memo.run().plan.scenario());
        Source::update(&mut self.source, stage, (&self.state.preset, &self.base), live);
        self.studies.update(stage, self.source.as_ref().map_or(live, |source| &source.scenario));
        if ui.ctx().current_pass_index() == 0 && self.studies.work() {
            ui.ctx().request_repaint();
        }
        let scenario = self.memo.run().plan.scenario();
        // A pointer or a key that is down may be moving a threshold.
        let moving = ui.input(|input| input.pointer.any_down() || !input.keys_down.is_empty());
        self.tuner.update((self.state.stage == Stage::Tuning).then_some(scenario), self.state.tuning.repeats, moving);
        let frame = ui.input(|input| input.stable_dt);
        if ui.ctx().current_pass_index() == 0 && self.tuner.work(frame) {
            ui.ctx().request_repaint();
        }
    }

    fn end(&self) -> f64 {
        self.memo.run().plan.scenario().motion.end
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
        let (time, end) = (self.cursor() + step, self.end());
        if time < end {
            self.state.time = time;
        } else if self.state.looping {
            self.state.time = state::lead_in(self.memo.run().plan.scenario());
        } else {
            self.state.time = end;
            self.state.playing = false;
        }
    }

    fn page(&mut self, ui: &mut Ui, out: &mut Vec<Command>) {
        let theme = theme::Theme::of(ui);
        let page = ui.ctx().content_rect();
        let mut whole = ui.new_child(egui::UiBuilder::new().id_salt("page").max_rect(page));
        whole.set_clip_rect(page);
        let ui = &mut whole;
        ui.painter().rect_filled(page, 0.0, theme.surface);
        let sheet = match (self.prefers_reduced_motion, self.state.sheet) {
            (true, open) => f32::from(u8::from(open)),
            (false, open) => ui.ctx().animate_bool_responsive(egui::Id::unique("sheet"), open),
        };
        let layout = Layout::new(page, sheet);
        let cursor = self.cursor();
        let otherwise = |method: Method| (method, self.state.otherwise_si(method.threshold_key(), &self.base));
        self.plots.otherwise = Method::ALL.iter().copied().map(otherwise).collect();
        let Self {
            state,
            base,
            memo,
            notes,
            chip,
            plots,
            view,
            studies,
            tuner,
            stages,
            source,
            prefers_reduced_motion,
        } = self;
        let (state, run) = (&*state, memo.run());

        panels::title::title(ui, layout.title, state, out);
        panels::views::views(ui, layout.views, state.stage, state.paper, out);
        panels::title::tools(ui, layout.tools, state, layout.sheet, out);
        if let Some(rect) = layout.controls {
            let refusal = memo.refusal().map(refusal::told);
            let inputs = Inputs { state, base, notes, refusal, touch: layout.sheet };
            layout::card(ui, "controls", rect, |ui| controls::controls(ui, &inputs, out));
        }
        let robot = state.stage == Stage::Robot;
        let covered = layout.stage();
        if robot {
            layout::card(ui, "view", layout.view, |ui| viewport::viewport(ui, run, memo.trace(), cursor, view));
            layout::round(ui, layout.view);
            chip.show(ui, layout.view.min + vec2(12.0, 12.0), Phase::at(run, cursor), *prefers_reduced_motion);
        } else {
            let inputs = stages::Inputs {
                stage: state.stage,
                run,
                base: (&state.preset, base),
                source: source.as_ref(),
                tuner,
                tuning: state.tuning,
            };
            layout::card(ui, "stage", covered, |ui| stages::stage(ui, covered, &inputs, studies, stages, out));
        }
        layout::card(ui, "transport", layout.transport, |ui| {
            panels::transport::transport(ui, layout.transport, (state, run, cursor), out);
        });
        let mut show = |ui: &mut Ui, tab: Tab, rect: Rect, out: &mut Vec<Command>| match tab {
            Tab::Result => layout::inside(ui, "readout", rect, |ui| panels::readout::readout(ui, run)),
            Tab::Plots => layout::inside(ui, "plots", rect.shrink(8.0), |ui| {
                // Where they do not fit above each other they are scrolled.
                let low = rect.width() < 796.0 && rect.height() < 430.0;
                if low {
                    let area = egui::ScrollArea::vertical().auto_shrink(false);
                    area.show(ui, |ui| plots::plots(ui, (run, memo.version()), cursor, plots, out));
                } else {
                    plots::plots(ui, (run, memo.version()), cursor, plots, out);
                }
            }),
            Tab::Plane => {
                layout::inside(ui, "plane", rect.shrink(8.0), |ui| plane::plane(ui, run, memo.trace(), cursor, out))
            }
        };
        for (tab, rect) in [(Tab::Plane, layout.plane), (Tab::Result, layout.readout), (Tab::Plots, layout.plots)] {
            if let Some(rect) = rect.filter(|rect| robot || !covered.contains_rect(*rect)) {
                layout::card(ui, "card", rect, |_| ());
                show(ui, tab, rect, out);
            }
        }
        if let Some(rect) = layout.tabbed.filter(|rect| robot || !covered.contains_rect(*rect)) {
            layout::card(ui, "tabbed", rect, |_| ());
            let (strip, below) = layout::tab_strip(rect);
            panels::tabs::tabs(ui, strip, state.tab, out);
            show(ui, state.tab, below, out);
        }
        if state.help {
            words::help::help(ui, out);
        }
    }

    /// Carries out commands. The only place where state changes, besides the passing of time.
    fn apply(&mut self, ctx: &egui::Context, commands: &mut Vec<Command>) {
        for command in commands.drain(..) {
            match command {
                Command::Seek(time) if time.is_finite() => self.state.time = time.clamp(0.0, self.end()),
                Command::Seek(_) => {}
                Command::Pause => self.state.playing = false,
                Command::TogglePlay => self.toggle_play(),
                Command::Step(hundredths) => {
                    self.state.playing = false;
                    let time = self.cursor() + f64::from(hundredths) * 0.01;
                    self.state.time = ((time * 1e6).round() / 1e6).clamp(0.0, self.end());
                }
                Command::SetSpeed(speed) => self.state.speed = speed.clamp(0.1, 4.0),
                Command::ToggleLoop => self.state.looping = !self.state.looping,
                Command::Choose(preset) => {
                    // Whoever chooses another experiment wants to see it: a figure would go on showing its own.
                    if self.state.stage.own_preset().is_some_and(|own| own != preset.name) {
                        self.state.stage = Stage::Robot;
                    }
                    self.choose(preset);
                }
                Command::Show(stage) => {
                    self.state.stage = stage;
                    if stage.section() == Section::Paper {
                        self.state.paper = stage;
                    }
                }
                Command::Touch { arc_length, bend } => self.change(&["contact.disk", "contact.time"], |s| {
                    s.contact = Contact { place: Place::ArcLength(arc_length), start: Start::Bend(bend) };
                    Ok(())
                }),
                Command::Tune(tuning) => self.state.tuning = tuning,
                Command::Take { rule, threshold, length } => self.take(rule, threshold, length),
                Command::HoldStudy(held) => self.tuner.hold(held),
                Command::ResetAll => self.load(self.base.clone()),
                Command::SetXi1(xi1) => self.change(&["detection.xi1"], |s| {
                    s.detection.xi1 = xi1;
                    Ok(())
                }),
                Command::SetXi2(xi2) => self.change(&["detection.xi2"], |s| {
                    s.detection.xi2 = xi2;
                    Ok(())
                }),
                Command::SetArmedFrom(time) => self.change(&["detection.armed_from"], |s| {
                    s.detection.armed_from = time;
                    Ok(())
                }),
                Command::Set(control, value) => self.change(&[control.key], |s| {
                    control.slide(s, value);
                    Ok(())
                }),
                Command::Enter(control, text) => self.change(&[control.key], |s| control.enter(s, &text)),
                Command::Switch(control, on) => self.switch(control, on),
                Command::Pick(choice, option) => self.change(&[choice.of.path], |s| {
                    choice.of.choose(s, option);
                    Ok(())
                }),
                Command::Reset(control) => self.restore(control.key, |from, to| control.copy(from, to)),
                Command::ResetChoice(choice) => self.restore(choice.of.path, |from, to| choice.of.copy(from, to)),
                Command::NextTheme => {
                    self.state.theme = self.state.theme.next();
                    ctx.set_theme(self.state.theme.preference());
                }
                Command::Fold(group) => {
                    if !self.state.folded.remove(group) {
                        self.state.folded.insert(group.into());
                    }
                }
                Command::ShowTab(tab) => self.state.tab = tab,
                Command::ToggleSheet => self.state.sheet = !self.state.sheet,
                Command::ToggleHelp => self.state.help = !self.state.help,
            }
        }
    }

    /// Takes what a study has shown.
    fn take(&mut self, rule: Rule, threshold: f64, length: Option<u64>) {
        let key = match (rule, self.state.scenario.detection.xi1_rule) {
            (Rule::Jfd, Xi1Rule::Constant) => "detection.xi1",
            (Rule::Jfd, Xi1Rule::Bound) => "detection.xi1_factor",
            _ => "detection.xi2",
        };
        self.change(&[key, "filter.length"], |s| {
            if let Some(key) = find(key) {
                key.set_number(s, threshold);
            }
            s.filter.length = length.unwrap_or(s.filter.length);
            Ok(())
        });
    }

    fn choose(&mut self, preset: &Preset) {
        self.state.preset = preset.name.into();
        self.base = state::shipped(preset);
        self.load(self.base.clone());
        self.state.time = state::lead_in(&self.state.scenario);
    }

    fn toggle_play(&mut self) {
        self.state.playing = !self.state.playing;
        if self.state.playing && self.cursor() >= self.end() {
            self.state.time = state::lead_in(self.memo.run().plan.scenario());
        }
    }

    fn load(&mut self, scenario: Scenario) {
        self.notes.clear();
        self.state.remembered.clear();
        self.state.scenario = scenario;
    }

    /// Changes what controls (`asked`, by key) set if what comes out can be run; else says why not, beside the one of them
    /// that is refused or beside the first, and changes nothing.
    fn change(&mut self, asked: &[&'static str], change: impl FnOnce(&mut Scenario) -> Result<(), String>) {
        let mut scenario = self.state.scenario.clone();
        let first = asked.first().copied().unwrap_or_default();
        let checked = change(&mut scenario).map_err(|note| (first, note)).and_then(|()| {
            memo::check(&scenario).map_err(|refused| {
                let control = refusal::control(&refused).map(|control| control.key);
                let key = asked.iter().copied().find(|key| Some(*key) == control).unwrap_or(first);
                (key, refusal::told(&refused))
            })
        });
        match checked {
            Ok(()) => {
                self.remember(&scenario);
                asked.iter().for_each(|key| drop(self.notes.remove(key)));
                self.state.scenario = scenario;
            }
            Err((key, note)) => {
                self.notes.insert(key, format!("{note}. Nothing was changed."));
            }
        }
    }

    /// Keeps the values of controls that a change switches off.
    fn remember(&mut self, next: &Scenario) {
        for control in controls::table::GROUPS.iter().flat_map(|group| group.controls).filter(|c| c.has_off()) {
            if let (Some(value), None) = (control.value(&self.state.scenario), control.value(next)) {
                self.state.remembered.insert(control.key.into(), value);
            }
        }
    }

    fn switch(&mut self, control: &'static Control, on: bool) {
        let value = self.state.otherwise(control, &self.base);
        self.change(&[control.key], |scenario| {
            match (on, value) {
                (true, Some(value)) => control.slide(scenario, value),
                (true, None) => {}
                (false, _) => control.of.switch_off(scenario),
            }
            Ok(())
        });
    }

    fn restore(&mut self, key: &'static str, copy: impl FnOnce(&Scenario, &mut Scenario)) {
        let base = self.base.clone();
        self.change(&[key], |scenario| {
            copy(&base, scenario);
            Ok(())
        });
    }
}

#[cfg(test)]
mod tests;
