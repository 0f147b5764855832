//! Places: what the filter does to that of Eq. 24, and how well any estimate can know it.

use super::halves::chart;
use crate::facts::{quiet, run};
use anyhow::{Context, Result};
use centrode_core::chart::{Axis, Chart, Panel, Role, Series, Style};
use centrode_core::detect::Settings;
use centrode_core::detect::calibration::bound::{Beginning, place};
use centrode_core::detect::calibration::course::{Model, Planner};
use centrode_core::run::Run;
use centrode_core::scenario::{Plan, Threshold};

/// Thresholds that are tried, mm.
const THRESHOLDS: std::ops::RangeInclusive<u32> = 10..=120;
/// So long after the beginning of the contact, s.
const SHOWN: f64 = 0.5;
/// Bounds beyond this say nothing, m.
const WORST: f64 = 0.02;

/// Where Eq. 24 puts a contact at the alarm, for every threshold (SI).
fn located(mut run: Run) -> Result<Vec<[f64; 2]>> {
    let mut scenario = run.plan.scenario().clone();
    let mut points = Vec::new();
    for tenths in THRESHOLDS {
        let xi2 = f64::from(tenths) * 1e-4;
        scenario.detection.xi2 = Threshold::On(xi2);
        run.update(Plan::new(&scenario)?);
        let began = run.contact_time().context("a contact")?;
        // What alarms before the contact does not place it.
        let found = run.detection().filter(|detection| detection.time > began);
        points.push([xi2, found.map_or(f64::NAN, |detection| detection.location)]);
    }
    Ok(points)
}

/// The place at the alarm against the threshold that raised it.
pub fn against_threshold() -> Result<Chart> {
    let runs = [("disk 3", "disk-3", Role::Sensor, Style::Line), ("disk 2", "bench", Role::Sensor, Style::Dashed)];
    let length = quiet("bench", &[])?.segment().length;
    let ends = [0.0, f64::from(*THRESHOLDS.end()) * 1e-4];
    let mut series = Vec::new();
    for (name, preset, role, style) in runs {
        let run = quiet(preset, &[])?;
        let truth = run.plan.contact().context("a contact")?.arc_length;
        series.push(Series::new("true places", Role::Contact, Style::Thin, ends.map(|xi2| [xi2, truth]).to_vec()));
        series.push(Series::new(format!("place at the alarm, {name}"), role, style, located(run)?));
    }
    let double = ends.map(|xi2| [xi2, 2.0 * xi2]).to_vec();
    series.push(Series::new("2 ξ_2", Role::Constrained, Style::Dashed, double));
    let axis = |name| Axis::new(name, "m", "mm", 1e3);
    let mut panel = Panel { series, ..Panel::new(axis("Threshold ξ_2"), axis("Place s_c by Eq. 24")) };
    (panel.x.range, panel.y.range) = (Some(ends), Some([0.0, length]));
    Ok(chart("Place of a contact at its alarm, against the threshold", panel))
}

/// Cramér and Rao's bound of the place as readings come in, for contacts on each disk.
pub fn bound() -> Result<Chart> {
    let mut series = Vec::new();
    let disks = run("miscalibrated", &[])?.plan.scenario().robot.disks.clone();
    for (k, _) in disks.iter().enumerate() {
        let disk = format!("contact.disk={}", k + 1);
        let points = deviations(&run("miscalibrated", &[&disk, "contact.time=5.8"])?)?;
        let shade = Role::Member(k as f64 / (disks.len() - 1).max(1) as f64);
        series.push(Series::new(format!("disk {}", k + 1), shade, Style::Line, points));
    }
    let x = Axis { range: Some([0.0, SHOWN]), ..Axis::new("Time since the contact began", "s", "s", 1.0) };
    let y = Axis { range: Some([0.0, 0.012]), ..Axis::new("Standard deviation of the place", "m", "mm", 1e3) };
    Ok(chart("How well a place can be known", Panel { series, ..Panel::new(x, y) }))
}

fn deviations(run: &Run) -> Result<Vec<[f64; 2]>> {
    let settings = Settings::of(&run.plan);
    let contact = run.plan.contact().context("a contact")?;
    let commands: Vec<_> = settings.commands(&run.plan).collect();
    let length = settings.segment.length;
    let model = Model { length, belief: settings.watching.belief, noise: settings.watching.declared };
    let moments = Planner::all(&model, &commands, false);
    let began =
        Beginning::of(&commands, contact.bend, contact.side).context("readings before and after the contact")?;
    let [from, to] = [began.reading, began.reading + 1].map(|k| commands[k].time);
    let start = from + began.share * (to - from);
    let times = commands[began.reading + 1..].iter().map(|command| command.time - start);
    let bounds = place(&moments, length, contact.arc_length, began);
    let points = times.zip(bounds).take_while(|(time, _)| *time <= SHOWN);
    Ok(points.map(|(time, bound)| [time, if bound < WORST { bound } else { f64::NAN }]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::model::{Assumption, Rate, locate};

    #[test]
    fn places_at_the_alarm_follow_twice_the_threshold() {
        for (preset, most) in [("disk-3", 0.0095), ("bench", 0.0074)] {
            let points = located(quiet(preset, &[]).unwrap()).unwrap();
            let counted: Vec<_> = points.iter().filter(|[xi2, _]| (0.0015..most).contains(xi2)).collect();
            assert!(counted.len() > 50);
            for [xi2, place] in counted {
                assert!((place - 2.0 * xi2).abs() < 1.2e-3, "{preset} at {xi2}: {place}");
            }
        }
    }

    #[test]
    fn a_late_alarm_errs_by_the_shape_that_it_takes_for_frozen() {
        let run = quiet("disk-3", &["detection.xi2=0.0115"]).unwrap();
        let (detection, contact) = (run.detection().unwrap(), run.plan.contact().unwrap());
        let sample = run.sample_at(detection.time);
        let rate = Rate { theta_l: sample.theta_l_rate, delta: 0.0 };
        let place = |met| {
            let assumption = Assumption { met, ..Assumption::default() };
            let shape = run.commanded(run.place(detection.time));
            let centrode = &sample.judgement.sensor_centrode;
            locate(assumption, run.segment().length, shape, rate, centrode).unwrap().arc_length
        };
        assert!(contact.arc_length - place(None) > 4e-3, "{}", place(None));
        assert!((contact.arc_length - place(Some(contact.bend))).abs() < 1.5e-3, "{}", place(Some(contact.bend)));
    }
}
