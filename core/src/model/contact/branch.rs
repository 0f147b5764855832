//! One contact over all bends: where it holds, how it ends, and the tip at the price of a polynomial.
//!
//! Against a fixed obstacle the shape is a smooth function of the bend φ alone, without history. A branch is followed from
//! first contact to the last bend asked for, or to where it ends; on it the tip is interpolated at Chebyshev points, piece by
//! piece, to rounding.

use super::plane::Solved;
use super::ritz::Basis;
use super::{Meeting, Planar, Touching, Unknowns, cylinder, plane};
use libm::cos;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// What the segment touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// A plane that holds one point of the backbone along its normal.
    Plane,
    /// A round beam along which the backbone's round envelope slides.
    Cylinder {
        /// Radius of the beam and of the envelope, in units of L.
        rounding: f64,
    },
}

/// How a branch ends before the last bend that was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The shape loses its stability and the segment snaps off.
    Snaps,
    /// The contact slides over the end of the backbone.
    SlidesOff,
    /// The backbone is as curved as the round beam, and would lie along it from there: that is not modelled.
    Wraps,
    /// The contact force falls to zero.
    Opens,
}

/// The end disk in the bending plane, at one bend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// Position, in units of L.
    pub position: Planar,
    /// Its derivative by φ.
    pub by_bend: Planar,
}

impl Surface {
    /// Chebyshev points of a piece: more than a shape needs cost time, and so does a piece split in vain.
    fn points(self) -> usize {
        match self {
            Self::Plane => 16,
            Self::Cylinder { .. } => TERMS,
        }
    }
}

impl Tip {
    const UNDEFINED: Self =
        Self { position: Planar::new(f64::NAN, f64::NAN), by_bend: Planar::new(f64::NAN, f64::NAN) };
}

/// Most terms of a piece.
const TERMS: usize = 24;
/// A piece is good when its last coefficients are below this: they tell what is left out.
const ROUNDING: f64 = 2e-14;
/// No piece is split below this width, rad: near a snap the shape goes like a root.
const NARROW: f64 = 1e-4;
/// Steps along the branch, rad: the longest, and where the search for an end stops.
const STRIDE: f64 = 0.1;
const FINE: f64 = 1e-10;
const SKETCHED: f64 = 1e-5;
/// A shape further from where the last one led, rad per coefficient, is on another branch.
const LEAP: f64 = 0.2;

/// A contact whose branch is followed once somebody asks for it: to know that a contact is possible costs nothing.
#[derive(Debug, Clone)]
pub struct Touch {
    meeting: Meeting,
    surface: Surface,
    last: f64,
    sketched: bool,
    branch: OnceLock<Arc<Branch>>,
}

impl Touch {
    /// A contact to the bend `last` (rad), whose shapes are exact or [sketched](Branch::sketched).
    #[must_use]
    pub fn new(meeting: Meeting, surface: Surface, last: f64, sketched: bool) -> Self {
        Self { meeting, surface, last, sketched, branch: OnceLock::new() }
    }

    /// Its shapes.
    #[must_use]
    pub fn branch(&self) -> &Arc<Branch> {
        self.branch.get_or_init(|| {
            let follow = if self.sketched { Branch::sketched } else { Branch::new };
            Arc::new(follow(self.meeting, self.surface, self.last))
        })
    }

    /// What the segment touches.
    #[must_use]
    pub fn surface(&self) -> Surface {
        self.surface
    }
}

impl PartialEq for Touch {
    fn eq(&self, other: &Self) -> bool {
        let asked = |touch: &Self| (touch.meeting, touch.surface, touch.last, touch.sketched);
        asked(self) == asked(other)
    }
}

/// The shapes of one contact over the bends at which it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    basis: Basis,
    meeting: Meeting,
    surface: Surface,
    /// Shapes found on the way, in order.
    anchors: Vec<Touching>,
    pieces: Vec<Piece>,
    ending: Option<(f64, Ending)>,
}

#[derive(Debug, Clone, PartialEq)]
struct Piece {
    middle: f64,
    half: f64,
    /// How many terms of each series there are.
    terms: usize,
    /// Position of the tip, and its derivative.
    tip: [[f64; TERMS]; 4],
    /// Slope at the contact, and its place.
    contact: [[f64; TERMS]; 2],
}

impl Piece {
    /// Cubics through two shapes and their derivatives.
    fn between(basis: &Basis, from: &Touching, to: &Touching) -> Self {
        let (middle, half) = (0.5 * (from.bend + to.bend), 0.5 * (to.bend - from.bend).abs());
        let (low, high) = if from.bend < to.bend { (from, to) } else { (to, from) };
        // Value and derivative of each quantity, at both ends.
        let ends = [low, high].map(|touching| {
            let (tip, by) = touching.tip(basis);
            let contact = [(touching.slope(), touching.by_bend.coefficients[0])];
            let place = [(touching.at.place, touching.by_bend.place)];
            [[(tip.x, by.x)], [(tip.y, by.y)], contact, place].map(|[pair]| pair)
        });
        let cubic = |quantity: usize| {
            let [(a, da), (b, db)] = ends.each_ref().map(|end| end[quantity]);
            let (da, db) = (da * half, db * half);
            // The Hermite cubic on [−1, 1] as a Chebyshev series.
            let (sum, difference) = (0.5 * (a + b), 0.5 * (b - a));
            let mut series = [0.0; TERMS];
            series[0] = sum - (db - da) / 8.0;
            series[1] = difference + (2.0 * difference - da - db) / 16.0;
            series[2] = (db - da) / 8.0;
            series[3] = (da + db - 2.0 * difference) / 16.0;
            series
        };
        let [x, z, slope, place] = std::array::from_fn(cubic);
        Self { middle, half, terms: 4, tip: [x, z, slopes(&x, half), slopes(&z, half)], contact: [slope, place] }
    }
}

/// The derivative of a cubic Chebyshev series over an interval of half this width.
fn slopes(series: &[f64; TERMS], half: f64) -> [f64; TERMS] {
    let mut by = [0.0; TERMS];
    by[0] = (series[1] + 3.0 * series[3]) / half;
    by[1] = 4.0 * series[2] / half;
    by[2] = 6.0 * series[3] / half;
    by
}

impl Branch {
    /// Follows a contact from where it was met to the bend `last` (rad), which lies on its side.
    #[must_use]
    pub fn new(meeting: Meeting, surface: Surface, last: f64) -> Self {
        let mut branch = Self::followed(meeting, surface, last, FINE);
        if let (Some(first), Some(end)) = (branch.anchors.first(), branch.anchors.last()) {
            let (from, to) = (first.bend, end.bend);
            branch.fit(from, to);
        }
        branch
    }

    /// The same at a tenth of the price, for a map of many contacts: cubics between the shapes found on the way, which are
    /// right to 1e-5 L, but for a contact that is about to slide off.
    #[must_use]
    pub fn sketched(meeting: Meeting, surface: Surface, last: f64) -> Self {
        let mut branch = Self::followed(meeting, surface, last, SKETCHED);
        branch.pieces =
            branch.anchors.windows(2).map(|ends| Piece::between(&branch.basis, &ends[0], &ends[1])).collect();
        branch
    }

    fn followed(meeting: Meeting, surface: Surface, last: f64, fine: f64) -> Self {
        let basis = Basis::new();
        let mut branch = Self { basis, meeting, surface, anchors: Vec::new(), pieces: Vec::new(), ending: None };
        branch.follow(last, fine);
        branch
    }

    /// What was met, and where.
    #[must_use]
    pub fn meeting(&self) -> &Meeting {
        &self.meeting
    }

    /// What the segment touches.
    #[must_use]
    pub fn surface(&self) -> Surface {
        self.surface
    }

    /// Quadrature for [`Touching::point`].
    #[must_use]
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// The bend (rad) at which the contact ends before the last bend asked for, and how.
    #[must_use]
    pub fn ending(&self) -> Option<(f64, Ending)> {
        self.ending
    }

    /// Whether the contact holds the backbone at a bend φ (rad).
    #[must_use]
    pub fn holds_at(&self, bend: f64) -> bool {
        let beyond = |limit: f64| self.meeting.side * (bend - limit);
        // Past the last bend asked for by a rounding error, it still holds: only an ending ends it.
        let within = |end: &Touching| self.ending.is_none() || beyond(end.bend) <= 0.0;
        beyond(self.meeting.bend) > 0.0 && self.anchors.last().is_some_and(within)
    }

    /// The tip at a bend at which the contact holds; at another, that of the nearest such bend.
    #[must_use]
    pub fn tip(&self, bend: f64) -> Tip {
        let Some((piece, x)) = self.piece(bend) else {
            return self.anchors.last().map_or(Tip::UNDEFINED, |only| {
                let (position, by_bend) = only.tip(&self.basis);
                Tip { position, by_bend }
            });
        };
        let [px, pz, vx, vz] = clenshaw(&piece.tip, piece.terms, x);
        Tip { position: Planar::new(px, pz), by_bend: Planar::new(vx, vz) }
    }

    /// Bend of the part above the contact (rad), and arc length of the contact (in units of L), at a bend at which it holds.
    #[must_use]
    pub fn above(&self, bend: f64) -> (f64, f64) {
        let Some((piece, x)) = self.piece(bend) else {
            let only = self.anchors.last();
            return only.map_or((f64::NAN, f64::NAN), |only| (only.upper_bend(), only.at.place));
        };
        let [slope, place] = clenshaw(&piece.contact, piece.terms, x);
        (bend - slope, place)
    }

    /// The piece in which a bend lies, and where in it.
    fn piece(&self, bend: f64) -> Option<(&Piece, f64)> {
        let side = self.meeting.side;
        let at = self.pieces.partition_point(|piece| side * (bend - piece.middle) > piece.half);
        let piece = self.pieces.get(at).or(self.pieces.last())?;
        Some((piece, ((bend - piece.middle) / piece.half).clamp(-1.0, 1.0)))
    }

    /// The shape at a bend at which the contact holds; `None` elsewhere.
    #[must_use]
    pub fn shape(&self, bend: f64) -> Option<Touching> {
        if self.holds_at(bend) || bend == self.meeting.bend { self.exactly(bend) } else { None }
    }

    fn exactly(&self, bend: f64) -> Option<Touching> {
        let side = self.meeting.side;
        let after = self.anchors.partition_point(|anchor| side * (anchor.bend - bend) <= 0.0);
        let near = self.anchors.get(after.saturating_sub(1))?;
        if near.bend == bend {
            return Some(*near);
        }
        self.solve(bend, &led(near, bend)).map(|solved| solved.touching)
    }

    fn solve(&self, bend: f64, from: &Unknowns) -> Option<Solved> {
        match self.surface {
            Surface::Plane => plane::solve(&self.basis, &self.meeting, bend, Some(from)),
            Surface::Cylinder { rounding } => cylinder::solve(&self.basis, &self.meeting, rounding, bend, Some(from)),
        }
    }

    /// Finds anchors up to `last`, or to an end, which is known to `fine`.
    fn follow(&mut self, last: f64, fine: f64) {
        let Meeting { place, bend, side } = self.meeting;
        let coefficients = plane::first(self.meeting.slope());
        let start = Unknowns { coefficients, place, multiplier: 0.0 };
        let Some(first) = self.solve(bend, &start).filter(|first| first.stable) else {
            self.ending = Some((bend, Ending::Snaps));
            return;
        };
        let mut near = first.touching;
        self.anchors.push(near);
        let mut stride = STRIDE;
        while side * (last - near.bend) > 0.0 {
            let left = side * (last - near.bend);
            let bend = if stride < left { near.bend + side * stride } else { last };
            match self.next(&near, bend) {
                Ok(touching) => {
                    near = touching;
                    self.anchors.push(near);
                    stride = (2.0 * stride).min(STRIDE);
                }
                Err(how) if stride < fine => {
                    self.ending = Some((near.bend, how));
                    return;
                }
                Err(_) => stride = 0.5 * stride.min(left),
            }
        }
    }

    /// The shape at a bend a step further, if the branch goes so far.
    fn next(&self, near: &Touching, bend: f64) -> Result<Touching, Ending> {
        let from = led(near, bend);
        let found = self.solve(bend, &from).ok_or(Ending::Snaps)?;
        let Touching { at, .. } = found.touching;
        let leap = at.coefficients.iter().zip(from.coefficients).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if !found.stable || leap > LEAP {
            return Err(Ending::Snaps);
        }
        if let Surface::Cylinder { rounding } = self.surface
            && self.meeting.side * found.touching.curvature_above() * rounding >= 1.0
        {
            return Err(Ending::Wraps);
        }
        // So near to the end there is no arc above the contact left to speak of.
        if at.place > 1.0 - 1e-6 || at.place < 1e-6 {
            return Err(Ending::SlidesOff);
        }
        if at.multiplier * self.meeting.side < 0.0 {
            return Err(Ending::Opens);
        }
        Ok(found.touching)
    }

    /// Interpolates between two bends, in as many pieces as it takes.
    fn fit(&mut self, from: f64, to: f64) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from).abs());
        if half == 0.0 {
            return;
        }
        let terms = self.surface.points();
        let sample = |k: usize| {
            let x = cos(PI * (k as f64 + 0.5) / terms as f64);
            let touching = self.exactly(middle + half * x)?;
            let (position, by_bend) = touching.tip(&self.basis);
            Some(([position.x, position.y, by_bend.x, by_bend.y], [touching.slope(), touching.at.place]))
        };
        let samples: Option<Vec<_>> = (0..terms).map(sample).collect();
        let piece = samples.map(|samples| {
            let (tips, contacts): (Vec<_>, Vec<_>) = samples.into_iter().unzip();
            Piece { middle, half, terms, tip: coefficients(&tips), contact: coefficients(&contacts) }
        });
        let good = |piece: &Piece| {
            let mut series = piece.tip.iter().chain(&piece.contact);
            series.all(|row| {
                let size = row.iter().fold(1.0_f64, |most, term| most.max(term.abs()));
                row[terms - 3..terms].iter().all(|term| term.abs() < ROUNDING * size)
            })
        };
        match piece {
            Some(piece) if good(&piece) || half < NARROW => self.pieces.push(piece),
            _ if half < NARROW => {}
            _ => {
                self.fit(from, middle);
                self.fit(middle, to);
            }
        }
    }
}

/// Where a shape leads at another bend, to first order.
fn led(near: &Touching, bend: f64) -> Unknowns {
    let step = bend - near.bend;
    let mut at = near.at;
    at.coefficients.iter_mut().zip(near.by_bend.coefficients).for_each(|(b, by)| *b += step * by);
    at.place += step * near.by_bend.place;
    at.multiplier += step * near.by_bend.multiplier;
    at
}

/// Chebyshev coefficients of values at the points cos(π(k + ½)/n); the first is halved.
fn coefficients<const N: usize>(samples: &[[f64; N]]) -> [[f64; TERMS]; N] {
    let points = samples.len();
    let n = points as f64;
    let mut all = [[0.0; TERMS]; N];
    for j in 0..points {
        let share = if j == 0 { 1.0 / n } else { 2.0 / n };
        for (k, values) in samples.iter().enumerate() {
            let weight = share * cos(PI * j as f64 * (k as f64 + 0.5) / n);
            all.iter_mut().zip(values).for_each(|(series, value)| series[j] += weight * value);
        }
    }
    all
}

/// The sums of several Chebyshev series of some terms at x in [−1, 1].
fn clenshaw<const N: usize>(series: &[[f64; TERMS]; N], terms: usize, x: f64) -> [f64; N] {
    let (mut a, mut b) = ([0.0; N], [0.0; N]);
    for j in (1..terms).rev() {
        for v in 0..N {
            (a[v], b[v]) = (series[v][j] + 2.0 * x * a[v] - b[v], a[v]);
        }
    }
    std::array::from_fn(|v| series[v][0] + x * a[v] - b[v])
}
