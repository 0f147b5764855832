//! The presets as a gallery: groups, and for each preset a small picture, its name and a sentence.

use crate::app::chain::apply::Wish;
use crate::app::chain::thumb::Thumb as ChainThumb;
use crate::app::charts::plane::thumb::Thumb;
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::mirror;
use crate::app::panels::title::name;
use crate::app::theme::Theme;
use centrode_core::run::simulate;
use centrode_core::scenario::preset::{self, CHAINS, PRESETS, Preset};
use egui::{CursorIcon, Galley, Rect, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2};
use std::sync::Arc;

/// The groups, with the names of their presets.
pub const GROUPS: &[(&str, &[&str])] = &[
    (
        "The paper",
        &["bench", "paper", "disk-1", "disk-3", "mid-gap", "figure-3", "figure-4", "figure-6", "figure-7", "figure-8"],
    ),
    ("Noise", &["free", "static-resolution"]),
    ("Touch", &["touch-1", "touch-2", "touch-3", "cylinder", "snap"]),
    ("Detection", &["miscalibrated", "play", "load-at-rest"]),
    ("Odd", &["letting-go", "gimbal-lock"]),
    ("Several segments", &["three-segments", "two-contacts", "reopened", "buckling", "oblique", "tip-only"]),
];

/// Size of a picture, points.
const PICTURE: Vec2 = vec2(76.0, 66.0);
/// The least width of a preset, points.
const LEAST: f32 = 264.0;
/// Space between presets, points.
const GAP: f32 = 6.0;
/// Space around what a preset holds, points.
const PAD: f32 = 8.0;

/// Pictures that have been made.
#[derive(Debug, Default)]
pub struct Gallery {
    /// In the order of the presets.
    made: Vec<Option<Thumb>>,
    /// Likewise, of several segments.
    chains: Vec<Option<ChainThumb>>,
    /// Whether it was shown in the last frame.
    pub(super) open: bool,
}

impl Gallery {
    /// Whether pictures are to be made for who looks.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.open && (self.made.len() < PRESETS.len() || self.chains.len() < CHAINS.len())
    }

    /// Makes one picture.
    fn work(&mut self) {
        if let Some(preset) = PRESETS.get(self.made.len()) {
            let run = preset.scenario().and_then(|scenario| simulate(&scenario));
            self.made.push(run.ok().map(|run| Thumb::new(&run)));
        } else if let Some(preset) = CHAINS.get(self.chains.len()) {
            self.chains.push(preset.chain(&[]).ok().and_then(|scenario| ChainThumb::new(&scenario)));
        }
    }

    fn paint(&self, painter: &egui::Painter, preset: &Preset, rect: Rect, theme: &Theme) {
        let place = |presets: &[Preset]| presets.iter().position(|other| other.name == preset.name);
        if let Some(Some(thumb)) = place(PRESETS).and_then(|place| self.made.get(place)) {
            thumb.paint(painter, rect, theme);
        }
        if let Some(Some(thumb)) = place(CHAINS).and_then(|place| self.chains.get(place)) {
            thumb.paint(painter, rect, theme);
        }
    }

    /// Shows all presets in the width there is; returns whether one was chosen.
    pub fn show(&mut self, ui: &mut Ui, chosen: &Preset, out: &mut Vec<Command>) -> bool {
        self.open = true;
        if ui.ctx().current_pass_index() == 0 {
            self.work();
        }
        if self.is_working() {
            ui.ctx().request_repaint();
        }
        let theme = Theme::of(ui);
        let width = ui.available_width();
        let columns = ((width + GAP) / (LEAST + GAP)).floor().max(1.0);
        let each = (width - (columns - 1.0) * GAP) / columns;
        let before = out.len();
        ui.spacing_mut().item_spacing = Vec2::splat(0.0);
        for (group, names) in GROUPS {
            ui.add_space(6.0);
            let heading = ui.painter().layout_no_wrap((*group).into(), fonts::strong(13.0), theme.dim);
            let (rect, response) = ui.allocate_exact_size(vec2(width, heading.size().y + 6.0), Sense::hover());
            response.widget_info(|| WidgetInfo::labeled(Role::Heading, true, *group));
            ui.painter().galley(rect.min + vec2(2.0, 0.0), heading, theme.dim);
            let presets: Vec<&'static Preset> = names.iter().filter_map(|name| found(name)).collect();
            ui.push_id(group, |ui| {
                mirror::mark(ui, mirror::Part::Group, group);
                for row in presets.chunks(columns as usize) {
                    self.row(ui, row, (each, chosen, &theme), out);
                }
            });
        }
        out.len() > before
    }

    /// Shows presets beside each other, each so wide.
    fn row(
        &self,
        ui: &mut Ui,
        row: &[&'static Preset],
        (each, chosen, theme): (f32, &Preset, &Theme),
        out: &mut Vec<Command>,
    ) {
        let texts: Vec<_> = row.iter().map(|preset| texts(ui, preset, each, theme)).collect();
        let high = texts.iter().map(|texts| texts[0].size().y + texts[1].size().y + 2.0);
        let high = high.fold(PICTURE.y, f32::max) + 2.0 * PAD;
        let (place, _) = ui.allocate_exact_size(vec2(ui.available_width(), high + GAP), Sense::hover());
        for (k, (preset, texts)) in row.iter().zip(texts).enumerate() {
            let at = place.min + vec2(k as f32 * (each + GAP), 0.0);
            let rect = Rect::from_min_size(at, vec2(each, high));
            if self.item(ui, rect, (preset, preset.name == chosen.name), texts, theme) {
                let several = preset::find_chain(preset.name).is_some();
                out.push(if several { Command::Chain(Wish::Choose(preset)) } else { Command::Choose(preset) });
            }
        }
    }

    fn item(
        &self,
        ui: &mut Ui,
        rect: Rect,
        (preset, chosen): (&Preset, bool),
        [title, summary]: [Arc<Galley>; 2],
        theme: &Theme,
    ) -> bool {
        let response = ui.interact(rect, ui.make_persistent_id(("preset", preset.name)), Sense::click());
        let response = response.on_hover_cursor(CursorIcon::PointingHand);
        let title_text = name(preset);
        response.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, ui.is_enabled(), chosen, &title_text));
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_description(preset.summary()));
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        let warm = response.hovered() || response.has_focus();
        let fill = if warm { theme.raised } else { theme.panel };
        let edge = if chosen { Stroke::new(1.5, theme.accent) } else { Stroke::new(1.0, theme.faint) };
        ui.painter().rect(rect, 8.0, fill, edge, StrokeKind::Inside);
        let picture = Rect::from_min_size(rect.min + Vec2::splat(PAD), PICTURE);
        ui.painter().rect_filled(picture, 5.0, theme.surface);
        self.paint(ui.painter(), preset, picture, theme);
        let at = pos2(picture.right() + 10.0, rect.top() + PAD);
        let below = at + vec2(0.0, title.size().y + 2.0);
        ui.painter().galley(at, title, theme.ink);
        ui.painter().galley(below, summary, theme.dim);
        response.clicked()
    }
}

/// The preset of a name, with one segment or several.
fn found(name: &str) -> Option<&'static Preset> {
    preset::find(name).ok().or_else(|| preset::find_chain(name))
}

/// Name and sentence of a preset that is so wide.
fn texts(ui: &Ui, preset: &Preset, width: f32, theme: &Theme) -> [Arc<Galley>; 2] {
    let room = width - PICTURE.x - 2.0 * PAD - 10.0;
    let title = ui.painter().layout(name(preset), fonts::strong(13.0), theme.ink, room);
    let summary = ui.painter().layout(preset.summary().into(), fonts::regular(12.0), theme.dim, room);
    [title, summary]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_stands_in_one_group() {
        let listed: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        for preset in PRESETS.iter().chain(CHAINS) {
            assert_eq!(listed.iter().filter(|name| **name == preset.name).count(), 1, "{}", preset.name);
        }
        assert_eq!(listed.len(), PRESETS.len() + CHAINS.len(), "a name of no preset");
    }
}
