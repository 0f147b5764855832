//! Where on a chain a contact is: what its trackers say of it together.

use super::ensemble::Listens;
use super::filter::Signature;
use super::likelihood::{Base, Began, Grid, Row};
use super::marginal::{Estimate, Place, Tried, Weighed, likeliest, rows, weigh};
use super::sheet::{Sheet, Softness, WIDE};
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
    /// The segment, from 0.
    pub segment: usize,
    /// Its length, m.
    pub length: f64,
    /// The commands of its readings.
    pub commands: &'a [Command],
    /// Errors of its calibration before the contact, in their own units, and their standard deviations.
    pub calibration: [[f64; STATES]; 2],
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
pub fn estimate<H: Hypotheses>(heard: &impl Listens, hypotheses: &H, question: &Question) -> Option<Placed> {
    let base = if question.segment == 0 { Base::Stays } else { Base::Moves };
    let grid = Grid::coarse(base);
    let (seeing, softness) = (hypotheses.seen_by(), hypotheses.softness());
    let known: RefCell<BTreeMap<usize, Sheet>> = RefCell::default();
    let made = |at: f64| {
        let met = hypotheses.met(at);
        Sheet::new(at, heard.hear(at, seeing, |tracker, k| met.planes(tracker, k)).doubted(question.doubt), softness)
    };
    let sheet = |(whole, part): (usize, f64)| {
        if part > 0.0 {
            return made(whole as f64 + part);
        }
        let known_already = known.borrow().get(&whole).cloned();
        known_already.unwrap_or_else(|| {
            let sheet = made(whole as f64);
            known.borrow_mut().insert(whole, sheet.clone());
            sheet
        })
    };
    let began = likeliest(question.beginnings, |began| sheet((began, 0.0)).largest(&grid))?;
    let (sheets, parts) = rows(sheet, question.beginnings, began, question.parts, &grid);
    let (planes, tilt) = tilted(&sheets, parts, &grid)?;
    let across: Vec<Row> = sheets.iter().map(|sheet| sheet.at(0.0)).collect();
    let mut all = vec![planes, Tried { kind: Kind::Plane, rows: across, parts: f64::from(parts) }];
    let mut shares = vec![0.5, 0.5];
    if hypotheses.may_clamp() {
        let clamp = |(whole, part): (usize, f64)| {
            let (at, met) = (whole as f64 + part, hypotheses.met(whole as f64 + part));
            heard.hear(at, seeing, |tracker, k| met.clamps(tracker, k)).doubted(question.doubt).row(at)
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
    let beginnings = question.beginnings.len();
    let Question { length, commands, calibration, .. } = *question;
    let weighed = Weighed { base, length, commands, beginnings, calibration };
    // One segment against another is weighed by all that was heard. What trackers learn of the calibration they learn from noise that they share:
    // of the place, several are believed no more than they are on average.
    let Estimate { ratio, evidence, .. } = weigh(&all, &weighed)?;
    for tried in &mut all {
        tried.rows.iter_mut().for_each(|row| *row = row.told(1.0 / seeing as f64));
    }
    let mut estimate = Estimate { ratio, evidence, ..weigh(&all, &weighed)? };
    let mut kinds: Vec<(Kind, f64)> = Vec::new();
    for (kind, share) in &estimate.kinds {
        match kinds.iter_mut().find(|(known, _)| known == kind) {
            Some((_, sum)) => *sum += share,
            None => kinds.push((*kind, *share)),
        }
    }
    if let [_, _, ..] = kinds[..]
        && let Some((likeliest, _)) = kinds.iter().max_by(|a, b| a.1.total_cmp(&b.1))
    {
        // Between where a plane would be and where a clamp would be there is nothing: the interval holds both, the place is that of one.
        all.retain(|tried| tried.kind == *likeliest);
        let Place { mean, mode, .. } = weigh(&all, &weighed)?.place;
        estimate.place = Place { mean, mode, ..estimate.place };
    }
    estimate.kinds = kinds;
    Some(Placed { estimate, tilt })
}

/// How likely a clamp is beforehand, where one is thought possible. Half of the planes stand across the bending plane, half with any tilt.
const CLAMPED: f64 = 0.03;
/// Tilts are first tried at so many steps over half a turn.
const STEPS: usize = 24;
/// So often their steps are made smaller, at most.
const FINER: usize = 4;
/// As long as fewer of them count than this.
const ENOUGH: usize = 10;
/// A tilt whose log likelihood is this much below the best counts for nothing.
const NEGLIGIBLE: f64 = 20.0;

/// Planes of all tilts, each as likely as the others; and the likeliest tilt, rad.
fn tilted(sheets: &[Sheet], parts: u32, grid: &Grid) -> Option<(Tried, f64)> {
    let looks = sheets.iter().map(|sheet| sheet.likeliest(grid));
    let (middle, ..) = looks.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let (mut step, mut count) = (PI / STEPS as f64, STEPS);
    let mut from = middle - 0.5 * (STEPS + 1) as f64 * step;
    for finer in 0.. {
        let tilts: Vec<f64> = (0..count).map(|i| from + (i as f64 + 0.5) * step).collect();
        let rows: Vec<Vec<(f64, Row)>> = tilts
            .iter()
            .map(|tilt| sheets.iter().map(|sheet| sheet.at(*tilt)).map(|row| (row.most(grid), row)).collect())
            .collect();
        let most: Vec<f64> =
            rows.iter().map(|rows| rows.iter().map(|(most, _)| *most).fold(f64::NEG_INFINITY, f64::max)).collect();
        let (likeliest, best) = most.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        if !best.is_finite() {
            return None;
        }
        let counts = |most: &f64| *most > best - NEGLIGIBLE;
        let [first, last] = [most.iter().position(counts)?, most.iter().rposition(counts)?];
        if finer == FINER || last - first >= ENOUGH {
            let kept = rows.into_iter().flatten().filter(|(most, _)| counts(most)).map(|(_, row)| row).collect();
            // Each stands for a step of the half turn.
            let parts = f64::from(parts) * PI / step;
            let turns = libm::rint(tilts[likeliest] / PI);
            return Some((Tried { kind: Kind::Plane, rows: kept, parts }, tilts[likeliest] - PI * turns));
        }
        // With what lies just beside them.
        let wide = (last - first + 3) as f64 * step;
        from += (first as f64 - 1.0) * step;
        (count, step) = (STEPS, wide / STEPS as f64);
    }
    None
}
