//! The panel of controls: groups that fold, and a reset of everything.

pub mod contact;
pub mod control;
pub mod quantity;
pub mod row;
mod span;
pub mod table;

use std::collections::BTreeMap;

use egui::{Align2, CursorIcon, Frame, Margin, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};

use crate::app::charts::notation;
use crate::app::command::Command;
use crate::app::controls::control::{Control, Group};
use crate::app::controls::table::GROUPS;
use crate::app::fonts;
use crate::app::layout;
use crate::app::memo::recorded::Recorded;
use crate::app::mirror;
use crate::app::panels::sheet;
use crate::app::state::State;
use crate::app::theme::Theme;
use crate::app::widgets::{icon, text};
use crate::app::words::log;
use centrode_core::scenario::Scenario;
use row::Context;

/// Below this height there is no foot, points.
pub const LEAST: f32 = 110.0;

/// What the panel needs to know.
pub struct Inputs<'a> {
    /// What is set.
    pub state: &'a State,
    /// The preset's scenario.
    pub base: &'a Scenario,
    /// What was refused last, by key.
    pub notes: &'a BTreeMap<&'static str, String>,
    /// Why the scenario as a whole is not the one that was run.
    pub refusal: Option<String>,
    /// The log in place of a simulation.
    pub log: Option<&'a Recorded>,
    /// Whether rows are to be large enough for a finger.
    pub touch: bool,
}

/// Shows the controls.
pub fn controls(ui: &mut Ui, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let edge = if inputs.touch { 4.0 } else { 10.0 };
    let mut scrolled = ui.max_rect();
    // A sheet that is hardly drawn out has no foot.
    if scrolled.height() > LEAST {
        let (above, foot) = scrolled.split_top_bottom_at_y(scrolled.bottom() - 52.0);
        layout::inside(ui, "reset", foot.shrink2(vec2(16.0, edge)), |ui| reset_all(ui, inputs, out));
        scrolled = above;
    }
    let mut ui = ui.new_child(UiBuilder::new().max_rect(scrolled));
    sheet::scrolled(&mut ui, |ui| {
        Frame::new().inner_margin(Margin { left: 16, right: 16, top: 6, bottom: 6 }).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            if let Some(refusal) = &inputs.refusal {
                row::refusal(ui, &format!("{refusal}. What is shown is the last run that was possible."));
            }
            for group in GROUPS {
                show_group(ui, group, inputs, out);
            }
        });
    });
}

/// The head of a group, by which it folds; returns whether it is open.
pub fn header(ui: &mut Ui, name: &'static str, open: bool, touch: bool, out: &mut Vec<Command>) -> bool {
    let theme = Theme::of(ui);
    let height = if touch { row::TARGET } else { 29.0 };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click());
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), open, name));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_expanded(open));
    let shown = ui.ctx().animate_bool(response.id, open);
    let ink = if response.hovered() || response.has_focus() { theme.ink } else { theme.dim };
    text::paint(ui, rect.left_center(), Align2::LEFT_CENTER, name, fonts::strong(12.5), theme.ink);
    icon::chevron(ui.painter(), rect.right_center() - vec2(6.0, 0.0), shown, ink);
    if response.clicked() {
        out.push(Command::Fold(name));
    }
    open
}

fn show_group(ui: &mut Ui, group: &'static Group, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    if !header(ui, group.name, !inputs.state.folded.contains(group.name), inputs.touch, out) {
        return;
    }
    ui.push_id(group.name, |ui| {
        mirror::mark(ui, mirror::Part::Group, group.name);
        let scenario = &inputs.state.scenario;
        let (base, touch) = (inputs.base, inputs.touch);
        let note = |key| inputs.notes.get(key).map(String::as_str);
        let idle = |key: &str| inputs.log.is_some_and(|recorded| log::idle(key, recorded));
        if let Some(note) = inputs.log.and_then(|_| idle_note(group, &idle)) {
            ui.add(egui::Label::new(egui::RichText::new(note).size(11.5).color(theme.dim)).wrap());
            ui.add_space(4.0);
        }
        let number = |ui: &mut Ui, control: &'static Control, out: &mut Vec<Command>| {
            let remembered = inputs.state.otherwise(control, base);
            let context = Context { scenario, base, note: note(control.key), remembered, touch };
            ui.add_enabled_ui(!idle(control.key), |ui| row::number(ui, control, &context, out));
        };
        for control in group.controls.iter().filter(|control| control.only.is_none()) {
            number(ui, control, out);
        }
        for choice in group.choices {
            let context = Context { scenario, base, note: note(choice.of.path), remembered: None, touch };
            ui.add_enabled_ui(!idle(choice.of.path), |ui| row::choice(ui, choice, &context, out));
        }
        for control in group.controls.iter().filter(|control| control.only.is_some_and(|only| only(scenario))) {
            number(ui, control, out);
        }
        if !group.note.is_empty() {
            ui.add_space(6.0);
            let job = notation::job(group.note, 11.5, theme.dim);
            ui.add(egui::Label::new(job).wrap());
            ui.add_space(8.0);
        }
    });
}

/// What is said of a group while a log is shown.
fn idle_note(group: &Group, idle: &dyn Fn(&str) -> bool) -> Option<&'static str> {
    let keys = group.controls.iter().map(|control| control.key);
    let mut keys = keys.chain(group.choices.iter().map(|choice| choice.of.path)).map(idle);
    match (keys.clone().any(|idle| idle), keys.all(|idle| idle)) {
        (false, _) => None,
        (true, true) => Some("These make simulations. They do not change the log that is shown."),
        (true, false) => Some("What is dimmed makes simulations. It does not change the log that is shown."),
    }
}

fn reset_all(ui: &mut Ui, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let changed = inputs.state.scenario != *inputs.base;
    reset_button(ui, changed, &crate::app::panels::title::name(inputs.state.preset()), out);
}

/// The button that restores a preset, by its name on the page.
pub fn reset_button(ui: &mut Ui, changed: bool, preset: &str, out: &mut Vec<Command>) {
    let label = egui::RichText::new("Reset all").font(if changed { fonts::strong(13.0) } else { fonts::regular(13.0) });
    let button = egui::Button::new(label);
    let tip = format!("Restore the scenario of the preset “{preset}”");
    if ui.centered_and_justified(|ui| ui.add(button)).inner.on_hover_text(tip).clicked() {
        out.push(Command::ResetAll);
    }
}
