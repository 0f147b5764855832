//! What the segment meets, in its bending plane: the 3D view and the flat one draw the same cross-section.
//!
//! Points are in m, x toward the bend and z along the straight backbone; a slope is the angle of the tangent from z toward x, its normal
//! is `(cos α, −sin α)`, see [`centrode_core::model::contact`].

use super::Proportions;
use centrode_core::model::contact::Planar;
use centrode_core::model::contact::branch::{Branch, Surface};
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
        let length = run.plan.segment().length;
        let met = Arc { length, configuration: Configuration::new(0.0, 0.0).with_bend(contact.bend) };
        let position = met.pose(contact.arc_length).position;
        let touches = Planar::new(position.x, position.z);
        let slope = contact.bend * contact.arc_length / length;
        let toward = normal(slope) * contact.side;
        let along = Planar::new(-toward.y, toward.x);
        let (surface, beam) = (f64::from(sizes.surface(contact.arc_length)), f64::from(sizes.beam));
        let away = |distance: f64| touches + toward * distance;
        let arm = |distance: f64| (away(surface + distance), ARM * beam);
        let (bar, fittings) = match contact.touch.as_deref().map(Branch::surface) {
            None => {
                // The jaws hold the rim between them, clear of the backbones.
                let [gap, thick] = [0.52, 1.1].map(|share| share * f64::from(sizes.thickness()));
                let (near, far) = (-0.8 * f64::from(sizes.rim(contact.arc_length)), 1.8 * beam);
                let jaw = |end: f64| Piece::Bar {
                    center: away(surface + 0.5 * (near + far)) + along * (end * (gap + 0.5 * thick)),
                    half: [0.5 * (far - near), 0.5 * thick],
                };
                (arm(far), vec![jaw(-1.0), jaw(1.0)])
            }
            Some(Surface::Plane) => {
                let half = [0.25 * beam, PLATE * f64::from(sizes.disk)];
                (arm((0.4 + ARM) * beam), vec![Piece::Bar { center: away(surface + half[0]), half }])
            }
            Some(Surface::Cylinder { rounding }) => {
                let reach = rounding * length;
                ((away(reach), reach - envelope(contact, sizes, length)), Vec::new())
            }
        };
        Some(Self { touches, slope, side: contact.side, bar, fittings })
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

/// Distance from the backbone at which beam and robot touch, m. It is the robot's side; a round beam whose rounding leaves it no room
/// beyond that is drawn as thin as a backbone.
fn envelope(contact: &PlannedContact, sizes: &Proportions, length: f64) -> f64 {
    let side = f64::from(sizes.surface(contact.arc_length));
    match contact.touch.as_deref().map(Branch::surface) {
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
        let segment = run.plan.segment();
        let (place, _) = touching.point(branch.basis(), touching.at.place);
        let toward = normal(touching.force_slope) * contact.side;
        let at = place * segment.length + toward * envelope(contact, sizes, segment.length);
        let force = contact.side * touching.force();
        let motion = &run.plan.scenario().motion;
        let ends = [motion.start, motion.finish].map(|time| run.commanded(run.place(time)).bend());
        let furthest = ends.into_iter().map(|bend| contact.side * bend).fold(f64::NEG_INFINITY, f64::max);
        let last = branch.ending().map_or(contact.side * furthest, |(bend, _)| bend);
        let largest = branch.shape(last).map_or(0.0, |shape| contact.side * shape.force()).max(force);
        let unit = (segment.ep_ip + 3.0 * segment.es_is) / (segment.length * segment.length);
        let share = if largest > 0.0 { (force / largest).max(0.0) } else { 0.0 };
        Some(Self { at, along: -toward, newtons: force * unit, share })
    }
}

/// Whether a run has a beam that touches without clamping.
#[must_use]
pub fn only_touches(run: &Run) -> bool {
    run.plan.contact().is_some_and(|contact| contact.touch.is_some())
}

/// Where the paper's model has the backbone at a place of a run while a beam touches it that does not clamp: frozen below the contact.
#[must_use]
pub fn frozen(run: &Run, place: usize) -> Option<Shape> {
    let contact = run.plan.contact()?;
    matches!(run.truth(place)?.shape, Shape::Touched(_)).then(|| {
        let length = run.plan.segment().length;
        Shape::Held(Constrained::new(length, contact.arc_length, contact.bend, run.commanded(place)))
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
