//! Drawings as files: a page of lines, marks and text, in SVG or as pixels.

mod canvas;
mod figure;
mod map;
mod study;
mod ticks;

use super::output::{Failure, NewFile};
use canvas::{Canvas, Paper, register_fonts};
use plotters::backend::{BitMapBackend, SVGBackend};
use std::io::Write;
use std::path::Path;

pub use figure::figure;
pub use map::map;
pub use study::study;

/// How a drawing is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Vectors.
    Svg,
    /// Pixels.
    Png,
}

/// How a file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// As a drawing.
    Drawing(Format),
    /// As numbers.
    Csv,
}

/// Extensions, as a message names them.
const KNOWN: &str = ".svg, .png, .csv";

impl Kind {
    /// The kind that the extension of the file behind `--out` names.
    pub fn of(path: &Path) -> Result<Self, Failure> {
        Self::named("--out", path, KNOWN)
    }

    fn named(flag: &str, path: &Path, known: &str) -> Result<Self, Failure> {
        let wrong = |what: String| Failure::Input(format!("{flag} {}: {what}; known are: {known}", path.display()));
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Self::Drawing(Format::Svg)),
            Some("png") => Ok(Self::Drawing(Format::Png)),
            Some("csv") => Ok(Self::Csv),
            Some(other) => Err(wrong(format!("unknown extension .{other}"))),
            None => Err(wrong("the extension is missing".into())),
        }
    }
}

impl Format {
    /// The format that the extension of the file behind a flag names.
    pub fn of(flag: &str, path: &Path) -> Result<Self, Failure> {
        match Kind::named(flag, path, ".svg, .png")? {
            Kind::Drawing(format) => Ok(format),
            Kind::Csv => {
                Err(Failure::Input(format!("{flag} {}: not a drawing; known are: .svg, .png", path.display())))
            }
        }
    }
}

/// Writes a drawing to its file.
pub fn write(file: &mut NewFile, drawn: Result<Vec<u8>, String>) -> Result<(), Failure> {
    let bytes = drawn.map_err(|error| Failure::Input(format!("the drawing failed: {error}")))?;
    file.write_all(&bytes).map_err(|error| file.blame(&error))
}

/// Something that can be drawn on either kind of paper.
trait Drawing {
    /// Width and height of its page.
    const SIZE: [u32; 2];

    /// Draws it.
    fn draw<P: Paper>(&self, canvas: &mut Canvas<P>);
}

/// Units of the SVG's own grid to one of the page: the library rounds to whole ones.
const FINE: u32 = 8;
/// Pixels to a unit of the page, and points drawn to a pixel on either side, which are averaged.
const PIXELS: u32 = 2;
const POINTS: u32 = 2;

/// A drawing as a file's bytes.
fn bytes<D: Drawing>(drawing: &D, format: Format) -> Result<Vec<u8>, String> {
    register_fonts()?;
    let [width, height] = D::SIZE;
    match format {
        Format::Svg => {
            let mut text = String::new();
            let mut canvas =
                Canvas::new(SVGBackend::with_string(&mut text, (width * FINE, height * FINE)), f64::from(FINE));
            drawing.draw(&mut canvas);
            let lengths = canvas.finish()?;
            let text = of_length(&text, &lengths);
            let size = |scale| format!("width=\"{}\" height=\"{}\"", width * scale, height * scale);
            Ok(text.replacen(&size(FINE), &size(1), 1).into_bytes())
        }
        Format::Png => {
            let scale = PIXELS * POINTS;
            let mut points = vec![0xff; (3 * width * scale * height * scale) as usize];
            let paper = BitMapBackend::with_buffer(&mut points, (width * scale, height * scale));
            let mut canvas = Canvas::new(paper, f64::from(scale));
            drawing.draw(&mut canvas);
            canvas.finish()?;
            let pixels = averaged(&points, (width * scale) as usize);
            encoded(&pixels, width * PIXELS, height * PIXELS)
        }
    }
}

/// Holds each text of an SVG to its length, so that a viewer without the font leaves everything in its place.
fn of_length(svg: &str, lengths: &[f64]) -> String {
    let mut parts = svg.split("<text ");
    let mut held = parts.next().unwrap_or_default().to_owned();
    for (part, length) in parts.zip(lengths) {
        held += &format!("<text textLength=\"{length:.0}\" lengthAdjust=\"spacingAndGlyphs\" {part}");
    }
    held
}

/// Each square of points as one pixel, so that edges are smooth.
fn averaged(points: &[u8], width: usize) -> Vec<u8> {
    let (side, columns) = (POINTS as usize, width / POINTS as usize);
    let rows = points.len() / 3 / width / side;
    let mut pixels = Vec::with_capacity(3 * columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            for channel in 0..3 {
                let square = (0..side * side).map(|k| {
                    let (x, y) = (column * side + k % side, row * side + k / side);
                    u32::from(points[3 * (y * width + x) + channel])
                });
                pixels.push((square.sum::<u32>() / (POINTS * POINTS)) as u8);
            }
        }
    }
    pixels
}

fn encoded(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, String> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(pixels).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(file)
}
