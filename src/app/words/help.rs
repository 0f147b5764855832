//! The help: what one sees, and which keys there are.

use egui::{Align, Id, Layout, Modal, RichText, ScrollArea, Ui, vec2};

use crate::app::command::Command;
use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::widgets::symbol;
use crate::app::widgets::text::rich_lines;
use crate::app::widgets::toggle::toggle;
use crate::app::words::keys;

/// Titles and texts.
pub const PARAGRAPHS: &[(&str, &str)] = &[
    (
        "What the fixed centrode is",
        "At every instant the tip of a moving robot turns about an axis in space. The centrode is the point of that axis nearest to the base. \
         While the robot bends freely, a model of its shape predicts the centrode, and a tracker on the tip measures it.",
    ),
    (
        "What happens on contact",
        "A beam stops one point of the backbone. The paper's beam is a clamp: the part below it keeps its shape and only the part above goes on bending, so the tip turns about \
         another axis, and the two centrodes move apart by about half the distance from the base to the beam. When they are farther apart than the threshold ξ2, contact is detected. \
         The estimate is the place of contact whose model explains the measured centrode best.",
    ),
    (
        "Clamp, plane and cylinder",
        "A clamp holds a disk where it is and as it is turned. A flat or a round beam only pushes against it, without friction: the part below goes on changing its shape, the \
         centrodes move apart less, and detection comes later or not at all. The arrow is the force on the robot. “Compare with a clamp” above the 3D view adds the shape that a \
         clamp would give.",
    ),
    (
        "What the views show",
        "Blue triangles mark the model's centrode without contact, orange circles the model's centrode with contact, and green dots the centrode that the tracker measures. \
         The detection and its estimate are vermilion. The 3D view and the bending plane use the same colours; the robot is steel grey, the beam stone grey.",
    ),
    (
        "What the plots show",
        "The first plot shows the distance between the model's centrode and the measured one, with its threshold ξ2. The second shows the joint force deviation Θ with its threshold ξ1, \
         which is a constant or a multiple of ε_c, the deviation that load cell errors alone can cause. The third shows the bend. You can drag the thresholds. \
         No alarm is raised before the arming time. A long filter gives few false alarms but reacts late; a short one reacts early but gives more of them: try N.",
    ),
    (
        "The paper on the page",
        "The view Paper shows five figures of the paper and its Table II, simulated here; only the parts headed “The paper's experiment” hold its measurements. Each is made with a preset of its own, whatever \
         is set on this page; “Use this scenario” loads that preset, and the figure then follows the controls. The map shows which contacts are detectable: for each place and bend at contact, the \
         largest thresholds that still detect it. Click on it to put the contact there.",
    ),
    (
        "Tuning",
        "The tuning view repeats the experiment with new noise, with contact and without, and judges every run by every threshold. The curves show how many false alarms an earlier detection costs; \
         their bands show how uncertain that is after so few runs. A dot marks what is set, a ring what is recommended. Click or drag on a picture to take its threshold; the plots below follow. \
         Detectors holds all of them against each other, and against what no test and no estimate can beat.",
    ),
    (
        "How to try things",
        "Drag a slider, or type a value with or without its unit; the experiment is computed again at once. The notch under a slider marks the preset's value, and the round arrow returns to it.",
    ),
];

/// What the theory is.
const THEORY: &str =
    "Every equation with the function that computes it, the misprints with their proof, and what limits detection";

/// What is heard.
const SOUND: &str = "While the run plays, a tone rises with the centrode's deviation: an octave at its threshold. A strike tells an alarm.";

/// Shows the help over the page; opened by a key it takes the keyboard. `sound` says whether the run is heard.
pub fn help(ui: &mut Ui, (sound, by_key): (bool, bool), out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let screen = ui.ctx().content_rect();
    let modal = Modal::new(Id::unique("help")).backdrop_color(egui::Color32::from_black_alpha(110));
    let frame = egui::Frame::popup(ui.style()).inner_margin(20).corner_radius(12);
    let shown = modal.frame(frame).show(ui.ctx(), |ui| {
        ui.set_width((screen.width() - 72.0).min(560.0));
        let (bar, _) = ui.allocate_exact_size(vec2(ui.available_width(), 30.0), egui::Sense::hover());
        titled(ui, bar, "What this page shows", &theme);
        let corner = egui::Rect::from_center_size(bar.right_center() - vec2(15.0, 0.0), vec2(32.0, 32.0));
        let close = icon::button(ui, corner, Icon::Close, "Close help", Look::Plain);
        if by_key {
            close.request_focus();
        }
        ui.add_space(6.0);
        ScrollArea::vertical().max_height(screen.height() - 140.0).min_scrolled_height(screen.height() - 140.0).show(
            ui,
            |ui| {
                ui.set_width(ui.available_width() - 8.0);
                ui.add_space(4.0);
                let theory = egui::Button::new(RichText::new("Open the theory").font(fonts::strong(13.0)));
                ui.horizontal(|ui| {
                    if ui.add(theory).on_hover_text(THEORY).clicked() {
                        out.push(Command::Theory(None));
                    }
                    let keys = egui::Button::new(RichText::new("Keys").font(fonts::strong(13.0)));
                    if ui.add(keys).on_hover_text("All of them, also by the key ?").clicked() {
                        out.push(Command::ToggleKeys);
                    }
                    let (place, _) = ui.allocate_exact_size(ui.spacing().interact_size, egui::Sense::hover());
                    if toggle(ui, place, "Sound", sound) {
                        out.push(Command::ToggleSound);
                    }
                    ui.label("Sound").on_hover_text(SOUND);
                });
                for (title, body) in PARAGRAPHS {
                    ui.add_space(6.0);
                    heading(ui, title, 13.5, &theme);
                    let text = rich_lines(body, 13.5, theme.ink.lerp_to_gamma(theme.dim, 0.4), 1.48);
                    symbol::label(ui, text, false);
                }
                ui.add_space(10.0);
                keys::table(ui, &theme);
                ui.add_space(10.0);
                if ui.link("Licences of what this page is made of").clicked() {
                    out.push(Command::Licences);
                }
            },
        );
        close.clicked()
    });
    if shown.inner || shown.should_close() {
        out.push(Command::ToggleHelp);
    }
}

/// A title in the flow.
pub(super) fn heading(ui: &mut Ui, title: &str, size: f32, theme: &Theme) {
    let response = ui.label(RichText::new(title).font(fonts::strong(size)).color(theme.ink));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_role(egui::Role::Heading);
        node.set_label(title);
    });
}

/// The title of a window, in its place.
pub(super) fn titled(ui: &mut Ui, bar: egui::Rect, title: &str, theme: &Theme) {
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(bar).layout(Layout::left_to_right(Align::Center)));
    heading(&mut inside, title, 18.0, theme);
}
