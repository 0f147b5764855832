//! Signs, painted, and the buttons that bear them.

use std::f32::consts::{PI, TAU};

use egui::{
    Align2, Color32, CursorIcon, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, lerp,
    pos2, vec2,
};

use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::finger;

/// A sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Icon {
    /// A triangle.
    Play,
    /// Two bars.
    Pause,
    /// A bar and a triangle to the left.
    StepBack,
    /// A bar and a triangle to the right.
    StepForward,
    /// A bar and two triangles to the left.
    ToStart,
    /// A loop with its arrow.
    Loop,
    /// A circle arrow that goes back.
    Reset,
    /// Half a disk: as the system says.
    System,
    /// A sun.
    Light,
    /// A moon.
    Dark,
    /// A screen on its stand.
    Projector,
    /// A question mark.
    Help,
    /// Two sliders.
    Controls,
    /// A cross.
    Close,
    /// An arrow out of a tray.
    Share,
    /// An arrow into a tray.
    Save,
    /// An arrow out of a window.
    Open,
    /// Two curves from one foot.
    Compare,
    /// An open book.
    Learn,
}

/// How a button looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// Only the sign.
    Plain,
    /// A sign that is lit: something is switched on.
    Lit,
    /// On the accent.
    Accent,
}

/// Shows a button in a rectangle.
pub fn button(ui: &mut Ui, rect: Rect, icon: Icon, label: &str, look: Look) -> Response {
    let theme = Theme::of(ui);
    let id = ui.make_persistent_id(("icon", rect_key(icon)));
    let response = ui.interact(finger::around(ui, rect), id, Sense::click());
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| match look {
        Look::Lit => WidgetInfo::selected(Role::Button, ui.is_enabled(), true, label),
        _ => WidgetInfo::labeled(Role::Button, ui.is_enabled(), label),
    });
    let warm = ui.ctx().animate_bool(id, response.hovered() || response.is_pointer_button_down_on());
    let radius = rect.height().min(rect.width()) / 2.0;
    let (fill, ink) = match look {
        Look::Accent => (theme.accent.lerp_to_gamma(theme.ink, 0.12 * warm), theme.on_accent),
        Look::Lit => (theme.accent.gamma_multiply(0.14 + 0.08 * warm), theme.accent),
        Look::Plain => (theme.raised.gamma_multiply(warm), theme.dim.lerp_to_gamma(theme.ink, 0.4 + 0.6 * warm)),
    };
    let corner = if look == Look::Accent { radius } else { 7.0 };
    ui.painter().rect_filled(rect, corner, fill);
    paint(ui.painter(), rect.center(), 1.0, icon, ink);
    response.on_hover_text(label)
}

/// Play and pause, and the three themes, are one button each.
fn rect_key(icon: Icon) -> &'static str {
    match icon {
        Icon::Play | Icon::Pause => "play",
        Icon::System | Icon::Light | Icon::Dark | Icon::Projector => "theme",
        Icon::StepBack => "back",
        Icon::StepForward => "forward",
        Icon::ToStart => "start",
        Icon::Loop => "loop",
        Icon::Reset => "reset",
        Icon::Help => "help",
        Icon::Controls => "controls",
        Icon::Close => "close",
        Icon::Share => "share",
        Icon::Save => "save",
        Icon::Open => "open",
        Icon::Compare => "compare",
        Icon::Learn => "learn",
    }
}

/// Paints a sign of about 14 points times `scale` around a centre.
pub fn paint(painter: &Painter, center: Pos2, scale: f32, icon: Icon, ink: Color32) {
    let p = |x: f32, y: f32| center + vec2(x, y) * scale;
    let stroke = Stroke::new(1.6 * scale, ink);
    let triangle = |at: f32, width: f32, half: f32| {
        let points = vec![p(at, -half), p(at + width, 0.0), p(at, half)];
        painter.add(Shape::convex_polygon(points, ink, Stroke::new(1.0, ink)));
    };
    let bar = |x: f32, half: f32, width: f32| {
        painter.rect_filled(Rect::from_min_max(p(x - width / 2.0, -half), p(x + width / 2.0, half)), 0.8, ink);
    };
    match icon {
        Icon::Play => triangle(-3.6, 9.5, 5.6),
        Icon::Pause => [-3.2, 3.2].into_iter().for_each(|x| bar(x, 5.6, 3.2)),
        Icon::StepBack => {
            triangle(2.2, -6.5, 4.4);
            bar(5.0, 4.8, 1.8);
        }
        Icon::StepForward => {
            triangle(-2.2, 6.5, 4.4);
            bar(-5.0, 4.8, 1.8);
        }
        Icon::ToStart => {
            bar(-5.6, 4.8, 1.8);
            triangle(0.6, -5.0, 4.4);
            triangle(6.2, -5.0, 4.4);
        }
        Icon::Loop => {
            for side in [1.0, -1.0] {
                let way = [(-6.0, 0.4), (-6.0, -1.4), (-5.1, -3.3), (-3.4, -4.0), (3.2, -4.0)];
                painter.line(way.map(|(x, y)| p(side * x, side * y)).to_vec(), stroke);
                let head = [(2.8, -7.0), (6.2, -4.0), (2.8, -1.0)].map(|(x, y)| p(side * x, side * y));
                painter.add(Shape::convex_polygon(head.to_vec(), ink, Stroke::NONE));
            }
        }
        Icon::Reset => turn(painter, center, 4.4 * scale, 1.25 * PI, -1.5 * PI, Stroke::new(1.4 * scale, ink)),
        Icon::System => {
            painter.circle_stroke(center, 5.8 * scale, stroke);
            let half = (0..=16).map(|i| center + 5.0 * scale * Vec2::angled(PI / 2.0 + PI * i as f32 / 16.0)).collect();
            painter.add(Shape::convex_polygon(half, ink, Stroke::NONE));
        }
        Icon::Light => {
            painter.circle_filled(center, 3.2 * scale, ink);
            for i in 0..8 {
                let ray = Vec2::angled(TAU * i as f32 / 8.0) * scale;
                painter.line_segment([center + ray * 5.2, center + ray * 7.0], stroke);
            }
        }
        Icon::Dark => {
            // The edge of a disk, and back along the edge of a smaller one that covers its upper right.
            let arc = |hub: Pos2, radius: f32, from: f32, to: f32| {
                (0..=16).map(move |i| hub + radius * Vec2::angled(lerp(from..=to, i as f32 / 16.0).to_radians()))
            };
            let (outer, inner) = (5.8 * scale, 5.0 * scale);
            let cover = p(2.9, -2.9);
            let points = arc(center, outer, 13.0, 257.0).chain(arc(cover, inner, 213.0, 57.0)).collect();
            painter.add(Shape::closed_line(points, stroke));
        }
        Icon::Projector => {
            painter.add(Shape::closed_line(vec![p(-6.0, -5.0), p(6.0, -5.0), p(6.0, 3.0), p(-6.0, 3.0)], stroke));
            painter.line(vec![p(-3.5, 6.5), p(0.0, 3.0), p(3.5, 6.5)], stroke);
        }
        Icon::Help => {
            painter.text(center, Align2::CENTER_CENTER, "?", fonts::strong(15.0 * scale), ink);
        }
        Icon::Controls => {
            for (y, x) in [(-3.2, 2.2), (3.2, -2.2)] {
                painter.line_segment([p(-6.5, y), p(6.5, y)], stroke);
                painter.circle_filled(p(x, y), 2.8 * scale, ink);
            }
        }
        Icon::Share => {
            painter.line_segment([p(0.0, 2.0), p(0.0, -6.0)], stroke);
            painter.line([(-3.2, -3.2), (0.0, -6.4), (3.2, -3.2)].map(|(x, y)| p(x, y)).to_vec(), stroke);
            let tray = [(-3.4, -0.8), (-5.6, -0.8), (-5.6, 6.0), (5.6, 6.0), (5.6, -0.8), (3.4, -0.8)];
            painter.line(tray.map(|(x, y)| p(x, y)).to_vec(), stroke);
        }
        Icon::Save => {
            painter.line_segment([p(0.0, -6.0), p(0.0, 2.0)], stroke);
            painter.line([(-3.2, -0.8), (0.0, 2.4), (3.2, -0.8)].map(|(x, y)| p(x, y)).to_vec(), stroke);
            let tray = [(-5.6, 2.4), (-5.6, 6.0), (5.6, 6.0), (5.6, 2.4)];
            painter.line(tray.map(|(x, y)| p(x, y)).to_vec(), stroke);
        }
        Icon::Open => {
            let frame = [(0.4, -4.6), (-5.2, -4.6), (-5.2, 5.4), (4.8, 5.4), (4.8, 0.2)];
            painter.line(frame.map(|(x, y)| p(x, y)).to_vec(), stroke);
            painter.line_segment([p(-0.8, 1.0), p(5.6, -5.4)], stroke);
            painter.line([(2.0, -5.6), (5.8, -5.6), (5.8, -1.8)].map(|(x, y)| p(x, y)).to_vec(), stroke);
        }
        Icon::Compare => {
            let curve = |reach: f32| {
                let along = (0_u8..=8).map(|i| f32::from(i) / 8.0);
                along.map(|s| p(-4.5 + reach * s * s, 6.0 - 12.0 * s)).collect::<Vec<_>>()
            };
            painter.line(curve(2.5), stroke);
            let other = curve(10.0);
            painter.extend(Shape::dashed_line(&other, stroke, 2.4 * scale, 2.0 * scale));
        }
        Icon::Learn => {
            for side in [1.0, -1.0] {
                let page = [(0.0, -3.4), (2.6, -4.8), (6.6, -4.8), (6.6, 4.0), (2.6, 4.0), (0.0, 5.4)];
                painter.line(page.map(|(x, y)| p(side * x, y)).to_vec(), stroke);
            }
            painter.line_segment([p(0.0, -3.4), p(0.0, 5.4)], stroke);
        }
        Icon::Close => {
            painter.line_segment([p(-4.2, -4.2), p(4.2, 4.2)], stroke);
            painter.line_segment([p(-4.2, 4.2), p(4.2, -4.2)], stroke);
        }
    }
}

/// An arc with an arrowhead at its end.
fn turn(painter: &Painter, center: Pos2, radius: f32, from: f32, sweep: f32, stroke: Stroke) {
    let points: Vec<Pos2> = (0..=24).map(|i| center + radius * Vec2::angled(from + sweep * i as f32 / 24.0)).collect();
    let end = from + sweep;
    let ahead = Vec2::angled(end + sweep.signum() * PI / 2.0);
    let tip = center + radius * Vec2::angled(end);
    let side = ahead.rot90() * 0.62 * radius;
    painter.line(points, stroke);
    let head = vec![tip - side, tip + ahead * 0.8 * radius, tip + side];
    painter.add(Shape::convex_polygon(head, stroke.color, Stroke::NONE));
}

/// A disclosure triangle, turned down by `open` (0 to 1).
pub fn chevron(painter: &Painter, center: Pos2, open: f32, ink: Color32) {
    let turned = |x: f32, y: f32| {
        let (sin, cos) = (open * PI / 2.0).sin_cos();
        pos2(center.x + x * cos - y * sin, center.y + x * sin + y * cos)
    };
    painter.line(vec![turned(-1.8, -3.6), turned(1.8, 0.0), turned(-1.8, 3.6)], Stroke::new(1.5, ink));
}
