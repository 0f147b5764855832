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
use super::{Chart, Panel, Role};

/// The page of a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// Width and height, points.
    pub size: [f64; 2],
    /// Size of the text, points; everything else is in proportion.
    pub text: f64,
    /// Whether title and caption stand on it, with a margin around; the interface writes its own.
    pub words: bool,
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
        }
    }

    /// The corners of a triangle of a radius around a place.
    #[must_use]
    pub fn triangle(self, [x, y]: Spot, r: f64) -> [Spot; 3] {
        [[x, y - r], [x + 0.87 * r, y + 0.6 * r], [x - 0.87 * r, y + 0.6 * r]]
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
    /// A line through points, its width, and the lengths of its dashes and of the gaps between them.
    Line(Vec<Spot>, Paint, f64, Option<[f64; 2]>),
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
        space = words(&mut drawing, chart, t, space);
    }
    for (k, (panel, place)) in chart.panels.iter().zip(places(space, chart.panels.len(), t)).enumerate() {
        let mut pen = Pen { drawing: &mut drawing, t, k };
        pen.panel(panel, place);
    }
    drawing
}

/// Title and caption; the space between them.
fn words(drawing: &mut Drawing, chart: &Chart, t: f64, page: Rect) -> Rect {
    let side = 2.7 * t;
    let mut pen = Pen { drawing, t, k: 0 };
    let (left, right) = (page.left + side, page.right - side);
    if !chart.title.is_empty() {
        let at = [left, page.top + 2.6 * t];
        pen.text(&chart.title, at, Look { size: 1.4 * t, strong: true, ..Look::PLAIN });
    }
    let lines = font::lines(&printed(&chart.caption), 0.9 * t, right - left);
    let line = 1.27 * t;
    let foot = page.bottom - 1.5 * t - line * lines.len() as f64;
    for (k, text) in lines.iter().enumerate() {
        let at = [left, foot + line * (k as f64 + 0.5)];
        pen.text(text, at, Look { size: 0.9 * t, ink: Ink::Dim, ..Look::PLAIN });
    }
    Rect { left, right, top: page.top + 4.2 * t, bottom: foot - 0.9 * t }
}

/// Places of panels: side by side where there is the width, else above each other.
#[must_use]
pub fn places(space: Rect, count: usize, t: f64) -> Vec<Rect> {
    let of = count.max(1) as f64;
    let beside = space.width() > 1.15 * space.height();
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
    /// Size of the text.
    t: f64,
    /// Place of the panel in the chart.
    k: usize,
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

    fn line(&mut self, points: &[Spot], paint: impl Into<Paint>, wide: f64, dash: Option<[f64; 2]>) {
        self.add(Item::Line(points.to_vec(), paint.into(), wide, dash));
    }

    /// One panel in its place.
    fn panel(&mut self, panel: &Panel, place: Rect) {
        let (data, title) = self.divide(panel, place);
        let frame = axes::frame(panel, data);
        self.drawing.frames.push(frame);
        self.head(panel, place, &frame, title);
        if let Some(map) = &panel.map {
            self.map(map, &frame);
        }
        self.axes(panel, place, &frame);
        self.data(panel, &frame);
        if let Some(map) = &panel.map {
            self.bar(map, &frame);
        }
        self.rungs(panel, &frame);
    }

    /// The place of a panel's data, and whether title and note stand on one line.
    fn divide(&self, panel: &Panel, place: Rect) -> (Rect, bool) {
        let t = self.t;
        let right = place.right - if panel.map.is_some() { self.bar_room(panel) } else { 0.9 * t };
        let mut data = Rect { left: place.left, right, top: place.top, bottom: place.bottom - 3.2 * t };
        // Labels of the vertical axis need its height, which hardly depends on them.
        data.top = place.top + 0.7 * t;
        data.left += self.gutter(panel, &data);
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
    fn head(&mut self, panel: &Panel, place: Rect, frame: &Frame, one: bool) {
        let t = self.t;
        let data = frame.data;
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
