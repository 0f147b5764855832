//! Rows about joint forces: the load cells, the load on the tip, and what ξ1 is.

use crate::app::controls::control::Scale::{self, Linear, Log};
use crate::app::controls::control::{Choice, Control};
use crate::app::controls::table::{key, row};

/// The load cells.
pub const CELLS: &[Control] =
    &[row("load_cells.noise", "Load cell noise", 3, Log(0.001)), row("load_cells.preload", "Preload", 1, Linear(0.5))];

/// Their options.
pub const CELL_CHOICES: &[Choice] =
    &[Choice { of: key("load_cells.errors"), label: "Cell errors", hint: "", options: &["common", "independent"] }];

/// Why a preload matters to one bound and not to the other.
pub const PRELOAD_NOTE: &str = "A preload pulls on all three backbones alike, and equal forces bend nothing: an error \
    common to the cells cancels, so ε_c does not depend on the preload. Errors that differ between the cells leave a part of it, so the \
    bound for independent errors grows with the preload.";

/// One part of a vector.
pub(super) const fn part(
    path: &'static str,
    of: &str,
    part: usize,
    label: &'static str,
    decimals: usize,
    scale: Scale,
) -> Control {
    Control { key: path, of: key(of), part: Some(part), label, decimals, scale, hint: "", words: None, only: None }
}

/// The wrench on the end disk.
pub const LOAD: &[Control] = &[
    part("load.force[0]", "load.force", 0, "Force x", 2, Linear(0.05)),
    part("load.force[1]", "load.force", 1, "Force y", 2, Linear(0.05)),
    part("load.force[2]", "load.force", 2, "Force z", 2, Linear(0.05)),
    part("load.moment[0]", "load.moment", 0, "Moment x", 1, Linear(1.0)),
    part("load.moment[1]", "load.moment", 1, "Moment y", 1, Linear(1.0)),
    part("load.moment[2]", "load.moment", 2, "Moment z", 1, Linear(1.0)),
    row("load.start", "Load begins", 2, Linear(0.05)),
    row("load.finish", "Full load from", 2, Linear(0.05)),
];

/// What ξ1 is, what Eq. 24 takes the contact to be, which detectors judge, and what places the contact that they tell of.
pub const CHOICES: &[Choice] = &[
    Choice {
        of: key("detection.xi1_rule"),
        label: "ξ1 is",
        hint: "Both are drawn; the one that judges is solid.",
        options: &["constant", "follows shape"],
    },
    Choice {
        of: key("estimation.kind"),
        label: "Located as",
        hint: "What Eq. 24 takes the contact to be.",
        options: &["clamp", "plane", "simulated"],
    },
    Choice {
        of: key("detection.arming"),
        label: "Armed from applies to",
        hint: "",
        options: &["FCD and JFD", "all detectors"],
    },
    Choice {
        of: key("detection.detectors"),
        label: "Detectors",
        hint: "",
        options: &["FCD", "JFD", "FCD consistent", "FCD velocity", "CUSUM", "GLR"],
    },
    Choice {
        of: key("estimation.estimators"),
        label: "Placed by",
        hint: "After an alarm of CUSUM or GLR.",
        options: &["Eq. 24", "settled", "marginal"],
    },
    Choice { of: key("estimation.plants"), label: "Thought possible", hint: "", options: &["a clamp", "a plane"] },
];
