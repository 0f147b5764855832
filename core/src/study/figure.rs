//! The paper's figures, as data: the command draws them to files, the page to the screen.
//!
//! A `_` in a name makes the next character a subscript, as in `θ_L`. Reading order: the types here, `job` (which
//! figure, and the work it takes), then one file per figure: `bound` (3), `centrodes` (4), `residuals` (6),
//! `bend` (7), `deviations` (8); `plans`, `thin` and `words` help them.

mod bend;
mod bound;
mod centrodes;
mod deviations;
mod job;
mod plans;
mod residuals;
mod thin;
mod words;

pub use job::{FigureJob, Number, UnknownFigure};

/// A figure: curves, marks and words. Numbers in SI; [`Axis`] says how they are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it shows, in a line.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, back to front.
    pub series: Vec<Series>,
    /// Lines across the whole height, such as detections.
    pub verticals: Vec<Vertical>,
    /// Spans of x that are shaded over the whole height.
    pub spans: Vec<Span>,
    /// Whether both axes have one scale, as in space.
    pub equal_scales: bool,
    /// What it was made with: every parameter that matters, in a sentence.
    pub caption: String,
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The quantity, such as `θL`.
    pub name: &'static str,
    /// Unit of the numbers, such as `rad`; 1 for none.
    pub si_unit: &'static str,
    /// Unit shown, such as `°`.
    pub unit: &'static str,
    /// Numbers are multiplied by this to be shown.
    pub scale: f64,
    /// Ends of the axis, SI, where what is drawn should not decide them.
    pub range: Option<[f64; 2]>,
}

/// A curve or a row of marks.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; series of one name and role are one entry.
    pub name: String,
    /// What it means, which gives its colour.
    pub role: Role,
    /// How it is drawn.
    pub style: Style,
    /// Points, SI; a NaN is a gap.
    pub points: Vec<[f64; 2]>,
}

/// What a series means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Role {
    /// The model without constraint.
    Model,
    /// The constrained model.
    Constrained,
    /// What the tracker says.
    Sensor,
    /// What the load cells say.
    Force,
    /// A threshold or a bound.
    Bound,
    /// The robot itself.
    Robot,
    /// One of a family, by its share from 0 (first) to 1 (last): a shade of an even colour map.
    Member(f64),
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// A triangle at each point.
    Triangles,
    /// A circle at each point.
    Circles,
}

/// A vertical dashed line.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertical {
    /// Name in the legend; lines of one name are one entry.
    pub name: &'static str,
    /// Where, SI.
    pub x: f64,
    /// What it means.
    pub mark: Mark,
}

/// What a vertical line marks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A detection.
    Detection,
    /// Where contact began in truth.
    Contact,
}

/// A shaded span of x.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// What it is, in the legend.
    pub name: &'static str,
    /// Its ends, SI.
    pub ends: [f64; 2],
}
