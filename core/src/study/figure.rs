//! The paper's figures: the work that makes each of them, and the chart that comes of it.
//!
//! Reading order: `job` (which figure, and the work it takes), then one file per figure: `bound` (3), `centrodes` (4),
//! `residuals` (6), `bend` (7), `deviations` (8); `content` is what they have in common, `plans`, `thin` and `words` help them.

mod bend;
mod bound;
mod centrodes;
mod content;
mod deviations;
mod job;
mod plans;
mod residuals;
pub(super) mod thin;
pub(super) mod words;

pub use job::{FigureJob, Number, UnknownFigure};
