//! Where along the backbone contacts are, as far as is known at the playback position.

use crate::app::chain::memo::Memo;
use crate::app::charts::notation::job;
use crate::app::charts::paint::{Picture, page};
use crate::app::charts::plots::frame::{Frame, GUTTER, RIGHT, SMALL};
use crate::app::theme::Theme;
use centrode_core::chart::Chart;
use centrode_core::chart::layout::Page;
use centrode_core::study::chain::course::along;
use egui::{Ui, vec2};

/// What a picture is made of: the run, which estimates, and what presses.
type Key = (u64, Vec<(usize, u64)>, Vec<usize>);

/// What is remembered between frames.
#[derive(Default)]
pub struct BackboneState {
    picture: Option<Picture<Key>>,
}

/// Shows it in all of `ui`, at a time (s).
pub fn backbone(ui: &mut Ui, memo: &Memo, time: f64, state: &mut BackboneState) {
    let theme = Theme::of(ui);
    let (run, rect) = (memo.run(), ui.max_rect());
    let placed = memo.placed(time);
    let pressing = run.plan.path().at(time, &run.plan.bends(time)).active;
    let key = (memo.version(), placed.iter().map(|(k, estimate)| (*k, estimate.time.to_bits())).collect(), pressing);
    let make = || Chart { panels: vec![along(run, &placed, time)], ..Chart::default() };
    let title = job("Where along the backbone", 12.5, theme.ink);
    let galley = ui.painter().layout_job(title);
    ui.painter().galley(rect.min + vec2(2.0, 1.0), galley, theme.ink);
    let picture = Picture::keep(&mut state.picture, ui.ctx(), &theme, (key, false), make);
    let sides = Some([GUTTER, RIGHT].map(f64::from));
    let page = Page { sides, pixel: f64::from(1.0 / ui.pixels_per_point()), ..page(SMALL) };
    let places = picture.show(ui.painter(), &theme, Frame::below_title(rect), page);
    let response = ui.interact(rect, ui.scope_id().with("backbone"), egui::Sense::hover());
    let said = if placed.is_empty() { "no contact is placed yet" } else { "probability density of each contact" };
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Figure, true, format!("Where along the backbone: {said}"))
    });
    if let Some(place) = places.first().filter(|_| placed.is_empty()) {
        let words = ui.painter().layout_job(job("no contact is placed yet", 12.0, theme.dim));
        let at = egui::Rect::from_center_size(place.data().center(), words.size());
        // Not across the lines between segments.
        ui.painter().rect_filled(at.expand2(vec2(6.0, 2.0)), 0.0, theme.panel);
        ui.painter().galley(at.min, words, theme.dim);
    }
}
