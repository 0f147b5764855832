//! Draws a study: contacts found, and delay, against false alarms, each with its band.

use super::canvas::{Align, Canvas, Look, Paper, Point as At, width};
use super::ticks::ticks;
use super::{Format, bytes};
use crate::scene::Color;
use crate::scene::colormap::member;
use crate::scene::palette::Palette;
use centrode_core::study::Job;
use centrode_core::study::tuning::rate::{percents, spread};
use centrode_core::study::tuning::recommend::{Verdict, Wish};
use centrode_core::study::tuning::watch::Method;
use centrode_core::study::tuning::{Point, Study};

/// The page.
const SIZE: [f64; 2] = [1280.0, 660.0];
/// Left and right of both panels.
const PANELS: [[f64; 2]; 2] = [[84.0, 606.0], [724.0, 1246.0]];
const TOP: f64 = 130.0;
const BOTTOM: f64 = 520.0;
const TEXT: f64 = 14.0;
const SMALL: f64 = 12.5;
/// The most cells whose delays are drawn.
const CELLS: usize = 12;

/// A study as a file's bytes.
pub fn study(study: &Study, wish: &Wish, verdict: &Verdict, partial: bool, format: Format) -> Result<Vec<u8>, String> {
    bytes(&Drawing { study, wish, verdict, partial }, format)
}

struct Drawing<'a> {
    study: &'a Study,
    wish: &'a Wish,
    verdict: &'a Verdict,
    partial: bool,
}

/// A curve: points of the page, with the corners of both intervals that lie farthest from it.
struct Curve {
    color: Color,
    dashed: bool,
    name: String,
    stretches: Vec<Vec<[At; 3]>>,
}

impl super::Drawing for Drawing<'_> {
    const SIZE: [u32; 2] = [SIZE[0] as u32, SIZE[1] as u32];

    fn draw<P: Paper>(&self, canvas: &mut Canvas<P>) {
        let palette = Palette::LIGHT;
        canvas.rectangle([0.0, 0.0, SIZE[0], SIZE[1]], Color::WHITE);
        let bold = Look { bold: true, upright: false };
        canvas.text("What thresholds cost", [30.0, 40.0], 20.0, palette.ink, Align::Left, bold);
        let late = self.late();
        let cells = self.drawn();
        let sides: [(&str, &str, Vec<Curve>); 2] = [
            (
                &self.titled("Contacts found against false alarms"),
                "Found in time (%)",
                Method::ALL.map(|method| self.operating(method, palette)).into(),
            ),
            (
                "Delay against false alarms",
                "Median delay (s)",
                cells.iter().map(|&cell| self.delays(cell, cells.len(), palette)).collect(),
            ),
        ];
        for (k, ((title, name, curves), [left, right])) in sides.into_iter().zip(PANELS).enumerate() {
            canvas.text(title, [left, 76.0], TEXT + 1.0, palette.ink, Align::Left, bold);
            let marks: Vec<(f64, String)> = if k == 0 {
                let mark = |percent| (spread(f64::from(percent) / 100.0), format!("{percent}"));
                percents(0.045).into_iter().map(mark).collect()
            } else {
                let inside = |(value, _): &(f64, String)| *value <= late;
                ticks([0.0, late], "s").into_iter().filter(inside).map(|(value, text)| (value / late, text)).collect()
            };
            frame(canvas, [left, right], name, &marks, palette);
            let wish = left + (right - left) * spread(self.wish.false_alarm_rate);
            canvas.dashed(&[[wish, TOP], [wish, BOTTOM]], palette.ink_dim, 1.2, [4.0, 4.0]);
            for curve in &curves {
                band(canvas, curve);
            }
            for curve in &curves {
                line(canvas, curve);
            }
            legend(canvas, [left, right], &curves, palette);
        }
        self.marks(canvas, palette);
        for (k, text) in self.caption().iter().enumerate() {
            canvas.text(text, [30.0, 594.0 + 18.0 * k as f64], SMALL, palette.ink_dim, Align::Left, Look::default());
        }
    }
}

impl Drawing<'_> {
    /// Top of the delays, s: no run is longer.
    fn late(&self) -> f64 {
        let ends = self.study.cells().iter().map(|cell| cell.scenario.motion.end);
        self.study.spec().late.min(ends.fold(0.0, f64::max)).max(1e-9)
    }

    /// The cell of the first panel: the advised one, or the first.
    fn cell(&self) -> usize {
        match self.verdict {
            Verdict::Take { cell, .. } => *cell,
            _ => 0,
        }
    }

    fn titled(&self, title: &str) -> String {
        let set = self.study.cells().get(self.cell()).map_or_else(String::new, |cell| cell.set.join(", "));
        if set.is_empty() { title.into() } else { format!("{title}, {set}") }
    }

    fn drawn(&self) -> Vec<usize> {
        (0..self.study.cells().len().min(CELLS)).collect()
    }

    fn operating(&self, method: Method, palette: Palette) -> Curve {
        let (color, name) = match method {
            Method::Fcd => (palette.sensor, "Centrode"),
            Method::Jfd => (palette.force, "Forces"),
            Method::Or => (palette.ink, "Either"),
            Method::And => (palette.ink_dim, "Both"),
        };
        let stretches = stretches(&self.study.curve(self.cell(), method), |point| self.found(point));
        Curve { color, dashed: method == Method::And, name: name.into(), stretches }
    }

    fn delays(&self, cell: usize, of: usize, palette: Palette) -> Curve {
        let set = &self.study.cells()[cell].set;
        let (name, color) = if set.is_empty() {
            ("As set".to_owned(), palette.sensor)
        } else {
            (set.join(", "), member(cell as f64 / (of.max(2) - 1) as f64, false))
        };
        let stretches = stretches(&self.study.curve(cell, self.wish.method), |point| self.delay(point));
        Curve { color, dashed: false, name, stretches }
    }

    /// Value and both corners of the band in the first panel.
    fn found(&self, point: &Point) -> Option<[At; 3]> {
        let rate = point.detection?.detected;
        let alarms = point.false_alarms.rate;
        let at = |x: f64, y: f64| place(PANELS[0], [spread(x), spread(y)]);
        (rate.of > 0 && alarms.of > 0)
            .then(|| [at(alarms.rate, rate.rate), at(alarms.high, rate.low), at(alarms.low, rate.high)])
    }

    /// The same in the second.
    fn delay(&self, point: &Point) -> Option<[At; 3]> {
        let seen = point.detection?;
        let alarms = point.false_alarms.rate;
        let late = self.late();
        let open = |value: f64| if value.is_nan() { late } else { value };
        let at = |x: f64, y: f64| place(PANELS[1], [spread(x), y / late]);
        (!seen.median.is_nan() && alarms.of > 0).then(|| {
            [
                at(alarms.rate, seen.median),
                at(alarms.low, open(seen.median_low)),
                at(alarms.high, open(seen.median_high)),
            ]
        })
    }

    /// The thresholds that are set, and the one that is advised.
    fn marks<P: Paper>(&self, canvas: &mut Canvas<P>, palette: Palette) {
        let cell = self.cell();
        for method in Method::ALL {
            let own = self.study.own(cell, method).map(|level| self.study.point(cell, method, level));
            if let Some([at, ..]) = own.as_ref().and_then(|point| self.found(point)) {
                canvas.disk(at, 6.0, Color::WHITE);
                canvas.disk(at, 4.6, self.operating(method, palette).color);
            }
        }
        let method = self.wish.method;
        let own = self.study.own(cell, method).map(|level| self.study.point(cell, method, level));
        if let Some([at, ..]) = own.as_ref().and_then(|point| self.delay(point)) {
            canvas.disk(at, 6.0, Color::WHITE);
            canvas.disk(at, 4.6, palette.ink);
        }
        if let Verdict::Take { point, .. } = self.verdict {
            for [at, ..] in [self.found(point), self.delay(point)].into_iter().flatten() {
                let ring = |k: usize| {
                    let angle = std::f64::consts::TAU * k as f64 / 40.0;
                    [at[0] + 9.0 * angle.cos(), at[1] + 9.0 * angle.sin()]
                };
                let ring: Vec<At> = (0..=40).map(ring).collect();
                canvas.line(&ring, palette.detection, 2.2);
            }
        }
    }

    fn caption(&self) -> [String; 3] {
        let spec = self.study.spec();
        let (tracker, cells) = (&spec.scenario.tracker, &spec.scenario.load_cells);
        let progress = self.study.progress();
        let made = match self.partial {
            true => format!("PARTIAL: {} of {} runs", progress.done, progress.of),
            false => format!("{} repeats with contact and without", spec.repeats),
        };
        let swept = self.study.cells().iter().flat_map(|cell| &cell.set).any(|set| set.starts_with("filter.length="));
        let filter = if swept { String::new() } else { format!(", N = {}", spec.scenario.filter.length) };
        let left_out = self.study.cells().len().saturating_sub(CELLS);
        let more = if left_out > 0 { format!(" {left_out} more cells are not drawn.") } else { String::new() };
        [
            format!(
                "Simulated by Centrode, {made}: tracker noise {} mm and {:.3}°, load cell noise {} N, ε_τ = {} %{filter}; alarms more than {} s after contact are missed.",
                tracker.position_noise * 1e3,
                tracker.orientation_noise.to_degrees(),
                cells.noise,
                cells.epsilon_tau * 100.0,
                spec.late,
            ),
            format!(
                "Bands: corners of the 95 % intervals of both axes. Shares lie on an arcsine scale. Delays are those of method {}.{more}",
                self.wish.method.name()
            ),
            format!(
                "Dots: thresholds as set. Ring: soonest with at most {} % false alarms{}.",
                self.wish.false_alarm_rate * 100.0,
                if matches!(self.verdict, Verdict::Take { .. }) { "" } else { " (none reaches this)" }
            ),
        ]
    }
}

/// A point of a panel, from shares of its width and height.
fn place([left, right]: [f64; 2], [x, y]: [f64; 2]) -> At {
    [left + (right - left) * x, BOTTOM - (BOTTOM - TOP) * y.clamp(0.0, 1.0)]
}

/// The points that can be drawn, without those that repeat the one before.
fn stretches(points: &[Point], at: impl Fn(&Point) -> Option<[At; 3]>) -> Vec<Vec<[At; 3]>> {
    let mut stretches = vec![Vec::new()];
    for point in points {
        match (at(point), stretches.last_mut()) {
            (Some(at), Some(stretch)) if stretch.last() != Some(&at) => stretch.push(at),
            (None, Some(stretch)) if !stretch.is_empty() => stretches.push(Vec::new()),
            _ => {}
        }
    }
    stretches
}

fn band<P: Paper>(canvas: &mut Canvas<P>, curve: &Curve) {
    let color = Color { a: 0.14, ..curve.color };
    for stretch in curve.stretches.iter().filter(|stretch| stretch.len() > 1) {
        let outline: Vec<At> =
            stretch.iter().map(|[_, below, _]| *below).chain(stretch.iter().rev().map(|[.., above]| *above)).collect();
        canvas.fill(&outline, color);
    }
}

fn line<P: Paper>(canvas: &mut Canvas<P>, curve: &Curve) {
    for stretch in &curve.stretches {
        let points: Vec<At> = stretch.iter().map(|[at, ..]| *at).collect();
        if curve.dashed {
            canvas.dashed(&points, curve.color, 1.8, [7.0, 4.0]);
        } else {
            canvas.line(&points, curve.color, 1.8);
        }
    }
}

fn frame<P: Paper>(
    canvas: &mut Canvas<P>,
    [left, right]: [f64; 2],
    name: &str,
    marks: &[(f64, String)],
    palette: Palette,
) {
    let plain = Look::default();
    let grid = palette.ink_dim.mix(Color::WHITE, 0.78);
    for percent in percents(0.05) {
        let [x, _] = place([left, right], [spread(f64::from(percent) / 100.0), 0.0]);
        canvas.line(&[[x, TOP], [x, BOTTOM]], grid, 1.0);
        canvas.text(&percent.to_string(), [x, BOTTOM + 20.0], SMALL, palette.ink, Align::Center, plain);
    }
    for (share, text) in marks {
        let [_, y] = place([left, right], [0.0, *share]);
        canvas.line(&[[left, y], [right, y]], grid, 1.0);
        canvas.text(text, [left - 9.0, y + 4.5], SMALL, palette.ink, Align::Right, plain);
    }
    let around = [[left, TOP], [right, TOP], [right, BOTTOM], [left, BOTTOM], [left, TOP]];
    canvas.line(&around, palette.ink_dim, 1.0);
    let middle = 0.5 * (left + right);
    canvas.text(
        "Runs without contact that alarm (%)",
        [middle, BOTTOM + 43.0],
        TEXT,
        palette.ink,
        Align::Center,
        plain,
    );
    let upright = Look { bold: false, upright: true };
    canvas.text(name, [left - 48.0, 0.5 * (TOP + BOTTOM)], TEXT, palette.ink, Align::Center, upright);
}

/// Names in rows above the panel; those that find no room are left to the colours' order.
fn legend<P: Paper>(canvas: &mut Canvas<P>, [left, right]: [f64; 2], curves: &[Curve], palette: Palette) {
    let mut at = [left, 98.0];
    for curve in curves {
        let wide = 30.0 + width(&curve.name, SMALL, false) + 16.0;
        if at[0] + wide > right + 16.0 {
            if at[1] > 105.0 {
                break;
            }
            at = [left, at[1] + 18.0];
        }
        let line = [[at[0], at[1] - 4.5], [at[0] + 22.0, at[1] - 4.5]];
        if curve.dashed {
            canvas.dashed(&line, curve.color, 2.2, [7.0, 4.0]);
        } else {
            canvas.line(&line, curve.color, 2.2);
        }
        canvas.text(&curve.name, [at[0] + 28.0, at[1]], SMALL, palette.ink, Align::Left, Look::default());
        at[0] += wide;
    }
}
