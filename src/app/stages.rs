//! What can stand on the stage in the robot's place: a figure, Table II, the map, the tuning.

mod choices;
pub mod comparer;
mod detectors;
mod figure;
mod map;
pub mod source;
pub mod stage;
pub mod studies;
mod table;
pub mod tuner;
mod tuning;
pub mod viewport;

use crate::app::charts::notation;
use crate::app::charts::paint::Picture;
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::panels::save;
use crate::app::saving::Subject;
use crate::app::stages::comparer::Comparer;
use crate::app::stages::source::Source;
use crate::app::stages::stage::{Section, Stage};
use crate::app::stages::studies::{Found, Studies};
use crate::app::stages::tuner::Tuner;
use crate::app::state::Tuning;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::segmented::{Segment, segments};
use crate::app::widgets::text;
use crate::app::words::refusal;
use centrode_core::chart::Chart;
use centrode_core::scenario::{Plan, Scenario};
use detectors::DetectorsState;
use egui::{Align2, Rect, Role, Ui, pos2, vec2};
use tuning::TuningState;

/// Space around the content.
const PAD: f32 = 14.0;
/// Below this height, and from this width on, what is above the content stands in one row.
const LOW: f32 = 340.0;
const WIDE: f32 = 700.0;

/// The widest that the switch between both studies of the tuning gets.
const SWITCH: f32 = 280.0;

/// Pictures that are kept between frames.
#[derive(Default)]
pub struct StageState {
    figure: Option<Picture<u64>>,
    estimates: Option<Picture<u64>>,
    map: Option<Picture<map::Key>>,
    tuning: TuningState,
    detectors: DetectorsState,
}

impl StageState {
    /// The pictures of the tuning view in one chart, as they were last shown.
    #[must_use]
    pub fn tuning(&self, tuner: &Tuner) -> Option<Chart> {
        tuning::chart(&self.tuning, tuner)
    }
}

/// What the stage is drawn from.
pub struct Inputs<'a> {
    /// What stands on it.
    pub stage: Stage,
    /// What is set on the page.
    pub plan: &'a Plan,
    /// Whether a log is shown in place of its simulation.
    pub log: bool,
    /// The preset that resets go back to: its name and scenario.
    pub base: (&'a str, &'a Scenario),
    /// What a figure or Table II is made with.
    pub source: Option<&'a Source>,
    /// The study behind the tuning view.
    pub tuner: &'a Tuner,
    /// The comparison behind the view of detectors.
    pub comparer: &'a Comparer,
    /// What is looked at in them.
    pub tuning: Tuning,
}

/// Shows the stage in `rect`.
pub fn stage(
    ui: &mut Ui,
    rect: Rect,
    inputs: &Inputs<'_>,
    studies: &mut Studies,
    state: &mut StageState,
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    let mut top = rect.top() + 8.0;
    // On a phone on its side there is no height to spare and width enough.
    let low = rect.height() < LOW && rect.width() > WIDE;
    let (side, high) = (save::side(ui), finger::at_least(ui, 32.0));
    if inputs.stage.section() == Section::Paper {
        let room = if low { 0.58 * rect.width() } else { rect.width() - 14.0 - side };
        let strip = Rect::from_min_max(pos2(rect.left() + 8.0, top), pos2(rect.left() + room, top + high));
        choice(ui, strip, inputs.stage, out);
        if let Some(source) = inputs.source.filter(|_| low) {
            source.line(ui, strip.with_min_x(strip.right() + 14.0).with_max_x(rect.right() - 14.0 - side), out);
        }
        if let Some(subject) = Subject::on(inputs.stage) {
            let corner = pos2(rect.right() - 8.0 - 0.5 * side, strip.center().y);
            save::menu(ui, Rect::from_center_size(corner, egui::Vec2::splat(side)), subject, out);
        }
        top = strip.bottom() + 4.0;
    }
    if inputs.stage.section() == Section::Tuning {
        let strip = Rect::from_min_size(pos2(rect.left() + 8.0, top), vec2(SWITCH.min(rect.width() - 16.0), high));
        switch(ui, strip, inputs.stage, out);
        top = strip.bottom() + 4.0;
    }
    let line = Rect::from_min_max(pos2(rect.left(), top), pos2(rect.right(), top + 2.0));
    if let Some(progress) = studies.progress().or(inputs.tuner.left()).or(inputs.comparer.left()) {
        let share = progress.done as f32 / progress.of.max(1) as f32;
        ui.painter().rect_filled(line.with_max_x(rect.left() + rect.width() * share), 0.0, theme.accent);
    }
    let mut body = Rect::from_min_max(pos2(rect.left() + PAD, line.bottom() + 6.0), rect.max - vec2(PAD, 10.0));
    if let Some(source) = inputs.source.filter(|_| !low) {
        // What one can take over is a button.
        let line = if source.taken { source::LINE } else { finger::at_least(ui, source::LINE) };
        source.line(ui, body.with_max_y(body.top() + line), out);
        body.min.y += line + 6.0;
    }
    if let Some(refused) = studies.refused().or(inputs.tuner.refused()) {
        let said = format!("{} cannot be shown: {}.", inputs.stage.name(), refusal::told(refused));
        let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(body).id_salt("refused"));
        inner.add(egui::Label::new(notation::job(&said, 13.5, theme.error)).wrap());
        return;
    }
    if inputs.stage == Stage::Tuning {
        tuning::tuning(ui, body, inputs, &mut state.tuning, out);
        return;
    }
    if inputs.stage == Stage::Detectors {
        detectors::detectors(ui, body, inputs, &mut state.detectors, out);
        return;
    }
    match studies.found() {
        Some((Found::Figure(shown), version)) => {
            figure::figure(ui, body, (shown, version), inputs, &mut state.figure);
        }
        Some((Found::Table(shown, rows), version)) => {
            table::table(ui, body, (shown, rows.each_ref().map(Vec::as_slice), version), &mut state.estimates);
        }
        Some((Found::Map(shown), version)) => map::map(ui, body, shown, version, inputs, &mut state.map, out),
        None => {
            text::paint(ui, body.center(), Align2::CENTER_CENTER, "Computing …", fonts::regular(13.5), theme.dim);
        }
    }
}

/// Thresholds of the paper's rules, or all detectors.
fn switch(ui: &mut Ui, strip: Rect, stage: Stage, out: &mut Vec<Command>) {
    let options = Stage::TUNING.map(|stage| {
        let text = if stage == Stage::Tuning { "Thresholds" } else { stage.name() };
        Segment { text, name: text, hint: stage.summary() }
    });
    let chosen = Stage::TUNING.iter().position(|other| *other == stage).unwrap_or(0);
    if let Some(picked) = segments(ui, strip, ("Study", Role::RadioButton), &options, chosen) {
        out.push(Command::Show(Stage::TUNING[picked]));
    }
}

/// What there is of the paper, side by side; short where there is little room.
fn choice(ui: &mut Ui, strip: Rect, stage: Stage, out: &mut Vec<Command>) {
    let short = ["Fig. 3", "Fig. 4", "Fig. 6", "Fig. 7", "Fig. 8", "Table II"];
    let narrow = strip.width() < 480.0;
    let options: [Segment<'_>; 6] = std::array::from_fn(|k| {
        let stage = Stage::PAPER[k];
        Segment { text: if narrow { short[k] } else { stage.name() }, name: stage.name(), hint: stage.summary() }
    });
    let chosen = Stage::PAPER.iter().position(|other| *other == stage).unwrap_or(0);
    if let Some(picked) = segments(ui, strip, ("Paper", Role::RadioButton), &options, chosen) {
        out.push(Command::Show(Stage::PAPER[picked]));
    }
}
