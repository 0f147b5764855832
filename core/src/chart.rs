//! Charts as data: panels with axes, curves, bands, marks, maps, and the words around them.
//!
//! Numbers are SI; an [`Axis`] says how they are shown. Colours are told by what they mean ([`Role`]). In all texts a `_`
//! makes the next character a subscript ([`notation`]). [`layout`] divides a page and gives a [`layout::Drawing`], which the
//! page paints and [`svg`] writes; [`csv`] writes the numbers.

pub mod clip;
pub mod csv;
pub mod decimate;
pub mod font;
pub mod layout;
pub mod notation;
pub mod scale;
pub mod svg;
pub mod ticks;

use ticks::{Steps, Tick};

/// A chart: one panel or several that share a title and a caption.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// What it shows, in a line.
    pub title: String,
    /// Panels in reading order.
    pub panels: Vec<Panel>,
    /// What it was made with: every parameter that matters, in sentences; a line break begins a paragraph.
    pub caption: String,
}

/// Two axes and what is drawn between them: map, spans, bands, bars, series, intervals and verticals, back to front.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// What it shows, above it; empty where the chart's title says it.
    pub title: String,
    /// A remark beside the title, such as what a line stands for.
    pub note: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Whether both axes have one scale, as in space: their ranges grow until it is so.
    pub equal_scales: bool,
    /// A grid of values in colour.
    pub map: Option<Map>,
    /// Spans of x that are shaded over the whole height.
    pub spans: Vec<Span>,
    /// Areas along curves, such as their confidence.
    pub bands: Vec<Band>,
    /// Filled rectangles, such as those of a histogram.
    pub bars: Vec<Bars>,
    /// Curves and rows of marks.
    pub series: Vec<Series>,
    /// Marks that reach from one value to another, such as a mean with its scatter.
    pub intervals: Vec<Intervals>,
    /// Dashed lines across the whole height, such as detections.
    pub verticals: Vec<Vertical>,
    /// Named places of the vertical axis, at its right end.
    pub rungs: Vec<Rung>,
    /// Words at the right of the data, each beside a place of the vertical axis.
    pub asides: Vec<Aside>,
    /// Whether the upper edge says where a solid curve lies beyond it.
    pub off_scale: bool,
}

impl Panel {
    /// An empty panel between two axes.
    #[must_use]
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            title: String::new(),
            note: String::new(),
            x,
            y,
            equal_scales: false,
            map: None,
            spans: Vec::new(),
            bands: Vec::new(),
            bars: Vec::new(),
            series: Vec::new(),
            intervals: Vec::new(),
            verticals: Vec::new(),
            rungs: Vec::new(),
            asides: Vec::new(),
            off_scale: false,
        }
    }
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The quantity, such as `θ_L`.
    pub name: &'static str,
    /// Unit of the numbers, such as `rad`; 1 for none.
    pub si_unit: &'static str,
    /// Unit shown, such as `°`; 1 or nothing for none.
    pub unit: &'static str,
    /// Numbers are multiplied by this to be shown.
    pub scale: f64,
    /// Ends of the axis, SI, where what is drawn should not decide them.
    pub range: Option<[f64; 2]>,
    /// Which numbers are marked, and how they lie.
    pub steps: Steps,
    /// Marks at given places (SI), in place of those of `steps`: with names as texts, each is a category.
    pub ticks: Vec<Tick>,
    /// Whether it runs the other way: to the left, or downward.
    pub falling: bool,
    /// Whether its marks have no texts, for those of a panel below stand for them.
    pub bare: bool,
}

impl Axis {
    /// An axis whose marks are round numbers.
    #[must_use]
    pub const fn new(name: &'static str, si_unit: &'static str, unit: &'static str, scale: f64) -> Self {
        Self {
            name,
            si_unit,
            unit,
            scale,
            range: None,
            steps: Steps::Decimal,
            ticks: Vec::new(),
            falling: false,
            bare: false,
        }
    }

    /// An axis of categories, one at each whole number from 0 on, down the page or to the right.
    #[must_use]
    pub fn categories(name: &'static str, texts: impl IntoIterator<Item = String>, falling: bool) -> Self {
        let tick = |(k, text): (usize, String)| Tick { value: k as f64, text };
        let ticks: Vec<Tick> = texts.into_iter().enumerate().map(tick).collect();
        let range = Some([-0.5, ticks.len().max(1) as f64 - 0.5]);
        Self { range, ticks, falling, ..Self::new(name, "1", "1", 1.0) }
    }

    /// Its name with the unit, such as `θ_L (°)`.
    #[must_use]
    pub fn title(&self) -> String {
        if matches!(self.unit, "1" | "") { self.name.into() } else { format!("{} ({})", self.name, self.unit) }
    }
}

/// What something means, which gives its colour.
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
    /// A log likelihood ratio.
    Likelihood,
    /// A threshold or a bound, or all methods together.
    Bound,
    /// The robot itself.
    Robot,
    /// A detection.
    Detection,
    /// Contact, and what touches.
    Contact,
    /// What matters less.
    Aside,
    /// What a person chose.
    Choice,
    /// One of a family, by its share from 0 (first) to 1 (last): a shade of an even colour map.
    Member(f64),
}

/// A curve or a row of marks.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; series of one name and look are one entry, without a name there is none.
    pub name: String,
    /// What it means.
    pub role: Role,
    /// How it is drawn.
    pub style: Style,
    /// Whether it stands back behind the others.
    pub faint: bool,
    /// Whether each of its marks is drawn, though they touch.
    pub every: bool,
    /// Points, SI; a NaN is a gap.
    pub points: Vec<[f64; 2]>,
}

impl Series {
    /// A series in full strength.
    #[must_use]
    pub fn new(name: impl Into<String>, role: Role, style: Style, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.into(), role, style, faint: false, every: false, points }
    }
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A thin line: what another is compared with.
    Thin,
    /// A heavy line: where something truly is.
    Heavy,
    /// A dashed line.
    Dashed,
    /// A line of long dashes.
    LongDashed,
    /// A dotted line.
    Dotted,
    /// A line of dashes and dots in turn.
    DashDotted,
    /// A triangle at each point.
    Triangles,
    /// A circle at each point.
    Circles,
    /// A dot at each point: what is set.
    Dots,
    /// A diamond at each point.
    Diamonds,
    /// A ring around each point: what is advised.
    Rings,
    /// A dot at each point, with lines to all four sides.
    Targets,
}

/// Lengths of two dashes, each with the gap behind it.
pub type Dash = [f64; 4];

impl Style {
    /// Whether it is a line, and not marks.
    #[must_use]
    pub fn is_line(self) -> bool {
        matches!(self, Self::Line | Self::Thin | Self::Heavy) || self.dash().is_some()
    }

    /// The dashes of a line, in heights of the text; none for what has no dashes.
    #[must_use]
    pub fn dash(self) -> Option<Dash> {
        match self {
            Self::Dashed => Some([0.5, 0.32, 0.5, 0.32]),
            Self::LongDashed => Some([1.3, 0.3, 1.3, 0.3]),
            Self::Dotted => Some([0.13, 0.25, 0.13, 0.25]),
            Self::DashDotted => Some([0.8, 0.24, 0.14, 0.24]),
            _ => None,
        }
    }
    /// Its name in a table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Thin => "thin",
            Self::Heavy => "heavy",
            Self::Dashed => "dashed",
            Self::LongDashed => "long dashed",
            Self::Dotted => "dotted",
            Self::DashDotted => "dash-dotted",
            Self::Triangles => "triangles",
            Self::Circles => "circles",
            Self::Dots => "dots",
            Self::Diamonds => "diamonds",
            Self::Rings => "rings",
            Self::Targets => "targets",
        }
    }
}

/// An area along a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// What it means.
    pub role: Role,
    /// Whether it stands back behind the others.
    pub faint: bool,
    /// Its edges at each point of the curve, SI: on one side, and on the other. A NaN is a gap.
    pub edges: Vec<[[f64; 2]; 2]>,
}

/// Filled rectangles of one meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Bars {
    /// Name in the legend; bars of one name and role are one entry, without a name there is none.
    pub name: String,
    /// What they mean.
    pub role: Role,
    /// Two opposite corners of each, SI.
    pub corners: Vec<[[f64; 2]; 2]>,
}

/// Marks with their ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Intervals {
    /// Name in the legend; intervals of one name and role are one entry, without a name there is none.
    pub name: String,
    /// What they mean.
    pub role: Role,
    /// One end, the mark, and the other end of each, SI; a mark with an end that is a NaN stands alone.
    pub ends: Vec<[[f64; 2]; 3]>,
}

/// A vertical line, in dashes by what it means: see [`Vertical::style`].
#[derive(Debug, Clone, PartialEq)]
pub struct Vertical {
    /// Name in the legend; lines of one name are one entry, without a name there is none.
    pub name: &'static str,
    /// Where, SI.
    pub x: f64,
    /// What it means.
    pub role: Role,
}

impl Vertical {
    /// How a line of this meaning is drawn: those that stand in one panel differ without their colour.
    #[must_use]
    pub fn style(role: Role) -> Style {
        match role {
            Role::Contact => Style::Dotted,
            Role::Detection => Style::DashDotted,
            _ => Style::Dashed,
        }
    }
}

/// A shaded span of x.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// What it is, in the legend.
    pub name: &'static str,
    /// What it means.
    pub role: Role,
    /// Whether a strip at the foot of the data stands for it, in place of a shade over the whole height.
    pub low: bool,
    /// Its ends, SI.
    pub ends: [f64; 2],
}

/// Words beside a place of the vertical axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Aside {
    /// Where, SI.
    pub y: f64,
    /// Its lines, the one that matters most first: what does not fit is left out.
    pub lines: Vec<String>,
}

/// A named place of the vertical axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// Its name.
    pub name: String,
    /// Where, SI.
    pub y: f64,
}

/// A grid of values in colour, with the bar that explains the colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Unit of the values shown, above the bar.
    pub unit: &'static str,
    /// Values are multiplied by this to be shown.
    pub scale: f64,
    /// Cells to a row.
    pub columns: usize,
    /// Values, SI, row by row; NaN where there is none.
    pub values: Vec<f64>,
    /// Cells that stand back; none of them when empty.
    pub faint: Vec<bool>,
    /// Outer edges of the first and of the last column, SI.
    pub x: [f64; 2],
    /// Outer edges of the first and of the last row, SI.
    pub y: [f64; 2],
    /// The values with the darkest and with the lightest colour; those beyond are as these.
    pub ends: [f64; 2],
    /// The value whose line is drawn, where there is one, and the line's pieces, SI.
    pub level: Option<f64>,
    /// Pieces of that line, SI.
    pub line: Vec<[[f64; 2]; 2]>,
}

impl Map {
    /// Rows of cells.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.values.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Where a value lies between the darkest colour (0) and the lightest (1); NaN where there is none.
    #[must_use]
    pub fn share(&self, value: f64) -> f64 {
        let [dark, light] = self.ends;
        if light == dark { 0.0 * value } else { ((value - dark) / (light - dark)).clamp(0.0, 1.0) }
    }

    /// Whether a cell stands back.
    #[must_use]
    pub fn is_faint(&self, cell: usize) -> bool {
        self.faint.get(cell).copied().unwrap_or(false)
    }
}
