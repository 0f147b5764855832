//! What a drawing is made of: lines, marks and text in units of a page, on a bitmap or in SVG.

use crate::scene::Color;
use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, FontTransform, IntoFont, RGBAColor, ShapeStyle, TextStyle, register_font};

/// Name of the page's font; what follows it is what a viewer without it may take.
const FONT: &str = "Inter, Helvetica, Arial, sans-serif";
/// Size of a subscript, and how far it sinks, in sizes of its text.
const SUBSCRIPT: (f64, f64) = (0.74, 0.17);

/// A point of the page, x to the right and y down.
pub type Point = [f64; 2];

/// Makes the fonts known to the drawing library.
pub fn register_fonts() -> Result<(), String> {
    let fonts: [(FontStyle, &'static [u8]); 2] = [
        (FontStyle::Normal, include_bytes!("../../../assets/fonts/Inter-Regular.otf")),
        (FontStyle::Bold, include_bytes!("../../../assets/fonts/Inter-SemiBold.otf")),
    ];
    fonts.into_iter().try_for_each(|(style, bytes)| register_font(FONT, style, bytes)).map_err(|_| "bad font".into())
}

/// Text in which `_x` is a subscript, as runs of equal size.
fn runs(text: &str) -> Vec<(String, bool)> {
    // The font lacks the double bar.
    let text = text.replace('‖', "||").replace("ξ1", "ξ_1").replace("ξ2", "ξ_2");
    let mut runs: Vec<(String, bool)> = Vec::new();
    let mut low = false;
    for character in text.chars() {
        if character == '_' && !low {
            low = true;
            continue;
        }
        match runs.last_mut() {
            Some((run, is_low)) if *is_low == low => run.push(character),
            _ => runs.push((character.into(), low)),
        }
        low = false;
    }
    runs
}

/// Width of text at a size.
pub fn width(text: &str, size: f64, bold: bool) -> f64 {
    let run = |(run, low): &(String, bool)| run_width(run, if *low { SUBSCRIPT.0 * size } else { size }, bold);
    runs(text).iter().map(run).sum()
}

fn run_width(run: &str, size: f64, bold: bool) -> f64 {
    // Measured large, for the library rounds to whole pixels.
    const LARGE: f64 = 1000.0;
    let style = if bold { FontStyle::Bold } else { FontStyle::Normal };
    let font = (FONT, LARGE * BITMAP_EM, style).into_font();
    font.box_size(run).map_or(0.0, |(width, _)| f64::from(width) * size / LARGE)
}

/// Font height of the bitmap's library in em (ascent and descent of the font).
const BITMAP_EM: f64 = 3408.0 / 2816.0;

/// Where text starts, ends or is centred.
#[derive(Debug, Clone, Copy)]
pub enum Align {
    Left,
    Center,
    Right,
}

/// What the canvas is drawn on.
pub trait Paper: DrawingBackend {
    /// Size that the library wants for text of one em.
    const EM: f64;
    /// How far below the given place the baseline comes to lie, in such sizes.
    const BASELINE: f64;
    /// Whether thick lines are best drawn piece by piece.
    const PIECEWISE: bool;
}

impl Paper for BitMapBackend<'_> {
    const EM: f64 = BITMAP_EM;
    const BASELINE: f64 = 0.5;
    // The library's joints of thick lines spike where a curve turns back sharply.
    const PIECEWISE: bool = true;
}

impl Paper for SVGBackend<'_> {
    const EM: f64 = 1.24;
    const BASELINE: f64 = 0.76 / 1.24;
    const PIECEWISE: bool = false;
}

/// A page being drawn, in units of its own.
pub struct Canvas<P: Paper> {
    paper: P,
    scale: f64,
    failed: Option<String>,
    /// Lengths of the texts drawn, in order, in units of the paper.
    lengths: Vec<f64>,
}

impl<P: Paper> Canvas<P> {
    /// A page on paper with `scale` pixels for each unit.
    pub fn new(paper: P, scale: f64) -> Self {
        Self { paper, scale, failed: None, lengths: Vec::new() }
    }

    /// Ends the drawing; gives the lengths of its texts, in order, in units of the paper.
    pub fn finish(mut self) -> Result<Vec<f64>, String> {
        let done = self.paper.present().map_err(|error| error.to_string());
        self.failed.map_or(done, Err).map(|()| self.lengths)
    }

    fn note<E: std::fmt::Display>(failed: &mut Option<String>, done: Result<(), E>) {
        if let Err(error) = done {
            failed.get_or_insert(error.to_string());
        }
    }

    fn pixel(&self, [x, y]: Point) -> (i32, i32) {
        ((x * self.scale).round() as i32, (y * self.scale).round() as i32)
    }

    fn style(&self, color: Color, width: f64) -> ShapeStyle {
        ShapeStyle { color: rgba(color), filled: true, stroke_width: (width * self.scale).round().max(1.0) as u32 }
    }

    /// A filled polygon.
    pub fn fill(&mut self, points: &[Point], color: Color) {
        let style = self.style(color, 1.0);
        let points: Vec<_> = points.iter().map(|point| self.pixel(*point)).collect();
        Self::note(&mut self.failed, self.paper.fill_polygon(points, &style));
    }

    /// A filled rectangle.
    pub fn rectangle(&mut self, [left, top, right, bottom]: [f64; 4], color: Color) {
        self.fill(&[[left, top], [right, top], [right, bottom], [left, bottom]], color);
    }

    /// A disk.
    pub fn disk(&mut self, at: Point, radius: f64, color: Color) {
        let style = self.style(color, 1.0);
        let at = self.pixel(at);
        let radius = (radius * self.scale).round() as u32;
        Self::note(&mut self.failed, self.paper.draw_circle(at, radius, &style, true));
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point], color: Color, width: f64) {
        if points.len() < 2 {
            return;
        }
        if !P::PIECEWISE {
            let style = self.style(color, width);
            let points: Vec<_> = points.iter().map(|point| self.pixel(*point)).collect();
            Self::note(&mut self.failed, self.paper.draw_path(points, &style));
            return;
        }
        for pair in points.windows(2) {
            let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
            let length = (x1 - x0).hypot(y1 - y0);
            if length > 0.0 {
                let (nx, ny) = (0.5 * width * (y0 - y1) / length, 0.5 * width * (x1 - x0) / length);
                self.fill(&[[x0 + nx, y0 + ny], [x1 + nx, y1 + ny], [x1 - nx, y1 - ny], [x0 - nx, y0 - ny]], color);
            }
        }
        // Round joints; ends stay flat, so that dashes keep their length.
        for joint in &points[1..points.len() - 1] {
            self.disk(*joint, 0.5 * width, color);
        }
    }

    /// The same, dashed: `on` drawn, `off` left out.
    pub fn dashed(&mut self, points: &[Point], color: Color, width: f64, [on, off]: [f64; 2]) {
        let mut dash: Vec<Point> = points.first().copied().into_iter().collect();
        let (mut drawing, mut left) = (true, on);
        for pair in points.windows(2) {
            let (mut from, to) = (pair[0], pair[1]);
            loop {
                let length = (to[0] - from[0]).hypot(to[1] - from[1]);
                if length < left {
                    left -= length;
                    dash.push(to);
                    break;
                }
                let share = left / length;
                from = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
                dash.push(from);
                if drawing {
                    self.line(&dash, color, width);
                }
                dash = vec![from];
                drawing = !drawing;
                left = if drawing { on } else { off };
            }
        }
        if drawing {
            self.line(&dash, color, width);
        }
    }

    /// Text with its baseline at a place; upright text reads upward.
    pub fn text(&mut self, text: &str, at: Point, size: f64, color: Color, align: Align, look: Look) {
        let whole = width(text, size, look.bold);
        let mut along = match align {
            Align::Left => 0.0,
            Align::Center => -0.5 * whole,
            Align::Right => -whole,
        };
        for (run, low) in runs(text) {
            let (size, sunk) = if low { (SUBSCRIPT.0 * size, SUBSCRIPT.1 * size) } else { (size, 0.0) };
            // SVG swallows spaces at both ends of a text.
            let (whole, bare) = (run_width(&run, size, look.bold), run.trim_start());
            let rest = run_width(bare, size, look.bold);
            along += whole - rest;
            let height = size * P::EM;
            let down = sunk - P::BASELINE * height;
            let place = if look.upright { [at[0] + down, at[1] - along] } else { [at[0] + along, at[1] + down] };
            let style = if look.bold { FontStyle::Bold } else { FontStyle::Normal };
            let turn = if look.upright { FontTransform::Rotate270 } else { FontTransform::None };
            let font = (FONT, height * self.scale, style).into_font().transform(turn);
            let color = rgba(color);
            let style = TextStyle::from(font).color(&color).pos(Pos::new(HPos::Left, VPos::Top));
            let pixel = self.pixel(place);
            if !bare.trim_end().is_empty() {
                self.lengths.push(run_width(bare.trim_end(), size, look.bold) * self.scale);
                Self::note(&mut self.failed, self.paper.draw_text(bare.trim_end(), &style, pixel));
            }
            along += rest;
        }
    }
}

/// How text stands.
#[derive(Debug, Clone, Copy, Default)]
pub struct Look {
    /// In the heavier weight.
    pub bold: bool,
    /// Turned to read upward.
    pub upright: bool,
}

fn rgba(color: Color) -> RGBAColor {
    let [r, g, b, _] = color.to_bytes();
    RGBAColor(r, g, b, f64::from(color.a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::scenario::preset;
    use centrode_core::study::Job;
    use centrode_core::study::figure::{FigureJob, Number};

    fn pixels(character: char) -> Vec<(i32, i32)> {
        let mut pixels = Vec::new();
        let font = (FONT, 40.0, FontStyle::Normal).into_font();
        let drawn = font.draw(&character.to_string(), (0, 0), |x, y, _| {
            pixels.push((x, y));
            Ok::<(), std::convert::Infallible>(())
        });
        assert!(drawn.is_ok(), "{character}");
        pixels
    }

    #[test]
    fn the_font_has_every_character_of_every_figure() {
        register_fonts().expect("the fonts");
        let missing = pixels('\u{e000}');
        for number in Number::ALL {
            let scenario = preset::find(number.preset()).expect("its preset").scenario().expect("a scenario");
            let mut job = FigureJob::new(number, &scenario).expect("a plan");
            job.finish();
            let figure = job.figure();
            let mut words = figure.title + &figure.caption;
            for axis in [&figure.x, &figure.y] {
                words += axis.name;
                words += axis.unit;
            }
            figure.series.iter().for_each(|series| words += &series.name);
            figure.verticals.iter().for_each(|vertical| words += vertical.name);
            figure.spans.iter().for_each(|span| words += span.name);
            for (run, _) in runs(&(words + "0123456789−.")) {
                for character in run.chars().filter(|character| !character.is_whitespace()) {
                    assert_ne!(pixels(character), missing, "{character:?} in figure {number}");
                }
            }
        }
    }

    #[test]
    fn an_underscore_lowers_one_character() {
        let expected = [("ε".to_string(), false), ("c".into(), true), (" of θ".into(), false), ("L".into(), true)];
        assert_eq!(runs("ε_c of θ_L"), expected);
    }
}
