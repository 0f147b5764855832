//! A figure of the paper, as it is made here.

use crate::app::charts::notation::{self, job, number};
use crate::app::charts::paint::{self, Picture, Place};
use crate::app::stages::Inputs;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use crate::app::widgets::text::rich;
use centrode_core::chart::layout::Ink;
use centrode_core::chart::notation::printed;
use centrode_core::chart::{Axis, Chart, Panel};
use egui::{Color32, Label, Painter, Pos2, Rect, ScrollArea, Sense, Stroke, Ui, pos2, vec2};

/// Size of the chart's text, points.
const TEXT: f32 = 11.5;
/// A stage lower than this has the words beside the chart.
const LOW: f32 = 260.0;
/// Width of the words there.
const ASIDE: f32 = 250.0;
/// A panel with its legend is not lower than this where there is another, points.
const LEAST: f32 = 300.0;
/// The pointer reads a point this near.
const REACH: f32 = 28.0;

/// Shows a figure with its legend, its caption, and the command that writes it to a file.
pub fn figure(
    ui: &mut Ui,
    rect: Rect,
    (chart, version): (&Chart, u64),
    inputs: &Inputs<'_>,
    kept: &mut Option<Picture<u64>>,
) {
    let theme = Theme::of(ui);
    let title = ui.painter().layout_job(strong(&chart.title, 15.0, theme.ink, rect.width()));
    let height = title.size().y;
    symbol::galley(ui.painter(), rect.min, title, theme.ink);

    // The words take what they need, below the chart or, where it would be too low, beside it.
    let below = rect.with_min_y(rect.top() + height + 10.0);
    let space = if below.height() < LOW && below.width() > 2.0 * ASIDE {
        words(ui, below.with_min_x(below.right() - ASIDE), chart, inputs, &theme);
        below.with_max_x(below.right() - ASIDE - 12.0)
    } else {
        below.with_max_y(words(ui, rect, chart, inputs, &theme) - 8.0)
    };
    let picture = Picture::keep(kept, ui.ctx(), &theme, (version, false), || chart.clone());
    // Several panels that would be too low, beside or below each other, are scrolled.
    let below = if space.width() > 1.5 * LEAST { 1.0 } else { chart.panels.len() as f32 };
    let tall = LEAST * below;
    if chart.panels.len() > 1 && space.height() < tall {
        let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(space).id_salt("panels"));
        ScrollArea::vertical().auto_shrink(false).show(&mut inner, |ui| {
            let (_, place) = ui.allocate_space(vec2(ui.available_width(), tall));
            panels(ui, place, chart, picture, &theme);
        });
    } else {
        panels(ui, space, chart, picture, &theme);
    }
}

/// Draws the panels, and reads the one under the pointer.
fn panels(ui: &mut Ui, space: Rect, chart: &Chart, picture: &mut Picture<u64>, theme: &Theme) {
    let painter = ui.painter().clone();
    let places = picture.show(&painter, theme, space, paint::page(TEXT));
    for (k, (place, panel)) in places.iter().zip(&chart.panels).enumerate() {
        let response = ui.interact(place.data(), ui.make_persistent_id(("figure", k)), Sense::hover());
        let title = [&chart.title, &panel.title].map(String::as_str).into_iter().filter(|title| !title.is_empty());
        let title = title.collect::<Vec<_>>().join(": ");
        let label = if k == 0 { format!("{title}. {}", chart.caption) } else { title };
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Figure, true, &label));
        if let Some(pointer) = response.hover_pos() {
            read(&painter, place, panel, pointer, theme);
        }
    }
}

fn strong(text: &str, size: f32, color: Color32, width: f32) -> egui::text::LayoutJob {
    let mut job = egui::text::LayoutJob::simple(text.into(), crate::app::fonts::strong(size), color, width);
    job.wrap.max_width = width;
    job
}

/// Caption and command, at the foot; returns where they begin.
fn words(ui: &mut Ui, rect: Rect, chart: &Chart, inputs: &Inputs<'_>, theme: &Theme) -> f32 {
    let mut caption = rich(&chart.caption, 11.5, theme.dim);
    caption.wrap.max_width = rect.width();
    let command = command(inputs);
    let mut line = job(&command, 11.5, theme.ink);
    line.wrap.max_width = rect.width();
    let heights = [&caption, &line].map(|job| ui.painter().layout_job(job.clone()).size().y);
    let top = (rect.bottom() - heights.iter().sum::<f32>() - 6.0).max(rect.top());
    let place = Rect::from_min_max(pos2(rect.left(), top), rect.max);
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(place).id_salt("caption"));
    inner.spacing_mut().item_spacing.y = 4.0;
    symbol::label(&mut inner, caption, true);
    inner.add(Label::new(line).wrap().selectable(true));
    top
}

/// The command that writes this figure to a file.
fn command(inputs: &Inputs<'_>) -> String {
    let digit = inputs.stage.figure().map_or(0, |number| number.digit());
    let changed = inputs.source.is_some_and(|source| source.changed);
    let scenario = if changed { " my.toml" } else { "" };
    let file = format!("centrode figure {digit}{scenario} --out figure-{digit}.svg");
    if changed { format!("{file}   (my.toml: this scenario)") } else { file }
}

/// Reads the nearest point under the pointer.
fn read(painter: &Painter, place: &Place, panel: &Panel, pointer: Pos2, theme: &Theme) {
    let points = panel.series.iter().flat_map(|series| series.points.iter().map(move |point| (series, point)));
    let near = points
        .filter(|(_, point)| point.iter().all(|v| v.is_finite()))
        .map(|(series, point)| (place.at(*point).distance(pointer), series, point))
        .filter(|(distance, ..)| *distance < REACH)
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, series, point)) = near else { return };
    let at = place.at(*point);
    painter.circle(at, 4.0, paint::color(Ink::Role(series.role), theme), Stroke::new(1.5, theme.panel));
    let line = |axis: &Axis, value: f64| {
        let text = format!("{} {} {}", printed(axis.name), number(value * axis.scale, 2), axis.unit);
        job(&text, 11.5, theme.ink)
    };
    let name = job(&printed(&series.name), 11.5, theme.dim);
    let lines = vec![name, line(&panel.x, point[0]), line(&panel.y, point[1])];
    notation::note(painter, theme, at, place.data(), lines);
}
