//! Playback: play, step, scrub, speed, loop.

use egui::{Align2, Rect, Shape, Stroke, Ui, pos2, vec2};

use crate::app::charts::notation::number;
use crate::app::command::Command;
use crate::app::controls::control::Scale;
use crate::app::controls::quantity;
use crate::app::controls::row::TARGET;
use crate::app::fonts;
use crate::app::memo;
use crate::app::state::State;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::widgets::rail::Rail;
use crate::app::widgets::slider::{self, Slider};
use crate::app::widgets::text;
use crate::app::words::story::{Phase, let_go};
use centrode_core::run::Run;

/// Height in one row, points.
pub const FLAT: f32 = 52.0;
/// Height in two rows, points.
pub const TALL: f32 = 104.0;

/// A mark on the time of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    /// Something touches from a time on, s.
    Contact(f64),
    /// The robot has come off it, s.
    LetGo(f64),
    /// An alarm, s.
    Alarm(f64),
}

/// The time of a run: what stands on its rail.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// When it ends, s.
    pub end: f64,
    /// From when alarms are armed, s.
    pub armed_from: f64,
    /// What happens.
    pub marks: Vec<Mark>,
    /// The same in words.
    pub said: String,
}

impl Track {
    /// Of a run of one segment.
    #[must_use]
    pub fn of(run: &Run) -> Self {
        let contact = run.contact_time().map(Mark::Contact);
        let marks = contact.into_iter().chain(let_go(run).map(|(_, time)| Mark::LetGo(time)));
        let marks = marks.chain(run.detection().map(|detection| Mark::Alarm(detection.time)));
        let armed_from = run.plan.scenario().detection.armed_from;
        Self { end: memo::end(run), armed_from, marks: marks.collect(), said: marks_said(run) }
    }
}

/// Shows playback with the cursor (s) of the views; in two rows where it is narrow.
pub fn transport(ui: &mut Ui, rect: Rect, (state, run, cursor): (&State, &Track, f64), out: &mut Vec<Command>) {
    let narrow = rect.height() > FLAT + 1.0;
    let fingers = narrow || finger::is_welcome(ui);
    let size = if fingers { TARGET } else { 34.0 };
    let y = if narrow { rect.bottom() - 30.0 } else { rect.center().y };
    let mut x = rect.left() + if narrow { 8.0 } else { 10.0 };
    let mut place = |width: f32| {
        x += width;
        Rect::from_center_size(pos2(x - width / 2.0, y), vec2(if fingers { width } else { width - 2.0 }, size))
    };

    // On the narrowest phones the scrub bar alone goes to the start.
    if rect.width() >= 380.0 && icon::button(ui, place(size), Icon::ToStart, "To start", Look::Plain).clicked() {
        out.push(Command::Seek(0.0));
    }
    if icon::button(ui, place(size), Icon::StepBack, "Step back", Look::Plain).clicked() {
        out.push(Command::Step(-1));
    }
    let (sign, label) = if state.playing { (Icon::Pause, "Pause") } else { (Icon::Play, "Play") };
    let round = Rect::from_center_size(place(size + if narrow { 2.0 } else { 8.0 }).center(), vec2(size, size));
    if icon::button(ui, round, sign, label, Look::Accent).clicked() {
        out.push(Command::TogglePlay);
    }
    if icon::button(ui, place(size), Icon::StepForward, "Step forward", Look::Plain).clicked() {
        out.push(Command::Step(1));
    }
    let theme = Theme::of(ui);
    let clock = number(cursor, 3);
    let at = pos2(x + if narrow { 2.0 } else { 12.0 }, y);
    let drawn = text::paint(ui, at, Align2::LEFT_CENTER, &clock, fonts::strong(14.5), theme.ink);
    let unit = text::paint(
        ui,
        drawn.right_center() + vec2(4.0, 0.0),
        Align2::LEFT_CENTER,
        "s",
        fonts::regular(13.0),
        theme.dim,
    );
    let left = at.x + text::width(ui, "00.000", fonts::strong(14.5)) + unit.width() + if narrow { 4.0 } else { 10.0 };

    let mut right = rect.right() - if narrow { 4.0 } else { 10.0 };
    right -= size;
    let look = if state.looping { Look::Lit } else { Look::Plain };
    let corner = Rect::from_center_size(pos2(right + size / 2.0, y), vec2(size, size));
    if icon::button(ui, corner, Icon::Loop, "Loop", look).clicked() {
        out.push(Command::ToggleLoop);
    }
    let rail_width = if narrow { (right - left - 44.0).clamp(44.0, 110.0) } else { 92.0 };
    right -= if narrow { 6.0 } else { 8.0 };
    let word = if narrow { 34.0 } else { 38.0 };
    speed(ui, pos2(right, y), (rail_width, word), size, state, out);
    right -= rail_width + 56.0;

    let track = if narrow {
        Rect::from_min_max(rect.min + vec2(8.0, 6.0), pos2(rect.right() - 8.0, rect.bottom() - 54.0))
    } else {
        let edge = if fingers { 4.0 } else { 8.0 };
        Rect::from_min_max(pos2(left + 4.0, rect.top() + edge), pos2(right, rect.bottom() - edge))
    };
    scrub(ui, track, run, cursor, out);
}

/// The speed: a slider and a word, which are so wide, points.
fn speed(
    ui: &mut Ui,
    right: egui::Pos2,
    (width, word): (f32, f32),
    height: f32,
    state: &State,
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    let spoken = format!("{}×", quantity::number(state.speed, 1));
    text::paint(ui, right, Align2::RIGHT_CENTER, &spoken, fonts::regular(13.0), theme.dim);
    let track = Rect::from_min_max(right - vec2(width + word, height / 2.0), right + vec2(-word, height / 2.0));
    let rail = Rail { range: (0.1, 4.0), scale: Scale::Log(0.1) };
    let (response, moved) = slider::slider(
        ui,
        track,
        &Slider { key: "speed", label: "Speed", spoken: &spoken, rail, value: state.speed, notch: Some(1.0), on: true },
    );
    response.on_hover_text("Speed of playback");
    if let Some(speed) = moved {
        // The natural speed is easy to hit.
        out.push(Command::SetSpeed(if (0.93..1.08).contains(&speed) { 1.0 } else { speed }));
    }
}

fn scrub(ui: &mut Ui, rect: Rect, run: &Track, cursor: f64, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let rail = Rail { range: (0.0, run.end), scale: Scale::Linear(0.001) };
    let spoken = format!("{} s", number(cursor, 3));
    let shape = Slider { key: "time", label: "Time", spoken: &spoken, rail, value: cursor, notch: None, on: true };
    let (response, asked) = slider::sense(ui, rect, &shape);
    if let Some(time) = asked {
        out.push(Command::Seek(time));
    }
    let time = asked.unwrap_or(cursor);
    let (x, y) = (slider::at(rect, rail.place(time)), rect.center().y);
    let at = |time: f64| slider::at(rect, rail.place(time));
    let (start, end) = slider::way(rect);
    let painter = ui.painter();
    let bar = |from: f32, to: f32, half: f32, color| {
        painter.rect_filled(Rect::from_x_y_ranges(from..=to, y - half..=y + half), half, color);
    };
    bar(start, end, 2.5, theme.faint);
    let armed = at(run.armed_from);
    // Before arming the rail is thin: nothing can be noticed there.
    painter.rect_filled(Rect::from_x_y_ranges(start..=armed, y - 3.0..=y - 1.0), 0.0, theme.panel);
    painter.rect_filled(Rect::from_x_y_ranges(start..=armed, y + 1.0..=y + 3.0), 0.0, theme.panel);
    bar(start, x.min(armed).max(start), 1.0, theme.accent);
    if x > armed {
        bar(armed, x, 2.5, theme.accent);
    }
    painter.vline(armed, y - 6.0..=y + 6.0, Stroke::new(1.5, theme.dim));
    for mark in &run.marks {
        match *mark {
            Mark::Contact(time) => {
                painter.add(Shape::convex_polygon(below(at(time), y), theme.obstacle, Stroke::NONE));
            }
            Mark::LetGo(time) => {
                painter.add(Shape::closed_line(below(at(time), y), Stroke::new(1.5, theme.obstacle)));
            }
            Mark::Alarm(time) => {
                let center = pos2(at(time), y - 10.0);
                let points =
                    [vec2(0.0, -5.0), vec2(5.0, 0.0), vec2(0.0, 5.0), vec2(-5.0, 0.0)].map(|v| center + v).to_vec();
                painter.add(Shape::convex_polygon(points, theme.detection, Stroke::NONE));
            }
        }
    }
    slider::paint_handle(ui, &response, x, true);
    response.on_hover_ui(|ui| {
        ui.label(&run.said);
    });
}

/// A triangle below the rail that points at it.
fn below(x: f32, y: f32) -> Vec<egui::Pos2> {
    let top = y + 6.0;
    vec![pos2(x, top), pos2(x + 5.0, top + 8.0), pos2(x - 5.0, top + 8.0)]
}

/// What the marks on the rail are.
fn marks_said(run: &Run) -> String {
    let mut said = format!("Armed from {} s", number(run.plan.scenario().detection.armed_from, 2));
    if let Some(contact) = run.contact_time() {
        said += &format!(" · contact at {} s", number(contact, 3));
    }
    if let Some((how, time)) = let_go(run) {
        said += &format!(" · {how} at {} s", number(time, 3));
    }
    if let Some(detection) = run.detection() {
        let what = match Phase::at(run, detection.time) {
            Phase::FalseAlarm => "false alarm",
            _ => "detected",
        };
        said += &format!(" · {what} at {} s", number(detection.time, 3));
    }
    said
}
