//! What stands between the axes: map, bands, curves and marks.

use super::{Align, Form, Frame, Ink, Item, Look, Paint, Pen};
use crate::chart::clip::{Rect, Spot};
use crate::chart::decimate::{Column, columns, spans};
use crate::chart::font::width;
use crate::chart::{Intervals, Map, Panel, Role, Series, Style, Vertical};
use libm::hypot;

/// Opacity of a shaded span, of a band, and of what parts white from a map.
pub(super) const SHADE: f64 = 0.16;
const BAND: f64 = 0.15;
pub(super) const VEIL: f64 = 0.55;
/// Opacity of a curve that stands back, and of its band.
const FAINT: f64 = 0.6;
/// The same in a row of plots, whose curves are rough.
const PALE: f64 = 0.4;
/// Marks of one row stand at least this far apart, in sizes of the text.
const CROWDED: f64 = 0.87;
/// A curve with this many points to a column of pixels is drawn by its columns.
const MANY: f64 = 4.0;
/// Points of a curve nearer than this to the one before say nothing new.
const SAME: f64 = 0.004;

impl Pen<'_> {
    /// A mark of a role, with its edge.
    pub(super) fn mark(&mut self, at: Spot, form: Form, role: Role, edge: Ink) {
        let radius = match form {
            Form::Triangle => 0.43,
            Form::Circle => 0.3,
            Form::Dot => 0.34,
            Form::Ring => 0.62,
            Form::Diamond => 0.46,
        };
        self.add(Item::Mark(at, form, radius * self.t, Ink::Role(role).into(), edge));
    }

    /// The cells of a map and its level line.
    pub(super) fn map(&mut self, map: &Map, frame: &Frame) {
        let (x, y) = (map.x.map(|x| frame.x.at(x)), map.y.map(|y| frame.y.at(y)));
        let rect = Rect { left: x[0].min(x[1]), right: x[0].max(x[1]), top: y[0].min(y[1]), bottom: y[0].max(y[1]) };
        self.add(Item::Map(rect, self.k));
        let line = joined(&map.line);
        for (wide, paint) in [(0.3, Paint { ink: Ink::Black, opacity: VEIL }), (0.15, Ink::White.into())] {
            for piece in &line {
                let points: Vec<Spot> = piece.iter().map(|point| frame.at(*point)).collect();
                for part in frame.data.inside(&points) {
                    self.line(&part, paint, wide * self.t, None);
                }
            }
        }
    }

    /// Bands, series and verticals.
    pub(super) fn data(&mut self, panel: &Panel, frame: &Frame) {
        let edge = if panel.map.is_some() { Ink::White } else { Ink::Ground };
        for band in &panel.bands {
            let paint = Paint { ink: Ink::Role(band.role), opacity: if band.faint { FAINT * BAND } else { BAND } };
            let gap = |edges: &[[f64; 2]; 2]| edges.iter().flatten().any(|value| value.is_nan());
            for stretch in band.edges.split(gap).filter(|stretch| stretch.len() > 1) {
                let place = |edges: &[Spot; 2]| edges.map(|point| frame.data.nearest(frame.at(point)));
                let mut edges: Vec<[Spot; 2]> = stretch.iter().map(place).collect();
                edges.dedup();
                self.add(Item::Band(edges, paint));
            }
        }
        for bars in &panel.bars {
            for corners in &bars.corners {
                let [a, b] = corners.map(|corner| frame.data.nearest(frame.at(corner)));
                let (left, right) = (a[0].min(b[0]), a[0].max(b[0]));
                // A hair between neighbours, where there is room for it.
                let gap = (0.1 * (right - left)).min(0.05 * self.t);
                let (top, bottom) = (a[1].min(b[1]), a[1].max(b[1]));
                let rect = Rect { left: left + gap, right: right - gap, top, bottom };
                self.add(Item::Fill(rect, Ink::Role(bars.role).into()));
            }
        }
        self.all_series(&panel.series, frame, edge);
        for intervals in &panel.intervals {
            self.intervals(intervals, frame, edge);
        }
        if panel.off_scale {
            panel.series.iter().for_each(|series| self.off_scale(series, frame));
        }
        for vertical in &panel.verticals {
            let x = frame.x.at(vertical.x);
            if (frame.data.left..=frame.data.right).contains(&x) {
                let line = [[x, frame.data.top], [x, frame.data.bottom]];
                let dash = Vertical::style(vertical.role).dash().map(|dash| dash.map(|length| 0.92 * length * self.t));
                self.line(&line, Ink::Role(vertical.role), 0.12 * self.t, dash);
            }
        }
    }

    /// Curves and rows of marks, in their order.
    pub(super) fn all_series(&mut self, all: &[Series], frame: &Frame, edge: Ink) {
        for series in all {
            if let Some(stretches) = self.dense(series, frame) {
                stretches.iter().for_each(|stretch| self.stretch(series, stretch, frame));
                continue;
            }
            let gap = |point: &[f64; 2]| point.iter().any(|value| !value.is_finite());
            for stretch in series.points.split(gap).filter(|stretch| !stretch.is_empty()) {
                let points: Vec<Spot> = stretch.iter().map(|point| frame.at(*point)).collect();
                self.series(series, &points, frame, edge);
            }
        }
    }

    /// The columns of pixels of a curve that has many more points than there are columns; heights are places, points.
    fn dense(&self, series: &Series, frame: &Frame) -> Option<Vec<Vec<Column>>> {
        let line = series.style.is_line();
        let many = series.points.len() as f64 > MANY * frame.data.width() / self.page.pixel;
        let rises = || series.points.windows(2).all(|pair| pair[0][0] <= pair[1][0]);
        (line && many && rises()).then(|| self.columns(series, frame))
    }

    fn columns(&self, series: &Series, frame: &Frame) -> Vec<Vec<Column>> {
        let place = |&[x, y]: &[f64; 2]| (x, frame.y.at(y));
        columns(series.points.iter().map(place), &frame.x, self.page.pixel)
    }

    /// An unbroken stretch of columns as a line.
    fn stretch(&mut self, series: &Series, stretch: &[Column], frame: &Frame) {
        let pixel = self.page.pixel;
        let mut points: Vec<Spot> = Vec::with_capacity(2 * stretch.len());
        for column in stretch {
            // Less than a pixel of spread is one point: fewer to draw, and smoother.
            if column.high - column.low < pixel {
                points.push([column.x, f64::midpoint(column.low, column.high)]);
            } else {
                points.extend(column.values().map(|y| [column.x, y]));
            }
        }
        if let [[x, y]] = points[..] {
            points = vec![[x - 0.5 * pixel, y], [x + 0.5 * pixel, y]];
        }
        self.curve(series, &points, frame);
    }

    fn curve(&mut self, series: &Series, points: &[Spot], frame: &Frame) {
        let t = self.t;
        let faint = if self.page.sides.is_some() { PALE } else { FAINT };
        let paint = Paint { ink: Ink::Role(series.role), opacity: if series.faint { faint } else { 1.0 } };
        let wide = match series.style {
            Style::Heavy => 0.27 * t,
            Style::Thin => 0.1 * t,
            Style::Dashed if self.page.sides.is_some() => 0.09 * t,
            _ if series.faint => 0.1 * t,
            _ => 0.13 * t,
        };
        let dash = series.style.dash().map(|dash| dash.map(|length| length * t));
        for part in frame.data.inside(points) {
            self.line(&part, paint, wide, dash);
        }
    }

    /// Marks with their ends.
    fn intervals(&mut self, intervals: &Intervals, frame: &Frame, edge: Ink) {
        let t = self.t;
        let ink = Ink::Role(intervals.role);
        for [from, mark, to] in &intervals.ends {
            if [from, to].into_iter().flatten().all(|value| value.is_finite()) {
                let [a, b] = [from, to].map(|end| frame.data.nearest(frame.at(*end)));
                self.line(&[a, b], ink, 0.12 * t, None);
                // Bars at both ends, across the interval.
                let long = hypot(b[0] - a[0], b[1] - a[1]).max(1e-9);
                let across = [(a[1] - b[1]) / long, (b[0] - a[0]) / long].map(|share| 0.24 * t * share);
                for [x, y] in [a, b] {
                    self.line(&[[x - across[0], y - across[1]], [x + across[0], y + across[1]]], ink, 0.12 * t, None);
                }
            }
            if mark.iter().all(|value| value.is_finite()) && frame.data.holds(frame.at(*mark)) {
                self.mark(frame.at(*mark), Form::Dot, intervals.role, edge);
            }
        }
    }

    /// Says along the upper edge where a curve lies beyond it.
    fn off_scale(&mut self, series: &Series, frame: &Frame) {
        if series.style != Style::Line || series.faint {
            return;
        }
        let (t, data) = (self.t, frame.data);
        let ink = Ink::Role(series.role);
        for (from, to) in spans(&self.columns(series, frame), |column| column.low < data.top) {
            let half = 0.5 * self.page.pixel;
            let (left, right) = ((from - half).max(data.left), (to + half).min(data.right));
            let bar = Rect { left, right, top: data.top, bottom: data.top + 0.3 * t };
            self.add(Item::Fill(bar, Paint { ink, opacity: 0.45 }));
            if to - from > 0.8 * t {
                let at = [f64::midpoint(from, to), data.top + 0.72 * t];
                self.add(Item::Mark(at, Form::Triangle, 0.4 * t, ink.into(), ink));
            }
        }
    }

    fn series(&mut self, series: &Series, points: &[Spot], frame: &Frame, edge: Ink) {
        let t = self.t;
        let form = match series.style {
            style if style.is_line() => {
                self.curve(series, &thinned(points, SAME * t), frame);
                return;
            }
            Style::Triangles => Form::Triangle,
            Style::Circles => Form::Circle,
            Style::Dots | Style::Targets => Form::Dot,
            Style::Rings => Form::Ring,
            _ => Form::Diamond,
        };
        let mut last: Option<Spot> = None;
        for &at in points.iter().filter(|at| frame.data.holds(**at)) {
            // Marks on top of each other say less than marks apart.
            if !series.every && last.is_some_and(|last| hypot(last[0] - at[0], last[1] - at[1]) < CROWDED * t) {
                continue;
            }
            if series.style == Style::Targets {
                let Rect { left, top, right, bottom } = frame.data;
                for (wide, paint) in [(0.2, Paint { ink: Ink::Black, opacity: 0.5 * VEIL }), (0.08, Ink::White.into())]
                {
                    self.line(&[[left, at[1]], [right, at[1]]], paint, wide * t, None);
                    self.line(&[[at[0], top], [at[0], bottom]], paint, wide * t, None);
                }
            }
            if form == Form::Ring && edge == Ink::White {
                // On a map no one colour stands out everywhere.
                let dark = Paint { ink: Ink::Black, opacity: VEIL };
                self.add(Item::Mark(at, form, 0.69 * t, dark, edge));
                self.add(Item::Mark(at, form, 0.6 * t, Ink::White.into(), edge));
            } else {
                self.mark(at, form, series.role, edge);
            }
            last = Some(at);
        }
    }

    /// Room for the words at the right of the data.
    pub(super) fn aside_room(&self, panel: &Panel) -> f64 {
        let lines = panel.asides.iter().flat_map(|aside| &aside.lines);
        let widest = lines.map(|line| width(line, self.t, false)).fold(0.0, f64::max);
        if widest > 0.0 { widest + 0.4 * self.t } else { 0.0 }
    }

    /// Words at the right of the data, as many lines as stand clear of the next.
    pub(super) fn asides(&mut self, panel: &Panel, frame: &Frame) {
        let t = self.t;
        let step = 1.27 * t;
        let fits = ((frame.data.height() / (step * panel.asides.len().max(1) as f64)) as usize).max(1);
        for aside in &panel.asides {
            let lines = &aside.lines[..aside.lines.len().min(fits)];
            for (k, line) in lines.iter().enumerate() {
                let down = step * (k as f64 - 0.5 * (lines.len() as f64 - 1.0));
                let at = [frame.data.right + 0.7 * t, frame.y.at(aside.y) + down];
                let ink = if k == 0 { Ink::Text } else { Ink::Dim };
                self.text(line, at, Look { ink, ..Look::PLAIN });
            }
        }
    }

    /// Named places at the right end of the vertical axis.
    pub(super) fn rungs(&mut self, panel: &Panel, frame: &Frame) {
        let (t, data) = (self.t, frame.data);
        // Names that would touch are left to the strokes.
        let named = data.height() > 1.4 * t * panel.rungs.len() as f64;
        for rung in panel.rungs.iter().filter(|rung| frame.y.holds(rung.y)) {
            let y = frame.y.at(rung.y);
            self.line(&[[data.right - 0.6 * t, y], [data.right, y]], Ink::White, 0.12 * t, None);
            if named {
                let half = 0.62 * t;
                let middle = y.max(data.top + half).min(data.bottom - half);
                let right = data.right - 0.9 * t;
                let left = right - width(&rung.name, 0.85 * t, false);
                let behind =
                    Rect { left: left - 0.3 * t, right: right + 0.3 * t, top: middle - half, bottom: middle + half };
                self.add(Item::Fill(behind, Paint { ink: Ink::Black, opacity: VEIL }));
                let look = Look { size: 0.85 * t, ink: Ink::White, align: Align::Right, ..Look::PLAIN };
                self.text(&rung.name, [right, middle], look);
            }
        }
    }
}

/// Points without those that lie on the one before; both ends stay.
fn thinned(points: &[Spot], same: f64) -> Vec<Spot> {
    let mut kept: Vec<Spot> = Vec::with_capacity(points.len());
    for (k, point) in points.iter().enumerate() {
        let near = |last: &Spot| (last[0] - point[0]).abs() < same && (last[1] - point[1]).abs() < same;
        if k + 1 == points.len() || !kept.last().is_some_and(near) {
            kept.push(*point);
        }
    }
    kept
}

/// Pieces of a level line as lines: pieces that follow each other are joined.
fn joined(pieces: &[[Spot; 2]]) -> Vec<Vec<Spot>> {
    let mut lines: Vec<Vec<Spot>> = Vec::new();
    for [a, b] in pieces {
        match lines.last_mut() {
            Some(line) if line.last() == Some(a) => line.push(*b),
            _ => lines.push(vec![*a, *b]),
        }
    }
    lines
}
