//! Draws one of the paper's figures: title, legend above the data, axes with units, caption below.

use super::canvas::{Align, Canvas, Look, Paper, Point, width};
use super::ticks::{ranges, ticks};
use super::{Drawing, Format, bytes};
use crate::scene::Color;
use crate::scene::colormap::member;
use crate::scene::palette::Palette;
use centrode_core::study::figure::{Axis, Figure, Mark, Role, Style};

const PAGE: [f64; 2] = [1200.0, 820.0];
/// Space at the sides.
const SIDE: f64 = 40.0;
/// Left end of the data: left of it stand the numbers and the axis' name.
const LEFT: f64 = 104.0;
const RIGHT: f64 = PAGE[0] - SIDE;
const TITLE: f64 = 21.0;
const TEXT: f64 = 15.0;
const SMALL: f64 = 13.5;
/// Height of a line of the legend, and of the caption.
const LINE: f64 = 21.0;
/// Marks stand at least this far apart.
const CROWDED: f64 = 13.0;

/// A figure as a file's bytes.
pub fn figure(figure: &Figure, format: Format) -> Result<Vec<u8>, String> {
    bytes(&OnPage { figure, palette: Palette::LIGHT }, format)
}

struct OnPage<'a> {
    figure: &'a Figure,
    palette: Palette,
}

/// How an entry of the legend looks.
#[derive(Clone, Copy, PartialEq)]
enum Sign {
    Series(Style),
    Vertical,
    Span,
}

/// Where values lie on the page.
struct Frame {
    /// Left, top, right, bottom of the data.
    data: [f64; 4],
    /// Ends of both axes, as shown.
    ranges: [[f64; 2]; 2],
}

impl Frame {
    /// In `space`; with equal scales the data is as high and as wide as its ranges ask for.
    fn new(figure: &Figure, space: [f64; 4]) -> Self {
        let ranges = ranges(figure);
        let [left, top, right, bottom] = space;
        let (mut wide, mut high) = (right - left, bottom - top);
        if figure.equal_scales {
            let scale = ranges.map(|[low, high]| (high - low).abs());
            let points = (wide / scale[0]).min(high / scale[1]);
            (wide, high) = (points * scale[0], points * scale[1]);
        }
        let middle = 0.5 * (left + right);
        Self { data: [middle - 0.5 * wide, top, middle + 0.5 * wide, top + high], ranges }
    }

    fn x(&self, shown: f64) -> f64 {
        let ([low, high], [left, _, right, _]) = (self.ranges[0], self.data);
        left + (right - left) * (shown - low) / (high - low)
    }

    fn y(&self, shown: f64) -> f64 {
        let ([low, high], [_, top, _, bottom]) = (self.ranges[1], self.data);
        bottom - (bottom - top) * (shown - low) / (high - low)
    }

    fn holds(&self, [x, y]: Point) -> bool {
        let [left, top, right, bottom] = self.data;
        (left - 0.5..=right + 0.5).contains(&x) && (top - 0.5..=bottom + 0.5).contains(&y)
    }

    /// The part of a stretch between two points that lies inside (Liang and Barsky).
    fn clipped(&self, a: Point, b: Point) -> Option<[Point; 2]> {
        let [left, top, right, bottom] = self.data;
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for (step, room) in [(-dx, a[0] - left), (dx, right - a[0]), (-dy, a[1] - top), (dy, bottom - a[1])] {
            if step == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if step < 0.0 {
                from = from.max(room / step);
            } else {
                to = to.min(room / step);
            }
        }
        (from <= to).then(|| [from, to].map(|share| [a[0] + share * dx, a[1] + share * dy]))
    }

    /// The parts of a line that lie inside.
    fn inside(&self, line: &[Point]) -> Vec<Vec<Point>> {
        let mut parts: Vec<Vec<Point>> = Vec::new();
        for pair in line.windows(2) {
            let Some([a, b]) = self.clipped(pair[0], pair[1]) else { continue };
            match parts.last_mut() {
                Some(part) if part.last() == Some(&a) => part.push(b),
                _ => parts.push(vec![a, b]),
            }
        }
        parts
    }
}

impl Drawing for OnPage<'_> {
    const SIZE: [u32; 2] = [PAGE[0] as u32, PAGE[1] as u32];

    fn draw<P: Paper>(&self, canvas: &mut Canvas<P>) {
        let (figure, ink) = (self.figure, self.palette.ink);
        canvas.rectangle([0.0, 0.0, PAGE[0], PAGE[1]], Color::WHITE);
        let bold = Look { bold: true, upright: false };
        canvas.text(&figure.title, [SIDE, 46.0], TITLE, ink, Align::Left, bold);
        let legend = self.legend(canvas, 78.0);
        let caption = lines(&figure.caption, SMALL, PAGE[0] - 2.0 * SIDE);
        let foot = PAGE[1] - 22.0 - (caption.len() as f64 - 1.0) * (LINE - 2.0);
        for (k, line) in caption.iter().enumerate() {
            let at = [SIDE, foot + k as f64 * (LINE - 2.0)];
            canvas.text(line, at, SMALL, self.palette.ink_dim, Align::Left, Look::default());
        }
        let frame = Frame::new(figure, [LEFT, legend + 6.0, RIGHT, foot - 88.0]);
        self.axes(canvas, &frame);
        self.data(canvas, &frame);
        let [left, top, right, bottom] = frame.data;
        let around = [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
        canvas.line(&around, self.palette.ink_dim, 1.2);
    }
}

impl OnPage<'_> {
    fn color(&self, role: Role) -> Color {
        match role {
            Role::Model => self.palette.model,
            Role::Constrained => self.palette.constrained,
            Role::Sensor => self.palette.sensor,
            Role::Force => self.palette.force,
            Role::Bound => self.palette.ink,
            Role::Robot => self.palette.ink_dim,
            Role::Member(share) => member(share, false),
        }
    }

    fn mark(&self, mark: Mark) -> Color {
        match mark {
            Mark::Detection => self.palette.detection,
            Mark::Contact => self.palette.stone,
        }
    }

    /// Entries in rows from `top` on; returns where they end.
    fn legend<P: Paper>(&self, canvas: &mut Canvas<P>, top: f64) -> f64 {
        let figure = self.figure;
        let series = figure.series.iter().map(|s| (Sign::Series(s.style), self.color(s.role), s.name.as_str()));
        let verticals = figure.verticals.iter().map(|v| (Sign::Vertical, self.mark(v.mark), v.name));
        let spans = figure.spans.iter().map(|s| (Sign::Span, self.shade(), s.name));
        let mut entries: Vec<(Sign, Color, &str)> = Vec::new();
        for entry in series.chain(verticals).chain(spans) {
            if !entry.2.is_empty() && !entries.contains(&entry) {
                entries.push(entry);
            }
        }
        let mut at = [SIDE, top];
        for (sign, color, name) in entries {
            let wide = 46.0 + width(name, TEXT, false) + 24.0;
            if at[0] + wide > RIGHT + 24.0 && at[0] > SIDE {
                at = [SIDE, at[1] + LINE];
            }
            self.sign(canvas, sign, color, [at[0] + 17.0, at[1] - 5.0]);
            canvas.text(name, [at[0] + 44.0, at[1]], TEXT, self.palette.ink, Align::Left, Look::default());
            at[0] += wide;
        }
        at[1] + LINE * 0.5
    }

    fn shade(&self) -> Color {
        self.palette.ink_dim.mix(Color::WHITE, 0.82)
    }

    fn sign<P: Paper>(&self, canvas: &mut Canvas<P>, sign: Sign, color: Color, [x, y]: Point) {
        let line = [[x - 17.0, y], [x + 17.0, y]];
        match sign {
            Sign::Series(Style::Line) => canvas.line(&line, color, 2.4),
            Sign::Series(Style::Dashed) | Sign::Vertical => canvas.dashed(&line, color, 2.0, [7.0, 4.5]),
            Sign::Series(Style::Triangles) => triangle(canvas, [x, y], color),
            Sign::Series(Style::Circles) => circle(canvas, [x, y], color),
            Sign::Span => canvas.rectangle([x - 17.0, y - 7.0, x + 17.0, y + 7.0], color),
        }
    }

    fn axes<P: Paper>(&self, canvas: &mut Canvas<P>, frame: &Frame) {
        let [left, top, right, bottom] = frame.data;
        let (ink, plain) = (self.palette.ink, Look::default());
        for span in &self.figure.spans {
            let ends = span.ends.map(|end| frame.x(end * self.figure.x.scale).clamp(left, right));
            canvas.rectangle([ends[0].min(ends[1]), top, ends[0].max(ends[1]), bottom], self.shade());
        }
        let grid = self.palette.ink_dim.mix(Color::WHITE, 0.78);
        for (value, text) in ticks(frame.ranges[0], self.figure.x.unit) {
            let x = frame.x(value);
            canvas.line(&[[x, top], [x, bottom]], grid, 1.0);
            canvas.line(&[[x, bottom], [x, bottom + 6.0]], self.palette.ink_dim, 1.2);
            canvas.text(&text, [x, bottom + 23.0], TEXT, ink, Align::Center, plain);
        }
        for (value, text) in ticks(frame.ranges[1], self.figure.y.unit) {
            let y = frame.y(value);
            canvas.line(&[[left, y], [right, y]], grid, 1.0);
            canvas.line(&[[left - 6.0, y], [left, y]], self.palette.ink_dim, 1.2);
            canvas.text(&text, [left - 11.0, y + 5.0], TEXT, ink, Align::Right, plain);
        }
        let name = named(&self.figure.x);
        canvas.text(&name, [0.5 * (left + right), bottom + 50.0], TEXT + 1.0, ink, Align::Center, plain);
        let upright = Look { bold: false, upright: true };
        let name = named(&self.figure.y);
        canvas.text(&name, [left - 58.0, 0.5 * (top + bottom)], TEXT + 1.0, ink, Align::Center, upright);
    }

    fn data<P: Paper>(&self, canvas: &mut Canvas<P>, frame: &Frame) {
        let figure = self.figure;
        let [_, top, _, bottom] = frame.data;
        for series in &figure.series {
            let color = self.color(series.role);
            for stretch in series.points.split(|point| point.iter().any(|v| !v.is_finite())) {
                let place = |p: &Point| [frame.x(p[0] * figure.x.scale), frame.y(p[1] * figure.y.scale)];
                let line: Vec<Point> = stretch.iter().map(place).collect();
                match series.style {
                    Style::Line => frame.inside(&line).iter().for_each(|part| canvas.line(part, color, 1.8)),
                    Style::Dashed => {
                        frame.inside(&line).iter().for_each(|part| canvas.dashed(part, color, 1.8, [8.0, 5.0]));
                    }
                    Style::Triangles | Style::Circles => {
                        let mut last: Option<Point> = None;
                        for at in line.into_iter().filter(|at| frame.holds(*at)) {
                            if last.is_none_or(|[x, y]| (x - at[0]).hypot(y - at[1]) > CROWDED) {
                                if series.style == Style::Circles {
                                    circle(canvas, at, color)
                                } else {
                                    triangle(canvas, at, color)
                                }
                                last = Some(at);
                            }
                        }
                    }
                }
            }
        }
        for vertical in &figure.verticals {
            let x = frame.x(vertical.x * figure.x.scale);
            if frame.holds([x, top]) {
                canvas.dashed(&[[x, top], [x, bottom]], self.mark(vertical.mark), 1.6, [7.0, 4.5]);
            }
        }
    }
}

fn triangle<P: Paper>(canvas: &mut Canvas<P>, [x, y]: Point, color: Color) {
    let outline = |r: f64| [[x, y - r], [x + 0.87 * r, y + 0.6 * r], [x - 0.87 * r, y + 0.6 * r]];
    canvas.fill(&outline(8.0), Color::WHITE);
    canvas.fill(&outline(6.4), color);
}

fn circle<P: Paper>(canvas: &mut Canvas<P>, at: Point, color: Color) {
    canvas.disk(at, 5.6, color);
    canvas.disk(at, 3.4, Color::WHITE);
}

fn named(axis: &Axis) -> String {
    if axis.unit == "1" { axis.name.into() } else { format!("{} ({})", axis.name, axis.unit) }
}

/// Text in lines of at most a width.
fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.last().map_or("", String::as_str);
        let longer = if last.is_empty() { word.to_owned() } else { format!("{last} {word}") };
        if last.is_empty() || width(&longer, size, false) <= most {
            lines.pop();
            lines.push(longer);
        } else {
            lines.push(word.into());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_edge_of_the_data() {
        let frame = Frame { data: [0.0, 0.0, 10.0, 10.0], ranges: [[0.0, 1.0], [0.0, 1.0]] };
        let parts = frame.inside(&[[-5.0, 5.0], [5.0, 5.0], [5.0, 20.0], [8.0, 20.0], [8.0, 5.0]]);
        assert_eq!(parts, vec![vec![[0.0, 5.0], [5.0, 5.0], [5.0, 10.0]], vec![[8.0, 10.0], [8.0, 5.0]]]);
        assert_eq!(frame.inside(&[[-1.0, -1.0], [-5.0, 30.0]]), Vec::<Vec<Point>>::new());
    }
}
