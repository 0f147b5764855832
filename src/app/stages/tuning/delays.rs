//! When contact is found: a histogram of the delays for each disk, with those that alarm before and those missed.

use crate::app::charts::notation::{job, number};
use crate::app::charts::plots::{Axis, Steps};
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::stages::tuner::LATE;
use crate::app::stages::tuning::{REACH, View, color, taken, title};
use crate::app::widgets::text;
use centrode_core::study::tuning::tally::Count;
use egui::{Align2, CursorIcon, Painter, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Bars over the delays that are in time.
const BARS: usize = 50;
/// Room for the words beside each row.
const WORDS: f32 = 118.0;

/// Shows one row for each contact. A drag moves the threshold to the one whose median delay is under the pointer.
pub fn histogram(ui: &mut Ui, rect: Rect, view: &View<'_>, out: &mut Vec<Command>) {
    let theme = &view.theme;
    let heading = "Delay by place of contact";
    title(ui, rect, heading, theme);
    let rows = &view.cells.contacts;
    let level = view.derived.own[view.tuning.rule as usize];
    let place = Rect::from_min_max(rect.min + vec2(0.0, 4.0), rect.max - vec2(WORDS - 10.0, 0.0));
    let data = Rect::from_min_max(place.min + vec2(50.0, 20.0), place.max - vec2(10.0, 38.0));
    let data = Rect::from_min_size(data.min, data.size().max(vec2(40.0, 40.0)));
    let time = Axis::new([0.0, LATE], [data.left(), data.right()]);
    let painter = ui.painter().clone();
    let font = fonts::regular(11.0);
    for tick in time.ticks(56.0, Steps::Decimal) {
        let at = painter.round_to_pixel_center(time.at(tick.value));
        painter.vline(at, data.y_range(), Stroke::new(1.0, theme.faint.gamma_multiply(0.7)));
        painter.text(pos2(at, data.bottom() + 4.0), Align2::CENTER_TOP, tick.text, font.clone(), theme.dim);
    }
    let name = painter.layout_job(job("Delay after contact (s)", 12.0, theme.ink));
    painter.galley(pos2(data.center().x - 0.5 * name.size().x, data.bottom() + 18.0), name, theme.ink);
    let (Some(level), false) = (level, rows.is_empty()) else {
        let said = if rows.is_empty() { "no contact" } else { "switched off" };
        text::paint(ui, data.center(), Align2::CENTER_CENTER, said, fonts::regular(12.5), theme.dim);
        return;
    };
    let height = data.height() / rows.len() as f32;
    for (k, (name, cell)) in rows.iter().enumerate() {
        let row = Rect::from_min_size(pos2(data.left(), data.top() + height * k as f32), vec2(data.width(), height));
        one(&painter, row, view, (name, *cell), level);
    }
    // The median of the contact that is set: what a drag moves.
    let median = view.own().and_then(|point| point.detection).map_or(f64::NAN, |seen| seen.median);
    if !median.is_nan() {
        let x = time.at(median);
        let line = [pos2(x, data.top()), pos2(x, data.bottom())];
        painter.extend(Shape::dashed_line(&line, Stroke::new(1.4, theme.detection), 5.0, 3.5));
    }
    let held = time.at(median);
    let response = ui.interact(data, ui.make_persistent_id(heading), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, heading));
    if let Some(pointer) = taken(ui, &response, |finger| (finger.x - held).abs() < REACH) {
        take(time.value(pointer.x), view, out);
    }
}

fn one(painter: &Painter, row: Rect, view: &View<'_>, (name, cell): (&str, usize), level: usize) {
    let (theme, rule) = (&view.theme, view.tuning.rule);
    let Some(held) = view.study.cells()[cell].held else { return };
    let batch = &view.study.batches()[held];
    // Cells share their thresholds, but for an own one that only some have.
    let threshold = view.curve()[level].threshold;
    let Some(level) = view.study.levels(cell, rule).iter().position(|&other| other == threshold) else { return };
    let count = batch.counted(rule, level).count;
    let heights = bars(count, batch.clock.rate);
    let most = heights.iter().copied().max().unwrap_or(0).max(1) as f32;
    let base = row.bottom() - 3.0;
    painter.hline(row.x_range(), painter.round_to_pixel_center(base), Stroke::new(1.0, theme.faint));
    let width = row.width() / BARS as f32;
    let high = (row.height() - 10.0).max(4.0);
    for (k, bar) in heights.iter().enumerate().filter(|(_, bar)| **bar > 0) {
        let left = row.left() + width * k as f32;
        let top = base - high * *bar as f32 / most;
        let bar = Rect::from_min_max(pos2(left + 0.5, top), pos2(left + width - 0.5, base));
        painter.rect_filled(bar, 1.0, color(rule, theme));
    }
    let y = row.center().y;
    painter.text(pos2(row.left() - 6.0, y), Align2::RIGHT_CENTER, name, fonts::regular(11.0), theme.ink);
    let seen = view.study.point(cell, rule, level).detection;
    let Some(seen) = seen.filter(|seen| seen.early.of > 0) else { return };
    let mut lines = vec![format!("found {} of {}", seen.detected.count, seen.detected.of)];
    if seen.early.count > 0 {
        lines.push(format!("{} before contact", seen.early.count));
    }
    if !seen.median.is_nan() {
        lines.push(format!("median {} s", number(seen.median, 2)));
    }
    let step = 14.0;
    let fits = ((row.height() / step) as usize).max(1);
    lines.truncate(fits);
    for (k, line) in lines.iter().enumerate() {
        let at = pos2(row.right() + 8.0, y + step * (k as f32 - 0.5 * (lines.len() - 1) as f32));
        let ink = if k == 0 { theme.ink } else { theme.dim };
        painter.text(at, Align2::LEFT_CENTER, line, fonts::regular(11.0), ink);
    }
}

/// How many contacts are found within each bar.
fn bars(count: &Count, rate: f64) -> [u32; BARS] {
    let mut bars = [0; BARS];
    for &(delay, runs) in &count.found {
        let bar = f64::from(delay) / rate / LATE * BARS as f64;
        bars[(bar as usize).min(BARS - 1)] += runs;
    }
    bars
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
