//! What is chosen above the pictures of a study, in rows that wrap, with the button that stops the study.

use crate::app::command::Command;
use crate::app::fonts;
use crate::app::panels::save;
use crate::app::saving::Subject;
use crate::app::state::Tuning;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::finger;
use crate::app::widgets::segmented::{Segment, segmented, several_named};
use crate::app::widgets::text::{paint, width};
use egui::{Align2, Rect, Ui, Vec2, pos2, vec2};

/// The shares of false alarms that can be wished for.
pub const WISHES: [(f64, &str); 4] = [(0.01, "1 %"), (0.02, "2 %"), (0.05, "5 %"), (0.1, "10 %")];
/// Repeats that can be chosen.
pub const REPEATS: [(usize, &str); 3] = [(100, "100"), (400, "400"), (1000, "1000")];
/// Height of a row.
const ROW: f32 = 28.0;
/// Height of a label that stands above its options.
const LABEL: f32 = 20.0;

/// One choice.
pub struct Part<'a> {
    label: &'a str,
    options: Vec<&'a str>,
    chosen: Vec<bool>,
    /// Width of the options where there is room.
    wide: f32,
    /// Where several may be chosen, the most options to a row where there is little room.
    several: Option<usize>,
}

impl<'a> Part<'a> {
    /// One of some options; none where no such place is chosen.
    pub fn one(label: &'a str, options: Vec<&'a str>, chosen: usize, wide: f32) -> Self {
        let chosen = (0..options.len()).map(|place| place == chosen).collect();
        Self { label, options, chosen, wide, several: None }
    }

    /// Several of them.
    pub fn several(label: &'a str, options: Vec<&'a str>, chosen: Vec<bool>, (wide, most): (f32, usize)) -> Self {
        Self { label, options, chosen, wide, several: Some(most) }
    }

    /// The share of runs without contact that may alarm.
    pub fn wish(tuning: Tuning) -> Self {
        let chosen = WISHES.iter().position(|(wish, _)| *wish == tuning.wish).unwrap_or(WISHES.len());
        Self::one("False alarms, at most", WISHES.map(|(_, name)| name).to_vec(), chosen, 168.0)
    }

    /// Repeats of each run.
    pub fn repeats(tuning: Tuning) -> Self {
        let chosen = REPEATS.iter().position(|(repeats, _)| *repeats == tuning.repeats).unwrap_or(REPEATS.len());
        Self::one("Runs", REPEATS.map(|(_, name)| name).to_vec(), chosen, 138.0)
    }
}

/// Shows choices, the button that saves `subject`, and how far a `study` is that is not complete (in words, and whether it is held).
/// Returns which part was clicked, and which of its options.
pub fn row(
    ui: &mut Ui,
    (beside, subject): (bool, Subject),
    parts: &[Part<'_>],
    study: Option<(String, bool)>,
    out: &mut Vec<Command>,
) -> Option<(usize, usize)> {
    let theme = Theme::of(ui);
    let (side, high) = (save::side(ui), finger::at_least(ui, ROW));
    let whole = ui.available_width() - side - 8.0;
    let (mut row, mut x) = (ui.allocate_space(vec2(whole, high)).1, 0.0);
    let corner = pos2(row.right() + 8.0 + 0.5 * side, row.center().y);
    save::menu(ui, Rect::from_center_size(corner, Vec2::splat(side)), subject, out);
    let mut clicked = None;
    for (k, part) in parts.iter().enumerate() {
        let Part { label, options, chosen, wide, several: most } = part;
        let head = width(ui, label, fonts::regular(12.0)) + 8.0;
        let fingers = finger::is_welcome(ui);
        let most = most.map(|most| if beside { options.len() } else { most });
        // Rows of boxes have a gap between them.
        let high = if fingers && most.is_some() { high + 2.0 } else { high };
        let wide = if fingers && most.is_none() { wide.max(high * options.len() as f32) } else { *wide };
        // Where options beside their label would be too small they stand below it.
        let below = fingers && !beside && head + wide > whole && most.is_none();
        let head = if below { 0.0 } else { head };
        let wide = if beside { wide } else { (whole - head).min(wide) };
        let rows = most.map_or(1, |most| options.len().div_ceil(most.max(1)));
        let above = if below { LABEL } else { 0.0 };
        let tall = above + high * rows as f32;
        if x > 0.0 && (x + head + wide > whole || rows > 1 || below) {
            (row, x) = (ui.allocate_space(vec2(whole, tall)).1, 0.0);
        } else if tall > row.height() {
            let (_, more) = ui.allocate_space(vec2(whole, tall - row.height()));
            row.max.y = more.max.y;
        }
        let left = row.left() + x;
        let middle = row.top() + 0.5 * if below { LABEL } else { high };
        paint(ui, pos2(left, middle), Align2::LEFT_CENTER, label, fonts::regular(12.0), theme.dim);
        let place = Rect::from_min_size(pos2(left + head, row.top() + above), vec2(wide, high * rows as f32));
        let picked = match most {
            Some(most) => {
                let names: Vec<String> = options.iter().map(|option| format!("{label} {option}")).collect();
                let both = options.iter().zip(&names);
                let all: Vec<_> = both.map(|(text, name)| Segment { text, name, hint: "" }).collect();
                several_named(ui, place, label, (&all, most), |place| chosen[place])
            }
            None => {
                let chosen = chosen.iter().position(|chosen| *chosen).unwrap_or(options.len());
                segmented(ui, place, label, options, chosen)
            }
        };
        clicked = picked.map(|picked| (k, picked)).or(clicked);
        x += head + wide + 16.0;
        if rows > 1 || below {
            x = whole;
        }
    }
    if let Some((hint, held)) = study {
        let label = if held { "Go on" } else { "Stop" };
        let wide = 140.0 + width(ui, label, fonts::regular(12.5));
        if x + wide > whole {
            (row, x) = (ui.allocate_space(vec2(whole, high)).1, 0.0);
        }
        let place = Rect::from_min_size(pos2(row.left() + x, row.top()), vec2(66.0, high));
        if button(ui, place, label, &theme) {
            out.push(Command::HoldStudy(!held));
        }
        let at = pos2(place.right() + 8.0, row.center().y);
        paint(ui, at, Align2::LEFT_CENTER, &hint, fonts::regular(12.0), theme.dim);
    }
    clicked
}
