//! The generalised likelihood ratio: the best of many contacts, wherever and whenever they may have begun.

use super::course::Flight;
use super::filter::Stage;
use super::{Command, Six};
use std::collections::VecDeque;

/// Places that are tried.
pub const PLACES: usize = 20;
/// A contact is tried to have begun up to so many readings ago.
pub const WINDOW: usize = 100;

/// The places, in units of L: 1/30 to 59/60.
#[must_use]
pub fn places() -> [f64; PLACES] {
    std::array::from_fn(|i| 1.0 / 30.0 + i as f64 / PLACES as f64)
}

/// What each contact adds to an innovation, in the bending plane, with half its square: the oldest contact first, and of each the
/// places in order. The first is new when a contact that is too old has gone.
#[derive(Debug, Clone, PartialEq)]
pub struct Bank {
    added: Box<[[[f32; PLACES]; 4]]>,
    /// Contacts that have gone since the last reading.
    gone: usize,
}

/// Contacts on their way through the filter.
#[derive(Debug, Clone, Default)]
pub(super) struct Flights {
    /// With the reading at which each began, the oldest first.
    flights: VecDeque<(usize, Flight<PLACES>)>,
    reading: usize,
    /// The bend at which the robot rested when the last reading was taken, rad.
    rested: Option<f64>,
}

impl Flights {
    pub(super) fn next(&mut self, stage: &Stage, length: f64, command: &Command) -> Bank {
        let Self { flights, reading, rested } = self;
        let mut gone = 0;
        while flights.front().is_some_and(|(began, _)| began + WINDOW < *reading) {
            flights.pop_front();
            gone += 1;
        }
        // A contact may have begun as the motion did, at the last reading at rest.
        let still = command.rate == 0.0;
        if let Some(met) = std::mem::replace(rested, still.then_some(command.bend)).filter(|_| !still) {
            flights.extend(Flight::begin(&Command { bend: met, ..*command }).map(|flight| (*reading - 1, flight)));
        }
        let places = places();
        let added = |(_, flight): &mut (usize, Flight<PLACES>)| {
            let seen = flight.step(stage, length, command.bend, &places);
            let half = |i: usize| 0.5 * seen.iter().map(|axis| axis[i] * axis[i]).sum::<f64>();
            let [a, b, c] = seen.map(|axis| axis.map(|w| w as f32));
            [a, b, c, std::array::from_fn(|i| half(i) as f32)]
        };
        let bank = Bank { added: flights.iter_mut().map(added).collect(), gone };
        if let Some(flight) = Flight::begin(command) {
            flights.push_back((*reading, flight));
        }
        *reading += 1;
        bank
    }
}

/// The log likelihood ratios of one run.
#[derive(Debug, Clone, Default)]
pub struct Glr {
    sums: VecDeque<[f64; PLACES]>,
}

impl Glr {
    /// Takes the innovation of the next reading, and returns the largest log likelihood ratio (natural); 0 where no contact can have
    /// begun.
    pub fn step(&mut self, bank: &Bank, innovation: &Six) -> f64 {
        self.sums.drain(..bank.gone.min(self.sums.len()));
        self.sums.resize(bank.added.len(), [0.0; PLACES]);
        let [a, b, c] = [innovation[0], innovation[1], innovation[2]];
        let mut most = f64::NEG_INFINITY;
        for (sums, [x, y, z, half]) in self.sums.iter_mut().zip(&bank.added) {
            for i in 0..PLACES {
                sums[i] += f64::from(x[i]) * a + f64::from(y[i]) * b + f64::from(z[i]) * c - f64::from(half[i]);
            }
            // Without a branch on what is not a number: sums are numbers.
            most = sums.iter().fold(most, |most, sum| if *sum > most { *sum } else { most });
        }
        if most.is_finite() { most } else { 0.0 }
    }
}
