//! Two curves over all thresholds, each with its band: contacts found, and delay, against false alarms.

use crate::app::charts::notation::{self, job, number};
use crate::app::charts::paint::{self, Place};
use crate::app::command::Command;
use crate::app::stages::tuner::LATE;
use crate::app::stages::tuning::words::{digits, percent};
use crate::app::stages::tuning::{Named, REACH, TEXT, View, taken};
use crate::app::theme::Theme;
use centrode_core::chart::{Chart, Panel, Role, Style};
use centrode_core::study::tuning::Point;
use centrode_core::study::tuning::chart::{self, Curve, look};
use centrode_core::study::tuning::recommend::Verdict;
use centrode_core::study::tuning::watch::Rule;
use egui::{CursorIcon, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo};

/// Where a threshold lies; none where its values are not defined.
type At = fn(&Point) -> Option<[f64; 2]>;

/// Contacts found against false alarms: the operating characteristic.
pub fn operating(ui: &mut Ui, rect: Rect, view: &View<'_>, out: &mut Vec<Command>) {
    show(ui, rect, chart::operating(&curves(view), view.tuning.wish), chart::found, view, out);
}

/// Median delay against false alarms.
pub fn delay(ui: &mut Ui, rect: Rect, view: &View<'_>, out: &mut Vec<Command>) {
    show(ui, rect, chart::delays(&curves(view), view.tuning.wish, LATE), chart::delay, view, out);
}

/// All rules; the chosen one lies on top of the others, which stand back.
fn curves<'a>(view: &'a View<'_>) -> Vec<Curve<'a>> {
    let chosen = view.tuning.rule;
    let others = Rule::ALL.iter().copied().filter(|rule| *rule != chosen);
    let curve = |rule: Rule| {
        let (role, dashed) = look(rule);
        let points = &view.derived.curves[rule as usize];
        Curve { name: chart::name(rule).into(), role, dashed, faint: rule != chosen, points }
    };
    others.chain([chosen]).map(curve).collect()
}

fn show(ui: &mut Ui, rect: Rect, mut panel: Panel, at: At, view: &View<'_>, out: &mut Vec<Command>) {
    let chosen = view.tuning.rule;
    if let Verdict::Take { cell, level, .. } = &view.derived.verdict {
        chart::mark(&mut panel, Role::Choice, Style::Rings, at(&view.study.point(*cell, chosen, *level)));
    }
    chart::mark(&mut panel, look(chosen).0, Style::Dots, view.own().and_then(at));
    let title = panel.title.clone();
    let chart = Chart { panels: vec![panel], ..Chart::default() };
    let places = paint::chart(ui.painter(), &view.theme, rect, &chart, TEXT, &[]);
    if let Some(place) = places.first() {
        touch(ui, place, &title, at, view, out);
    }
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
