//! Where on a chain a contact is: what its trackers say of it together.

use super::ensemble::Listens;
use super::filter::Signature;
use super::likelihood::{Base, Began, Grid, Row};
use super::marginal::{Estimate, Place, Tried, Weighed, likeliest, rows, weigh};
use super::sheet::{Sheet, Softness, Sums, WIDE};
use super::signature::PLACES;
use super::{Command, STATES};
use crate::scenario::Kind;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// What contacts on one segment change in the readings of every tracker.
pub trait Hypotheses: std::fmt::Debug {
    /// Those that began at an instant (in readings).
    type Met: Met;
    /// How many trackers, from the first, see anything of them.
    fn seen_by(&self) -> usize;
    /// Those that began at an instant (in readings).
    fn met(&self, began: f64) -> Self::Met;
    /// How soft the chain is where planes press.
    fn softness(&self) -> Softness;
    /// Whether a clamp is thought possible.
    fn may_clamp(&self) -> bool;
}

/// What contacts that began at the same instant change in a reading of a tracker after it, at the
/// [`places`](super::signature::places) of their segment.
pub trait Met {
    /// Of planes, at all [`tilts`](super::sheet::tilts) from that of the softness on.
    fn planes(&self, tracker: usize, reading: usize) -> Signature<WIDE>;
    /// Of clamps.
    fn clamps(&self, tracker: usize, reading: usize) -> Signature<PLACES>;
}

/// What is asked.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// The readings that are thought of as the beginning, rising.
    pub beginnings: &'a [usize],
    /// Beginnings that are tried between one of them and the next.
    pub parts: u32,
    /// How many times less than it seems to, each reading says.
    pub doubt: f64,
    /// The largest logarithm of the likelihood ratio on another segment, beside which this one may not count.
    pub rival: f64,
    /// The segment, from 0.
    pub segment: usize,
    /// Its length, m.
    pub length: f64,
    /// The commands of its readings.
    pub commands: &'a [Command],
    /// Errors of its calibration before the contact, in their own units, and their standard deviations.
    pub calibration: [[f64; STATES]; 2],
}

/// What was heard of contacts on one segment, by the instant at which they began: kept from one question to the next.
#[derive(Debug, Default)]
pub struct Kept {
    planes: RefCell<BTreeMap<u64, Sums<WIDE>>>,
    clamps: RefCell<BTreeMap<u64, Sums<PLACES>>>,
}

/// What is kept of an instant (in readings), or else made.
fn kept<const N: usize>(all: &RefCell<BTreeMap<u64, Sums<N>>>, at: f64, make: impl FnOnce() -> Sums<N>) -> Sums<N> {
    let known = all.borrow().get(&at.to_bits()).cloned();
    known.unwrap_or_else(|| {
        let made = make();
        all.borrow_mut().insert(at.to_bits(), made.clone());
        made
    })
}

/// A contact on one segment.
#[derive(Debug, Clone)]
pub struct Placed {
    /// Where, and since when.
    pub estimate: Estimate,
    /// The likeliest tilt of a plane, rad.
    pub tilt: f64,
}

/// Places a contact on one segment. `None` where nothing moved.
#[must_use]
pub fn estimate<H: Hypotheses>(
    heard: &impl Listens,
    hypotheses: &H,
    keeping: &Kept,
    question: &Question,
) -> Option<Placed> {
    let base = if question.segment == 0 { Base::Stays } else { Base::Moves };
    let grid = Grid::coarse(base);
    let (seeing, softness) = (hypotheses.seen_by(), hypotheses.softness());
    let sheet = |(whole, part): (usize, f64)| {
        let at = whole as f64 + part;
        let make = || {
            let met = hypotheses.met(at);
            heard.hear(at, seeing, |tracker, k| met.planes(tracker, k))
        };
        Sheet::new(at, kept(&keeping.planes, at, make).doubted(question.doubt), softness)
    };
    let began = likeliest(question.beginnings, |began| sheet((began, 0.0)).largest(&grid))?;
    let (sheets, parts) = rows(sheet, question.beginnings, began, question.parts, &grid);
    let beginnings = question.beginnings.len();
    let Question { length, commands, calibration, .. } = *question;
    let weighed = Weighed { base, length, commands, beginnings, calibration };
    let likeliest_of =
        |sheets: &[Sheet]| sheets.iter().map(|sheet| sheet.largest(&grid)).fold(f64::NEG_INFINITY, f64::max);
    let across: Vec<Row> = sheets.iter().map(|sheet| sheet.at(0.0)).collect();
    let across = Tried { kind: Kind::Plane, rows: across, parts: f64::from(parts) };
    if likeliest_of(&sheets) < question.rival - HOPELESS {
        // Whatever else is known of it counts for nothing.
        let best = sheets.iter().max_by(|a, b| a.largest(&grid).total_cmp(&b.largest(&grid)))?;
        let (tilt, row, _) = best.likeliest(&grid).clone();
        let estimate = weigh(&[Tried { rows: vec![row], ..across }], &weighed)?;
        return Some(Placed { estimate, tilt });
    }
    let (planes, tilt) = tilted(&sheets, parts, &grid)?;
    let mut all = vec![planes, across];
    let mut shares = vec![0.5, 0.5];
    if hypotheses.may_clamp() {
        let clamp = |(whole, part): (usize, f64)| {
            let at = whole as f64 + part;
            let make = || {
                let met = hypotheses.met(at);
                heard.hear(at, seeing, |tracker, k| met.clamps(tracker, k))
            };
            kept(&keeping.clamps, at, make).doubted(question.doubt).row(at)
        };
        let began = likeliest(question.beginnings, |began| clamp((began, 0.0)).most(&grid))?;
        let (rows, parts) = rows(clamp, question.beginnings, began, question.parts, &grid);
        all.push(Tried { kind: Kind::Clamp, rows, parts: f64::from(parts) });
        shares.iter_mut().for_each(|share| *share *= 1.0 - CLAMPED);
        shares.push(CLAMPED);
    }
    // All are weighed alike: what is likelier beforehand counts as if more had been tried.
    let count = all.len() as f64;
    all.iter_mut().zip(shares).for_each(|(tried, share)| tried.parts /= share * count);
    // One segment against another is weighed by all that was heard. What trackers learn of the calibration they learn from noise that they share,
    // and each learns by itself: with every further one, what they say of the place is believed less. Then intervals hold it.
    let mut estimate = weigh(&all, &weighed)?;
    if seeing > 1 {
        let believed = (1..seeing).map(|_| SHARED).product();
        for tried in &mut all {
            tried.rows.iter_mut().for_each(|row| *row = row.told(believed));
        }
        estimate = Estimate { ratio: estimate.ratio, evidence: estimate.evidence, ..weigh(&all, &weighed)? };
    }
    let mut kinds: Vec<(Kind, f64)> = Vec::new();
    for (kind, share) in &estimate.kinds {
        match kinds.iter_mut().find(|(known, _)| known == kind) {
            Some((_, sum)) => *sum += share,
            None => kinds.push((*kind, *share)),
        }
    }
    if let Some((_, clamp)) = kinds.iter().find(|(kind, _)| *kind == Kind::Clamp) {
        // Between where a plane would be and where a clamp would be there is nothing: the interval holds both, the place is that of one.
        let kind = if *clamp > SURE { Kind::Clamp } else { Kind::Plane };
        all.retain(|tried| tried.kind == kind);
        let Place { mean, mode, .. } = weigh(&all, &weighed)?.place;
        estimate.place = Place { mean, mode, ..estimate.place };
    }
    estimate.kinds = kinds;
    Some(Placed { estimate, tilt })
}

/// How much less several trackers are believed with every further one: measured on chains of two to five segments.
const SHARED: f64 = 0.45;
/// A segment whose largest log likelihood is this much below that on another counts for nothing.
const HOPELESS: f64 = 40.0;
/// How likely a clamp is beforehand, where one is thought possible. Half of the planes stand across the bending plane, half with any tilt.
const CLAMPED: f64 = 0.03;
/// A contact is placed as a plane unless it is a clamp with more than this probability.
const SURE: f64 = 0.95;
/// Steps from the least to the largest tilt that counts.
const STEPS: usize = 24;
/// How far beside the likeliest tilt one is first tried (rad), and how many times farther the next.
const FIRST: f64 = 1e-3;
const FARTHER: f64 = 1.5;
/// A tilt whose log likelihood is this much below the best counts for nothing.
const NEGLIGIBLE: f64 = 12.0;
/// A beginning whose log likelihood is this much below the best has no say in which tilts are tried.
const SLIGHT: f64 = 8.0;

/// Planes of all tilts, each as likely as the others; and the likeliest tilt, rad.
fn tilted(sheets: &[Sheet], parts: u32, grid: &Grid) -> Option<(Tried, f64)> {
    let likeliest = |sheet: &&Sheet| sheet.likeliest(grid).2;
    let best = sheets.iter().max_by(|a, b| likeliest(a).total_cmp(&likeliest(b)))?;
    let (middle, _, most) = *best.likeliest(grid);
    if !most.is_finite() {
        return None;
    }
    let turned = |tilt: f64| tilt - PI * libm::rint((tilt - middle) / PI);
    let [low, high] = ends(best, middle, most, grid);
    // Other beginnings have likeliest tilts of their own, and are about as sure of them.
    let counts = |sheet: &&Sheet| likeliest(sheet) > most - SLIGHT;
    let others = sheets.iter().filter(counts).map(|sheet| turned(sheet.likeliest(grid).0));
    let [first, last] = others.fold([middle, middle], |[first, last], tilt| [first.min(tilt), last.max(tilt)]);
    let (from, to) = (first - (middle - low), last + (high - middle));
    let wide = (to - from).min(PI);
    let step = wide / STEPS as f64;
    let from = if wide < PI { from } else { middle - 0.5 * PI };
    let tilts = (0..STEPS).map(|i| from + (i as f64 + 0.5) * step);
    let rows = tilts.flat_map(|tilt| sheets.iter().map(move |sheet| sheet.at(tilt)));
    let kept = rows.filter(|row| row.most(grid) > most - NEGLIGIBLE).collect();
    // Each stands for a step of the half turn.
    let parts = f64::from(parts) * PI / step;
    Some((Tried { kind: Kind::Plane, rows: kept, parts }, middle - PI * libm::rint(middle / PI)))
}

/// Tilts beside the likeliest one (rad) of planes that began at one instant, beyond which nothing counts: at most a quarter turn away.
fn ends(sheet: &Sheet, middle: f64, most: f64, grid: &Grid) -> [f64; 2] {
    [-1.0, 1.0].map(|side| {
        let mut away = FIRST;
        while away < 0.5 * PI && sheet.at(middle + side * away).most(grid) > most - NEGLIGIBLE {
            away *= FARTHER;
        }
        middle + side * away.min(0.5 * PI)
    })
}
