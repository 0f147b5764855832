//! Which contacts are detectable: for each place and bend at contact, how far the centrode will leave the model's, and how
//! much the load cells may err before the joint forces say nothing.

pub mod chart;
pub mod contour;
mod course;

use super::{Job, Progress};
use crate::chart::csv;
use crate::model::configuration::bend_from_theta_l;
use crate::model::{Configuration, Covector, Segment};
use crate::plant::moved_part;
use crate::scenario::plan::PlannedContact;
use crate::scenario::{Plan, Scenario, ScenarioError};
use course::Course;
use libm::sqrt;

/// Fewest and most cells along a side.
pub const SIDES: (usize, usize) = (2, 1000);

/// Bends in contact at which the joint forces are looked at; what they show grows with the bend.
const FORCE_STEPS: usize = 12;

/// Part of the sharpest bend up to which forces are looked at: at the bend itself they are not defined.
const NEARLY: f64 = 1.0 - 1e-9;

/// The map of a scenario's motion, without noise, of the robot as calibrated: `calibration` plays no part in it, nor does the scenario's
/// own contact.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ContactMap {
    /// Arc lengths s_c of the contact, m: the rows' middles, from the base up.
    pub arc_lengths: Vec<f64>,
    /// Bends φ at contact, rad: the columns' middles, in the order in which the motion passes them.
    pub bends: Vec<f64>,
    /// The largest ‖c_m − c_s‖ that is judged after contact, m, row by row: ξ2 finds the contact when it is smaller.
    /// NaN where nothing is judged, or not computed yet.
    pub deviation: Vec<f64>,
    /// The largest ε_τ at which Θ shows the contact, whatever error within ±ε_τ the cells have in common: Θ then exceeds
    /// ε_c (Eq. 16), below which ξ1 raises false alarms. NaN where no contact is judged, or not computed yet.
    pub epsilon: Vec<f64>,
}

impl ContactMap {
    /// Place of a cell in [`ContactMap::deviation`] and [`ContactMap::epsilon`].
    #[must_use]
    pub fn cell(&self, row: usize, column: usize) -> usize {
        row * self.bends.len() + column
    }

    /// The column and the row nearest to a contact; none outside the map.
    #[must_use]
    pub fn nearest(&self, arc_length: f64, bend: f64) -> Option<(usize, usize)> {
        Some((index(&self.bends, bend)?, index(&self.arc_lengths, arc_length)?))
    }

    /// Every cell as CSV, a row each, units in the header.
    #[must_use]
    pub fn csv(&self) -> String {
        let columns = self.bends.len();
        let row = |cell: usize| {
            let (row, column) = (cell / columns, cell % columns);
            [self.arc_lengths[row], self.bends[column], self.deviation[cell], self.epsilon[cell]]
        };
        let header = ["arc_length [m]", "bend [rad]", "largest_xi2 [m]", "largest_epsilon_tau [1]"];
        csv::table(header, (0..self.deviation.len()).map(row))
    }
}

/// The evenly spaced middle to whose cell a value belongs.
fn index(middles: &[f64], value: f64) -> Option<usize> {
    let (first, last) = (*middles.first()?, *middles.last()?);
    let step = (last - first) / (middles.len() - 1) as f64;
    let place = (value - first) / step + 0.5;
    let inside = place >= -1e-9 && place <= middles.len() as f64 + 1e-9;
    inside.then(|| (place.max(0.0) as usize).min(middles.len() - 1))
}

/// Computes a [`ContactMap`], a row at a time.
#[derive(Debug, Clone)]
pub struct MapJob {
    plan: Plan,
    course: Course,
    map: ContactMap,
    row: usize,
}

impl MapJob {
    /// A map of `columns` bends by `rows` places.
    ///
    /// # Errors
    /// When the scenario is impossible.
    ///
    /// # Panics
    /// When a side is not within [`SIDES`].
    pub fn new(scenario: &Scenario, columns: usize, rows: usize) -> Result<Self, ScenarioError> {
        assert!([columns, rows].iter().all(|n| (SIDES.0..=SIDES.1).contains(n)), "{columns} × {rows} cells");
        let plan = Plan::new(scenario)?;
        let motion = &scenario.motion;
        let (from, to) = (bend_from_theta_l(motion.theta_start), bend_from_theta_l(motion.theta_end));
        let middles = |from: f64, to: f64, count: usize| -> Vec<f64> {
            (0..count).map(|k| from + (to - from) * (k as f64 + 0.5) / count as f64).collect()
        };
        let map = ContactMap {
            arc_lengths: middles(0.0, scenario.robot.length, rows),
            bends: middles(from, to, columns),
            deviation: vec![f64::NAN; columns * rows],
            epsilon: vec![f64::NAN; columns * rows],
        };
        Ok(Self { course: Course::new(&plan), plan, map, row: 0 })
    }

    /// What is computed so far.
    #[must_use]
    pub fn map(&self) -> &ContactMap {
        &self.map
    }
}

impl Job for MapJob {
    fn step(&mut self) {
        let Some(&arc_length) = self.map.arc_lengths.get(self.row) else { return };
        for column in 0..self.map.bends.len() {
            let contact = PlannedContact::beyond(arc_length, self.map.bends[column], self.plan.scenario());
            let cell = self.map.cell(self.row, column);
            self.map.deviation[cell] = self.course.largest_deviation(&contact);
            self.map.epsilon[cell] = largest_epsilon(&self.plan, &contact);
        }
        self.row += 1;
    }

    fn progress(&self) -> Progress {
        Progress { done: self.row as u64, of: self.map.arc_lengths.len() as u64 }
    }
}

/// The largest deviation that the centrode of a contact reaches, m; see [`ContactMap::deviation`].
#[must_use]
pub fn largest_deviation(plan: &Plan, contact: &PlannedContact) -> f64 {
    Course::new(plan).largest_deviation(contact)
}

/// The largest error of the load cells with which a contact is found; see [`ContactMap::epsilon`].
#[must_use]
pub fn largest_epsilon(plan: &Plan, contact: &PlannedContact) -> f64 {
    let scenario = plan.scenario();
    let motion = &scenario.motion;
    let bend_at = |time: f64| bend_from_theta_l(crate::scenario::motion::command(motion, time).0);
    if scenario.detection.armed_from > motion.end {
        return f64::NAN;
    }
    // The motion is monotone: from arming on it passes all bends between these two. Of them count those in contact, up
    // to where the part above the beam would leave a backbone no length.
    let (armed, last) = (bend_at(scenario.detection.armed_from), bend_at(motion.end));
    let segment = plan.segment();
    let (mut low, mut high) = (armed.min(last), armed.max(last));
    if contact.touch.is_none() {
        let lower = contact.bend * (contact.arc_length / segment.length);
        let sharpest = (segment.length - contact.arc_length) / segment.pitch_radius * NEARLY;
        (low, high) = ((lower - sharpest).max(low), (lower + sharpest).min(high));
    }
    if contact.side > 0.0 {
        low = low.max(contact.bend)
    } else {
        high = high.min(contact.bend)
    }
    let plane = Configuration::new(0.0, motion.delta);
    let bends = (0..=FORCE_STEPS).map(|k| low + (high - low) * (k as f64 / FORCE_STEPS as f64));
    let held = bends.filter(|&bend| low <= high && contact.holds_at(bend));
    held.filter_map(|bend| shown_epsilon(segment, contact, plane.with_bend(bend))).fold(f64::NAN, f64::max)
}

/// The ε_τ up to which one configuration shows the contact; none where its forces are not defined.
///
/// With an error ε common to the cells, Θ > ε_c reads ‖g − (1 − ε)∇E‖ > ε_τ‖g‖, where g = J_qψᵀτ is what the true joint
/// forces do. A contact stiffens the robot, so ε = −ε_τ hides it best: ‖d‖² − 2 ε_τ d·∇E + ε_τ²(‖∇E‖² − ‖g‖²) = 0, with
/// d = g − ∇E, is where it is lost.
fn shown_epsilon(segment: &Segment, contact: &PlannedContact, configuration: Configuration) -> Option<f64> {
    let (part, shape) = moved_part(segment, Some(contact), configuration);
    if part.shortest_backbone(shape.bend()) <= 0.0 {
        return None;
    }
    let model = segment.energy_gradient(&configuration);
    // J_qψᵀ of the commanded configuration weighs the δ part by its bend, not by that of the part above the beam.
    let forces = Covector { bend: configuration.bend(), ..part.energy_gradient(&shape) };
    let difference = forces.minus(&model);
    let dot = |a: &Covector, b: &Covector| a.theta_l * b.theta_l + a.delta() * b.delta();
    let (half, constant) = (dot(&difference, &model), difference.norm_squared());
    // ‖∇E‖² − ‖g‖² = −d·(∇E + g), without the cancellation.
    let square = -(dot(&difference, &model) + dot(&difference, &forces));
    if constant == 0.0 {
        return Some(0.0);
    }
    // The smallest positive root of square·x² − 2 half·x + constant.
    let root = sqrt((half * half - square * constant).max(0.0));
    Some(constant / (half + root))
}
