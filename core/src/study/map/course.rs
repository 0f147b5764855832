//! The centrode that the filtered tracker shows over a motion, for many contacts at once.
//!
//! δ is constant, so the end disk moves in the bending plane: x along the direction of bending, z, and the bend. A moving
//! average over a window W with a backward difference behind it gives the mean over the window and, as velocity, what
//! went in less what went out over W. In place of every sample of the loop, the mean comes from the integral of the tip's
//! path on a coarse grid, and the two ends of the window from the path itself.

use crate::model::configuration::bend_from_theta_l;
use crate::model::special::Angle;
use crate::model::{Configuration, Rate};
use crate::scenario::Plan;
use crate::scenario::motion::command;
use crate::scenario::plan::PlannedContact;
use libm::{ceil, floor, sqrt};

/// Instants at which the centrode is compared, at most.
const JUDGED: usize = 64;
/// Steps of the grid over the motion, and over everything that the filter sees of it, at most.
const STEPS: (f64, f64) = (64.0, 400.0);
/// Halvings that find when the speed passes its floor.
const HALVINGS: usize = 40;
/// Slower than this part of the mean speed, a centrode is the rounding of its numbers.
const STILL: f64 = 1e-6;

/// A point of the bending plane, m.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    x: f64,
    z: f64,
}

impl Point {
    const ORIGIN: Self = Self { x: 0.0, z: 0.0 };

    fn plus(self, other: Self, scale: f64) -> Self {
        Self { x: self.x + scale * other.x, z: self.z + scale * other.z }
    }
}

/// End of an arc of `length` (m) and `bend` (rad), from its start.
fn arc_end(length: f64, bend: f64) -> Point {
    let angle = Angle::new(bend);
    Point { x: length * bend * angle.versinc(), z: length * angle.sinc() }
}

/// An instant at which the centrode is compared.
#[derive(Debug, Clone, Copy)]
struct Instant {
    /// Commanded bend, rad.
    bend: f64,
    /// What enters the filter's window, and what leaves it.
    last: Seen,
    first: Seen,
    /// Length of the window, s: shorter than W until the filter is full.
    window: f64,
    /// Whether the filter is full.
    full: bool,
    /// Angular velocity of the filtered reading, rad/s: the same with and without contact.
    speed: f64,
    /// The model's centrode.
    model: Point,
}

/// The tip as the tracker saw it at one time.
#[derive(Debug, Clone, Copy)]
struct Seen {
    /// Bend then, rad.
    bend: f64,
    /// Place on the grid, in steps.
    step: f64,
}

/// The motion of one scenario, as the filter sees it.
#[derive(Debug, Clone)]
pub struct Course {
    length: f64,
    /// Bends at the grid's times, rad.
    bends: Vec<f64>,
    /// Tip of the free segment there, and the integral of its path up to there (m·s).
    free: Vec<Point>,
    step: f64,
    instants: Vec<Instant>,
}

impl Course {
    /// Of a plan's motion, filter, tracker and arming.
    pub fn new(plan: &Plan) -> Self {
        let scenario = plan.scenario();
        let (motion, length) = (&scenario.motion, scenario.robot.length);
        let window = scenario.filter.length as f64 / scenario.loop_rate;
        // A held reading is on average half a refresh old, less half a sample of the loop.
        let held = (0.5 / scenario.tracker.rate - 0.5 / scenario.loop_rate).max(0.0);
        let lag = scenario.tracker.latency + held;
        let start = (motion.start - window).max(0.0);
        let end = motion.end.min(motion.finish + window + lag).max(start);
        let step = ((motion.finish - motion.start) / STEPS.0).max((end - start) / STEPS.1);
        let count = ceil((end - start) / step) as usize + 1;
        let seen_bend = |time: f64| bend_from_theta_l(command(motion, (time - lag).max(0.0)).0);
        let bends: Vec<f64> = (0..=count).map(|k| seen_bend(start + k as f64 * step)).collect();
        let free = bends.iter().map(|&bend| arc_end(length, bend)).collect();

        let seen = |time: f64| Seen { bend: seen_bend(time), step: ((time - start) / step).max(0.0) };
        let speed = |time: f64| {
            if time >= window {
                (seen_bend(time) - seen_bend(time - window)) / window
            } else {
                // A mean that still grows changes by what comes, less itself, over its length.
                let mean = mean_bend(&bends, start, step, time);
                (seen_bend(time) - mean) / time
            }
        };
        let still = STILL * (bends[count] - bends[0]).abs() / (motion.finish - motion.start);
        let floor = scenario.detection.min_speed.max(still);
        let judged = |time: f64| speed(time).abs() > floor;
        let armed = scenario.detection.armed_from.max(start).max(1.0 / scenario.loop_rate);
        let mut instants = Vec::new();
        let mut before: Option<(f64, bool)> = None;
        let tip_model = |bend: f64| {
            let arc = plan.segment().arc(Configuration::new(bend, 0.0));
            let (pose, jacobian) = arc.pose_and_jacobian(length);
            let centrode = jacobian.centrode(&pose.position, Rate::BENDING);
            centrode.map_or(Point { x: f64::NAN, z: f64::NAN }, |c| Point { x: c.x, z: c.z })
        };
        let mut push = |time: f64| {
            let bend = bend_from_theta_l(command(motion, time).0);
            let full = time >= window;
            instants.push(Instant {
                bend,
                last: seen(time),
                first: seen(if full { time - window } else { 0.0 }),
                window: window.min(time),
                full,
                speed: speed(time),
                model: tip_model(bend),
            });
        };
        if armed <= end {
            for k in 0..=JUDGED {
                let time = armed + (end - armed) * (k as f64 / JUDGED as f64);
                let now = judged(time);
                // Deviations grow as the motion ends: the instant at which the speed passes its floor counts.
                if let Some((earlier, was)) = before
                    && was != now
                {
                    let (mut inside, mut outside) = if was { (earlier, time) } else { (time, earlier) };
                    for _ in 0..HALVINGS {
                        let middle = f64::midpoint(inside, outside);
                        if judged(middle) { inside = middle } else { outside = middle }
                    }
                    push(inside);
                }
                if now {
                    push(time);
                }
                before = Some((time, now));
            }
        }
        Self { length, bends, free, step, instants }
    }

    /// The largest ‖c_m − c_s‖ judged from the first instant in contact on, m; NaN where none is judged.
    pub fn largest_deviation(&self, contact: &PlannedContact) -> f64 {
        let share = contact.arc_length / self.length;
        let lower_bend = contact.bend * share;
        let lower = arc_end(contact.arc_length, lower_bend);
        let turn = Angle::new(lower_bend);
        let upper_length = self.length - contact.arc_length;
        let tip = |bend: f64| {
            if !contact.holds_at(bend) {
                return arc_end(self.length, bend);
            }
            if let Some(branch) = contact.branch() {
                let at = branch.tip(bend).position * self.length;
                return Point { x: at.x, z: at.y };
            }
            let upper = arc_end(upper_length, bend - lower_bend);
            Point {
                x: lower.x + turn.cosine() * upper.x + turn.sine() * upper.z,
                z: lower.z - turn.sine() * upper.x + turn.cosine() * upper.z,
            }
        };
        // Integrals of the path up to each step of the grid (trapezia).
        let mut integrals = [Point::ORIGIN; STEPS.1 as usize + 3];
        let mut path = [Point::ORIGIN; STEPS.1 as usize + 3];
        for (k, (&bend, free)) in self.bends.iter().zip(&self.free).enumerate() {
            path[k] = match k {
                _ if !contact.holds_at(bend) => *free,
                // While the robot rests, the tip is where it was.
                1.. if bend == self.bends[k - 1] => path[k - 1],
                _ => tip(bend),
            };
            if k > 0 {
                let both = path[k - 1].plus(path[k], 1.0);
                integrals[k] = integrals[k - 1].plus(both, 0.5 * self.step);
            }
        }
        let last_step = self.bends.len() - 1;
        let integral = |seen: &Seen, at: Point| {
            let k = (floor(seen.step) as usize).min(last_step);
            let rest = (seen.step - k as f64) * self.step;
            integrals[k].plus(path[k].plus(at, 1.0), 0.5 * rest)
        };
        let mut largest = f64::NAN;
        let mut touched = false;
        for instant in &self.instants {
            touched |= contact.holds_at(instant.bend);
            if !touched {
                continue;
            }
            let (last, first) = (tip(instant.last.bend), tip(instant.first.bend));
            let mean = integral(&instant.last, last).plus(integral(&instant.first, first), -1.0);
            let mean = Point { x: mean.x / instant.window, z: mean.z / instant.window };
            let from = if instant.full { first } else { mean };
            let velocity = last.plus(from, -1.0);
            let per_turn = 1.0 / (instant.speed * instant.window);
            // c = p + ω × ṗ/ω², in the plane.
            let centrode = Point { x: mean.x + velocity.z * per_turn, z: mean.z - velocity.x * per_turn };
            let (dx, dz) = (centrode.x - instant.model.x, centrode.z - instant.model.z);
            let deviation = sqrt(dx * dx + dz * dz);
            largest = largest.max(deviation);
        }
        largest
    }
}

/// Mean bend from time 0 to `time`, while the filter is not full.
fn mean_bend(bends: &[f64], start: f64, step: f64, time: f64) -> f64 {
    let place = ((time - start) / step).max(0.0);
    let k = (floor(place) as usize).min(bends.len() - 2);
    let mut integral = bends[0] * start;
    integral += bends[..=k].windows(2).map(|pair| 0.5 * (pair[0] + pair[1]) * step).sum::<f64>();
    let at = bends[k] + (bends[k + 1] - bends[k]) * (place - k as f64);
    integral += 0.5 * (bends[k] + at) * (place - k as f64) * step;
    integral / time
}
