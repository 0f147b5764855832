//! Which contacts are detectable: two maps over bend and place of the contact.

use crate::app::charts::notation::{self, job, number};
use crate::app::charts::paint::{self, Picture, Place};
use crate::app::command::Command;
use crate::app::panels::save;
use crate::app::saving::Subject;
use crate::app::stages::Inputs;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use centrode_core::scenario::{Contact, Place as At, Scenario};
use centrode_core::study::map::ContactMap;
use centrode_core::study::map::chart::{Kind, target, without_contact};
use egui::{CursorIcon, Rect, Sense, Ui, pos2};

/// Size of the chart's text, points.
const TEXT: f32 = 11.5;
/// Decimals of both thresholds.
const DECIMALS: usize = 1;

/// What the picture is made of: the map's version, and the scenario without the contact, which moves over it.
pub type Key = (u64, Scenario);

/// Shows both maps; a click sets the contact.
pub fn map(
    ui: &mut Ui,
    rect: Rect,
    shown: &ContactMap,
    version: u64,
    inputs: &Inputs<'_>,
    kept: &mut Option<Picture<Key>>,
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    let plan = inputs.plan;
    let nowhere = Contact { place: At::Nowhere, ..Contact::default() };
    let key = (version, Scenario { contact: nowhere, ..plan.scenario().clone() });
    let picture = Picture::keep(kept, ui.ctx(), &theme, (key, true), || without_contact(shown, plan));
    let mut words = job(&summary(shown, inputs), 12.5, theme.ink);
    let told = rect.with_max_x(rect.right() - save::side(ui) - 6.0);
    words.wrap.max_width = told.width();
    let mut hint = job(
        "Computed without noise. Contacts below the line are missed. Click or drag to put the contact there. The second map shows the \
         largest load cell error ε_τ with which Θ still exceeds ε_c, whatever error within ±ε_τ the cells share; above 50 % it has one colour.",
        11.5,
        theme.dim,
    );
    hint.wrap.max_width = told.width();
    let heights = [&words, &hint].map(|job| ui.painter().layout_job(job.clone()).size().y);
    let foot = rect.bottom() - heights.iter().sum::<f32>() - 4.0;
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(told.with_min_y(foot)).id_salt("words"));
    inner.spacing_mut().item_spacing.y = 3.0;
    symbol::label(&mut inner, words, false);
    symbol::label(&mut inner, hint, false);

    let corner = pos2(rect.right() - 0.5 * save::side(ui), foot + 0.5 * save::side(ui) - 4.0);
    let place = Rect::from_center_size(corner, egui::Vec2::splat(save::side(ui)));
    save::menu(ui, place, Subject::Map, out);

    let space = rect.with_max_y(foot - 8.0);
    let painter = ui.painter().clone();
    let places = picture.show(&painter, &theme, space, paint::page(TEXT));
    let contact: Vec<_> = target(plan).into_iter().collect();
    for (k, (&kind, place)) in Kind::ALL.iter().zip(&places).enumerate() {
        picture.over(&painter, &theme, (k, place), &contact);
        touch(ui, place, kind, shown, out, &theme);
    }
}

/// The values where the contact is, in words.
fn summary(map: &ContactMap, inputs: &Inputs<'_>) -> String {
    let plan = inputs.plan;
    let Some(contact) = plan.contact() else {
        return "There is no contact now: click where it should be.".into();
    };
    let at =
        format!("Contact at {} mm and {}°", number(contact.arc_length * 1e3, 1), number(contact.bend.to_degrees(), 1));
    let Some((column, row)) = map.nearest(contact.arc_length, contact.bend) else {
        return format!("{at} is never reached by this motion.");
    };
    let cell = map.cell(row, column);
    let value = |kind: Kind| {
        let (unit, scale) = kind.unit();
        let value = kind.values(map)[cell] * scale;
        if value.is_nan() { "nothing is judged".into() } else { format!("{} {unit}", number(value, DECIMALS)) }
    };
    format!("{at}: largest ξ_2 {}, largest ε_τ {}.", value(Kind::Centrode), value(Kind::Forces))
}

/// How the values of a map are called.
fn short(kind: Kind) -> &'static str {
    match kind {
        Kind::Centrode => "largest ξ2",
        Kind::Forces => "largest ε_τ",
    }
}

/// A click or a drag puts the contact where the pointer is; without a button the pointer reads the map.
fn touch(ui: &mut Ui, place: &Place, kind: Kind, map: &ContactMap, out: &mut Vec<Command>, theme: &Theme) {
    let data = place.data();
    let response = ui.interact(data, ui.make_persistent_id(short(kind)), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::Crosshair);
    let label = format!("Map of the {} over bend and place of the contact", short(kind));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Figure, true, &label));
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked() || response.dragged()) {
        let [bend, arc_length] = place.value(at);
        out.push(Command::Touch { arc_length: (arc_length * 1e5).round() / 1e5, bend: (bend * 1e4).round() / 1e4 });
    }
    let Some(at) = response.hover_pos().filter(|_| !response.dragged()) else { return };
    let [bend, arc_length] = place.value(at);
    let Some((column, row)) = map.nearest(arc_length, bend) else { return };
    let (unit, scale) = kind.unit();
    let value = number(kind.values(map)[map.cell(row, column)] * scale, DECIMALS);
    let lines = vec![
        job(&format!("largest {} {value} {unit}", kind.symbol()), 11.5, theme.ink),
        job(&format!("{} mm, {}°", number(arc_length * 1e3, 1), number(bend.to_degrees(), 1)), 11.5, theme.dim),
    ];
    notation::note(ui.painter(), theme, at, data, lines);
}
