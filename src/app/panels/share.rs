//! The menu by which things leave the page and come in, and what is said in passing.

use egui::{Align2, Rect, Role, Ui, WidgetInfo, pos2, vec2};

use crate::app::command::{Command, Share};
use crate::app::fonts;
use crate::app::panels::menu;
use crate::app::panels::title::item;
use crate::app::theme::Theme;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::app::widgets::text;

const ITEMS: [(Share, &str, &str); 5] = [
    (
        Share::CopyLink,
        "Copy link",
        "What is set and shown here, in an address. Nothing leaves this device until you send it.",
    ),
    (Share::CopyCommand, "Copy command", "Computes the same without a page, with the centrode command"),
    (Share::Save, "Save scenario", "What is set, as a TOML file"),
    (Share::Open, "Open scenario", "A TOML file; it can also be dropped on the page"),
    (
        Share::OpenLog,
        "Open log",
        "What a rig recorded: CSV, TUM, EuRoC, NDI or MCAP. It is read on this device and stays on it; it can also be dropped.",
    ),
];

/// Shows the button and, when it was clicked, the menu.
pub fn menu(ui: &mut Ui, rect: Rect, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let response = icon::button(ui, rect, Icon::Share, "Share", Look::Plain);
    let width = (ui.ctx().content_rect().width() - 40.0).min(320.0);
    menu::show(ui, &response, "Share", width, |ui| {
        ui.set_width(width);
        ui.spacing_mut().item_spacing.y = 2.0;
        for (what, title, summary) in ITEMS {
            if item(ui, Role::MenuItem, (title, summary), false, &theme) {
                out.push(Command::Share(what));
                ui.close();
            }
        }
    });
}

/// Shows what is said in passing, below the tools.
pub fn said(ui: &Ui, tools: Rect, said: Option<&str>) {
    let Some(said) = said else { return };
    let theme = Theme::of(ui);
    let id = egui::Id::unique("said");
    let width = text::width(ui, said, fonts::strong(13.0)).min(tools.right() - 60.0);
    let rect = Rect::from_min_size(pos2(tools.right() - width - 32.0, tools.bottom() + 6.0), vec2(width + 24.0, 32.0));
    egui::Area::new(id).order(egui::Order::Tooltip).fixed_pos(rect.min).interactable(false).show(ui.ctx(), |ui| {
        let (rect, response) = ui.allocate_exact_size(rect.size(), egui::Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, said));
        ui.painter().rect_filled(rect, 8.0, theme.ink);
        let inside = ui.painter().with_clip_rect(rect);
        inside.text(rect.left_center() + vec2(12.0, 0.0), Align2::LEFT_CENTER, said, fonts::strong(13.0), theme.panel);
    });
}
