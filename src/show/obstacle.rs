//! What the segment meets, in its bending plane: the 3D view and the flat one draw the same cross-section.
//!
//! Points are in m, x toward the bend and z along the straight backbone; a slope is the angle of the tangent from z toward x, its normal
//! is `(cos α, −sin α)`, see [`centrode_core::model::contact`].

use super::Proportions;
use centrode_core::model::contact::Planar;
use centrode_core::model::contact::branch::{Surface, Touch};
use centrode_core::model::{Arc, Configuration, Constrained};
use centrode_core::plant::Shape;
use centrode_core::run::Run;
use centrode_core::scenario::plan::PlannedContact;

/// One piece of the obstacle's cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Piece {
    /// A circle.
    Round {
        /// Middle, m.
        center: Planar,
        /// m.
        radius: f64,
    },
    /// A rectangle along the backbone as it was met.
    Bar {
        /// Middle, m.
        center: Planar,
        /// Half sizes across the backbone and along it, m.
        half: [f64; 2],
    },
}

/// The obstacle; it does not move.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// Point of the backbone that meets it, m.
    pub touches: Planar,
    /// Slope there at that moment, rad.
    pub slope: f64,
    /// +1 where it stands on the side of larger bends, −1 on the other.
    pub side: f64,
    /// The bar that a post carries: middle and radius, m.
    pub bar: (Planar, f64),
    /// What is fixed to the bar and does the touching; none where the bar itself does.
    pub fittings: Vec<Piece>,
}

/// Half the width of a plate along the backbone, in radii of a disk: more would reach into a segment that bends over it.
const PLATE: f64 = 0.55;
/// Radius of an arm that bears jaws or a plate, as part of a round beam's usual one.
const ARM: f64 = 0.7;

impl Obstacle {
    /// The beam of a run, when there is one.
    #[must_use]
    pub fn of(run: &Run, sizes: &Proportions) -> Option<Self> {
        let contact = run.plan.contact()?;
        let length = run.segment().length;
        let met = Arc { length, configuration: Configuration::new(0.0, 0.0).with_bend(contact.bend) };
        let position = met.pose(contact.arc_length).position;
        let touches = Planar::new(position.x, position.z);
        let slope = contact.bend * contact.arc_length / length;
        let (surface, rim) = (sizes.surface(contact.arc_length), sizes.rim(contact.arc_length));
        let met = Met { touches, slope, side: contact.side, surface: surface.into(), rim: rim.into() };
        Some(match contact.touch.as_deref().map(Touch::surface) {
            None => met.jaws(sizes),
            Some(Surface::Plane) => met.plate(sizes),
            Some(Surface::Cylinder { rounding }) => {
                let reach = rounding * length;
                met.rod(reach, reach - envelope(contact, sizes, length))
            }
        })
    }

    /// The whole cross-section, what touches last.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> {
        let (center, radius) = self.bar;
        std::iter::once(Piece::Round { center, radius }).chain(self.fittings.iter().copied())
    }

    /// Corners of a bar, in order around it, m.
    #[must_use]
    pub fn corners(&self, center: Planar, [across, along]: [f64; 2]) -> [Planar; 4] {
        let normal = normal(self.slope) * across;
        let tangent = tangent(self.slope) * along;
        [center - normal - tangent, center + normal - tangent, center + normal + tangent, center - normal + tangent]
    }
}

/// Where a backbone is as it is met, in the plane of the cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Met {
    /// The point of the backbone, m.
    pub touches: Planar,
    /// Slope there, rad.
    pub slope: f64,
    /// +1 where what it meets stands on the side of larger bends, −1 on the other.
    pub side: f64,
    /// How far the robot's side is from the backbone there, m.
    pub surface: f64,
    /// How far a disk's rim stands out there, m; 0 between disks.
    pub rim: f64,
}

impl Met {
    fn toward(&self) -> Planar {
        normal(self.slope) * self.side
    }

    /// So far from the backbone, m.
    fn away(&self, distance: f64) -> Planar {
        self.touches + self.toward() * distance
    }

    /// The bar that bears what touches: so far beyond the robot's side (m), and below it by a share of a disk's radius.
    fn arm(&self, sizes: &Proportions, distance: f64, below: f64) -> (Planar, f64) {
        let at = self.away(self.surface + distance) - tangent(self.slope) * (below * f64::from(sizes.disk));
        (at, ARM * f64::from(sizes.beam))
    }

    fn obstacle(self, bar: (Planar, f64), fittings: Vec<Piece>) -> Obstacle {
        let Self { touches, slope, side, .. } = self;
        Obstacle { touches, slope, side, bar, fittings }
    }

    /// A clamp: its jaws hold the rim between them, clear of the backbones.
    pub fn jaws(self, sizes: &Proportions) -> Obstacle {
        let toward = self.toward();
        let along = Planar::new(-toward.y, toward.x);
        let [gap, thick] = [0.52, 1.1].map(|share| share * f64::from(sizes.thickness()));
        let (near, far) = (-0.8 * self.rim, 1.8 * f64::from(sizes.beam));
        let jaw = |end: f64| Piece::Bar {
            center: self.away(self.surface + 0.5 * (near + far)) + along * (end * (gap + 0.5 * thick)),
            half: [0.5 * (far - near), 0.5 * thick],
        };
        self.obstacle(self.arm(sizes, far, 0.0), vec![jaw(-1.0), jaw(1.0)])
    }

    /// A plate, on an arm below its middle: clear of the part that bends over it.
    pub fn plate(self, sizes: &Proportions) -> Obstacle {
        let beam = f64::from(sizes.beam);
        let half = [0.25 * beam, PLATE * f64::from(sizes.disk)];
        let plate = Piece::Bar { center: self.away(self.surface + half[0]), half };
        self.obstacle(self.arm(sizes, (0.4 + ARM) * beam, 0.3), vec![plate])
    }

    /// A rod whose axis is so far from the backbone, m.
    fn rod(self, distance: f64, radius: f64) -> Obstacle {
        let bar = (self.away(distance), radius);
        self.obstacle(bar, Vec::new())
    }
}

/// Distance from the backbone at which beam and robot touch, m. It is the robot's side; a round beam whose rounding leaves it no room
/// beyond that is drawn as thin as a backbone.
fn envelope(contact: &PlannedContact, sizes: &Proportions, length: f64) -> f64 {
    let side = f64::from(sizes.surface(contact.arc_length));
    match contact.touch.as_deref().map(Touch::surface) {
        Some(Surface::Cylinder { rounding }) => side.min(rounding * length - f64::from(sizes.thin())),
        _ => side,
    }
}

/// The force of a beam that only touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Where beam and robot touch, m.
    pub at: Planar,
    /// Direction of the force on the robot, of length 1.
    pub along: Planar,
    /// Its size, N.
    pub newtons: f64,
    /// Its size, as a share of the largest in the whole motion.
    pub share: f64,
}

impl Push {
    /// Its size in words.
    #[must_use]
    pub fn words(&self) -> String {
        format!("{:.2} N", self.newtons)
    }

    /// The force in a shape of a run, while a beam touches it. A clamp has none: it acts by a couple.
    #[must_use]
    pub fn of(run: &Run, sizes: &Proportions, shape: &Shape) -> Option<Self> {
        let (Shape::Touched(touched), contact) = (shape, run.plan.contact()?) else { return None };
        let (branch, touching) = (touched.branch(), touched.touching()?);
        let segment = run.segment();
        let (place, _) = touching.point(branch.basis(), touching.at.place);
        let toward = normal(touching.force_slope) * contact.side;
        let at = place * segment.length + toward * envelope(contact, sizes, segment.length);
        let force = contact.side * touching.force();
        let motion = &run.plan.scenario().motion;
        let ends = [motion.start, motion.finish].map(|time| truly(run, run.place(time)).bend());
        let furthest = ends.into_iter().map(|bend| contact.side * bend).fold(f64::NEG_INFINITY, f64::max);
        let last = branch.ending().map_or(contact.side * furthest, |(bend, _)| bend);
        let largest = branch.shape(last).map_or(0.0, |shape| contact.side * shape.force()).max(force);
        let unit = segment.bending_stiffness() / (segment.length * segment.length);
        let share = if largest > 0.0 { (force / largest).max(0.0) } else { 0.0 };
        Some(Self { at, along: -toward, newtons: force * unit, share })
    }
}

/// Whether a run has a beam that touches without clamping.
#[must_use]
pub fn only_touches(run: &Run) -> bool {
    run.plan.contact().is_some_and(|contact| contact.touch.is_some())
}

/// Whether the segment has got away from a beam at a place of a run: it bends beyond where the contact ends, and the beam is in the way of
/// nothing any more.
#[must_use]
pub fn let_go(run: &Run, place: usize) -> bool {
    let ended = |contact: &PlannedContact| {
        let (last, _) = contact.branch()?.ending()?;
        Some(contact.side * (truly(run, place).bend() - last) > 0.0)
    };
    run.plan.contact().and_then(ended).unwrap_or(false)
}

/// The true configuration at a place of a run; that of the command for a log.
fn truly(run: &Run, place: usize) -> Configuration {
    let commanded = run.commanded(place);
    if run.is_recorded() { commanded } else { run.plan.true_robot().configuration(commanded) }
}

/// Where the paper's model has the backbone at a place of a run while a beam touches it that does not clamp: frozen below the contact.
#[must_use]
pub fn frozen(run: &Run, place: usize) -> Option<Shape> {
    let contact = run.plan.contact()?;
    matches!(run.truth(place)?.shape, Shape::Touched(_)).then(|| {
        let length = run.segment().length;
        Shape::Held(Constrained::new(length, contact.arc_length, contact.bend, truly(run, place)))
    })
}

/// The tangent at a slope.
fn tangent(slope: f64) -> Planar {
    let (sin, cos) = slope.sin_cos();
    Planar::new(sin, cos)
}

/// The normal at a slope, toward larger bends.
fn normal(slope: f64) -> Planar {
    let (sin, cos) = slope.sin_cos();
    Planar::new(cos, -sin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::{ContactKind, Scenario, preset};

    fn run(kind: ContactKind, change: impl FnOnce(&mut Scenario)) -> (Run, Proportions) {
        let mut scenario = Scenario::default();
        scenario.contact.kind = kind;
        scenario.contact.rounding = 0.006;
        change(&mut scenario);
        let run = simulate(&scenario).expect("valid");
        let sizes = Proportions::of(&run);
        (run, sizes)
    }

    /// The forces at times (s) at which the beam holds.
    fn pushes((run, sizes): &(Run, Proportions)) -> Vec<Push> {
        let at = |time| Push::of(run, sizes, &run.shape(run.place(time))).expect("it touches");
        [5.9, 6.4, 7.0, 9.0].map(at).into()
    }

    #[test]
    fn a_plates_face_goes_through_where_it_touches() {
        let touched = run(ContactKind::Plane, |_| ());
        let obstacle = Obstacle::of(&touched.0, &touched.1).expect("beam");
        let [Piece::Bar { center, half }] = obstacle.fittings[..] else { panic!("a plate") };
        let corners = obstacle.corners(center, half);
        let (face, back) = ([corners[0], corners[3]], [corners[1], corners[2]]);
        let normal = normal(obstacle.slope);
        assert!((face[1] - face[0]).dot(&normal).abs() < 1e-12, "its normal is that of the backbone as it was met");
        assert!((back[0] - face[0]).dot(&normal) > 0.0, "it stands beyond its face");
        for push in pushes(&touched) {
            assert!((push.at - face[0]).dot(&normal).abs() < 1e-8, "{push:?}");
            assert!((push.along + normal).norm() < 1e-12);
        }
    }

    #[test]
    fn a_rod_stays_where_it_is_and_always_touches() {
        let touched = run(ContactKind::Cylinder, |_| ());
        let (center, radius) = Obstacle::of(&touched.0, &touched.1).expect("beam").bar;
        for push in pushes(&touched) {
            assert!((push.at - center - push.along * radius).norm() < 1e-8, "{push:?}");
        }
    }

    #[test]
    fn a_thin_rod_can_be_seen_and_stays_where_it_is() {
        let touched = run(ContactKind::Cylinder, |scenario| scenario.contact.rounding = 0.0);
        let (center, radius) = Obstacle::of(&touched.0, &touched.1).expect("beam").bar;
        assert!(radius > 1e-4);
        for push in pushes(&touched) {
            assert!((push.at - center - push.along * radius).norm() < 1e-8, "{push:?}");
        }
    }

    #[test]
    fn the_force_opposes_the_bend_and_grows() {
        for kind in [ContactKind::Plane, ContactKind::Cylinder] {
            for back in [false, true] {
                let touched = run(kind, |scenario| {
                    if back {
                        scenario.motion.theta_end = 2.0 * scenario.motion.theta_start;
                    }
                });
                let bends = if back { -1.0 } else { 1.0 };
                let forces = pushes(&touched);
                assert!(forces.iter().all(|push| push.along.x * bends < 0.0 && push.newtons > 0.0), "{forces:?}");
                assert!(forces.windows(2).all(|pair| pair[0].newtons < pair[1].newtons));
                assert!(forces.windows(2).all(|pair| pair[0].share < pair[1].share));
                assert!((forces[3].share - 1.0).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn after_a_small_bend_the_force_is_that_of_linear_beam_theory() {
        // The moment is M0 − F(s − x) below the contact and M0 above, its integral EI Δφ, and the contact stays where it is.
        let touched = run(ContactKind::Plane, |scenario| {
            scenario.motion.theta_start = 1.5;
            scenario.motion.theta_end = 1.49;
        });
        let (run, sizes) = &touched;
        let (contact, segment) = (run.plan.contact().expect("beam"), run.plan.segment());
        let (length, s) = (segment.length, contact.arc_length);
        let place = run.place(9.0);
        let turned = run.commanded(place).bend() - contact.bend;
        let stiffness = segment.bending_stiffness();
        // M0 s²/2 = F s³/3, so M0 = 2 F s/3; and EI Δφ = M0 L − F s²/2.
        let force = stiffness * turned / (2.0 * s * length / 3.0 - 0.5 * s * s);
        let push = Push::of(run, sizes, &run.shape(place)).expect("it touches");
        assert!((push.newtons / force - 1.0).abs() < 0.01, "{} N, {force} N", push.newtons);
    }

    #[test]
    fn a_clamp_has_jaws_and_no_force() {
        let (run, sizes) = run(ContactKind::Clamp, |_| ());
        let obstacle = Obstacle::of(&run, &sizes).expect("beam");
        assert_eq!(obstacle.fittings.len(), 2);
        let place = run.place(7.0);
        assert_eq!((Push::of(&run, &sizes, &run.shape(place)), frozen(&run, place)), (None, None));
    }

    #[test]
    fn a_beam_that_slides_off_has_let_go() {
        let (run, sizes) = run(ContactKind::Cylinder, |scenario| {
            let of_preset = preset::find("disk-3").and_then(preset::Preset::scenario).expect("preset");
            scenario.contact.place = of_preset.contact.place;
            scenario.contact.start = of_preset.contact.start;
            scenario.contact.rounding = 0.008;
        });
        let at = |time| (let_go(&run, run.place(time)), run.shape(run.place(time)));
        for (time, gone) in [(4.0, false), (9.0, true)] {
            let (let_go, shape) = at(time);
            assert_eq!(let_go, gone, "{time} s");
            assert!(!gone || Push::of(&run, &sizes, &shape).is_none());
        }
    }

    #[test]
    fn only_a_held_shape_has_a_frozen_one() {
        let (run, _) = run(ContactKind::Plane, |_| ());
        assert_eq!(frozen(&run, run.place(5.0)), None);
        let place = run.place(7.0);
        let (frozen, truth) = (frozen(&run, place).expect("it touches"), run.shape(place));
        let apart = |s: f64| (frozen.pose(s).position - truth.pose(s).position).norm();
        assert!(apart(0.010) > 1e-4 && apart(0.030) > 1e-4, "the part below changes its shape");
    }
}
