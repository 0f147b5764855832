//! Draws the map of detectable contacts: two panels with their colour bars, level lines and the contact.

use super::canvas::{Align, Canvas, Look, Paper, Point, width};
use super::ticks::ticks;
use super::{Format, bytes};
use crate::scene::Color;
use crate::scene::colormap::colormap;
use crate::scene::palette::Palette;
use centrode_core::scenario::Plan;
use centrode_core::study::map::Map;
use centrode_core::study::map::contour::contour;

/// The page.
const SIZE: [f64; 2] = [1280.0, 640.0];
/// Of one panel: its left and right, where the first begins.
const PANELS: [[f64; 2]; 2] = [[78.0, 528.0], [718.0, 1168.0]];
const TOP: f64 = 92.0;
const BOTTOM: f64 = 520.0;
const TEXT: f64 = 14.0;
const SMALL: f64 = 12.5;
/// Errors are shown in colour up to this: load cells are not worse.
const MOST: f64 = 0.5;

struct Panel<'a> {
    title: &'static str,
    unit: &'static str,
    scale: f64,
    values: &'a [f64],
    top: f64,
    level: Option<f64>,
    level_name: &'static str,
}

/// The map of a plan's scenario as a file's bytes.
pub fn map(map: &Map, plan: &Plan, format: Format) -> Result<Vec<u8>, String> {
    bytes(&Drawing { map, plan }, format)
}

struct Drawing<'a> {
    map: &'a Map,
    plan: &'a Plan,
}

impl super::Drawing for Drawing<'_> {
    const SIZE: [u32; 2] = [SIZE[0] as u32, SIZE[1] as u32];

    fn draw<P: Paper>(&self, canvas: &mut Canvas<P>) {
        let scenario = self.plan.scenario();
        let palette = Palette::LIGHT;
        let largest = |values: &[f64]| values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max).max(1e-12);
        let panels = [
            Panel {
                title: "Largest ξ_2 that finds the contact",
                unit: "mm",
                scale: 1e3,
                values: &self.map.deviation,
                top: largest(&self.map.deviation),
                level: scenario.detection.xi2.value(),
                level_name: "ξ_2",
            },
            Panel {
                title: "Largest ε_τ at which joint forces show it",
                unit: "%",
                scale: 100.0,
                values: &self.map.epsilon,
                top: largest(&self.map.epsilon).min(MOST),
                level: Some(scenario.load_cells.epsilon_tau),
                level_name: "ε_τ",
            },
        ];
        canvas.rectangle([0.0, 0.0, SIZE[0], SIZE[1]], Color::WHITE);
        let bold = Look { bold: true, upright: false };
        canvas.text("Which contacts are detectable", [30.0, 38.0], 20.0, palette.ink, Align::Left, bold);
        for (panel, [left, right]) in panels.iter().zip(PANELS) {
            self.panel(canvas, panel, left, right, &palette);
        }
        for (k, line) in self.caption().iter().enumerate() {
            canvas.text(line, [30.0, 590.0 + 18.0 * k as f64], SMALL, palette.ink_dim, Align::Left, Look::default());
        }
    }
}

impl Drawing<'_> {
    fn caption(&self) -> [String; 2] {
        let scenario = self.plan.scenario();
        let motion = &scenario.motion;
        [
            format!(
                "Simulated by Centrode, without noise: L = {} mm, r = {} mm, δ = {:.0}°; θ_L from {:.0}° to {:.0}° between {} s and {} s; N = {}, armed from {} s, ‖ω_s‖ above {} rad/s.",
                scenario.robot.length * 1e3,
                scenario.robot.pitch_radius * 1e3,
                motion.delta.to_degrees(),
                motion.theta_start.to_degrees(),
                motion.theta_end.to_degrees(),
                motion.start,
                motion.finish,
                scenario.filter.length,
                scenario.detection.armed_from,
                scenario.detection.min_speed,
            ),
            "Below the line a contact is missed. Joint forces show a contact when Θ exceeds ε_c whatever error within ±ε_τ the cells share; beyond 50 % the colour stays."
                .into(),
        ]
    }

    fn panel<P: Paper>(&self, canvas: &mut Canvas<P>, panel: &Panel<'_>, left: f64, right: f64, palette: &Palette) {
        let map = self.map;
        let (columns, rows) = (map.bends.len(), map.arc_lengths.len());
        let step = |values: &[f64]| (values[values.len() - 1] - values[0]) / (values.len() - 1) as f64;
        let (bend_step, place_step) = (step(&map.bends), step(&map.arc_lengths));
        let (first, last) = (map.bends[0] - 0.5 * bend_step, map.bends[columns - 1] + 0.5 * bend_step);
        let (low, high) = (first.min(last), first.max(last));
        let span = if high > low { high - low } else { 1.0 };
        let length = self.plan.segment().length;
        let x = |bend: f64| left + (right - left) * (bend - low) / span;
        let y = |place: f64| BOTTOM - (BOTTOM - TOP) * place / length;
        for row in 0..rows {
            for column in 0..columns {
                let value = panel.values[map.cell(row, column)];
                if value.is_nan() {
                    continue;
                }
                let (bend, place) = (map.bends[column], map.arc_lengths[row]);
                let ends = [x(bend - 0.5 * bend_step), x(bend + 0.5 * bend_step)];
                // Half a point of overlap, so that no seam shows between cells.
                let cell = [
                    ends[0].min(ends[1]),
                    y(place + 0.5 * place_step),
                    (ends[0].max(ends[1]) + 0.5).min(right),
                    (y(place - 0.5 * place_step) + 0.5).min(BOTTOM),
                ];
                canvas.rectangle(cell, colormap(value / panel.top));
            }
        }
        self.lines(canvas, panel, (&x, &y), [bend_step, place_step]);
        let frame = [[left, TOP], [right, TOP], [right, BOTTOM], [left, BOTTOM], [left, TOP]];
        canvas.line(&frame, palette.ink_dim, 1.0);
        let plain = Look::default();
        canvas.text(
            panel.title,
            [left, TOP - 18.0],
            TEXT + 1.0,
            palette.ink,
            Align::Left,
            Look { bold: true, upright: false },
        );
        if let Some(level) = panel.level {
            let text = format!("line: {} = {:.1} {}", panel.level_name, level * panel.scale, panel.unit);
            canvas.text(&text, [right, TOP - 18.0], SMALL, palette.ink_dim, Align::Right, plain);
        }
        for (value, text) in ticks([low.to_degrees(), (low + span).to_degrees()], "°") {
            let at = x(value.to_radians());
            canvas.line(&[[at, BOTTOM], [at, BOTTOM + 5.0]], palette.ink_dim, 1.0);
            canvas.text(&text, [at, BOTTOM + 20.0], SMALL, palette.ink, Align::Center, plain);
        }
        for (value, text) in ticks([0.0, length * 1e3], "mm") {
            let at = y(value * 1e-3);
            canvas.line(&[[left - 5.0, at], [left, at]], palette.ink_dim, 1.0);
            canvas.text(&text, [left - 9.0, at + 4.5], SMALL, palette.ink, Align::Right, plain);
        }
        let middle = 0.5 * (left + right);
        canvas.text("Bend at contact (°)", [middle, BOTTOM + 42.0], TEXT, palette.ink, Align::Center, plain);
        let upright = Look { bold: false, upright: true };
        canvas.text("s_c (mm)", [left - 42.0, 0.5 * (TOP + BOTTOM)], TEXT, palette.ink, Align::Center, upright);
        for (k, &disk) in self.plan.scenario().robot.disks.iter().enumerate() {
            canvas.line(&[[right - 9.0, y(disk)], [right, y(disk)]], Color::WHITE, 1.5);
            let at = [right - 13.0, y(disk) + 4.0];
            let wide = width(&format!("disk {}", k + 1), SMALL - 1.0, false);
            let behind = [at[0] - wide - 4.0, at[1] - 12.0, at[0] + 3.0, at[1] + 4.0];
            canvas.rectangle(behind, Color::rgba(0.0, 0.0, 0.0, 0.55));
            canvas.text(&format!("disk {}", k + 1), at, SMALL - 1.0, Color::WHITE, Align::Right, plain);
        }
        self.bar(canvas, panel, right + 14.0, palette);
    }

    /// Level line and contact.
    fn lines<P: Paper>(
        &self,
        canvas: &mut Canvas<P>,
        panel: &Panel<'_>,
        (x, y): (&impl Fn(f64) -> f64, &impl Fn(f64) -> f64),
        [bend_step, place_step]: [f64; 2],
    ) {
        let map = self.map;
        if let Some(level) = panel.level {
            let place = |[column, row]: [f64; 2]| -> Point {
                [x(map.bends[0] + column * bend_step), y(map.arc_lengths[0] + row * place_step)]
            };
            let pieces = contour(panel.values, map.bends.len(), level);
            for (width, color) in [(4.0, Color::rgba(0.0, 0.0, 0.0, 0.55)), (2.0, Color::WHITE)] {
                for piece in &pieces {
                    canvas.line(&piece.map(place), color, width);
                }
            }
        }
        if let Some(contact) = self.plan.contact() {
            let at = [x(contact.bend), y(contact.arc_length)];
            let [left, right] =
                PANELS.into_iter().find(|[left, right]| (*left..=*right).contains(&at[0])).unwrap_or_default();
            if right > left {
                canvas.line(&[[left, at[1]], [right, at[1]]], Color::WHITE, 1.0);
                canvas.line(&[[at[0], TOP], [at[0], BOTTOM]], Color::WHITE, 1.0);
                canvas.disk(at, 6.5, Color::WHITE);
                canvas.disk(at, 5.0, Palette::LIGHT.detection);
            }
        }
    }

    /// What the colours mean.
    fn bar<P: Paper>(&self, canvas: &mut Canvas<P>, panel: &Panel<'_>, left: f64, palette: &Palette) {
        const PIECES: usize = 96;
        let height = BOTTOM - TOP;
        for k in 0..PIECES {
            let [from, to] = [k, k + 1].map(|k| BOTTOM - height * k as f64 / PIECES as f64);
            let color = colormap((k as f64 + 0.5) / PIECES as f64);
            canvas.rectangle([left, to, left + 14.0, (from + 0.5).min(BOTTOM)], color);
        }
        let y = |value: f64| BOTTOM - height * value / panel.top;
        for (value, text) in ticks([0.0, panel.top * panel.scale], panel.unit) {
            let at = y(value / panel.scale);
            canvas.line(&[[left + 14.0, at], [left + 18.0, at]], palette.ink_dim, 1.0);
            canvas.text(&text, [left + 22.0, at + 4.5], SMALL, palette.ink, Align::Left, Look::default());
        }
        canvas.text(panel.unit, [left, TOP - 18.0], SMALL, palette.ink, Align::Left, Look::default());
        if let Some(level) = panel.level.filter(|level| *level <= panel.top) {
            canvas.line(&[[left - 3.0, y(level)], [left + 17.0, y(level)]], Color::WHITE, 2.0);
        }
    }
}
