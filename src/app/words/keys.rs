//! The list of keys.

use egui::{Id, Modal, Rect, RichText, ScrollArea, Ui, vec2};

use crate::app::command::Command;
use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::words::help::{heading, titled};

/// Where keys are heard, which, and what they do.
pub const KEYS: &[(&str, &[(&str, &str)])] = &[
    (
        "Everywhere but in a field",
        &[
            ("Tab", "go to the next control; with Shift to the one before"),
            ("Space", "play or pause, unless a button has the focus"),
            ("A, B", "mark the time shown"),
            ("C", "copy what changes from A to B"),
            ("S", "save what is on the stage"),
            ("Shift S", "save the plots or the run"),
            ("M", "let the run be heard, or no longer"),
            ("?", "show this list"),
            ("Esc", "discard what is typed, or close what is open"),
        ],
    ),
    (
        "While no control has the focus",
        &[
            ("← →", "step by 0.01 s"),
            ("Shift ← →", "step by 0.1 s"),
            ("Home, End", "go to the start or the end"),
            ("Shift drag", "mark A and B on a plot"),
            ("Delete", "remove A and B"),
        ],
    ),
    (
        "On a slider",
        &[
            ("← → ↑ ↓", "one step; with Shift ten"),
            ("PageUp, PageDown", "a tenth of its range"),
            ("Home, End", "the least or the greatest value"),
        ],
    ),
    ("In the 3D view", &[("← → ↑ ↓", "turn it; with Shift move it"), ("+ −", "zoom"), ("Home", "show it as at first")]),
    ("In a menu", &[("↑ ↓", "go from entry to entry"), ("Enter", "take it"), ("Esc", "close it")]),
];

/// All keys in columns, under where they are heard.
pub fn table(ui: &mut Ui, theme: &Theme) {
    ui.spacing_mut().interact_size.y = 0.0;
    for (place, keys) in KEYS {
        ui.add_space(8.0);
        heading(ui, place, 13.5, theme);
        ui.add_space(4.0);
        egui::Grid::new(*place).min_col_width(108.0).spacing(vec2(16.0, 6.0)).show(ui, |ui| {
            for (key, what) in *keys {
                ui.label(RichText::new(*key).font(fonts::strong(13.0)).color(theme.ink));
                ui.add(egui::Label::new(RichText::new(*what).color(theme.dim)).wrap());
                ui.end_row();
            }
        });
    }
}

/// Shows the list over the page; opened by a key it takes the keyboard.
pub fn keys(ui: &mut Ui, by_key: bool, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let screen = ui.ctx().content_rect();
    let modal = Modal::new(Id::unique("keys")).backdrop_color(egui::Color32::from_black_alpha(110));
    let frame = egui::Frame::popup(ui.style()).inner_margin(20).corner_radius(12);
    let shown = modal.frame(frame).show(ui.ctx(), |ui| {
        ui.set_width((screen.width() - 72.0).min(460.0));
        let (bar, _) = ui.allocate_exact_size(vec2(ui.available_width(), 30.0), egui::Sense::hover());
        titled(ui, bar, "Keys", &theme);
        let corner = Rect::from_center_size(bar.right_center() - vec2(15.0, 0.0), vec2(32.0, 32.0));
        let close = icon::button(ui, corner, Icon::Close, "Close keys", Look::Plain);
        if by_key {
            close.request_focus();
        }
        let height = (screen.height() - 140.0).min(620.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.set_width(ui.available_width() - 8.0);
            table(ui, &theme);
        });
        close.clicked()
    });
    if shown.inner || shown.should_close() {
        out.push(Command::ToggleKeys);
    }
}
