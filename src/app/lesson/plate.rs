//! A plate that moves in its plane: two of its velocities and the centre that they give away. Exact; y points up.

pub mod view;

use glam::{DVec2, dvec2};

/// Half of the plate's sides.
pub const HALF: DVec2 = dvec2(1.0, 0.55);
/// Where the first step wants the centre, and how near counts.
pub const RING: DVec2 = dvec2(0.25, -0.85);
/// Radius of the ring.
pub const NEAR: f64 = 0.1;
/// Two directions that differ by less than this (the sine of their angle) are parallel.
const PARALLEL: f64 = 1e-6;

/// Both points stay so far apart.
const APART: f64 = 0.2;

/// What is done to the plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Move {
    /// Turn the arrow at a point, 0 or 1, to an angle from the x-axis, rad.
    Turn(usize, f64),
    /// Put a point, 0 or 1, somewhere on the plate.
    Carry(usize, DVec2),
}

/// Two points of the plate and the directions in which they move.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate {
    points: [DVec2; 2],
    /// From the x-axis, rad.
    angles: [f64; 2],
    /// The point whose arrow keeps its direction where both cannot.
    kept: usize,
}

/// How the plate moves at the instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// What it turns about; none where it only shifts.
    pub center: Option<DVec2>,
    /// Its angular velocity; the longer arrow has length 1.
    pub turn: f64,
    /// The velocity that all points have where it only shifts.
    shift: DVec2,
}

impl Motion {
    /// Velocity of a point.
    #[must_use]
    pub fn at(&self, point: DVec2) -> DVec2 {
        self.center.map_or(self.shift, |center| self.turn * (point - center).perp())
    }
}

impl Default for Plate {
    fn default() -> Self {
        // The perpendicular at A runs through the ring.
        let a = dvec2(-0.62, 0.18);
        let along = -(a - RING).perp();
        Self { points: [a, dvec2(0.6, 0.1)], angles: [along.to_angle(), 0.0], kept: 0 }
    }
}

impl Plate {
    /// One of both points.
    #[must_use]
    pub fn point(&self, which: usize) -> DVec2 {
        self.points[which]
    }

    /// Direction of the arrow at one of both points, rad.
    #[must_use]
    pub fn angle(&self, which: usize) -> f64 {
        self.angles[which]
    }

    /// What the plate turns about: where the perpendiculars meet. None where the arrows are parallel.
    #[must_use]
    pub fn center(&self) -> Option<DVec2> {
        let [a, b] = self.points;
        let [n, m] = self.angles.map(|angle| DVec2::from_angle(angle).perp());
        let sine = n.perp_dot(m);
        (sine.abs() > PARALLEL).then(|| a + n * ((b - a).perp_dot(m) / sine))
    }

    /// How it moves.
    #[must_use]
    pub fn motion(&self) -> Motion {
        let direction = DVec2::from_angle(self.angles[self.kept]);
        let center = self.center();
        let turn = center.map_or(0.0, |center| {
            let reach = self.points.map(|point| point.distance(center));
            let sense = (self.points[self.kept] - center).perp().dot(direction);
            1_f64.copysign(sense) / reach[0].max(reach[1])
        });
        Motion { center, turn, shift: direction }
    }

    /// Whether the centre lies in the ring.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.center().is_some_and(|center| center.distance(RING) <= NEAR)
    }

    /// Moves something; what cannot be is brought to the nearest that can.
    pub fn apply(&mut self, moved: Move) {
        match moved {
            Move::Turn(which @ 0..=1, angle) if angle.is_finite() => {
                self.angles[which] = DVec2::from_angle(angle).to_angle();
                self.kept = which;
            }
            Move::Carry(which @ 0..=1, to) if to.is_finite() => {
                let edge = HALF - DVec2::splat(0.08);
                let to = to.clamp(-edge, edge);
                // One point gives one velocity only.
                if to.distance(self.points[1 - which]) >= APART {
                    self.points[which] = to;
                }
            }
            _ => {}
        }
        // A rigid plate turns one way only: the other arrow follows.
        let (other, motion) = (1 - self.kept, self.motion());
        let velocity = motion.at(self.points[other]);
        if velocity.length() > PARALLEL {
            self.angles[other] = velocity.to_angle();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Both points keep their distance: what they move along the line between them is equal.
    fn is_rigid(plate: &Plate) {
        let [a, b] = [0, 1].map(|which| plate.point(which));
        let motion = plate.motion();
        let along = (b - a).normalize();
        assert!((motion.at(a).dot(along) - motion.at(b).dot(along)).abs() < 1e-9, "{plate:?}");
        for which in [0, 1] {
            let velocity = motion.at(plate.point(which));
            let off = velocity.perp_dot(DVec2::from_angle(plate.angle(which)));
            assert!(off.abs() < 1e-9, "the arrow is the velocity: {plate:?}");
            assert!(velocity.dot(DVec2::from_angle(plate.angle(which))) >= -1e-9, "{plate:?}");
        }
    }

    #[test]
    fn whatever_is_dragged_the_plate_stays_rigid_and_turns_about_its_centre() {
        let mut plate = Plate::default();
        for k in 0..200 {
            let x = f64::from(k);
            let moved = match k % 4 {
                0 => Move::Turn(0, 0.7 * x),
                1 => Move::Turn(1, 1.3 * x),
                2 => Move::Carry(0, dvec2((0.3 * x).sin(), (0.7 * x).cos())),
                _ => Move::Carry(1, dvec2((1.1 * x).cos(), (0.2 * x).sin())),
            };
            plate.apply(moved);
            is_rigid(&plate);
            let Some(center) = plate.center() else { continue };
            for which in [0, 1] {
                let arm = plate.point(which) - center;
                let off = arm.dot(DVec2::from_angle(plate.angle(which)));
                assert!(off.abs() < 1e-6 * arm.length().max(1.0), "{k}: {plate:?}");
            }
        }
    }

    #[test]
    fn parallel_arrows_have_no_centre() {
        let mut plate = Plate::default();
        plate.apply(Move::Turn(0, 0.4));
        plate.apply(Move::Turn(1, 0.4));
        assert_eq!(plate.center(), None);
        assert_eq!(plate.motion().at(dvec2(9.0, 9.0)), DVec2::from_angle(0.4));
        is_rigid(&plate);
    }

    #[test]
    fn it_begins_off_the_ring_and_one_arrow_brings_it_there() {
        let mut plate = Plate::default();
        assert!(!plate.is_met());
        is_rigid(&plate);
        let wanted = (plate.point(1) - RING).to_angle() - FRAC_PI_2;
        plate.apply(Move::Turn(1, wanted));
        assert!(plate.is_met() && plate.center().expect("one").distance(RING) < 1e-9);
        // The other way round it is the same motion, backwards.
        plate.apply(Move::Turn(1, wanted + PI));
        assert!(plate.is_met());
        plate.apply(Move::Turn(0, f64::NAN));
        plate.apply(Move::Turn(7, 1.0));
        assert!(plate.is_met(), "nonsense changes nothing");
    }
}
