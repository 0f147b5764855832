//! The figures: which chart each of them is, and how it is drawn into the page.
//!
//! Reading order: `paper` (figures that the page has as well), `halves` (why the deviation is near s_c/2), `places` (what the filter
//! does to the place, and what no estimate can beat), `chains` (segments in series), `draw` (a chart as SVG whose colours follow the page's).

pub mod chains;
mod draw;
mod halves;
mod paper;
mod places;

pub use draw::Colours;

use anyhow::{Result, bail};
use centrode_core::chart::Chart;

/// A figure of the theory.
#[derive(Debug)]
pub struct Figure {
    /// What is drawn.
    pub chart: Chart,
    /// The name of the state of the page that shows it, and what the page then shows.
    pub state: (&'static str, &'static str),
    /// Sizes on a wide screen and on a narrow one, points.
    pub sizes: [[f64; 2]; 2],
}

/// Names of all figures.
#[cfg(test)]
pub const NAMES: [&str; 11] = [
    "bound",
    "loci",
    "detections",
    "map",
    "centroids",
    "half",
    "place-threshold",
    "place-bound",
    "chain-blame",
    "chain-place",
    "chain-margin",
];

/// Sizes of a figure with one panel.
const SINGLE: [[f64; 2]; 2] = [[720.0, 380.0], [350.0, 290.0]];
/// Sizes of a figure with two panels: beside each other and above each other.
const DOUBLE: [[f64; 2]; 2] = [[720.0, 370.0], [350.0, 600.0]];

/// Makes the figure of a name.
pub fn figure(name: &str) -> Result<Figure> {
    let (chart, state, sizes) = match name {
        "bound" => (paper::figure(3)?, ("figure-3", "Figure 3 in Centrode"), SINGLE),
        "loci" => (paper::figure(4)?, ("figure-4", "Figure 4 in Centrode"), DOUBLE),
        "detections" => (paper::figure(8)?, ("figure-8", "Figure 8 in Centrode"), SINGLE),
        "map" => (paper::map()?, ("map", "the map in Centrode"), DOUBLE),
        "centroids" => (halves::centroids()?, ("bench", "this contact in Centrode"), SINGLE),
        "half" => (halves::half()?, ("disk-1", "a contact that stays below ξ₂"), SINGLE),
        "place-threshold" => (places::against_threshold()?, ("disk-3", "disk 3 as it is detected"), SINGLE),
        "place-bound" => (places::bound()?, ("miscalibrated", "a robot that is not calibrated"), SINGLE),
        "chain-blame" => (chains::blame()?, ("three-segments", "three segments in Centrode"), SINGLE),
        "chain-place" => (chains::places()?, ("two-contacts", "both contacts in Centrode"), SINGLE),
        "chain-margin" => (chains::margins()?, ("buckling", "a chain that buckles in Centrode"), SINGLE),
        _ => bail!("there is no figure called {name:?}"),
    };
    Ok(Figure { chart, state, sizes })
}
