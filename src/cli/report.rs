//! What a run or a log comes to, printed.

use super::output::{Failure, json};
use centrode_core::detect::calibration::Noise;
use centrode_core::detect::calibration::noise::Whiteness;
use centrode_core::detect::estimates::Estimated;
use centrode_core::detect::force::Force;
use centrode_core::detect::{Detection, Event, Method};
use centrode_core::plant::{Happening, PlantEvent};
use centrode_core::scenario::Listed;
use centrode_core::study::about::About;
use centrode_core::study::course::{Measure, measure};
use centrode_core::study::report::{self, Contact, Found, MAX_CROSSINGS, Pressed, TooMany};
use std::io::Write;

/// What a run or a log comes to.
pub type Report = report::Report<About>;

/// Prints a report as JSON or as a table.
pub fn print(out: &mut impl Write, report: &Report, as_json: bool) -> Result<(), Failure> {
    if as_json { json(out, report) } else { Ok(table(out, report)?) }
}

/// Refuses to list so many crossings.
pub fn too_many(TooMany { time }: TooMany) -> Failure {
    Failure::Input(format!(
        "--json lists every threshold crossing, {MAX_CROSSINGS} at most, and at {time} s there are more: raise \
         the thresholds, or leave --json away"
    ))
}

/// Where a contact is; `raised` is its alarm (s), where it is not the first.
fn placed(out: &mut impl Write, estimate: &Estimated, (detector, raised): (Method, f64)) -> std::io::Result<()> {
    let Estimated { after, estimator, location, contact_time, kinds, .. } = estimate;
    let mm = |x: f64| x * 1e3;
    let alarm = format!("{}'s alarm at {raised:.3} s", detector.key());
    write!(out, "placed      {after:.2} s after {alarm}, by {}: {:.2} mm", estimator.word(), mm(location.mean))?;
    if location.low < location.high {
        write!(out, ", 95 % between {:.2} and {:.2} mm", mm(location.low), mm(location.high))?;
    }
    if let Some(began) = contact_time {
        write!(out, "; since {began:.3} s")?;
    }
    for (kind, share) in kinds {
        write!(out, ", {kind} {:.0} %", share * 100.0)?;
    }
    writeln!(out)
}

/// At most this many events are listed in the table; JSON holds them all.
const LISTED: usize = 12;

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
    for event in &report.plant {
        let PlantEvent { what, time, bend, .. } = event;
        let how = match what {
            Happening::Met => continue,
            Happening::Opened => "comes off the beam",
            Happening::Snapped => "snaps off the beam, and is free from then on",
            Happening::SlidOff => "slides off the beam, and is free from then on",
            Happening::Wrapped => "would lie along the round beam, which is not modelled: free from then on",
        };
        writeln!(out, "            at {time:.3} s (bend {:.1}°) the segment {how}", degrees(*bend))?;
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
    if let Some(alarm) = &report.placed {
        let Event { detector, raised, .. } = *alarm;
        for estimate in &report.estimates {
            placed(out, estimate, (detector, raised))?;
        }
        for next in &report.next_estimates {
            for estimate in &next.estimates {
                placed(out, estimate, (detector, next.raised))?;
            }
        }
        if report.estimates.is_empty() {
            let estimation = &report.scenario.estimation;
            let chosen = estimation.estimators.iter().next().is_some() && estimation.plants.iter().next().is_some();
            let why = match chosen {
                true => "the readings do not place the contact, or end before",
                false => "no estimator, or no kind of contact, is chosen",
            };
            writeln!(out, "placed      nowhere after {}'s alarm at {raised:.3} s: {why}", detector.key())?;
        }
    }
    if let Some(Pressed { force: Force { time, mean, low, high }, truth }) = report.force {
        write!(out, "presses     with {mean:.2} N at {time:.3} s, between {low:.2} and {high:.2} N")?;
        write!(out, " with load cells that err by {} %", report.scenario.load_cells.epsilon_tau * 100.0)?;
        match truth {
            Some(truth) => writeln!(out, "; in truth {truth:.2} N")?,
            None => writeln!(out)?,
        }
    }
    if let Some(Noise { position, orientation, colour }) = report.noise {
        let (position, orientation) = (mm(position), degrees(orientation));
        writeln!(
            out,
            "filter      takes the tracker's noise for {position:.3} mm and {orientation:.4}°, ρ = {colour:.2}"
        )?;
    }
    if report.noise_unmeasured {
        writeln!(
            out,
            "warning     the tracker's noise could not be measured, for the robot is not at rest before it moves: it is taken for what \
             tracker.position_noise and tracker.orientation_noise say"
        )?;
    }
    if let Some(test) = report.whiteness.filter(Whiteness::fails) {
        let p = if test.p_value < 1e-99 { "< 1e-99".into() } else { format!("= {:.0e}", test.p_value) };
        writeln!(
            out,
            "warning     innovations are not white (p {p}): thresholds of cusum and glr, and intervals of places, hold for \
             white ones; see prior.colour, prior.drift and prior.position_noise, unless a contact was missed"
        )?;
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
    let listed = || report.events.iter().take(LISTED);
    // Wide enough for the heading, and for every name.
    let width = listed().map(|event| event.detector.key().len()).fold("detector".len(), usize::max);
    let head = "  raised [s]  cleared [s]    θL [°]          value      threshold";
    writeln!(out, "\n{:<width$} {head}", "detector")?;
    for event in listed() {
        let Event { detector, raised, cleared, value, threshold, theta_l, .. } = event;
        let Measure { unit, scale, .. } = measure(*detector);
        let cleared = cleared.map_or("never".into(), |time| format!("{time:.3}"));
        let (name, theta_l) = (detector.key(), degrees(*theta_l));
        let line = format!(
            "{name:<width$} {raised:>12.3} {cleared:>12} {theta_l:>9.3} {:>9.3} {unit:<4} {:>9.3} {unit}",
            value * scale,
            threshold * scale
        );
        // A detector without a unit leaves no space behind.
        writeln!(out, "{}", line.trim_end())?;
    }
    if report.events.len() > LISTED {
        writeln!(out, "… and {} more events (--json lists them all)", report.events.len() - LISTED)?;
    }
    match report.crossings.len() as u64 + report.more {
        1 => writeln!(out, "a threshold was crossed once"),
        count => writeln!(out, "thresholds were crossed {count} times (--json lists every crossing)"),
    }
}
