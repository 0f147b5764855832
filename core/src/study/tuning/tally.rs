//! What repeats of one scenario came to: whole numbers, so that the order in which they are added changes nothing.

use super::rate::{Share, wilson};
use super::watch::{Firsts, NEVER, Rule};
use libm::{ceil, sqrt};
use serde::{Deserialize, Serialize};

/// What is known of the runs before they are made, in samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Loop rate, Hz.
    pub rate: f64,
    /// The first sample in which alarms are armed; at most the run's length.
    pub armed: u32,
    /// The run's length.
    pub samples: u32,
    /// An alarm more than this after contact comes too late.
    pub late: u32,
}

/// Counts for one threshold.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Count {
    /// Alarms before contact; without contact, all.
    pub early: u64,
    /// Samples from arming to these alarms, all together.
    pub early_samples: u64,
    /// Alarms that came too late.
    pub late: u64,
    /// Contacts found: samples after contact, rising, and how many were found then.
    ///
    /// As many entries as there are samples in which an alarm is not late: a bound, however many runs are made.
    pub found: Vec<(u32, u32)>,
}

/// Counts of all runs with one scenario.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Runs counted.
    pub runs: u64,
    /// Truth: the first sample in contact, the earliest of all runs; none without contact or before the first run.
    pub contact: Option<u32>,
    /// By rule and level; empty before the first run, so that what is not begun takes no memory.
    pub counts: Vec<Vec<Count>>,
}

/// What is counted of one threshold, in so many runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counted<'a> {
    /// Runs counted.
    pub runs: u64,
    /// What they came to.
    pub count: &'a Count,
}

impl Tally {
    /// Counts one run in.
    pub fn add(&mut self, firsts: &Firsts, clock: &Clock) {
        self.runs += 1;
        self.contact = self.contact.into_iter().chain(firsts.contact).min();
        self.counts.resize_with(firsts.alarms.len(), Vec::new);
        for (counts, alarms) in self.counts.iter_mut().zip(&firsts.alarms) {
            counts.resize_with(alarms.len(), Count::default);
            for (count, &first) in counts.iter_mut().zip(alarms) {
                count.add(first, firsts.contact, clock);
            }
        }
    }

    /// Whether so many runs of a scenario with this clock can have come to it.
    #[must_use]
    pub fn is_of(&self, runs: u64, clock: &Clock) -> bool {
        self.runs == runs && self.counts.iter().flatten().all(|count| count.is_of(runs, clock))
    }

    /// Counts in what other runs with the same scenario came to.
    pub fn join(&mut self, other: &Self) {
        self.runs += other.runs;
        self.contact = self.contact.into_iter().chain(other.contact).min();
        self.counts.resize_with(other.counts.len().max(self.counts.len()), Vec::new);
        for (counts, others) in self.counts.iter_mut().zip(&other.counts) {
            counts.resize_with(others.len().max(counts.len()), Count::default);
            counts.iter_mut().zip(others).for_each(|(count, other)| count.join(other));
        }
    }

    /// What the runs say about one threshold.
    #[must_use]
    pub fn counted(&self, rule: Rule, level: usize) -> Counted<'_> {
        let counts = self.counts.get(rule as usize);
        Counted { runs: self.runs, count: counts.map_or(&NONE, |counts| &counts[level]) }
    }
}

/// Before the first run.
static NONE: Count = Count { early: 0, early_samples: 0, late: 0, found: Vec::new() };

impl Count {
    /// Counts the first alarm of a run in ([`NEVER`] without one), and when its contact began, in samples.
    pub fn add(&mut self, first: u32, contact: Option<u32>, clock: &Clock) {
        if first == NEVER {
            return;
        }
        match contact {
            Some(contact) if first >= contact => {
                let delay = first - contact;
                if delay > clock.late {
                    self.late += 1;
                } else {
                    self.found_after(delay, 1);
                }
            }
            _ => {
                self.early += 1;
                self.early_samples += u64::from(first.saturating_sub(clock.armed));
            }
        }
    }

    fn join(&mut self, other: &Self) {
        self.early += other.early;
        self.early_samples += other.early_samples;
        self.late += other.late;
        for &(delay, runs) in &other.found {
            self.found_after(delay, runs);
        }
    }

    fn found_after(&mut self, delay: u32, runs: u32) {
        match self.found.binary_search_by_key(&delay, |&(delay, _)| delay) {
            Ok(place) => self.found[place].1 += runs,
            Err(place) => self.found.insert(place, (delay, runs)),
        }
    }

    /// Whether so many runs can have come to it.
    fn is_of(&self, runs: u64, clock: &Clock) -> bool {
        let rising = self.found.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let in_time = self.found.iter().all(|&(delay, _)| delay <= clock.late.min(clock.samples));
        let alarms = u128::from(self.early) + u128::from(self.late) + u128::from(self.found());
        let samples = u128::from(self.early) * u128::from(clock.samples);
        rising && in_time && alarms <= u128::from(runs) && u128::from(self.early_samples) <= samples
    }

    fn found(&self) -> u64 {
        self.found.iter().map(|&(_, runs)| u64::from(runs)).sum()
    }
}

/// False alarms of a threshold: of runs without contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FalseAlarms {
    /// Runs with an alarm.
    #[serde(flatten)]
    pub rate: Share,
    /// Mean time to false alarm, s: the time watched, from arming to alarm or end, for each alarm (the estimate under a
    /// constant hazard, which counts silent runs too). NaN without an alarm.
    pub mean_time: f64,
    /// Its standard error, s.
    pub mean_time_error: f64,
    /// The time watched in all runs, s.
    pub watched: f64,
}

/// What a threshold does about contacts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Found {
    /// Alarms before contact, of all runs.
    pub early: Share,
    /// Contacts found in time, of those met without an alarm before.
    pub detected: Share,
    /// Contacts not found in time, of the same: never, or late.
    pub missed: Share,
    /// Alarms after contact that came too late; they are among the missed.
    pub late: u64,
    /// Mean delay of those found, s; NaN of none.
    pub mean: f64,
    /// Its standard error, s; NaN below two.
    pub mean_error: f64,
    /// Delay by which half of the contacts met are found, s; NaN when fewer are found in time.
    pub median: f64,
    /// Lower end of the median's 95 % interval, s.
    pub median_low: f64,
    /// Upper end, s; NaN where it lies beyond what is in time.
    pub median_high: f64,
    /// Delay by which 90 % of the contacts met are found, s; NaN when fewer are found in time.
    pub ninety: f64,
}

/// False alarms, from the runs without contact.
#[must_use]
pub fn false_alarms(Counted { runs, count }: Counted<'_>, clock: &Clock) -> FalseAlarms {
    let silent = runs - count.early;
    let whole = u64::from(clock.samples.saturating_sub(clock.armed));
    let watched = (count.early_samples + silent * whole) as f64 / clock.rate;
    let alarms = count.early as f64;
    let mean_time = if count.early > 0 { watched / alarms } else { f64::NAN };
    FalseAlarms { rate: Share::new(count.early, runs), mean_time, mean_time_error: mean_time / sqrt(alarms), watched }
}

/// Contacts found and missed, from the runs with contact.
#[must_use]
pub fn detection(Counted { runs, count }: Counted<'_>, clock: &Clock) -> Found {
    let (met, found) = (runs - count.early, count.found());
    let seconds = |samples: f64| samples / clock.rate;
    let sum: u64 = count.found.iter().map(|&(delay, runs)| u64::from(delay) * u64::from(runs)).sum();
    let squares: u128 = count.found.iter().map(|&(delay, runs)| u128::from(delay).pow(2) * u128::from(runs)).sum();
    // n²·variance·(n−1)/n as a whole number: nothing cancels.
    let spread = u128::from(found) * squares - u128::from(sum).pow(2);
    let n = found as f64;
    let [low, high] = if met > 0 { wilson(0.5, met as f64) } else { [0.5; 2] };
    let quantile = |share: f64| seconds(quantile(&count.found, met, share));
    Found {
        early: Share::new(count.early, runs),
        detected: Share::new(found, met),
        missed: Share::new(met - found, met),
        late: count.late,
        mean: if found > 0 { seconds(sum as f64 / n) } else { f64::NAN },
        mean_error: if found > 1 { seconds(sqrt(spread as f64 / (n * n * (n - 1.0)))) } else { f64::NAN },
        median: quantile(0.5),
        median_low: quantile(low),
        median_high: quantile(high),
        ninety: quantile(0.9),
    }
}

/// Delay in samples by which a share of `met` contacts is found; NaN when it never is.
fn quantile(found: &[(u32, u32)], met: u64, share: f64) -> f64 {
    if met == 0 {
        return f64::NAN;
    }
    // A share that is a whole number of runs but for roundings is that number.
    let wanted = (ceil(share * met as f64 - 1e-9) as u64).max(1);
    let mut so_far = 0;
    for &(delay, runs) in found {
        so_far += u64::from(runs);
        if so_far >= wanted {
            return f64::from(delay);
        }
    }
    f64::NAN
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLOCK: Clock = Clock { rate: 1000.0, armed: 5000, samples: 10_001, late: 500 };

    fn tally(firsts: &[u32]) -> Tally {
        tally_of(firsts, Some(6000))
    }

    fn tally_of(firsts: &[u32], contact: Option<u32>) -> Tally {
        let mut tally = Tally::default();
        for &first in firsts {
            tally.add(&Firsts { alarms: vec![vec![first], vec![NEVER], vec![first], vec![NEVER]], contact }, &CLOCK);
        }
        tally
    }

    #[test]
    fn an_alarm_is_early_found_late_or_missing() {
        // Early, at contact, in time (twice), just in time, late, never (twice).
        let tally = tally(&[5500, 6000, 6100, 6100, 6500, 6501, NEVER, NEVER]);
        let seen = detection(tally.counted(Rule::Fcd, 0), &CLOCK);
        assert_eq!((seen.early.count, seen.early.of), (1, 8));
        assert_eq!((seen.detected.count, seen.detected.of, seen.missed.count, seen.late), (4, 7, 3, 1));
        assert!((seen.mean - 0.175).abs() < 1e-15);
        // Sample deviation of 0, 0.1, 0.1, 0.5 over √4.
        assert!((seen.mean_error - sqrt(0.049_166_666_666_666_67 / 4.0)).abs() < 1e-12, "{}", seen.mean_error);
        assert_eq!(seen.median, 0.5);
        assert!(seen.ninety.is_nan() && seen.median_high.is_nan());
        assert_eq!(detection(tally.counted(Rule::Jfd, 0), &CLOCK).detected.count, 0);
    }

    #[test]
    fn without_contact_every_alarm_is_false_and_silence_counts() {
        let tally = tally_of(&[6000, 7001, NEVER, NEVER], None);
        let alarms = false_alarms(tally.counted(Rule::Fcd, 0), &CLOCK);
        assert_eq!((alarms.rate.count, alarms.rate.of), (2, 4));
        let watched = 1.0 + 2.001 + 2.0 * 5.001;
        assert!((alarms.watched - watched).abs() < 1e-12);
        assert!((alarms.mean_time - watched / 2.0).abs() < 1e-12);
        assert!((alarms.mean_time_error - watched / 2.0 / sqrt(2.0)).abs() < 1e-12);
        assert!(false_alarms(tally.counted(Rule::Jfd, 0), &CLOCK).mean_time.is_nan());
    }

    #[test]
    fn the_order_of_runs_changes_nothing() {
        let firsts = [6100, NEVER, 5100, 6480, 6100, 6005, 9000];
        let mut turned = firsts;
        turned.reverse();
        assert_eq!(tally(&firsts), tally(&turned));
    }
}
