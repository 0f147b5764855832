//! Notices that a contact has been left, and takes the filter back to what it knew before it.
//!
//! A contact is learned as if it were an error of the calibration. So what was known before it is kept, and each reading is compared with it
//! once the robot has bent back to where the contact began, for a beam holds what is bent beyond it: if the readings are then again what a
//! free robot would give, the contact is over, and what was learned meanwhile is forgotten.

use super::course::{Model, Moment};
use super::filter::{Designer, Filter, Square};
use super::linear::Linear;
use super::{DRIFT, STATES, Six, States};
use std::collections::VecDeque;

/// A cumulative sum as large as this tells of a contact without a doubt.
const CERTAIN: f64 = 25.0;
/// So far beyond the bend at which a contact seems to have begun, rad, it may have begun in truth; beside the freedom of the bend.
const MARGIN: f64 = 0.02;
/// Readings over which differences from the free robot are averaged.
const READINGS: usize = 10;
/// So many times what it was before the contact, a difference stands out, …
const OUT: f64 = 2.0;
/// … and is as if there were none.
const BACK: f64 = 1.5;

/// What was known after a reading.
#[derive(Debug, Clone, PartialEq)]
struct Known {
    states: States,
    covariance: Square,
    reading: usize,
    /// The bend, rad.
    bend: f64,
}

/// What a filter goes on with after a contact.
#[derive(Debug, Clone)]
pub struct Release {
    /// The estimate.
    pub filter: Filter,
    /// Makes the stages of the readings from now on.
    pub designer: Designer,
    /// The first and the last reading that count for nothing, counted from 0.
    pub forgotten: [usize; 2],
}

/// Waits for a contact to be left.
#[derive(Debug, Clone, Default)]
pub struct Vigil {
    readings: usize,
    known: Option<Known>,
    /// Sum of squared innovations outside contacts, and their number.
    calm: (f64, u32),
    recent: VecDeque<f64>,
    stood_out: bool,
    /// To which side the robot has bent since the contact began: +1 where the bend grew.
    side: f64,
}

impl Vigil {
    /// Takes what a filter has made of a reading; returns what it is to go on with where a contact has been left.
    pub fn look(
        &mut self,
        model: &Model,
        moment: &Moment,
        filter: &Filter,
        (innovation, residual, cusum): (&Six, &Six, f64),
    ) -> Option<Release> {
        let reading = self.readings;
        self.readings += 1;
        if cusum < CERTAIN {
            self.recent.clear();
            (self.stood_out, self.side) = (false, 0.0);
            self.calm.0 += innovation.norm_squared();
            self.calm.1 += 1;
            if cusum == 0.0 {
                let (states, covariance, bend) = (filter.states, moment.covariance, moment.command.bend);
                self.known = Some(Known { states, covariance, reading, bend });
            }
            return None;
        }
        let known = self.known.as_ref()?;
        let beyond = moment.command.bend - known.bend;
        if self.side == 0.0 {
            self.side = beyond.signum();
        }
        // At rest nothing is left.
        if moment.command.rate == 0.0 {
            return None;
        }
        let mut designer = known.resumed(model);
        let filter = Filter::knowing(known.states);
        let stage = designer.next(moment.command.time, &Linear::nominal(model.length, &moment.command));
        if self.recent.len() == READINGS {
            self.recent.pop_front();
        }
        self.recent.push_back(filter.clone().step(&stage, residual).norm_squared());
        let level = (self.calm.0 / f64::from(self.calm.1.max(1))).max(6.0);
        let mean = self.recent.iter().sum::<f64>() / READINGS as f64;
        self.stood_out |= mean > OUT * level;
        let returned = self.side * beyond < MARGIN + model.belief.free_bend;
        let back = returned && self.stood_out && self.recent.len() == READINGS && mean < BACK * level;
        if !back {
            return None;
        }
        let release = Release { filter, designer: known.resumed(model), forgotten: [known.reading + 1, reading] };
        *self = Self { readings: self.readings, calm: self.calm, ..Self::default() };
        Some(release)
    }
}

impl Known {
    /// What makes the stages of later readings; of a drift nothing is known any more.
    fn resumed(&self, model: &Model) -> Designer {
        let mut covariance = self.covariance;
        for i in DRIFT..STATES {
            covariance.row_mut(i).fill(0.0);
            covariance.column_mut(i).fill(0.0);
            covariance[(i, i)] = 1.0;
        }
        Designer::resumed(&model.belief, model.noise, covariance)
    }
}
