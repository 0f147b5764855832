//! A chart as a file shows it: on white, with title and caption, in the page's font. The same bytes wherever it is written.

use super::ink;
use crate::scene::palette::Palette;
use centrode_core::chart::Chart;
use centrode_core::chart::layout::{Ink, Page, layout};
use centrode_core::chart::svg;

/// Pixels to a point where a chart becomes pixels.
pub const PIXELS: u32 = 2;

/// Size of the paper and of its text, points: of a chart with one panel, of one with several, of one with four, and of panels over
/// one time axis, which stand above each other.
const SINGLE: ([f64; 2], f64) = ([1200.0, 820.0], 15.0);
const SEVERAL: ([f64; 2], f64) = ([1280.0, 640.0], 14.0);
const FOUR: ([f64; 2], f64) = ([1280.0, 1080.0], 14.0);
const OVER_TIME: ([f64; 2], f64) = ([1200.0, 1260.0], 14.0);

/// Writes a chart as SVG.
#[must_use]
pub fn svg(chart: &Chart) -> String {
    let (size, text) = match &chart.panels[..] {
        [] | [_] => SINGLE,
        [first, rest @ ..] if first.x.si_unit == "s" && rest.iter().all(|panel| panel.x == first.x) => OVER_TIME,
        [_, _, _, _] => FOUR,
        _ => SEVERAL,
    };
    let drawing = layout(chart, &Page { words: true, pixel: 1.0 / f64::from(PIXELS), ..Page::screen(size, text) });
    let color = |ink: Ink| {
        let [r, g, b, _] = ink::color(ink, &Palette::LIGHT, false).to_bytes();
        [r, g, b]
    };
    svg::svg(&drawing, chart, &color)
}
