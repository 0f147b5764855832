//! What stands between the axes: map, bands, curves and marks.

use super::{Align, Form, Frame, Ink, Item, Look, Paint, Pen};
use crate::chart::clip::{Rect, Spot};
use crate::chart::font::width;
use crate::chart::{Map, Panel, Role, Series, Style};
use libm::hypot;

/// Opacity of a shaded span, of a band, and of what parts white from a map.
pub(super) const SHADE: f64 = 0.16;
const BAND: f64 = 0.15;
pub(super) const VEIL: f64 = 0.55;
/// Opacity of a curve that stands back, and of its band.
const FAINT: f64 = 0.6;
/// Marks of one row stand at least this far apart, in sizes of the text.
const CROWDED: f64 = 0.87;
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
        for series in &panel.series {
            let gap = |point: &[f64; 2]| point.iter().any(|value| !value.is_finite());
            for stretch in series.points.split(gap).filter(|stretch| !stretch.is_empty()) {
                let points: Vec<Spot> = stretch.iter().map(|point| frame.at(*point)).collect();
                self.series(series, &points, frame, edge);
            }
        }
        for vertical in &panel.verticals {
            let x = frame.x.at(vertical.x);
            if (frame.data.left..=frame.data.right).contains(&x) {
                let line = [[x, frame.data.top], [x, frame.data.bottom]];
                self.line(&line, Ink::Role(vertical.role), 0.12 * self.t, Some([0.46 * self.t, 0.3 * self.t]));
            }
        }
    }

    fn series(&mut self, series: &Series, points: &[Spot], frame: &Frame, edge: Ink) {
        let t = self.t;
        let opacity = if series.faint { FAINT } else { 1.0 };
        let paint = Paint { ink: Ink::Role(series.role), opacity };
        let wide = if series.faint { 0.1 * t } else { 0.13 * t };
        let form = match series.style {
            Style::Line | Style::Dashed => {
                let dash = (series.style == Style::Dashed).then_some([0.5 * t, 0.32 * t]);
                for part in frame.data.inside(&thinned(points, SAME * t)) {
                    self.line(&part, paint, wide, dash);
                }
                return;
            }
            Style::Triangles => Form::Triangle,
            Style::Circles => Form::Circle,
            Style::Dots | Style::Targets => Form::Dot,
            Style::Rings => Form::Ring,
        };
        let mut last: Option<Spot> = None;
        for &at in points.iter().filter(|at| frame.data.holds(**at)) {
            // Marks on top of each other say less than marks apart.
            if last.is_some_and(|last| hypot(last[0] - at[0], last[1] - at[1]) < CROWDED * t) {
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
