//! The plate as it is drawn and dragged.

use super::{HALF, Move, NEAR, Plate, RING};
use crate::app::charts::notation::number;
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::lesson::Wish;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::text;
use egui::accesskit::{Action, ActionData};
use egui::{
    Align2, Color32, CursorIcon, EventFilter, Key, Pos2, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind, Ui,
    WidgetInfo, pos2, vec2,
};
use glam::{DVec2, dvec2};

/// Half of what is to be seen around the plate's middle, and where that middle is.
const SEEN: DVec2 = dvec2(1.42, 1.35);
const MIDDLE: DVec2 = dvec2(0.0, -0.3);
/// How far the handle of an arrow is from its point.
const HANDLE: f64 = 0.62;
/// Size of what is dragged, points.
const GRIP: f32 = 44.0;
/// Names of both points.
pub const NAMES: [&str; 2] = ["A", "B"];

/// From the plate to the screen.
#[derive(Clone, Copy)]
struct Frame {
    center: Pos2,
    scale: f64,
}

impl Frame {
    fn new(rect: Rect) -> Self {
        let scale = (f64::from(rect.width()) / (2.0 * SEEN.x)).min(f64::from(rect.height()) / (2.0 * SEEN.y));
        Self { center: rect.center(), scale }
    }

    fn at(self, point: DVec2) -> Pos2 {
        let off = (point - MIDDLE) * self.scale;
        self.center + vec2(off.x as f32, -off.y as f32)
    }

    fn of(self, at: Pos2) -> DVec2 {
        let off = at - self.center;
        MIDDLE + dvec2(f64::from(off.x), -f64::from(off.y)) / self.scale
    }
}

/// Shows the plate in `rect`.
pub fn plate(ui: &mut Ui, rect: Rect, plate: &Plate, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let frame = Frame::new(rect.shrink(10.0));
    body(ui, frame, plate, &theme);
    ring(ui, frame, plate, &theme);
    perpendiculars(ui, rect, frame, plate, &theme);
    for which in [0, 1] {
        arrow(ui, frame, plate, which, &theme, out);
    }
    for which in [0, 1] {
        point(ui, frame, plate, which, &theme, out);
    }
    caption(ui, rect, plate, &theme);
}

fn outline(frame: Frame, about: DVec2, angle: f64) -> Vec<Pos2> {
    let turn = DVec2::from_angle(angle);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let round = 0.14;
    let arc = |(x, y): (f64, f64)| {
        let hub = dvec2(x * (HALF.x - round), y * (HALF.y - round));
        let first = f64::atan2(y, x) - std::f64::consts::FRAC_PI_4;
        // From the side before the corner to the side behind it.
        (0..=6).map(move |k| {
            let from = (first / std::f64::consts::FRAC_PI_2).round() * std::f64::consts::FRAC_PI_2;
            hub + round * DVec2::from_angle(from + f64::from(k) / 6.0 * std::f64::consts::FRAC_PI_2)
        })
    };
    corners.into_iter().flat_map(arc).map(|point| frame.at(about + turn.rotate(point - about))).collect()
}

/// What the plate is filled with.
fn ground(theme: &Theme) -> Color32 {
    theme.raised.lerp_to_gamma(theme.robot, if theme.dark { 0.18 } else { 0.06 })
}

/// The plate, where it is about to be, and how its points move.
fn body(ui: &Ui, frame: Frame, plate: &Plate, theme: &Theme) {
    let painter = ui.painter();
    let motion = plate.motion();
    let fill = ground(theme);
    painter.add(Shape::convex_polygon(outline(frame, DVec2::ZERO, 0.0), fill, Stroke::new(1.5, theme.robot)));
    if let Some(center) = motion.center {
        let ahead = Shape::closed_line(
            outline(frame, center, 0.12 * motion.turn.signum() / center.length().max(1.0)),
            Stroke::new(1.0, theme.robot.gamma_multiply(0.5)),
        );
        painter.add(ahead);
    }
    for x in [-0.8, -0.4, 0.0, 0.4, 0.8] {
        for y in [-0.36, 0.0, 0.36] {
            let at = dvec2(x, y);
            let velocity = motion.at(at);
            let ink = theme.dim.gamma_multiply(0.55);
            painter.circle_filled(frame.at(at), 1.5, ink);
            painter.line_segment([frame.at(at), frame.at(at + 0.2 * velocity)], Stroke::new(1.2, ink));
        }
    }
}

fn ring(ui: &Ui, frame: Frame, plate: &Plate, theme: &Theme) {
    let (at, radius) = (frame.at(RING), (NEAR * frame.scale) as f32);
    let color = if plate.is_met() { theme.sensor } else { theme.dim };
    ui.painter().circle_stroke(at, radius.max(9.0), Stroke::new(2.5, color));
}

/// The line on which the centre must lie, for each point, and the centre.
fn perpendiculars(ui: &Ui, rect: Rect, frame: Frame, plate: &Plate, theme: &Theme) {
    let painter = ui.painter_at(rect);
    let far = 40.0;
    for (which, color) in [(0, theme.model), (1, theme.constrained)] {
        let (from, normal) = (plate.point(which), DVec2::from_angle(plate.angle(which)).perp());
        let line = [frame.at(from - far * normal), frame.at(from + far * normal)];
        if let Some(line) = clipped(line, rect) {
            painter.extend(Shape::dashed_line(&line, Stroke::new(1.8, color), 7.0, 5.0));
        }
        let corner = [0.09 * normal, 0.09 * (normal + normal.perp()), 0.09 * normal.perp()];
        painter.line(corner.map(|off| frame.at(from + off)).to_vec(), Stroke::new(1.2, color));
    }
    let Some(center) = plate.center().map(|center| frame.at(center)).filter(|at| rect.contains(*at)) else { return };
    let color = if plate.is_met() { theme.sensor } else { theme.detection };
    painter.circle(center, 6.5, color, Stroke::new(2.0, theme.panel));
    painter.text(center + vec2(11.0, -4.0), Align2::LEFT_BOTTOM, "centre", fonts::strong(13.0), color);
}

/// The part of a line inside a rectangle.
fn clipped([a, b]: [Pos2; 2], rect: Rect) -> Option<[Pos2; 2]> {
    let along = b - a;
    let (mut from, mut to) = (0.0_f32, 1.0_f32);
    for (start, step, low, high) in
        [(a.x, along.x, rect.left(), rect.right()), (a.y, along.y, rect.top(), rect.bottom())]
    {
        if step.abs() < 1e-6 {
            if start < low || start > high {
                return None;
            }
            continue;
        }
        let [one, other] = [(low - start) / step, (high - start) / step];
        (from, to) = (from.max(one.min(other)), to.min(one.max(other)));
    }
    (from < to).then(|| [a + from * along, a + to * along])
}

fn colors(which: usize, theme: &Theme) -> Color32 {
    [theme.model, theme.constrained][which]
}

/// Marks what has the focus.
fn focus(ui: &Ui, response: &Response, at: Pos2, theme: &Theme) {
    if response.hovered() || response.dragged() {
        ui.painter().circle_filled(at, 14.0, theme.accent.gamma_multiply(0.16));
    }
}

/// How often arrow keys were pressed, to the right and up, with Shift five times as much.
fn keys(ui: &Ui, response: &Response) -> egui::Vec2 {
    if !response.has_focus() {
        return egui::Vec2::ZERO;
    }
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    ui.input(|input| {
        let presses = |key| input.num_presses(key) as f32;
        let big = if input.modifiers.shift { 5.0 } else { 1.0 };
        big * vec2(presses(Key::ArrowRight) - presses(Key::ArrowLeft), presses(Key::ArrowUp) - presses(Key::ArrowDown))
    })
}

fn arrow(ui: &mut Ui, frame: Frame, plate: &Plate, which: usize, theme: &Theme, out: &mut Vec<Command>) {
    let (from, angle) = (plate.point(which), plate.angle(which));
    let along = DVec2::from_angle(angle);
    let grip = frame.at(from + HANDLE * along);
    let id = ui.make_persistent_id(("arrow", which));
    let target = Rect::from_center_size(grip, egui::Vec2::splat(GRIP));
    finger::claim(ui, target);
    let response = ui.interact(target, id, Sense::click_and_drag());
    let response = response.on_hover_and_drag_cursor(CursorIcon::Grab);
    let degrees = angle.to_degrees();
    let label = format!("Direction of arrow {}", NAMES[which]);
    response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), degrees.round(), &label));
    ui.ctx().accesskit_node_builder(id, |node| {
        node.set_min_numeric_value(-180.0);
        node.set_max_numeric_value(180.0);
        node.set_numeric_value_step(2.0);
        node.set_value(format!("{} degrees", number(degrees, 0)));
        [Action::SetValue, Action::Increment, Action::Decrement].into_iter().for_each(|action| node.add_action(action));
    });
    let pointer = response.interact_pointer_pos().filter(|_| response.dragged());
    let mut asked = pointer.map(|at| (frame.of(at) - from).to_angle());
    let pressed = keys(ui, &response);
    let mut steps = pressed.x + pressed.y;
    ui.input(|input| {
        steps += input.num_accesskit_action_requests(id, Action::Increment) as f32;
        steps -= input.num_accesskit_action_requests(id, Action::Decrement) as f32;
        for request in input.accesskit_action_requests(id, Action::SetValue) {
            if let Some(ActionData::NumericValue(value)) = &request.data {
                asked = Some(value.to_radians());
            }
        }
    });
    if steps != 0.0 {
        asked = Some((degrees + 2.0 * f64::from(steps)).to_radians());
    }
    if let Some(angle) = asked {
        out.push(Command::Lesson(Wish::Plate(Move::Turn(which, angle))));
    }
    let color = colors(which, theme);
    let velocity = plate.motion().at(from);
    let tip = from + 0.85 * HANDLE * velocity;
    let painter = ui.painter();
    painter.line_segment([frame.at(from), grip], Stroke::new(1.0, color.gamma_multiply(0.5)));
    head(ui, frame.at(from), frame.at(tip), color);
    focus(ui, &response, grip, theme);
    ui.painter().circle(grip, 7.0, if theme.dark { theme.ink } else { theme.panel }, Stroke::new(2.5, color));
}

/// An arrow.
fn head(ui: &Ui, from: Pos2, to: Pos2, color: Color32) {
    let along = to - from;
    if along.length() < 4.0 {
        return;
    }
    let (ahead, size) = (along.normalized(), 11.0_f32.min(along.length()));
    let neck = to - size * ahead;
    ui.painter().line_segment([from, neck], Stroke::new(4.0, color));
    let side = 0.55 * size * ahead.rot90();
    ui.painter().add(Shape::convex_polygon(vec![neck + side, to, neck - side], color, Stroke::NONE));
}

fn point(ui: &mut Ui, frame: Frame, plate: &Plate, which: usize, theme: &Theme, out: &mut Vec<Command>) {
    let (place, at) = (plate.point(which), frame.at(plate.point(which)));
    let id = ui.make_persistent_id(("point", which));
    let target = Rect::from_center_size(at, egui::Vec2::splat(GRIP));
    finger::claim(ui, target);
    let response = ui.interact(target, id, Sense::click_and_drag());
    let response = response.on_hover_and_drag_cursor(CursorIcon::Grab);
    let name = format!("Point {}", NAMES[which]);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), &name));
    ui.ctx().accesskit_node_builder(id, |node| node.set_description("Arrow keys move it"));
    let pressed = keys(ui, &response);
    let stepped =
        (pressed != egui::Vec2::ZERO).then(|| place + 0.04 * dvec2(f64::from(pressed.x), f64::from(pressed.y)));
    let pointer = response.interact_pointer_pos().filter(|_| response.dragged());
    if let Some(to) = pointer.map(|at| frame.of(at)).or(stepped) {
        out.push(Command::Lesson(Wish::Plate(Move::Carry(which, to))));
    }
    let color = colors(which, theme);
    focus(ui, &response, at, theme);
    ui.painter().circle(at, 6.0, color, Stroke::new(2.0, theme.panel));
    // Behind the arrow, where neither it nor the perpendicular is.
    let back = -20.0 * DVec2::from_angle(plate.angle(which));
    let name = at + vec2(back.x as f32, -back.y as f32);
    text::paint(ui, name, Align2::CENTER_CENTER, NAMES[which], fonts::strong(15.0), color);
}

/// What the plate does, in words.
fn caption(ui: &Ui, rect: Rect, plate: &Plate, theme: &Theme) {
    let said = match plate.center() {
        Some(_) if plate.is_met() => "The plate turns about the ring.".to_owned(),
        Some(center)
            if !Rect::from_min_max(pos2(-1.7, -1.6), pos2(1.7, 1.0))
                .contains(pos2(center.x as f32, center.y as f32)) =>
        {
            format!("The centre lies outside of the picture, {} plate lengths away.", number(center.length() / 2.0, 1))
        }
        Some(_) => "The plate turns about the point where the perpendiculars meet.".to_owned(),
        None => "Parallel arrows: the plate shifts, and turns about no point.".to_owned(),
    };
    let ink = if plate.is_met() { theme.sensor } else { theme.dim };
    let galley = ui.painter().layout(said.clone(), fonts::regular(13.0), ink, rect.width() - 28.0);
    let at = pos2(rect.left() + 14.0, rect.top() + 12.0);
    let place = Rect::from_min_size(at, galley.size());
    ui.painter().rect(place.expand(4.0), 5.0, theme.panel, Stroke::NONE, StrokeKind::Inside);
    ui.painter().galley(at, galley, ink);
    let response = ui.interact(place, ui.scope_id().with("plate caption"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &said));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Color;
    use crate::scene::palette::Shade;

    /// WCAG 2.2, 1.4.11: lines and marks, 3 to 1.
    #[test]
    fn arrows_and_perpendiculars_stand_out_from_the_plate() {
        let scene = |c: Color32| Color::hex(u32::from(c.r()) << 16 | u32::from(c.g()) << 8 | u32::from(c.b()));
        for theme in [Shade::Dark, Shade::Light, Shade::Projector].map(Theme::new) {
            for line in [theme.model, theme.constrained, theme.dim, theme.sensor] {
                let found = scene(line).contrast(scene(ground(&theme)));
                assert!(found >= 3.0, "{line:?} in {:?}: {found}", theme.shade);
            }
        }
    }
}
