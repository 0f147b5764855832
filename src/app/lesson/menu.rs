//! The menu by which the lessons are entered.

use super::challenge::CHALLENGES;
use super::tour::{STEPS, TOUR};
use super::{Lesson, Wish};
use crate::app::command::Command;
use crate::app::controls::row::TARGET;
use crate::app::panels::menu;
use crate::app::panels::title::item;
use crate::app::theme::Theme;
use crate::app::widgets::icon::{self, Icon, Look};
use egui::{Rect, Role, Ui, vec2};

/// Shows the button at the left end of the tools and, when it was clicked, the menu.
pub fn menu(ui: &mut Ui, (tools, sheet): (Rect, bool), (lesson, open): (&Lesson, bool), out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let (side, from) = if sheet { (TARGET, 0.5 * TARGET) } else { (34.0, 20.0) };
    let place = Rect::from_center_size(tools.left_center() + vec2(from, 0.0), vec2(side, side));
    let response = icon::button(ui, place, Icon::Learn, "Learn", if open { Look::Lit } else { Look::Plain });
    let width = (ui.ctx().content_rect().width() - 40.0).min(320.0);
    menu::show(ui, &response, "Learn", width, |ui| {
        ui.set_width(width);
        ui.spacing_mut().item_spacing.y = 2.0;
        let mut offer = |ui: &mut Ui, title: &str, summary: &str, wish: Wish| {
            if item(ui, Role::MenuItem, (title, summary), false, &theme) {
                out.push(Command::Lesson(wish));
                ui.close();
            }
        };
        if open {
            offer(ui, "Leave", "Back to what was set before", Wish::Leave);
        }
        let resume = lesson.resume();
        if resume > 0 {
            offer(ui, &format!("Resume step {}", resume + 1), TOUR[resume].title, Wish::Tour(resume));
        }
        let about = format!(
            "What a centrode is and how it gives a contact away, in {STEPS} steps. What is set here comes back afterwards."
        );
        offer(ui, if resume > 0 { "Tour from the start" } else { "Tour" }, &about, Wish::Tour(0));
        let met = CHALLENGES.iter().filter(|of| lesson.is_met(of.key)).count();
        let about = format!("Exercises with a goal that the page measures: {met} of {} met", CHALLENGES.len());
        offer(ui, "Challenges", &about, Wish::Challenges);
    });
}
