//! `centrode run` and `centrode analyze` of an experiment with several segments.

mod log;

use super::draw::{self, Format};
use super::output::{Failure, NewFile, finish_csv, json, write_record};
use centrode_core::detect::Method;
use centrode_core::detect::chain::{ChainMethod, ChainSettings};
use centrode_core::scenario::{ChainPlan, ChainScenario};
use centrode_core::study::chain::figure::over_time;
use centrode_core::study::chain::{ChainReport, ChainRun, ContactTold, EstimateTold, EventTold};
use std::io::{self, Write};
use std::path::Path;

/// What is asked of it.
pub(super) struct Asked<'a> {
    pub detector: Option<&'a str>,
    pub after: Vec<f64>,
    pub json: bool,
    pub csv: Option<&'a Path>,
    pub figure: Option<&'a Path>,
}

pub(super) use log::{Files, analyze, commands};

/// Refuses a drawing of a log of several segments.
pub(super) fn without_figure(figure: Option<&Path>) -> Result<(), Failure> {
    match figure {
        None => Ok(()),
        Some(_) => Err(Failure::Input(
            "--figure: not for a log of several segments, of which no drawing is made; --csv has what its detectors hold".into(),
        )),
    }
}

/// The longest run, in samples: it is kept whole.
const MOST: usize = 200_000;

/// Simulates and reports.
pub(super) fn execute(
    scenario: &ChainScenario,
    asked: &Asked,
    log_file: Option<&Path>,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let detector = asked.detector.map(|name| detector(scenario, name)).transpose()?;
    let samples = scenario.common().motion.end * scenario.common().loop_rate;
    if samples > MOST as f64 {
        return Err(Failure::Input(format!(
            "end: a run of {samples:.0} samples; with several segments a run is kept whole, and has {MOST} at most"
        )));
    }
    let log_file = log_file.map(log::checked).transpose()?;
    let format = asked.figure.map(|path| Format::of("--figure", path)).transpose()?;
    let csv = asked.csv.map(NewFile::create).transpose()?;
    let figure = asked.figure.map(NewFile::create).transpose()?;
    let plan = ChainPlan::new(scenario)
        .map_err(|unsettled| Failure::Input(format!("as the experiment begins, there is {unsettled}")))?;
    let run = ChainRun::new(plan);
    if let Some(path) = log_file {
        log::write_log(path, &run.recording)?;
    }
    if let Some(file) = csv {
        write_csv(file, &run)?;
    }
    if let (Some(mut file), Some(format)) = (figure, format) {
        draw::write(&mut file, &over_time(&run), format)?;
        file.finish()?;
    }
    print(out, &run.report(detector, &asked.after), asked.json)
}

fn print(out: &mut impl Write, report: &ChainReport, as_json: bool) -> Result<(), Failure> {
    if as_json { json(out, report) } else { Ok(table(out, report)?) }
}

/// A detector that judges.
fn detector(scenario: &ChainScenario, name: &str) -> Result<ChainMethod, Failure> {
    let known: Vec<ChainMethod> = ChainSettings::of(scenario).detectors().collect();
    known.iter().copied().find(|method| method.key() == name).ok_or_else(|| {
        let keys: Vec<&str> = known.iter().map(|method| method.key()).collect();
        Failure::Input(format!("--detector: {name:?} does not judge here; those that do: {}", keys.join(", ")))
    })
}

/// Everything at loop rate: what each segment was told, read and showed, and the truth.
fn write_csv(file: NewFile, run: &ChainRun) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(file);
    let segments = run.recording.segments();
    let mut header = vec!["time [s]".to_owned()];
    for k in 1..=segments {
        header.extend([format!("theta_l_{k} [rad]"), format!("delta_{k} [rad]")]);
    }
    for k in 1..=segments {
        header.extend(["x", "y", "z"].map(|axis| format!("disk_{k}_{axis} [m]")));
        header.extend(["x", "y", "z"].map(|axis| format!("tracker_{k}_{axis} [m]")));
        header.extend(["azimuth", "elevation", "roll"].map(|angle| format!("tracker_{k}_{angle} [rad]")));
        header.extend([format!("deviation_{k} [m]"), format!("consistent_{k} [m]"), format!("screw_angle_{k} [rad]")]);
        header.push(format!("cusum_{k} [1]"));
    }
    let contacts = run.plan.scenario().contacts.len();
    header.extend((1..=contacts).map(|k| format!("force_{k} [N]")));
    header.push("stability_margin [1]".into());
    write_record(&mut csv, header)?;
    let word = |value: f64| if value.is_nan() { String::new() } else { value.to_string() };
    for (at, time) in run.recording.times.iter().enumerate() {
        let mut row = vec![time.to_string()];
        for told in &run.recording.told {
            let configuration = told[at].configuration;
            row.extend([word(configuration.theta_l()), word(configuration.delta())]);
        }
        let truth = run.recording.truth.as_ref().map(|truth| &truth[at]);
        for k in 0..segments {
            let disk = truth.map(|truth| truth.disks[k].position);
            row.extend((0..3).map(|axis| disk.map_or(String::new(), |disk| word(disk[axis]))));
            let reading = run.recording.readings[k].as_ref().map(|readings| readings[at]);
            row.extend((0..3).map(|axis| reading.map_or(String::new(), |reading| word(reading.position[axis]))));
            row.extend((0..3).map(|axis| reading.map_or(String::new(), |reading| word(reading.angles[axis]))));
            let values = run.judged.judgement(k, at).map(|of| [of.deviation, of.consistent, of.turned, of.cusum]);
            row.extend(values.unwrap_or([f64::NAN; 4]).map(word));
        }
        row.extend((0..contacts).map(|k| truth.map_or(String::new(), |truth| word(truth.forces[k]))));
        row.push(truth.map_or(String::new(), |truth| word(truth.margin)));
        write_record(&mut csv, row)?;
    }
    finish_csv(csv)
}

fn table(out: &mut impl Write, report: &ChainReport) -> io::Result<()> {
    if let Some(about) = &report.log {
        about.table(out)?;
    }
    for contact in &report.contacts {
        let ContactTold { contact, segment, at, kind, time, largest_force, .. } = contact;
        write!(out, "contact {contact}   {kind} on segment {segment}, {:.2} mm from its base", at * 1e3)?;
        match time {
            Some(time) => write!(out, ", from {time:.3} s")?,
            None => write!(out, ", from the start")?,
        }
        match largest_force {
            Some(force) => writeln!(out, "; at most {force:.3} N")?,
            None => writeln!(out)?,
        }
    }
    if report.log.is_some() {
        writeln!(out, "contact     not known: a log holds no truth")?;
    } else if report.contacts.is_empty() {
        writeln!(out, "contact     none")?;
    }
    for event in &report.plant_events {
        let which = event.contact.unwrap_or(0);
        match event.what {
            "met" => writeln!(out, "            at {:.3} s contact {which} is met", event.time)?,
            "opened" => writeln!(out, "            at {:.3} s the robot comes off contact {which}", event.time)?,
            "buckled" => writeln!(out, "            at {:.3} s the robot buckles; the run ends there", event.time)?,
            _ => writeln!(
                out,
                "            at {:.3} s no shape near that of before is found; the run ends there",
                event.time
            )?,
        }
    }
    for event in &report.events {
        let EventTold { segment, detector, raised, cleared, value, threshold, angle } = event;
        write!(out, "event       {detector} on disk {segment}: {}", measured(detector, *value))?;
        if let Some(angle) = angle {
            write!(out, " and {:.1}°", angle.to_degrees())?;
        }
        write!(out, " (threshold {}) at {raised:.3} s", measured(detector, *threshold))?;
        match cleared {
            Some(cleared) => writeln!(out, ", cleared at {cleared:.3} s")?,
            None => writeln!(out, ", stands")?,
        }
    }
    for (place, found) in report.found.iter().enumerate() {
        let disks: Vec<String> = found.deviating.iter().map(ToString::to_string).collect();
        let detector = report.detector.unwrap_or_default();
        let disks = match disks.as_slice() {
            [disk] => format!("disk {disk} deviates"),
            disks => format!("disks {} deviate", disks.join(", ")),
        };
        writeln!(out, "found {}     {detector} alarms at {:.3} s; {disks}", place + 1, found.alarm)?;
        for estimate in &found.estimates {
            placed(out, estimate)?;
        }
        if found.estimates.is_empty() {
            writeln!(
                out,
                "placed      not: that takes cusum, or fcd with trackers on every end disk, and readings from before the contact up to then of it alone"
            )?;
        }
    }
    if report.found.is_empty() {
        writeln!(out, "found       no contact")?;
    }
    Ok(())
}

fn placed(out: &mut impl Write, estimate: &EstimateTold) -> io::Result<()> {
    let EstimateTold { after, segment, probabilities, nothing, at, low, high, began, .. } = estimate;
    if *nothing > 0.5 {
        return writeln!(out, "placed      {after:.2} s after it: a false alarm ({:.0} %)", nothing * 100.0);
    }
    write!(out, "placed      {after:.2} s after it: segment {segment} ({:.0} %)", probabilities[segment - 1] * 100.0)?;
    write!(out, ", {:.2} mm from its base", at * 1e3)?;
    if low < high {
        write!(out, ", 95 % between {:.2} and {:.2} mm", low * 1e3, high * 1e3)?;
    }
    if let Some(began) = began {
        write!(out, "; since {began:.3} s")?;
    }
    writeln!(out)
}

/// A detector's value in the unit in which it is shown.
fn measured(detector: &str, value: f64) -> String {
    match Method::ALL.iter().find(|method| method.key() == detector) {
        Some(Method::Cusum | Method::Glr) => format!("{value:.2}"),
        Some(Method::FcdVelocity) => format!("{:.2} mm/s", value * 1e3),
        _ => format!("{:.2} mm", value * 1e3),
    }
}
