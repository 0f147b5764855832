//! Table II three times: the paper's, and simulated with two kinds of contact; a fourth time where the calibration filter detects, too;
//! and every estimate behind the first three.

mod estimates;

use crate::app::charts::notation::{job, number};
use crate::app::charts::paint::Picture;
use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use centrode_core::scenario::ContactKind;
use centrode_core::study::table2::ours::Ours;
use centrode_core::study::table2::{Disk, Row, Spread, Table2};
use egui::{Align, Label, Rect, ScrollArea, Sense, Ui, vec2};

/// From this width on both stand side by side.
const BESIDE: f32 = 900.0;
const ROW: f32 = 32.0;

/// One column: head, unit, and what stands in it.
struct Column {
    head: &'static str,
    unit: &'static str,
    /// Part of the table's width.
    share: f32,
    cell: fn(&Disk) -> String,
}

fn both(value: &Spread, scale: f64, decimals: usize) -> String {
    match (value.mean.is_nan(), value.deviation.is_nan()) {
        (true, _) => "–".into(),
        (false, true) => number(value.mean * scale, decimals),
        _ => format!("{} ± {}", number(value.mean * scale, decimals), number(value.deviation * scale, decimals)),
    }
}

const COLUMNS: [Column; 6] = [
    Column {
        head: "Disk",
        unit: "s_c, mm",
        share: 0.15,
        cell: |d| format!("{}   {}", d.disk, number(d.arc_length * 1e3, 1)),
    },
    Column { head: "Found", unit: "of all", share: 0.14, cell: |d| format!("{} / {}", d.found, d.repeats) },
    Column { head: "Detected", unit: "s", share: 0.21, cell: |d| both(&d.detection_time, 1.0, 3) },
    Column { head: "θ_L there", unit: "°", share: 0.18, cell: |d| both(&d.theta_l, 180.0 / std::f64::consts::PI, 1) },
    Column { head: "Estimate", unit: "mm", share: 0.18, cell: |d| both(&d.location, 1e3, 1) },
    Column {
        head: "Bias",
        unit: "mm",
        share: 0.14,
        cell: |d| {
            let text = number(d.bias * 1e3, 1);
            if d.bias > 0.0 { format!("+{text}") } else { text }
        },
    },
];

/// Shows all tables, and the estimates of `rows` (the experiments with either kind of contact) against the truth.
pub fn table(
    ui: &mut Ui,
    rect: Rect,
    (shown, rows, version): (&Table2, [&[Row]; 2], u64),
    kept: &mut Option<Picture<u64>>,
) {
    let theme = Theme::of(ui);
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(rect).id_salt("table"));
    ScrollArea::vertical().auto_shrink(false).show(&mut inner, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let paper = ("The paper's experiment", "Means and standard deviations of the rows it prints", &shown.paper);
        let [ours, others] = [(shown.kind, &shown.simulated), (shown.other_kind, &shown.other)].map(|(kind, disks)| {
            let (title, below) = words(kind);
            (title, below, disks)
        });
        let filter = shown.ours.as_ref().map(|ours| (held(ours), ours.each_ref().map(|ours| ours.disk)));
        let filter = filter.as_ref().map(|(below, disks)| (BY_CUSUM, below.as_str(), disks));
        let said = "± is the standard deviation over repeats. Contacts are those of the presets disk-1, bench and disk-3. The paper does \
            not say when contact began nor in how many repeats it was missed: each of its rows counts as found.";
        let mut said = job(said, 12.0, theme.dim);
        said.wrap.max_width = ui.available_width();
        // The picture has what tables and words leave.
        let end = ui.min_rect().top() + rect.height() - ui.painter().layout_job(said.clone()).size().y - 16.0;
        let mut picture = |ui: &mut Ui| {
            let height = (end - ui.cursor().top()).max(estimates::LEAST);
            let (_, place) = ui.allocate_space(vec2(ui.available_width(), height));
            estimates::estimates(ui, place, (shown, rows, version), kept);
        };
        if rect.width() > BESIDE {
            ui.horizontal_top(|ui| {
                let width = 0.5 * (ui.available_width() - 40.0);
                let column = |ui: &mut Ui, show: &mut dyn FnMut(&mut Ui)| {
                    ui.allocate_ui_with_layout(vec2(width, 0.0), egui::Layout::top_down(Align::Min), |ui| show(ui));
                };
                column(ui, &mut |ui| {
                    block(ui, paper, width, &theme);
                    ui.add_space(14.0);
                    picture(ui);
                });
                ui.add_space(32.0);
                column(ui, &mut |ui| {
                    block(ui, ours, width, &theme);
                    ui.add_space(14.0);
                    block(ui, others, width, &theme);
                    if let Some(filter) = filter {
                        ui.add_space(14.0);
                        block(ui, filter, width, &theme);
                    }
                });
            });
        } else {
            for part in [paper, ours, others].into_iter().chain(filter) {
                block(ui, part, ui.available_width(), &theme);
                ui.add_space(14.0);
            }
            picture(ui);
        }
        ui.add_space(8.0);
        symbol::label(ui, said, false);
    });
}

/// Title of the table in which the calibration filter detects and places.
const BY_CUSUM: &str = "Simulated: noticed by CUSUM, placed half a second later";

/// How often its intervals hold the true places.
fn held(ours: &[Ours; 3]) -> String {
    let disk = |ours: &Ours| match ours.placed {
        0 => format!("disk {}: none placed", ours.disk.disk),
        placed => format!("disk {}: {} of {placed}", ours.disk.disk, number(ours.covered * placed as f64, 0)),
    };
    let disks: Vec<_> = ours.iter().map(disk).collect();
    format!(
        "The same experiments as with the scenario's beam. 95 % intervals that hold the true place: {}",
        disks.join(", ")
    )
}

/// Title of a simulated table, and what its kind of contact does.
fn words(kind: ContactKind) -> (&'static str, &'static str) {
    match kind {
        ContactKind::Clamp => {
            ("Simulated: a beam that clamps", "What is below the beam keeps its shape, as the paper takes it")
        }
        ContactKind::Plane => ("Simulated: a flat beam that touches", "What is below the beam goes on changing shape"),
        ContactKind::Cylinder => {
            ("Simulated: a round beam that touches", "The backbone slides along it and changes shape below")
        }
    }
}

fn block(ui: &mut Ui, (title, below, disks): (&str, &str, &[Disk; 3]), width: f32, theme: &Theme) {
    ui.add(Label::new(egui::RichText::new(title).font(fonts::strong(15.0)).color(theme.ink)));
    ui.add_space(2.0);
    symbol::label(ui, job(below, 12.0, theme.dim), false);
    ui.add_space(8.0);
    let narrow = width < 430.0;
    let size = if narrow { 12.0 } else { 12.5 + ((width - 450.0) / 60.0).clamp(0.0, 1.0) };
    let (head, _) = ui.allocate_exact_size(vec2(width, 36.0), Sense::hover());
    cells(head, |column, right| {
        for (k, (text, color)) in [(column.head, theme.ink), (column.unit, theme.dim)].into_iter().enumerate() {
            let galley = ui.painter().layout_job(job(text, size - 1.0, color));
            let at = egui::pos2(right - galley.size().x, head.top() + 2.0 + 16.0 * k as f32);
            symbol::galley(ui.painter(), at, galley, color);
        }
    });
    for disk in disks {
        let (row, response) = ui.allocate_exact_size(vec2(width, if narrow { 1.3 * ROW } else { ROW }), Sense::hover());
        ui.painter().hline(row.x_range(), row.top(), egui::Stroke::new(1.0, theme.faint));
        let mut words = format!("{title}, disk {}", disk.disk);
        cells(row, |column, right| {
            let text = (column.cell)(disk);
            if column.head != "Disk" {
                words.push_str(&format!("; {} {text} {}", column.head.replace('_', ""), column.unit));
            }
            // On a phone the deviation stands below the mean.
            let (mean, deviation) = match text.split_once(" ± ") {
                Some((mean, deviation)) if narrow => (mean.to_owned(), Some(format!("± {deviation}"))),
                _ => (text, None),
            };
            let lift = if deviation.is_some() { 7.0 } else { 0.0 };
            let lines = [(Some(mean), size, theme.ink, -lift), (deviation, size - 1.5, theme.dim, lift + 1.0)];
            for (text, size, color, down) in lines {
                let Some(text) = text else { continue };
                let galley = ui.painter().layout_no_wrap(text, egui::FontId::proportional(size), color);
                let at = egui::pos2(right - galley.size().x, row.center().y - 0.5 * galley.size().y + down);
                ui.painter().galley(at, galley, color);
            }
        });
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &words));
    }
    let (end, _) = ui.allocate_exact_size(vec2(width, 1.0), Sense::hover());
    ui.painter().hline(end.x_range(), end.top(), egui::Stroke::new(1.0, theme.faint));
}

/// Calls `cell` with each column and its right edge.
fn cells(row: Rect, mut cell: impl FnMut(&Column, f32)) {
    let mut right = row.left();
    for column in &COLUMNS {
        right += column.share * row.width();
        cell(column, right - 4.0);
    }
}
