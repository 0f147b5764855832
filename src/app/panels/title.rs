//! The two ends of the title bar: name and presets; sharing, theme and help.

use egui::{
    Align2, CursorIcon, Popup, Rect, Response, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2,
};

use crate::app::command::Command;
use crate::app::controls::row::TARGET;
use crate::app::fonts;
use crate::app::panels::gallery::Gallery;
use crate::app::panels::{menu, share};
use crate::app::stages::stage::Stage;
use crate::app::state::State;
use crate::app::theme::{Theme, ThemeChoice};
use crate::app::widgets::finger;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::widgets::text;
use centrode_core::scenario::preset::Preset;

/// A preset's name as the page writes it.
#[must_use]
pub fn name(preset: &Preset) -> String {
    let words = preset.name.replace('-', " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Shows what the page is called and which preset it goes back to.
pub fn title(ui: &mut Ui, rect: Rect, state: &State, gallery: &mut Gallery, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let mut left = rect.left_center() + vec2(if rect.width() < 560.0 { 8.0 } else { 10.0 }, 0.0);
    // On the narrowest phones the preset needs all there is.
    if rect.width() < 120.0 {
        left.x = rect.left();
    } else {
        mark(ui, left + vec2(9.0, 0.0), &theme);
        left.x += 26.0;
    }
    if rect.width() > 240.0 {
        left.x = text::paint(ui, left, Align2::LEFT_CENTER, "Centrode", fonts::strong(16.0), theme.ink).right() + 14.0;
    }
    let high = finger::at_least(ui, 30.0).min(rect.height());
    let room = (rect.right() - left.x).clamp(72.0, 240.0);
    let place = Rect::from_min_size(rect.left_center() + vec2(left.x - rect.left(), -0.5 * high), vec2(room, high));
    presets(ui, place, state, gallery, out);
}

/// Width that [`tools`] takes, points.
#[must_use]
pub fn tools_width(sheet: bool) -> f32 {
    if sheet { 5.0 * TARGET } else { 158.0 }
}

/// Shows sharing, theme and help; `sheet` asks for the button that opens the controls.
pub fn tools(ui: &mut Ui, rect: Rect, state: &State, sheet: bool, out: &mut Vec<Command>) {
    let (side, apart) = if sheet { (TARGET, TARGET) } else { (34.0, 38.0) };
    let mut right = rect.right_center() - vec2(0.5 * side + if sheet { 0.0 } else { 3.0 }, 0.0);
    let mut place = || {
        let place = Rect::from_center_size(right, vec2(side, side));
        right.x -= apart;
        place
    };
    if icon::button(ui, place(), Icon::Help, "Help", Look::Plain).clicked() {
        out.push(Command::ToggleHelp);
    }
    let (sign, label) = match state.theme {
        ThemeChoice::System => (Icon::System, "Theme: system"),
        ThemeChoice::Light => (Icon::Light, "Theme: light"),
        ThemeChoice::Dark => (Icon::Dark, "Theme: dark"),
        ThemeChoice::Projector => (Icon::Projector, "Theme: projector"),
    };
    if icon::button(ui, place(), sign, label, Look::Plain).clicked() {
        out.push(Command::NextTheme);
    }
    share::menu(ui, place(), out);
    if sheet {
        let look = if state.sheet { Look::Lit } else { Look::Plain };
        if icon::button(ui, place(), Icon::Controls, "Controls", look).clicked() {
            out.push(Command::ToggleSheet);
        }
    }
}

/// The highest that the box of a menu is painted, points.
const BOX: f32 = 36.0;

/// A button with a text that opens a menu.
fn combo(ui: &mut Ui, rect: Rect, label: &str, title: &str, theme: &Theme) -> Response {
    let response =
        ui.interact(rect, ui.make_persistent_id(label), Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
    response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, ui.is_enabled(), label));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_value(title));
    let warm = response.hovered() || Popup::is_id_open(ui.ctx(), Popup::default_response_id(&response));
    let ground = theme.panel.lerp_to_gamma(theme.ink, if warm { 0.05 } else { 0.0 });
    // A finger needs more than the eye.
    let shown = rect.shrink2(vec2(0.0, (0.5 * (rect.height() - BOX)).max(0.0)));
    ui.painter().rect(shown, 7.0, ground, Stroke::new(1.0, theme.faint), StrokeKind::Inside);
    // A long name is smaller rather than cut.
    let room = rect.width() - 32.0;
    let size = (13.0 * room / text::width(ui, title, fonts::strong(13.0))).clamp(10.5, 13.0);
    let clip = ui.painter_at(rect.with_max_x(rect.right() - 22.0));
    let at = rect.left_center() + vec2(10.0, 0.0);
    clip.text(at, Align2::LEFT_CENTER, title, fonts::strong(size), theme.ink);
    icon::chevron(ui.painter(), rect.right_center() - vec2(14.0, 0.0), 1.0, theme.dim);
    response
}

/// The mark: an arc and the point it turns about.
fn mark(ui: &Ui, center: egui::Pos2, theme: &Theme) {
    let hub = center + vec2(5.0, 5.0);
    let points = (0..=20)
        .map(|i| hub + 12.0 * egui::Vec2::angled(std::f32::consts::PI * (0.94 + 0.62 * i as f32 / 20.0)))
        .collect();
    ui.painter().line(points, Stroke::new(2.6, theme.ink));
    ui.painter().circle_filled(hub, 2.8, theme.accent);
}

fn presets(ui: &mut Ui, rect: Rect, state: &State, gallery: &mut Gallery, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let several = state.stage == Stage::Chain;
    let chosen = if several { state.chain.preset() } else { state.preset() };
    let title = name(chosen);
    let response = combo(ui, rect, "Preset", &title, &theme);

    let screen = ui.ctx().content_rect();
    let width = (screen.width() - 56.0).min(900.0);
    gallery.open = false;
    menu::show(ui, &response, "Presets", width, |ui| {
        let height = screen.bottom() - rect.bottom() - 40.0;
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.set_width(width);
            if gallery.show(ui, chosen, out) {
                ui.close();
            }
        });
    });
    if !Popup::is_any_open(ui.ctx()) {
        response.on_hover_text(chosen.summary());
    }
}

/// A choice with what it shows or does; returns whether it was clicked.
pub(in crate::app) fn item(ui: &mut Ui, role: Role, texts: (&str, &str), chosen: bool, theme: &Theme) -> bool {
    choice(ui, role, texts, chosen, theme).clicked()
}

/// The same; returns what happened to it.
pub(super) fn choice(ui: &mut Ui, role: Role, (title, summary): (&str, &str), chosen: bool, theme: &Theme) -> Response {
    let mut job = egui::text::LayoutJob::default();
    job.wrap.max_width = ui.available_width() - 20.0;
    let format = |font, color| egui::TextFormat { font_id: font, color, ..Default::default() };
    job.append(title, 0.0, format(fonts::strong(13.0), if chosen { theme.accent } else { theme.ink }));
    job.append(&format!("\n{}", summary), 0.0, format(fonts::regular(12.0), theme.dim));
    let galley = ui.painter().layout_job(job);
    let size = vec2(ui.available_width(), finger::at_least(ui, galley.size().y + 12.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::selected(role, ui.is_enabled(), chosen, title));
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, theme.raised);
    }
    ui.painter().galley(rect.min + vec2(10.0, 6.0), galley, theme.ink);
    response
}
