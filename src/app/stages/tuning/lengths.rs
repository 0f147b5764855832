//! Filter length by threshold: how late contact is found, where false alarms are rare enough.

use crate::app::charts::notation::{self, job};
use crate::app::charts::paint::{self, Picture, Place};
use crate::app::command::Command;
use crate::app::stages::tuner::{Cells, LATE};
use crate::app::stages::tuning::{Named, REACH, TEXT, View, curves, taken, words};
use crate::app::state::Tuning;
use centrode_core::chart::ticks::Tick;
use centrode_core::chart::{Axis, Chart, Map, Panel, Role, Series, Style};
use centrode_core::study::tuning::Study;
use centrode_core::study::tuning::chart::mark;
use centrode_core::study::tuning::recommend::Verdict;
use egui::{CursorIcon, Pos2, Rect, Sense, Ui, WidgetInfo};

/// What the picture is made of: the study's version, what is looked at in it, and how many thresholds it shows.
pub type Key = (u64, Tuning, usize);

/// So many rows are shown, at least and at most: the evenly spaced thresholds.
const ROWS: [usize; 2] = [20, 200];

/// Shows the map; a click or a drag takes threshold and filter length.
pub fn map(
    ui: &mut Ui,
    rect: Rect,
    view: &View<'_>,
    version: u64,
    kept: &mut Option<Picture<Key>>,
    out: &mut Vec<Command>,
) {
    let heading = "Median delay by filter length and threshold";
    let step = step(view);
    // Rows up to the threshold that is set, and some more: its dot moves over a map that stays.
    let own = view.setting().map_or(0, |threshold| (threshold / step).ceil() as usize);
    let least = (own + own / 8).next_multiple_of(ROWS[0]).clamp(ROWS[0], ROWS[1]);
    let at = |length: u64, threshold: f64| place(view.cells, length, threshold);
    let make = || {
        let mut panel = Panel { title: heading.into(), ..panel(view, delays(view, step, least)) };
        if let Verdict::Take { cell, point, .. } = &view.derived.verdict {
            let length = view.study.cells()[*cell].scenario.filter.length;
            mark(&mut panel, Role::Choice, Style::Rings, at(length, point.threshold));
        }
        Chart { panels: vec![panel], ..Chart::default() }
    };
    let picture = Picture::keep(kept, ui.ctx(), &view.theme, ((version, view.tuning, least), false), make);
    let places = picture.show(ui.painter(), &view.theme, rect, paint::page(TEXT));
    let map = picture.chart().panels.first().and_then(|panel| panel.map.as_ref());
    let (Some(place), Some(map)) = (places.first(), map) else { return };
    let own = view.setting().and_then(|threshold| set(view.study, view.cells, threshold));
    let dot = own.map(|own| Series::new("", Role::Detection, Style::Dots, vec![own]));
    picture.over(ui.painter(), &view.theme, (0, place), dot.as_slice());
    touch(ui, place, heading, view, (map.rows(), step), own, out);
}

/// Where a filter length and a threshold lie.
fn place(cells: &Cells, length: u64, threshold: f64) -> Option<[f64; 2]> {
    let column = cells.lengths.iter().position(|(other, _)| *other == length)?;
    Some([column as f64, threshold])
}

/// Where the filter length of a study's scenario lies with the threshold that is set.
pub fn set(study: &Study, cells: &Cells, threshold: f64) -> Option<[f64; 2]> {
    place(cells, study.cells().first()?.scenario.filter.length, threshold)
}

/// The axes of the map: a column for each filter length, a row for each threshold.
fn panel(view: &View<'_>, map: Map) -> Panel {
    let named = Named::of(view.tuning.rule, view.study);
    let tick = |(k, (length, _)): (usize, &(u64, usize))| Tick { value: k as f64, text: length.to_string() };
    let ticks = view.cells.lengths.iter().enumerate().map(tick).collect();
    let x = Axis { range: Some(map.x), ticks, ..Axis::new("Filter length N", "1", "1", 1.0) };
    let y = Axis { range: Some(map.y), ..Axis::new(named.symbol, "1", named.unit, named.scale) };
    let note = format!("faded: more than {} % may alarm", words::wished(view.tuning.wish));
    Panel { note, map: Some(map), ..Panel::new(x, y) }
}

/// A click or a drag takes the threshold and the filter length under it; without a button the pointer reads them.
fn touch(
    ui: &mut Ui,
    place: &Place,
    heading: &str,
    view: &View<'_>,
    (rows, step): (usize, f64),
    own: Option<[f64; 2]>,
    out: &mut Vec<Command>,
) {
    let (rule, lengths) = (view.tuning.rule, &view.cells.lengths);
    let response = ui.interact(place.data(), ui.make_persistent_id(heading), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::Crosshair);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Figure, true, heading));
    let under = |at: Pos2| {
        let [column, wanted] = place.value(at);
        let &(length, cell) = lengths.get((column.round().max(0.0) as usize).min(lengths.len().checked_sub(1)?))?;
        // Levels that are drawn: the evenly spaced ones.
        let row = ((wanted / step).round() as usize).clamp(1, rows.max(1));
        Some((length, cell, nearest(view.study.levels(cell, rule), row as f64 * step)))
    };
    let near = |finger: Pos2| own.is_some_and(|own| place.at(own).distance(finger) < REACH);
    if let Some(at) = taken(ui, &response, near) {
        if let Some((length, cell, level)) = under(at) {
            view.take_threshold(view.study.levels(cell, rule)[level], Some(length), out);
        }
    } else if let Some(at) = response.hover_pos().filter(|_| !response.dragged())
        && let Some((length, cell, level)) = under(at)
    {
        let mut lines = curves::note(view, &view.study.point(cell, rule, level), &view.theme);
        lines.insert(1, job(&format!("N = {length}"), 11.5, view.theme.ink));
        notation::note(ui.painter(), &view.theme, at, place.data(), lines);
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

/// The median delay, s, and whether false alarms are as rare as wished.
fn delay(view: &View<'_>, cell: usize, threshold: f64) -> Option<(f64, bool)> {
    let (study, rule) = (view.study, view.tuning.rule);
    let point = study.point(cell, rule, nearest(study.levels(cell, rule), threshold));
    let quiet = point.false_alarms.rate.high <= view.tuning.wish;
    let delay = point.detection.map(|seen| seen.median).filter(|delay| !delay.is_nan());
    delay.filter(|_| point.false_alarms.rate.of > 0).map(|delay| (delay, quiet))
}

/// The step between the thresholds drawn, SI: they are even, but for the coarse ones and the scenario's own.
fn step(view: &View<'_>) -> f64 {
    let levels = view.study.levels(0, view.tuning.rule);
    levels.windows(2).map(|pair| pair[1] - pair[0]).take(4).fold(0.0, f64::max)
}

/// The map, of at least so many thresholds.
fn delays(view: &View<'_>, step: f64, least: usize) -> Map {
    let cells = &view.cells.lengths;
    let known = |row: usize| cells.iter().map(move |(_, cell)| delay(view, *cell, row as f64 * step));
    let rows: Vec<Vec<Option<(f64, bool)>>> = (1..=ROWS[1]).map(|row| known(row).collect()).collect();
    let last = rows.iter().rposition(|row| row.iter().any(Option::is_some)).unwrap_or(0);
    let count = (last + last / 8).max(least).clamp(ROWS[0], ROWS[1]);
    let shown = || rows[..count].iter().flatten();
    Map {
        unit: "s",
        scale: 1.0,
        columns: cells.len(),
        values: shown().map(|known| known.map_or(f64::NAN, |(delay, _)| delay)).collect(),
        faint: shown().map(|known| known.is_some_and(|(_, quiet)| !quiet)).collect(),
        x: [-0.5, cells.len() as f64 - 0.5],
        // Rows are centred on their thresholds.
        y: [0.5 * step, (count as f64 + 0.5) * step],
        // The soonest is the lightest.
        ends: [LATE, 0.0],
        level: None,
        line: Vec::new(),
    }
}
