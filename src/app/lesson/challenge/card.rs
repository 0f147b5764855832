//! The card of the challenges: all of them, or one with its goal, what was measured, hint and answer.

use super::check::Verdict;
use super::{CHALLENGES, Challenge};
use crate::app::command::Command;
use crate::app::controls::row::TARGET;
use crate::app::fonts;
use crate::app::layout;
use crate::app::lesson::card::{self, FOOT, HEAD, Inputs, PAD, SIZE, Way, leave, set_text, written};
use crate::app::lesson::{At, Wish};
use crate::app::theme::Theme;
use crate::app::widgets::{finger, icon, symbol, text};
use crate::app::words::refusal;
use egui::{Align2, CursorIcon, Rect, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

/// Height of one challenge in the list, points.
const ITEM: f32 = 44.0;
/// Height of what unfolds a hint, points.
const FOLD: f32 = 34.0;
/// Height of what shows the answer, with the space around it, points.
const SHOW: f32 = 36.0;
/// What is said where a browser keeps nothing.
const UNKEPT: &str = "Progress is not kept here.";

/// How high the card has to be where it is so wide, points.
#[must_use]
pub fn height(ui: &Ui, width: f32, inputs: &Inputs<'_>) -> f32 {
    let Some(At::Challenge(which)) = inputs.state.lesson else {
        return HEAD + 34.0 + (ITEM + 4.0) * CHALLENGES.len() as f32 + 28.0;
    };
    let Some(of) = CHALLENGES.get(which) else { return 0.0 };
    let inner = width - 2.0 * PAD;
    let high = |said: &str, width: f32| set_text(ui, said, width, SIZE, Theme::of(ui).ink).size().y;
    let goal = high(of.goal, inner - 20.0) + high(&measured(inputs), inner - 46.0) + 36.0;
    let (hint, answer) = inputs.lesson.unfolded;
    let [fold, show] = [FOLD, SHOW].map(|height: f32| if inputs.touch { height.max(TARGET) } else { height });
    let open = |open: bool, said: &str| fold + if open { high(said, inner - 8.0) + 6.0 } else { 0.0 };
    let shown = open(hint, of.hint) + open(answer, of.answer) + if answer { show + 6.0 } else { 0.0 };
    HEAD + 28.0 + high(of.text, inner) + 10.0 + goal + card::rows(inputs, of.controls) + shown + FOOT + 10.0
}

/// Shows the card.
pub fn card(ui: &mut Ui, rect: Rect, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    match inputs.state.lesson {
        Some(At::Challenge(which)) if which < CHALLENGES.len() => one(ui, rect, which, inputs, out),
        _ => list(ui, rect, inputs, out),
    }
}

fn head(ui: &mut Ui, rect: Rect, said: &str, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let line = Rect::from_min_size(rect.min, vec2(rect.width(), HEAD));
    let at = line.left_center() + vec2(PAD, 2.0);
    text::paint(ui, at, Align2::LEFT_CENTER, said, fonts::regular(12.5), theme.dim);
    leave(ui, line, "Leave challenges", out);
}

fn list(ui: &mut Ui, rect: Rect, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let met = CHALLENGES.iter().filter(|of| inputs.lesson.is_met(of.key)).count();
    head(ui, rect, &format!("Challenges, {met} of {} met", CHALLENGES.len()), out);
    let body = rect.with_min_y(rect.top() + HEAD).shrink2(vec2(PAD, 0.0));
    layout::inside(ui, "challenges", body, |ui| {
        ScrollArea::vertical().id_salt("challenges").auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 4.0;
            for (which, of) in CHALLENGES.iter().enumerate() {
                if item(ui, of, inputs.lesson.is_met(of.key), &theme) {
                    out.push(Command::Lesson(Wish::Challenge(which)));
                }
            }
            if !inputs.lesson.is_kept() {
                let galley = set_text(ui, UNKEPT, ui.available_width(), 12.0, theme.dim);
                written(ui, galley, UNKEPT, Role::Label);
            }
        });
    });
}

fn item(ui: &mut Ui, of: &Challenge, met: bool, theme: &Theme) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ITEM), Sense::click());
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, of.title));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_description(if met { "Met" } else { "Not met yet" }));
    let warm = if response.hovered() { 0.06 } else { 0.0 };
    let fill = theme.raised.lerp_to_gamma(theme.ink, warm);
    ui.painter().rect(rect, 8.0, fill, Stroke::new(1.0, theme.faint), StrokeKind::Inside);
    card::sign(ui, rect.left_center() + vec2(18.0, 0.0), met, theme);
    let at = rect.left_center() + vec2(36.0, 0.0);
    text::paint(ui, at, Align2::LEFT_CENTER, of.title, fonts::strong(13.5), theme.ink);
    icon::chevron(ui.painter(), rect.right_center() - vec2(14.0, 0.0), 0.0, theme.dim);
    response.clicked()
}

/// What was measured, in words.
fn measured(inputs: &Inputs<'_>) -> String {
    match inputs.lesson.check.verdict() {
        Some(Verdict::Measuring(made, of)) => format!("Measuring: {made} of {of} runs"),
        Some(Verdict::Forbidden(path)) => {
            let name = refusal::called(path).unwrap_or(path);
            format!("{name} is to stay as it was: reset it, and the rest is measured again.")
        }
        Some(Verdict::Measured(_, said)) => said,
        None => String::new(),
    }
}

fn one(ui: &mut Ui, rect: Rect, which: usize, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let of = &CHALLENGES[which];
    head(ui, rect, &format!("Challenge {} of {}", which + 1, CHALLENGES.len()), out);
    let body = Rect::from_min_max(pos2(rect.left(), rect.top() + HEAD), pos2(rect.right(), rect.bottom() - FOOT));
    layout::inside(ui, "challenge body", body, |ui| {
        ScrollArea::vertical().id_salt(("challenge", which)).auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(PAD as i8, 0)).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                let width = ui.available_width();
                let title = ui.painter().layout_no_wrap(of.title.into(), fonts::strong(16.5), theme.ink);
                written(ui, title, of.title, Role::Heading);
                ui.add_space(6.0);
                let ink = theme.ink.lerp_to_gamma(theme.dim, 0.25);
                let said = set_text(ui, of.text, width, SIZE, ink);
                written(ui, said, of.text, Role::Label);
                ui.add_space(10.0);
                goal(ui, of, inputs, &theme);
                card::controls(ui, inputs, of.controls, out);
                let (hint, answer) = inputs.lesson.unfolded;
                if fold(ui, "Hint", hint, &theme) {
                    out.push(Command::Lesson(Wish::UnfoldHint));
                }
                if hint {
                    told(ui, of.hint, ink);
                }
                if fold(ui, "Worked answer", answer, &theme) {
                    out.push(Command::Lesson(Wish::UnfoldAnswer));
                }
                if answer {
                    told(ui, of.answer, ink);
                    let (bar, _) = ui.allocate_exact_size(vec2(110.0, finger::at_least(ui, SHOW)), Sense::hover());
                    if crate::app::widgets::button::button(ui, bar.shrink2(vec2(0.0, 2.0)), "Show me", &theme) {
                        out.push(Command::Lesson(Wish::ShowAnswer));
                    }
                }
            });
        });
    });
    let met = matches!(inputs.lesson.check.verdict(), Some(Verdict::Measured(true, _)));
    let next = (which + 1 < CHALLENGES.len()).then_some(Wish::Challenge(which + 1));
    let way = Way {
        next: (if next.is_some() { "Next" } else { "Finish" }, next.unwrap_or(Wish::Challenges), met),
        back: Some(("All", Wish::Challenges)),
        keep: true,
    };
    card::foot(ui, rect, &way, out);
}

/// What is to be reached, and how far that is.
fn goal(ui: &mut Ui, of: &Challenge, inputs: &Inputs<'_>, theme: &Theme) {
    let width = ui.available_width();
    let verdict = inputs.lesson.check.verdict();
    let met = matches!(verdict, Some(Verdict::Measured(true, _)));
    let said = measured(inputs);
    let goal = set_text(ui, of.goal, width - 20.0, SIZE, theme.ink);
    let ink = if matches!(verdict, Some(Verdict::Forbidden(_))) { theme.error } else { theme.ink };
    let found = set_text(ui, &said, width - 46.0, SIZE, ink);
    let (rect, response) = ui.allocate_exact_size(vec2(width, goal.size().y + found.size().y + 28.0), Sense::hover());
    let color = if met { theme.sensor } else { theme.accent };
    ui.painter().rect(rect, 8.0, theme.raised, Stroke::new(1.0, color.gamma_multiply(0.6)), StrokeKind::Inside);
    let below = rect.top() + 8.0 + goal.size().y + 10.0;
    symbol::galley(ui.painter(), rect.min + vec2(10.0, 8.0), goal, theme.ink);
    ui.painter().hline(rect.x_range().shrink(10.0), below - 5.0, Stroke::new(1.0, theme.faint));
    card::sign(ui, pos2(rect.left() + 18.0, below + 0.72 * SIZE), met, theme);
    symbol::galley(ui.painter(), pos2(rect.left() + 34.0, below), found, ink);
    if let Some(Verdict::Measuring(made, of)) = verdict {
        let share = made as f32 / of.max(1) as f32;
        let line = Rect::from_min_size(rect.left_bottom() - vec2(-10.0, 4.0), vec2((width - 20.0) * share, 2.0));
        ui.painter().rect_filled(line, 1.0, theme.accent);
    }
    let heard = format!("Goal: {} {}{said}", of.goal, if met { "Met. " } else { "" });
    response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &heard));
    if !matches!(inputs.lesson.check.verdict(), Some(Verdict::Measuring(..))) {
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_live(egui::accesskit::Live::Polite));
    }
}

fn fold(ui: &mut Ui, name: &str, open: bool, theme: &Theme) -> bool {
    let size = vec2(ui.available_width(), finger::at_least(ui, FOLD));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, open, name));
    let ink = if response.hovered() || response.has_focus() { theme.accent } else { theme.ink };
    icon::chevron(ui.painter(), rect.left_center() + vec2(6.0, 0.0), f32::from(u8::from(open)), ink);
    text::paint(ui, rect.left_center() + vec2(20.0, 0.0), Align2::LEFT_CENTER, name, fonts::strong(13.0), ink);
    response.clicked()
}

fn told(ui: &mut Ui, said: &str, ink: egui::Color32) {
    let galley = set_text(ui, said, ui.available_width() - 8.0, SIZE, ink);
    written(ui, galley, said, Role::Label);
    ui.add_space(6.0);
}
