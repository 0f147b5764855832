//! A track on the loop's clock: the last value, while it is not too old.

use super::{Happening, Place, Report, Track};

/// Steps of the loop by which a row may be late and still be in time: the rounding of its stamp.
const LATE: f64 = 1e-6;

/// Holds the last value of a track.
#[derive(Debug)]
pub struct Held<'a, const D: usize> {
    track: &'a Track<D>,
    /// The longest that a value is held, s.
    limit: f64,
    late: f64,
    /// Place of the next row.
    next: usize,
    /// How often a value was held, and when first.
    held: (u64, f64),
    /// How often there was none that is young enough, and when first.
    missing: (u64, f64),
    /// How many rows a later one overtook, and the first.
    passed: (u64, usize),
}

impl<'a, const D: usize> Held<'a, D> {
    /// Before the first instant of a loop of `rate` Hz.
    pub fn new(track: &'a Track<D>, limit: f64, rate: f64) -> Self {
        Self { track, limit, late: LATE / rate, next: 0, held: (0, 0.0), missing: (0, 0.0), passed: (0, 0) }
    }

    /// The value at the next instant (s).
    pub fn at(&mut self, time: f64) -> [f64; D] {
        let before = self.next;
        while self.track.times.get(self.next).is_some_and(|at| *at <= time + self.late) {
            self.next += 1;
        }
        let over = (self.next - before).saturating_sub(1);
        if over > 0 {
            let first = if self.passed.0 == 0 { before } else { self.passed.1 };
            self.passed = (self.passed.0 + over as u64, first);
        }
        let last = self.next.checked_sub(1);
        let fresh = self.next > before;
        let Some(last) = last.filter(|last| fresh || time - self.track.times[*last] <= self.limit) else {
            once_more(&mut self.missing, time);
            return [f64::NAN; D];
        };
        if !fresh {
            once_more(&mut self.held, time);
        }
        self.track.values[last]
    }

    /// Reports what was held and what was missing, on a clock that starts `start` (s) later.
    pub fn tell(&self, [held, gap]: [Happening; 2], start: f64, report: &mut Report) {
        if self.track.is_empty() {
            return;
        }
        let Self { held: (holds, first_held), missing: (misses, first_missing), passed: (passed, first), .. } = self;
        report.add_many(held, *holds, Place::default(), Some(first_held - start));
        report.add_many(gap, *misses, Place::default(), Some(first_missing - start));
        let line = self.track.lines.get(*first).map_or(0, |line| u64::from(*line));
        let place = Place { name: self.track.file.clone(), ..Place::line(line) };
        report.add_many(Happening::PassedOver, *passed, place, None);
        if *misses > 0 {
            let what = match held {
                Happening::HeldReading => "reading",
                Happening::HeldCommand => "command",
                _ => "load cell's value",
            };
            let limit = crate::scenario::text::number(self.limit);
            report.notes.push(format!("a {what} is held for at most {limit} s"));
        }
    }
}

fn once_more((count, first): &mut (u64, f64), time: f64) {
    if *count == 0 {
        *first = time;
    }
    *count += 1;
}
