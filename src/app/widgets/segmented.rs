//! A row of options of which one holds, or any.

use egui::{Align2, CursorIcon, Rect, Role, Sense, Stroke, StrokeKind, Ui, UiBuilder, WidgetInfo, vec2};

use crate::app::fonts;
use crate::app::mirror;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use crate::app::widgets::text;

/// Size of the words, points.
const SIZE: f32 = 12.5;

/// One option.
#[derive(Debug, Clone, Copy)]
pub struct Segment<'a> {
    /// What is written on it.
    pub text: &'a str,
    /// Its name to assistive technology.
    pub name: &'a str,
    /// What it is for, shown under the pointer; nothing when empty.
    pub hint: &'a str,
}

/// Shows the options side by side; returns the one that was clicked.
pub fn segmented(ui: &mut Ui, rect: Rect, label: &str, options: &[&str], chosen: usize) -> Option<usize> {
    let options: Vec<_> = options.iter().map(|text| Segment { text, name: text, hint: "" }).collect();
    segments(ui, rect, (label, Role::RadioButton), &options, chosen)
}

/// Shows options any of which can hold, with at most `most` in a row; returns the one that was clicked.
pub fn several(
    ui: &mut Ui,
    rect: Rect,
    label: &str,
    (options, most): (&[&str], usize),
    holds: impl Fn(usize) -> bool,
) -> Option<usize> {
    let options: Vec<_> = options.iter().map(|text| Segment { text, name: text, hint: "" }).collect();
    several_named(ui, rect, label, (&options, most), holds)
}

/// The same, with what each option is to assistive technology.
pub fn several_named(
    ui: &mut Ui,
    rect: Rect,
    label: &str,
    (options, most): (&[Segment<'_>], usize),
    holds: impl Fn(usize) -> bool,
) -> Option<usize> {
    let rows = options.chunks(most.max(1));
    let height = rect.height() / rows.len().max(1) as f32;
    let mut clicked = None;
    for (k, row) in rows.enumerate() {
        let place = Rect::from_min_size(rect.min + vec2(0.0, height * k as f32), vec2(rect.width(), height));
        let first = k * most;
        let name = format!("{label} {k}");
        let place = place.shrink2(vec2(0.0, 1.0));
        clicked = parts(ui, place, (&name, Role::CheckBox), row, |i| holds(first + i)).map(|i| first + i).or(clicked);
    }
    clicked
}

/// The same, with what each option is to assistive technology.
pub fn segments(
    ui: &mut Ui,
    rect: Rect,
    (label, role): (&str, Role),
    options: &[Segment<'_>],
    chosen: usize,
) -> Option<usize> {
    parts(ui, rect, (label, role), options, |i| i == chosen)
}

fn parts(
    ui: &mut Ui,
    rect: Rect,
    (label, role): (&str, Role),
    options: &[Segment<'_>],
    holds: impl Fn(usize) -> bool,
) -> Option<usize> {
    let theme = Theme::of(ui);
    let ui = &mut ui.new_child(UiBuilder::new().id_salt(("segments", label)).max_rect(rect));
    mirror::mark(ui, mirror::Part::Group, label);
    ui.painter().rect_filled(rect, 7.0, theme.raised);
    let width = rect.width() / options.len().max(1) as f32;
    let mut clicked = None;
    for (i, option) in options.iter().enumerate() {
        let part = Rect::from_min_size(rect.min + vec2(width * i as f32, 0.0), vec2(width, rect.height()));
        let id = ui.make_persistent_id(("segment", label, i));
        let response = ui.interact(part, id, Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
        let held = holds(i);
        // All of it can be hit, to its edges.
        let part = part.shrink(2.0);
        response.widget_info(|| WidgetInfo::selected(role, ui.is_enabled(), held, option.name));
        if held {
            let fill = if theme.dark { theme.faint } else { theme.panel };
            ui.painter().rect(part, 5.0, fill, Stroke::new(1.0, theme.faint), StrokeKind::Inside);
        }
        let ink = if held || response.hovered() { theme.ink } else { theme.dim };
        // A long word is smaller rather than cut, and as large when it is chosen.
        let wide = text::width(ui, option.text, fonts::strong(SIZE));
        let size = (SIZE * (part.width() - 6.0) / wide).clamp(10.5, SIZE);
        let font = if held { fonts::strong(size) } else { fonts::regular(size) };
        text::paint(ui, part.center(), Align2::CENTER_CENTER, option.text, font, ink);
        if response.clicked() {
            clicked = Some(i);
        }
        if option.hint.is_empty() {
            symbol::names(response, option.text);
        } else {
            response.on_hover_text(option.hint);
        }
    }
    clicked
}
