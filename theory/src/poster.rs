//! The robot as it notices the contact, in its bending plane: what the page shows while its program loads.

use crate::facts::quiet;
use anyhow::{Context, Result};
use centrode_core::model::{Configuration, Constrained, Vec3};
use std::fmt::Write;

/// Points of a backbone.
const POINTS: usize = 25;
/// A disk is wider than the circle of the backbones by this factor.
const DISK: f64 = 1.35;
/// Radius of the beam, m.
const BEAM: f64 = 0.0022;
/// Room around the robot, mm.
const ROOM: f64 = 1.5;

/// It, as SVG. `web/style.css` has its colours.
pub fn poster() -> Result<String> {
    let run = quiet("bench", &[])?;
    let contact = run.plan.contact().context("a contact")?;
    let alarm = run.detection().context("a detection")?;
    let sample = run.sample_at(alarm.time);
    let (length, radius) = (run.segment().length, run.segment().pitch_radius);
    let held = Constrained::new(length, contact.arc_length, contact.bend, Configuration::new(sample.theta_l, 0.0));
    let beside = |s: f64, away: f64| {
        let pose = held.pose(s);
        flat(&(pose.position + pose.rotation.column(0) * away))
    };

    let side = |away: f64| (0..POINTS).map(move |k| (length * k as f64 / (POINTS - 1) as f64, away));
    let end = DISK * radius;
    let mut drawn = String::new();
    write!(drawn, "<path class=\"floor\" d=\"M{:.2} 0H{:.2}\"/>", -3.0 * end * 1e3, 3.0 * end * 1e3)?;
    let body = side(-radius).chain(side(radius).rev()).map(|(s, away)| beside(s, away));
    write!(drawn, "<polygon class=\"body\" points=\"{}\"/>", listed(body))?;
    for away in [-radius, 0.0, radius] {
        write!(drawn, "<polyline class=\"tube\" points=\"{}\"/>", listed(side(away).map(|(s, away)| beside(s, away))))?;
    }
    let disks = run.plan.scenario().robot.disks.iter().copied();
    for s in [0.0].into_iter().chain(disks).chain([length]) {
        let ends = [beside(s, -end), beside(s, end)];
        write!(drawn, "<polyline class=\"disk\" points=\"{}\"/>", listed(ends.into_iter()))?;
    }
    let [x, y] = beside(contact.arc_length, end + BEAM);
    write!(drawn, "<circle class=\"beam\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\"/>", BEAM * 1e3)?;
    let [model, sensor] = [&sample.judgement.model_centrode, &sample.judgement.sensor_centrode].map(flat);
    write!(drawn, "<polyline class=\"deviation\" points=\"{}\"/>", listed([model, sensor].into_iter()))?;
    let [x, y] = model;
    write!(drawn, "<path class=\"model\" d=\"M{x:.2} {:.2}l1.2 2.1h-2.4z\"/>", y - 1.3)?;
    let [x, y] = sensor;
    write!(drawn, "<circle class=\"sensor\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"1.1\"/>")?;

    let tip = beside(length, 0.0);
    let [left, right] = [-3.0 * end * 1e3 - ROOM, tip[0] + end * 1e3 + ROOM];
    let top = tip[1].min(beside(length, -end)[1]) - ROOM;
    Ok(format!(
        "<svg class=\"poster\" viewBox=\"{left:.2} {top:.2} {:.2} {:.2}\" aria-hidden=\"true\">{drawn}</svg>\n",
        right - left,
        ROOM - top
    ))
}

/// In the picture: mm, down.
fn flat(point: &Vec3) -> [f64; 2] {
    [point.x * 1e3, -point.z * 1e3]
}

fn listed(points: impl Iterator<Item = [f64; 2]>) -> String {
    points.map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_shows_the_robot_the_beam_and_both_centrodes() {
        let svg = poster().expect("a picture");
        for (part, count) in
            [("tube", 3), ("body", 1), ("disk", 5), ("beam", 1), ("model", 1), ("sensor", 1), ("deviation", 1)]
        {
            assert_eq!(svg.matches(&format!("class=\"{part}\"")).count(), count, "{part}");
        }
        assert!(svg.len() < 6000 && !svg.contains("NaN") && !svg.contains("style="), "{svg}");
    }
}
