//! What the bending plane shows, as numbers: everything projected into the plane, in mm.

use crate::app::charts::plane::flat::{Flat, MM, Mark, Projection, shifted};
use crate::show::Proportions;
use crate::show::obstacle::{self, Obstacle, Piece, Push};
use crate::show::track::{self, Locus, Spot, Trace};
use centrode_core::model::contact::Planar;
use centrode_core::plant::Shape;
use centrode_core::run::{Run, Sample};

/// Points of a drawn backbone.
const POINTS: usize = 40;

/// The three loci over the run; a centrode that is not defined has no mark.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Loci {
    /// c_m: the model without constraint.
    pub model: Vec<Mark>,
    /// c_c: the model held at the true contact, while it holds.
    pub constrained: Vec<Mark>,
    /// c_s: from the sensor.
    pub sensor: Vec<Mark>,
}

/// A backbone with its disks.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    /// Points of the primary backbone from base to tip, mm.
    pub backbone: Vec<Flat>,
    /// The same, on both sides at the pitch radius, mm.
    pub sides: [Vec<Flat>; 2],
    /// Ends of each disk, base and end disk included, mm.
    pub disks: Vec<[Flat; 2]>,
}

/// One piece of the beam.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// A circle: centre and radius, mm.
    Round(Flat, f64),
    /// A rectangle: its corners in order, mm.
    Bar([Flat; 4]),
}

impl Outline {
    /// Corners of a rectangle around it, or its own, mm.
    pub(super) fn corners(&self) -> [Flat; 4] {
        match *self {
            Self::Bar(corners) => corners,
            Self::Round([x, z], r) => [[x - r, z - r], [x + r, z - r], [x + r, z + r], [x - r, z + r]],
        }
    }
}

/// The force of a beam that only touches.
#[derive(Debug, Clone, PartialEq)]
pub struct Force {
    /// Its arrow, from its tail to where it acts on the robot, mm.
    pub arrow: [Flat; 2],
    /// Its size in words.
    pub words: String,
}

/// Length of the largest force's arrow, as part of the segment's.
const LARGEST: f64 = 0.4;

/// A point of the bending plane (m), mm.
fn flat(at: Planar) -> Flat {
    [at.x * MM, at.y * MM]
}

/// Everything that is drawn from one run.
#[derive(Debug, Clone)]
pub struct Track<'a> {
    run: &'a Run,
    trace: &'a Trace,
    sizes: Proportions,
    projection: Projection,
    obstacle: Option<Obstacle>,
}

impl<'a> Track<'a> {
    /// The track of a run with its loci.
    #[must_use]
    pub fn new(run: &'a Run, trace: &'a Trace) -> Self {
        let projection = Projection::of(run.commanded(0));
        let sizes = Proportions::of(run);
        Self { run, trace, obstacle: Obstacle::of(run, &sizes), sizes, projection }
    }

    /// The true shape at a time.
    #[must_use]
    pub fn truth(&self, time: f64) -> Shape {
        self.run.shape(self.run.place(time))
    }

    /// The shape without constraint, while contact holds at a time.
    #[must_use]
    pub fn ghost(&self, time: f64) -> Option<Vec<Flat>> {
        let place = self.run.place(time);
        self.run.truth(place)?.held?;
        let configuration = self.run.recording.entries[place].configuration;
        Some(self.backbone(&Shape::Free(self.run.plan.segment().arc(configuration))))
    }

    /// The shape by the paper's model, while a beam that only touches holds at a time.
    #[must_use]
    pub fn frozen(&self, time: f64) -> Option<Vec<Flat>> {
        obstacle::frozen(self.run, self.run.place(time)).map(|shape| self.backbone(&shape))
    }

    /// A point of a shape, mm.
    #[must_use]
    pub fn place(&self, shape: &Shape, s: f64) -> Flat {
        self.projection.point(&shape.pose(s).position)
    }

    fn backbone(&self, shape: &Shape) -> Vec<Flat> {
        let length = match shape {
            // The model's, whose length may be another.
            Shape::Free(arc) => arc.length,
            Shape::Held(_) | Shape::Touched(_) => self.run.segment().length,
        };
        (0..=POINTS).map(|k| self.place(shape, length * k as f64 / POINTS as f64)).collect()
    }

    /// The robot in a shape.
    #[must_use]
    pub fn robot(&self, shape: &Shape) -> Robot {
        let segment = self.run.segment();
        let (length, radius) = (segment.length, segment.pitch_radius * MM);
        let side = |sign: f64| {
            (0..=POINTS)
                .map(|k| {
                    let pose = shape.pose(length * k as f64 / POINTS as f64);
                    shifted(self.projection.point(&pose.position), self.projection.across(&pose), sign * radius)
                })
                .collect()
        };
        Robot { backbone: self.backbone(shape), sides: [side(-1.0), side(1.0)], disks: self.disks(shape) }
    }

    /// Ends of the base, the spacer disks and the end disk, mm.
    fn disks(&self, shape: &Shape) -> Vec<[Flat; 2]> {
        let length = self.run.segment().length;
        let spacers = self.run.plan.scenario().robot.disks.iter().map(|&disk| disk.min(length));
        let of = |s: f64| {
            let pose = shape.pose(s);
            let (at, across) = (self.projection.point(&pose.position), self.projection.across(&pose));
            [-1.0, 1.0].map(|side| shifted(at, across, side * f64::from(self.sizes.disk) * MM))
        };
        std::iter::once(0.0).chain(spacers).chain([length]).map(of).collect()
    }

    /// The beam, piece by piece, when there is one: on the side that the segment bends to.
    #[must_use]
    pub fn beam(&self) -> Vec<Outline> {
        let Some(obstacle) = &self.obstacle else { return Vec::new() };
        let outline = |piece| match piece {
            Piece::Round { center, radius } => Outline::Round(flat(center), radius * MM),
            Piece::Bar { center, half } => Outline::Bar(obstacle.corners(center, half).map(flat)),
        };
        obstacle.pieces().map(outline).collect()
    }

    /// Whether the segment has got away from the beam at a time.
    #[must_use]
    pub fn let_go(&self, time: f64) -> bool {
        obstacle::let_go(self.run, self.run.place(time))
    }

    /// The force of the beam in a shape, while it touches it.
    #[must_use]
    pub fn force(&self, shape: &Shape) -> Option<Force> {
        let push = Push::of(self.run, &self.sizes, shape)?;
        let tail = push.at - push.along * (LARGEST * self.run.plan.segment().length * push.share);
        Some(Force { arrow: [flat(tail), flat(push.at)], words: push.words() })
    }

    /// c_m in a sample, mm.
    #[must_use]
    pub fn model(&self, sample: &Sample) -> Option<Flat> {
        track::model(self.run, sample).as_ref().map(|at| self.projection.point(at))
    }

    /// c_c at a time, while contact holds, mm.
    #[must_use]
    pub fn constrained(&self, time: f64) -> Option<Flat> {
        track::constrained(self.run, self.run.truth(self.run.place(time))).as_ref().map(|at| self.projection.point(at))
    }

    /// c_s in a sample where it is judged, mm.
    #[must_use]
    pub fn sensed(&self, sample: &Sample) -> Option<Flat> {
        track::sensed(self.run, sample).as_ref().map(|at| self.projection.point(at))
    }

    /// The loci, the sensor's up to a time (s).
    #[must_use]
    pub fn loci(&self, until: f64) -> Loci {
        let mark = |spot: Spot| Mark { time: spot.time, at: self.projection.point(&spot.at) };
        let flat = |locus: &Locus| locus.marks.iter().copied().map(mark).collect();
        let Trace { model, constrained, .. } = self.trace;
        Loci { model: flat(model), constrained: flat(constrained), sensor: self.trace.dots(until).map(mark).collect() }
    }

    /// Least and greatest coordinates of what the whole run draws, mm, sensor apart: it may lie anywhere.
    #[must_use]
    pub fn bounds(&self, loci: &Loci) -> [Flat; 2] {
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let mut include = |at: Flat| {
            for i in 0..2 {
                if at[i].is_finite() {
                    bounds[0][i] = bounds[0][i].min(at[i]);
                    bounds[1][i] = bounds[1][i].max(at[i]);
                }
            }
        };
        loci.model.iter().chain(&loci.constrained).for_each(|mark| include(mark.at));
        for place in std::iter::once(0).chain(track::even(self.run, 12)) {
            self.disks(&self.run.shape(place)).iter().flatten().for_each(|&at| include(at));
            let time = self.run.recording.entries[place].time;
            self.ghost(time).into_iter().flatten().for_each(&mut include);
        }
        self.beam().iter().flat_map(Outline::corners).for_each(include);
        bounds
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::{Scenario, preset};

    fn run(name: &str) -> Run {
        simulate(&preset::find(name).and_then(preset::Preset::scenario).expect("preset")).expect("run")
    }

    #[test]
    fn the_plane_turns_with_the_bending_direction() {
        let flat = |delta: f64| {
            let mut scenario = Scenario::default();
            scenario.motion.delta = delta;
            let run = simulate(&scenario).expect("run");
            let trace = Trace::new(&run);
            let track = Track::new(&run, &trace);
            (track.bounds(&track.loci(99.0)), track.beam())
        };
        let (straight, turned) = (flat(0.0), flat(2.1));
        assert!(!straight.1.is_empty() && straight.1 == turned.1);
        for i in 0..2 {
            for j in 0..2 {
                assert!((straight.0[i][j] - turned.0[i][j]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn the_held_shape_passes_where_the_beam_stands() {
        let run = run("paper");
        let trace = Trace::new(&run);
        let track = Track::new(&run, &trace);
        let touches = flat(track.obstacle.as_ref().expect("beam").touches);
        let Outline::Round(center, radius) = track.beam()[0] else { panic!("a round bar first") };
        let away = (center[0] - touches[0]).hypot(center[1] - touches[1]);
        assert!(away > f64::from(track.sizes.disk) * MM + radius && center[0] > touches[0], "beside the disk");
        for time in [5.9, 7.0, 9.5] {
            let at = track.place(&track.truth(time), 0.015);
            assert!((at[0] - touches[0]).hypot(at[1] - touches[1]) < 1e-9);
            assert_eq!((track.frozen(time), track.force(&track.truth(time))), (None, None), "a clamp is what it is");
        }
    }

    #[test]
    fn a_robot_that_does_not_move_is_still_drawn() {
        let mut scenario = Scenario::default();
        scenario.motion.theta_end = scenario.motion.theta_start;
        let run = simulate(&scenario).expect("run");
        let trace = Trace::new(&run);
        let track = Track::new(&run, &trace);
        let bounds = track.bounds(&track.loci(99.0));
        assert!(bounds.iter().flatten().all(|x| x.is_finite()));
    }
}
