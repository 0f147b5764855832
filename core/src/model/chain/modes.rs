//! What the curvature of a chain is a sum of.
//!
//! Contacts and segment ends cut the backbone below the last contact into pieces, between which the curvature may jump in its
//! slope. On each piece it is a sum of Legendre polynomials; what lies above the last contact is an arc that does not twist. The
//! terms are scaled and combined so that the elastic energy is ½ Σ|U_i|² EI_i/L_i + ½|x|² of their factors x, whatever x is,
//! and the joints' integrals U stay what they are: stiffness is then the identity, and what is left is geometry.

use super::gauss::Gauss;
use super::{Bends, Contact, Rod, Torsion};
use libm::{ceil, sqrt};
use nalgebra::DVector;
use std::ops::Range;

/// A piece bends by at most this much (rad) before anything presses: beyond, more terms would be needed than a cut costs.
const BEND_OF_A_PIECE: f64 = 2.0;

/// A part of the backbone below the last contact. Lengths in units of the whole chain's.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub length: f64,
}

/// A term of the curvature: about one axis of the cross section, on some successive pieces.
#[derive(Debug, Clone)]
pub(super) struct Mode {
    /// 0 and 1 bend about x and y, 2 twists.
    pub axis: usize,
    pub pieces: Range<usize>,
    /// Of the Legendre polynomial; none for what moves bend from piece to piece, or is constant.
    order: Option<usize>,
    /// Curvature per factor at each node of these pieces.
    pub values: Vec<f64>,
}

/// The rest of a segment above the last contact: an arc.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    /// In units of the whole chain's length.
    pub length: f64,
    /// Share of the segment's length.
    pub share: f64,
    /// The two modes that move bend between this arc and what lies below it, about x and y.
    pub modes: [usize; 2],
    /// What such a mode adds to the arc's own bend, per factor.
    pub bend: f64,
}

/// The pieces and all terms on them.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub gauss: Gauss,
    pub pieces: Vec<Piece>,
    /// Those of x first, then two for each segment with pieces: constant curvature, per U.
    pub modes: Vec<Mode>,
    /// How many are of x.
    pub unknowns: usize,
    pub rest: Option<Rest>,
    /// The piece at whose end each contact is.
    pub contacts: Vec<usize>,
    /// The first mode of the highest terms kept, and how many x has of them: what shows whether they suffice.
    highest: Vec<(usize, f64)>,
}

/// Lengths over the chain's, stiffnesses over the stiffest segment's; forces follow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    pub length: f64,
    pub stiffness: f64,
}

impl Units {
    pub fn of(rods: &[Rod]) -> Self {
        Self {
            length: rods.iter().map(|rod| rod.length).sum(),
            stiffness: rods.iter().map(|rod| rod.bending_stiffness).fold(0.0, f64::max),
        }
    }

    pub fn force(self) -> f64 {
        self.stiffness / (self.length * self.length)
    }

    pub fn moment(self) -> f64 {
        self.stiffness / self.length
    }
}

impl Layout {
    /// With Legendre terms up to `terms` on each piece. There is at least one contact.
    pub fn new(rods: &[Rod], bends: &[Bends], contacts: &[Contact], terms: usize) -> Self {
        let last = contacts.iter().map(|contact| contact.segment).max().unwrap_or(0);
        let mut layout = Self {
            gauss: Gauss::new(terms),
            pieces: Vec::new(),
            modes: Vec::new(),
            unknowns: 0,
            rest: None,
            contacts: vec![0; contacts.len()],
            highest: Vec::new(),
        };
        let units = Units::of(rods);
        let segments: Vec<Range<usize>> = (0..=last)
            .map(|segment| {
                let first = layout.pieces.len();
                let rest = layout.cut(rods, bends, contacts, segment, segment == last);
                layout.add_modes(&rods[segment], units, first, rest);
                if rest > 0.0 {
                    layout.set_rest(&rods[segment], units, rest);
                }
                first..layout.pieces.len()
            })
            .collect();
        layout.unknowns = layout.modes.len();
        for (segment, pieces) in segments.into_iter().enumerate() {
            let curvature = units.length / rods[segment].length;
            for axis in 0..2 {
                let values = vec![curvature; pieces.len() * layout.gauss.count()];
                layout.modes.push(Mode { axis, pieces: pieces.clone(), order: None, values });
            }
        }
        layout
    }

    /// Adds a segment's pieces; what is left of it above the last contact.
    fn cut(&mut self, rods: &[Rod], bends: &[Bends], contacts: &[Contact], segment: usize, last: bool) -> f64 {
        let (rod, whole) = (&rods[segment], Units::of(rods).length);
        let mut places: Vec<f64> =
            contacts.iter().filter(|contact| contact.segment == segment).map(|contact| contact.at).collect();
        if !last {
            places.push(rod.length);
        }
        places.sort_by(f64::total_cmp);
        places.dedup();
        let mut from = 0.0;
        for place in places {
            let length = place - from;
            let parts = ceil(bends[segment].norm() * length / rod.length / BEND_OF_A_PIECE).max(1.0);
            let piece = Piece { length: length / parts / whole };
            self.pieces.extend(std::iter::repeat_n(piece, parts as usize));
            let end = self.pieces.len() - 1;
            let here = contacts.iter().zip(&mut self.contacts);
            here.filter(|(contact, _)| contact.segment == segment && contact.at == place)
                .for_each(|(_, piece)| *piece = end);
            from = place;
        }
        ((rod.length - from) / whole).max(0.0)
    }

    /// Adds the terms of a segment whose pieces begin with `first`, with a `rest` above them.
    fn add_modes(&mut self, rod: &Rod, units: Units, first: usize, rest: f64) {
        let bending = rod.bending_stiffness / units.stiffness;
        for piece in first..self.pieces.len() {
            for axis in 0..2 {
                self.add_legendre(piece, axis, bending, 1);
            }
            if let Torsion::Ratio(ratio) = rod.torsion {
                self.add_legendre(piece, 2, bending * ratio, 0);
            }
        }
        let count = self.gauss.count();
        let mut below = 0.0;
        let mut lengths: Vec<f64> = self.pieces[first..].iter().map(|piece| piece.length).collect();
        lengths.extend((rest > 0.0).then_some(rest));
        for (k, &length) in lengths.iter().enumerate() {
            // Bend moves between this piece and all those below it together.
            if k > 0 {
                let scale = 1.0 / sqrt(bending * (1.0 / below + 1.0 / length));
                let pieces = first..(first + k + 1).min(self.pieces.len());
                let mut values = vec![scale / below; k * count];
                values.resize(pieces.len() * count, -scale / length);
                for axis in 0..2 {
                    self.modes.push(Mode { axis, pieces: pieces.clone(), order: None, values: values.clone() });
                }
            }
            below += length;
        }
    }

    /// The Legendre terms of one piece about one axis, each with the energy ½x².
    fn add_legendre(&mut self, piece: usize, axis: usize, stiffness: f64, from: usize) {
        let length = self.pieces[piece].length;
        for j in from..=self.gauss.modes {
            let order = 2.0 * j as f64 + 1.0;
            let scale = sqrt(order / (stiffness * length));
            let values = self.gauss.legendre.iter().map(|p| scale * p[j]).collect();
            if j + 2 > self.gauss.modes {
                self.highest.push((self.modes.len(), scale * length));
            }
            self.modes.push(Mode { axis, pieces: piece..piece + 1, order: Some(j), values });
        }
    }

    fn set_rest(&mut self, rod: &Rod, units: Units, length: f64) {
        let (stiffness, whole) = (rod.bending_stiffness / units.stiffness, rod.length / units.length);
        let bend = -1.0 / sqrt(stiffness * (1.0 / (whole - length) + 1.0 / length));
        // They were added last.
        let modes = [self.modes.len() - 2, self.modes.len() - 1];
        self.rest = Some(Rest { length, share: length / whole, modes, bend });
    }

    /// The column of U about an axis of a segment, among the modes.
    pub fn column(&self, segment: usize, axis: usize) -> usize {
        self.unknowns + 2 * segment + axis
    }

    /// How many segments have pieces.
    pub fn segments(&self) -> usize {
        (self.modes.len() - self.unknowns) / 2
    }

    /// The last piece of a segment.
    pub fn last_piece(&self, segment: usize) -> usize {
        self.modes[self.column(segment, 0)].pieces.end - 1
    }

    /// The factors x of a layout of the same pieces with fewer terms, as this one has them.
    pub fn carried(&self, from: &Self, x: &DVector<f64>) -> DVector<f64> {
        let same = |a: &Mode, b: &Mode| (a.axis, a.order, &a.pieces) == (b.axis, b.order, &b.pieces);
        DVector::from_fn(self.unknowns, |i, _| {
            let old = from.modes[..from.unknowns].iter().position(|mode| same(mode, &self.modes[i]));
            old.map_or(0.0, |old| x[old])
        })
    }

    /// The largest bend (rad) that one of the highest two terms of a piece makes: what is left out is smaller still.
    pub fn tail(&self, x: &DVector<f64>) -> f64 {
        self.highest.iter().map(|(mode, bend)| (x[*mode] * bend).abs()).fold(0.0, f64::max)
    }
}
