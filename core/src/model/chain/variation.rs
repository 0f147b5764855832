//! How points of the backbone move by the terms of its curvature, to second order.
//!
//! A change δu of curvature at s turns all that lies above by R δu: a frame at p moves by ω = ∫ R δu, v = ∫ R δu × (p − p(s)).

use super::free::NONE;
use super::modes::Layout;
use super::shape::{Shape, sum};
use crate::model::{Mat3, Twist, Vec3};
use nalgebra::DMatrix;

/// A term's effect on what lies above.
#[derive(Debug, Clone)]
struct Column {
    /// W = ∫ R δu from the base to each node of the term's own pieces.
    until: Vec<Vec3>,
    /// R δu at each of these nodes, times the node's share of arc length.
    turns: Vec<Vec3>,
    /// ∫ R δu from the base to the end of each of these pieces, and ∫ R δu × p.
    angular: Vec<Vec3>,
    moment: Vec<Vec3>,
}

/// Those of every term of a layout, at a shape.
#[derive(Debug, Clone)]
pub(super) struct Variation<'a> {
    layout: &'a Layout,
    shape: &'a Shape,
    columns: Vec<Column>,
}

/// A point that is pushed: at the end of a piece, with a force of this size along −n.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push {
    pub piece: usize,
    pub normal: Vec3,
    pub force: f64,
}

impl<'a> Variation<'a> {
    pub fn new(layout: &'a Layout, shape: &'a Shape) -> Self {
        let columns = (0..layout.modes.len()).map(|mode| Column::new(layout, shape, mode)).collect();
        Self { layout, shape, columns }
    }

    /// The motion of the end of a piece by a term.
    pub fn motion(&self, mode: usize, piece: usize) -> Twist {
        let (pieces, column) = (&self.layout.modes[mode].pieces, &self.columns[mode]);
        if piece < pieces.start {
            return NONE;
        }
        let last = piece.min(pieces.end - 1) - pieces.start;
        let (angular, moment) = (column.angular[last], column.moment[last]);
        Twist { linear: angular.cross(&self.shape.ends[piece].position) - moment, angular }
    }

    /// Second derivatives of Σ F n·p by all terms: rows of x, columns of x and of U.
    pub fn second(&self, pushes: &[Push]) -> DMatrix<f64> {
        let (unknowns, all) = (self.layout.unknowns, self.columns.len());
        let couples = self.couples(pushes);
        let loads: Vec<Load> = (0..all).map(|mode| self.load(mode, &couples)).collect();
        let mut second = DMatrix::zeros(unknowns, all);
        for (j, load) in loads.iter().enumerate() {
            for i in 0..=j.min(unknowns - 1) {
                second[(i, j)] = self.half(i, j, load) + self.half(j, i, &loads[i]);
                if j < unknowns {
                    second[(j, i)] = second[(i, j)];
                }
            }
        }
        second
    }

    /// Σ F [r nᵀ − (r·n) 1] at each node, r from the node to each point pushed above it.
    fn couples(&self, pushes: &[Push]) -> Vec<Mat3> {
        let count = self.layout.gauss.count();
        let at = |(node, position): (usize, &Vec3)| {
            let above = pushes.iter().filter(|push| push.piece >= node / count);
            above.fold(Mat3::zeros(), |sum, push| {
                let arm = self.shape.ends[push.piece].position - position;
                sum + (arm * push.normal.transpose() - Mat3::from_diagonal_element(arm.dot(&push.normal))) * push.force
            })
        };
        self.shape.positions.iter().enumerate().map(at).collect()
    }

    fn load(&self, mode: usize, couples: &[Mat3]) -> Load {
        let count = self.layout.gauss.count();
        let first = self.layout.modes[mode].pieces.start * count;
        let turns = &self.columns[mode].turns;
        let nodes: Vec<Vec3> = couples[first..].iter().zip(turns).map(|(couple, turn)| couple * turn).collect();
        let pieces = nodes.chunks_exact(count).map(|piece| piece.iter().sum()).collect();
        Load { nodes, pieces }
    }

    /// ∫ W_i · K R δu_j: the part in which i lies below j.
    fn half(&self, i: usize, j: usize, load: &Load) -> f64 {
        let count = self.layout.gauss.count();
        let (below, above) = (&self.layout.modes[i].pieces, &self.layout.modes[j].pieces);
        let column = &self.columns[i];
        let mut half = 0.0;
        for piece in above.start.max(below.start)..above.end {
            let at = piece - above.start;
            if piece < below.end {
                let (own, other) = ((piece - below.start) * count, at * count);
                let nodes = column.until[own..own + count].iter().zip(&load.nodes[other..other + count]);
                half += nodes.map(|(turned, load)| turned.dot(load)).sum::<f64>();
            } else {
                half += column.whole().dot(&load.pieces[at]);
            }
        }
        half
    }
}

/// K R δu of a term at its nodes, and over each of its pieces.
struct Load {
    nodes: Vec<Vec3>,
    pieces: Vec<Vec3>,
}

impl Column {
    fn new(layout: &Layout, shape: &Shape, mode: usize) -> Self {
        let (gauss, mode) = (&layout.gauss, &layout.modes[mode]);
        let count = gauss.count();
        let nodes = mode.values.len();
        let mut column = Self {
            until: Vec::with_capacity(nodes),
            turns: Vec::with_capacity(nodes),
            angular: Vec::with_capacity(mode.pieces.len()),
            moment: Vec::with_capacity(mode.pieces.len()),
        };
        let (mut base, mut moment) = (Vec3::zeros(), Vec3::zeros());
        for (piece, values) in mode.pieces.clone().zip(mode.values.chunks_exact(count)) {
            let (first, length) = (piece * count, layout.pieces[piece].length);
            let rotations = &shape.rotations[first..first + count];
            let axes = rotations.iter().zip(values);
            let turns: Vec<Vec3> = axes.map(|(r, value)| r.column(mode.axis) * (value * length)).collect();
            column.until.extend(gauss.until.iter().map(|row| base + sum(row, &turns)));
            let weighted = turns.iter().zip(&gauss.weights).map(|(turn, weight)| turn * *weight);
            column.turns.extend(weighted);
            let turns = &column.turns[column.turns.len() - count..];
            let positions = &shape.positions[first..first + count];
            moment += turns.iter().zip(positions).map(|(turn, position)| turn.cross(position)).sum::<Vec3>();
            base += turns.iter().sum::<Vec3>();
            column.moment.push(moment);
            column.angular.push(base);
        }
        column
    }

    fn whole(&self) -> Vec3 {
        self.angular.last().copied().unwrap_or_default()
    }
}
