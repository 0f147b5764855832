//! A switch: on or off.

use egui::{Rect, Role, Sense, Ui, WidgetInfo, lerp, pos2};

use crate::app::theme::Theme;

/// Shows a switch; returns whether it was clicked.
pub fn toggle(ui: &mut Ui, rect: Rect, label: &str, on: bool) -> bool {
    let theme = Theme::of(ui);
    let response = ui.interact(rect, ui.make_persistent_id(("toggle", label)), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, ui.is_enabled(), on, label));
    let along = ui.ctx().animate_bool(response.id, on);
    let track = Rect::from_center_size(rect.center(), egui::vec2(26.0, 14.0));
    let fill = theme.edge.lerp_to_gamma(theme.accent, along);
    ui.painter().rect_filled(track, 7.0, fill);
    let x = lerp(track.left() + 7.0..=track.right() - 7.0, along);
    let knob = if theme.dark { theme.ink } else { theme.panel };
    ui.painter().circle_filled(pos2(x, track.center().y), 5.0, knob);
    response.on_hover_text(if on { "Switch off" } else { "Switch on" }).clicked()
}
