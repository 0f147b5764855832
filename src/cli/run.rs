//! `centrode run`: simulate one scenario, sample by sample: a long run needs no more memory than a short one.

use super::ScenarioArgs;
use super::output::{Failure, NewFile, cell, finish_csv, json, write_record};
use centrode_core::detect::{Crossing, Detection, Method};
use centrode_core::run::{CHANNELS, Sample, Simulation};
use centrode_core::scenario::{Plan, Scenario};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    /// Write every channel at loop rate to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

/// What a run comes to.
#[derive(Debug, Serialize)]
struct Report {
    scenario: Scenario,
    samples: usize,
    /// Truth; null when the beam never holds.
    contact: Option<Contact>,
    crossings: Vec<Crossing>,
    /// The first crossing of ξ2; null when there is none.
    detection: Option<Found>,
    /// Largest values judged: after arming, and for the centrode while the end disk turns.
    peak: Peaks,
}

#[derive(Debug, Serialize)]
struct Contact {
    time: f64,
    arc_length: f64,
    bend: f64,
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

impl RunArgs {
    /// Simulates and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let scenario = self.scenario.scenario()?;
        let plan = Plan::new(&scenario).map_err(|error| Failure::Input(error.to_string()))?;
        let mut csv = self.csv.as_deref().map(NewFile::create).transpose()?.map(csv::Writer::from_writer);
        if let Some(csv) = &mut csv {
            let header = CHANNELS.iter().map(|channel| format!("{} [{}]", channel.name, channel.unit));
            write_record(csv, header)?;
        }
        let mut simulation = Simulation::new(&plan);
        let mut peak = Peaks::default();
        let detection = &scenario.detection;
        for sample in simulation.by_ref() {
            let Sample { time, judgement, .. } = &sample;
            if *time >= detection.armed_from {
                raise(&mut peak.residual, *time, judgement.residual);
                if judgement.speed > detection.min_speed {
                    raise(&mut peak.deviation, *time, judgement.deviation);
                }
            }
            if let Some(csv) = &mut csv {
                write_record(csv, CHANNELS.iter().map(|channel| cell((channel.value)(&sample))))?;
            }
        }
        if let Some(csv) = csv {
            finish_csv(csv)?;
        }
        let contact_time = simulation.contact_time();
        let contact = plan.contact().zip(contact_time).map(|(contact, time)| Contact {
            time,
            arc_length: contact.arc_length,
            bend: contact.bend,
        });
        let found = simulation
            .detection()
            .map(|detection| Found { delay: contact_time.map(|time| detection.time - time), detection });
        let crossings = simulation.crossings().to_vec();
        let report = Report { samples: plan.samples(), contact, crossings, detection: found, peak, scenario };
        if self.json { json(out, &report) } else { Ok(table(out, &report)?) }
    }
}

/// At most this many crossings are listed in the table; JSON holds them all.
const LISTED: usize = 12;

fn table(out: &mut impl Write, report: &Report) -> std::io::Result<()> {
    let (mm, degrees) = (|x: f64| x * 1e3, |x: f64| x.to_degrees());
    match &report.contact {
        Some(Contact { time, arc_length, bend }) => writeln!(
            out,
            "contact     {:.1} mm along the backbone, from {time:.3} s (bend {:.1}°)",
            mm(*arc_length),
            degrees(*bend)
        )?,
        None => writeln!(out, "contact     none")?,
    }
    match &report.detection {
        Some(Found { detection, delay }) => {
            let Detection { time, theta_l, location, .. } = detection;
            write!(out, "detected    at {time:.3} s, θL = {:.2}°", degrees(*theta_l))?;
            match delay {
                Some(delay) if *delay >= 0.0 => writeln!(out, ", {delay:.3} s after contact")?,
                Some(_) => writeln!(out, ": a false alarm, before any contact")?,
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
    writeln!(out, "\nmethod      time [s]    θL [°]          value      threshold")?;
    for crossing in report.crossings.iter().take(LISTED) {
        let Crossing { method, time, theta_l, value, threshold } = crossing;
        let (name, unit) = match method {
            Method::Fcd => ("fcd", "mm"),
            Method::Jfd => ("jfd", "mN·m"),
        };
        let theta_l = degrees(*theta_l);
        writeln!(
            out,
            "{name:<8} {time:>11.3} {theta_l:>9.3} {:>9.3} {unit:<4} {:>9.3} {unit}",
            mm(*value),
            mm(*threshold)
        )?;
    }
    match report.crossings.len() {
        0 => writeln!(out, "no threshold was crossed"),
        count if count > LISTED => writeln!(out, "… and {} more (--json lists them all)", count - LISTED),
        _ => Ok(()),
    }
}
