//! A run of several segments at one instant, as a scene.

mod beams;
mod bent;
mod robot;
mod signs;

use super::{ASPECT, DESIGN_LENGTH, PITCH, Proportions, ROOM, YAW, ground, scene_pose};
use crate::scene::palette::Palette;
use crate::scene::{Camera, Pose, Scene};
use bent::Bent;
use centrode_core::detect::chain::ChainEstimate;
use centrode_core::model::Configuration;
use centrode_core::model::chain::{free, path};
use centrode_core::study::chain::ChainRun;
use glam::Vec3;

/// How a run of several segments is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainOptions<'a> {
    /// Colours.
    pub palette: Palette,
    /// How far the ring around a fresh detection has run, 0..1; 0 shows none.
    pub pulse: f32,
    /// The segment, from 0, that is drawn as chosen.
    pub chosen: usize,
    /// Where contacts are placed, one for each that was found, as far as that is known.
    pub placed: &'a [&'a ChainEstimate],
}

/// One instant of a run.
struct Instant<'a> {
    /// s.
    time: f64,
    /// The sample of that time.
    place: usize,
    palette: &'a Palette,
    /// Of each segment, from the base.
    sizes: Vec<Proportions>,
    /// Angle of each segment's first secondary backbone on the pitch circle, rad.
    offsets: Vec<f32>,
    /// What each segment is told.
    told: Vec<Configuration>,
    /// The true backbone; that of the model for a log.
    bent: Bent,
    /// What presses and how hard, where it is known.
    truth: Option<path::Instant>,
}

impl<'a> Instant<'a> {
    fn new(run: &ChainRun, time: f64, palette: &'a Palette) -> Self {
        let plan = &run.plan;
        let segments = &plan.scenario().segments;
        let lengths = segments.iter().map(|segment| segment.alone.true_robot().segment().length);
        let sizes = segments.iter().zip(lengths);
        let sizes = sizes.map(|(segment, length)| Proportions::of_robot(&segment.alone.scenario().robot, length));
        let place = run.recording.times.partition_point(|at| *at <= time + 1e-9).saturating_sub(1);
        let mut instant = Self {
            time,
            place,
            palette,
            sizes: sizes.collect(),
            offsets: segments.iter().map(|segment| segment.joint_offset as f32).collect(),
            told: told(run, time),
            bent: Bent::free(&[], &[]),
            truth: None,
        };
        if run.recording.truth.is_some() {
            // Where the chain buckles, the picture stops.
            instant.time = time.clamp(0.0, plan.path().end());
            let bends = plan.bends(instant.time);
            instant.told = told(run, instant.time);
            instant.bent = Bent::new(&plan.path().backbone(instant.time, &bends, bent::PARTS));
            instant.truth = Some(plan.path().at(instant.time, &bends));
        } else {
            instant.bent = Bent::free(&nominal_lengths(run), &instant.told);
        }
        instant
    }

    /// The contacts that press.
    fn pressing(&self) -> &[usize] {
        self.truth.as_ref().map_or(&[], |truth| &truth.active)
    }

    /// The backbone of a segment at an arc length, m.
    fn on(&self, segment: usize, at: f64) -> Pose {
        self.bent.pose(segment, at as f32 / self.sizes[segment].length)
    }
}

/// The scene of `run` at `time` (s): robot, what it meets and the forces there, ghost, screw axes of every end disk, estimates.
#[must_use]
pub fn view(run: &ChainRun, time: f64, options: &ChainOptions<'_>) -> Scene {
    let palette = &options.palette;
    let instant = Instant::new(run, time, palette);
    let scale = SPREAD * nominal_lengths(run).iter().sum::<f64>() as f32 / DESIGN_LENGTH;
    let mut scene = Scene { ground: Some(ground(palette, &instant.sizes[0], scale)), ..Scene::default() };
    robot::robot(&mut scene, &instant);
    if !instant.pressing().is_empty() {
        robot::ghost(&mut scene, &instant, &Bent::free(&nominal_lengths(run), &instant.told));
    }
    beams::beams(&mut scene, run, &instant, home_camera(run).backward());
    signs::axes(&mut scene, run, &instant, options.chosen);
    signs::names(&mut scene, &instant, options.chosen);
    signs::placed(&mut scene, run, &instant, options.placed, options.pulse);
    signs::end(&mut scene, run, &instant, time);
    scene
}

/// The floor of a chain is so much smaller than its length asks for: it never lies down.
const SPREAD: f32 = 0.7;
/// Instants of the whole motion at which the camera looks at the robot.
const LOOKS: usize = 24;

/// The view in which a run opens: the robot as large as its whole motion allows, from the side to which it leans and a little from above.
/// It does not depend on contacts, so that it keeps still while they are moved.
#[must_use]
pub fn home_camera(run: &ChainRun) -> Camera {
    let scenario = run.plan.scenario();
    let sizes: Vec<Proportions> = scenario
        .segments
        .iter()
        .map(|segment| Proportions::of_robot(&segment.alone.scenario().robot, segment.alone.segment().length))
        .collect();
    let last = run.recording.times.last().copied().unwrap_or(0.0);
    let end = if run.recording.truth.is_some() { scenario.common().motion.end } else { last };
    let mut points = Vec::new();
    let mut leans = Vec3::ZERO;
    for look in 0..=LOOKS {
        let ends = free_ends(run, end * look as f64 / LOOKS as f64);
        leans += ends.last().map_or(Vec3::ZERO, |tip| tip.position);
        points.extend(sizes.iter().zip(&ends).flat_map(|(sizes, end)| sizes.outline(end).collect::<Vec<_>>()));
    }
    Camera::framing(&points, YAW + heading(leans), PITCH, ASPECT, ROOM)
}

/// The direction of a vector over the floor, from x toward y, rad; 0 for one that points up.
fn heading(along: Vec3) -> f32 {
    if along.truncate().length() > 1e-3 * along.length() { along.y.atan2(along.x) } else { 0.0 }
}

fn nominal_lengths(run: &ChainRun) -> Vec<f64> {
    run.plan.scenario().segments.iter().map(|segment| segment.alone.segment().length).collect()
}

/// What each segment is told at a time (s): as a log has it, or as the plan does, which goes on where a chain has buckled.
fn told(run: &ChainRun, time: f64) -> Vec<Configuration> {
    let recording = &run.recording;
    if recording.truth.is_some() {
        return (0..recording.segments()).map(|segment| run.plan.command(segment, time).0).collect();
    }
    let place = recording.times.partition_point(|at| *at <= time + 1e-9).saturating_sub(1);
    recording.told.iter().filter_map(|told| Some(told.get(place)?.configuration)).collect()
}

/// The end disks of the model that nothing touches, from the base.
fn free_ends(run: &ChainRun, time: f64) -> Vec<Pose> {
    free(&nominal_lengths(run), &told(run, time)).iter().map(|disk| scene_pose(&disk.pose)).collect()
}

#[cfg(test)]
mod tests;
