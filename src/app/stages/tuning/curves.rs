//! Two curves over all thresholds, each with its band: contacts found, and delay, against false alarms.

use crate::app::charts::notation::{self, job, number};
use crate::app::charts::paint::{self, Picture, Place};
use crate::app::command::Command;
use crate::app::stages::tuner::LATE;
use crate::app::stages::tuning::words::{digits, percent};
use crate::app::stages::tuning::{Named, REACH, TEXT, View, taken};
use crate::app::state::Tuning;
use crate::app::theme::Theme;
use centrode_core::chart::{Chart, Panel, Role, Series, Style};
use centrode_core::study::tuning::Point;
use centrode_core::study::tuning::chart::{self, Curve, look};
use centrode_core::study::tuning::recommend::Verdict;
use centrode_core::study::tuning::watch::Rule;
use egui::{CursorIcon, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo};

/// Where a threshold lies; none where its values are not defined.
pub type At = fn(&Point) -> Option<[f64; 2]>;
/// What a picture is made of: the study's version, and what is looked at in it.
pub type Key = (u64, Tuning);

/// Contacts found against false alarms: the operating characteristic.
pub fn operating(ui: &mut Ui, rect: Rect, view: &View<'_>, kept: &mut Option<Picture<Key>>, out: &mut Vec<Command>) {
    let make = || chart::operating(&curves(view), view.tuning.wish);
    show(ui, rect, make, chart::found, (view, kept), out);
}

/// Median delay against false alarms.
pub fn delay(ui: &mut Ui, rect: Rect, view: &View<'_>, kept: &mut Option<Picture<Key>>, out: &mut Vec<Command>) {
    let make = || chart::delays(&curves(view), view.tuning.wish, LATE);
    show(ui, rect, make, chart::delay, (view, kept), out);
}

/// All rules; the chosen one lies on top of the others, which stand back.
fn curves<'a>(view: &'a View<'_>) -> Vec<Curve<'a>> {
    let chosen = view.tuning.rule;
    let others = Rule::ALL.iter().copied().filter(|rule| *rule != chosen);
    let curve = |rule: Rule| {
        let (role, style) = look(rule);
        let points = &view.derived.curves[rule as usize];
        Curve { name: chart::name(rule).into(), role, style, faint: rule != chosen, points }
    };
    others.chain([chosen]).map(curve).collect()
}

fn show(
    ui: &mut Ui,
    rect: Rect,
    make: impl Fn() -> Panel,
    at: At,
    (view, kept): (&View<'_>, &mut Option<Picture<Key>>),
    out: &mut Vec<Command>,
) {
    let chosen = view.tuning.rule;
    let key = (view.derived.version, view.tuning);
    let make = || {
        let mut panel = make();
        if let Verdict::Take { cell, level, .. } = &view.derived.verdict {
            chart::mark(&mut panel, Role::Choice, Style::Rings, at(&view.study.point(*cell, chosen, *level)));
        }
        Chart { panels: vec![panel], ..Chart::default() }
    };
    let picture = Picture::keep(kept, ui.ctx(), &view.theme, (key, false), make);
    let places = picture.show(ui.painter(), &view.theme, rect, paint::page(TEXT));
    let (Some(place), Some(panel)) = (places.first(), picture.chart().panels.first()) else { return };
    let own = view.own().and_then(at).map(|own| Series::new("", look(chosen).0, Style::Dots, vec![own]));
    picture.over(ui.painter(), &view.theme, (0, place), own.as_slice());
    touch(ui, place, &panel.title, at, view, out);
}

/// A click or a drag takes the nearest threshold; without a button the pointer reads it.
fn touch(ui: &mut Ui, place: &Place, title: &str, at: At, view: &View<'_>, out: &mut Vec<Command>) {
    let response = ui.interact(place.data(), ui.make_persistent_id(title), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::Crosshair);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Figure, true, title));
    let at = |point: &Point| at(point).map(|point| place.at(point));
    let nearest = |pointer: Pos2| {
        let levels = view.curve().iter().enumerate().filter_map(|(level, point)| Some((level, at(point)?)));
        let distance = |at: &Pos2| at.distance(pointer);
        levels.min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)))
    };
    let own = view.own().and_then(at);
    if let Some(pointer) = taken(ui, &response, |finger| own.is_some_and(|own| own.distance(finger) < REACH)) {
        if let Some((level, _)) = nearest(pointer) {
            view.take(level, None, out);
        }
        return;
    }
    let hover = response.hover_pos().filter(|_| !response.dragged());
    let Some((level, near)) = hover.and_then(nearest) else { return };
    let painter = ui.painter();
    painter.circle_stroke(near, 4.5, Stroke::new(1.5, view.theme.ink));
    notation::note(painter, &view.theme, near, place.data(), note(view, &view.curve()[level], &view.theme));
}

/// A threshold and what it comes to.
pub fn note(view: &View<'_>, point: &Point, theme: &Theme) -> Vec<egui::text::LayoutJob> {
    let named = Named::of(view.tuning.rule, view.study);
    let alarms = point.false_alarms.rate;
    let mut lines = vec![
        job(&format!("{} = {} {}", named.symbol, digits(&named, point.threshold), named.unit), 11.5, theme.ink),
        job(&format!("alarms {} of {}", alarms.count, alarms.of), 11.5, theme.dim),
    ];
    if let Some(seen) = point.detection {
        lines.push(job(&format!("found {} of {}", seen.detected.count, seen.detected.of), 11.5, theme.dim));
        if !seen.median.is_nan() {
            lines.push(job(&format!("after {} s", number(seen.median, 3)), 11.5, theme.dim));
        } else if seen.detected.of > 0 {
            lines.push(job(&format!("{} % in time", percent(seen.detected.rate)), 11.5, theme.dim));
        }
    }
    lines
}
