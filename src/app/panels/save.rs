//! The menu by which what a card shows is saved.

use egui::{Context, Id, Popup, Rect, Role, Ui};

use crate::app::command::Command;
use crate::app::panels::menu;
use crate::app::panels::title::choice;
use crate::app::saving::Subject;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::icon::{self, Icon, Look};

/// Width and height of the button, points.
const BUTTON: f32 = 30.0;
/// The menu that a key asked for is opened when it is next shown, unless that takes more frames than this.
const PATIENCE: u64 = 4;

/// Width and height of the button, points; larger for a finger.
#[must_use]
pub fn side(ui: &Ui) -> f32 {
    finger::at_least(ui, BUTTON)
}

fn asked() -> Id {
    Id::unique("save")
}

/// Opens the menu of something, should it be on the page.
pub fn offer(ctx: &Context, subject: Subject) {
    let frame = ctx.cumulative_frame_nr();
    ctx.data_mut(|data| data.insert_temp(asked(), (subject, frame)));
    ctx.request_repaint();
}

/// Whether a key has just asked for the menu of something.
fn is_asked(ctx: &Context, subject: Subject) -> bool {
    let Some((wanted, frame)) = ctx.data(|data| data.get_temp::<(Subject, u64)>(asked())) else { return false };
    if wanted != subject {
        return false;
    }
    ctx.data_mut(|data| data.remove::<(Subject, u64)>(asked()));
    ctx.cumulative_frame_nr().saturating_sub(frame) <= PATIENCE
}

/// What else the menu of the plots offers once there are two times A and B.
const COPY: (&str, &str) = ("Copy A and B", "Both times and values with their differences, as a table of text");

/// Shows the button and, when it was clicked or a key asked for it, the menu.
pub fn menu(ui: &mut Ui, rect: Rect, subject: Subject, out: &mut Vec<Command>) {
    menu_with(ui, rect, subject, false, out);
}

/// The same; `marked` says whether there are two times A and B.
pub fn menu_with(ui: &mut Ui, rect: Rect, subject: Subject, marked: bool, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let label = format!("Save {}", subject.name());
    let response = icon::button(ui, rect, Icon::Save, &label, Look::Plain);
    let id = Popup::default_response_id(&response);
    if is_asked(ui.ctx(), subject) {
        Popup::open_id(ui.ctx(), id);
        response.request_focus();
        menu::enter(ui.ctx(), id);
    }
    let width = (ui.ctx().content_rect().width() - 40.0).min(300.0);
    menu::show(ui, &response, &label, width, |ui| {
        ui.set_width(width);
        ui.spacing_mut().item_spacing.y = 2.0;
        for &format in subject.formats(marked) {
            if choice(ui, Role::MenuItem, format.words(subject), false, &theme).clicked() {
                out.push(Command::Save(subject, format));
                ui.close();
            }
        }
        if marked && choice(ui, Role::MenuItem, COPY, false, &theme).clicked() {
            out.push(Command::CopyMarks);
            ui.close();
        }
    });
}
