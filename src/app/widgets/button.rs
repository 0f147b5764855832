//! A button with a word on it.

use egui::{Align2, CursorIcon, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};

use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::text::paint;

/// Shows a button; returns whether it was clicked.
pub fn button(ui: &mut Ui, rect: Rect, label: &str, theme: &Theme) -> bool {
    named(ui, rect, (label, label), theme)
}

/// The same with another name to assistive technology than the word on it, where several have the same word.
pub fn named(ui: &mut Ui, rect: Rect, (label, name): (&str, &str), theme: &Theme) -> bool {
    let id = ui.make_persistent_id(("button", name));
    let response = ui.interact(finger::around(ui, rect), id, Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), name));
    let warm = if response.hovered() { 0.08 } else { 0.0 };
    let fill = theme.raised.lerp_to_gamma(theme.ink, warm);
    ui.painter().rect(rect, 7.0, fill, Stroke::new(1.0, theme.faint), StrokeKind::Inside);
    paint(ui, rect.center(), Align2::CENTER_CENTER, label, fonts::strong(12.5), theme.accent);
    response.clicked()
}
