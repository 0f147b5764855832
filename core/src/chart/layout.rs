//! Divides a page among the parts of a chart: where everything stands, in points.
//!
//! All sizes follow from that of the text, so that a chart on a phone and one on paper look alike. What comes out is a
//! [`Drawing`]: shapes from back to front, and for each panel a [`Frame`] that says which value lies where.

mod axes;
mod data;
mod legend;

use super::clip::{Rect, Spot};
use super::font::{self, width};
use super::notation::printed;
use super::scale::Scale;
use super::{Chart, Dash, Panel, Role, Series};

/// The page of a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// Width and height, points.
    pub size: [f64; 2],
    /// Size of the text, points; everything else is in proportion.
    pub text: f64,
    /// Whether title and caption stand on it, with a margin around; the interface writes its own.
    pub words: bool,
    /// Size of a pixel, points: of a curve with many more points than columns of pixels, each column keeps its extremes.
    pub pixel: f64,
    /// Room at the left and at the right of the data, points, for plots that stand in line with each other: they have no titles,
    /// no legends, no names of axes and no frames, for who shows them writes his own.
    pub sides: Option<[f64; 2]>,
}

impl Page {
    /// A page without words of its own, for a screen.
    #[must_use]
    pub fn screen(size: [f64; 2], text: f64) -> Self {
        Self { size, text, words: false, pixel: 1.0, sides: None }
    }
}

/// A chart that has been laid out.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height, points.
    pub size: [f64; 2],
    /// What is drawn, back to front.
    pub shapes: Vec<Item>,
    /// Where the panels' data lies, in their order.
    pub frames: Vec<Frame>,
}

/// Where the data of a panel lies. Values are SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The data's place.
    pub data: Rect,
    /// The horizontal scale.
    pub x: Scale,
    /// The vertical scale.
    pub y: Scale,
}

impl Frame {
    /// Where a point lies.
    #[must_use]
    pub fn at(&self, [x, y]: [f64; 2]) -> Spot {
        [self.x.at(x), self.y.at(y)]
    }

    /// The values at a place, within the ranges.
    #[must_use]
    pub fn value(&self, [x, y]: Spot) -> [f64; 2] {
        [self.x.value(x), self.y.value(y)]
    }
}

/// What gives a shape its colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ink {
    /// What it means.
    Role(Role),
    /// Text.
    Text,
    /// Text that matters less, and frames.
    Dim,
    /// Lines behind the data.
    Grid,
    /// The page.
    Ground,
    /// White on a map.
    White,
    /// Black on a map.
    Black,
    /// A share of the colour map, from 0 (dark) to 1 (light).
    Map(f64),
}

/// A colour with its opacity, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    /// The colour.
    pub ink: Ink,
    /// Its opacity.
    pub opacity: f64,
}

impl From<Ink> for Paint {
    fn from(ink: Ink) -> Self {
        Self { ink, opacity: 1.0 }
    }
}

/// Form of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A filled triangle.
    Triangle,
    /// A circle filled with the ground.
    Circle,
    /// A filled dot.
    Dot,
    /// A circle that is not filled.
    Ring,
    /// A filled diamond.
    Diamond,
}

impl Form {
    /// Width of its line, or of its edge, in radii.
    #[must_use]
    pub fn stroke(self) -> f64 {
        match self {
            Self::Triangle => 0.5,
            Self::Circle => 0.5,
            Self::Dot => 0.35,
            Self::Ring => 0.25,
            Self::Diamond => 0.3,
        }
    }

    /// The corners of a form of a radius around a place; none where it is round.
    #[must_use]
    pub fn corners(self, [x, y]: Spot, r: f64) -> Vec<Spot> {
        match self {
            Self::Triangle => vec![[x, y - r], [x + 0.87 * r, y + 0.6 * r], [x - 0.87 * r, y + 0.6 * r]],
            Self::Diamond => vec![[x, y - r], [x + r, y], [x, y + r], [x - r, y]],
            Self::Circle | Self::Dot | Self::Ring => Vec::new(),
        }
    }
}

/// How a text lies to its place: its middle is as high as the place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// It begins there.
    Left,
    /// It is centred there.
    Center,
    /// It ends there.
    Right,
}

/// A text of one line.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// The text, in which `_x` is a subscript.
    pub text: String,
    /// Its place.
    pub at: Spot,
    /// Its size, points.
    pub size: f64,
    /// Its colour.
    pub ink: Ink,
    /// How it lies to its place.
    pub align: Align,
    /// In the heavier weight.
    pub strong: bool,
    /// Turned to read upward.
    pub upright: bool,
}

/// Something that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// A filled rectangle.
    Fill(Rect, Paint),
    /// The map of the panel of this place in the chart.
    Map(Rect, usize),
    /// The area between two edges, point by point.
    Band(Vec<[Spot; 2]>, Paint),
    /// A line through points, its width, and the lengths of its dashes and of the gaps between them, points.
    Line(Vec<Spot>, Paint, f64, Option<Dash>),
    /// A mark at a place, its form and its radius; its edge parts it from what is behind it.
    Mark(Spot, Form, f64, Paint, Ink),
    /// A text.
    Text(Text),
}

/// Lays a chart out on a page.
#[must_use]
pub fn layout(chart: &Chart, page: &Page) -> Drawing {
    let mut drawing = Drawing { size: page.size, shapes: Vec::new(), frames: Vec::new() };
    let t = page.text;
    let mut space = Rect { left: 0.0, top: 0.0, right: page.size[0], bottom: page.size[1] };
    if page.words {
        space = words(&mut drawing, chart, page, space);
    }
    let places = places(space, chart.panels.len(), t);
    let [first, others @ ..] = &chart.panels[..] else { return drawing };
    let in_column = others.iter().all(|panel| panel.x == first.x) && places.iter().all(|at| at.left == places[0].left);
    let mut pen = Pen { drawing: &mut drawing, page, t, k: 0, gutter: 0.0 };
    if in_column && !others.is_empty() {
        // Panels over one axis begin in line.
        let gutters = chart.panels.iter().zip(&places).map(|(panel, at)| pen.gutter(panel, &pen.below_head(at)));
        pen.gutter = gutters.fold(0.0, f64::max);
    }
    for (k, (panel, place)) in chart.panels.iter().zip(places).enumerate() {
        pen.k = k;
        pen.panel(panel, place);
    }
    drawing
}

/// What moves over a panel that has been laid out: the shapes of a few series in its frame. `on_map` says whether a map is behind.
#[must_use]
pub fn over(frame: &Frame, series: &[Series], page: &Page, on_map: bool) -> Vec<Item> {
    let mut drawing = Drawing { size: page.size, shapes: Vec::new(), frames: Vec::new() };
    let mut pen = Pen { drawing: &mut drawing, page, t: page.text, k: 0, gutter: 0.0 };
    pen.all_series(series, frame, if on_map { Ink::White } else { Ink::Ground });
    drawing.shapes
}

/// Title and caption; the space between them.
fn words(drawing: &mut Drawing, chart: &Chart, page: &Page, whole: Rect) -> Rect {
    let t = page.text;
    let side = 2.7 * t;
    let mut pen = Pen { drawing, page, t, k: 0, gutter: 0.0 };
    let (left, right) = (whole.left + side, whole.right - side);
    if !chart.title.is_empty() {
        let at = [left, whole.top + 2.6 * t];
        pen.text(&chart.title, at, Look { size: 1.4 * t, strong: true, ..Look::PLAIN });
    }
    let lines = font::lines(&printed(&chart.caption), 0.9 * t, right - left);
    let line = 1.27 * t;
    let foot = whole.bottom - 1.5 * t - line * lines.len() as f64;
    for (k, text) in lines.iter().enumerate() {
        let at = [left, foot + line * (k as f64 + 0.5)];
        pen.text(text, at, Look { size: 0.9 * t, ink: Ink::Dim, ..Look::PLAIN });
    }
    Rect { left, right, top: whole.top + 4.2 * t, bottom: foot - 0.9 * t }
}

/// Places of panels: side by side where there is the width, else above each other; four of them two by two where there is the width.
#[must_use]
pub fn places(space: Rect, count: usize, t: f64) -> Vec<Rect> {
    let of = count.max(1) as f64;
    let beside = space.width() > 1.15 * space.height();
    if beside && count == 4 {
        let middle = 0.5 * (space.top + space.bottom);
        let rows = [Rect { bottom: middle - 0.6 * t, ..space }, Rect { top: middle + 0.6 * t, ..space }];
        return rows.into_iter().flat_map(|row| places(row, 2, t)).collect();
    }
    let gap = if beside { 2.4 * t } else { 1.2 * t };
    let part = (if beside { space.width() } else { space.height() } - gap * (of - 1.0)) / of;
    let place = |k: usize| {
        let from = k as f64 * (part + gap);
        if beside {
            Rect { left: space.left + from, right: space.left + from + part, ..space }
        } else {
            Rect { top: space.top + from, bottom: space.top + from + part, ..space }
        }
    };
    (0..count).map(place).collect()
}

/// How a text stands, but for its place.
#[derive(Clone, Copy)]
struct Look {
    size: f64,
    ink: Ink,
    align: Align,
    strong: bool,
    upright: bool,
}

impl Look {
    const PLAIN: Self = Self { size: 0.0, ink: Ink::Text, align: Align::Left, strong: false, upright: false };
}

/// Adds the shapes of one panel.
struct Pen<'a> {
    drawing: &'a mut Drawing,
    page: &'a Page,
    /// Size of the text.
    t: f64,
    /// Place of the panel in the chart.
    k: usize,
    /// The least room for the labels of vertical axes, points.
    gutter: f64,
}

impl Pen<'_> {
    fn add(&mut self, shape: Item) {
        self.drawing.shapes.push(shape);
    }

    fn text(&mut self, text: &str, at: Spot, look: Look) {
        let size = if look.size > 0.0 { look.size } else { self.t };
        let Look { ink, align, strong, upright, .. } = look;
        self.add(Item::Text(Text { text: printed(text), at, size, ink, align, strong, upright }));
    }

    fn line(&mut self, points: &[Spot], paint: impl Into<Paint>, wide: f64, dash: Option<Dash>) {
        self.add(Item::Line(points.to_vec(), paint.into(), wide, dash));
    }

    /// One panel in its place.
    fn panel(&mut self, panel: &Panel, place: Rect) {
        let (data, title) = self.divide(panel, place);
        let aside = axes::spare(panel, &data);
        let narrow = |rect: Rect| Rect { left: rect.left + aside, right: rect.right - aside, ..rect };
        let frame = axes::frame(panel, narrow(data));
        self.drawing.frames.push(frame);
        if self.page.sides.is_none() {
            self.head(panel, place, &data, title);
        }
        let place = narrow(place);
        if let Some(map) = &panel.map {
            self.map(map, &frame);
        }
        self.axes(panel, place, &frame);
        self.data(panel, &frame);
        if let Some(map) = &panel.map {
            self.bar(map, &frame);
        }
        self.rungs(panel, &frame);
        self.asides(panel, &frame);
    }

    /// A panel without its head and the labels of its horizontal axis: those of the vertical axis need its height, which hardly
    /// depends on them.
    fn below_head(&self, place: &Rect) -> Rect {
        Rect { top: place.top + 0.7 * self.t, bottom: place.bottom - 3.2 * self.t, ..*place }
    }

    /// The place of a panel's data, and whether title and note stand on one line.
    fn divide(&self, panel: &Panel, place: Rect) -> (Rect, bool) {
        let t = self.t;
        if let Some([left, right]) = self.page.sides {
            let bottom = place.bottom - if panel.x.bare { 0.5 * t } else { 1.7 * t };
            let data = Rect { left: place.left + left, right: place.right - right, top: place.top, bottom };
            return (data, true);
        }
        let beside = if panel.map.is_some() { self.bar_room(panel) } else { 0.9 * t };
        let right = place.right - beside - self.aside_room(panel);
        let mut data = Rect { right, ..self.below_head(&place) };
        data.left += self.gutter(panel, &data).max(self.gutter);
        let room = place.right - data.left;
        let one = width(&panel.title, 1.07 * t, true) + width(&panel.note, 0.9 * t, false) + t <= data.width();
        let mut head = match (panel.title.is_empty(), panel.note.is_empty()) {
            (true, true) => 0.0,
            (false, false) if !one => 3.4 * t,
            _ => 1.9 * t,
        };
        head += self.legend_height(panel, room);
        if panel.map.is_some() && head == 0.0 {
            head = 1.4 * t;
        }
        data.top += head;
        if !self.stands_upright(panel, &data) {
            data.top += 1.5 * t;
        }
        data.bottom = data.bottom.max(data.top + 3.0 * t);
        data.right = data.right.max(data.left + 3.0 * t);
        (data, one)
    }

    /// Title, note and legend above the data.
    fn head(&mut self, panel: &Panel, place: Rect, data: &Rect, one: bool) {
        let t = self.t;
        let mut y = place.top + 0.7 * t;
        if !panel.title.is_empty() {
            let look = Look { size: 1.07 * t, strong: true, ..Look::PLAIN };
            self.text(&panel.title, [data.left, y], look);
        }
        if !panel.note.is_empty() {
            let look = Look { size: 0.9 * t, ink: Ink::Dim, ..Look::PLAIN };
            if one {
                self.text(&panel.note, [data.right, y], Look { align: Align::Right, ..look });
            } else {
                y += 1.5 * t;
                self.text(&panel.note, [data.left, y], look);
            }
        }
        if !panel.title.is_empty() || !panel.note.is_empty() {
            y += 1.9 * t;
        }
        self.legend(panel, [data.left, y], place.right - data.left);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Aside, Axis, Bars, Intervals, Style};

    fn axis(name: &'static str) -> Axis {
        Axis::new(name, "m", "mm", 1e3)
    }

    fn of(panel: Panel, page: &Page) -> Drawing {
        layout(&Chart { panels: vec![panel], ..Chart::default() }, page)
    }

    #[test]
    fn one_scale_for_both_axes_leaves_no_empty_sides() {
        let page = Page::screen([1000.0, 320.0], 11.0);
        let points = vec![[0.0, 0.0], [0.02, 0.03]];
        let series = vec![Series::new("", Role::Robot, Style::Line, points)];
        let panel = Panel { equal_scales: true, series, ..Panel::new(axis("x"), axis("y")) };
        let frame = of(panel, &page).frames[0];
        assert!(frame.data.width() < 1.7 * frame.data.height(), "{:?}", frame.data);
        let [x, y] = [frame.x, frame.y].map(|scale| scale.per_point());
        assert!((x - y).abs() < 1e-9);
        let [left, right] = [frame.data.left, page.size[0] - frame.data.right];
        assert!((left - right).abs() < 80.0, "it stands in the middle: {left} {right}");
    }

    #[test]
    fn panels_over_one_axis_begin_in_line_and_four_stand_two_by_two() {
        let panel = |top: f64| {
            let x = Axis { range: Some([0.0, 1.0]), ..axis("x") };
            Panel::new(x, Axis { range: Some([0.0, top]), ..axis("y") })
        };
        let frames =
            |panels: Vec<Panel>, size| layout(&Chart { panels, ..Chart::default() }, &Page::screen(size, 11.0)).frames;
        let column = frames(vec![panel(0.001), panel(1000.0)], [400.0, 600.0]);
        assert!(column[0].data.bottom < column[1].data.top && column[0].data.left == column[1].data.left);
        let four = frames(vec![panel(1.0), panel(1.0), panel(1.0), panel(1.0)], [800.0, 600.0]);
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| four[k].data);
        assert!(a.right < b.left && c.right < d.left && a.bottom < c.top && b.bottom < d.top);
        assert!(a.left == c.left && b.top == a.top);
    }

    #[test]
    fn a_curve_of_many_points_keeps_its_peak_and_few_points() {
        let page = Page { sides: Some([38.0, 8.0]), ..Page::screen([346.0, 120.0], 10.5) };
        let point = |k: i32| [f64::from(k) * 1e-3, if k == 5_432 { 0.9 } else { 0.1 }];
        let series = vec![Series::new("", Role::Sensor, Style::Line, (0..=10_000).map(point).collect())];
        let y = Axis { range: Some([0.0, 1.0]), ..axis("y") };
        let x = Axis { range: Some([0.0, 10.0]), ..axis("x") };
        let drawing = of(Panel { series, ..Panel::new(x, y) }, &page);
        let frame = drawing.frames[0];
        let curve = drawing.shapes.iter().find_map(|shape| match shape {
            Item::Line(points, paint, ..) if paint.ink == Ink::Role(Role::Sensor) => Some(points),
            _ => None,
        });
        let curve = curve.expect("a curve");
        assert!(curve.len() < 320, "{}", curve.len());
        let top = curve.iter().map(|point| point[1]).fold(f64::MAX, f64::min);
        assert!((top - frame.y.at(0.9)).abs() < 1e-9);
    }

    #[test]
    fn categories_go_down_the_page_with_their_bars_intervals_and_words_inside() {
        let page = Page::screen([500.0, 240.0], 11.0);
        let names = ["Disk 1", "Disk 2"].map(String::from);
        let mut panel = Panel::new(axis("x"), Axis::categories("", names, true));
        panel.x.range = Some([0.0, 0.03]);
        panel.bars = vec![Bars { name: String::new(), role: Role::Sensor, corners: vec![[[0.0, 0.4], [0.01, -9.0]]] }];
        let ends = vec![[[0.01, 1.0], [0.02, 1.0], [9.0, 1.0]]];
        panel.intervals = vec![Intervals { name: String::new(), role: Role::Bound, ends }];
        panel.asides = vec![Aside { y: 1.0, lines: vec!["found 3 of 100".into()] }];
        let drawing = of(panel, &page);
        let frame = drawing.frames[0];
        let text = |wanted: &str| {
            let texts =
                drawing.shapes.iter().filter_map(|shape| if let Item::Text(text) = shape { Some(text) } else { None });
            texts.filter(|text| text.text == wanted).map(|text| text.at).next().expect("a text")
        };
        assert!(text("Disk 1")[1] < text("Disk 2")[1] && text("Disk 2")[1] == frame.y.at(1.0));
        let beside = text("found 3 of 100");
        assert!(beside[0] > frame.data.right && beside[0] + width("found 3 of 100", 11.0, false) <= page.size[0]);
        for shape in &drawing.shapes {
            match shape {
                Item::Fill(rect, paint) if paint.ink == Ink::Role(Role::Sensor) => {
                    assert!(rect.top >= frame.data.top && rect.bottom <= frame.data.bottom, "{rect:?}");
                }
                Item::Line(points, paint, ..) if paint.ink == Ink::Role(Role::Bound) => {
                    assert!(points.iter().all(|point| point[0] <= frame.data.right + 1e-9), "{points:?}");
                }
                _ => {}
            }
        }
    }
}
