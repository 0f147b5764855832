//! The axes of a panel: ranges, grid, numbers and names; the bar beside a map.

use super::{Align, Frame, Ink, Item, Look, Paint, Pen};
use crate::chart::clip::Rect;
use crate::chart::font::width;
use crate::chart::scale::Scale;
use crate::chart::ticks::{Steps, Tick, ticks};
use crate::chart::{Axis, Map, Panel};

/// Room beyond what is drawn, where no range is given, in shares of the range.
const MARGIN: f64 = 0.05;
/// The same at both ends of an axis of shares.
const SHARES: f64 = 0.04;
/// Least distances of marks along both axes, in sizes of the text.
const APART: [f64; 2] = [5.6, 2.9];
/// The same in a row of plots, whose numbers are times.
const IN_LINE: [f64; 2] = [4.4, 2.9];
/// The same on an axis of shares, whose marks are short.
const SHARES_APART: [f64; 2] = [2.3, 1.5];
/// The same on a logarithmic axis.
const LOG_APART: [f64; 2] = [3.2, 1.6];
/// Data of one scale for both axes are at most this many times as wide, against their height, as what they show, and so many.
const SPARE: f64 = 1.3;
const SQUARE: f64 = 1.6;
/// Width of a map's bar and of the space before it.
const BAR: [f64; 2] = [0.9, 0.8];

/// Ends of both axes, SI.
fn ranges(panel: &Panel) -> [[f64; 2]; 2] {
    let of = |which: usize, axis: &Axis| {
        if let Some([a, b]) = axis.range
            && a != b
        {
            return [a.min(b), a.max(b)];
        }
        let series = panel.series.iter().flat_map(|series| &series.points);
        let bands = panel.bands.iter().flat_map(|band| band.edges.iter().flatten());
        let bars = panel.bars.iter().flat_map(|bars| bars.corners.iter().flatten());
        let intervals = panel.intervals.iter().flat_map(|all| all.ends.iter().flatten());
        let values = series.chain(bands).chain(bars).chain(intervals).map(|p| p[which]);
        let (low, high) =
            values.filter(|x| x.is_finite()).fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            return [0.0, 1.0 / axis.scale];
        }
        let margin = if high > low { MARGIN * (high - low) } else { (1.0 / axis.scale).max(0.1 * high.abs()) };
        // What is never negative starts at 0.
        let floor = if low >= 0.0 && low < 0.4 * high && !panel.equal_scales { 0.0 } else { low - margin };
        [floor, high + margin]
    };
    [of(0, &panel.x), of(1, &panel.y)]
}

/// How much narrower the data's place is at both sides where one scale for both axes would leave it empty there, points.
pub(super) fn spare(panel: &Panel, data: &Rect) -> f64 {
    if !panel.equal_scales {
        return 0.0;
    }
    let [x, y] = ranges(panel).map(|[low, high]| high - low);
    let most = (SPARE * x / y).max(SQUARE) * data.height();
    (0.5 * (data.width() - most)).max(0.0)
}

/// Which value lies where in the data's place.
pub(super) fn frame(panel: &Panel, data: Rect) -> Frame {
    let mut ranges = ranges(panel);
    if panel.equal_scales {
        let sides = [data.width(), data.height()];
        let per_point = |k: usize| (ranges[k][1] - ranges[k][0]) / sides[k];
        let scale = per_point(0).max(per_point(1));
        for (range, points) in ranges.iter_mut().zip(sides) {
            let (middle, half) = (f64::midpoint(range[0], range[1]), 0.5 * scale * points);
            *range = [middle - half, middle + half];
        }
    }
    let along = |axis: &Axis, [from, to]: [f64; 2]| if axis.falling { [to, from] } else { [from, to] };
    let scale = |axis: &Axis, range, ends| match axis.steps {
        Steps::Shares => Scale::shares(SHARES, ends),
        Steps::Log => Scale::log(range, ends),
        _ => Scale::new(range, ends),
    };
    Frame {
        data,
        x: scale(&panel.x, ranges[0], along(&panel.x, [data.left, data.right])),
        y: scale(&panel.y, ranges[1], along(&panel.y, [data.bottom, data.top])),
    }
}

/// Marks of an axis at SI values.
fn marks(axis: &Axis, scale: &Scale, apart: f64) -> Vec<Tick> {
    if !axis.ticks.is_empty() {
        return axis.ticks.clone();
    }
    if axis.steps == Steps::Shares {
        return ticks(scale, apart, axis.steps);
    }
    let (shown, length) = (scale.range().map(|end| end * axis.scale), [0.0, scale.length()]);
    let shown = if axis.steps == Steps::Log { Scale::log(shown, length) } else { Scale::new(shown, length) };
    let marks = ticks(&shown, apart, axis.steps);
    marks.into_iter().map(|tick| Tick { value: tick.value / axis.scale, ..tick }).collect()
}

/// Marks that are given, every second or third where they would touch.
fn sparse(marks: Vec<Tick>, scale: &Scale, t: f64, given: bool) -> Vec<Tick> {
    let widest = marks.iter().map(|tick| width(&tick.text, t, false)).fold(0.0, f64::max) + 0.5 * t;
    if !given || marks.len() < 2 {
        return marks;
    }
    let apart = (scale.at(marks[1].value) - scale.at(marks[0].value)).abs();
    let every = libm::ceil(widest / apart.max(1e-9)).clamp(1.0, marks.len() as f64) as usize;
    marks.into_iter().skip((every - 1) / 2).step_by(every).collect()
}

impl Pen<'_> {
    fn marks_of(&self, axis: &Axis, scale: &Scale, which: usize) -> Vec<Tick> {
        let apart = match axis.steps {
            Steps::Shares => SHARES_APART,
            Steps::Log => LOG_APART,
            _ if self.page.sides.is_some() => IN_LINE,
            _ => APART,
        };
        let marks = marks(axis, scale, apart[which] * self.t);
        if which == 0 { sparse(marks, scale, self.t, !axis.ticks.is_empty()) } else { marks }
    }

    fn widest(&self, marks: &[Tick]) -> f64 {
        marks.iter().map(|tick| width(&tick.text, self.t, false)).fold(0.0, f64::max)
    }

    /// Room at the left of the data, for the numbers and the name of the vertical axis.
    pub(super) fn gutter(&self, panel: &Panel, data: &Rect) -> f64 {
        let frame = frame(panel, *data);
        let name = if self.stands_upright(panel, data) && !panel.y.name.is_empty() { 1.7 } else { 0.2 };
        self.widest(&self.marks_of(&panel.y, &frame.y, 1)) + (0.7 + name) * self.t
    }

    /// Whether the name of the vertical axis has room to read upward; else it stands above the axis.
    pub(super) fn stands_upright(&self, panel: &Panel, data: &Rect) -> bool {
        width(&panel.y.title(), 1.07 * self.t, false) <= data.height()
    }

    /// Spans, grid, numbers, names and the frame.
    pub(super) fn axes(&mut self, panel: &Panel, place: Rect, frame: &Frame) {
        let (t, data) = (self.t, frame.data);
        let grid = panel.map.is_none();
        let in_line = self.page.sides.is_some();
        let ink = if in_line { Ink::Dim } else { Ink::Text };
        for span in &panel.spans {
            let ends = span.ends.map(|end| frame.x.at(end).max(data.left).min(data.right));
            let top = if span.low { data.bottom - 0.38 * t } else { data.top };
            let rect = Rect { left: ends[0].min(ends[1]), right: ends[0].max(ends[1]), top, ..data };
            let opacity = if span.low { 1.0 } else { super::data::SHADE };
            self.add(Item::Fill(rect, Paint { ink: Ink::Role(span.role), opacity }));
        }
        let marks = self.marks_of(&panel.x, &frame.x, 0);
        let last = marks.len().saturating_sub(1);
        for (k, tick) in marks.into_iter().enumerate() {
            let x = frame.x.at(tick.value);
            if grid && panel.x.ticks.is_empty() {
                self.line(&[[x, data.top], [x, data.bottom]], Ink::Grid, 0.07 * t, None);
            }
            if panel.x.bare {
                continue;
            }
            self.line(&[[x, data.bottom], [x, data.bottom + 0.35 * t]], Ink::Dim, 0.08 * t, None);
            // Where the axis has no name, its last number has the unit.
            let text = if in_line && k == last { format!("{} {}", tick.text, panel.x.unit) } else { tick.text };
            let half = 0.5 * width(&text, t, false);
            let x = if in_line { x.min(place.right - half) } else { x };
            self.text(&text, [x, data.bottom + 1.1 * t], Look { align: Align::Center, ink, ..Look::PLAIN });
        }
        if grid {
            for pair in panel.y.ticks.windows(2) {
                let y = frame.y.at(f64::midpoint(pair[0].value, pair[1].value));
                self.line(&[[data.left, y], [data.right, y]], Ink::Grid, 0.07 * t, None);
            }
        }
        for tick in self.marks_of(&panel.y, &frame.y, 1) {
            let y = frame.y.at(tick.value);
            if grid && panel.y.ticks.is_empty() {
                self.line(&[[data.left, y], [data.right, y]], Ink::Grid, 0.07 * t, None);
            }
            if panel.y.ticks.is_empty() && !in_line {
                self.line(&[[data.left - 0.35 * t, y], [data.left, y]], Ink::Dim, 0.08 * t, None);
            }
            let at = [data.left - if in_line { 0.5 } else { 0.65 } * t, y];
            self.text(&tick.text, at, Look { align: Align::Right, ink, ..Look::PLAIN });
        }
        if in_line {
            self.line(&[[data.left, data.bottom], [data.right, data.bottom]], Ink::Dim, 0.08 * t, None);
            return;
        }
        let name = Look { size: 1.07 * t, align: Align::Center, ..Look::PLAIN };
        let [middle, height] = data.center();
        // A name that is wider than the data ends with the panel.
        let half = 0.5 * width(&panel.x.title(), 1.07 * t, false);
        let x = middle.min(place.right - half).max(place.left + half);
        self.text(&panel.x.title(), [x, data.bottom + 2.65 * t], name);
        if self.stands_upright(panel, &data) {
            let at = [place.left + 0.6 * t, height];
            self.text(&panel.y.title(), at, Look { upright: true, ..name });
        } else {
            let at = [place.left, data.top - 0.9 * t];
            self.text(&panel.y.title(), at, Look { align: Align::Left, ..name });
        }
        self.frame(data);
    }

    /// The line around a rectangle.
    fn frame(&mut self, Rect { left, top, right, bottom }: Rect) {
        let around = [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
        self.line(&around, Ink::Dim, 0.08 * self.t, None);
    }

    fn bar_axis(map: &Map, ends: [f64; 2]) -> Scale {
        let [a, b] = map.ends;
        Scale::new([a.min(b), a.max(b)], ends)
    }

    fn bar_marks(&self, map: &Map, scale: &Scale) -> Vec<Tick> {
        marks(&Axis::new("", "", map.unit, map.scale), scale, APART[1] * self.t)
    }

    /// Room for the bar and its numbers.
    pub(super) fn bar_room(&self, panel: &Panel) -> f64 {
        let Some(map) = &panel.map else { return 0.0 };
        // The numbers' widths do not depend on where they stand, only on how many there are.
        let marks = self.bar_marks(map, &Self::bar_axis(map, [0.0, 20.0 * self.t]));
        (BAR[0] + BAR[1] + 0.9) * self.t + self.widest(&marks).max(width(map.unit, self.t, false) - 1.3 * self.t)
    }

    /// The bar that says what a map's colours mean.
    pub(super) fn bar(&mut self, map: &Map, frame: &Frame) {
        const PIECES: usize = 64;
        let (t, data) = (self.t, frame.data);
        let bar = Rect { left: data.right + BAR[1] * t, right: data.right + (BAR[0] + BAR[1]) * t, ..data };
        let scale = Self::bar_axis(map, [bar.bottom, bar.top]);
        let [low, high] = scale.range();
        for k in 0..PIECES {
            let value = |share: f64| low + (high - low) * share;
            let [from, to] = [k, k + 1].map(|k| scale.at(value(k as f64 / PIECES as f64)));
            let share = map.share(value((k as f64 + 0.5) / PIECES as f64));
            // A hair of overlap, so that no seam shows.
            let piece = Rect { top: to, bottom: (from + 0.04 * t).min(bar.bottom), ..bar };
            self.add(Item::Fill(piece, Ink::Map(share).into()));
        }
        for tick in self.bar_marks(map, &scale) {
            let y = scale.at(tick.value);
            self.line(&[[bar.right, y], [bar.right + 0.3 * t, y]], Ink::Dim, 0.08 * t, None);
            self.text(&tick.text, [bar.right + 0.55 * t, y], Look::PLAIN);
        }
        self.text(map.unit, [bar.left, bar.top - 0.95 * t], Look { ink: Ink::Dim, ..Look::PLAIN });
        if let Some(level) = map.level.filter(|level| scale.holds(*level)) {
            let y = scale.at(level);
            let line = [[bar.left - 0.2 * t, y], [bar.right + 0.2 * t, y]];
            self.line(&line, Paint { ink: Ink::Black, opacity: super::data::VEIL }, 0.27 * t, None);
            self.line(&line, Ink::White, 0.14 * t, None);
        }
    }
}
