//! What a figure or Table II is made with: a preset of its own, so that looking at it changes nothing that is set.

use centrode_core::scenario::Scenario;
use centrode_core::scenario::preset::{self, Preset};
use egui::{Align2, Rect, Ui, pos2, vec2};

use crate::app::command::Command;
use crate::app::panels::title;
use crate::app::stages::stage::Stage;
use crate::app::state::shipped;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::text::{paint_rich, rich, width};

/// Height of the line that says it, points.
pub const LINE: f32 = 28.0;

/// The scenario of a figure or of Table II.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// The preset that it belongs to.
    pub preset: &'static Preset,
    /// The scenario: the preset's, or the page's once the page has been given that preset.
    pub scenario: Scenario,
    /// Whether it is the page's, and follows the controls.
    pub taken: bool,
    /// Whether it differs from the preset.
    pub changed: bool,
}

impl Source {
    /// Brings the source up to date with what stands on the stage, with the preset that the page goes back to and that
    /// preset's scenario, and with the page's scenario.
    pub fn update(known: &mut Option<Self>, stage: Stage, (chosen, base): (&str, &Scenario), live: &Scenario) {
        let Some(preset) = stage.own_preset().and_then(|name| preset::find(name).ok()) else {
            *known = None;
            return;
        };
        let taken = preset.name == chosen;
        if taken {
            if known.as_ref().is_none_or(|known| !known.taken || known.preset != preset || known.scenario != *live) {
                *known = Some(Self { preset, scenario: live.clone(), taken, changed: live != base });
            }
        } else if known.as_ref().is_none_or(|known| known.taken || known.preset != preset) {
            *known = Some(Self { preset, scenario: shipped(preset), taken, changed: false });
        }
    }

    /// Says in a line which scenario it is; one click takes it over.
    pub fn line(&self, ui: &mut Ui, rect: Rect, out: &mut Vec<Command>) {
        let theme = Theme::of(ui);
        let name = title::name(self.preset);
        let wide = rect.width() > 620.0;
        let said = match (self.taken, self.changed) {
            (true, true) if wide => format!("Made with what is set on this page: preset {name}, changed."),
            (true, false) if wide => format!("Made with what is set on this page: preset {name}."),
            (true, true) => format!("Made with: {name}, changed here"),
            (true, false) => format!("Made with: {name}, as set here"),
            (false, _) if wide => format!("Made with preset {name}, not with what is set on this page."),
            (false, _) => format!("Made with: preset {name}"),
        };
        paint_rich(ui, rect.left_center(), Align2::LEFT_CENTER, &said, 12.5, theme.dim);
        let id = ui.make_persistent_id("source");
        let said_width = ui.painter().layout_job(rich(&said, 12.5, theme.dim)).size().x;
        let response = ui.interact(rect.with_max_x(rect.left() + said_width), id, egui::Sense::hover());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &said));
        if !self.taken {
            let text = "Use this scenario";
            let size = vec2(width(ui, text, crate::app::fonts::strong(12.5)) + 24.0, 26.0);
            let left = (rect.left() + said_width + 12.0).min(rect.right() - size.x);
            let place = Rect::from_min_size(pos2(left, rect.center().y - 0.5 * size.y), size);
            if button(ui, place, text, &theme) {
                out.push(Command::Choose(self.preset));
            }
        }
    }
}
