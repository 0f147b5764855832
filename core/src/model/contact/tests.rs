//! Touching shapes against 40-digit values, closed forms, and each other.

use super::branch::{Branch, Ending, Surface};
use super::ritz::Basis;
use super::*;
use libm::{cos, sin};
use nalgebra::{Matrix4, Vector4};
use serde::Deserialize;
use std::f64::consts::PI;

#[derive(Deserialize)]
struct Reference {
    cases: Vec<Case>,
}

/// Numbers are strings, as they have 40 digits.
#[derive(Deserialize)]
struct Case {
    s_c: String,
    phi_contact: String,
    phi: String,
    tip_x: String,
    tip_z: String,
    tip_angle: String,
    dtip_x_dphi: String,
    dtip_z_dphi: String,
    centrode_x: String,
    centrode_z: String,
    slope_at_contact: String,
    dslope_dphi: String,
    #[serde(rename = "contact_force_L2_over_EI")]
    force: String,
    dforce_dphi: String,
    #[serde(rename = "curvature_above_L")]
    curvature_above: String,
    #[serde(rename = "curvature_base_L")]
    curvature_base: String,
    contact_x: String,
    contact_z: String,
}

fn number(text: &str) -> f64 {
    text.parse().expect("a number")
}

fn meeting(place: f64, bend: f64) -> Meeting {
    Meeting { place, bend, side: 1.0 }
}

#[test]
fn a_plane_has_the_reference_values() {
    let reference: Reference = serde_json::from_str(include_str!("../../../tests/data/touch.json")).expect("reference");
    assert_eq!(reference.cases.len(), 25);
    let basis = Basis::new();
    for case in &reference.cases {
        let meeting = meeting(number(&case.s_c), number(&case.phi_contact));
        let bend = number(&case.phi);
        let solved = plane::solve(&basis, &meeting, bend, None).expect("a shape");
        assert!(solved.stable);
        let shape = solved.touching;
        let (tip, by) = shape.tip(&basis);
        let (end, angle) = shape.point(&basis, 1.0);
        let (held, slope) = shape.point(&basis, meeting.place);
        let centrode = shape.centrode(&basis);
        let force_by = shape.by_bend.multiplier / (meeting.place * meeting.place);
        let tolerance = if bend < 0.5001 * PI { 1e-13 } else { 1e-9 };
        for (what, ours, theirs, size) in [
            ("tip x", tip.x, &case.tip_x, 1.0),
            ("tip z", tip.y, &case.tip_z, 1.0),
            ("end x", end.x, &case.tip_x, 1.0),
            ("end z", end.y, &case.tip_z, 1.0),
            ("angle", angle, &case.tip_angle, 1.0),
            ("tip x by φ", by.x, &case.dtip_x_dphi, 1.0),
            ("tip z by φ", by.y, &case.dtip_z_dphi, 1.0),
            ("centrode x", centrode.x, &case.centrode_x, 1.0),
            ("centrode z", centrode.y, &case.centrode_z, 1.0),
            ("slope", slope, &case.slope_at_contact, 1.0),
            ("slope by φ", shape.by_bend.coefficients[0], &case.dslope_dphi, 1.0),
            ("force", shape.force(), &case.force, 100.0),
            ("force by φ", force_by, &case.dforce_dphi, 100.0),
            ("curvature above", shape.curvature_above(), &case.curvature_above, 1.0),
            ("curvature at the base", shape.curvature(0.0), &case.curvature_base, 1e5),
            ("contact x", held.x, &case.contact_x, 1.0),
            ("contact z", held.y, &case.contact_z, 1.0),
        ] {
            let error = (ours - number(theirs)).abs();
            let (at, bend) = (&case.s_c, bend.to_degrees());
            assert!(error <= tolerance * size, "{what} at {at}, {bend}°: {ours} for {theirs}, off by {error:e}");
        }
    }
}

#[test]
fn a_cylinder_of_no_radius_that_touches_where_it_did_is_a_plane_of_small_bends() {
    // At first contact, and to first order beyond it, nothing has slid yet.
    let basis = Basis::new();
    for place in [0.25, 0.5, 0.75] {
        let meeting = meeting(place, 0.3);
        let shape = cylinder::solve(&basis, &meeting, 0.0, 0.3, None).expect("a shape");
        let plane = plane::solve(&basis, &meeting, 0.3, None).expect("a shape");
        assert!(shape.stable && plane.stable, "{place}");
        let (a, b) = (shape.touching.tip(&basis), plane.touching.tip(&basis));
        assert!((a.0 - b.0).amax() < 1e-14 && (a.1 - b.1).amax() < 1e-12, "{a:?} {b:?}");
    }
}

/// n at a slope (rad).
fn normal(slope: f64) -> Planar {
    Planar::new(cos(slope), -sin(slope))
}

fn along(meeting: &Meeting, surface: Surface, last: f64) -> (Branch, Vec<Touching>) {
    let branch = Branch::new(*meeting, surface, last);
    let end = branch.ending().map_or(last, |(bend, _)| bend);
    let bends = (1..=40).map(|k| meeting.bend + (end - meeting.bend) * f64::from(k) / 40.0);
    let shapes = bends.map(|bend| branch.shape(bend).expect("on the branch")).collect();
    (branch, shapes)
}

fn all() -> Vec<(Meeting, Surface)> {
    let mut all = Vec::new();
    for place in [0.1, 0.25, 0.5, 0.75, 0.9] {
        for bend in [0.05, 0.6, 1.2] {
            for surface in [Surface::Plane, Surface::Cylinder { rounding: 0.1 }, Surface::Cylinder { rounding: 0.01 }] {
                all.push((meeting(place, bend), surface));
            }
        }
    }
    all
}

#[test]
fn a_branch_goes_through_every_bend_and_its_polynomials_are_exact() {
    for (meeting, surface) in all() {
        let (branch, shapes) = along(&meeting, surface, PI);
        let known = |how| matches!(how, Ending::SlidesOff | Ending::Wraps);
        assert!(branch.ending().is_none_or(|(_, how)| known(how)), "{meeting:?} {surface:?}");
        for shape in shapes {
            let (tip, by) = shape.tip(branch.basis());
            let (fast, (upper, place)) = (branch.tip(shape.bend), branch.above(shape.bend));
            let off = (tip - fast.position).amax().max((by - fast.by_bend).amax() * 0.1);
            assert!(off < 1e-12, "{meeting:?} {surface:?} at {}: off by {off:e}", shape.bend);
            assert!((upper - shape.upper_bend()).abs() < 1e-12 && (place - shape.at.place).abs() < 1e-12);
        }
    }
}

#[test]
fn a_sketched_branch_is_right_to_what_a_map_shows() {
    for (meeting, surface) in all() {
        let last = meeting.bend + meeting.side * 1.2;
        let [exact, sketched] = [Branch::new, Branch::sketched].map(|follow| follow(meeting, surface, last));
        let [at, sketch] = [&exact, &sketched].map(Branch::ending);
        assert_eq!(at.is_some(), sketch.is_some());
        assert!(at.zip(sketch).is_none_or(|(at, sketch)| (at.0 - sketch.0).abs() < 1e-4), "{at:?} {sketch:?}");
        for k in 1..60 {
            let bend = meeting.bend + (last - meeting.bend) * f64::from(k) / 60.0;
            if !exact.holds_at(bend) || !sketched.holds_at(bend) {
                continue;
            }
            let (a, b) = (exact.tip(bend), sketched.tip(bend));
            let what = format!("{meeting:?} {surface:?} at {bend}");
            // Near the end of the backbone a sliding contact hurries.
            let coarse = if exact.above(bend).1 < 0.93 { 1.0 } else { 100.0 };
            assert!((a.position - b.position).norm() < 1e-5 * coarse, "{what}: {a:?} {b:?}");
            assert!((a.by_bend - b.by_bend).norm() < 1e-3 * coarse, "{what}: {a:?} {b:?}");
            assert!((exact.above(bend).0 - sketched.above(bend).0).abs() < 1e-4 * coarse, "{what}");
        }
    }
}

#[test]
fn bend_and_what_is_held_are_kept_and_the_force_pushes() {
    for (meeting, surface) in all() {
        let (branch, shapes) = along(&meeting, surface, PI);
        let basis = branch.basis();
        let first = branch.shape(meeting.bend).expect("first contact");
        assert!(first.force().abs() < 1e-12, "{}", first.force());
        let centre = |shape: &Touching| {
            let (point, slope) = shape.point(basis, shape.at.place);
            match surface {
                Surface::Plane => {
                    // Only the position along the normal is held.
                    Planar::new(point.dot(&normal(meeting.slope())), 0.0)
                }
                Surface::Cylinder { rounding } => point + normal(slope) * rounding,
            }
        };
        let mut force = 0.0;
        for shape in shapes {
            assert!((shape.point(basis, 1.0).1 - shape.bend).abs() < 1e-14 * 8.0);
            let off = (centre(&shape) - centre(&first)).amax();
            assert!(off < 1e-12, "{meeting:?} {surface:?} at {}: moved by {off:e}", shape.bend);
            assert!(shape.force() > force, "{meeting:?} {surface:?} at {}", shape.bend);
            force = if surface == Surface::Plane { shape.force() } else { 0.0 };
        }
    }
}

#[test]
fn the_tips_velocity_is_the_derivative_of_its_position() {
    for (meeting, surface) in all() {
        let (branch, shapes) = along(&meeting, surface, PI);
        for shape in shapes.iter().step_by(7).take(5) {
            let h = 1e-3;
            let at = |k: f64| branch.shape(shape.bend + k * h).map(|shape| shape.tip(branch.basis()).0);
            let (Some(a), Some(b), Some(c), Some(d)) = (at(-2.0), at(-1.0), at(1.0), at(2.0)) else { continue };
            let difference = (a - d + (c - b) * 8.0) / (12.0 * h);
            let off = (difference - shape.tip(branch.basis()).1).amax();
            assert!(off < 1e-8, "{meeting:?} {surface:?} at {}: off by {off:e}", shape.bend);
        }
    }
}

#[test]
fn it_costs_less_energy_than_a_clamp_and_more_than_an_arc() {
    for (meeting, surface) in all() {
        let (_, shapes) = along(&meeting, surface, PI);
        for shape in shapes {
            let (frozen, above) = (meeting.slope(), shape.bend - meeting.slope());
            let clamp = 0.5 * (frozen * frozen / meeting.place + above * above / (1.0 - meeting.place));
            let free = 0.5 * shape.bend * shape.bend;
            let energy = shape.energy();
            assert!(free < energy && energy < clamp, "{meeting:?} {surface:?}: {free} {energy} {clamp}");
        }
    }
}

#[test]
fn bending_the_other_way_is_the_mirror_image() {
    for (meeting, surface) in all().into_iter().step_by(5) {
        let mirrored = Meeting { bend: -meeting.bend, side: -1.0, ..meeting };
        let (branch, shapes) = along(&meeting, surface, 2.0);
        let other = Branch::new(mirrored, surface, -2.0);
        for shape in shapes {
            let (a, b) = (branch.tip(shape.bend), other.tip(-shape.bend));
            let off = (a.position.x + b.position.x).abs().max((a.position.y - b.position.y).abs());
            assert!(off < 1e-12, "{meeting:?} {surface:?}: off by {off:e}");
            assert!((a.by_bend.x - b.by_bend.x).abs().max((a.by_bend.y + b.by_bend.y).abs()) < 1e-11);
        }
    }
}

#[test]
fn near_first_contact_the_slope_turns_at_its_known_share() {
    for place in [0.1, 0.25, 0.5, 0.75, 0.9] {
        let meeting = meeting(place, 1e-6);
        for surface in [Surface::Plane, Surface::Cylinder { rounding: 0.1 }] {
            let branch = Branch::new(meeting, surface, 2e-6);
            let shape = branch.shape(1e-6).expect("first contact");
            // For small bends the slope at the contact turns at 1/(4 − 3s) of its free rate s.
            let rate = shape.by_bend.coefficients[0] / place;
            assert!((rate - 1.0 / (4.0 - 3.0 * place)).abs() < 1e-6, "{place}: {rate}");
            // And the deviation of the centrodes settles at s(3 − 2s)/(2(4 − 3s)).
            let free = Planar::new(0.0, 0.5);
            let deviation = (shape.centrode(branch.basis()) - free).norm();
            let known = place * (3.0 - 2.0 * place) / (2.0 * (4.0 - 3.0 * place));
            assert!((deviation - known).abs() < 2e-6, "{place}: {deviation} {known}");
        }
    }
}

/// α, κ, x, z at the end of the part below the contact, by Runge–Kutta from the base.
fn shot(curvature: f64, force: f64, slope: f64, place: f64) -> [f64; 4] {
    let steps = 2000;
    let h = place / f64::from(steps);
    let rate = |y: [f64; 4]| [y[1], force * cos(y[0] - slope), sin(y[0]), cos(y[0])];
    let ahead = |y: [f64; 4], k: [f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    (0..steps).fold([0.0, curvature, 0.0, 0.0], |y, _| {
        let a = rate(y);
        let b = rate(ahead(y, a, 0.5 * h));
        let c = rate(ahead(y, b, 0.5 * h));
        let d = rate(ahead(y, c, h));
        std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
    })
}

/// Curvature at the base, force, place and slope of the force's line, from a start near by: what is left of the four equations
/// is zero.
fn shoot(start: Vector4<f64>, left: impl Fn(&Vector4<f64>) -> Vector4<f64>) -> Vector4<f64> {
    (0..6).fold(start, |at, _| {
        let column = |i: usize| {
            let step = Vector4::ith(i, 1e-6 * at[i].abs().max(1.0));
            (left(&(at + step)) - left(&(at - step))) / (2.0 * step[i])
        };
        let jacobian = Matrix4::from_columns(&[column(0), column(1), column(2), column(3)]);
        at - jacobian.lu().solve(&left(&at)).expect("regular")
    })
}

#[test]
fn shooting_finds_the_same_shapes() {
    let mut compared = 0;
    for (meeting, surface) in all() {
        let (branch, shapes) = along(&meeting, surface, 2.0);
        let first = branch.shape(meeting.bend).expect("first contact").point(branch.basis(), meeting.place).0;
        // Nearer to the end of the backbone shooting loses its digits.
        let apart = [&shapes[9], &shapes[24], &shapes[39]].into_iter().filter(|shape| shape.at.place < 0.98);
        for shape in apart {
            compared += 1;
            let left = |at: &Vector4<f64>| {
                let (place, slope) = (at[2], at[3]);
                let [angle, curvature, x, z] = shot(at[0], at[1], slope, place);
                let moment = curvature - (shape.bend - angle) / (1.0 - place);
                let moved = Planar::new(x, z) - first;
                match surface {
                    Surface::Plane => {
                        let known = meeting.slope();
                        Vector4::new(moment, moved.dot(&normal(known)), place - meeting.place, slope - known)
                    }
                    Surface::Cylinder { rounding } => {
                        let moved = moved + (normal(slope) - normal(meeting.slope())) * rounding;
                        Vector4::new(moment, moved.x, moved.y, angle - slope)
                    }
                }
            };
            let start = Vector4::new(shape.curvature(0.0), shape.force(), shape.at.place, shape.force_slope);
            let found = shoot(start, left);
            assert!(left(&found).amax() < 1e-9, "{meeting:?} {surface:?} at {}: {found} {}", shape.bend, left(&found));
            let (place, [angle, _, x, z]) = (found[2], shot(found[0], found[1], found[3], found[2]));
            let tip = Planar::new(x, z) + arc(angle, shape.bend - angle, 1.0 - place);
            let off = (tip - shape.tip(branch.basis()).0).amax();
            assert!(off < 1e-8, "{meeting:?} {surface:?} at {}: off by {off:e}", shape.bend);
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn a_segment_that_straightens_against_a_beam_snaps_off_where_it_is_known_to() {
    // 135° at contact, 22.5 and 28.5 of 30 mm.
    for (place, known) in [(0.75, -111.98), (0.95, -31.42)] {
        let meeting = Meeting { place, bend: 135_f64.to_radians(), side: -1.0 };
        let branch = Branch::new(meeting, Surface::Plane, -PI);
        let (bend, how) = branch.ending().expect("an end");
        assert_eq!(how, Ending::Snaps);
        assert!((bend.to_degrees() - known).abs() < 0.1, "{place}: {}", bend.to_degrees());
        assert!(branch.holds_at(bend + 1e-6) && !branch.holds_at(bend - 1e-6));
    }
    for place in [0.1, 0.25, 0.5, 0.75, 0.95] {
        let meeting = Meeting { place, bend: 0.5 * PI, side: -1.0 };
        assert_eq!(Branch::new(meeting, Surface::Plane, 0.0).ending(), None, "{place}");
    }
}

#[test]
fn a_backbone_as_curved_as_the_beam_would_wrap_around_it() {
    let (branch, shapes) = along(&meeting(0.5, 0.3), Surface::Cylinder { rounding: 1.0 / 3.0 }, 2.9);
    let (end, how) = branch.ending().expect("an end");
    assert_eq!(how, Ending::Wraps);
    assert!((1.6..2.0).contains(&end), "{end}");
    assert!(shapes.iter().all(|shape| shape.curvature_above() / 3.0 < 1.0));
}

#[test]
fn a_branch_holds_past_its_last_bend_by_rounding_and_at_first_contact() {
    let met = meeting(0.5, 0.6);
    let branch = Branch::new(met, Surface::Plane, 1.2);
    assert!(branch.holds_at(1.2_f64.next_up()) && !branch.holds_at(0.6));
    let only = Branch::new(met, Surface::Plane, 0.6);
    let (tip, first) = (only.tip(0.6), branch.tip(0.6));
    assert!((tip.position - first.position).norm() < 1e-12 && (tip.by_bend - first.by_bend).norm() < 1e-10);
    assert!((only.above(0.6).0 - 0.3).abs() < 1e-15);
}

#[test]
fn in_space_the_bending_plane_turns_with_delta_and_mirrors() {
    use super::touched::Touched;
    use crate::model::{Configuration, Rate, Vec3};
    let branch = std::sync::Arc::new(Branch::new(meeting(0.5, 0.6), Surface::Plane, 1.4));
    let at = |delta: f64| Touched::new(0.03, std::sync::Arc::clone(&branch), Configuration::new(1.3, delta));
    let flat = at(0.0);
    for delta in [0.7, -0.7, 2.5, PI] {
        let turned = |v: Vec3| Vec3::new(cos(delta) * v.x + sin(delta) * v.y, cos(delta) * v.y - sin(delta) * v.x, v.z);
        let shape = at(delta);
        for s in [0.004, 0.015, 0.022, 0.03] {
            assert!((shape.pose(s).position - turned(flat.pose(s).position)).norm() < 1e-15, "{delta} at {s}");
        }
        let [(a, by_a), (b, by_b)] = [&flat, &shape].map(Touched::tip_pose_and_jacobian);
        assert!((b.position - turned(a.position)).norm() < 1e-15);
        let [slow, fast] = [by_a, by_b].map(|by| by.twist(Rate::BENDING));
        assert!((fast.linear - turned(slow.linear)).norm() < 1e-15);
        assert!((fast.angular - turned(slow.angular)).norm() < 1e-15);
        let centrode = shape.centrode(Rate::BENDING).expect("it bends");
        assert!((centrode - turned(flat.centrode(Rate::BENDING).expect("it bends"))).norm() < 1e-15);
    }
    // Mirrored in δ, mirrored in y.
    let [a, b] = [0.7, -0.7].map(|delta| at(delta).tip_pose().position);
    assert!((a - Vec3::new(b.x, -b.y, b.z)).norm() < 1e-15);
}
