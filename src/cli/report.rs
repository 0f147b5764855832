//! What a run or a log comes to, as JSON and as a table.

use super::analyze::About;
use super::output::{Failure, json};
use centrode_core::detect::{Crossing, Detection, Event, Method};
use centrode_core::run::Sample;
use centrode_core::scenario::{Scenario, Thresholds};
use serde::Serialize;
use std::io::Write;

/// What a run or a log comes to.
#[derive(Debug, Serialize)]
pub struct Report {
    scenario: Scenario,
    samples: usize,
    /// Truth; null when the beam never holds, and for a log, which does not know it.
    contact: Option<Contact>,
    crossings: Vec<Crossing>,
    /// What each detector makes of its crossings.
    events: Vec<Event>,
    /// Crossings that are not listed.
    #[serde(skip)]
    more: u64,
    /// The first crossing of ξ2; null when there is none.
    detection: Option<Found>,
    /// Largest values judged: after arming, and for the centrode while the end disk turns.
    peak: Peaks,
    /// How the log was read; left out for a simulation.
    #[serde(skip_serializing_if = "Option::is_none")]
    log: Option<About>,
}

impl Report {
    /// Of what was simulated, or of a log.
    pub fn new(
        scenario: Scenario,
        tally: Tally,
        events: &[Event],
        contact: Option<Contact>,
        log: Option<About>,
    ) -> Self {
        let detection = Detection::first(events);
        let delay = |detection: &Detection| contact.as_ref().map(|contact| detection.time - contact.time);
        let detection = detection.map(|detection| Found { delay: delay(&detection), detection });
        let Tally { samples, crossings: Crossings { listed, more, .. }, peak, .. } = tally;
        Self { scenario, samples, contact, crossings: listed, events: events.to_vec(), more, detection, peak, log }
    }

    /// Prints it as JSON or as a table.
    pub fn print(&self, out: &mut impl Write, as_json: bool) -> Result<(), Failure> {
        if as_json { json(out, self) } else { Ok(table(out, self)?) }
    }
}

/// What is gathered sample by sample.
#[derive(Debug)]
pub struct Tally {
    samples: usize,
    /// Whether every crossing is listed.
    lists: bool,
    crossings: Crossings,
    peak: Peaks,
}

impl Tally {
    /// Before the first sample; `lists` for JSON, which lists every crossing.
    pub fn new(lists: bool) -> Self {
        let crossings = Crossings::new(if lists { MAX_CROSSINGS } else { 0 });
        Self { samples: 0, lists, crossings, peak: Peaks::default() }
    }

    /// Takes a sample, and the crossings at it.
    pub fn add(&mut self, sample: &Sample, crossings: &[Crossing], thresholds: &Thresholds) -> Result<(), Failure> {
        let Self { samples, lists, crossings: listed, peak } = self;
        *samples += 1;
        listed.add(crossings);
        if *lists && listed.more > 0 {
            let line = format!(
                "--json lists every threshold crossing, {MAX_CROSSINGS} at most, and at {} s there are more: raise \
                 detection.xi2 or detection.xi1, or leave --json away",
                sample.time
            );
            return Err(Failure::Input(line));
        }
        let Sample { time, judgement, .. } = sample;
        for (method, peak) in [(Method::Fcd, &mut peak.deviation), (Method::Jfd, &mut peak.residual)] {
            if let Some(value) = method.statistic(judgement, *time, thresholds).counted() {
                raise(peak, *time, value);
            }
        }
        Ok(())
    }
}

/// A contact as the simulation knows it.
#[derive(Debug, Serialize)]
pub struct Contact {
    /// When it began, s.
    pub time: f64,
    /// Where, m.
    pub arc_length: f64,
    /// Bend of the segment then, rad.
    pub bend: f64,
}

#[derive(Debug, Serialize)]
struct Found {
    #[serde(flatten)]
    detection: Detection,
    /// Time since the contact began, s; null without contact.
    delay: Option<f64>,
}

#[derive(Debug, Default, Serialize)]
struct Peaks {
    deviation: Option<Peak>,
    residual: Option<Peak>,
}

#[derive(Debug, Clone, Copy, Serialize)]
struct Peak {
    time: f64,
    value: f64,
}

fn raise(peak: &mut Option<Peak>, time: f64, value: f64) {
    if !value.is_nan() && peak.is_none_or(|peak| value > peak.value) {
        *peak = Some(Peak { time, value });
    }
}

/// At most this many events are listed in the table; JSON holds them all.
const LISTED: usize = 12;

/// A run with more crossings than this gives no JSON: 40 MB of them.
pub const MAX_CROSSINGS: usize = 1_000_000;

/// The first crossings, and how many more there are.
#[derive(Debug)]
struct Crossings {
    most: usize,
    listed: Vec<Crossing>,
    more: u64,
}

impl Crossings {
    fn new(most: usize) -> Self {
        Self { most, listed: Vec::new(), more: 0 }
    }

    fn add(&mut self, crossings: &[Crossing]) {
        let (listed, more) = crossings.split_at(crossings.len().min(self.most - self.listed.len()));
        self.listed.extend_from_slice(listed);
        self.more += more.len() as u64;
    }
}

fn table(out: &mut impl Write, report: &Report) -> std::io::Result<()> {
    let (mm, degrees) = (|x: f64| x * 1e3, |x: f64| x.to_degrees());
    if let Some(about) = &report.log {
        about.table(out)?;
    }
    match &report.contact {
        Some(Contact { time, arc_length, bend }) => writeln!(
            out,
            "contact     {:.1} mm along the backbone, from {time:.3} s (bend {:.1}°)",
            mm(*arc_length),
            degrees(*bend)
        )?,
        None if report.log.is_some() => writeln!(out, "contact     not known: a log holds no truth")?,
        None => writeln!(out, "contact     none")?,
    }
    match &report.detection {
        Some(Found { detection, delay }) => {
            let Detection { time, theta_l, location, .. } = detection;
            write!(out, "detected    at {time:.3} s, θL = {:.2}°", degrees(*theta_l))?;
            match delay {
                Some(delay) if *delay >= 0.0 => writeln!(out, ", {delay:.3} s after contact")?,
                Some(_) => writeln!(out, ": a false alarm, before any contact")?,
                None if report.log.is_some() => writeln!(out)?,
                None => writeln!(out, ": a false alarm, there is no contact")?,
            }
            writeln!(out, "located     at {:.2} mm", mm(*location))?;
        }
        None => writeln!(out, "detected    nothing by the centrode")?,
    }
    for (name, peak, unit) in [
        ("deviation", report.peak.deviation.map(|p| (p.time, mm(p.value))), "mm"),
        ("residual", report.peak.residual.map(|p| (p.time, mm(p.value))), "mN·m"),
    ] {
        if let Some((time, value)) = peak {
            writeln!(out, "{name:<11} at most {value:.3} {unit}, at {time:.3} s")?;
        }
    }
    if report.events.is_empty() {
        return writeln!(out, "\nno threshold was crossed");
    }
    writeln!(out, "\ndetector   raised [s]  cleared [s]    θL [°]          value      threshold")?;
    for event in report.events.iter().take(LISTED) {
        let Event { detector, raised, cleared, value, threshold, theta_l, .. } = event;
        let unit = match detector {
            Method::Fcd => "mm",
            Method::Jfd => "mN·m",
        };
        let cleared = cleared.map_or("never".into(), |time| format!("{time:.3}"));
        let (name, theta_l) = (detector.key(), degrees(*theta_l));
        writeln!(
            out,
            "{name:<8} {raised:>12.3} {cleared:>12} {theta_l:>9.3} {:>9.3} {unit:<4} {:>9.3} {unit}",
            mm(*value),
            mm(*threshold)
        )?;
    }
    if report.events.len() > LISTED {
        writeln!(out, "… and {} more events (--json lists them all)", report.events.len() - LISTED)?;
    }
    match report.crossings.len() as u64 + report.more {
        1 => writeln!(out, "a threshold was crossed once"),
        count => writeln!(out, "thresholds were crossed {count} times (--json lists every crossing)"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_crossings_are_listed_and_the_others_counted() {
        let at = |time| Crossing { method: Method::Fcd, time, theta_l: 0.0, value: 2.0, threshold: 1.0 };
        let mut crossings = Crossings::new(3);
        for some in [&[][..], &[at(1.0), at(2.0)], &[at(3.0), at(4.0)], &[at(5.0)]] {
            crossings.add(some);
        }
        assert_eq!((crossings.listed, crossings.more), (vec![at(1.0), at(2.0), at(3.0)], 2));
    }
}
