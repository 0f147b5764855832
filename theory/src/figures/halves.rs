//! Why the deviation is near s_c/2: the centrode is the mean of the points at which the backbone bends.

use crate::facts::quiet;
use anyhow::{Context, Result};
use centrode_core::chart::{Axis, Chart, Panel, Role, Series, Style};
use centrode_core::model::{Arc, Configuration, Constrained, Rate, Vec3};

/// Points of a curve.
const POINTS: usize = 121;
/// Bends at which a contact begins, degrees.
const BENDS: [f64; 3] = [10.0, 55.0, 90.0];

const MILLIMETRES: f64 = 1e3;

fn axis(name: &'static str) -> Axis {
    Axis::new(name, "m", "mm", MILLIMETRES)
}

/// The motion of which only the direction counts: bending on.
const ON: Rate = Rate { theta_l: -1.0, delta: 0.0 };

/// The centrodes of a segment of a length (m) without contact, and with a clamp at `s_c` (m) that began just now.
pub fn centrodes(length: f64, s_c: f64, bend: f64) -> Result<[Vec3; 2]> {
    let configuration = Configuration::new(bend, 0.0);
    let arc = Arc { length, configuration };
    let (pose, jacobian) = arc.pose_and_jacobian(length);
    let free = jacobian.centrode(&pose.position, ON).context("a free segment that turns")?;
    let held = Constrained::new(length, s_c, bend, configuration).centrode(ON).context("a held segment that turns")?;
    Ok([free, held])
}

/// The mean of an arc's points between two arc lengths (m), by Simpson's rule.
pub fn centroid(arc: &Arc, [from, to]: [f64; 2]) -> Vec3 {
    let steps = 200;
    let at = |k: usize| arc.pose(from + (to - from) * k as f64 / steps as f64).position;
    let weight = |k: usize| match k {
        0 => 1.0,
        k if k == steps => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=steps).map(|k| at(k) * weight(k)).sum::<Vec3>() / (3.0 * steps as f64)
}

/// The backbone as a clamp meets disk 2, and the means of its parts.
pub fn centroids() -> Result<Chart> {
    let run = quiet("bench", &[])?;
    let contact = run.plan.contact().context("a contact")?;
    let (length, s_c) = (run.segment().length, contact.arc_length);
    let arc = Arc { length, configuration: Configuration::new(contact.bend, 0.0) };
    let part = |from: f64, to: f64| {
        let at = |k: usize| arc.pose(from + (to - from) * k as f64 / (POINTS - 1) as f64).position;
        (0..POINTS).map(at).map(flat).collect::<Vec<_>>()
    };
    let below = centroid(&arc, [0.0, s_c]);
    let [free, held] = centrodes(length, s_c, contact.bend)?;
    let series = vec![
        Series::new("held part", Role::Contact, Style::Heavy, part(0.0, s_c)),
        Series::new("part that bends on", Role::Robot, Style::Line, part(s_c, length)),
        Series::new("means on one line", Role::Aside, Style::Dashed, vec![flat(below), flat(held)]),
        Series::new("mean of the held part", Role::Contact, Style::Diamonds, vec![flat(below)]),
        Series::new("c_c, mean of the part that bends on", Role::Constrained, Style::Circles, vec![flat(held)]),
        Series::new("c_m, mean of the whole", Role::Model, Style::Triangles, vec![flat(free)]),
    ];
    let mut panel = Panel { series, equal_scales: true, ..Panel::new(axis("x"), axis("z")) };
    panel.y.range = Some([0.0, length]);
    panel.x.range = Some([-0.2 * length, 0.8 * length]);
    Ok(chart("Centrodes as means of points of the backbone", panel))
}

fn flat(point: Vec3) -> [f64; 2] {
    [point.x, point.z]
}

/// How far the centrode leaves the model's as a clamp takes hold, against the place of the clamp.
pub fn half() -> Result<Chart> {
    let run = quiet("bench", &[])?;
    let length = run.segment().length;
    let mut series = Vec::new();
    for (k, degrees) in BENDS.iter().enumerate() {
        let mut points = Vec::new();
        for i in 0..POINTS {
            let s_c = length * i as f64 / POINTS as f64;
            let [free, held] = centrodes(length, s_c, degrees.to_radians())?;
            points.push([s_c, (held - free).norm()]);
        }
        let shade = Role::Member(k as f64 / (BENDS.len() - 1) as f64);
        series.push(Series::new(format!("φ = {degrees}°"), shade, Style::Line, points));
    }
    series.push(Series::new("s_c/2", Role::Constrained, Style::Dashed, vec![[0.0, 0.0], [length, 0.5 * length]]));
    let xi2 = run.plan.scenario().detection.xi2.value().context("ξ2 is on")?;
    series.push(Series::new("ξ_2", Role::Bound, Style::Thin, vec![[0.0, xi2], [length, xi2]]));
    let mut panel = Panel { series, ..Panel::new(axis("Place of the clamp s_c"), axis("‖c_c − c_m‖")) };
    panel.x.range = Some([0.0, length]);
    panel.y.range = Some([0.0, 0.5 * length]);
    Ok(chart("How far a clamp moves the centrode", panel))
}

/// A chart of one panel.
pub fn chart(title: &str, panel: Panel) -> Chart {
    Chart { title: title.into(), panels: vec![panel], caption: String::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_centrode_is_the_mean_of_the_points_that_bend() {
        for (s_c, bend) in [(0.0075, 0.3), (0.015, 0.96), (0.0225, 1.5)] {
            let length = 0.03;
            let arc = Arc { length, configuration: Configuration::new(bend, 0.0) };
            let [free, held] = centrodes(length, s_c, bend).unwrap();
            assert!((centroid(&arc, [0.0, length]) - free).norm() < 1e-11, "free at {bend}");
            assert!((centroid(&arc, [s_c, length]) - held).norm() < 1e-11, "held at {s_c}");
            let below = centroid(&arc, [0.0, s_c]);
            assert!(((held - free) - (held - below) * (s_c / length)).norm() < 1e-11);
        }
    }

    #[test]
    fn a_straight_segment_deviates_by_exactly_half() {
        for s_c in [0.001, 0.015, 0.029] {
            let [free, held] = centrodes(0.03, s_c, 0.0).unwrap();
            assert!(((held - free).norm() - 0.5 * s_c).abs() < 1e-15);
        }
    }
}
