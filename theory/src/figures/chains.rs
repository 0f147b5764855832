//! Segments in series: which of them a contact bends, where two contacts are placed, and when a chain buckles.

use super::halves::chart;
use anyhow::{Context, Result};
use centrode_core::chart::{Axis, Chart, Panel, Role, Series, Style};
use centrode_core::detect::chain::ChainContactFound;
use centrode_core::model::chain::path::{Path, Plane, Stands, What};
use centrode_core::model::chain::{Bends, Contact, Rod, Settled, Torsion, bends, free, settle};
use centrode_core::model::{Configuration, Pose, Vec3};
use centrode_core::scenario::{ChainPlan, ChainSetup, preset};
use centrode_core::study::chain::{ChainRun, course};

/// Bend of every segment as the beam is met, and further bend of every segment, rad.
pub const MET: f64 = 20.0 * DEGREE;
/// See [`MET`].
pub const ON: f64 = 3.0 * DEGREE;
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Steps along a segment at which a beam is tried.
const PLACES: usize = 20;
/// Largest bend of each segment, rad, and steps on the way there.
const MOST: f64 = 90.0 * DEGREE;
const STEPS: usize = 60;

/// The example of the package: its chain, its configuration and its contacts.
pub fn example() -> Result<ChainSetup> {
    Ok(ChainSetup::from_bytes(include_bytes!("../../../assets/chain.toml"))?)
}

/// The chain of the example, with another stiffness in torsion.
pub fn rods(torsion: Torsion) -> Result<Vec<Rod>> {
    Ok(example()?.rods.into_iter().map(|rod| Rod { torsion, ..rod }).collect())
}

fn alike(bend: f64, rods: &[Rod]) -> Vec<Configuration> {
    vec![Configuration::new(bend, 0.0); rods.len()]
}

/// A flat beam that a chain meets when all its segments are bent alike by [`MET`].
fn beam(rods: &[Rod], segment: usize, at: f64) -> Contact {
    let lengths: Vec<f64> = rods.iter().map(|rod| rod.length).collect();
    let pose = free::point(&lengths, &alike(MET, rods), segment, at);
    let normal = pose.rotation * Vec3::x();
    Contact { segment, at, normal, offset: normal.dot(&pose.position) }
}

/// A chain bent alike against a beam; none where it has buckled.
pub fn against(rods: &[Rod], (segment, at): (usize, f64), bend: f64) -> Option<Settled> {
    settle(rods, &alike(bend, rods), &[beam(rods, segment, at)]).ok()
}

/// How far each end disk, seen from the one below, is from where the free model has it, m.
pub fn deviations(rods: &[Rod], settled: &Settled, bend: f64) -> Vec<f64> {
    let mut base = Pose { position: Vec3::zeros(), rotation: centrode_core::model::Mat3::identity() };
    let each = rods.iter().zip(&settled.disks).map(|(rod, disk)| {
        let seen = base.rotation.transpose() * (disk.pose.position - base.position);
        base = disk.pose;
        (seen - free::pose(rod.length, Configuration::new(bend, 0.0)).position).norm()
    });
    each.collect()
}

fn millimetres(name: &'static str) -> Axis {
    Axis::new(name, "m", "mm", 1e3)
}

/// Which end disks leave their model, against the place of a beam.
pub fn blame() -> Result<Chart> {
    let rods = rods(Torsion::Ratio(5.0))?;
    let mut points = vec![Vec::new(); rods.len()];
    let mut base = 0.0;
    for (segment, rod) in rods.iter().enumerate() {
        for step in 1..=PLACES {
            let at = rod.length * step as f64 / PLACES as f64;
            let found = against(&rods, (segment, at), MET + ON);
            let moved = found.map(|settled| deviations(&rods, &settled, MET + ON));
            for (disk, points) in points.iter_mut().enumerate() {
                points.push([base + at, moved.as_ref().map_or(f64::NAN, |moved| moved[disk])]);
            }
        }
        base += rod.length;
    }
    let styles = [Style::Line, Style::LongDashed, Style::DashDotted];
    let series = points.into_iter().enumerate().map(|(disk, points)| {
        let role = Role::Member(disk as f64 / (rods.len() - 1) as f64);
        Series::new(format!("disk {}", disk + 1), role, styles[disk % styles.len()], points)
    });
    let (x, y) = (millimetres("Place of the beam, from the base"), millimetres("Deviation, seen from the disk below"));
    let mut panel = Panel { series: series.collect(), ..Panel::new(x, y) };
    panel.x.range = Some([0.0, base]);
    panel.verticals = disks(&rods);
    Ok(chart("Which segments a contact bends", panel))
}

fn disks(rods: &[Rod]) -> Vec<centrode_core::chart::Vertical> {
    let ends = rods.iter().scan(0.0, |at, rod| {
        *at += rod.length;
        Some(*at)
    });
    let line = |x| centrode_core::chart::Vertical { name: "end disk", x, role: Role::Aside };
    ends.take(rods.len() - 1).map(line).collect()
}

/// A preset of several segments, run.
pub fn run(name: &str) -> Result<ChainRun> {
    let scenario = preset::find_chain(name).with_context(|| format!("there is no preset {name:?}"))?.chain(&[])?;
    Ok(ChainRun::new(ChainPlan::new(&scenario)?))
}

/// The contacts that are found, each as it is known half a second after its alarm.
pub fn found(run: &ChainRun) -> Result<Vec<ChainContactFound>> {
    let teller = run.judged.teller().context("a detector that tells of contacts")?;
    Ok(run.judged.contacts(teller, &[AFTER]))
}

/// Time after an alarm at which a place is quoted, s.
const AFTER: f64 = 0.5;

/// Where both contacts of the preset are placed.
pub fn places() -> Result<Chart> {
    let run = run("two-contacts")?;
    let found = found(&run)?;
    let placed: Vec<_> =
        found.iter().enumerate().filter_map(|(k, contact)| Some((k, contact.estimates.first()?))).collect();
    let mut panel = course::along(&run, &placed, course::end(&run));
    panel.title = String::new();
    Ok(chart("Where two contacts are along the backbone", panel))
}

/// Bend of each segment (rad) at which a chain buckles against a beam at the middle of a segment; none if it does not by [`MOST`].
pub fn buckles(rods: &[Rod], segment: usize) -> Result<Option<f64>> {
    let all = rods.len();
    let course = |time: f64| -> Vec<Bends> { vec![bends(Configuration::new(MOST * time, 0.0)); all] };
    let stands = Stands::From { time: MET / MOST, tilt: 0.0 };
    let plane = Plane { segment, at: 0.5 * rods[segment].length, delta: 0.0, stands };
    let path = Path::new(rods, &course, &[0.0, 1.0], &[plane])?;
    let buckled = path.happened().iter().find(|event| event.what == What::Buckled);
    Ok(buckled.map(|event| MOST * event.time))
}

/// The stability margin as a chain bends on against a beam.
pub fn margins() -> Result<Chart> {
    let mut series = Vec::new();
    for (torsion, name, style) in
        [(Torsion::Ratio(5.0), "", Style::Line), (Torsion::Rigid, ", cannot twist", Style::Dashed)]
    {
        let rods = rods(torsion)?;
        for segment in 0..rods.len() {
            let end = buckles(&rods, segment)?;
            let last = end.unwrap_or(MOST);
            let at = 0.5 * rods[segment].length;
            let mut points = vec![[0.0, 1.0], [MET, 1.0]];
            for step in 1..STEPS {
                let bend = MET + (last - MET) * step as f64 / STEPS as f64;
                points.push([bend, against(&rods, (segment, at), bend).map_or(f64::NAN, |settled| settled.margin)]);
            }
            points.extend(end.map(|end| [end, 0.0]));
            let role = Role::Member(segment as f64 / (rods.len() - 1) as f64);
            series.push(Series::new(format!("segment {}{name}", segment + 1), role, style, points));
        }
    }
    let x = Axis::new("Bend of each segment", "rad", "°", 1.0 / DEGREE);
    let mut panel = Panel { series, ..Panel::new(x, Axis::new("Stability margin", "1", "1", 1.0)) };
    panel.x.range = Some([0.0, MOST]);
    panel.y.range = Some([0.0, 1.05]);
    Ok(chart("How far a chain is from buckling", panel))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_above_the_contact_are_free_and_those_below_are_not() {
        let rods = rods(Torsion::Ratio(5.0)).unwrap();
        for segment in 0..3 {
            let settled = against(&rods, (segment, 0.02), MET + ON).expect("stable");
            let moved = deviations(&rods, &settled, MET + ON);
            for (disk, moved) in moved.into_iter().enumerate() {
                assert!(if disk > segment { moved < 1e-12 } else { moved > 1e-5 }, "{segment}, {disk}: {moved}");
            }
        }
    }

    #[test]
    fn below_a_contact_on_a_straight_chain_the_shift_is_that_of_the_text() {
        // Bends so small that linear beam theory holds.
        let rods = rods(Torsion::Rigid).unwrap();
        let (met, bend) = (1e-4, 1.1e-4);
        let lengths: Vec<f64> = rods.iter().map(|rod| rod.length).collect();
        let pose = free::point(&lengths, &alike(met, &rods), 2, 0.01);
        let contact = Contact { segment: 2, at: 0.01, normal: Vec3::x(), offset: pose.position.x };
        let settled = settle(&rods, &alike(bend, &rods), &[contact]).unwrap();
        let moved = deviations(&rods, &settled, bend);
        for (moved, rod) in moved.iter().zip(&rods).take(2) {
            let said = settled.forces[0] * rod.length.powi(3) / (12.0 * rod.bending_stiffness);
            assert!((moved / said - 1.0).abs() < 1e-3, "{moved} {said}");
        }
    }

    #[test]
    fn a_chain_that_buckles_has_no_margin_left() {
        let rods = rods(Torsion::Ratio(5.0)).unwrap();
        assert_eq!(buckles(&rods, 0).unwrap(), None);
        let end = buckles(&rods, 2).unwrap().expect("it buckles");
        let margin = |bend| against(&rods, (2, 0.015), bend).map(|settled| settled.margin);
        assert!(margin(0.999 * end).is_some_and(|margin| margin < 0.02), "{:?}", margin(0.999 * end));
    }
}
