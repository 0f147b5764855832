//! Filter length by threshold: how late contact is found, where false alarms are rare enough.

use crate::app::charts::notation::{self, job, number};
use crate::app::charts::plots::{Axis, Steps};
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::stages::tuner::LATE;
use crate::app::stages::tuning::{Named, REACH, View, taken, title};
use crate::scene::colormap::colormap;
use centrode_core::study::tuning::recommend::Verdict;
use egui::{
    Align2, Color32, ColorImage, CursorIcon, Rect, Role, Sense, Stroke, StrokeKind, TextureHandle, TextureOptions, Ui,
    WidgetInfo, pos2, vec2,
};

/// The map as an image, kept while it stays the same.
pub struct Picture {
    key: (u64, u64, usize),
    texture: TextureHandle,
    /// The thresholds drawn, as shown: evenly spaced rows from `step` up.
    rows: usize,
    step: f64,
}

/// Width of the colour bar with its labels.
const BAR: f32 = 44.0;
/// So many rows are shown, at least and at most: the evenly spaced thresholds.
const ROWS: [usize; 2] = [20, 200];
/// How much of its colour a place keeps where there are too many false alarms.
const FADED: f32 = 0.28;

/// Shows the map; a click or a drag takes threshold and filter length.
pub fn map(ui: &mut Ui, rect: Rect, view: &View<'_>, version: u64, kept: &mut Option<Picture>, out: &mut Vec<Command>) {
    let (theme, method) = (&view.theme, view.tuning.method);
    let named = Named::of(method, view.study);
    let heading = "Median delay by filter length and threshold";
    title(ui, rect, heading, theme);
    let key = (version, view.tuning.wish.to_bits(), method as usize);
    if kept.as_ref().is_none_or(|picture| picture.key != key) {
        *kept = Some(paint(ui, view, key, &named));
    }
    let (Some(picture), lengths) = (kept, &view.cells.lengths) else { return };
    let data = Rect::from_min_max(rect.min + vec2(50.0, 38.0), rect.max - vec2(BAR + 10.0, 38.0));
    let data = Rect::from_min_size(data.min, data.size().max(vec2(60.0, 40.0)));
    let painter = ui.painter().clone();
    painter.rect_filled(data, 0.0, theme.raised);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.image(picture.texture.id(), data, whole, Color32::WHITE);
    painter.rect_stroke(data, 0.0, Stroke::new(1.0, theme.dim), StrokeKind::Middle);
    // Rows are centred on their thresholds.
    let y = Axis::new([0.5 * picture.step, (picture.rows as f64 + 0.5) * picture.step], [data.bottom(), data.top()]);
    let column = data.width() / lengths.len() as f32;
    let x = |k: usize| data.left() + column * (k as f32 + 0.5);
    for tick in y.ticks(20.0, Steps::Decimal) {
        let at = pos2(data.left() - 6.0, y.at(tick.value));
        painter.text(at, Align2::RIGHT_CENTER, tick.text, fonts::regular(11.0), theme.dim);
    }
    for (k, (length, _)) in lengths.iter().enumerate() {
        // Every other one where they would touch.
        if column > 27.0 || k % 2 == 1 {
            let at = pos2(x(k), data.bottom() + 4.0);
            painter.text(at, Align2::CENTER_TOP, length.to_string(), fonts::regular(11.0), theme.dim);
        }
    }
    let name = painter.layout_job(job("Filter length N", 12.0, theme.ink));
    painter.galley(pos2(data.center().x - 0.5 * name.size().x, data.bottom() + 18.0), name, theme.ink);
    let unit = if named.unit.is_empty() { named.symbol.into() } else { format!("{} ({})", named.symbol, named.unit) };
    let name = painter.layout_job(job(&unit, 12.0, theme.ink));
    painter.galley(pos2(rect.left() + 4.0, data.top() - 17.0), name, theme.ink);
    let hint = format!("faded: more than {} % may alarm", crate::app::stages::tuning::words::wished(view.tuning.wish));
    if rect.width() > 300.0 {
        let at = pos2(data.right(), data.top() - 4.0);
        painter.text(at, Align2::RIGHT_BOTTOM, hint, fonts::regular(11.0), theme.dim);
    }
    bar(ui, data, view);

    let clip = painter.with_clip_rect(data.expand(8.0).intersect(painter.clip_rect()));
    let place = |length: u64, threshold: f64| {
        let k = lengths.iter().position(|(other, _)| *other == length)?;
        Some(pos2(x(k), y.at(threshold * named.scale)))
    };
    if let Verdict::Take { cell, point, .. } = &view.derived.verdict
        && let Some(at) = place(view.study.cells()[*cell].scenario.filter.length, point.threshold)
    {
        clip.circle_stroke(at, 7.5, Stroke::new(4.0, Color32::from_black_alpha(140)));
        clip.circle_stroke(at, 7.5, Stroke::new(2.2, Color32::WHITE));
    }
    let own = view.setting().and_then(|xi| place(view.study.cells()[0].scenario.filter.length, xi));
    if let Some(at) = own {
        clip.circle(at, 5.0, theme.detection, Stroke::new(1.5, Color32::WHITE));
    }

    let response = ui.interact(data, ui.make_persistent_id(heading), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::Crosshair);
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, heading));
    let under = |at: egui::Pos2| {
        let k = (((at.x - data.left()) / column) as usize).min(lengths.len() - 1);
        let wanted = y.value(at.y) / named.scale;
        // Levels that are drawn: the evenly spaced ones.
        let row = ((wanted * named.scale / picture.step).round() as usize).clamp(1, picture.rows);
        let threshold = row as f64 * picture.step / named.scale;
        (k, nearest(view.study.levels(lengths[k].1, method), threshold))
    };
    let near = |finger: egui::Pos2| own.is_some_and(|own| own.distance(finger) < REACH);
    if let Some(at) = taken(ui, &response, near) {
        let (k, level) = under(at);
        let threshold = view.study.levels(lengths[k].1, method)[level];
        view.take_threshold(threshold, Some(lengths[k].0), out);
    } else if let Some(at) = response.hover_pos().filter(|_| !response.dragged()) {
        let (k, level) = under(at);
        let mut lines =
            crate::app::stages::tuning::curves::note(view, &view.study.point(lengths[k].1, method, level), theme);
        lines.insert(1, job(&format!("N = {}", lengths[k].0), 11.5, theme.ink));
        notation::note(&painter, theme, at, data, lines);
    }
}

/// The place of the level nearest to a threshold.
fn nearest(levels: &[f64], threshold: f64) -> usize {
    let above = levels.partition_point(|&level| level < threshold);
    let far = |level: usize| (levels[level] - threshold).abs();
    [above.saturating_sub(1), above.min(levels.len().saturating_sub(1))]
        .into_iter()
        .min_by(|&a, &b| far(a).total_cmp(&far(b)))
        .unwrap_or(0)
}

/// Delay as a share of the largest in time, and whether false alarms are as rare as wished.
fn delay(view: &View<'_>, cell: usize, threshold: f64) -> Option<(f64, bool)> {
    let (study, method) = (view.study, view.tuning.method);
    let point = study.point(cell, method, nearest(study.levels(cell, method), threshold));
    let quiet = point.false_alarms.rate.high <= view.tuning.wish;
    let delay = point.detection.map(|seen| seen.median / LATE).filter(|delay| !delay.is_nan());
    delay.filter(|_| point.false_alarms.rate.of > 0).map(|delay| (delay, quiet))
}

fn paint(ui: &Ui, view: &View<'_>, key: (u64, u64, usize), named: &Named) -> Picture {
    let cells = &view.cells.lengths;
    // The steps are even, but for the coarse ones and the scenario's own.
    let levels = view.study.levels(0, view.tuning.method);
    let step = levels.windows(2).map(|pair| pair[1] - pair[0]).take(4).fold(0.0, f64::max);
    let known = |row: usize| cells.iter().map(move |(_, cell)| delay(view, *cell, row as f64 * step));
    let rows: Vec<Vec<Option<(f64, bool)>>> = (1..=ROWS[1]).map(|row| known(row).collect()).collect();
    let last = rows.iter().rposition(|row| row.iter().any(Option::is_some)).unwrap_or(0);
    let own = view.setting().map_or(0, |threshold| (threshold / step).ceil() as usize);
    let count = (last + last / 8).max(own + own / 8).clamp(ROWS[0], ROWS[1]);
    let ground = Color32::TRANSPARENT;
    let pixels = rows[..count].iter().rev().flatten().map(|known| {
        known.map_or(ground, |(share, quiet)| {
            let [r, g, b, _] = colormap(1.0 - share).to_bytes();
            let color = Color32::from_rgb(r, g, b);
            if quiet { color } else { view.theme.raised.lerp_to_gamma(color, FADED) }
        })
    });
    let image = ColorImage::new([cells.len(), count], pixels.collect());
    let texture = ui.ctx().load_texture("filter lengths", image, TextureOptions::NEAREST);
    Picture { key, texture, rows: count, step: step * named.scale }
}

/// What the colours mean.
fn bar(ui: &Ui, data: Rect, view: &View<'_>) {
    let painter = ui.painter();
    let bar = Rect::from_min_max(pos2(data.right() + 10.0, data.top()), pos2(data.right() + 19.0, data.bottom()));
    let steps = 48;
    for k in 0..steps {
        let [from, to] = [k, k + 1].map(|k| bar.bottom() - bar.height() * k as f32 / steps as f32);
        let [r, g, b, _] = colormap(1.0 - f64::from(k) / f64::from(steps - 1)).to_bytes();
        painter.rect_filled(Rect::from_x_y_ranges(bar.x_range(), to..=from + 0.5), 0.0, Color32::from_rgb(r, g, b));
    }
    for share in [0.0, 0.5, 1.0] {
        let at = pos2(bar.right() + 4.0, bar.bottom() - bar.height() * share as f32);
        let text = format!("{} s", number(share * LATE, 1));
        painter.text(at, Align2::LEFT_CENTER, text, fonts::regular(10.5), view.theme.dim);
    }
}
