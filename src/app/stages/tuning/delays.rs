//! When contact is found: a histogram of the delays for each disk, with those that alarm before and those missed.

use crate::app::charts::paint::{self, Picture};
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::stages::tuner::LATE;
use crate::app::stages::tuning::{REACH, TEXT, View, taken};
use crate::app::widgets::text;
use centrode_core::chart::Chart;
use centrode_core::study::tuning::chart::places;
use centrode_core::study::tuning::watch::Rule;
use egui::{Align2, CursorIcon, Rect, Role, Sense, Ui, WidgetInfo};

/// What the picture is made of: the study's version, a rule, and its threshold.
pub type Key = (u64, Rule, Option<u64>);

/// Shows one row for each contact. A drag moves the threshold to the one whose median delay is under the pointer.
pub fn histogram(
    ui: &mut Ui,
    rect: Rect,
    view: &View<'_>,
    version: u64,
    kept: &mut Option<Picture<Key>>,
    out: &mut Vec<Command>,
) {
    let (theme, rule) = (&view.theme, view.tuning.rule);
    let (contacts, threshold) = (&view.cells.contacts, view.own().map(|point| point.threshold));
    // The median of the contact that is set: what a drag moves.
    let median = view.own().and_then(|point| point.detection).map(|seen| seen.median).filter(|delay| !delay.is_nan());
    let make = || {
        let panel = places(view.study, contacts, (rule, threshold), median, LATE);
        Chart { panels: vec![panel], ..Chart::default() }
    };
    let key = (version, rule, threshold.map(f64::to_bits));
    let picture = Picture::keep(kept, ui.ctx(), theme, (key, false), make);
    let found = picture.show(ui.painter(), theme, rect, paint::page(TEXT));
    let (Some(place), Some(panel)) = (found.first(), picture.chart().panels.first()) else { return };
    let data = place.data();
    if threshold.is_none() || contacts.is_empty() {
        let said = if contacts.is_empty() { "no contact" } else { "switched off" };
        text::paint(ui, data.center(), Align2::CENTER_CENTER, said, fonts::regular(12.5), theme.dim);
        return;
    }
    let held = median.map_or(f32::NAN, |median| place.at([median, 0.0]).x);
    let response = ui.interact(data, ui.make_persistent_id(&panel.title), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, &panel.title));
    if let Some(pointer) = taken(ui, &response, |finger| (finger.x - held).abs() < REACH) {
        take(place.value(pointer)[0], view, out);
    }
}

/// Takes the threshold whose median delay is nearest to what is wanted, s.
fn take(wanted: f64, view: &View<'_>, out: &mut Vec<Command>) {
    let levels = view.curve().iter().enumerate();
    let far = |median: f64| (median - wanted).abs();
    let medians = levels.filter_map(|(level, point)| Some((level, point.detection?.median)));
    let nearest = medians.filter(|(_, median)| !median.is_nan()).min_by(|a, b| far(a.1).total_cmp(&far(b.1)));
    if let Some((level, _)) = nearest {
        view.take(level, None, out);
    }
}
