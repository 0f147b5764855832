//! What can stand on the stage in the robot's place: a figure, Table II, the map.

mod figure;
mod map;
pub mod stage;
pub mod studies;
mod table;
pub mod tuner;
mod tuning;
pub mod viewport;

use crate::app::charts::notation;
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::stages::stage::Stage;
use crate::app::stages::studies::{Found, Studies};
use crate::app::stages::tuner::Tuner;
use crate::app::state::Tuning;
use crate::app::theme::Theme;
use crate::app::widgets::segmented::segmented;
use crate::app::widgets::text;
use centrode_core::run::Run;
use centrode_core::scenario::Scenario;
use egui::{Align2, Rect, Ui, pos2, vec2};
use map::Picture;
use tuning::TuningState;

/// Space around the content.
const PAD: f32 = 14.0;

/// Pictures that are kept between frames.
#[derive(Default)]
pub struct StageState {
    map: Option<Picture>,
    tuning: TuningState,
}

/// What the stage is drawn from.
pub struct Inputs<'a> {
    /// What stands on it.
    pub stage: Stage,
    /// The experiment on the page.
    pub run: &'a Run,
    /// The preset that resets go back to: its name and scenario.
    pub base: (&'a str, &'a Scenario),
    /// The study behind the tuning view.
    pub tuner: &'a Tuner,
    /// What is looked at in it.
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
    let strip = Rect::from_min_max(rect.min + vec2(8.0, 8.0), pos2(rect.right() - 8.0, rect.top() + 40.0));
    choice(ui, strip, inputs.stage, out);
    let line = Rect::from_min_max(pos2(rect.left(), strip.bottom() + 4.0), pos2(rect.right(), strip.bottom() + 6.0));
    if let Some(progress) = studies.progress().or(inputs.tuner.left()) {
        let share = progress.done as f32 / progress.of.max(1) as f32;
        ui.painter().rect_filled(line.with_max_x(rect.left() + rect.width() * share), 0.0, theme.accent);
    }
    let body = Rect::from_min_max(pos2(rect.left() + PAD, line.bottom() + 6.0), rect.max - vec2(PAD, 10.0));
    if let Some(refused) = studies.refused().or(inputs.tuner.refused()) {
        let said = format!("{} cannot be shown: {refused}.", inputs.stage.name());
        let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(body).id_salt("refused"));
        inner.add(egui::Label::new(notation::job(&said, 13.5, theme.error)).wrap());
        return;
    }
    if inputs.stage == Stage::Tuning {
        tuning::tuning(ui, body, inputs, &mut state.tuning, out);
        return;
    }
    match studies.found() {
        Some((Found::Figure(shown), _)) => figure::figure(ui, body, shown, inputs),
        Some((Found::Table(shown), _)) => table::table(ui, body, shown),
        Some((Found::Map(shown), version)) => map::map(ui, body, shown, version, inputs, &mut state.map, out),
        None => {
            text::paint(ui, body.center(), Align2::CENTER_CENTER, "Computing …", fonts::regular(13.5), theme.dim);
        }
    }
}

/// All that can stand there, side by side; short names where there is little room.
fn choice(ui: &mut Ui, strip: Rect, stage: Stage, out: &mut Vec<Command>) {
    let narrow = strip.width() < 560.0;
    let names = Stage::ALL.map(|stage| match (narrow, stage.figure()) {
        (true, Some(_)) => stage.name().trim_start_matches("Figure "),
        (true, None) if stage == Stage::Table2 => "II",
        (true, None) if stage == Stage::Tuning => "Tune",
        _ => stage.name(),
    });
    let chosen = Stage::ALL.iter().position(|other| *other == stage).unwrap_or(0);
    if let Some(picked) = segmented(ui, strip, "Stage", &names, chosen) {
        out.push(Command::Show(Stage::ALL[picked]));
    }
}
