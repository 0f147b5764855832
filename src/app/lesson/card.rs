//! The card that speaks: what a step is about, what is to be done, and the way on.

use super::tour::{STEPS, Step, TOUR, choice, control};
use super::{At, Lesson, Wish};
use crate::app::command::Command;
use crate::app::controls::row::{self, Context};
use crate::app::controls::table::GROUPS;
use crate::app::fonts;
use crate::app::layout;
use crate::app::state::State;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::widgets::text;
use centrode_core::scenario::Scenario;
use egui::{
    Align2, CursorIcon, Galley, Rect, Response, Role, ScrollArea, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo,
    pos2, vec2,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Space at the card's edges, points.
pub(super) const PAD: f32 = 14.0;
/// Height of the line above the title and of the bar below, points.
const HEAD: f32 = 34.0;
const FOOT: f32 = 48.0;
/// Width that the sign before a task takes.
const SIGN: f32 = 26.0;
/// Size of the text, points.
const SIZE: f32 = 13.5;

/// What the card is drawn from.
pub struct Inputs<'a> {
    /// What is set.
    pub state: &'a State,
    /// The preset's scenario.
    pub base: &'a Scenario,
    /// What was refused last, by key.
    pub notes: &'a BTreeMap<&'static str, String>,
    /// What is known of the lessons.
    pub lesson: &'a Lesson,
    /// Whether the panel of controls is on the page.
    pub panel: bool,
    /// Whether what is touched is to be large enough for a finger.
    pub touch: bool,
}

impl Inputs<'_> {
    /// The step that is open, from 0.
    fn step(&self) -> Option<(usize, &'static Step)> {
        match self.state.lesson? {
            At::Tour(step) => Some((step, TOUR.get(step)?)),
        }
    }

    /// Keys of the controls that the page does not show elsewhere.
    fn controls(&self, step: &Step) -> impl Iterator<Item = &'static str> {
        let shown = |key: &str| {
            let group = GROUPS.iter().find(|group| group.holds(key));
            self.panel && group.is_some_and(|group| !self.state.folded.contains(group.name))
        };
        step.controls.iter().copied().filter(move |key| !shown(key))
    }
}

/// A text over several lines.
pub(super) fn set_text(ui: &Ui, said: &str, width: f32, size: f32, ink: egui::Color32) -> Arc<Galley> {
    let mut job = text::rich(said, size, ink);
    job.wrap.max_width = width;
    job.sections.iter_mut().for_each(|section| section.format.line_height = Some(1.45 * size));
    ui.painter().layout_job(job)
}

/// How high the card has to be for all that it holds, where it is so wide, points.
#[must_use]
pub fn height(ui: &Ui, width: f32, inputs: &Inputs<'_>) -> f32 {
    let Some((_, step)) = inputs.step() else { return 0.0 };
    let ink = Theme::of(ui).ink;
    let inner = width - 2.0 * PAD;
    let high = |said: &str, width: f32| set_text(ui, said, width, SIZE, ink).size().y;
    let task = high(step.task, inner - SIGN - 10.0).max(high(step.noticed, inner - SIGN - 10.0));
    let row = |key| match (control(key).is_some(), inputs.touch) {
        (true, true) => 67.0,
        (true, false) => 48.0,
        (false, true) => 66.0,
        (false, false) => 58.0,
    };
    let rows: f32 = inputs.controls(step).map(row).sum();
    HEAD + 28.0 + high(step.text, inner) + 10.0 + task + 18.0 + rows + if rows > 0.0 { 8.0 } else { 0.0 } + FOOT + 6.0
}

/// Shows the card.
pub fn card(ui: &mut Ui, rect: Rect, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let Some((place, step)) = inputs.step() else { return };
    let theme = Theme::of(ui);
    head(ui, rect, (place, step), inputs, out);
    let body = Rect::from_min_max(pos2(rect.left(), rect.top() + HEAD), pos2(rect.right(), rect.bottom() - FOOT));
    layout::inside(ui, "lesson body", body, |ui| {
        ScrollArea::vertical().id_salt(("lesson", place)).auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(PAD as i8, 0)).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                let width = ui.available_width();
                let title = ui.painter().layout_no_wrap(step.title.into(), fonts::strong(16.5), theme.ink);
                written(ui, title, step.title, Role::Heading);
                ui.add_space(6.0);
                let said = set_text(ui, step.text, width, SIZE, theme.ink.lerp_to_gamma(theme.dim, 0.25));
                written(ui, said, step.text, Role::Label);
                ui.add_space(10.0);
                task(ui, step, inputs.lesson.is_done(place), &theme);
                let keys: Vec<_> = inputs.controls(step).collect();
                if !keys.is_empty() {
                    ui.add_space(8.0);
                    keys.into_iter().for_each(|key| one_control(ui, key, inputs, out));
                }
            });
        });
    });
    foot(ui, rect, place, inputs, out);
}

/// Paints a text where the layout goes on, with what it is to assistive technology.
pub(super) fn written(ui: &mut Ui, galley: Arc<Galley>, said: &str, role: Role) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), galley.size().y), Sense::hover());
    ui.painter().galley(rect.min, galley, Theme::of(ui).ink);
    response.widget_info(|| WidgetInfo::labeled(role, true, said));
    response
}

fn head(ui: &mut Ui, rect: Rect, (place, step): (usize, &Step), inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let line = Rect::from_min_size(rect.min, vec2(rect.width(), HEAD));
    let said = format!("Tour, {} of {STEPS}", place + 1);
    let at = line.left_center() + vec2(PAD, 2.0);
    let drawn = text::paint(ui, at, Align2::LEFT_CENTER, &said, fonts::regular(12.5), theme.dim);
    let response = ui.interact(drawn, ui.scope_id().with("lesson head"), Sense::hover());
    let heard = format!("Step {} of {STEPS}: {}", place + 1, step.title);
    response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &heard));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_live(egui::accesskit::Live::Polite));
    let mut dot = drawn.right_center() + vec2(18.0, 0.5);
    for other in 0..STEPS {
        let color = if inputs.lesson.is_done(other) { theme.sensor } else { theme.faint };
        let radius = if other == place { 4.5 } else { 3.0 };
        if other == place {
            ui.painter().circle_stroke(dot, radius, Stroke::new(1.5, theme.accent));
        }
        ui.painter().circle_filled(dot, if other == place { 2.5 } else { radius }, color);
        dot.x += 12.0;
    }
    let corner = Rect::from_center_size(line.right_center() - vec2(22.0, -2.0), vec2(30.0, 30.0));
    let close = ui.push_id("leave", |ui| icon::button(ui, corner, Icon::Close, "Leave tour", Look::Plain)).inner;
    if close.clicked() {
        out.push(Command::Lesson(Wish::Leave));
    }
}

/// What is to be done; once it is done, what that has shown.
fn task(ui: &mut Ui, step: &Step, done: bool, theme: &Theme) {
    let width = ui.available_width();
    let size = |said| set_text(ui, said, width - SIGN - 10.0, SIZE, theme.ink);
    let [task, noticed] = [size(step.task), size(step.noticed)];
    let high = task.size().y.max(noticed.size().y) + 14.0;
    let (rect, response) = ui.allocate_exact_size(vec2(width, high), Sense::hover());
    let color = if done { theme.sensor } else { theme.accent };
    ui.painter().rect(rect, 8.0, theme.raised, Stroke::new(1.0, color.gamma_multiply(0.6)), StrokeKind::Inside);
    let sign = pos2(rect.left() + 15.0, rect.top() + 7.0 + 0.72 * SIZE);
    if done {
        ui.painter().circle_filled(sign, 8.0, color);
        let tick = [(-3.6, 0.2), (-1.0, 2.9), (3.8, -2.9)].map(|(x, y)| sign + vec2(x, y));
        ui.painter().add(Shape::line(tick.to_vec(), Stroke::new(2.0, theme.panel)));
    } else {
        ui.painter().circle_stroke(sign, 7.0, Stroke::new(2.0, color));
    }
    let (said, galley) = if done { (step.noticed, noticed) } else { (step.task, task) };
    ui.painter().galley(rect.min + vec2(SIGN + 4.0, 7.0), galley, theme.ink);
    let heard = if done { format!("Done. {said}") } else { format!("To do: {said}") };
    response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &heard));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_live(egui::accesskit::Live::Polite));
}

fn one_control(ui: &mut Ui, key: &'static str, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let (scenario, base, touch) = (&inputs.state.scenario, inputs.base, inputs.touch);
    let note = inputs.notes.get(key).map(String::as_str);
    ui.push_id(("lesson", key), |ui| {
        if let Some(control) = control(key) {
            let remembered = inputs.state.otherwise(control, base);
            row::number(ui, control, &Context { scenario, base, note, remembered, touch }, out);
        } else if let Some(choice) = choice(key) {
            row::choice(ui, choice, &Context { scenario, base, note, remembered: None, touch }, out);
        }
    });
}

fn foot(ui: &mut Ui, rect: Rect, place: usize, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let bar = Rect::from_min_max(pos2(rect.left() + PAD, rect.bottom() - FOOT + 4.0), rect.max - vec2(PAD, 8.0));
    let last = place + 1 == STEPS;
    let next = if last { "Finish" } else { "Next" };
    let right = bar.with_min_x(bar.right() - 96.0);
    if on_accent(ui, right, next, inputs.lesson.is_done(place), &theme) {
        out.push(Command::Lesson(if last { Wish::Leave } else { Wish::Tour(place + 1) }));
    }
    let left = bar.with_max_x(bar.left() + 74.0);
    if place > 0 && button(ui, left, "Back", &theme) {
        out.push(Command::Lesson(Wish::Tour(place - 1)));
    }
    let middle = Rect::from_min_size(pos2(left.right() + 8.0, bar.top()), vec2(84.0, bar.height()));
    if middle.right() < right.left() - 4.0 && place > 0 && button(ui, middle, "Keep this", &theme) {
        out.push(Command::Lesson(Wish::Keep));
    }
}

/// A button that stands out where it is the way on.
pub(super) fn on_accent(ui: &mut Ui, rect: Rect, label: &str, prominent: bool, theme: &Theme) -> bool {
    if !prominent {
        return button(ui, rect, label, theme);
    }
    let id = ui.make_persistent_id(("button", label));
    let response = ui.interact(rect, id, Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), label));
    let fill = theme.accent.lerp_to_gamma(theme.ink, if response.hovered() { 0.12 } else { 0.0 });
    ui.painter().rect_filled(rect, 7.0, fill);
    if response.has_focus() {
        ui.painter().rect_stroke(rect, 7.0, Stroke::new(2.0, theme.ink), StrokeKind::Outside);
    }
    text::paint(ui, rect.center(), Align2::CENTER_CENTER, label, fonts::strong(13.0), theme.on_accent);
    response.clicked()
}
