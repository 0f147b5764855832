use super::*;
use crate::scene::palette::Shade;
use crate::scene::{Color, Finish, Shape};
use centrode_core::detect::chain::ChainContactFound;
use centrode_core::scenario::{ChainPlan, ChainScenario, preset};
use glam::Vec2;
use std::sync::LazyLock;

/// All presets, run once.
static RUNS: LazyLock<Vec<(&str, ChainRun)>> = LazyLock::new(|| {
    let run = |preset: &preset::Preset| (preset.name, of(&preset.chain(&[]).expect(preset.name)));
    preset::CHAINS.iter().map(run).collect()
});

fn of(scenario: &ChainScenario) -> ChainRun {
    ChainRun::new(ChainPlan::new(scenario).expect("stable at first"))
}

fn run(name: &str) -> &'static ChainRun {
    &RUNS.iter().find(|(known, _)| *known == name).expect("preset").1
}

fn at(run: &ChainRun, time: f64, placed: &[&ChainEstimate]) -> Scene {
    view(run, time, &ChainOptions { palette: Palette::LIGHT, pulse: 0.0, chosen: 0, placed })
}

fn found(run: &ChainRun) -> Vec<ChainContactFound> {
    run.judged.contacts(run.judged.teller().expect("a detector"), &[0.5])
}

fn ghosts(scene: &Scene) -> usize {
    scene.tubes.iter().filter(|tube| tube.finish == Finish::Ghost).count()
}

fn lines(scene: &Scene, color: Color) -> usize {
    scene.lines.iter().filter(|line| line.color.alpha(1.0) == color).count()
}

fn says(scene: &Scene, text: &str) -> bool {
    scene.labels.iter().any(|label| label.text.contains(text))
}

#[test]
fn the_story_is_told_in_order() {
    let run = run("two-contacts");
    let palette = Palette::LIGHT;
    let [rest, bending, one, two] = [1.0, 5.0, 6.0, 8.0].map(|time| at(run, time, &[]));
    assert_eq!([&rest, &bending].map(ghosts), [0, 0]);
    assert_eq!(ghosts(&one), 9, "the free chain appears with the first contact");
    let arrows = [&rest, &bending, &one, &two].map(|scene| lines(scene, palette.force));
    assert_eq!(arrows, [0, 0, 3, 6], "an arrow for each force, of three strokes");
    let pale = |scene: &Scene| scene.blocks.iter().filter(|block| block.color.a < 1.0).count();
    let beams = |scene: &Scene| scene.blocks.len() - 1;
    assert!(beams(&rest) == beams(&two) && pale(&rest) == beams(&rest), "both are pale before they stand");
    assert!(pale(&one) == pale(&rest) / 2 && pale(&two) == 0);
    for segment in 1..=3 {
        assert!(says(&rest, &format!("segment {segment}")));
    }
}

#[test]
fn forces_are_those_of_the_truth() {
    let run = run("two-contacts");
    let time = 8.0;
    let scene = at(run, time, &[]);
    let truth = run.plan.path().at(time, &run.plan.bends(time));
    for force in truth.forces {
        assert!(force > 0.1 && says(&scene, &format!("{force:.2} N")), "{force}");
    }
    let mut strokes = scene.lines.iter().filter(|line| line.color == Palette::LIGHT.force);
    let (shaft, normal) = (strokes.next().expect("an arrow"), run.plan.path().plane(0).expect("a plane").0);
    let along = (shaft.path[1] - shaft.path[0]).normalize();
    assert!(along.distance(-crate::show::scene_vector(&normal)) < 1e-4, "it pushes against the normal: {along}");
}

#[test]
fn a_contact_is_placed_on_the_segment_that_carries_it() {
    let run = run("two-contacts");
    let found = found(run);
    let estimates: Vec<&ChainEstimate> = found.iter().filter_map(|found| found.estimates.first()).collect();
    assert_eq!(estimates.iter().map(|estimate| estimate.segment).collect::<Vec<_>>(), [1, 2]);
    let color = Palette::LIGHT.constrained;
    let diamonds = |scene: &Scene| scene.markers.iter().filter(|marker| marker.shape == Shape::Diamond).count();
    let (none, one, both) = (at(run, 8.0, &[]), at(run, 8.0, &estimates[..1]), at(run, 8.0, &estimates));
    assert_eq!((lines(&none, color), diamonds(&none)), (0, 0));
    assert!(lines(&one, color) > 3 && lines(&both, color) > lines(&one, color));
    assert_eq!((diamonds(&one), diamonds(&both)), (1, 2));
    assert!(says(&both, "segment 2: ") && says(&both, "segment 3: "));
    // Within a millimetre of where the backbone truly is touched.
    let touched = run.plan.scenario().contacts.iter().map(|contact| {
        let pose = run.plan.path().pose(8.0, &run.plan.bends(8.0), contact.segment, contact.at);
        crate::show::scene_vector(&pose.position)
    });
    let leaders: Vec<_> = both.lines.iter().filter(|line| line.color == Palette::LIGHT.detection).collect();
    let leaders = leaders.iter().filter(|line| both.labels.iter().any(|label| line.path.last() == Some(&label.anchor)));
    let starts: Vec<Vec3> = leaders.map(|line| line.path[0]).collect();
    assert_eq!(starts.len(), 2);
    assert!(starts.iter().zip(touched).all(|(start, touched)| start.distance(touched) < 1e-3));
}

#[test]
fn only_the_latest_alarm_has_a_ring() {
    let run = run("two-contacts");
    let found = found(run);
    let placed: Vec<&ChainEstimate> = found.iter().filter_map(|found| found.estimates.first()).collect();
    let scene = view(run, 8.0, &ChainOptions { palette: Palette::DARK, pulse: 0.4, chosen: 1, placed: &placed });
    let pulses = scene.markers.iter().filter(|marker| marker.shape == Shape::Diamond).map(|marker| marker.pulse);
    assert_eq!(pulses.collect::<Vec<_>>(), [0.0, 0.4]);
}

#[test]
fn where_it_buckles_the_picture_stops_and_says_so() {
    let run = run("buckling");
    let end = run.plan.path().end();
    let [before, after, later] = [end - 0.1, end, 9.9].map(|time| at(run, time, &[]));
    assert!(!says(&before, "buckled") && says(&after, "buckled") && says(&later, "buckled"));
    assert_eq!(after.tubes, later.tubes);
    assert!(!says(&at(self::run("two-contacts"), 10.0, &[]), "buckled"));
}

#[test]
fn a_plate_stands_where_its_plane_is() {
    for (name, run) in RUNS.iter() {
        let scene = at(run, 9.9, &[]);
        let plates: Vec<_> =
            scene.blocks.iter().filter(|b| matches!(b.solid, crate::scene::Solid::Box { .. })).collect();
        let planes = (0..run.plan.scenario().contacts.len()).filter_map(|place| run.plan.path().plane(place));
        let planes: Vec<_> = planes.collect();
        assert_eq!(plates.len(), planes.len(), "{name}");
        for (plate, (normal, offset)) in plates.iter().zip(planes) {
            let normal = crate::show::scene_vector(&normal);
            assert!(plate.pose.rotation.mul_vec3(Vec3::X).distance(normal) < 1e-4, "{name}");
            let beyond = normal.dot(plate.pose.position) - offset as f32;
            assert!((0.002..0.006).contains(&beyond), "{name}: by the robot's side behind the plane, {beyond}");
        }
    }
}

#[test]
fn a_plate_is_as_large_as_what_slides_along_it() {
    for (name, run) in RUNS.iter() {
        for k in 0..40 {
            let time = 0.25 * f64::from(k);
            let scene = at(run, time, &[]);
            let rings = scene.markers.iter().filter(|marker| marker.shape == Shape::Ring);
            for ring in rings {
                let inside = scene.blocks.iter().any(|block| match block.solid {
                    crate::scene::Solid::Box { half } => {
                        let at = block.pose.rotation.inverse() * (ring.position - block.pose.position);
                        at.abs().cmple(half + Vec3::splat(1e-4)).all()
                    }
                    crate::scene::Solid::Cylinder { .. } => false,
                });
                assert!(inside, "{name} at {time}");
            }
        }
    }
}

#[test]
fn a_log_shows_the_model_and_nothing_that_nobody_knows() {
    let mut recorded = run("two-contacts").clone();
    recorded.recording.truth = None;
    let scene = at(&recorded, 8.0, &[]);
    assert_eq!((ghosts(&scene), lines(&scene, Palette::LIGHT.force)), (0, 0));
    let tip = *scene.tubes[8].path.last().expect("a path");
    let free = free_ends(run("two-contacts"), 8.0)[2];
    assert!(tip.distance(free.position) < 0.003, "the end of the third primary backbone");
}

#[test]
fn a_clamp_has_jaws_and_no_arrow() {
    let text = preset::find_chain("oblique").expect("preset").toml;
    let text = text.lines().filter(|line| !line.starts_with("tilt")).chain(["kind = \"clamp\""]);
    let text = text.collect::<Vec<_>>().join("\n");
    let run = of(&ChainScenario::from_bytes(text.as_bytes(), &[]).expect("a clamp"));
    let scene = at(&run, 8.0, &[]);
    let jaws = scene.blocks.iter().filter(|block| matches!(block.solid, crate::scene::Solid::Box { .. })).count();
    assert_eq!((jaws, lines(&scene, Palette::LIGHT.force)), (2, 0));
    assert!(ghosts(&scene) > 0 && !says(&scene, " N"));
}

#[test]
fn the_chosen_segment_is_ringed_and_alone_has_its_deviation_in_words() {
    let run = run("two-contacts");
    for chosen in 0..3 {
        let scene = view(run, 6.0, &ChainOptions { palette: Palette::DARK, pulse: 0.0, chosen, placed: &[] });
        assert_eq!(lines(&scene, Palette::DARK.choice), 2);
        assert_eq!(scene.labels.iter().filter(|label| label.text.ends_with(" mm")).count(), 1);
    }
    assert_eq!(lines(&at(self::run("oblique"), 6.0, &[]), Palette::LIGHT.choice), 0, "one segment needs no choice");
}

#[test]
fn with_a_tracker_on_the_tip_alone_only_its_axes_are_there() {
    let run = run("tip-only");
    let [rest, bending, touched] = [1.0, 5.0, 7.5].map(|time| at(run, time, &[]));
    let shapes = |scene: &Scene| {
        [Shape::Triangle, Shape::Dot].map(|shape| scene.markers.iter().filter(|marker| marker.shape == shape).count())
    };
    assert_eq!([&rest, &bending, &touched].map(shapes), [[0, 0], [1, 1], [1, 1]], "what rests has none");
    let words = |scene: &Scene| scene.labels.iter().find(|label| label.text.ends_with(" mm")).map(|label| label.color);
    assert_eq!(
        [&rest, &touched].map(words),
        [None, Some(Palette::LIGHT.detection)],
        "the deviation is over its threshold"
    );
}

#[test]
fn steels_differ_by_more_than_their_colour() {
    let scene = at(run("three-segments"), 0.0, &[]);
    let secondary: Vec<_> = [1, 5, 9].map(|place| &scene.tubes[place]).into();
    assert!(secondary.windows(2).all(|pair| pair[0].radius > 1.2 * pair[1].radius), "thinner toward the tip");
    for shade in [Shade::Dark, Shade::Light, Shade::Projector] {
        let steels = Palette::of(shade).steels;
        assert!(steels[0].contrast(steels[1]) > 1.4 && steels[0].contrast(steels[2]) > 1.4, "{shade:?}");
    }
    // Those of the third segment run through both below.
    let tip = scene.tubes[9].path.last().expect("a path");
    assert!(scene.tubes[9].path[0].z == 0.0 && tip.z > 0.09);
}

#[test]
fn the_robot_stays_in_the_picture_over_every_presets_motion() {
    for (name, run) in RUNS.iter() {
        let camera = home_camera(run);
        for size in [Vec2::new(730.0, 500.0), Vec2::new(375.0, 320.0), Vec2::new(300.0, 600.0)] {
            let (mut high, mut left, mut right) = (f32::MAX, f32::MAX, 0.0_f32);
            for k in 0..=40 {
                let scene = at(run, 0.25 * f64::from(k), &[]);
                let solid = scene.tubes.iter().filter(|tube| tube.finish != Finish::Ghost);
                for &point in solid.flat_map(|tube| &tube.path) {
                    let at = camera.project(point, size).expect("in front").truncate() / size;
                    assert!(at.cmpge(Vec2::ZERO).all() && at.cmple(Vec2::ONE).all(), "{name}: {at}");
                    (high, left, right) = (high.min(at.y), left.min(at.x), right.max(at.x));
                }
            }
            let fills = high < 0.1 || right - left > 0.6;
            assert!(size.x < size.y || fills, "{name}: it fills height or width, {high} {left} {right}");
        }
    }
}

#[test]
fn the_camera_keeps_still_while_contacts_move() {
    let run = run("two-contacts");
    let moved = ["contact[1].disk=1".into(), "contact[2].time=7.5".into()];
    let moved = of(&preset::find_chain("two-contacts").expect("preset").chain(&moved).expect("valid"));
    let free = of(&run.plan.scenario().without_contacts());
    assert_eq!(home_camera(run), home_camera(&moved));
    assert_eq!(home_camera(run), home_camera(&free));
}

#[test]
fn everything_is_finite_in_every_preset() {
    for (name, run) in RUNS.iter() {
        let found = if *name == "tip-only" { Vec::new() } else { found(run) };
        let placed: Vec<&ChainEstimate> = found.iter().filter_map(|found| found.estimates.first()).collect();
        for k in -1..=22 {
            let time = 0.5 * f64::from(k);
            let scene = at(run, time, &placed);
            let paths = scene.tubes.iter().map(|tube| &tube.path).chain(scene.lines.iter().map(|line| &line.path));
            let points = paths.flatten().copied().chain(scene.markers.iter().map(|marker| marker.position));
            let poses = scene.disks.iter().map(|disk| disk.pose).chain(scene.blocks.iter().map(|block| block.pose));
            let points =
                points.chain(scene.labels.iter().map(|label| label.anchor)).chain(poses.clone().map(|p| p.position));
            assert!(points.into_iter().all(|point| point.is_finite()), "{name} at {time}");
            assert!(poses.into_iter().all(|pose| pose.rotation.is_normalized()), "{name} at {time}");
        }
    }
}
