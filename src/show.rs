//! A run at one instant, as a scene.

pub mod band;
mod beam;
pub mod chain;
pub mod ink;
mod load;
mod loci;
pub mod obstacle;
pub mod paper;
mod pen;
mod robot;
pub mod track;

use crate::scene::palette::Palette;
use crate::scene::{Camera, Ground, Pose, Scene};
use beam::Beam;
use centrode_core::detect::calibration::marginal::Estimate;
use centrode_core::model::{self, Arc, Configuration};
use centrode_core::run::Run;
use glam::{DMat3, DQuat, DVec3, Quat, Vec2, Vec3};
use loci::Signs;
use obstacle::{Obstacle, Push};
use pen::Pen;
pub use robot::Proportions;
use std::f32::consts::PI;
use track::Trace;

/// How a run is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewOptions<'a> {
    /// Colours.
    pub palette: Palette,
    /// How far the ring around a fresh detection has run, 0..1; 0 shows none.
    pub pulse: f32,
    /// Whether a beam that only touches is held against the paper's model of it, which freezes the part below.
    pub frozen: bool,
    /// Where the calibration filter places the contact, as far as that is known.
    pub placed: Option<&'a Estimate>,
}

/// The scene of `run`, whose loci are `trace`, at `time` (s): robot, beam, ghost, screw axes, centrode loci, estimate.
#[must_use]
pub fn view(run: &Run, trace: &Trace, time: f64, options: &ViewOptions<'_>) -> Scene {
    let palette = &options.palette;
    let place = run.place(time);
    let (shape, truth) = (run.shape(place), run.truth(place));
    let configuration = run.commanded(place);
    let held = truth.is_some_and(|truth| truth.held.is_some());
    let (sizes, length) = (Proportions::of(run), run.segment().length);
    let delta = configuration.delta() as f32;
    let mut scene = Scene { ground: Some(floor(run, palette, &sizes)), ..Scene::default() };
    let pose = |s: f32| scene_pose(&shape.pose(f64::from(s)));
    robot::robot(&mut scene, palette, &sizes, pose);
    let push = Push::of(run, &sizes, &shape);
    if let (Some(obstacle), Some(contact)) = (Obstacle::of(run, &sizes), run.plan.contact()) {
        let section = Pose::new(Vec3::ZERO, Quat::from_rotation_z(-delta));
        let (away, faint) = (obstacle.side as f32, obstacle::let_go(run, place));
        let reach = [-1.0, 1.0].map(|end| end * beam::FITTING * sizes.disk);
        let beam = Beam { obstacle: &obstacle, sizes: &sizes, section, away, reach, faint };
        let surface = f64::from(sizes.surface(contact.arc_length));
        beam.draw(&mut scene, palette, held.then(|| beam.touching(push.as_ref(), surface)));
        if let Some(push) = &push {
            beam.force(&mut scene, palette, push, length as f32);
        }
    }
    if held {
        // Of the model, whose length may be another.
        let free = run.plan.segment().arc(configuration);
        let share = free.length / length;
        robot::ghost(&mut scene, palette.model, &sizes, 0.0, |s| scene_pose(&free.pose(share * f64::from(s))));
    }
    if let Some(frozen) = obstacle::frozen(run, place).filter(|_| options.frozen) {
        robot::ghost(&mut scene, palette.constrained, &sizes, 0.0, |s| scene_pose(&frozen.pose(f64::from(s))));
    }
    let pen = Pen { palette, lift: 1.5 * sizes.disk, length: run.plan.segment().length as f32 };
    let signs = Signs { run, trace, truth, time, pen };
    signs.loci(&mut scene);
    signs.axes(&mut scene);
    if let Some(truth) = truth {
        load::load(&mut scene, palette, run, &truth.wrench, &pose(length as f32));
    }
    // Labels stand off the side from which the segment bends away.
    let aside = Quat::from_rotation_z(-delta) * Vec3::X * (-1.9 * sizes.disk).copysign(-configuration.bend() as f32);
    if let Some(placed) = options.placed {
        signs.band(&mut scene, placed, |s| pose(s as f32), aside);
    }
    if let Some(detection) = run.detection().filter(|detection| detection.time <= time) {
        let at = pose(detection.location as f32);
        signs.estimate(&mut scene, options.pulse, [at.position, at.point(aside)], detection.location);
    }
    scene
}

/// The view in which a run opens: its bending plane a little from the side and from above, and the robot as large as
/// its whole motion allows. It does not depend on the beam, so that it keeps still while that is moved.
#[must_use]
pub fn home_camera(run: &Run) -> Camera {
    let motion = &run.plan.scenario().motion;
    let sizes = Proportions::of(run);
    let length = run.plan.segment().length;
    let commanded = |time| run.recording.entries[run.place(time)].configuration;
    let [start, end] =
        if run.is_recorded() { spanned(run) } else { [commanded(motion.start), commanded(motion.finish)] };
    let bends = (0..=6).map(|i| start.bend() + (end.bend() - start.bend()) * f64::from(i) / 6.0);
    let tips = bends.map(|bend| scene_pose(&Arc { length, configuration: start.with_bend(bend) }.pose(length)));
    let points: Vec<Vec3> = tips.flat_map(|tip| sizes.outline(&tip).collect::<Vec<_>>()).collect();
    // A segment that bends the other way is seen from the other side: it bends to the right in the picture.
    let back = if start.bend() + end.bend() < 0.0 { PI } else { 0.0 };
    Camera::framing(&points, YAW - start.delta() as f32 + back, PITCH, ASPECT, ROOM)
}

/// Of a log: the configurations between which it bends, the straighter one first.
fn spanned(run: &Run) -> [Configuration; 2] {
    let places = track::looked(run.len(), 256).map(|place| run.commanded(place));
    let [first, mut least, mut most] = [run.commanded(0); 3];
    for configuration in places {
        if configuration.bend() < least.bend() {
            least = configuration;
        }
        if configuration.bend() > most.bend() {
            most = configuration;
        }
    }
    let [a, b] = [least, most].map(|configuration| first.with_bend(configuration.bend()));
    if a.bend().abs() > b.bend().abs() { [b, a] } else { [a, b] }
}

/// Direction of the home view. Straight at the bending plane the screw axes would be points.
const YAW: f32 = -1.16;
const PITCH: f32 = 0.28;
/// Width over height of the smallest view that is planned for.
const ASPECT: f32 = 1.17;
/// Where the robot stands in the picture: below it is room for the legend, at its left for labels.
const ROOM: [Vec2; 2] = [Vec2::new(-0.76, -0.73), Vec2::new(0.90, 0.93)];
/// The length for which the floor was chosen by eye, m; others are scaled to it.
const DESIGN_LENGTH: f32 = 0.030;

fn floor(run: &Run, palette: &Palette, sizes: &Proportions) -> Ground {
    ground(palette, sizes, run.plan.segment().length as f32 / DESIGN_LENGTH)
}

/// The floor under a robot so many times as large as that for which it was chosen.
fn ground(palette: &Palette, sizes: &Proportions, scale: f32) -> Ground {
    Ground {
        center: Vec3::new(0.004 * scale, 0.0, sizes.floor),
        radius: 0.062 * scale,
        spacing: 0.005 * scale,
        major: 2,
        line: palette.grid,
        glow: palette.glow,
        shadow: palette.ground_shadow,
        contacts: vec![[0.0, 0.0, 1.85 * sizes.disk, 0.45]],
    }
}

fn scene_vector(v: &model::Vec3) -> Vec3 {
    DVec3::from_slice(v.as_slice()).as_vec3()
}

fn scene_pose(pose: &model::Pose) -> Pose {
    let rotation = DMat3::from_cols_slice(pose.rotation.as_slice());
    Pose::new(scene_vector(&pose.position), DQuat::from_mat3(&rotation).as_quat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Finish, Shape};
    use centrode_core::run::simulate;
    use centrode_core::scenario::{Place, Scenario};

    fn at(scenario: &Scenario, time: f64) -> Scene {
        let run = simulate(scenario).expect("valid");
        view(
            &run,
            &Trace::new(&run),
            time,
            &ViewOptions { palette: Palette::LIGHT, pulse: 0.0, frozen: false, placed: None },
        )
    }

    fn count(scene: &Scene, shape: Shape) -> usize {
        scene.markers.iter().filter(|marker| marker.shape == shape).count()
    }

    fn ghosts(scene: &Scene) -> usize {
        scene.tubes.iter().filter(|tube| tube.finish == Finish::Ghost).count()
    }

    #[test]
    fn the_story_is_told_in_order() {
        let scenario = Scenario::default();
        let (rest, bending, held, found) =
            (at(&scenario, 1.0), at(&scenario, 5.5), at(&scenario, 6.1), at(&scenario, 7.0));
        assert_eq!((ghosts(&rest), ghosts(&bending)), (0, 0));
        assert!(ghosts(&held) > 0, "the ghost appears with the contact");
        assert_eq!(
            (count(&held, Shape::Diamond), count(&found, Shape::Diamond)),
            (0, 1),
            "the estimate with the alarm"
        );
        assert!(count(&rest, Shape::Triangle) > 5, "the model's locus is known beforehand");
        assert!(count(&found, Shape::Dot) > count(&bending, Shape::Dot), "the sensor's locus grows");
        assert_eq!(rest.blocks.len(), found.blocks.len(), "the beam stands there from the start");
    }

    #[test]
    fn without_contact_there_is_no_beam_and_no_constrained_locus() {
        let mut scenario = Scenario::default();
        scenario.contact.place = Place::Nowhere;
        let free = at(&scenario, 7.0);
        assert_eq!((ghosts(&free), count(&free, Shape::Ring)), (0, 0));
        assert!(free.blocks.len() < at(&Scenario::default(), 7.0).blocks.len());
    }

    #[test]
    fn a_load_is_an_arrow_that_grows_at_the_tip() {
        let scenario =
            centrode_core::scenario::preset::find("load-at-rest").and_then(|p| p.scenario()).expect("preset");
        let lines = |time| at(&scenario, time).lines.into_iter().filter(|l| l.color == Palette::LIGHT.force).collect();
        let (before, half, whole): (Vec<_>, Vec<_>, Vec<_>) = (lines(7.0), lines(8.25), lines(9.5));
        assert!(before.is_empty());
        let length = |lines: &[crate::scene::Line]| lines[0].path[0].distance(lines[0].path[1]);
        assert!((length(&whole) / length(&half) - 2.0).abs() < 0.01, "{} {}", length(&half), length(&whole));
        let tip = at(&scenario, 9.5).tubes[0].path[48];
        assert!(whole[0].path[1].distance(tip) < 0.001, "it ends where it acts");
        assert!(at(&scenario, 9.5).labels.iter().any(|label| label.text == "1.00 N"));
    }

    #[test]
    fn the_sensors_dots_are_judged_ones_near_the_model() {
        for name in ["bench", "free", "static-resolution"] {
            let scenario = centrode_core::scenario::preset::find(name).and_then(|p| p.scenario()).expect(name);
            let armed = scenario.detection.armed_from;
            let early = at(&scenario, armed - 0.01);
            assert!(count(&early, Shape::Dot) <= 1, "{name}: the transient leaves no dots");
            let scene = at(&scenario, 8.0);
            let dots: Vec<Vec3> =
                scene.markers.iter().filter(|m| m.shape == Shape::Dot && m.lift == 0.0).map(|m| m.position).collect();
            let near = 2.6 * scenario.robot.length as f32;
            assert!(dots.iter().all(|dot| dot.length() < near) && dots.len() < 400, "{name}: {}", dots.len());
            let crowded = |(i, a): (usize, &Vec3)| dots[..i].iter().any(|b| a.distance(*b) < 0.0003);
            assert!(!dots.iter().enumerate().any(crowded), "{name}");
        }
    }

    #[test]
    fn the_robot_stays_in_the_picture_over_every_presets_motion() {
        for preset in centrode_core::scenario::preset::PRESETS {
            let run = simulate(&preset.scenario().expect(preset.name)).expect("valid");
            let camera = home_camera(&run);
            for size in [Vec2::new(730.0, 500.0), Vec2::new(375.0, 320.0), Vec2::new(300.0, 600.0)] {
                let (mut high, mut left, mut right) = (f32::MAX, f32::MAX, 0.0_f32);
                // Straight in between, the robot is highest.
                let times = [0.0, 5.5, 6.5, 8.0].into_iter().chain((0..20).map(|k| 3.0 + 0.25 * f64::from(k)));
                for time in times {
                    let scene = view(
                        &run,
                        &Trace::new(&run),
                        time,
                        &ViewOptions { palette: Palette::DARK, pulse: 0.0, frozen: false, placed: None },
                    );
                    let solid = scene.tubes.iter().filter(|tube| tube.finish != Finish::Ghost);
                    for &point in solid.flat_map(|tube| &tube.path) {
                        let at = camera.project(point, size).expect("in front").truncate() / size;
                        assert!(at.cmpge(Vec2::ZERO).all() && at.cmple(Vec2::ONE).all(), "{}: {at}", preset.name);
                        (high, left, right) = (high.min(at.y), left.min(at.x), right.max(at.x));
                    }
                }
                let fills = high < 0.1 || right - left > 0.6;
                assert!(size.x < size.y || fills, "{}: it fills height or width, {high} {left} {right}", preset.name);
            }
        }
    }

    #[test]
    fn a_bend_the_other_way_is_seen_from_the_other_side() {
        let mut scenario = Scenario::default();
        scenario.motion.theta_end = 2.0 * scenario.motion.theta_start;
        let run = simulate(&scenario).expect("valid");
        let (camera, size) = (home_camera(&run), Vec2::new(800.0, 600.0));
        let tip = |time| {
            view(
                &run,
                &Trace::new(&run),
                time,
                &ViewOptions { palette: Palette::DARK, pulse: 0.0, frozen: false, placed: None },
            )
            .tubes[0]
                .path[48]
        };
        let across = |time| camera.project(tip(time), size).expect("in front").x;
        assert!(across(8.0) > across(0.0) + 50.0);
    }

    #[test]
    fn everything_is_finite_in_every_preset() {
        for preset in centrode_core::scenario::preset::PRESETS {
            let scenario = preset.scenario().expect(preset.name);
            for time in [0.0, 3.0, 5.0, 6.5, 8.2, 10.0, 99.0] {
                let scene = at(&scenario, time);
                let paths = scene.tubes.iter().map(|tube| &tube.path).chain(scene.lines.iter().map(|line| &line.path));
                assert!(paths.flatten().all(|p| p.is_finite()), "{} at {time}", preset.name);
                assert!(scene.markers.iter().all(|marker| marker.position.is_finite()), "{} at {time}", preset.name);
            }
        }
    }
}
