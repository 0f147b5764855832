//! Charts as files: vectors, pixels or numbers.

use super::output::{Failure, NewFile};
use crate::show::paper::{PIXELS, svg};
use centrode_core::chart::Chart;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use std::io::Write;
use std::path::Path;

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
        let wrong =
            |what: String| Failure::Input(format!("{flag} {}: {what}; known extensions: {known}", path.display()));
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
                Err(Failure::Input(format!("{flag} {}: not a drawing; known extensions: .svg, .png", path.display())))
            }
        }
    }
}

/// The page's fonts: a drawing needs none of the machine.
const FONTS: [&[u8]; 2] =
    [include_bytes!("../../assets/fonts/Inter-Regular.otf"), include_bytes!("../../assets/fonts/Inter-SemiBold.otf")];

/// Draws a chart to its file.
pub fn write(file: &mut NewFile, chart: &Chart, format: Format) -> Result<(), Failure> {
    let text = svg(chart);
    let bytes = match format {
        Format::Svg => text.into_bytes(),
        Format::Png => pixels(&text).map_err(|error| Failure::Input(format!("the drawing failed: {error}")))?,
    };
    file.write_all(&bytes).map_err(|error| file.blame(&error))
}

/// An SVG as PNG.
fn pixels(text: &str) -> Result<Vec<u8>, String> {
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    FONTS.into_iter().for_each(|font| fonts.load_font_data(font.to_vec()));
    let tree = Tree::from_str(text, &options).map_err(|error| error.to_string())?;
    let size = tree.size();
    let scale = PIXELS as f32;
    let side = |points: f32| (points * scale).round() as u32;
    let mut pixmap = Pixmap::new(side(size.width()), side(size.height())).ok_or("it has no size")?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::chart::font::{FAMILY, STRONG_FAMILY, has, plain_width};
    use centrode_core::chart::notation::{printed, runs};
    use centrode_core::scenario::preset::find;
    use centrode_core::study::Job;
    use centrode_core::study::figure::{FigureJob, Number};

    /// Width of a text as the font itself has it, in sizes of the text.
    fn drawn(text: &str, strong: bool) -> f64 {
        let (family, weight) = if strong { (STRONG_FAMILY, 600) } else { (FAMILY, 400) };
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9000\" height=\"99\"><text y=\"50\" font-size=\"10\" \
             font-kerning=\"none\" font-family=\"{family}\" font-weight=\"{weight}\">{text}</text></svg>"
        );
        let mut options = Options::default();
        FONTS.into_iter().for_each(|font| options.fontdb_mut().load_font_data(font.to_vec()));
        let tree = Tree::from_str(&svg, &options).expect("an SVG");
        f64::from(tree.root().bounding_box().width()) / 10.0
    }

    #[test]
    fn the_layout_s_widths_are_the_font_s() {
        for text in ["Fixed centrode deviation (mN·m)", "θεξΘωφδ‖±−–·²", "0123456789.,:;%°", "Größe éàçñ"]
        {
            for strong in [false, true] {
                let (layout, font) = (plain_width(text, strong), drawn(text, strong));
                assert!((layout - font).abs() < 0.02 * font, "{text:?}: {layout} for {font}");
            }
        }
    }

    #[test]
    fn the_font_has_every_character_of_every_figure() {
        for number in Number::ALL {
            let scenario = find(number.preset()).expect("its preset").scenario().expect("a scenario");
            let mut job = FigureJob::new(number, &scenario).expect("a plan");
            job.finish();
            let svg = svg(&job.chart());
            let chart = job.chart();
            let words = printed(&(chart.title + &chart.caption)) + &svg;
            let missing: Vec<char> = runs(&words)
                .iter()
                .flat_map(|run| run.text.chars().collect::<Vec<_>>())
                .filter(|character| !character.is_whitespace() && !has(*character))
                .collect();
            assert!(missing.is_empty(), "figure {number}: {missing:?}");
        }
    }
}
