//! Tuning: what every threshold and filter length would cost, and which to take.
//!
//! Four pictures of one study. A drag on any of them moves the threshold, here and in the live run.

mod curves;
mod delays;
mod lengths;
mod words;

pub use words::{interval, percent, wished};

use crate::app::charts::notation::job;
use crate::app::charts::paint::Picture;
use crate::app::command::Command;
use crate::app::saving::Subject;
use crate::app::stages::Inputs;
use crate::app::stages::choices::{self, Part};
use crate::app::stages::tuner::{Cells, Tuner};
use crate::app::state::Tuning;
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::finger;
use crate::app::widgets::symbol;
use crate::app::widgets::text::rich;
use centrode_core::chart::{Chart, Role, Style};
use centrode_core::scenario::Xi1Rule;
use centrode_core::study::Job;
use centrode_core::study::tuning::chart;
use centrode_core::study::tuning::recommend::{Verdict, Wish, recommend_among};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Point, Study};
use egui::{Label, Pos2, Rect, Response, ScrollArea, Ui, pos2, vec2};

/// From this width on the pictures stand two by two.
const BESIDE: f32 = 700.0;
/// Least height of a picture.
const LEAST: f32 = 176.0;
const GAP: f32 = 12.0;
/// Size of the charts' text, points.
const TEXT: f32 = 11.0;
/// Height of the command below the pictures.
const FOOT: f32 = 20.0;
/// A finger holds what is this near, points.
const REACH: f32 = 32.0;

/// How the threshold of a method is shown: symbol, unit and size of that unit.
pub struct Named {
    symbol: &'static str,
    unit: &'static str,
    scale: f64,
    decimals: usize,
}

impl Named {
    fn of(rule: Rule, study: &Study) -> Self {
        Self::by(rule, study.spec().scenario.detection.xi1_rule)
    }

    fn by(method: Rule, xi1_rule: Xi1Rule) -> Self {
        match (method, xi1_rule) {
            (Rule::Jfd, Xi1Rule::Constant) => Self { symbol: "ξ_1", unit: "mN·m", scale: 1e3, decimals: 1 },
            (Rule::Jfd, Xi1Rule::Bound) => Self { symbol: "k", unit: "", scale: 1.0, decimals: 2 },
            _ => Self { symbol: "ξ_2", unit: "mm", scale: 1e3, decimals: 1 },
        }
    }
}

/// What follows from a study, computed once for each change.
struct Derived {
    version: u64,
    tuning: Tuning,
    /// By rule.
    curves: Vec<Vec<Point>>,
    own: Vec<Option<usize>>,
    settings: Vec<Option<f64>>,
    verdict: Verdict,
    /// The thresholds that the chosen rule holds beside its own, in words.
    beside: words::Beside,
}

/// What is kept between frames.
#[derive(Default)]
pub struct TuningState {
    derived: Option<Derived>,
    operating: Option<Picture<curves::Key>>,
    delay: Option<Picture<curves::Key>>,
    places: Option<Picture<delays::Key>>,
    lengths: Option<Picture<lengths::Key>>,
}

/// What the pictures are drawn from.
struct View<'a> {
    study: &'a Study,
    cells: &'a Cells,
    tuning: Tuning,
    derived: &'a Derived,
    theme: Theme,
}

impl View<'_> {
    fn curve(&self) -> &[Point] {
        &self.derived.curves[self.tuning.rule as usize]
    }

    fn own(&self) -> Option<&Point> {
        self.derived.own[self.tuning.rule as usize].map(|level| &self.curve()[level])
    }

    /// The threshold that is set; [`Self::own`] is what the nearest one that was counted comes to.
    fn setting(&self) -> Option<f64> {
        self.derived.settings[self.tuning.rule as usize]
    }

    /// Takes a threshold of the chosen rule. Joint forces are not filtered: with theirs, the length stays.
    fn take_threshold(&self, threshold: f64, length: Option<u64>, out: &mut Vec<Command>) {
        let rule = self.tuning.rule;
        out.push(Command::Take { rule, threshold, length: length.filter(|_| rule != Rule::Jfd) });
    }

    /// Takes a level of the chosen rule.
    fn take(&self, level: usize, length: Option<u64>, out: &mut Vec<Command>) {
        let Some(point) = self.curve().get(level) else { return };
        self.take_threshold(point.threshold, length, out);
    }
}

/// Shows the study.
pub fn tuning(ui: &mut Ui, rect: Rect, inputs: &Inputs<'_>, state: &mut TuningState, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let Some((study, cells, version)) = inputs.tuner.shown(inputs.tuning.rule) else { return };
    let TuningState { derived, operating, delay, places, lengths } = state;
    if derived.as_ref().is_none_or(|known| known.version != version || known.tuning != inputs.tuning) {
        *derived = Some(derive(study, cells, version, inputs));
    }
    let Some(derived) = derived else { return };
    // The thresholds that are set move over the pictures, which stay.
    let settings: Vec<Option<f64>> = Rule::ALL.iter().map(|&rule| inputs.tuner.setting(rule)).collect();
    if derived.settings != settings {
        derived.own = Rule::ALL.iter().map(|&rule| inputs.tuner.level(rule)).collect();
        derived.settings = settings;
    }
    let view = View { study, cells, tuning: inputs.tuning, derived, theme };

    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(rect).id_salt("tuning"));
    inner.spacing_mut().item_spacing.y = 4.0;
    let beside = rect.width() > BESIDE;
    let mut all = |ui: &mut Ui| {
        let top = ui.cursor().top();
        choices(ui, &view, inputs, beside, out);
        sentences(ui, &view, inputs, out);
        trouble(ui, inputs, &theme);
        ui.add_space(2.0);
        let used = ui.cursor().top() - top;
        let (columns, rows) = if beside { (2, 2) } else { (1, 4) };
        let width = (ui.available_width() - GAP * (columns - 1) as f32) / columns as f32;
        let room = (rect.height() - used - FOOT - GAP * (rows - 1) as f32) / rows as f32;
        let height = room.max(LEAST);
        let (_, area) = ui.allocate_space(vec2(ui.available_width(), height * rows as f32 + GAP * (rows - 1) as f32));
        let place = |k: usize| {
            let (column, row) = (k % columns, k / columns);
            let step = vec2((width + GAP) * column as f32, (height + GAP) * row as f32);
            Rect::from_min_size(area.min + step, vec2(width, height))
        };
        curves::operating(ui, place(0), &view, operating, out);
        curves::delay(ui, place(1), &view, delay, out);
        delays::histogram(ui, place(2), &view, version, places, out);
        lengths::map(ui, place(3), &view, version, lengths, out);
        ui.add(Label::new(job(&command(inputs), 11.5, theme.dim)).wrap().selectable(true));
    };
    ScrollArea::vertical().auto_shrink(false).show(&mut inner, |ui| all(ui));
}

/// All four pictures as they were last shown, with what is set and what they were made with.
pub fn chart(state: &TuningState, tuner: &Tuner) -> Option<Chart> {
    let derived = state.derived.as_ref()?;
    let rule = derived.tuning.rule;
    let (study, cells, _) = tuner.shown(rule)?;
    let panel = |chart: Option<&Chart>| chart.and_then(|chart| chart.panels.first()).cloned();
    let own = tuner.own(rule);
    let mut panels = Vec::new();
    for (picture, at) in [(&state.operating, chart::found as curves::At), (&state.delay, chart::delay)] {
        let mut panel = panel(picture.as_ref().map(Picture::chart))?;
        chart::mark(&mut panel, chart::look(rule).0, Style::Dots, own.as_ref().and_then(at));
        panels.push(panel);
    }
    panels.extend(panel(state.places.as_ref().map(Picture::chart)));
    if let Some(mut panel) = panel(state.lengths.as_ref().map(Picture::chart)) {
        let at = tuner.setting(rule).and_then(|threshold| lengths::set(study, cells, threshold));
        chart::mark(&mut panel, Role::Detection, Style::Dots, at);
        panels.push(panel);
    }
    let wish = Wish { rule, false_alarm_rate: derived.tuning.wish };
    let advised = matches!(derived.verdict, Verdict::Take { .. });
    let caption = chart::caption(study, &wish, advised, !study.progress().is_complete());
    Some(Chart { title: "Thresholds and filter lengths".into(), panels, caption })
}

/// The command that makes this study, with all its numbers.
fn command(inputs: &Inputs<'_>) -> String {
    let (name, base) = inputs.base;
    let lengths = inputs.tuner.shown(inputs.tuning.rule).map_or(&[][..], |(_, cells, _)| &cells.lengths);
    let lengths: Vec<String> = lengths.iter().map(|(length, _)| length.to_string()).collect();
    let (scenario, hint) = if base == inputs.plan.scenario() {
        (format!("--preset {name}"), "")
    } else {
        ("my.toml".into(), "   (my.toml: this scenario)")
    };
    format!(
        "centrode study {scenario} --repeats {} --sweep filter.length={} --csv study.csv{hint}",
        inputs.tuning.repeats,
        lengths.join(",")
    )
}

fn derive(study: &Study, cells: &Cells, version: u64, inputs: &Inputs<'_>) -> Derived {
    let (tuner, tuning) = (inputs.tuner, inputs.tuning);
    let wish = Wish { rule: tuning.rule, false_alarm_rate: tuning.wish };
    // Joint forces are not filtered: one length says it all.
    let lengths =
        if tuning.rule == Rule::Jfd { vec![0] } else { cells.lengths.iter().map(|(_, cell)| *cell).collect() };
    Derived {
        version,
        tuning,
        curves: Rule::ALL.iter().map(|&rule| tuner.curve(rule)).collect(),
        own: Rule::ALL.iter().map(|&rule| tuner.level(rule)).collect(),
        settings: Rule::ALL.iter().map(|&rule| tuner.setting(rule)).collect(),
        verdict: recommend_among(study, lengths, &wish),
        beside: words::beside(tuner, tuning.rule),
    }
}

/// Rule, wish, repeats, and the button that stops.
fn choices(ui: &mut Ui, view: &View<'_>, inputs: &Inputs<'_>, beside: bool, out: &mut Vec<Command>) {
    let tuning = view.tuning;
    let names = Rule::ALL.iter().map(|&rule| chart::name(rule)).collect();
    let parts = [Part::one("Alarm by", names, tuning.rule as usize, 280.0), Part::wish(tuning), Part::repeats(tuning)];
    let study = inputs.tuner.left().map(|left| (format!("{} of {} runs", left.done, left.of), inputs.tuner.is_held()));
    if let Some((part, picked)) = choices::row(ui, (beside, Subject::Tuning), &parts, study, out) {
        out.push(Command::Tune(match part {
            0 => Tuning { rule: Rule::ALL[picked], ..tuning },
            1 => Tuning { wish: choices::WISHES[picked].0, ..tuning },
            _ => Tuning { repeats: choices::REPEATS[picked].0, ..tuning },
        }));
    }
}

/// What is set now, and what should be.
fn sentences(ui: &mut Ui, view: &View<'_>, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let now = words::now(view);
    symbol::label(ui, rich(&now, 13.0, view.theme.ink), false);
    let (advice, take) = words::advice(view);
    let done = inputs.tuner.left().is_none();
    let advice = if done { advice } else { format!("So far: {advice}") };
    let advice = if take.is_some() { advice + &view.derived.beside.counted } else { advice };
    ui.horizontal_top(|ui| {
        let mut text = rich(&advice, 13.0, if take.is_some() { view.theme.ink } else { view.theme.dim });
        let room = if take.is_some() { 70.0 } else { 0.0 };
        text.wrap.max_width = (ui.available_width() - room).max(80.0);
        let height = ui.painter().layout_job(text.clone()).size().y.max(finger::at_least(ui, 24.0));
        let wide = ui.painter().layout_job(text.clone()).size().x;
        let (_, place) = ui.allocate_space(vec2(wide, height));
        let mut said = ui.new_child(egui::UiBuilder::new().max_rect(place).id_salt("advice"));
        symbol::label(&mut said, text, false);
        if let Some((level, length)) = take {
            let at = Rect::from_min_size(
                pos2(place.right() + 8.0, place.top() - 3.0),
                vec2(60.0, finger::at_least(ui, 24.0)),
            );
            if button(ui, at, "Take it", &view.theme) {
                view.take(level, Some(length), out);
            }
        }
    });
}

/// Says what is not as one would expect: that a log is not what is studied, or that the page makes the runs because its helper
/// could not.
pub fn trouble(ui: &mut Ui, inputs: &Inputs<'_>, theme: &Theme) {
    if inputs.log {
        let said = "This studies simulations of what is set, not the log that is shown: delays need to know when contact began, \
                    and a log does not say. To see what a threshold makes of the log, drag its line in the plots.";
        ui.add(Label::new(job(said, 12.5, theme.ink)).wrap());
    }
    if let Some(why) = inputs.tuner.trouble().or(inputs.comparer.trouble()) {
        let said = format!("The worker failed ({why}). The page makes the runs itself, between its frames.");
        ui.add(Label::new(job(&said, 12.0, theme.error)).wrap());
    }
}

/// Where a click or a drag takes something. A finger drags what it holds, `near` where that is, and scrolls the page from
/// anywhere else.
fn taken(ui: &Ui, response: &Response, near: impl Fn(Pos2) -> bool) -> Option<Pos2> {
    let at = response.interact_pointer_pos()?;
    if response.drag_started() {
        let (finger, from) = ui.input(|input| (input.any_touches(), input.pointer.press_origin()));
        ui.data_mut(|data| data.insert_temp(response.id, finger && !near(from.unwrap_or(at))));
    }
    if response.dragged() && ui.data(|data| data.get_temp(response.id).unwrap_or(false)) {
        ui.scroll_with_delta(vec2(0.0, response.drag_delta().y));
        return None;
    }
    (response.clicked() || response.dragged()).then_some(at)
}
