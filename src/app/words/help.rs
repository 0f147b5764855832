//! The help: what one sees, and which keys there are.

use egui::{Id, Modal, RichText, ScrollArea, Ui, vec2};

use crate::app::command::Command;
use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::widgets::text::rich;

/// Titles and texts.
pub const PARAGRAPHS: &[(&str, &str)] = &[
    (
        "What the fixed centrode is",
        "At every instant the tip of a moving robot turns about some axis in space. The point of that axis nearest the base \
         is its centrode. While the robot bends freely, a model of its shape tells where the centrode must be, and a tracker on the tip tells where it is.",
    ),
    (
        "What happens on contact",
        "A beam stops one point of the backbone. What lies below keeps the shape it had; only the part above goes on bending, \
         so the tip turns about another axis, and the two centrodes part by about half the distance from the base to the beam. When they are farther apart than ξ2, contact is detected, \
         and the place whose constrained model explains the sensor best is the estimate.",
    ),
    (
        "What the views show",
        "Blue triangles are the model's centrode without contact, orange circles the model with it, green dots what the sensor says, and vermilion is the detection with its estimate. \
         The 3D view and the bending plane show them with the robot in steel and the beam in stone.",
    ),
    (
        "What the plots show",
        "Above, the distance between model and sensor with its threshold ξ2; below it the joint force deviation Θ with ξ1, a constant or a multiple of the bound ε_c that load cell errors alone can reach; then the bend. \
         Thresholds can be dragged. Before arming no alarm is raised. A long filter is calm but late, a short one early but restless: try N.",
    ),
    (
        "The paper on the page",
        "The view Paper shows five figures of the paper and its Table II, simulated here; only the table headed as the paper's holds its measurements. Each is made with a preset of its own, whatever \
         is set on this page; “Use this scenario” loads that preset, and the figure then follows the controls. The map shows, for each place and bend at contact, the largest thresholds that still find it; a click puts the contact there.",
    ),
    (
        "Tuning",
        "This view repeats the experiment with new noise, with contact and without, and judges every run by every threshold. The curves show how many false alarms an earlier detection costs; \
         their bands show how far so few runs leave the numbers open. A dot is what is set, a ring what is advised; a click or a drag on any picture takes its threshold, and the plots below follow.",
    ),
    (
        "How to try things",
        "Drag a slider or type a value with or without its unit; the whole experiment is computed anew at once. A notch under a slider marks the preset, and the round arrow goes back to it.",
    ),
];

/// Keys and what they do.
pub const KEYS: &[(&str, &str)] = &[
    ("Space", "play or pause"),
    ("← →", "step by 0.01 s"),
    ("Shift ← →", "step by 0.1 s"),
    ("Home, End", "go to the start, the end"),
    ("Esc", "take back what is being typed, close this"),
];

/// Shows the help over the page.
pub fn help(ui: &mut Ui, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let screen = ui.ctx().content_rect();
    let modal = Modal::new(Id::unique("help")).backdrop_color(egui::Color32::from_black_alpha(110));
    let frame = egui::Frame::popup(ui.style()).inner_margin(20).corner_radius(12);
    let shown = modal.frame(frame).show(ui.ctx(), |ui| {
        ui.set_width((screen.width() - 72.0).min(560.0));
        let (bar, _) = ui.allocate_exact_size(vec2(ui.available_width(), 30.0), egui::Sense::hover());
        crate::app::widgets::text::paint(
            ui,
            bar.left_center(),
            egui::Align2::LEFT_CENTER,
            "What this page shows",
            fonts::strong(18.0),
            theme.ink,
        );
        let corner = egui::Rect::from_center_size(bar.right_center() - vec2(15.0, 0.0), vec2(32.0, 32.0));
        let closed = icon::button(ui, corner, Icon::Close, "Close help", Look::Plain).clicked();
        ui.add_space(6.0);
        ScrollArea::vertical().max_height(screen.height() - 140.0).min_scrolled_height(screen.height() - 140.0).show(
            ui,
            |ui| {
                ui.set_width(ui.available_width() - 8.0);
                for (title, body) in PARAGRAPHS {
                    ui.add_space(6.0);
                    ui.label(RichText::new(*title).font(fonts::strong(13.5)).color(theme.ink));
                    let mut text = rich(body, 13.5, theme.ink.lerp_to_gamma(theme.dim, 0.4));
                    text.sections.iter_mut().for_each(|section| section.format.line_height = Some(20.0));
                    ui.label(text);
                }
                ui.add_space(10.0);
                ui.spacing_mut().interact_size.y = 0.0;
                egui::Grid::new("keys").spacing(vec2(20.0, 6.0)).show(ui, |ui| {
                    for (key, what) in KEYS {
                        ui.label(RichText::new(*key).font(fonts::strong(13.0)).color(theme.ink));
                        ui.label(RichText::new(*what).color(theme.dim));
                        ui.end_row();
                    }
                });
            },
        );
        closed
    });
    if shown.inner || shown.should_close() {
        out.push(Command::ToggleHelp);
    }
}
