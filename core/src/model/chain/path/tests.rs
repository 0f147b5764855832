use super::*;
use crate::model::chain::{Contact, Torsion, configuration, settle};

/// The robot of Figure 1: 30 mm each, EI as 3 : 2 : 1.
fn robot(torsion: Torsion) -> Vec<Rod> {
    let rod = |share: f64| Rod { length: 0.03, bending_stiffness: 0.0015 * share, torsion };
    [3.0, 2.0, 1.0].map(rod).to_vec()
}

/// From one value to another between two instants (s), at rest before and after.
fn rest_to_rest(from: f64, to: f64, start: f64, finish: f64, time: f64) -> f64 {
    let u = ((time - start) / (finish - start)).clamp(0.0, 1.0);
    from + (to - from) * u * u * u * (10.0 + u * (6.0 * u - 15.0))
}

/// From one bend of every segment to another, at rest before second 1 and after second 6.
fn course(from: [(f64, f64); 3], to: [(f64, f64); 3]) -> impl Fn(f64) -> Vec<Bends> {
    move |time| {
        let share = rest_to_rest(0.0, 1.0, 1.0, 6.0, time);
        let each = from.iter().zip(to).map(|(from, to)| {
            let (bend, delta) = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            Bends::new(bend * libm::sin(delta), bend * libm::cos(delta))
        });
        each.collect()
    }
}

const KNOTS: [f64; 4] = [0.0, 1.0, 6.0, 7.0];
const STRAIGHT: [(f64, f64); 3] = [(0.0, 0.0), (0.0, 1.0), (0.0, -0.8)];
const BENT: [(f64, f64); 3] = [(0.6, 0.3), (0.5, 1.0), (0.7, -0.8)];

fn from(segment: usize, time: f64, delta: f64, tilt: f64) -> Plane {
    Plane { segment, at: 0.015, delta, stands: Stands::From { time, tilt } }
}

/// Compares a path with shapes that are looked for anew.
fn against_settled(rods: &[Rod], course: &dyn Course, path: &Path, planes: &[Plane]) {
    for k in 0..=70 {
        let time = f64::from(k) * 0.1;
        if time > path.end() {
            break;
        }
        let bends = course.bends(time);
        let standing: Vec<(usize, Contact)> = planes
            .iter()
            .enumerate()
            .filter(|(_, plane)| plane.time().is_none_or(|stands| stands <= time))
            .filter_map(|(place, plane)| {
                let (normal, offset) = path.plane(place)?;
                Some((place, Contact { segment: plane.segment, at: plane.at, normal, offset }))
            })
            .collect();
        let contacts: Vec<Contact> = standing.iter().map(|(_, contact)| *contact).collect();
        let at: Vec<_> = bends.iter().map(configuration).collect();
        let settled = settle(rods, &at, &contacts).unwrap_or_else(|error| panic!("{time}: {error}"));
        let instant = path.at(time, &bends);
        for (ours, theirs) in instant.disks.iter().zip(&settled.disks) {
            let off = (ours.position - theirs.pose.position).norm();
            assert!(off < 1e-9 * 0.09, "{time}: {off:e} m off, {:?} {:?}", instant.active, settled.active);
            assert!((ours.rotation - theirs.pose.rotation).amax() < 1e-8, "{time}");
        }
        for ((place, _), force) in standing.iter().zip(&settled.forces) {
            let off = (instant.forces[*place] - force).abs();
            assert!(off < 1e-6 * (1.0 + force.abs()), "{time}: contact {place} {} {force}", instant.forces[*place]);
        }
        let line = path.backbone(time, &bends, 12);
        for (ours, theirs) in line.iter().zip(&settled.disks) {
            let end = ours.last().expect("points");
            assert!((end.position - theirs.pose.position).norm() < 1e-9 * 0.09, "{time}: backbone");
        }
    }
}

#[test]
fn a_path_goes_through_the_shapes_that_are_found_one_by_one() {
    let rods = robot(Torsion::Ratio(5.0));
    for (planes, bent) in [
        (vec![from(2, 3.5, -0.8, 0.0)], BENT),
        (vec![from(1, 3.0, 1.0, 0.4)], BENT),
        (vec![from(0, 3.0, 0.3, 0.0)], BENT),
        (vec![from(1, 3.0, 1.0, 0.0), from(2, 3.8, -0.8, 0.0)], BENT),
    ] {
        let course = course(STRAIGHT, bent);
        let path = Path::new(&rods, &course, &KNOTS, &planes).expect("begins free");
        assert_eq!(path.end(), 7.0, "{:?}", path.happened());
        against_settled(&rods, &course, &path, &planes);
    }
}

/// All segments bend alike in one plane, from straight by 18° a second.
fn alike(time: f64) -> Vec<Bends> {
    vec![Bends::new(0.0, time * std::f64::consts::PI / 10.0); 3]
}

#[test]
fn a_chain_in_its_plane_buckles_where_it_is_known_to() {
    // Segment touched in the middle at 20° per segment, stiffness in torsion, bend per segment (deg) at which it buckles.
    for (segment, torsion, bend) in [
        (2, Torsion::Rigid, Some(46.0)),
        (1, Torsion::Rigid, Some(65.0)),
        (2, Torsion::Ratio(5.0), Some(32.0)),
        (1, Torsion::Ratio(5.0), Some(49.0)),
        (0, Torsion::Rigid, None),
    ] {
        let path = Path::new(&robot(torsion), &alike, &[0.0, 5.0], &[from(segment, 20.0 / 18.0, 0.0, 0.0)]);
        let path = path.expect("begins free");
        let buckled = path.happened().iter().find(|event| event.what == What::Buckled);
        let found = buckled.map(|event| event.time * 18.0);
        match (found, bend) {
            (Some(found), Some(bend)) => {
                assert!((found - bend).abs() < 0.6, "segment {segment}: {found}");
                assert!((path.end() - found / 18.0).abs() < 1e-12);
                let margin = path.at(path.end(), &alike(path.end())).margin;
                assert!((0.0..1e-3).contains(&margin), "{margin}");
            }
            (found, bend) => assert_eq!(found, bend),
        }
    }
}

#[test]
fn a_contact_far_out_opens_one_below() {
    let rods = robot(Torsion::Ratio(5.0));
    // Segment 3 meets a plane while segment 1 presses on one, and carries it off.
    let course = |time: f64| {
        let share = |start: f64| rest_to_rest(0.0, 1.0, start, start + 3.0, time);
        vec![Bends::new(0.0, 0.3 * share(0.0)), Bends::new(0.0, 0.0), Bends::new(0.0, 0.9 * share(3.0))]
    };
    let knots = [0.0, 3.0, 6.0, 7.0];
    let planes = [from(0, 2.0, 0.0, 0.0), from(2, 3.6, 0.0, 0.0)];
    let path = Path::new(&rods, &course, &knots, &planes).expect("begins free");
    let opened = path.happened().iter().find(|event| event.what == What::Opened(0));
    assert!(opened.is_some(), "{:?}", path.happened());
    against_settled(&rods, &course, &path, &planes);
}

#[test]
fn a_plane_that_stands_from_the_start_is_met_and_left_as_the_chain_goes_there_and_back() {
    let rods = robot(Torsion::Ratio(5.0));
    let course = |time: f64| {
        let share = rest_to_rest(0.0, 1.0, 0.0, 3.0, time) - rest_to_rest(0.0, 1.0, 3.5, 6.5, time);
        vec![Bends::new(0.1 * share, 0.4 * share), Bends::new(0.0, 0.3 * share), Bends::new(-0.2 * share, 0.3 * share)]
    };
    let plane = Plane { segment: 2, at: 0.03, delta: 0.0, stands: Stands::Always { normal: Vec3::x(), offset: 0.03 } };
    let path = Path::new(&rods, &course, &[0.0, 3.0, 3.5, 6.5, 7.0], &[plane]).expect("begins free");
    let what: Vec<What> = path.happened().iter().map(|event| event.what).collect();
    assert_eq!(what, [What::Met(0), What::Opened(0)], "{:?}", path.happened());
    let [met, left] = [0, 1].map(|k| path.happened()[k].time);
    assert!((met + left - 6.5).abs() < 1e-6, "{met} {left}");
    against_settled(&rods, &course, &path, &[plane]);
}

#[test]
fn one_segment_in_its_plane_is_as_the_elastic_segment_has_it() {
    use crate::model::contact::Meeting;
    use crate::model::contact::branch::{Surface, Touch};
    use crate::model::{Configuration, Touched};
    let rods = [Rod { length: 0.03, bending_stiffness: 0.0045, torsion: Torsion::Ratio(5.0) }];
    let bend = |time: f64| rest_to_rest(0.0, 1.4, 0.0, 5.0, time);
    let delta = 0.7;
    let course = |time: f64| vec![crate::model::chain::bends(Configuration::new(bend(time), delta))];
    let path = Path::new(&rods, &course, &[0.0, 5.0], &[from(0, 2.0, delta, 0.0)]).expect("begins free");
    let meeting = Meeting { place: 0.5, bend: bend(2.0), side: 1.0 };
    let touch = Touch::new(meeting, Surface::Plane, 1.5, false);
    for time in [2.1, 2.5, 3.0, 4.0, 5.0] {
        let touched = Touched::new(0.03, std::sync::Arc::clone(touch.branch()), Configuration::new(bend(time), delta));
        let (theirs, instant) = (touched.tip_pose(), path.at(time, &course(time)));
        assert!((instant.disks[0].position - theirs.position).norm() < 1e-11, "{time}");
        assert!((instant.disks[0].rotation - theirs.rotation).amax() < 1e-9, "{time}");
        let force = touched.force(0.0045).expect("a plane");
        assert!((instant.forces[0] - force).abs() < 1e-6 * force, "{time}: {} {force}", instant.forces[0]);
    }
}

#[test]
fn a_course_that_begins_beyond_a_plane_begins_pressed() {
    let rods = robot(Torsion::Ratio(5.0));
    let course = |time: f64| vec![Bends::new(0.0, 0.5 - 0.1 * time), Bends::new(0.0, 0.2), Bends::new(0.0, 0.3)];
    let plane = Plane { segment: 1, at: 0.02, delta: 0.0, stands: Stands::Always { normal: Vec3::x(), offset: 0.01 } };
    let path = Path::new(&rods, &course, &[0.0, 2.0, 5.0], &[plane]).expect("a stable shape");
    assert_eq!(path.happened()[0], Happened { time: 0.0, what: What::Met(0) });
    against_settled(&rods, &course, &path, &[plane]);
}

#[test]
fn a_clamp_keeps_what_is_below_and_lets_the_rest_bend_on() {
    use crate::model::{Configuration, Constrained};
    let rods = robot(Torsion::Ratio(5.0));
    let bend = |time: f64| rest_to_rest(0.2, 1.2, 1.0, 6.0, time);
    let course =
        |time: f64| vec![Bends::new(0.1, 0.3), Bends::new(0.0, bend(time)), Bends::new(0.0, 0.1 + 0.3 * bend(time))];
    let clamp = Plane { segment: 1, at: 0.015, delta: 0.0, stands: Stands::Clamped { time: 3.0 } };
    let path = Path::new(&rods, &course, &KNOTS, &[clamp]).expect("begins free");
    assert_eq!(path.happened(), [Happened { time: 3.0, what: What::Met(0) }]);
    for time in [2.9, 3.0, 3.1, 4.0, 7.0] {
        let (bends, instant) = (course(time), path.at(time, &course(time)));
        let free = free::poses(&rods, &bends);
        assert_eq!(instant.disks[0], free[0]);
        let own = Configuration::new(bend(time), 0.0);
        let held = if time <= 3.0 { own.bend() } else { bend(3.0) };
        let second = Constrained::new(0.03, 0.015, held, own).tip_pose();
        let base = instant.disks[0];
        let expected = base.position + base.rotation * second.position;
        assert!((instant.disks[1].position - expected).norm() < 1e-15, "{time}");
        let third = free::end(0.03, configuration(&bends[2])).0;
        let expected = instant.disks[1].position + instant.disks[1].rotation * third.position;
        assert!((instant.disks[2].position - expected).norm() < 1e-15, "{time}");
        let line = path.backbone(time, &bends, 10);
        assert!((line[1][10].position - instant.disks[1].position).norm() < 1e-15, "{time}");
    }
    // A plane above it, which comes to stand later.
    let above = [clamp, from(2, 4.0, 0.0, 0.0)];
    let path = Path::new(&rods, &course, &KNOTS, &above).expect("begins free");
    assert_eq!(path.happened()[1], Happened { time: 4.0, what: What::Met(1) });
    let (instant, (normal, offset)) = (path.at(7.0, &course(7.0)), path.plane(1).expect("stands"));
    assert!(instant.forces[1] > 0.0 && instant.active == [0, 1] && instant.forces[0].is_nan());
    let point = path.pose(7.0, &course(7.0), 2, 0.015).position;
    assert!((normal.dot(&point) - offset).abs() < 1e-11);
}
