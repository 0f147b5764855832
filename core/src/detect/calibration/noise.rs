//! What readings say of their own noise: its size while the robot stands still, and whether innovations are white.

use super::filter::{drifts, kept};
use super::linear::Linear;
use super::{Belief, Command, DRIFT, Noise, Six};
use crate::model::Pose;
use libm::{exp, log, sqrt};

/// Fewer still readings than this say too little of their noise.
pub const STILL: usize = 20;
/// Noise is never taken for less: a tracker without any still rounds.
pub const FLOOR: Noise = Noise { position: 5e-6, orientation: 2e-5, colour: 0.0 };

/// What noise is never taken for less than where the tracker rounds to these steps (m, rad): no step is known better than by an even
/// deviation within it.
#[must_use]
pub fn floor(position: f64, orientation: f64) -> Noise {
    let even = |step: f64| step / sqrt(12.0);
    Noise {
        position: even(position).max(FLOOR.position),
        orientation: even(orientation).max(FLOOR.orientation),
        colour: 0.0,
    }
}
/// A correlation below this many of its standard errors is taken for none.
const PLAIN: f64 = 3.0;
const MOST: f64 = 0.99;

/// More are not looked at.
const ENOUGH: usize = 10_000;

/// Commands that stay within this of the first, rad, may be those of an encoder at rest.
const JITTER: f64 = 5e-4;
/// They are, where their changes add up to so many times what they come to.
const TO_AND_FRO: f64 = 3.0;

/// How many readings were taken before the robot first moved, or enough of them. Where commands never stand still, as those of an
/// encoder, it is at rest while they stay near the first.
#[must_use]
pub fn still(commands: &[Command]) -> usize {
    let first = &commands[..commands.len().min(ENOUGH + 1)];
    let moved = |pair: &[Command]| pair[0].bend != pair[1].bend || pair[1].rate != 0.0;
    let exactly = first.windows(2).position(moved).map(|last| last + 1);
    let until = exactly.unwrap_or(first.len()).min(ENOUGH);
    if until >= STILL || until == first.len() {
        return until;
    }
    let near = first.iter().take_while(|command| (command.bend - first[0].bend).abs() <= JITTER).count();
    // What starts slowly goes one way, what is read at rest to and fro.
    let gone: f64 = first[..near].windows(2).map(|pair| (pair[1].bend - pair[0].bend).abs()).sum();
    let net = (first[near - 1].bend - first[0].bend).abs();
    if gone > TO_AND_FRO * net { near.min(ENOUGH) } else { until }
}

/// Noise of readings that were taken while the robot stood still; `None` where there are fewer than [`STILL`].
///
/// The correlation is that of successive readings, and none where it may be by chance; what varies less than the floor is rounding, which
/// may have any. Where the tracker is thought to drift, the
/// deviations are those of successive differences, less what drift adds to them, and what is left is taken for white. Nothing is
/// below `least` (see [`floor`]).
#[must_use]
pub fn measured(length: f64, belief: &Belief, least: &Noise, commands: &[Command], readings: &[Pose]) -> Option<Noise> {
    let command = commands.first()?;
    if readings.len() < STILL {
        return None;
    }
    let linear = Linear::nominal(length, command);
    let all: Vec<Six> = readings.iter().map(|reading| linear.residual(reading)).collect();
    let count = all.len() as f64;
    let mean = all.iter().sum::<Six>() / count;
    let (mut squares, mut products) = (Six::zeros(), Six::zeros());
    for (k, residual) in all.iter().enumerate() {
        let off = residual - mean;
        squares += off.component_mul(&off);
        if k > 0 {
            products += off.component_mul(&(all[k - 1] - mean));
        }
    }
    let places = [1, 2, 3];
    let turns = [0, 4, 5];
    let variance = |of: [usize; 3]| of.iter().map(|&i| squares[i]).sum::<f64>() / (3.0 * (count - 1.0));
    let floor = |i: usize| if places.contains(&i) { least.position } else { least.orientation };
    let varies = |&i: &usize| squares[i] > floor(i) * floor(i) * count;
    let shares: Vec<f64> = (0..6).filter(varies).map(|i| products[i] / squares[i]).collect();
    let share = if shares.is_empty() { 0.0 } else { shares.iter().sum::<f64>() / shares.len() as f64 };
    // Taking the mean away makes the correlation come out lower by about (1 + 3ρ)/n.
    let colour = share + (1.0 + 3.0 * share) / count;
    let error = 1.0 / sqrt(shares.len().max(1) as f64 * count);
    let colour = if colour > PLAIN * error { colour.min(MOST) } else { 0.0 };
    if drifts(belief) {
        let steps = |of: [usize; 3]| {
            let square =
                |pair: &[Six]| of.iter().map(|&i| (pair[1][i] - pair[0][i]) * (pair[1][i] - pair[0][i])).sum::<f64>();
            all.windows(2).map(square).sum::<f64>() / (6.0 * (count - 1.0))
        };
        let interval = (commands.last()?.time - command.time) / (commands.len().max(2) - 1) as f64;
        let drift = belief.deviations[DRIFT..].iter().map(|sigma| sigma * sigma).sum::<f64>() / 3.0;
        let place = steps(places) - drift * (1.0 - kept(belief, interval));
        let (position, orientation) = (sqrt(place.max(0.0)), sqrt(steps(turns)));
        let (position, orientation) = (position.max(least.position), orientation.max(least.orientation));
        return Some(Noise { position, orientation, colour: 0.0 });
    }
    Some(Noise {
        position: sqrt(variance(places)).max(least.position),
        orientation: sqrt(variance(turns)).max(least.orientation),
        colour,
    })
}

/// A test of whether innovations are white.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Whiteness {
    /// Ljung and Box's Q: n(n + 2) Σ ρ̂²/(n − lag), summed over components and lags.
    pub statistic: f64,
    /// How many terms it has: the mean of Q for white innovations.
    pub degrees: usize,
    /// How often white innovations give as much.
    pub p_value: f64,
}

/// Lags that are looked at.
const LAGS: usize = 10;
/// Below this p-value innovations are not taken for white.
pub const SUSPECT: f64 = 1e-3;

impl Whiteness {
    /// Of successive innovations. `None` of fewer than ten times the lags, or where they are all zero.
    ///
    /// The first component is left out: it has the freedom of the bend, which may be as coloured as it likes.
    #[must_use]
    pub fn of(innovations: &[Six]) -> Option<Self> {
        let count = innovations.len();
        if count < 10 * LAGS {
            return None;
        }
        let (mut statistic, mut degrees) = (0.0, 0);
        for i in 1..6 {
            let mean = innovations.iter().map(|nu| nu[i]).sum::<f64>() / count as f64;
            let off: Vec<f64> = innovations.iter().map(|nu| nu[i] - mean).collect();
            let square: f64 = off.iter().map(|x| x * x).sum();
            // What is far below the noise that was assumed is rounding, and may have any colour.
            if square < 1e-6 * count as f64 {
                continue;
            }
            for lag in 1..=LAGS {
                let share = off.iter().zip(&off[lag..]).map(|(a, b)| a * b).sum::<f64>() / square;
                statistic += share * share / (count - lag) as f64;
            }
            degrees += LAGS;
        }
        if degrees == 0 {
            return None;
        }
        let count = count as f64;
        let statistic = statistic * count * (count + 2.0);
        Some(Self { statistic, degrees, p_value: exceeded(statistic, degrees) })
    }

    /// Whether innovations are too coloured for the detector's thresholds and intervals to be believed.
    #[must_use]
    pub fn fails(&self) -> bool {
        self.p_value < SUSPECT
    }
}

/// How often a χ² variable of an even number of degrees of freedom exceeds a value: e^{−x} Σ xⁱ/i! with x half the value.
fn exceeded(value: f64, degrees: usize) -> f64 {
    let half = 0.5 * value;
    // In logarithms, for a large value takes e^{−x} to zero before its terms have grown.
    let (mut log_term, mut sum) = (-half, 0.0);
    for i in 0..degrees / 2 {
        if i > 0 {
            log_term += log(half / i as f64);
        }
        sum += exp(log_term);
    }
    if half > 0.0 { sum.min(1.0) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::calibration::course::planar;
    use crate::noise::{Normal, Source};

    #[test]
    fn chi_squares_are_exceeded_as_tables_have_it() {
        for (value, degrees, p) in [(3.841_46, 2, 0.146_5), (18.307, 10, 0.05), (76.154, 50, 0.01), (1e5, 50, 0.0)] {
            assert!((exceeded(value, degrees) - p).abs() < 1e-4, "{value} {degrees}: {}", exceeded(value, degrees));
        }
        assert_eq!(exceeded(0.0, 50), 1.0);
    }

    /// Still readings with noise of first order.
    fn still(colour: f64, position: f64, orientation: f64, seed: u64) -> Vec<Pose> {
        let mut normal = Normal::new(seed, Source::Tracker);
        let mut last = [0.0; 3];
        let fresh = sqrt(1.0 - colour * colour);
        (0..300)
            .map(|k| {
                last = last.map(|x| if k == 0 { normal.draw() } else { colour * x + fresh * normal.draw() });
                planar(last[0] * position, 0.03 + last[1] * position, last[2] * orientation)
            })
            .collect()
    }

    #[test]
    fn noise_is_measured_where_the_robot_stands_still() {
        let command = |k: u32| Command { time: 0.01 * f64::from(k), bend: 0.0, rate: 0.0, delta: 0.0 };
        let commands: Vec<_> = (0..300).map(command).collect();
        for (colour, position, orientation) in [(0.0, 5e-5, 2e-4), (0.5, 5e-4, 2e-3), (0.8, 1e-4, 1e-3)] {
            let all: Vec<Noise> = (1..40)
                .map(|seed| still(colour, position, orientation, seed))
                .map(|readings| measured(0.03, &Belief::default(), &FLOOR, &commands, &readings).expect("enough"))
                .collect();
            let mean = |of: fn(&Noise) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
            // Of three coordinates two move, of three angles one.
            let planar = [sqrt(2.0 / 3.0), sqrt(1.0 / 3.0)];
            assert!((mean(|noise| noise.position) / (position * planar[0]) - 1.0).abs() < 0.04, "{all:?}");
            assert!((mean(|noise| noise.orientation) / (orientation * planar[1]) - 1.0).abs() < 0.06, "{all:?}");
            assert!((mean(|noise| noise.colour) - colour).abs() < 0.02, "{colour}: {}", mean(|noise| noise.colour));
        }
        let exact = vec![planar(0.0, 0.03, 0.0); 100];
        assert_eq!(measured(0.03, &Belief::default(), &FLOOR, &commands, &exact), Some(FLOOR));
        assert_eq!(measured(0.03, &Belief::default(), &FLOOR, &commands, &exact[..STILL - 1]), None);
    }

    #[test]
    fn an_encoder_at_rest_stands_still_and_a_slow_start_does_not() {
        let mut normal = Normal::new(3, Source::Tracker);
        let mut commands = |jitter: f64, start: u32| -> Vec<Command> {
            let bend = |k: u32| 1e-5 * f64::from(k.saturating_sub(start) * k.saturating_sub(start));
            let command = |k: u32| Command {
                time: 0.01 * f64::from(k),
                bend: bend(k) + jitter * normal.draw(),
                rate: 0.0,
                delta: 0.0,
            };
            (0..300).map(command).collect()
        };
        assert_eq!(super::still(&commands(0.0, 100)), 101);
        assert!((95..115).contains(&super::still(&commands(1e-4, 100))));
        assert!(super::still(&commands(0.0, 0)) < 3);
        assert_eq!(super::still(&[]), 0);
    }

    #[test]
    fn coloured_innovations_are_told_from_white_ones() {
        let innovations = |colour: f64, seed: u64| -> Vec<Six> {
            let mut normal = Normal::new(seed, Source::Tracker);
            let mut last = Six::zeros();
            let fresh = sqrt(1.0 - colour * colour);
            (0..500)
                .map(|_| {
                    last = last.map(|x| colour * x + fresh * normal.draw());
                    last
                })
                .collect()
        };
        let fails = |colour: f64| {
            (0..200).filter(|seed| Whiteness::of(&innovations(colour, *seed)).is_some_and(|test| test.fails())).count()
        };
        assert!(fails(0.0) <= 2, "{}", fails(0.0));
        assert_eq!(fails(0.3), 200);
        assert_eq!(Whiteness::of(&vec![Six::zeros(); 500]), None);
        assert_eq!(Whiteness::of(&innovations(0.0, 1)[..99]), None);
    }
}
