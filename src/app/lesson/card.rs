//! The card that speaks: what a step is about, what is to be done, and the way on.

use super::tour::{STEPS, Step, TOUR, choice, control};
use super::{At, Lesson, Wish};
use crate::app::command::Command;
use crate::app::controls::row::{self, Context, TARGET};
use crate::app::controls::table::GROUPS;
use crate::app::fonts;
use crate::app::layout;
use crate::app::state::State;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::finger;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::widgets::symbol;
use crate::app::widgets::text;
use centrode_core::scenario::Scenario;
use egui::{
    Align2, CursorIcon, Galley, Pos2, Rect, Response, Role, ScrollArea, Sense, Shape, Stroke, StrokeKind, Ui,
    WidgetInfo, pos2, vec2,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Space at the card's edges, points.
pub(super) const PAD: f32 = 14.0;
/// Height of the line above the title and of the bar below, points.
pub(super) const HEAD: f32 = 34.0;
pub(super) const FOOT: f32 = 48.0;
/// Width that the sign before a task takes.
const SIGN: f32 = 26.0;
/// Size of the text, points.
pub(super) const SIZE: f32 = 13.5;

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
            _ => None,
        }
    }

    /// Keys of the controls that the page does not show elsewhere.
    fn hidden(&self, keys: &'static [&'static str]) -> impl Iterator<Item = &'static str> {
        let shown = |key: &str| {
            let group = GROUPS.iter().find(|group| group.holds(key));
            self.panel && group.is_some_and(|group| !self.state.folded.contains(group.name))
        };
        keys.iter().copied().filter(move |key| !shown(key))
    }
}

/// A text over several lines.
pub(super) fn set_text(ui: &Ui, said: &str, width: f32, size: f32, ink: egui::Color32) -> Arc<Galley> {
    let mut job = text::rich_lines(said, size, ink, 1.45);
    job.wrap.max_width = width;
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
    let rows = rows(inputs, step.controls);
    HEAD + 28.0 + high(step.text, inner) + 10.0 + task + 18.0 + rows + FOOT + 6.0
}

/// How high the controls are that the card shows, with the space above them, points.
pub(super) fn rows(inputs: &Inputs<'_>, keys: &'static [&'static str]) -> f32 {
    let row = |key| match (control(key).is_some(), inputs.touch) {
        (true, true) => 93.0,
        (true, false) => 48.0,
        (false, true) => 94.0,
        (false, false) => 58.0,
    };
    let rows: f32 = inputs.hidden(keys).map(row).sum();
    if rows > 0.0 { rows + 8.0 } else { 0.0 }
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
                controls(ui, inputs, step.controls, out);
            });
        });
    });
    let last = place + 1 == STEPS;
    let on = if last { Wish::Leave } else { Wish::Tour(place + 1) };
    let back = place.checked_sub(1);
    let way = Way {
        next: (if last { "Finish" } else { "Next" }, on, inputs.lesson.is_done(place)),
        back: back.map(|step| ("Back", Wish::Tour(step))),
        keep: back.is_some(),
    };
    foot(ui, rect, &way, out);
}

/// Paints a text where the layout goes on, with what it is to assistive technology.
pub(super) fn written(ui: &mut Ui, galley: Arc<Galley>, said: &str, role: Role) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), galley.size().y), Sense::hover());
    symbol::galley(ui.painter(), rect.min, galley, Theme::of(ui).ink);
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
    leave(ui, line, "Leave tour", out);
}

/// The way out, at the right end of a line.
pub(super) fn leave(ui: &mut Ui, line: Rect, name: &str, out: &mut Vec<Command>) {
    let down = if finger::is_welcome(ui) { 0.5 * (TARGET - HEAD) } else { 2.0 };
    let corner = Rect::from_center_size(line.right_center() + vec2(-22.0, down), vec2(30.0, 30.0));
    if ui.push_id("leave", |ui| icon::button(ui, corner, Icon::Close, name, Look::Plain)).inner.clicked() {
        out.push(Command::Lesson(Wish::Leave));
    }
}

/// A circle, with a tick once something is done.
pub(super) fn sign(ui: &Ui, at: Pos2, done: bool, theme: &Theme) {
    if !done {
        ui.painter().circle_stroke(at, 7.0, Stroke::new(2.0, theme.accent));
        return;
    }
    ui.painter().circle_filled(at, 8.0, theme.sensor);
    let tick = [(-3.6, 0.2), (-1.0, 2.9), (3.8, -2.9)].map(|(x, y)| at + vec2(x, y));
    ui.painter().add(Shape::line(tick.to_vec(), Stroke::new(2.0, theme.panel)));
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
    sign(ui, pos2(rect.left() + 15.0, rect.top() + 7.0 + 0.72 * SIZE), done, theme);
    let (said, galley) = if done { (step.noticed, noticed) } else { (step.task, task) };
    symbol::galley(ui.painter(), rect.min + vec2(SIGN + 4.0, 7.0), galley, theme.ink);
    let heard = if done { format!("Done. {said}") } else { format!("To do: {said}") };
    response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &heard));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_live(egui::accesskit::Live::Polite));
}

/// Shows the controls that the page does not show elsewhere.
pub(super) fn controls(ui: &mut Ui, inputs: &Inputs<'_>, keys: &'static [&'static str], out: &mut Vec<Command>) {
    if rows(inputs, keys) > 0.0 {
        ui.add_space(8.0);
        inputs.hidden(keys).for_each(|key| one_control(ui, key, inputs, out));
    }
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

/// Where the buttons below lead.
pub(super) struct Way<'a> {
    /// Word, where to, and whether it stands out.
    pub next: (&'a str, Wish, bool),
    /// Word and where to.
    pub back: Option<(&'a str, Wish)>,
    /// Whether what is set can be kept.
    pub keep: bool,
}

pub(super) fn foot(ui: &mut Ui, rect: Rect, way: &Way<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let bar = Rect::from_min_max(pos2(rect.left() + PAD, rect.bottom() - FOOT + 4.0), rect.max - vec2(PAD, 8.0));
    let (next, on, prominent) = way.next;
    let right = bar.with_min_x(bar.right() - 96.0);
    if on_accent(ui, right, next, prominent, &theme) {
        out.push(Command::Lesson(on));
    }
    let left = bar.with_max_x(bar.left() + 74.0);
    if let Some((word, back)) = way.back
        && button(ui, left, word, &theme)
    {
        out.push(Command::Lesson(back));
    }
    let middle = Rect::from_min_size(pos2(left.right() + 8.0, bar.top()), vec2(84.0, bar.height()));
    if middle.right() < right.left() - 4.0 && way.keep && button(ui, middle, "Keep this", &theme) {
        out.push(Command::Lesson(Wish::Keep));
    }
}

/// A button that stands out where it is the way on.
pub(super) fn on_accent(ui: &mut Ui, rect: Rect, label: &str, prominent: bool, theme: &Theme) -> bool {
    if !prominent {
        return button(ui, rect, label, theme);
    }
    let id = ui.make_persistent_id(("button", label));
    let response = ui.interact(finger::around(ui, rect), id, Sense::click());
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), label));
    let fill = theme.accent.lerp_to_gamma(theme.ink, if response.hovered() { 0.12 } else { 0.0 });
    ui.painter().rect_filled(rect, 7.0, fill);
    text::paint(ui, rect.center(), Align2::CENTER_CENTER, label, fonts::strong(13.0), theme.on_accent);
    response.clicked()
}
