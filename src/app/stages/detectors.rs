//! Detectors held against each other: delay against false alarms with what no test can beat, which threshold to take, and how true places
//! are with what no estimate can beat.

mod advice;
mod words;

use crate::app::charts::notation::{self, job};
use crate::app::charts::paint::{self, Picture, Place};
use crate::app::command::Command;
use crate::app::saving::Subject;
use crate::app::stages::Inputs;
use crate::app::stages::choices::{self, Part};
use crate::app::stages::tuning;
use crate::app::state::Tuning;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::finger;
use crate::app::widgets::symbol;
use crate::app::widgets::text::rich;
use crate::app::words::refusal;
use centrode_core::chart::{Chart, Panel};
use centrode_core::detect::Method;
use centrode_core::scenario::{Detectors, Xi1Rule};
use centrode_core::study::compare::{CompareError, Compared, Comparison, chart};
use centrode_core::study::tuning::Point;
use egui::{CursorIcon, Label, Pos2, Rect, ScrollArea, Sense, Stroke, Ui, WidgetInfo, vec2};

/// From this width on those of places stand beside that of delays.
const BESIDE: f32 = 700.0;
/// Least height of each of the two, points, and most height of that of delays.
const LEAST: f32 = 176.0;
const MOST: f32 = 620.0;
/// Height of a picture where they stand below each other.
const PHONE: f32 = 270.0;
/// What stays free below them, so that the heading of what follows is in sight whole.
const BELOW: f32 = 38.0;
const GAP: f32 = 12.0;
/// Size of the charts' text, points.
const TEXT: f32 = 11.0;
/// The pointer reads a threshold this near, points.
const REACH: f32 = 24.0;

/// What is kept between frames.
#[derive(Default)]
pub struct DetectorsState {
    delays: Option<Picture<u64>>,
    errors: Option<Picture<u64>>,
    coverage: Option<Picture<u64>>,
}

/// What the pictures are drawn from.
struct View<'a> {
    comparison: &'a Comparison,
    version: u64,
    rule: Xi1Rule,
    /// Whether a click takes a threshold: those of the settings before are only looked at.
    takes: bool,
}

/// Why there is nothing to compare, in the page's terms.
pub fn refused(refused: &CompareError) -> String {
    match refused {
        CompareError::Scenario(refused) => refusal::told(refused),
        CompareError::NoContact => "set a contact that the motion reaches".into(),
        CompareError::NoDetector => "choose a detector to compare".into(),
        other => other.to_string(),
    }
}

/// Shows the comparison.
pub fn detectors(ui: &mut Ui, rect: Rect, inputs: &Inputs<'_>, state: &mut DetectorsState, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let beside = rect.width() > BESIDE;
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(rect).id_salt("detectors"));
    inner.spacing_mut().item_spacing.y = 4.0;
    ScrollArea::vertical().auto_shrink(false).show(&mut inner, |ui| {
        let top = ui.cursor().top();
        choose(ui, inputs, beside, out);
        let refused = inputs.comparer.refused().map(self::refused);
        if let Some(refused) = refused {
            let said = format!("{} cannot be shown: {refused}.", inputs.stage.name());
            ui.add(Label::new(job(&said, 13.5, theme.error)).wrap());
            return;
        }
        let Some((_, comparison, version)) = inputs.comparer.shown() else { return };
        summary(ui, comparison, inputs, out);
        tuning::trouble(ui, inputs, &theme);
        if comparison.repeats == 0 {
            return;
        }
        ui.add_space(2.0);
        let used = ui.cursor().top() - top;
        let line = words::command(inputs);
        let room = rect.height() - used;
        let takes = !inputs.comparer.is_former();
        pictures(ui, beside, room, &View { comparison, version, rule: words::rule(inputs), takes }, state, out);
        advice::advice(ui, comparison, inputs, out);
        ui.add_space(8.0);
        if !beside {
            others(ui, (comparison, version), state);
        }
        ui.add(Label::new(wrapped(&line, rect.width(), &theme)).wrap().selectable(true));
    });
}

/// The picture of delays, and beside it, where there is room, those of places; `room` is the height that is in sight.
fn pictures(ui: &mut Ui, beside: bool, room: f32, view: &View<'_>, state: &mut DetectorsState, out: &mut Vec<Command>) {
    let least = if beside { 2.0 * LEAST + GAP } else { PHONE };
    let (_, area) = ui.allocate_space(vec2(ui.available_width(), (room - BELOW).clamp(least, MOST.max(least))));
    if !beside {
        return delays(ui, area, view, &mut state.delays, out);
    }
    let [left, right] = [0.0, 0.5].map(|from| {
        let width = 0.5 * (area.width() - GAP);
        Rect::from_min_size(area.min + vec2(from * (area.width() + GAP), 0.0), vec2(width, area.height()))
    });
    delays(ui, left, view, &mut state.delays, out);
    let half = 0.5 * (right.height() - GAP);
    let [above, below] = [right.with_max_y(right.top() + half), right.with_min_y(right.bottom() - half)];
    picture(ui, above, (view.version, chart::errors), view.comparison, &mut state.errors);
    picture(ui, below, (view.version, chart::coverage), view.comparison, &mut state.coverage);
}

/// The pictures of places, below each other.
fn others(ui: &mut Ui, (comparison, version): (&Comparison, u64), state: &mut DetectorsState) {
    let space = |ui: &mut Ui| ui.allocate_space(vec2(ui.available_width(), PHONE)).1;
    let place = space(ui);
    picture(ui, place, (version, chart::errors), comparison, &mut state.errors);
    let place = space(ui);
    picture(ui, place, (version, chart::coverage), comparison, &mut state.coverage);
}

fn wrapped(line: &str, width: f32, theme: &Theme) -> egui::text::LayoutJob {
    let mut line = job(line, 11.5, theme.dim);
    line.wrap.max_width = width;
    line
}

/// Which detectors are compared, at which rate, in how many runs.
fn choose(ui: &mut Ui, inputs: &Inputs<'_>, beside: bool, out: &mut Vec<Command>) {
    let tuning = inputs.tuning;
    let chosen = Method::ALL.iter().map(|&method| tuning.compare.has(method)).collect();
    let names = Method::ALL.iter().map(|&method| words::short(method)).collect();
    let compare = Part::several("Compare", names, chosen, (456.0, 3));
    let parts = [compare, Part::wish(tuning), Part::repeats(tuning)];
    let comparer = inputs.comparer;
    let study = comparer.left_repeats().map(|[made, of]| (format!("{made} of {of} repeats"), comparer.is_held()));
    if let Some((part, picked)) = choices::row(ui, (beside, Subject::Detectors), &parts, study, out) {
        out.push(Command::Tune(match part {
            0 => {
                let mut compare: Detectors = tuning.compare;
                compare.set(Method::ALL[picked], !compare.has(Method::ALL[picked]));
                Tuning { compare, ..tuning }
            }
            1 => Tuning { wish: choices::WISHES[picked].0, ..tuning },
            _ => Tuning { repeats: choices::REPEATS[picked].0, ..tuning },
        }));
    }
}

/// Which detector is soonest, and what no test can beat.
fn summary(ui: &mut Ui, comparison: &Comparison, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let said = words::summary(comparison, inputs);
    let advice = comparison.advice().filter(|_| !inputs.comparer.is_former());
    ui.horizontal_top(|ui| {
        let mut text = rich(&said, 13.0, theme.ink);
        let room = if advice.is_some() { 70.0 } else { 0.0 };
        text.wrap.max_width = (ui.available_width() - room).max(80.0);
        let size = ui.painter().layout_job(text.clone()).size();
        let (_, place) = ui.allocate_space(vec2(size.x, size.y.max(finger::at_least(ui, 24.0))));
        let mut said = ui.new_child(egui::UiBuilder::new().max_rect(place).id_salt("summary"));
        symbol::label(&mut said, text, false);
        if let Some((method, point)) = advice {
            let at = Rect::from_min_size(place.right_top() + vec2(8.0, -3.0), vec2(60.0, finger::at_least(ui, 24.0)));
            if button(ui, at, "Take it", &theme) {
                out.push(Command::TakeDetector { method, threshold: point.threshold });
            }
        }
    });
}

fn picture(
    ui: &mut Ui,
    rect: Rect,
    (version, make): (u64, fn(&Comparison) -> Panel),
    comparison: &Comparison,
    kept: &mut Option<Picture<u64>>,
) -> Option<Place> {
    let theme = Theme::of(ui);
    let make = || Chart { panels: vec![make(comparison)], ..Chart::default() };
    let picture = Picture::keep(kept, ui.ctx(), &theme, (version, false), make);
    let places = picture.show(ui.painter(), &theme, rect, paint::page(TEXT));
    let (place, panel) = (*places.first()?, picture.chart().panels.first()?);
    let response = ui.interact(place.data(), ui.make_persistent_id(&panel.title), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Figure, true, words::described(panel, comparison)));
    if let Some(pointer) = response.hover_pos() {
        words::read(ui.painter(), &place, (panel, pointer), &theme);
    }
    Some(place)
}

/// The curves of all detectors; the pointer reads the nearest threshold, a click takes it.
fn delays(ui: &mut Ui, rect: Rect, view: &View<'_>, kept: &mut Option<Picture<u64>>, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let Some(place) = picture(ui, rect, (view.version, chart::delays), view.comparison, kept) else { return };
    let response = ui.interact(place.data(), ui.make_persistent_id("thresholds"), Sense::click());
    let response = response.on_hover_cursor(CursorIcon::Crosshair);
    let Some(pointer) = response.hover_pos().or(response.interact_pointer_pos()) else { return };
    let Some((compared, point, at)) = nearest(view.comparison, &place, pointer) else { return };
    if response.clicked() && view.takes {
        out.push(Command::TakeDetector { method: compared.method(), threshold: point.threshold });
    }
    ui.painter().circle_stroke(at, 4.5, Stroke::new(1.5, theme.ink));
    notation::note(ui.painter(), &theme, at, place.data(), words::note(compared, point, view.rule, &theme));
}

fn nearest<'a>(comparison: &'a Comparison, place: &Place, pointer: Pos2) -> Option<(&'a Compared, &'a Point, Pos2)> {
    let points =
        comparison.detectors.iter().flat_map(|compared| compared.curve.iter().map(move |point| (compared, point)));
    let at = |(compared, point): (&'a Compared, &'a Point)| Some((compared, point, place.at(chart::at(point)?)));
    let near = points.filter_map(at).filter(|(.., at)| at.distance(pointer) < REACH);
    near.min_by(|a, b| a.2.distance(pointer).total_cmp(&b.2.distance(pointer)))
}
