//! Every estimate behind Table II against the true place: the paper's, and the simulated ones.

use crate::app::charts::notation::number;
use crate::app::charts::paint::{self, Picture, Place};
use crate::app::theme::Theme;
use centrode_core::study::table2::chart::{Estimate, chart, estimates as all};
use centrode_core::study::table2::{Disk, Row, Table2};
use egui::{Painter, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo};

/// Least height of the picture, points.
pub const LEAST: f32 = 190.0;
/// Height beyond which the lanes get no wider, points.
const MOST: f32 = 420.0;
/// Size of the chart's text, points.
const TEXT: f32 = 11.5;
/// The pointer reads a mark this near, points.
const REACH: f32 = 9.0;

/// Shows all estimates in lanes, a disk each.
pub fn estimates(
    ui: &mut Ui,
    rect: Rect,
    (shown, rows, version): (&Table2, [&[Row]; 2], u64),
    kept: &mut Option<Picture<u64>>,
) {
    let theme = Theme::of(ui);
    let rect = rect.with_max_y(rect.bottom().min(rect.top() + MOST));
    let painter = ui.painter().clone();
    let all = all(shown, rows);
    let picture = Picture::keep(kept, ui.ctx(), &theme, (version, false), || chart(shown, &all));
    let places = picture.show(&painter, &theme, rect, paint::page(TEXT));
    let Some(place) = places.first() else { return };
    let response = ui.interact(place.data(), ui.make_persistent_id("estimates"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, described(shown, all.len())));
    read(&painter, response, place, (shown, &all), &theme);
}

/// Names the nearest mark under the pointer.
fn read(painter: &Painter, response: Response, place: &Place, (shown, all): (&Table2, &[Estimate]), theme: &Theme) {
    let Some(pointer) = response.hover_pos() else { return };
    let near = all.iter().map(|estimate| (place.at(estimate.at).distance(pointer), estimate));
    let Some((_, estimate)) = near.filter(|(away, _)| *away < REACH).min_by(|a, b| a.0.total_cmp(&b.0)) else { return };
    painter.circle_stroke(place.at(estimate.at), 7.0, Stroke::new(1.5, theme.ink));
    let who = estimate.source.name(shown);
    let mm = number(estimate.at[0] * 1e3, 1);
    response.on_hover_text_at_pointer(format!("Disk {}, {who}, run {}: {mm} mm", estimate.disk, estimate.place));
}

/// The picture in words.
fn described(shown: &Table2, marks: usize) -> String {
    let mean = |disk: &Disk| number(disk.location.mean * 1e3, 1);
    let disks = shown.paper.iter().zip(&shown.simulated).zip(&shown.other).map(|((paper, simulated), other)| {
        let truth = number(simulated.arc_length * 1e3, 1);
        let [own, flat] = [shown.kind, shown.other_kind].map(|kind| kind.name());
        let means = [paper, simulated, other].map(mean);
        format!("disk {} at {truth} mm: paper {}, {own} {}, {flat} {}", simulated.disk, means[0], means[1], means[2])
    });
    let disks: Vec<String> = disks.collect();
    format!("Estimated places of contact, {marks} marks; means in mm: {}", disks.join("; "))
}
