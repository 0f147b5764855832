//! Rows about joint forces: the load cells, the load on the tip, and what ξ1 is.

use crate::app::controls::control::{Choice, Control};
use crate::app::controls::table::Quantity::{Force, Moment, Time};
use crate::app::controls::table::Scale::{Linear, Log};
use crate::app::controls::table::{Field, row};
use centrode_core::scenario::{CellErrors, Xi1Rule};

/// The load cells.
pub const CELLS: &[Control] = &[
    row(
        "load_cells.noise",
        "Load cell noise",
        Force,
        3,
        Log(0.001),
        |_| (0.0, 5.0),
        field!(load_cells.noise),
        "Standard deviation of white noise on each load cell.",
    ),
    row(
        "load_cells.preload",
        "Preload",
        Force,
        1,
        Linear(0.5),
        |_| (0.0, 50.0),
        field!(load_cells.preload),
        "Force added to all three secondary backbones alike.",
    ),
];

/// Their options.
pub const CELL_CHOICES: &[Choice] = &[Choice {
    key: "load_cells.errors",
    label: "Cell errors",
    tip: "All three cells err by ε_τ, or each by its own part of it, drawn from the seed.",
    options: &["common", "independent"],
    get: |s| usize::from(s.load_cells.errors == CellErrors::Independent),
    set: |s, i| s.load_cells.errors = if i == 0 { CellErrors::Common } else { CellErrors::Independent },
    copy: |from, to| to.load_cells.errors = from.load_cells.errors,
}];

/// Why a preload matters to one bound and not to the other.
pub const PRELOAD_NOTE: &str = "A preload pulls on all three backbones alike, and equal forces bend nothing: an error \
    common to the cells cancels in it, so ε_c does not know the preload. Cells that err apart leave a part of it, so the \
    bound for independent errors grows with it.";

const fn force(key: &'static str, label: &'static str, field: Field) -> Control {
    let tip = "Force at the end disk's centre, along this axis of the base.";
    row(key, label, Force, 2, Linear(0.05), |_| (-5.0, 5.0), field, tip)
}

const fn moment(key: &'static str, label: &'static str, field: Field) -> Control {
    let tip = "Moment on the end disk, along this axis of the base.";
    row(key, label, Moment, 1, Linear(1.0), |_| (-50.0, 50.0), field, tip)
}

/// The wrench on the end disk.
pub const LOAD: &[Control] = &[
    force("load.force[0]", "Force x", field!(part 0 of load.force)),
    force("load.force[1]", "Force y", field!(part 1 of load.force)),
    force("load.force[2]", "Force z", field!(part 2 of load.force)),
    moment("load.moment[0]", "Moment x", field!(part 0 of load.moment)),
    moment("load.moment[1]", "Moment y", field!(part 1 of load.moment)),
    moment("load.moment[2]", "Moment z", field!(part 2 of load.moment)),
    row(
        "load.start",
        "Load begins",
        Time,
        2,
        Linear(0.05),
        |s| (0.0, s.load.finish),
        field!(load.start),
        "From here on it grows evenly.",
    ),
    row(
        "load.finish",
        "Load is whole",
        Time,
        2,
        Linear(0.05),
        |s| (s.load.start, s.motion.end.max(s.load.start + 0.1)),
        field!(load.finish),
        "From here on it stays.",
    ),
];

/// What ξ1 is.
pub const XI1_CHOICES: &[Choice] = &[Choice {
    key: "detection.xi1_rule",
    label: "ξ1 is",
    tip: "One constant, or following the shape: k times the bound ε_c of the shape commanded: both are drawn, the one that judges is solid.",
    options: &["constant", "follows shape"],
    get: |s| usize::from(s.detection.xi1_rule == Xi1Rule::Bound),
    set: |s, i| s.detection.xi1_rule = if i == 0 { Xi1Rule::Constant } else { Xi1Rule::Bound },
    copy: |from, to| to.detection.xi1_rule = from.detection.xi1_rule,
}];
