//! The bar of views: always there, so that none has to be found.

use egui::{Align2, Rect, Role, Ui, vec2};

use crate::app::command::Command;
use crate::app::fonts;
use crate::app::stages::stage::{Section, Stage};
use crate::app::theme::Theme;
use crate::app::widgets::segmented::{Segment, segments};
use crate::app::widgets::text;

/// The widest the bar gets, points.
const WIDTH: f32 = 440.0;
/// Its height, points.
const HEIGHT: f32 = 34.0;
/// The same where fingers are: nothing but this row is there.
const TALL: f32 = 44.0;
const SAID: &str = "contact detection on a continuum robot";

/// Shows the bar; `paper` is what of the paper was looked at last.
pub fn views(ui: &mut Ui, rect: Rect, stage: Stage, paper: Stage, out: &mut Vec<Command>) {
    let height = if rect.width() < WIDTH { TALL } else { HEIGHT };
    let bar = vec2(rect.width().min(WIDTH), rect.height().min(height));
    let bar = Rect::from_min_size(rect.left_center() - vec2(0.0, 0.5 * bar.y), bar);
    let options =
        Section::ALL.map(|section| Segment { text: section.name(), name: section.name(), hint: section.summary() });
    let chosen = Section::ALL.iter().position(|section| *section == stage.section()).unwrap_or(0);
    if let Some(picked) = segments(ui, bar, ("Bar of views", Role::Tab), &options, chosen) {
        out.push(Command::Show(match Section::ALL[picked] {
            Section::Robot => Stage::Robot,
            Section::Chain => Stage::Chain,
            Section::Paper => paper,
            Section::Map => Stage::Map,
            Section::Tuning => Stage::Tuning,
        }));
    }
    // What the page is, where there is room to say so.
    let room = rect.right() - bar.right() - 40.0;
    if text::width(ui, SAID, fonts::regular(13.0)) < room {
        let at = bar.right_center() + vec2(20.0, 0.0);
        text::paint(ui, at, Align2::LEFT_CENTER, SAID, fonts::regular(13.0), Theme::of(ui).dim);
    }
}
