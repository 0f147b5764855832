//! Figures that the command and the page have as well.

use anyhow::Result;
use centrode_core::chart::Chart;
use centrode_core::scenario::{Plan, preset};
use centrode_core::study::Job;
use centrode_core::study::figure::{FigureJob, Number};
use centrode_core::study::map::{MapJob, chart};

/// Cells of the map, columns and rows.
const CELLS: [usize; 2] = [48, 36];

/// A figure of the paper, of its own preset.
pub fn figure(number: u8) -> Result<Chart> {
    let number: Number = number.to_string().parse()?;
    let mut job = FigureJob::new(number, &preset::find(number.preset())?.scenario()?)?;
    job.finish();
    Ok(job.chart())
}

/// Which contacts are detectable on the bench.
pub fn map() -> Result<Chart> {
    let scenario = preset::find("bench")?.scenario()?;
    let mut job = MapJob::new(&scenario, CELLS[0], CELLS[1])?;
    job.finish();
    Ok(chart::chart(job.map(), &Plan::new(&scenario)?))
}
