//! Carrying out commands: the only place where state changes, besides the passing of time.

use super::App;
use crate::app::chain::ChainState;
use crate::app::chain::apply::alone;
use crate::app::command::{Command, Mark};
use crate::app::controls::control::Control;
use crate::app::layout::sheet::Stop;
use crate::app::panels::save;
use crate::app::stages::stage::{Section, Stage};
use crate::app::words::refusal;
use crate::app::{controls, memo, state, theme};
use centrode_core::scenario::keys::find;
use centrode_core::scenario::preset::Preset;
use centrode_core::scenario::{Contact, Method, Place, Scenario, Start, Threshold, Thresholds, Xi1Rule};
use centrode_core::study::tuning::watch::Rule;

impl App {
    /// Carries out commands.
    pub(super) fn apply(&mut self, ctx: &egui::Context, commands: &mut Vec<Command>) {
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
                Command::ToggleFrozen => self.state.frozen = !self.state.frozen,
                Command::ToggleLoop => self.state.looping = !self.state.looping,
                Command::Choose(preset) => {
                    // Whoever chooses another experiment wants to see it: a figure would go on showing its own.
                    let own = self.state.stage.own_preset().is_some_and(|own| own != preset.name);
                    if own || self.state.stage == Stage::Chain {
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
                    s.contact = Contact { place: Place::ArcLength(arc_length), start: Start::Bend(bend), ..s.contact };
                    Ok(())
                }),
                Command::Tune(tuning) => self.state.tuning = tuning,
                Command::Take { rule, threshold, length } => self.take(rule, threshold, length),
                Command::TakeDetector { method, threshold } => self.take_detector(method, threshold),
                Command::HoldStudy(held) => match self.state.stage {
                    Stage::Detectors => self.comparer.hold(held),
                    _ => self.tuner.hold(held),
                },
                Command::ResetAll if self.state.stage == Stage::Chain => {
                    let chain = ChainState::of(self.state.chain.preset());
                    let ChainState { segment, all, shown, .. } = self.state.chain;
                    let time = self.cursor();
                    self.load_chain(ChainState { segment, all, shown, ..chain });
                    self.state.time = time;
                }
                Command::ResetAll => self.load(self.base.clone()),
                Command::SetThreshold(method, to) => self.change(&[method.threshold_key()], |s| {
                    *s.detection.of_mut(method) = to;
                    Ok(())
                }),
                Command::SetArmedFrom(time) => self.change(&["detection.armed_from"], |s| {
                    s.detection.armed_from = time;
                    Ok(())
                }),
                Command::Set(control, value) => {
                    self.sharing.slid = Some(control.key);
                    self.change(&[control.key], |s| {
                        control.slide(s, value);
                        Ok(())
                    });
                }
                Command::Enter(control, text) => self.change(&[control.key], |s| control.enter(s, &text)),
                Command::Switch(control, on) => self.switch(control, on),
                Command::Pick(choice, option) => self.change(&[choice.of.path], |s| {
                    match choice.of.is_words() {
                        true => choice.of.hold(s, option, !choice.of.holds(s, option)),
                        false => choice.of.choose(s, option),
                    }
                    Ok(())
                }),
                Command::Reset(control) => self.restore(control.key, |from, to| control.copy(from, to)),
                Command::ResetChoice(choice) => self.restore(choice.of.path, |from, to| choice.of.copy(from, to)),
                Command::NextTheme => self.state.theme = self.state.theme.next(),
                Command::Fold(group) => {
                    if !self.state.folded.remove(group) {
                        self.state.folded.insert(group.into());
                    }
                }
                Command::ShowTab(tab) => {
                    self.state.tab = tab;
                    self.raise_sheet();
                }
                Command::ToggleSheet => self.state.sheet = self.raise_sheet() || !self.state.sheet,
                Command::DrawSheet(stop) => self.state.stop = stop,
                Command::ToggleHelp => self.state.help = !self.state.help,
                Command::ToggleSound => self.state.sound = !self.state.sound,
                Command::ToggleKeys => self.state.keys = !self.state.keys,
                Command::Log(wish) => self.wish_of_log(wish),
                Command::Lesson(wish) => self.wish_of_lesson(ctx, wish),
                Command::Chain(wish) => self.wish_of_chain(wish),
                Command::Theory(symbol) => self.theory(symbol),
                Command::Licences => self.licences(),
                Command::Share(what) => self.share(ctx, what),
                Command::Mark(mark, time) => self.mark(mark, time),
                Command::MarkHere(mark) => self.mark(mark, Some(self.cursor())),
                Command::CopyMarks => self.copy_marks(ctx),
                Command::Save(subject, format) => self.save(subject, format),
                Command::OfferToSave(subject) => save::offer(ctx, subject),
                Command::CloseNotice => self.sharing.notice = None,
                Command::CopyNotice => self.copy_notice(ctx),
            }
        }
        theme::follow(ctx, self.state.theme);
    }

    /// What is asked for in a sheet that only peeks out is wanted whole; returns whether it only did.
    fn raise_sheet(&mut self) -> bool {
        let peeks = self.state.stop == Stop::Peek;
        self.state.stop = if peeks { Stop::Half } else { self.state.stop };
        peeks
    }

    fn mark(&mut self, mark: Mark, time: Option<f64>) {
        self.state.marks[mark as usize] = time.filter(|time| time.is_finite()).map(|time| time.clamp(0.0, self.end()));
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

    /// Takes the threshold of a detector that a comparison has shown, and switches it on.
    fn take_detector(&mut self, method: Method, threshold: f64) {
        let follows = method == Method::Jfd && self.state.scenario.detection.xi1_rule == Xi1Rule::Bound;
        let key = if follows { "detection.xi1_factor" } else { method.threshold_key() };
        self.change(&[key, "detection.detectors"], |s| {
            if follows && s.detection.xi1 == Threshold::OFF {
                s.detection.xi1 = Thresholds::default().xi1;
            }
            if let Some(key) = find(key) {
                key.set_number(s, threshold);
            }
            s.detection.detectors.set(method, true);
            Ok(())
        });
    }

    fn choose(&mut self, preset: &Preset) {
        self.state.preset = preset.name.into();
        self.base = state::shipped(preset);
        self.load(self.base.clone());
        self.state.time = state::lead_in(&self.state.scenario);
    }

    pub(super) fn toggle_play(&mut self) {
        self.state.playing = !self.state.playing;
        if self.state.playing && self.cursor() >= self.end() {
            self.state.time = self.lead_in();
        }
    }

    pub(super) fn load(&mut self, scenario: Scenario) {
        self.notes.clear();
        self.state.remembered.clear();
        self.state.scenario = scenario;
    }

    /// Changes what controls (`asked`, by key) set if what comes out can be run; else says why not, beside the one of them
    /// that is refused or beside the first, and changes nothing.
    fn change(&mut self, asked: &[&'static str], change: impl FnOnce(&mut Scenario) -> Result<(), String>) {
        if self.state.stage == Stage::Chain {
            return self.change_chain(asked, change);
        }
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
    pub(super) fn remember(&mut self, next: &Scenario) {
        let off = switched_off(&self.state.scenario, next).map(|(key, value)| (key.into(), value));
        self.state.remembered.extend(off);
    }

    fn switch(&mut self, control: &'static Control, on: bool) {
        let value = if self.state.stage == Stage::Chain {
            self.otherwise_of_chain(control)
        } else {
            self.state.otherwise(control, &self.base)
        };
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
        let chained = self.chain.base().filter(|_| self.state.stage == Stage::Chain);
        let base = chained.map_or(&self.base, |base| alone(base, self.state.chain.segment, key)).clone();
        self.change(&[key], |scenario| {
            copy(&base, scenario);
            Ok(())
        });
    }
}

/// What is switched off from one experiment to another: key, and the value that was shown.
pub fn switched_off<'s>(now: &'s Scenario, next: &'s Scenario) -> impl Iterator<Item = (&'static str, f64)> + 's {
    let controls = controls::table::GROUPS.iter().flat_map(|group| group.controls).filter(|of| of.has_off());
    controls.filter_map(|of| of.value(now).filter(|_| of.value(next).is_none()).map(|value| (of.key, value)))
}
