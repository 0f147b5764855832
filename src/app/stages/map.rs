//! Which contacts are detectable: two maps over bend and place of the contact.

use crate::app::charts::axes::{Chart, NAME, Side};
use crate::app::charts::notation::{self, job, number};
use crate::app::charts::plots::Steps;
use crate::app::command::Command;
use crate::app::fonts;
use crate::app::stages::Inputs;
use crate::app::theme::Theme;
use crate::scene::colormap::colormap;
use centrode_core::study::map::Map;
use centrode_core::study::map::contour::contour;
use egui::{
    Align2, Color32, ColorImage, CursorIcon, FontId, Label, Painter, Rect, Sense, Stroke, TextureHandle,
    TextureOptions, Ui, pos2, vec2,
};

/// From this width on both maps stand side by side.
const BESIDE: f32 = 640.0;
/// Width of a colour bar with its labels.
const BAR: f32 = 52.0;
/// Errors are shown in colour up to this: load cells are not worse.
const MOST: f64 = 0.5;

/// Both maps as images, kept while they stay the same.
pub struct Picture {
    version: u64,
    kinds: [(TextureHandle, f64); 2],
}

/// One of the two maps.
struct Kind {
    title: &'static str,
    short: &'static str,
    unit: &'static str,
    scale: f64,
    decimals: usize,
    values: fn(&Map) -> &[f64],
}

const KINDS: [Kind; 2] = [
    Kind {
        title: "Largest ξ_2 that detects the contact",
        short: "largest ξ2",
        unit: "mm",
        scale: 1e3,
        decimals: 1,
        values: |map| &map.deviation,
    },
    Kind {
        title: "Largest ε_τ at which joint forces show it",
        short: "largest ε_τ",
        unit: "%",
        scale: 100.0,
        decimals: 1,
        values: |map| &map.epsilon,
    },
];

/// Shows both maps; a click sets the contact.
pub fn map(
    ui: &mut Ui,
    rect: Rect,
    shown: &Map,
    version: u64,
    inputs: &Inputs<'_>,
    kept: &mut Option<Picture>,
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    if kept.as_ref().is_none_or(|picture| picture.version != version) {
        *kept = Some(paint(ui, shown, version));
    }
    let Some(picture) = kept else { return };
    let mut words = job(&summary(shown, inputs), 12.5, theme.ink);
    words.wrap.max_width = rect.width();
    let mut hint = job(
        "Computed without noise. Contacts below the line are missed. Click or drag to put the contact there. The second map shows the \
         largest load cell error ε_τ with which Θ still exceeds ε_c, whatever error within ±ε_τ the cells share; above 50 % it has one colour.",
        11.5,
        theme.dim,
    );
    hint.wrap.max_width = rect.width();
    let heights = [&words, &hint].map(|job| ui.painter().layout_job(job.clone()).size().y);
    let foot = rect.bottom() - heights.iter().sum::<f32>() - 4.0;
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(rect.with_min_y(foot)).id_salt("words"));
    inner.spacing_mut().item_spacing.y = 3.0;
    inner.add(Label::new(words).wrap());
    inner.add(Label::new(hint).wrap());

    let space = rect.with_max_y(foot - 8.0);
    let beside = rect.width() > BESIDE;
    for (k, kind) in KINDS.iter().enumerate() {
        let half = 0.5 * if beside { space.width() } else { space.height() };
        let place = if beside {
            Rect::from_min_size(space.min + vec2(half * k as f32, 0.0), vec2(half - 6.0, space.height()))
        } else {
            Rect::from_min_size(space.min + vec2(0.0, half * k as f32), vec2(space.width(), half - 4.0))
        };
        one(ui, place, kind, shown, &picture.kinds[k], inputs, out);
    }
}

/// The values where the contact is, in words.
fn summary(map: &Map, inputs: &Inputs<'_>) -> String {
    let plan = &inputs.run.plan;
    let Some(contact) = plan.contact() else {
        return "There is no contact now: click where it should be.".into();
    };
    let at =
        format!("Contact at {} mm and {}°", number(contact.arc_length * 1e3, 1), number(contact.bend.to_degrees(), 1));
    let Some((column, row)) = map.nearest(contact.arc_length, contact.bend) else {
        return format!("{at} is never reached by this motion.");
    };
    let cell = map.cell(row, column);
    let value = |kind: &Kind| {
        let value = (kind.values)(map)[cell] * kind.scale;
        if value.is_nan() {
            "nothing is judged".into()
        } else {
            format!("{} {}", number(value, kind.decimals), kind.unit)
        }
    };
    format!("{at}: largest ξ_2 {}, largest ε_τ {}.", value(&KINDS[0]), value(&KINDS[1]))
}

fn paint(ui: &Ui, map: &Map, version: u64) -> Picture {
    let size = [map.bends.len(), map.arc_lengths.len()];
    let rising = map.bends.first() <= map.bends.last();
    let kinds = [0, 1].map(|k| {
        let values = (KINDS[k].values)(map);
        let top = values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
        let top = if k == 1 { top.min(MOST) } else { top };
        // Rows from the tip down, columns from the smaller bend up.
        let pixels = (0..size[1]).rev().flat_map(|row| {
            (0..size[0]).map(move |column| map.cell(row, if rising { column } else { size[0] - 1 - column }))
        });
        let pixels = pixels.map(|cell| {
            let [r, g, b, a] = colormap(values[cell] / top).to_bytes();
            Color32::from_rgba_unmultiplied(r, g, b, a)
        });
        let image = ColorImage::new(size, pixels.collect());
        (ui.ctx().load_texture(KINDS[k].short, image, TextureOptions::LINEAR), top)
    });
    Picture { version, kinds }
}

fn one(
    ui: &mut Ui,
    rect: Rect,
    kind: &Kind,
    map: &Map,
    (texture, top): &(TextureHandle, f64),
    inputs: &Inputs<'_>,
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    let painter = ui.painter().clone();
    let title = painter.layout_job(job(kind.title, NAME + 0.5, theme.ink));
    painter.galley(rect.min + vec2(4.0, 0.0), title, theme.ink);
    let step = |values: &[f64]| (values[values.len() - 1] - values[0]) / (values.len() - 1) as f64;
    let (bend_step, place_step) = (step(&map.bends), step(&map.arc_lengths));
    let ends = [map.bends[0] - 0.5 * bend_step, map.bends[map.bends.len() - 1] + 0.5 * bend_step].map(f64::to_degrees);
    let x = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    let y = [0.0, (map.arc_lengths[map.arc_lengths.len() - 1] + 0.5 * place_step) * 1e3];
    let chart = Chart::new(Rect::from_min_max(rect.min + vec2(0.0, 18.0), rect.max - vec2(BAR, 0.0)), x, y, false);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    let side = |name, steps| Side { name, steps };
    painter.image(texture.id(), chart.data, whole, Color32::WHITE);
    chart.frame(&painter, &theme, &side("Bend at contact (°)", Steps::Degrees), &side("s_c (mm)", Steps::Decimal));
    bar(&painter, chart.data, kind, *top, &theme);

    let scenario = inputs.run.plan.scenario();
    let mut names = Vec::new();
    for (k, &disk) in scenario.robot.disks.iter().enumerate() {
        let at = chart.y.at(disk * 1e3);
        painter.hline(chart.data.right() - 7.0..=chart.data.right(), at, Stroke::new(1.5, Color32::WHITE));
        if chart.data.height() > 120.0 {
            let name = painter.layout_no_wrap(format!("disk {}", k + 1), FontId::proportional(10.0), Color32::WHITE);
            let place = Align2::RIGHT_CENTER.anchor_size(pos2(chart.data.right() - 11.0, at), name.size());
            names.push((place, name));
        }
    }

    let inside = painter.with_clip_rect(chart.data.intersect(painter.clip_rect()));
    let level = match kind.unit {
        "mm" => scenario.detection.xi2.value(),
        _ => Some(scenario.load_cells.epsilon_tau),
    };
    if let Some(level) = level {
        let place = |[column, row]: [f64; 2]| {
            let bend = (map.bends[0] + column * bend_step).to_degrees();
            chart.at([bend, (map.arc_lengths[0] + row * place_step) * 1e3])
        };
        let pieces = contour((kind.values)(map), map.bends.len(), level);
        for (width, color) in [(4.0, Color32::from_black_alpha(150)), (2.0, Color32::WHITE)] {
            for piece in &pieces {
                inside.line_segment(piece.map(place), Stroke::new(width, color));
            }
        }
        let symbol = if kind.unit == "mm" { "ξ_2" } else { "ε_τ" };
        let text = format!("{symbol} = {} {}", number(level * kind.scale, kind.decimals), kind.unit);
        let said = if pieces.is_empty() { format!("{text}: no line here") } else { text };
        let galley = painter.layout_job(job(&said, 11.0, theme.dim));
        let at = pos2(chart.data.right() - galley.size().x, chart.data.top() - 17.0);
        painter.galley(at, galley, theme.dim);
    }
    if let Some(contact) = inputs.run.plan.contact() {
        let at = chart.at([contact.bend.to_degrees(), contact.arc_length * 1e3]);
        for (width, color) in [(3.0, Color32::from_black_alpha(120)), (1.2, Color32::WHITE)] {
            inside.vline(at.x, chart.data.y_range(), Stroke::new(width, color));
            inside.hline(chart.data.x_range(), at.y, Stroke::new(width, color));
        }
        inside.circle(at, 5.5, theme.detection, Stroke::new(1.8, Color32::WHITE));
    }
    for (place, name) in names {
        painter.rect_filled(place.expand2(vec2(3.0, 1.0)), 3.0, Color32::from_black_alpha(150));
        painter.galley(place.min, name, Color32::WHITE);
    }
    touch(ui, &chart, kind, map, out, &theme);
}

/// What the colours mean.
fn bar(painter: &Painter, data: Rect, kind: &Kind, top: f64, theme: &Theme) {
    let bar = Rect::from_min_max(pos2(data.right() + 8.0, data.top()), pos2(data.right() + 18.0, data.bottom()));
    let steps = 64;
    for k in 0..steps {
        let [from, to] = [k, k + 1].map(|k| bar.bottom() - bar.height() * k as f32 / steps as f32);
        let [r, g, b, _] = colormap(f64::from(k) / f64::from(steps - 1)).to_bytes();
        painter.rect_filled(Rect::from_x_y_ranges(bar.x_range(), to..=from + 0.5), 0.0, Color32::from_rgb(r, g, b));
    }
    let axis = crate::app::charts::plots::Axis::new([0.0, top * kind.scale], [bar.bottom(), bar.top()]);
    for tick in axis.ticks(40.0, Steps::Decimal) {
        let at = pos2(bar.right() + 4.0, axis.at(tick.value));
        painter.text(at, Align2::LEFT_CENTER, tick.text, FontId::proportional(10.5), theme.dim);
    }
    painter.text(pos2(bar.left(), bar.top() - 5.0), Align2::LEFT_BOTTOM, kind.unit, fonts::regular(10.5), theme.dim);
}

/// A click or a drag puts the contact where the pointer is; without a button the pointer reads the map.
fn touch(ui: &mut Ui, chart: &Chart, kind: &Kind, map: &Map, out: &mut Vec<Command>, theme: &Theme) {
    let response = ui.interact(chart.data, ui.make_persistent_id(kind.short), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(CursorIcon::Crosshair);
    let label = format!("Map of the {} over bend and place of the contact", kind.short);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Figure, true, &label));
    let contact = |at: egui::Pos2| (chart.y.value(at.y) * 1e-3, chart.x.value(at.x).to_radians());
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked() || response.dragged()) {
        let (arc_length, bend) = contact(at);
        out.push(Command::Touch { arc_length: (arc_length * 1e5).round() / 1e5, bend: (bend * 1e4).round() / 1e4 });
    }
    let Some(at) = response.hover_pos().filter(|_| !response.dragged()) else { return };
    let (arc_length, bend) = contact(at);
    let Some((column, row)) = map.nearest(arc_length, bend) else { return };
    let value = (kind.values)(map)[map.cell(row, column)] * kind.scale;
    let lines = vec![
        job(
            &format!("{} {} {}", kind.short.replace("ξ2", "ξ_2"), number(value, kind.decimals), kind.unit),
            11.5,
            theme.ink,
        ),
        job(&format!("{} mm, {}°", number(arc_length * 1e3, 1), number(bend.to_degrees(), 1)), 11.5, theme.dim),
    ];
    notation::note(ui.painter(), theme, at, chart.data, lines);
}
