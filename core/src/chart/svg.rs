//! A drawing as SVG. The same drawing and colours give the same bytes everywhere.

use super::Chart;
use super::clip::{Rect, Spot};
use super::font::{FAMILY, LOW, MIDDLE, STRONG_FAMILY, STRONG_WEIGHT, SUNK, plain_width};
use super::layout::{Align, Drawing, Form, Ink, Item, Paint, Text};
use super::notation::runs;
use libm::rint;
use std::fmt::Write;

/// Part of a cell's colour that stays where it stands back.
pub const FAINT: f64 = 0.28;

/// Writes a drawing of a chart; `color` gives red, green and blue of an ink.
///
/// ```
/// use centrode_core::chart::layout::{Page, layout};
/// use centrode_core::chart::svg::svg;
/// use centrode_core::scenario::Scenario;
/// use centrode_core::study::Job;
/// use centrode_core::study::figure::{FigureJob, Number};
///
/// let mut job = FigureJob::new(Number::Three, &Scenario::default())?;
/// job.finish();
/// let chart = job.chart();
/// let drawing = layout(&chart, &Page { words: true, ..Page::screen([640.0, 480.0], 12.0) });
/// let text = svg(&drawing, &chart, &|_| [0, 0, 0]);
/// assert!(text.starts_with("<svg") && text.contains("Least detectable joint force deviation"));
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[must_use]
pub fn svg(drawing: &Drawing, chart: &Chart, color: &dyn Fn(Ink) -> [u8; 3]) -> String {
    let hex = |ink: Ink| {
        let [r, g, b] = color(ink);
        format!("#{r:02x}{g:02x}{b:02x}")
    };
    painted(drawing, chart, &hex)
}

/// The same with colours as CSS has them, such as `var(--ink)`, for a drawing inside a page whose colours change.
#[must_use]
pub fn painted(drawing: &Drawing, chart: &Chart, color: &dyn Fn(Ink) -> String) -> String {
    let mut page = Page { text: String::new(), color };
    page.document(drawing, chart);
    page.text
}

struct Page<'a> {
    text: String,
    color: &'a dyn Fn(Ink) -> String,
}

/// A length with two decimals, without zeros that say nothing.
fn length(value: f64) -> String {
    let rounded = rint(value * 100.0) / 100.0;
    // Adding 0 makes −0 a 0.
    (rounded + 0.0).to_string()
}

/// Text as XML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn path(points: impl Iterator<Item = Spot>) -> String {
    let mut path = String::new();
    for [x, y] in points {
        let lead = if path.is_empty() { 'M' } else { 'L' };
        // Writing to a string does not fail.
        let _ = write!(path, "{lead}{} {}", length(x), length(y));
    }
    path
}

impl Page<'_> {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn css(&self, ink: Ink) -> String {
        (self.color)(ink)
    }

    /// A colour as the attribute `name`, with its opacity where it is not whole.
    fn paint(&self, name: &str, Paint { ink, opacity }: Paint) -> String {
        let css = self.css(ink);
        if opacity < 1.0 {
            format!("{name}=\"{css}\" {name}-opacity=\"{}\"", length(opacity))
        } else {
            format!("{name}=\"{css}\"")
        }
    }

    fn document(&mut self, drawing: &Drawing, chart: &Chart) {
        let [width, height] = drawing.size.map(length);
        self.line(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"{FAMILY}\" stroke-linejoin=\"round\">"
        ));
        self.line(&format!("<title>{}</title>", escaped(&chart.title)));
        let ground = self.css(Ink::Ground);
        self.line(&format!("<rect width=\"{width}\" height=\"{height}\" fill=\"{ground}\"/>"));
        for shape in &drawing.shapes {
            self.shape(shape, chart);
        }
        self.line("</svg>");
    }

    fn shape(&mut self, shape: &Item, chart: &Chart) {
        match shape {
            Item::Fill(rect, paint) => {
                let paint = self.paint("fill", *paint);
                self.rect(*rect, &paint);
            }
            Item::Map(rect, panel) => self.map(*rect, chart, *panel),
            Item::Band(edges, paint) => {
                let around = edges.iter().map(|edge| edge[0]).chain(edges.iter().rev().map(|edge| edge[1]));
                let line = format!("<path d=\"{}Z\" {}/>", path(around), self.paint("fill", *paint));
                self.line(&line);
            }
            Item::Line(points, paint, wide, dash) => {
                let dash = dash.map_or(String::new(), |dash| {
                    // Two of a kind are said once.
                    let lengths = if dash[..2] == dash[2..] { &dash[..2] } else { &dash[..] };
                    let lengths: Vec<String> = lengths.iter().map(|of| length(*of)).collect();
                    format!(" stroke-dasharray=\"{}\"", lengths.join(" "))
                });
                let (path, paint) = (path(points.iter().copied()), self.paint("stroke", *paint));
                self.line(&format!(
                    "<path d=\"{path}\" fill=\"none\" {paint} stroke-width=\"{}\"{dash}/>",
                    length(*wide)
                ));
            }
            Item::Mark(at, form, radius, paint, edge) => self.mark(*at, *form, *radius, *paint, *edge),
            Item::Text(text) => self.words(text),
        }
    }

    fn rect(&mut self, rect: Rect, attributes: &str) {
        let [x, y, width, height] = [rect.left, rect.top, rect.width(), rect.height()].map(length);
        self.line(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {attributes}/>"));
    }

    fn mark(&mut self, [x, y]: Spot, form: Form, radius: f64, paint: Paint, edge: Ink) {
        let (fill, stroke) = match form {
            Form::Triangle | Form::Dot | Form::Diamond => (self.paint("fill", paint), self.css(edge)),
            Form::Circle => (format!("fill=\"{}\"", self.css(edge)), self.css(paint.ink)),
            Form::Ring => ("fill=\"none\"".into(), self.css(paint.ink)),
        };
        let wide = length(radius * form.stroke());
        let line = match form {
            Form::Triangle | Form::Diamond => {
                let outline = path(form.corners([x, y], radius).into_iter());
                format!(
                    "<path d=\"{outline}Z\" {fill} stroke=\"{stroke}\" stroke-width=\"{wide}\" paint-order=\"stroke\"/>"
                )
            }
            _ => {
                let [x, y, radius] = [x, y, radius].map(length);
                format!(
                    "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {fill} stroke=\"{stroke}\" stroke-width=\"{wide}\"/>"
                )
            }
        };
        self.line(&line);
    }

    /// The cells of a map; neighbours of one colour are one rectangle.
    fn map(&mut self, rect: Rect, chart: &Chart, panel: usize) {
        let Some(map) = chart.panels.get(panel).and_then(|panel| panel.map.as_ref()) else { return };
        let (columns, rows) = (map.columns, map.rows());
        let (turned, falling) = (map.x[0] > map.x[1], map.y[0] < map.y[1]);
        let step = [rect.width() / columns as f64, rect.height() / rows as f64];
        self.line("<g shape-rendering=\"crispEdges\">");
        for row in 0..rows {
            let colors: Vec<Option<String>> = (0..columns)
                .map(|column| {
                    let cell = row * columns + if turned { columns - 1 - column } else { column };
                    let share = map.share(map.values[cell]);
                    let opacity = if map.is_faint(cell) { FAINT } else { 1.0 };
                    (!share.is_nan()).then(|| self.paint("fill", Paint { ink: Ink::Map(share), opacity }))
                })
                .collect();
            let from_top = if falling { rows - 1 - row } else { row };
            let top = rect.top + step[1] * from_top as f64;
            let mut first = 0;
            while first < columns {
                let same = colors[first..].iter().take_while(|color| **color == colors[first]).count();
                if let Some(paint) = &colors[first] {
                    let left = rect.left + step[0] * first as f64;
                    let part = Rect { left, right: left + step[0] * same as f64, top, bottom: top + step[1] };
                    self.rect(part, paint);
                }
                first += same;
            }
        }
        self.line("</g>");
    }

    /// A text, each run held to its width, so that a viewer without the font leaves everything in its place.
    fn words(&mut self, text: &Text) {
        let (size, strong) = (text.size, text.strong);
        let run_size = |low: bool| if low { LOW * size } else { size };
        let runs = runs(&text.text);
        let width: f64 = runs.iter().map(|run| plain_width(&run.text, strong) * run_size(run.low)).sum();
        let mut along = match text.align {
            Align::Left => 0.0,
            Align::Center => -0.5 * width,
            Align::Right => -width,
        };
        let fill = self.css(text.ink);
        let weight = if strong {
            format!(" font-family=\"{STRONG_FAMILY}\" font-weight=\"{STRONG_WEIGHT}\"")
        } else {
            String::new()
        };
        for run in runs {
            let run_size = run_size(run.low);
            let of = |text: &str| plain_width(text, strong) * run_size;
            // SVG swallows spaces at both ends of a text.
            let bare = run.text.trim_start();
            along += of(&run.text) - of(bare);
            let word = bare.trim_end();
            let down = MIDDLE * size + if run.low { SUNK * size } else { 0.0 };
            let [x, y] = if text.upright {
                [text.at[0] + down, text.at[1] - along]
            } else {
                [text.at[0] + along, text.at[1] + down]
            };
            let [x, y] = [x, y].map(length);
            let turn = if text.upright { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
            if !word.is_empty() {
                self.line(&format!(
                    "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\" fill=\"{fill}\"{weight}{turn}>{}</text>",
                    length(run_size),
                    length(of(word)),
                    escaped(word),
                ));
            }
            along += of(bare);
        }
    }
}
