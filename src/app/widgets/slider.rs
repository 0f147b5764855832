//! A slider: a thin rail, the part up to the value in the accent, a round handle, a notch where the preset is.

use egui::accesskit::{Action, ActionData};
use egui::style::ScrollAnimation;
use egui::{CursorIcon, EventFilter, Key, Rect, Response, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::app::controls::control::Scale;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::rail::Rail;

/// Radius of a handle, points.
pub const HANDLE: f32 = 7.0;

/// What a slider shows.
pub struct Slider<'a> {
    /// Identity.
    pub key: &'a str,
    /// Name for assistive technology.
    pub label: &'a str,
    /// Value with its unit, for assistive technology.
    pub spoken: &'a str,
    /// How values lie along it.
    pub rail: Rail,
    /// The value.
    pub value: f64,
    /// Where the preset is.
    pub notch: Option<f64>,
    /// Whether the setting is switched on; a touch switches it on.
    pub on: bool,
}

/// The ends of the handle's way in a rectangle.
#[must_use]
pub fn way(rect: Rect) -> (f32, f32) {
    (rect.left() + HANDLE, rect.right() - HANDLE)
}

/// Where a place on the rail is on the screen.
#[must_use]
pub fn at(rect: Rect, place: f64) -> f32 {
    let (left, right) = way(rect);
    left + (right - left) * place as f32
}

/// Senses pointer, keys and assistive technology; returns the value asked for. Paints nothing.
pub fn sense(ui: &mut Ui, rect: Rect, slider: &Slider<'_>) -> (Response, Option<f64>) {
    let id = ui.make_persistent_id(("slider", slider.key));
    let response =
        ui.interact(rect, id, Sense::click_and_drag()).on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
    finger::claim(ui, rect);
    let mut asked = None;
    if let (true, Some(pointer)) = (held(ui, &response), response.interact_pointer_pos()) {
        let (left, right) = way(rect);
        asked = Some(slider.rail.value(f64::from((pointer.x - left) / (right - left).max(1.0))));
    }
    let (mut steps, mut pages) = (0.0, 0.0);
    if response.has_focus() {
        let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
        ui.input(|input| {
            let presses = |key| input.num_presses(key) as f64;
            let big = if input.modifiers.shift { 10.0 } else { 1.0 };
            steps += big
                * (presses(Key::ArrowRight) + presses(Key::ArrowUp)
                    - presses(Key::ArrowLeft)
                    - presses(Key::ArrowDown));
            pages += presses(Key::PageUp) - presses(Key::PageDown);
        });
        if ui.input(|input| input.key_pressed(Key::Home)) {
            asked = Some(slider.rail.range.0);
        }
        if ui.input(|input| input.key_pressed(Key::End)) {
            asked = Some(slider.rail.range.1);
        }
    }
    ui.input(|input| {
        steps += input.num_accesskit_action_requests(id, Action::Increment) as f64;
        steps -= input.num_accesskit_action_requests(id, Action::Decrement) as f64;
        for request in input.accesskit_action_requests(id, Action::SetValue) {
            match &request.data {
                Some(ActionData::NumericValue(value)) => asked = Some(*value),
                Some(ActionData::Value(text)) => asked = text.trim().parse().ok().or(asked),
                _ => {}
            }
        }
    });
    if steps != 0.0 {
        asked = Some(slider.rail.step(slider.value, steps));
    }
    if pages != 0.0 {
        asked = Some(slider.rail.page(slider.value, pages));
    }
    describe(ui, &response, slider);
    let asked = asked.filter(|asked| asked.is_finite() && (asked.to_bits() != slider.value.to_bits() || !slider.on));
    (response, asked)
}

/// Whether the pointer asks for a value. A finger may only want to scroll what the slider is in, so it has to move along
/// the rail, or tap.
fn held(ui: &Ui, response: &Response) -> bool {
    let id = response.id.with("finger");
    if !response.is_pointer_button_down_on() {
        ui.data_mut(|data| data.remove_temp::<bool>(id));
        return response.clicked();
    }
    match ui.data(|data| data.get_temp::<bool>(id)) {
        Some(true) => true,
        Some(false) => {
            let moved = vec2(0.0, response.drag_delta().y);
            ui.scroll_with_delta_animation(moved, ScrollAnimation::none());
            finger::pass(ui);
            false
        }
        None if !ui.input(|input| input.any_touches()) => true,
        None => {
            let moved = ui.input(|input| input.pointer.total_drag_delta()).unwrap_or_default();
            let along = moved.x.abs() >= moved.y.abs();
            if moved.length() < 6.0 {
                return false;
            }
            ui.data_mut(|data| data.insert_temp(id, along));
            along
        }
    }
}

fn describe(ui: &Ui, response: &Response, slider: &Slider<'_>) {
    response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), slider.value, slider.label));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_min_numeric_value(slider.rail.range.0);
        node.set_max_numeric_value(slider.rail.range.1);
        match slider.rail.scale {
            Scale::Linear(step) => node.set_numeric_value_step(step),
            Scale::Whole | Scale::Stops | Scale::LogWhole => node.set_numeric_value_step(1.0),
            Scale::Log(_) => {}
        }
        node.set_value(slider.spoken);
        for action in [Action::SetValue, Action::Increment, Action::Decrement] {
            node.add_action(action);
        }
    });
}

/// Paints a handle; returns its centre.
pub fn paint_handle(ui: &Ui, response: &Response, x: f32, on: bool) {
    let theme = Theme::of(ui);
    let center = pos2(x, response.rect.center().y);
    let held = response.is_pointer_button_down_on();
    let grown = ui.ctx().animate_bool(response.id.with("grown"), held || response.hovered());
    if held {
        ui.painter().circle_filled(center, HANDLE + 6.0, theme.accent.gamma_multiply(0.18));
    }
    let edge = if on { theme.accent } else { theme.dim };
    ui.painter().circle(
        center,
        HANDLE - 1.0 + grown,
        if theme.dark { theme.ink } else { theme.panel },
        Stroke::new(2.0, edge),
    );
}

/// Shows a slider in a rectangle; returns the value asked for.
pub fn slider(ui: &mut Ui, rect: Rect, slider: &Slider<'_>) -> (Response, Option<f64>) {
    let (response, asked) = sense(ui, rect, slider);
    if !ui.is_rect_visible(rect) {
        return (response, asked);
    }
    let theme = Theme::of(ui);
    let shown = asked.unwrap_or(slider.value);
    let (y, x) = (rect.center().y, at(rect, slider.rail.place(shown)));
    let painter = ui.painter();
    let bar = |from: f32, to: f32, color| {
        painter.rect_filled(Rect::from_x_y_ranges(from..=to, y - 1.5..=y + 1.5), 1.5, color)
    };
    let stops = slider.rail.scale == Scale::Stops && slider.rail.range.1 <= 12.0;
    let (left, right) = if stops { way(rect) } else { (rect.left(), rect.right()) };
    bar(left, right, theme.faint);
    let two_sided = slider.rail.range.0 < 0.0;
    let origin = if two_sided { at(rect, slider.rail.place(0.0)) } else { left };
    let filled = if slider.on { theme.accent } else { theme.dim.gamma_multiply(0.5) };
    bar(origin.min(x), origin.max(x), filled);
    if stops {
        for stop in 0..=slider.rail.range.1 as u32 {
            let stop = f64::from(stop);
            let color = if stop <= shown { filled } else { theme.faint };
            painter.circle_filled(pos2(at(rect, slider.rail.place(stop)), y), 3.0, color);
        }
    }
    if let Some(notch) = slider.notch {
        let x = at(rect, slider.rail.place(notch));
        painter.vline(x, y + 5.0..=y + 9.0, Stroke::new(1.5, theme.dim));
    }
    paint_handle(ui, &response, x, slider.on);
    (response, asked)
}
