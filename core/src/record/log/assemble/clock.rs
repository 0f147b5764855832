//! The loop's clock: how fast it ran, and when each instant was.

use super::{Log, LogError, Report};
use crate::scenario::Scenario;
use crate::scenario::text::number;
use libm::{floor, rint};

/// The times of the rows that the loop wrote: commands, else readings, else load cells.
pub fn times(log: &Log) -> Result<&[f64], LogError> {
    let tracks = [&log.commands.times, &log.joints.times, &log.readings.times, &log.forces.times];
    let times = tracks.into_iter().find(|times| !times.is_empty());
    times.map(Vec::as_slice).ok_or_else(|| LogError::file("holds no row that can be used"))
}

/// The usual spacing of rows, s; none for fewer than two.
pub fn median(times: &[f64]) -> Option<f64> {
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if steps.is_empty() {
        return None;
    }
    let middle = (steps.len() - 1) / 2;
    Some(*steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The rate of rows, Hz: gaps do not count, and a rate that is round but for the rounding of stamps is round.
pub fn rate(times: &[f64]) -> Result<f64, LogError> {
    let median =
        median(times).ok_or_else(|| LogError::file("has one row alone, which says nothing about the loop's rate"))?;
    let steps = times.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step < 1.5 * median);
    let (sum, count) = steps.fold((0.0, 0.0), |(sum, count), step| (sum + step, count + 1.0));
    let rate: f64 = count / sum;
    let round = format!("{rate:.3e}").parse().unwrap_or(rate);
    Ok(if (rate - round).abs() < 2e-4 * round { round } else { rate })
}

/// What is subtracted from the log's times, s: its first time where its clock cannot be the scenario's, else 0.
pub fn start(first: f64, origin: f64, scenario: &Scenario, report: &mut Report) -> f64 {
    if origin != 0.0 {
        report.notes.push(format!("times are counted from the first row, at {} s", number(origin + first)));
        return first;
    }
    if (0.0..=scenario.motion.end).contains(&first) {
        return 0.0;
    }
    let why = if first < 0.0 { "before 0" } else { "after motion.end" };
    report.notes.push(format!("times are counted from the first row, at {} s, which lies {why}", number(first)));
    first
}

/// The instants of the loop.
#[derive(Debug)]
pub struct Ticks<'a> {
    times: &'a [f64],
    rate: f64,
    /// Whether each row is an instant's own.
    aligned: bool,
    count: usize,
}

/// More instants than this for each value of a log are no recording.
const SPARSE: f64 = 10_000.0;
/// A row this near to an instant, in steps, is the instant's own.
const NEAR: f64 = 0.25;

impl<'a> Ticks<'a> {
    /// From the first row to the last, at `rate` (Hz), at most so many; `rows` is how many values the log has in all.
    pub fn new(
        (times, rows): (&'a [f64], usize),
        rate: f64,
        most: usize,
        report: &mut Report,
    ) -> Result<Self, LogError> {
        let (first, last) = (times[0], times[times.len() - 1]);
        let steps = floor((last - first) * rate + 0.5);
        if steps >= most as f64 {
            let what = format!(
                "{} s at {} Hz are {} instants of the loop, and at most {most} can be kept: cut the log, or set loop_rate lower",
                number(last - first),
                number(rate),
                number(steps + 1.0)
            );
            return Err(LogError::file(what));
        }
        // Memory is bounded by what the log holds, and so far apart nothing is held.
        if steps > SPARSE * rows as f64 {
            let what = format!(
                "{} s at {} Hz are {} instants of the loop from {rows} values: is the unit of the time right?",
                number(last - first),
                number(rate),
                number(steps + 1.0)
            );
            return Err(LogError::file(what));
        }
        let mut ticks = Self { times, rate, aligned: true, count: steps as usize + 1 };
        let mut before = -1.0;
        ticks.aligned = times.iter().all(|time| {
            let (place, at) = ticks.place(*time);
            let own = (at - place).abs() <= NEAR && place > before;
            before = place;
            own
        });
        if !ticks.aligned {
            report.notes.push(format!(
                "the rows do not lie on a clock of {} Hz: at each instant of the loop the last row is held",
                number(rate)
            ));
        }
        Ok(ticks)
    }

    /// The instant nearest to a time, and where it truly lies, in steps.
    fn place(&self, time: f64) -> (f64, f64) {
        let at = (time - self.times[0]) * self.rate;
        (rint(at), at)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// When they are, s on the log's clock.
    pub fn instants(&self) -> impl Iterator<Item = f64> {
        let mut rows = self.times.iter().copied().peekable();
        (0..self.count).map(move |k| {
            let place = k as f64;
            match rows.peek().filter(|time| self.aligned && self.place(**time).0 == place) {
                Some(_) => rows.next().unwrap_or_default(),
                None => self.times[0] + place / self.rate,
            }
        })
    }
}
